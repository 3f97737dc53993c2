#include "materialPoints/StateTransfer.h"

#include "materialPoints/Seeding.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace caisson;
using namespace caisson::testing;

namespace {

const std::string sand = "sand { law mohrCoulomb; porosity 0.35; solidDensity 2650; youngsModulus 60e6; "
                         "poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 1; cohesion 0; }";
const std::string elasticSand = "sand { law linearElastic; porosity 0.35; solidDensity 2650; "
                                "youngsModulus 60e6; poissonsRatio 0.25; }";
const std::string clay = "clay { law linearElastic; porosity 0.5; solidDensity 2700; youngsModulus 5e6; "
                         "poissonsRatio 0.4; }";

EarlierPoints fill(const BackgroundMesh& mesh, const std::string& soils, const std::string& regions)
{
    EarlierPoints result;
    InputProblems problems;
    result.materials = readMaterials(parseDictionary(soils), problems);
    const Dictionary dictionary = parseDictionary("regions (" + regions + ");", "setMaterialPointsDict");
    const auto read = readSeedRegions(dictionariesIn(*dictionary.find("regions"), problems), mesh,
                                      result.materials, problems);
    result.points = seedPoints(mesh, read, result.materials, {}, problems).points;
    problems.throwIfAny("test points");
    return result;
}

const BackgroundMesh& mesh()
{
    static const BackgroundMesh built =
        structuredMesh(evenLines(0, 2, 8), evenLines(-2, 0, 8), Geometry::axisymmetric);
    return built;
}

/// A stress that varies with the place.
void setStress(MaterialPoints& points)
{
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (int j = 0; j < 4; ++j) {
            points.stress[j][p] = (j + 1) * 1e4 * points.z[p] + 1e3 * points.r[p];
        }
        for (std::size_t k = 0; k < points.state.size(); ++k) {
            points.state[k][p] = 0.01 * static_cast<double>(k + 1) * points.r[p];
        }
    }
}

} // namespace

TEST(StateTransfer, isExactForTheSamePoints)
{
    EarlierPoints earlier = fill(mesh(), sand, "{ type all; material sand; }");
    setStress(earlier.points);
    std::vector<int> order(earlier.points.size());
    for (std::size_t p = 0; p < order.size(); ++p) {
        order[p] = static_cast<int>(order.size() - 1 - p);
    }
    EarlierPoints now = fill(mesh(), sand, "{ type all; material sand; }");
    const MaterialPoints expected = earlier.points;
    earlier.points.reorder(order);
    InputProblems problems;
    takeEarlierState(now.points, now.materials, mesh(), earlier, {}, problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(now.points.stress, expected.stress);
    EXPECT_EQ(now.points.state, expected.state);
}

TEST(StateTransfer, comesFromTheNearestPointOfOtherMeshesAndDensities)
{
    const BackgroundMesh fine =
        structuredMesh(evenLines(0, 2, 24), evenLines(-2, 0, 24), Geometry::axisymmetric);
    EarlierPoints earlier = fill(fine, sand, "{ type all; material sand; }");
    setStress(earlier.points);
    EarlierPoints now = fill(mesh(), sand, "{ type all; material sand; pointsPerCell (3 1); }");
    InputProblems problems;
    takeEarlierState(now.points, now.materials, mesh(), earlier, {}, problems);
    EXPECT_TRUE(problems.empty());
    const double reach =
        0.5 * std::hypot(2.0 / 48, 2.0 / 48) * 1.5; // half a diagonal; ring centres shift a bit
    for (std::size_t p = 0; p < now.points.size(); ++p) {
        const double exact = 2e4 * now.points.z[p] + 1e3 * now.points.r[p];
        EXPECT_NEAR(now.points.stress[1][p], exact, 2.1e4 * reach);
    }
}

TEST(StateTransfer, matchesMaterialsAndVariablesByName)
{
    const std::string layers = "{ type box; min (0 -2); max (2 -1); material sand; }"
                               "{ type box; min (0 -1); max (2 0); material clay; }";
    EarlierPoints earlier = fill(mesh(), clay + elasticSand, layers);
    setStress(earlier.points);
    EarlierPoints now = fill(mesh(), sand + clay, layers);
    const auto fresh = now.points.state;
    InputProblems problems;
    takeEarlierState(now.points, now.materials, mesh(), earlier, {}, problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(now.points.stress, earlier.points.stress);
    EXPECT_EQ(now.points.state, fresh); // an elastic law has none
}

TEST(StateTransfer, namesPointsWithoutAnEarlierOne)
{
    const EarlierPoints earlier = fill(mesh(), sand, "{ type box; min (0 -2); max (2 -1); material sand; }");
    EarlierPoints now = fill(mesh(), sand, "{ type all; material sand; }");
    InputProblems problems;
    takeEarlierState(now.points, now.materials, mesh(), earlier, {"system/setMaterialPointsDict", 7},
                     problems);
    ASSERT_EQ(problems.all().size(), 1);
    // Four rows of eight cells lie higher, the lowest of which is next to the earlier soil.
    EXPECT_EQ(problems.all()[0].message.find("96 of 256 points have no earlier one of their material"), 0)
        << problems.all()[0].message;
    EXPECT_EQ(problems.all()[0].where.line, 7);

    EarlierPoints other = fill(mesh(), clay, "{ type all; material clay; }");
    InputProblems names;
    takeEarlierState(other.points, other.materials, mesh(), now, {}, names);
    ASSERT_EQ(names.all().size(), 1);
    EXPECT_NE(names.all()[0].message.find("256 of 256"), std::string::npos);
}
