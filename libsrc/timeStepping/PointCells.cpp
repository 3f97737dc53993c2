#include "timeStepping/PointCells.h"

#include <algorithm>
#include <numeric>

namespace caisson {

void PointCells::sort(MaterialPoints& points, int cells)
{
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&points](int a, int b) {
        return points.cell[a] != points.cell[b] ? points.cell[a] < points.cell[b]
                                                : points.id[a] < points.id[b];
    });
    points.reorder(order);
    findRuns(points);
    index(points, cells);
}

void PointCells::index(const MaterialPoints& points, int cells)
{
    const int n = static_cast<int>(points.size());
    start_.assign(cells + 1, 0);
    for (int p = 0; p < n; ++p) {
        ++start_[points.cell[p] + 1];
    }
    for (int c = 0; c < cells; ++c) {
        start_[c + 1] += start_[c];
    }
    cursor_.assign(start_.begin(), start_.end() - 1);
    index_.resize(n);
    for (int p = 0; p < n; ++p) {
        index_[cursor_[points.cell[p]]++] = p;
    }
}

void PointCells::findRuns(const MaterialPoints& points)
{
    runs_.clear();
    for (int p = 0; p < static_cast<int>(points.size()); ++p) {
        if (runs_.empty() || runs_.back().material != points.material[p]) {
            runs_.push_back({points.material[p], p, p});
        }
        runs_.back().end = p + 1;
    }
}

} // namespace caisson
