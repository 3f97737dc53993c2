#include "bodies/BodySurface.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace caisson::testing {
namespace {

RigidBody skirt(double tipLevel)
{
    RigidBody body;
    body.name = "skirt";
    body.profile = caissonProfile(1.2, 0.2, 5, 0, 0);
    body.tipLevel = body.initialTipLevel = tipLevel;
    return body;
}

TEST(RigidBody, profileHasItsNormalsOutwardAndItsPartsByFace)
{
    const RigidBody body = skirt(-0.5);
    ASSERT_EQ(body.profile.size(), 4u);
    for (const ProfileEdge& edge : body.profile) {
        // A step along the normal from the middle of an edge leads out of the body, one against it leads in.
        const double r = 0.5 * (edge.from[0] + edge.to[0]);
        const double z = 0.5 * (edge.from[1] + edge.to[1]) + body.tipLevel;
        EXPECT_FALSE(body.contains(r + 1e-6 * edge.normal[0], z + 1e-6 * edge.normal[1]));
        EXPECT_TRUE(body.contains(r - 1e-6 * edge.normal[0], z - 1e-6 * edge.normal[1]));
        const SurfacePart part = edge.normal[1] < 0   ? SurfacePart::tip
                                 : edge.normal[1] > 0 ? SurfacePart::lid
                                 : edge.normal[0] < 0 ? SurfacePart::inner
                                                      : SurfacePart::outer;
        EXPECT_EQ(edge.part, part);
    }
}

TEST(RigidBody, aLidLooksDownAndIsNotTheTip)
{
    const std::vector<ProfileEdge> profile = caissonProfile(1.2, 0.2, 5, 2, 0.1);
    int lids = 0;
    for (const ProfileEdge& edge : profile) {
        lids += edge.part == SurfacePart::lid && edge.normal[1] < 0;
        EXPECT_FALSE(edge.from[0] == 0 && edge.to[0] == 0) << "the axis is no surface";
    }
    EXPECT_EQ(lids, 1);
}

TEST(RigidBody, itsRateRisesFromRestAndFollowsItsVariable)
{
    RigidBody body = skirt(-0.5);
    EXPECT_EQ(body.prescribedVelocity(1), 0) << "no rate given";
    body.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(0.2));
    body.ramp = 0.1;
    EXPECT_EQ(body.prescribedVelocity(0), 0);
    EXPECT_NEAR(body.prescribedVelocity(0.05), -0.1, 1e-15);
    EXPECT_EQ(body.prescribedVelocity(0.2), -0.2);
    InputProblems problems;
    const Dictionary dictionary = parseDictionary("rate table ((0 0.2) (5 0.08));");
    body.penetrationRate = readFunction1(dictionary, "rate", problems);
    ASSERT_TRUE(problems.empty());
    body.variable = RigidBody::Variable::penetration;
    EXPECT_NEAR(body.prescribedVelocity(1), -(0.2 - 0.12 * 0.5 / 5), 1e-15);
}

TEST(BodySurface, hasTheAreasOfItsFacesAndNoNodeAcrossTheWall)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 2, 20), evenLines(-2, 1, 30), Geometry::axisymmetric);
    const RigidBody body = skirt(-0.5);
    InputProblems problems;
    const BodySurface surface = findBodySurface(body, mesh, problems);
    ASSERT_TRUE(problems.empty());
    double area[surfaceParts] = {};
    for (const SurfaceNode& node : surface.nodes) {
        for (int f = 0; f < node.faces; ++f) {
            area[static_cast<int>(node.part[f])] += node.area[f];
        }
        EXPECT_TRUE(std::abs(mesh.r[node.node] - 1.0) < 1e-12 || std::abs(mesh.r[node.node] - 1.2) < 1e-12 ||
                    std::abs(mesh.z[node.node] + 0.5) < 1e-12);
    }
    // per radian: height times radius up to the top of the mesh, and (Ro^2 - Ri^2)/2
    EXPECT_NEAR(area[static_cast<int>(SurfacePart::inner)], 1.5 * 1.0, 1e-12);
    EXPECT_NEAR(area[static_cast<int>(SurfacePart::outer)], 1.5 * 1.2, 1e-12);
    EXPECT_NEAR(area[static_cast<int>(SurfacePart::tip)], (1.44 - 1.0) / 2, 1e-12);
    int voids = 0;
    for (const unsigned char isVoid : surface.voidCell) {
        voids += isVoid;
    }
    EXPECT_EQ(voids, 2 * 15) << "two columns of cells from the tip to the top of the mesh";
}

TEST(BodySurface, cornersOfTheTipKnowTheirNeighbourAndTheirShare)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 2, 20), evenLines(-2, 1, 30), Geometry::planeStrain);
    InputProblems problems;
    const BodySurface surface = findBodySurface(skirt(-0.5), mesh, problems);
    int cornersFound = 0;
    for (const SurfaceNode& node : surface.nodes) {
        if (node.faces < 2) {
            continue;
        }
        ++cornersFound;
        EXPECT_EQ(node.part[0], SurfacePart::tip);
        EXPECT_NEAR(node.tipShare, 0.5, 1e-12) << "equal cells on both sides, plane strain";
        ASSERT_GE(node.beside, 0);
        const double side = mesh.r[node.node] < 1.1 ? -0.1 : 0.1;
        EXPECT_NEAR(mesh.r[node.beside], mesh.r[node.node] + side, 1e-12);
        EXPECT_NEAR(mesh.z[node.beside], -0.5, 1e-12);
        EXPECT_NEAR(std::abs(node.roundedNormal[0]), std::sqrt(0.5), 1e-12);
        EXPECT_NEAR(node.roundedNormal[1], -std::sqrt(0.5), 1e-12);
    }
    EXPECT_EQ(cornersFound, 2);
}

TEST(BodySurface, aFaceThroughCellsIsAProblemThatSaysWhere)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 2, 20), evenLines(-2, 1, 30), Geometry::axisymmetric);
    InputProblems problems;
    findBodySurface(skirt(-0.47), mesh, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_NE(problems.all()[0].message.find("its surface cuts through the cells at r ="), std::string::npos);
    EXPECT_NE(problems.all()[0].hint.find("tipLevel"), std::string::npos);
}

TEST(BodySurface, pushesAPlaceOutOverTheNearestFace)
{
    const RigidBody body = skirt(-0.5);
    const auto left = pushOut(body, 1.01, 0.3, 1e-6);
    EXPECT_NEAR(left[0], 1 - 1e-6, 1e-12);
    EXPECT_NEAR(left[1], 0.3, 1e-12);
    const auto down = pushOut(body, 1.1, -0.49, 1e-6);
    EXPECT_NEAR(down[0], 1.1, 1e-12);
    EXPECT_NEAR(down[1], -0.5 - 1e-6, 1e-12);
}

TEST(Bodies, wrongInputIsReportedTogether)
{
    InputProblems problems;
    const Dictionary dictionary = parseDictionary(R"(
caisson
{
    shape caisson;
    outerRadius 1;
    wallThickness 2;
    skirtLenght 5;
    tipLevel -0.5;
    friction -1;
}
)",
                                                  "constant/bodies");
    readBodies(dictionary, problems);
    const std::string report = formatProblems("bodies", problems.all());
    EXPECT_NE(report.find("constant/bodies:7: unknown key 'skirtLenght'"), std::string::npos) << report;
    EXPECT_NE(report.find("did you mean 'skirtLength'?"), std::string::npos) << report;
    EXPECT_NE(report.find("constant/bodies:9: friction -1 is outside [0, inf)"), std::string::npos) << report;
    EXPECT_NE(report.find("wallThickness is not smaller than outerRadius"), std::string::npos) << report;
    EXPECT_NE(report.find("missing key 'skirtLength'"), std::string::npos) << report;
}

} // namespace
} // namespace caisson::testing
