#pragma once

#include "materialPoints/MaterialPoints.h"

#include <vector>

namespace caisson {

/// Which points are in which cell: those of cell c are points(c)[0 .. count(c)-1]. Between two physical sorts
/// the storage order stays and only the index moves.
class PointCells
{
public:
    /// Sorts the storage by cell, then id, and indexes it.
    void sort(MaterialPoints& points, int cells);
    /// Indexes anew after some points changed their cell; storage order within a cell.
    void index(const MaterialPoints& points, int cells);

    [[nodiscard]] int count(int cell) const { return start_[cell + 1] - start_[cell]; }
    [[nodiscard]] const int* begin(int cell) const { return index_.data() + start_[cell]; }
    [[nodiscard]] const int* end(int cell) const { return index_.data() + start_[cell + 1]; }

    /// Runs of one material in the storage: {material, first point, one past the last}.
    struct Run
    {
        int material, begin, end;
    };
    [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }

private:
    void findRuns(const MaterialPoints& points);

    std::vector<int> start_, index_, cursor_;
    std::vector<Run> runs_;
};

} // namespace caisson
