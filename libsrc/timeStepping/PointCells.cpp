#include "timeStepping/PointCells.h"

#include <algorithm>

namespace caisson {

void PointCells::sort(MaterialPoints& points, int cells, std::span<const unsigned char> rests)
{
    index(points, cells);
    std::vector<int> order;
    order.reserve(points.size());
    for (const bool resting : {false, true}) {
        for (int c = 0; c < cells; ++c) {
            if (resting != (!rests.empty() && rests[c] != 0)) {
                continue;
            }
            order.insert(order.end(), begin(c), end(c));
            std::sort(order.end() - count(c), order.end(),
                      [&points](int a, int b) { return points.id[a] < points.id[b]; });
        }
    }
    points.reorder(order);
    findRuns(points, rests);
    index(points, cells);
}

void PointCells::index(const MaterialPoints& points, int cells)
{
    constexpr int spare = 4; // points that may come before all is indexed again
    const int n = static_cast<int>(points.size());
    slots_.assign(cells, {});
    for (int p = 0; p < n; ++p) {
        ++slots_[points.cell[p]].room;
    }
    int start = 0;
    for (Slot& slot : slots_) {
        slot.room += spare;
        slot.start = start;
        start += slot.room;
    }
    index_.resize(start);
    for (int p = 0; p < n; ++p) {
        Slot& slot = slots_[points.cell[p]];
        index_[slot.start + slot.count++] = p;
    }
}

void PointCells::move(const MaterialPoints& points, std::span<const Mover> movers)
{
    for (const Mover& mover : movers) {
        Slot& to = slots_[points.cell[mover.point]];
        if (to.count == to.room) {
            index(points, cells());
            return;
        }
        Slot& from = slots_[mover.from];
        int* const old = std::lower_bound(index_.data() + from.start, index_.data() + from.start + from.count,
                                          mover.point);
        std::copy(old + 1, index_.data() + from.start + from.count, old);
        --from.count;
        int* const last = index_.data() + to.start + to.count;
        int* const place = std::lower_bound(index_.data() + to.start, last, mover.point);
        std::copy_backward(place, last, last + 1);
        *place = mover.point;
        ++to.count;
    }
}

void PointCells::findRuns(const MaterialPoints& points, std::span<const unsigned char> rests)
{
    runs_.clear();
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
        const bool resting = !rests.empty() && rests[points.cell[p]] != 0;
        if (runs_.empty() || runs_.back().material != points.material[p] || runs_.back().rests != resting) {
            runs_.push_back({points.material[p], resting, p, p});
        }
        runs_.back().end = p + 1;
    }
}

} // namespace caisson
