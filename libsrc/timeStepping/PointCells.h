#pragma once

#include "materialPoints/MaterialPoints.h"
#include "timeStepping/Threads.h"

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

    /// Indexes points as they lie.
    void index(const MaterialPoints& points, int cells);
    /// Sorts the storage of indexed points by cell, then id. Cells that rest come last: `rests` says so per
    /// cell, and may be empty. Points that the index does not hold go.
    void sort(MaterialPoints& points, Threads& threads, std::span<const unsigned char> rests = {});
    /// Brings the index up to date after points have moved to the cells that they name now: the same as to
    /// sort every cell's points anew.
    void move(const MaterialPoints& points, std::span<const Mover> movers);

    /// Takes a point out of a cell; the next sort ends it.
    void remove(int point, int cell);

    [[nodiscard]] int cells() const { return static_cast<int>(slots_.size()); }
    [[nodiscard]] int count(int cell) const { return slots_[cell].count; }
    [[nodiscard]] const int* begin(int cell) const { return index_.data() + slots_[cell].start; }
    [[nodiscard]] const int* end(int cell) const { return begin(cell) + count(cell); }
    /// Of points in cells that rest, or in those that do not.
    [[nodiscard]] std::span<const Run> runs(bool resting) const
    {
        const std::span<const Run> all = runs_;
        return resting ? all.subspan(awakeRuns_) : all.first(awakeRuns_);
    }

private:
    /// Place of a cell in the index, with room for points that come.
    struct Slot
    {
        int start = 0, count = 0, room = 0;
    };
    /// Where the points of a cell go in the storage.
    struct Place
    {
        int cell, first;
    };

    /// Points that stay one behind the other: most do, where few cells have changed.
    struct Piece
    {
        int first, count;
    };

    void makeRoom();
    void reorder(MaterialPoints& points, Threads& threads);
    void findRuns(const MaterialPoints& points, int resting);

    std::vector<Slot> slots_;
    std::vector<int> index_;
    std::vector<Run> runs_;
    std::size_t awakeRuns_ = 0; ///< the first of them, in cells that do not rest
    // Of sort, kept for the next one:
    std::vector<Place> places_;
    std::vector<int> order_;
    std::vector<Piece> pieces_;
    std::vector<std::vector<double>> numbers_; ///< per thread
    std::vector<std::vector<int>> labels_;     ///< per thread
};

} // namespace caisson
