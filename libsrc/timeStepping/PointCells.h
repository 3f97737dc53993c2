#pragma once

#include "materialPoints/MaterialPoints.h"

#include <span>
#include <vector>

namespace caisson {

/// Which points are in which cell: those of cell c are begin(c) .. end(c), ascending. Between two physical
/// sorts the storage order stays and only the index moves.
class PointCells
{
public:
    /// A point whose cell has changed, and the one that it was in.
    struct Mover
    {
        int point, from;
    };
    /// Run of points in the storage: of one material, in cells that rest or in cells that do not.
    struct Run
    {
        int material;
        bool rests;
        int begin, end;
    };

    /// Sorts the storage by cell, then id, and indexes it. Cells that rest come last: `rests` says so per
    /// cell, and may be empty.
    void sort(MaterialPoints& points, int cells, std::span<const unsigned char> rests = {});
    /// Brings the index up to date after points have moved to the cells that they name now: the same as to
    /// sort every cell's points anew.
    void move(const MaterialPoints& points, std::span<const Mover> movers);

    [[nodiscard]] int cells() const { return static_cast<int>(slots_.size()); }
    [[nodiscard]] int count(int cell) const { return slots_[cell].count; }
    [[nodiscard]] const int* begin(int cell) const { return index_.data() + slots_[cell].start; }
    [[nodiscard]] const int* end(int cell) const { return begin(cell) + count(cell); }
    [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }

private:
    /// Place of a cell in the index, with room for points that come.
    struct Slot
    {
        int start = 0, count = 0, room = 0;
    };

    void index(const MaterialPoints& points, int cells);
    void findRuns(const MaterialPoints& points, std::span<const unsigned char> rests);

    std::vector<Slot> slots_;
    std::vector<int> index_;
    std::vector<Run> runs_;
};

} // namespace caisson
