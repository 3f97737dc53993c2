// The quick squares of the stability map: what they are held to is said in Drive.h.

#include "Limits.h"
#include "Matrix.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>

namespace caisson::stability {
namespace {

std::vector<Case> quickCases()
{
    std::vector<Case> all = stabilityMatrix();
    std::erase_if(all, [](const Case& square) { return !square.quick; });
    return all;
}

class QuickSquare : public ::testing::TestWithParam<std::string>
{
};

std::vector<std::string> quickSweeps()
{
    std::vector<std::string> names;
    for (const Case& square : quickCases()) {
        if (names.empty() || names.back() != square.sweep) {
            names.push_back(square.sweep);
        }
    }
    return names;
}

TEST_P(QuickSquare, holdsOrIsStopped)
{
    for (const Case& square : quickCases()) {
        if (square.sweep != GetParam()) {
            continue;
        }
        const Outcome outcome = outcomeOf(square.run);
        std::printf("%s = %s, %s: %s %s\n", square.sweep.c_str(), square.value.c_str(), square.kernel.c_str(),
                    name(outcome.verdict).c_str(), outcome.remark.c_str());
        EXPECT_TRUE(square.content(outcome))
            << "expected holds" << (square.mayStop ? " or stopped" : "") << ", got " << name(outcome.verdict);
    }
}

std::string testName(const ::testing::TestParamInfo<std::string>& info)
{
    std::string result;
    bool capital = false;
    for (const char letter : info.param) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        if (plain) {
            result += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
        }
        capital = !plain;
    }
    return result;
}

INSTANTIATE_TEST_SUITE_P(Map, QuickSquare, ::testing::ValuesIn(quickSweeps()), testName);

/// The estimate of the stable step is safe, and not much too small, with implicit drag.
TEST(StableStep, isSafeAndThreeQuartersOfTheTrueLimitAtLeast)
{
    for (const int phases : {1, 2}) {
        for (const bool triangles : {false, true}) {
            Block block{.kernel = {phases, triangles, Geometry::planeStrain}};
            block.columns = block.rows = 6;
            block.emptyRows = 0;
            block.gravity = 0;
            block.noise = 1e-7;
            const std::string kernel = block.kernel.name();
            EXPECT_FALSE(grows(block, 1.0, 3000)) << kernel << ": noise grows at the estimate";
            // Triangles of two phases: their averaged pressures allow more (see doc/stability.md).
            const double beyond = phases == 2 && triangles ? 1.6 : 1 / 0.75;
            EXPECT_TRUE(grows(block, beyond, 3000)) << kernel << ": noise does not grow at " << beyond;
        }
    }
}

} // namespace
} // namespace caisson::stability
