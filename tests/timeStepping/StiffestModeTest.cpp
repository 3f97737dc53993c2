#include "timeStepping/StiffestMode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace caisson {
namespace {

constexpr double density = 2000, side = 0.2, shear = 3e6, bulk = 8e6;
/// Largest deviation that Lanczos' method may have where it finds all vibrations.
constexpr double rounding = 1e-9;

/// Equilateral triangle in plane strain, with one phase and the shape functions at its points of equal mass.
StiffestMode<1> equilateral(const std::vector<std::array<double, 3>>& points)
{
    const double r[3] = {0, side, 0.5 * side};
    const double z[3] = {0, 0, std::sqrt(0.75) * side};
    StiffestMode<1>::Cell cell;
    cell.node = {0, 1, 2};
    cell.volume = cell.stressed = 0.5 * side * z[2];
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3;
        const int b = (k + 2) % 3;
        cell.gr[k] = (z[a] - z[b]) / (2 * cell.volume);
        cell.gz[k] = (r[b] - r[a]) / (2 * cell.volume);
    }
    cell.shear = shear;
    cell.bulk = bulk;
    for (const auto& N : points) {
        const double mass = density * cell.volume / static_cast<double>(points.size());
        for (int k = 0; k < 3; ++k) {
            cell.mass[0][k] += mass * N[k] * N[k];
            cell.mass[0][3 + k] += mass * N[k] * N[(k + 1) % 3];
        }
    }
    StiffestMode<1> mode;
    mode.cells = {cell};
    mode.nodes.resize(3);
    return mode;
}

double stepOver(StiffestMode<1> mode, double exact)
{
    Threads threads(1);
    mode.prepare(threads);
    return mode.step(threads) / (StiffestMode<1>::margin * exact);
}

/// Step 2/omega of the even dilatation, the stiffest vibration: omega^2 = 3 (K + G/3) sum |grad N|^2/rho with
/// a third of the mass at each node, sum |grad N|^2 = 4/side^2.
double exactStep() { return 2 / std::sqrt(12 * (bulk + shear / 3) / (density * side * side)); }

TEST(StiffestMode, isTheEvenDilatationOfATriangleWithPointsAtItsCorners)
{
    const double ratio = stepOver(equilateral({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), exactStep());
    EXPECT_NEAR(ratio, 1, rounding) << "step over 2/omega: expected 1, got " << ratio;
}

/// Of the forces of a vibration without a mean a single point sees nothing: C M^-1 f = 0.
TEST(StiffestMode, allowsHalfTheSquareOfTheStepWhereAPointLosesTheVibration)
{
    const double ratio = stepOver(equilateral({{1. / 3, 1. / 3, 1. / 3}}), exactStep() / std::sqrt(2));
    EXPECT_NEAR(ratio, 1, rounding) << "step over sqrt(2)/omega: expected 1, got " << ratio;
}

/// Three points at 2/3, 1/6, 1/6 leave (2/3 - 1/6)^2 = 1/4 of a vibration without a mean.
TEST(StiffestMode, countsTheShareThatThreePointsKeep)
{
    const double ratio =
        stepOver(equilateral({{2. / 3, 1. / 6, 1. / 6}, {1. / 6, 2. / 3, 1. / 6}, {1. / 6, 1. / 6, 2. / 3}}),
                 exactStep() / std::sqrt(1.75));
    EXPECT_NEAR(ratio, 1, rounding) << "step over 2/(sqrt(1.75) omega): expected 1, got " << ratio;
}

TEST(StiffestMode, isNoneWhereEverythingIsHeld)
{
    StiffestMode<1> mode = equilateral({{1. / 3, 1. / 3, 1. / 3}});
    for (auto& node : mode.nodes) {
        node.hold(0, {1, 0});
        node.hold(0, {std::sqrt(0.5), std::sqrt(0.5)});
    }
    Threads threads(1);
    mode.prepare(threads);
    const double step = mode.step(threads);
    EXPECT_EQ(step, std::numeric_limits<double>::infinity()) << "expected no limit, got " << step << " s";
}

} // namespace
} // namespace caisson
