#include "timeStepping/PointCells.h"

#include <algorithm>
#include <numeric>

namespace caisson {

void PointCells::sort(MaterialPoints& points, Threads& threads, std::span<const unsigned char> rests)
{
    constexpr int cellsPerPiece = 128;
    places_.clear();
    int first = 0;
    int resting = 0; // the first point in a cell that rests
    for (const bool wanted : {false, true}) {
        resting = first;
        for (int c = 0; c < cells(); ++c) {
            if (count(c) > 0 && wanted == (!rests.empty() && rests[c] != 0)) {
                places_.push_back({c, first});
                first += count(c);
            }
        }
    }
    order_.resize(first);
    threads.share(static_cast<int>(places_.size()), cellsPerPiece, [&](int, int from, int to) {
        for (int i = from; i < to; ++i) {
            const auto [c, at] = places_[i];
            std::copy(begin(c), end(c), order_.begin() + at);
            std::sort(order_.begin() + at, order_.begin() + at + count(c),
                      [&points](int a, int b) { return points.id[a] < points.id[b]; });
        }
    });
    pieces_.clear();
    for (const int p : order_) {
        if (pieces_.empty() || p != pieces_.back().first + pieces_.back().count) {
            pieces_.push_back({p, 0});
        }
        ++pieces_.back().count;
    }
    reorder(points, threads);
    findRuns(points, resting);
    for (Slot& slot : slots_) {
        slot.room = slot.count;
    }
    makeRoom();
    threads.share(static_cast<int>(places_.size()), cellsPerPiece, [&](int, int from, int to) {
        for (int i = from; i < to; ++i) {
            const auto [c, at] = places_[i];
            int* const own = index_.data() + slots_[c].start;
            std::iota(own, own + count(c), at);
        }
    });
}

/// Every array at once, each by one thread.
void PointCells::reorder(MaterialPoints& points, Threads& threads)
{
    std::vector<std::vector<double>*> numbers;
    std::vector<std::vector<int>*> labels;
    points.forEachArray([&](auto& array) {
        if constexpr (std::is_same_v<decltype(array), std::vector<int>&>) {
            labels.push_back(&array);
        } else {
            numbers.push_back(&array);
        }
    });
    numbers_.resize(threads.count());
    labels_.resize(threads.count());
    const auto pick = [this](auto& array, auto& scratch) {
        scratch.resize(order_.size());
        auto to = scratch.begin();
        for (const Piece& piece : pieces_) {
            to = std::copy_n(array.begin() + piece.first, piece.count, to);
        }
        array.swap(scratch);
    };
    const int some = static_cast<int>(numbers.size());
    threads.share(some + static_cast<int>(labels.size()), 1, [&](int thread, int from, int to) {
        for (int i = from; i < to; ++i) {
            if (i < some) {
                pick(*numbers[i], numbers_[thread]);
            } else {
                pick(*labels[i - some], labels_[thread]);
            }
        }
    });
}

/// Places the slots one after the other, each with some points more than its room.
void PointCells::makeRoom()
{
    constexpr int spare = 4; // points that may come before all is indexed again
    int start = 0;
    for (Slot& slot : slots_) {
        slot.room += spare;
        slot.start = start;
        start += slot.room;
    }
    index_.resize(start);
}

void PointCells::index(const MaterialPoints& points, int cells)
{
    slots_.assign(cells, {});
    for (const int c : points.cell) {
        ++slots_[c].room;
    }
    makeRoom();
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
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
        remove(mover.point, mover.from);
        int* const last = index_.data() + to.start + to.count;
        int* const place = std::lower_bound(index_.data() + to.start, last, mover.point);
        std::copy_backward(place, last, last + 1);
        *place = mover.point;
        ++to.count;
    }
}

void PointCells::remove(int point, int cell)
{
    Slot& slot = slots_[cell];
    int* const last = index_.data() + slot.start + slot.count;
    int* const place = std::lower_bound(index_.data() + slot.start, last, point);
    std::copy(place + 1, last, place);
    --slot.count;
}

void PointCells::findRuns(const MaterialPoints& points, int resting)
{
    runs_.clear();
    const auto add = [&](int begin, int end, bool rests) {
        while (begin < end) {
            const int material = points.material[begin];
            const auto other = std::find_if(points.material.begin() + begin, points.material.begin() + end,
                                            [material](int of) { return of != material; });
            const int last = static_cast<int>(other - points.material.begin());
            runs_.push_back({material, rests, begin, last});
            begin = last;
        }
    };
    add(0, resting, false);
    awakeRuns_ = runs_.size();
    add(resting, static_cast<int>(points.size()), true);
}

} // namespace caisson
