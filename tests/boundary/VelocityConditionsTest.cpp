#include "boundary/VelocityConditions.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace caisson::testing {
namespace {

VelocityConditions conditions(const BackgroundMesh& mesh, const std::string& boundaryField,
                              InputProblems& problems)
{
    const Dictionary dictionary = parseDictionary("boundaryField { " + boundaryField + " }", "0/U");
    return {mesh, readPatchVelocities(dictionary, mesh, {"front", "back"}, problems)};
}

TEST(VelocityConditions, rollersHoldTheNormalAndCornersAreFixed)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 1, 2), evenLines(0, 1, 2), Geometry::axisymmetric);
    InputProblems problems;
    const VelocityConditions held =
        conditions(mesh, "right { type slip; } bottom { type slip; } top { type zeroGradient; }", problems);
    ASSERT_TRUE(problems.empty());
    int fixed = 0;
    for (const VelocityConditions::Node& node : held.nodes()) {
        fixed += node.fixed;
        const bool bottom = mesh.z[node.node] == 0;
        const bool side = mesh.r[node.node] == 0 || mesh.r[node.node] == 1;
        EXPECT_EQ(node.fixed, bottom && side);
        if (!node.fixed) {
            EXPECT_NEAR(std::abs(node.normal[0]), side ? 1 : 0, 1e-15);
            EXPECT_NEAR(std::abs(node.normal[1]), bottom ? 1 : 0, 1e-15);
        }
    }
    EXPECT_EQ(fixed, 2);
    EXPECT_EQ(held.nodes().size(), 7u) << "axis 3, right 3, bottom 3, less the two corners counted twice";
}

TEST(VelocityConditions, tractionsSumToPressureTimesArea)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        const BackgroundMesh mesh = structuredMesh(evenLines(1, 3, 5), evenLines(0, 2, 4), geometry);
        InputProblems problems;
        const VelocityConditions loaded = conditions(
            mesh,
            "left { type pressure; uniformValue 7; } right { type zeroGradient; } bottom { type slip; } "
            "top { type traction; uniformValue table ((0 (0 0 0)) (1 (2 0 -4))); }",
            problems);
        ASSERT_TRUE(problems.empty());
        ASSERT_TRUE(loaded.hasTractions());
        std::vector<std::array<double, 2>> force(mesh.nodes());
        loaded.addTractions(mesh, 0.5, force);
        double sumR = 0, sumZ = 0;
        for (const auto& nodal : force) {
            sumR += nodal[0];
            sumZ += nodal[1];
        }
        const bool axisymmetric = geometry == Geometry::axisymmetric;
        const double leftArea = axisymmetric ? 2 * 1 : 2;            // per radian: height times radius
        const double topArea = axisymmetric ? (9.0 - 1.0) / 2 : 2.0; // per radian: (b^2 - a^2)/2
        EXPECT_NEAR(sumR, 7 * leftArea + 1 * topArea, 1e-12) << "pressure on the left pushes to the right";
        EXPECT_NEAR(sumZ, -2 * topArea, 1e-12);
    }
}

TEST(VelocityConditions, wrongConditionsAreReportedTogether)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 1, 2), evenLines(0, 1, 2), Geometry::axisymmetric);
    InputProblems problems;
    conditions(mesh, "rigth { type slip; } bottom { type rolller; } top { type uniformFixedValue; }",
               problems);
    const std::string report = formatProblems("0/U", problems.all());
    EXPECT_NE(report.find("unknown patch 'rigth'"), std::string::npos) << report;
    EXPECT_NE(report.find("did you mean 'right'?"), std::string::npos) << report;
    EXPECT_NE(report.find("no condition for patch 'right'"), std::string::npos) << report;
    EXPECT_NE(report.find("unknown type 'rolller' for patch 'bottom'"), std::string::npos) << report;
    EXPECT_NE(report.find("type uniformFixedValue needs 'uniformValue'"), std::string::npos) << report;
}

} // namespace
} // namespace caisson::testing
