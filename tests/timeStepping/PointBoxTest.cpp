// The boxes of points, and the means of shape functions over them.

#include "timeStepping/PointBox.h"

#include <gtest/gtest.h>

#include <functional>

namespace caisson::testing {
namespace {

/// Three by three cells, with lines at r and z.
struct Nine
{
    std::array<double, 4> r{0, 0.3, 0.5, 0.9}, z{0, 0.2, 0.5, 0.7};

    template <bool axisymmetric>
    [[nodiscard]] typename shapes::Rectangle<axisymmetric>::Cell cell(int i, int j) const
    {
        const double dr = r[i + 1] - r[i];
        const double dz = z[j + 1] - z[j];
        return {r[i], z[j], dr, dz, 1 / dr, 1 / dz};
    }

    /// Sums of what all nodes have, times a value at each node: with N, dr, dz and hoop.
    template <bool axisymmetric>
    [[nodiscard]] std::array<double, 4> sums(double width, double pr, double pz,
                                             const std::function<double(double, double)>& value) const
    {
        int i = 0, j = 0;
        while (pr > r[i + 1]) {
            ++i;
        }
        while (pz > z[j + 1]) {
            ++j;
        }
        CellSurroundings beside;
        beside.left = i > 0 ? r[i] - r[i - 1] : 0;
        beside.right = i < 2 ? r[i + 2] - r[i + 1] : 0;
        beside.below = j > 0 ? z[j] - z[j - 1] : 0;
        beside.above = j < 2 ? z[j + 2] - z[j + 1] : 0;
        beside.corner = {i > 0 && j > 0, i < 2 && j > 0, i > 0 && j < 2, i < 2 && j < 2};
        const PointBox box = pointBox::around<axisymmetric>(pr, pz, cell<axisymmetric>(i, j), beside, width);
        std::array<double, 4> sum{};
        for (int m = 0; m < 9; ++m) {
            const int ci = m % 3, cj = m / 3;
            BoxPart part;
            if (!pointBox::part<axisymmetric>(box, cell<axisymmetric>(ci, cj), part)) {
                continue;
            }
            const std::array<double, 4> nodal{value(r[ci], z[cj]), value(r[ci + 1], z[cj]),
                                              value(r[ci + 1], z[cj + 1]), value(r[ci], z[cj + 1])};
            for (int k = 0; k < 4; ++k) {
                sum[0] += part.N[k] * nodal[k];
                sum[1] += part.dr[k] * nodal[k];
                sum[2] += part.dz[k] * nodal[k];
                sum[3] += part.hoop[k] * nodal[k];
            }
        }
        return sum;
    }
};

template <bool axisymmetric>
void expectLinearFields(double width)
{
    const Nine nine;
    for (const double r : {1e-6, 0.05, 0.1, 0.29, 0.3001, 0.42, 0.55, 0.87, 0.8999}) {
        for (const double z : {1e-6, 0.1, 0.21, 0.35, 0.49, 0.6, 0.6999}) {
            const auto ones = nine.sums<axisymmetric>(width, r, z, [](double, double) { return 1; });
            const auto alongR = nine.sums<axisymmetric>(width, r, z, [](double x, double) { return x; });
            const auto alongZ = nine.sums<axisymmetric>(width, r, z, [](double, double y) { return y; });
            const std::string where = "at r = " + std::to_string(r) + ", z = " + std::to_string(z);
            EXPECT_NEAR(ones[0], 1, 1e-12) << where;
            EXPECT_NEAR(ones[1], 0, 1e-9) << where;
            EXPECT_NEAR(ones[2], 0, 1e-9) << where;
            EXPECT_NEAR(alongR[0], r, 1e-12) << where << ": the point is the centre of weight";
            EXPECT_NEAR(alongR[1], 1, 1e-9) << where;
            EXPECT_NEAR(alongR[2], 0, 1e-9) << where;
            EXPECT_NEAR(alongR[3], axisymmetric ? 1 : 0, 1e-9) << where << ": hoop strain of v_r = r";
            EXPECT_NEAR(alongZ[0], z, 1e-12) << where;
            EXPECT_NEAR(alongZ[1], 0, 1e-9) << where;
            EXPECT_NEAR(alongZ[2], 1, 1e-9) << where;
        }
    }
}

TEST(PointBox, reproducesLinearFieldsAtTheAxisAtBoundariesAndOnGradedMeshes)
{
    for (const double width : {0.5, 1.0}) {
        expectLinearFields<true>(width);
        expectLinearFields<false>(width);
    }
}

TEST(PointBox, asWideAsACellMakesQuadraticBSplines)
{
    Nine nine;
    nine.r = nine.z = {0, 1, 2, 3};
    for (const double r : {1.05, 1.3, 1.5, 1.77, 1.999}) {
        const auto spline = [](double distance) {
            const double d = std::abs(distance);
            return d < 0.5 ? 0.75 - d * d : d < 1.5 ? 0.5 * (1.5 - d) * (1.5 - d) : 0.0;
        };
        for (const double node : nine.r) {
            const auto got = nine.sums<false>(1, r, 1.6, [&](double x, double) { return x == node ? 1 : 0; });
            EXPECT_NEAR(got[0], spline(r - node), 1e-14) << "node at " << node << ", point at " << r;
        }
    }
}

TEST(PointBox, changesSmoothlyWhereAPointCrossesALine)
{
    const Nine nine;
    for (const double width : {0.5, 1.0}) {
        const auto at = [&](double r) {
            return nine.sums<true>(width, r, 0.35, [](double x, double y) { return x * x + y * y; });
        };
        const auto before = at(0.5 - 1e-9), after = at(0.5 + 1e-9);
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(before[k], after[k], 1e-6) << "mean " << k << ", boxes of " << width << " cells";
        }
    }
}

} // namespace
} // namespace caisson::testing
