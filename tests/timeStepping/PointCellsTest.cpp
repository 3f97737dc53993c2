#include "timeStepping/PointCells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace caisson {
namespace {

/// Points whose ids fall while their cells go round.
MaterialPoints pointsRound(int count, int cells)
{
    MaterialPoints points;
    points.resize(count, 0);
    for (int p = 0; p < count; ++p) {
        points.id[p] = count - p;
        points.cell[p] = p % cells;
        points.material[p] = points.cell[p] == 2 ? 1 : 0;
        points.r[p] = 10 * points.id[p];
    }
    return points;
}

class SortedPoints : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(OfThreads, SortedPoints, ::testing::Values(1, 3));

TEST_P(SortedPoints, lieByCellThenIdAndThoseOfCellsThatRestLast)
{
    constexpr int cells = 5;
    MaterialPoints points = pointsRound(53, cells);
    Threads threads(GetParam());
    PointCells index;
    index.index(points, cells);
    const std::vector<unsigned char> rests{0, 1, 0, 1, 0};
    index.sort(points, threads, rests);
    std::vector<int> order;
    for (std::size_t p = 0; p < points.size(); ++p) {
        EXPECT_EQ(points.r[p], 10 * points.id[p]);
        if (order.empty() || order.back() != points.cell[p]) {
            order.push_back(points.cell[p]);
        } else {
            EXPECT_LT(points.id[p - 1], points.id[p]);
        }
    }
    EXPECT_EQ(order, (std::vector<int>{0, 2, 4, 1, 3}));
    for (int c = 0; c < cells; ++c) {
        for (const int* p = index.begin(c); p != index.end(c); ++p) {
            EXPECT_EQ(points.cell[*p], c);
        }
    }
    // Runs: of one material each, all points together.
    int awake = 0;
    for (const PointCells::Run& run : index.runs(false)) {
        EXPECT_FALSE(run.rests);
        EXPECT_EQ(run.begin, awake);
        awake = run.end;
    }
    EXPECT_EQ(index.runs(false).size(), 3U);
    int all = awake;
    for (const PointCells::Run& run : index.runs(true)) {
        EXPECT_TRUE(run.rests);
        EXPECT_EQ(run.begin, all);
        all = run.end;
    }
    EXPECT_EQ(awake, index.count(0) + index.count(2) + index.count(4));
    EXPECT_EQ(all, 53);
}

TEST_P(SortedPoints, areWithoutThoseThatWereRemoved)
{
    MaterialPoints points = pointsRound(20, 4);
    Threads threads(GetParam());
    PointCells index;
    index.index(points, 4);
    const int gone = points.id[6];
    index.remove(6, 2);
    EXPECT_EQ(index.count(2), 4);
    index.sort(points, threads);
    EXPECT_EQ(points.size(), 19U);
    EXPECT_EQ(std::count(points.id.begin(), points.id.end(), gone), 0);
    EXPECT_EQ(index.count(2), 4);
}

TEST(PointCells, followPointsThatMoveAsIfIndexedAnew)
{
    MaterialPoints points = pointsRound(40, 4);
    PointCells index;
    index.index(points, 4);
    std::vector<PointCells::Mover> movers;
    for (const int p : {8, 12, 1, 16, 20, 24}) { // more than there is room for
        movers.push_back({p, points.cell[p]});
        points.cell[p] = 3;
    }
    index.move(points, movers);
    PointCells anew;
    anew.index(points, 4);
    for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(std::vector<int>(index.begin(c), index.end(c)),
                  std::vector<int>(anew.begin(c), anew.end(c)));
    }
}

} // namespace
} // namespace caisson
