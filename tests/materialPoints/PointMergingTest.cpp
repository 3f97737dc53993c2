#include "materialPoints/PointMerging.h"

#include <gtest/gtest.h>

#include <cmath>

namespace caisson {
namespace {

/// Three points of saturated soil of which nothing is alike.
MaterialPoints threePoints()
{
    MaterialPoints points;
    points.resize(3, 2);
    points.addLiquid();
    double value = 1;
    points.forEachArray([&value](auto& array) {
        for (auto& item : array) {
            using Item = std::decay_t<decltype(item)>;
            item = static_cast<Item>(value);
            value = std::is_same_v<Item, int> ? value + 1 : 1.3 * value + 0.1;
            value = value > 50 ? value / 47 : value;
        }
    });
    points.material = {0, 0, 0};
    return points;
}

/// Sum over the points of what `of` says of each.
template <class Of>
double total(const MaterialPoints& points, const Of& of)
{
    double sum = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        sum += of(p);
    }
    return sum;
}

TEST(PointMerging, keepsMassVolumeMomentumAndTheIntegralsOfStressPressureAndState)
{
    const MaterialPoints before = threePoints();
    const std::vector<double> pores{0.3, 0.7, 0.4};
    MaterialPoints after = before;
    mergePoints(after, 0, 2, {pores[0], pores[2]});
    after.reorder({0, 1});
    ASSERT_EQ(after.size(), 2U);
    const auto compare = [&](const char* name, const auto& of) {
        const double expected = total(before, [&](std::size_t p) { return of(before, p); });
        const double got = total(after, [&](std::size_t p) { return of(after, p); });
        EXPECT_NEAR(got, expected, 1e-13 * std::abs(expected)) << name;
    };
    using Points = MaterialPoints;
    compare("mass", [](const Points& points, std::size_t p) { return points.mass[p]; });
    compare("volume", [](const Points& points, std::size_t p) { return points.volume[p]; });
    for (const auto member : {&Points::r, &Points::z, &Points::vr, &Points::vz, &Points::initialZ}) {
        compare("moment of mass", [member](const Points& points, std::size_t p) {
            return points.mass[p] * (points.*member)[p];
        });
    }
    for (int j = 0; j < 4; ++j) {
        compare("stress",
                [j](const Points& points, std::size_t p) { return points.volume[p] * points.stress[j][p]; });
    }
    for (int k = 0; k < 2; ++k) {
        compare("state",
                [k](const Points& points, std::size_t p) { return points.volume[p] * points.state[k][p]; });
    }
    compare("pore pressure",
            [](const Points& points, std::size_t p) { return points.volume[p] * points.porePressure[p]; });
    // The liquid of the merged point is that of both.
    EXPECT_NEAR((pores[0] + pores[2]) * after.wz[0], pores[0] * before.wz[0] + pores[2] * before.wz[2],
                1e-13);
}

TEST(PointMerging, costsTheSecondMomentOfMassThatItTakes)
{
    const MaterialPoints before = threePoints();
    const double width = 0.7;
    const double height = 3;
    const auto moment = [&](const MaterialPoints& points) {
        return total(points, [&](std::size_t p) {
            return points.mass[p] * (std::pow(points.r[p] / width, 2) + std::pow(points.z[p] / height, 2));
        });
    };
    MaterialPoints after = before;
    mergePoints(after, 1, 2, {0.2, 0.3});
    after.reorder({0, 1});
    const double expected = moment(before) - moment(after);
    EXPECT_NEAR(mergingCost(before, 1, 2, width, height), expected, 1e-10 * moment(before));
    EXPECT_GT(expected, 0);
}

} // namespace
} // namespace caisson
