// Conditions on the pore liquid of patches: what 0/p says, and what is wrong in it.

#include "boundary/LiquidConditions.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

namespace caisson::testing {
namespace {

constexpr double unitWeight = 9810;

std::map<std::string, PatchPressure> read(const std::string& boundaryField, InputProblems& problems)
{
    const BackgroundMesh mesh = structuredMesh({1, 2}, {0, 1}, Geometry::planeStrain);
    return readPatchPressures(parseDictionary("boundaryField { " + boundaryField + " }", "0/p"), mesh,
                              {"front", "back"}, unitWeight, problems);
}

/// The message that a field with one thing wrong gives.
std::string messageOf(const std::string& boundaryField)
{
    InputProblems problems;
    static_cast<void>(read(boundaryField, problems));
    try {
        problems.throwIfAny("test");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no problem";
}

TEST(LiquidConditions, everyTypeGivesItsPressureOrDischarge)
{
    InputProblems problems;
    const auto patches = read("left { type fixedValue; value uniform 7; } "
                              "right { type hydrostatic; level 2; pressure table ((0 0) (10 100)); } "
                              "bottom { type prescribedFlux; uniformValue 1e-6; } top { type impermeable; }",
                              problems);
    problems.throwIfAny("test");
    ASSERT_EQ(patches.size(), 4u);
    EXPECT_TRUE(patches.at("left").givesPressure());
    EXPECT_DOUBLE_EQ(patches.at("left").at(3, 0.5), 7);
    EXPECT_TRUE(patches.at("right").givesPressure());
    EXPECT_DOUBLE_EQ(patches.at("right").at(5, 0.5), unitWeight * 1.5 + 50) << "9810 * (2 - 0.5) + 100/2";
    EXPECT_TRUE(patches.at("bottom").givesFlux());
    EXPECT_DOUBLE_EQ(patches.at("bottom").at(0, 0.5), 1e-6) << "no part of the height";
    EXPECT_EQ(patches.at("top").kind, PatchPressure::Kind::impermeable);
}

TEST(LiquidConditions, planesAndWallsLetNothingThrough)
{
    InputProblems problems;
    const auto patches = read("left { type symmetryPlane; } right { type zeroGradient; } "
                              "bottom { type slip; } top { type uniformFixedValue; uniformValue 5; }",
                              problems);
    problems.throwIfAny("test");
    for (const char* name : {"left", "right", "bottom"}) {
        EXPECT_EQ(patches.at(name).kind, PatchPressure::Kind::impermeable) << name;
    }
    EXPECT_DOUBLE_EQ(patches.at("top").at(1, 0), 5);
}

TEST(LiquidConditions, everyMistakeIsNamedWithItsRemedy)
{
    const std::string rest = " right { type slip; } bottom { type slip; } top { type slip; }";
    const struct
    {
        std::string left, expected;
    } cases[] = {
        {"left { type hydrostatik; level 0; }", "did you mean 'hydrostatic'"},
        {"left { type hydrostatic; levle 0; }", "did you mean 'level'"},
        {"left { type fixedValue; value uniform 5abc; }", "'5abc' is no number"},
        {"left { type fixedValue; value nonuniform (1 2); }", "is not uniform"},
        {"left { type fixedValue; }", "'value'"},
        {"left { type prescribedFlux; }", "'uniformValue'"},
        {"left { level 0; }", "no type for patch 'left'"},
        {"", "no condition for patch 'left'"},
        {"left { type slip; } lfet { type slip; }", "unknown patch 'lfet'"},
    };
    for (const auto& [left, expected] : cases) {
        const std::string message = messageOf(left + rest);
        EXPECT_NE(message.find(expected), std::string::npos)
            << "input: " << left << "\nexpected: " << expected << "\ngot: " << message;
    }
}

TEST(LiquidConditions, allMistakesAreReportedAtOnce)
{
    const std::string message = messageOf("left { type hydrostatik; } right { type prescribedFlux; } "
                                          "bottom { type slip; }");
    for (const char* expected : {"hydrostatik", "'uniformValue'", "no condition for patch 'top'"}) {
        EXPECT_NE(message.find(expected), std::string::npos) << expected << " in:\n" << message;
    }
}

} // namespace
} // namespace caisson::testing
