#include "scene/CheckerboardWatch.h"

#include <gtest/gtest.h>

namespace caisson::testing {
namespace {

/// @returns how often it warns of `times` such indices, one after the other
int warnings(CheckerboardWatch& watch, double index, int times)
{
    int count = 0;
    for (int look = 0; look < times; ++look) {
        count += watch.warns(index) ? 1 : 0;
    }
    return count;
}

TEST(CheckerboardWatch, saysOnceThatPressuresAlternate)
{
    CheckerboardWatch watch;
    EXPECT_EQ(warnings(watch, 0.97, CheckerboardWatch::looks - 1), 0) << "too soon";
    EXPECT_TRUE(watch.warns(0.97));
    EXPECT_EQ(warnings(watch, 0.97, 20), 0) << "said again";
    EXPECT_EQ(warnings(watch, 0.1, 1) + warnings(watch, 0.97, 20), 0) << "said again after smooth pressures";
}

TEST(CheckerboardWatch, bearsRoughPressuresForAMoment)
{
    CheckerboardWatch watch;
    for (int moment = 0; moment < 10; ++moment) {
        EXPECT_EQ(warnings(watch, 0.97, CheckerboardWatch::looks - 1), 0);
        EXPECT_FALSE(watch.warns(CheckerboardWatch::rough)) << "the limit itself is not above it";
    }
}

} // namespace
} // namespace caisson::testing
