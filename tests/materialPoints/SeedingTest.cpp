#include "materialPoints/InitialState.h"
#include "mesh/CellLocator.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace caisson;
using namespace caisson::testing;

namespace {

std::vector<Material> soils()
{
    InputProblems problems;
    const Dictionary dictionary = parseDictionary(
        "sand { law mohrCoulomb; porosity 0.35; solidDensity 2650; youngsModulus 60e6; poissonsRatio 0.25;"
        "       frictionAngle 38; dilatancyAngle 1; cohesion 0; }"
        "clay { law linearElastic; porosity 0.5; solidDensity 2700; youngsModulus 5e6; poissonsRatio 0.4; }");
    auto result = readMaterials(dictionary, problems);
    problems.throwIfAny("soils");
    return result;
}

BackgroundMesh domain(bool triangles = false)
{
    // Graded, and lines through all levels that the tests use
    return structuredMesh({0, 0.4, 1, 1.5, 2.45, 2.5, 4}, {-6, -4.5, -3, -2, -1.2, -0.5, 0, 0.4, 1},
                          Geometry::axisymmetric, triangles);
}

struct Filled
{
    SeededPoints seeded;
    std::vector<std::string> problems;
    std::vector<SourceLocation> where;
};

Filled fill(const BackgroundMesh& mesh, const std::string& regions,
            const std::function<bool(double, double)>& insideBody = {}, const MeshMotion& motion = {})
{
    Filled result;
    InputProblems problems;
    const Dictionary dictionary = parseDictionary("regions\n(\n" + regions + "\n);", "setMaterialPointsDict");
    const auto materials = soils();
    const auto read = readSeedRegions(dictionariesIn(*dictionary.find("regions"), problems), mesh, materials,
                                      problems, motion);
    if (problems.empty()) {
        result.seeded = seedPoints(mesh, read, materials, insideBody, problems);
    }
    for (const InputProblem& problem : problems.all()) {
        result.problems.push_back(problem.message);
        result.where.push_back(problem.where);
    }
    return result;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

} // namespace

TEST(Seeding, volumeAndMassOfABoxAreExact)
{
    for (const bool triangles : {false, true}) {
        const BackgroundMesh mesh = domain(triangles);
        const Filled filled = fill(mesh, "{ type box; min (0 -6); max (4 0); material sand; }");
        ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
        const MaterialPoints& points = filled.seeded.points;
        const double exact = 4.0 * 4 / 2 * 6;
        EXPECT_EQ(points.size(), (triangles ? 3u * 2 : 4u) * 36) << "36 rectangles below z = 0";
        EXPECT_NEAR(total(points.volume) / exact, 1, 1e-14);
        EXPECT_NEAR(total(points.mass) / (exact * (0.65 * 2650 + 0.35 * 1000)), 1, 1e-14) << "saturated";
        EXPECT_NEAR(filled.seeded.regions[0].exactVolume / exact, 1, 1e-14);
        EXPECT_NEAR(filled.seeded.regions[0].coveredVolume / exact, 1, 1e-14);
        EXPECT_DOUBLE_EQ(filled.seeded.regions[0].mass, total(points.mass));
        for (std::size_t p = 0; p < points.size(); ++p) {
            EXPECT_EQ(points.id[p], static_cast<int>(p));
            EXPECT_EQ(points.initialZ[p], points.z[p]);
            EXPECT_EQ(points.vr[p], 0);
            EXPECT_TRUE(p == 0 || points.cell[p] >= points.cell[p - 1]);
        }
    }
}

TEST(Seeding, laterRegionsWinAndNothingIsFilledTwice)
{
    const Filled filled =
        fill(domain(), "{ type all; material sand; pointsPerCell (3 3); }"
                       "{ type box; min (1 -3); max (2.5 0); material clay; pointsPerCell (1 2); }");
    ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
    const double clay = (2.5 * 2.5 - 1) / 2 * 3;
    EXPECT_NEAR(total(filled.seeded.points.volume), 8.0 * 7, 1e-12);
    EXPECT_NEAR(filled.seeded.regions[1].volume, clay, 1e-13);
    EXPECT_NEAR(filled.seeded.regions[0].volume, 8.0 * 7 - clay, 1e-12);
    EXPECT_NEAR(filled.seeded.regions[0].coveredVolume, 8.0 * 7, 1e-12);
    EXPECT_EQ(filled.seeded.regions[1].points, 2u * 12);
    EXPECT_EQ(filled.seeded.points.state.size(), soils()[0].law->stateNames().size());
}

TEST(Seeding, cellZonesAreFilledWhole)
{
    BackgroundMesh mesh = domain(true);
    mesh.cellZones["layer"] = {7, 3, 12};
    const Filled filled = fill(mesh, "{ type cellZone; name layer; material clay; pointsPerCell 6; }");
    ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
    EXPECT_EQ(filled.seeded.points.size(), 18u);
    EXPECT_NEAR(total(filled.seeded.points.volume),
                cellVolume(mesh, 3) + cellVolume(mesh, 7) + cellVolume(mesh, 12), 1e-14);
}

TEST(Seeding, cellsInsideABodyStayEmpty)
{
    const auto skirt = [](double r, double z) { return r > 2.45 && r < 2.5 && z > -1.2; };
    const Filled filled = fill(domain(), "{ type box; min (0 -6); max (4 0); material sand; }", skirt);
    const double exact = 8.0 * 6 - (2.5 * 2.5 - 2.45 * 2.45) / 2 * 1.2;
    EXPECT_NEAR(total(filled.seeded.points.volume), exact, 1e-12);
    EXPECT_NEAR(filled.seeded.regions[0].exactVolume, exact, 1e-12);
    for (std::size_t p = 0; p < filled.seeded.points.size(); ++p) {
        EXPECT_FALSE(skirt(filled.seeded.points.r[p], filled.seeded.points.z[p]));
    }
}

TEST(Seeding, cutCellsConvergeToTheExactVolumeThatIsReported)
{
    // Volume per radian of a polygon or a circle: its area times the r of its centroid (Pappus).
    const double polygon = 0.5 * 2 * 1.7 * (0.9 + 2.9 + 1.6) / 3;
    const double circle = M_PI * 0.8 * 0.8 * 2.2;
    const auto check = [](const std::string& shape, double exact, double tolerance) {
        double last = 1;
        for (const int n : {4, 64}) {
            const Filled filled = fill(domain(), shape + " material sand; pointsPerCell (" +
                                                     std::to_string(n) + " " + std::to_string(n) + "); }");
            ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
            const SeededRegion& region = filled.seeded.regions[0];
            EXPECT_NEAR(region.exactVolume / exact, 1, tolerance) << shape;
            const double error = std::abs(region.volume / exact - 1);
            EXPECT_LT(error, n == 4 ? 0.2 : 0.01) << shape << n;
            EXPECT_LT(error, last);
            last = error;
        }
    };
    check("{ type polygon; vertices ((0.9 -4) (2.9 -4) (1.6 -2.3));", polygon, 1e-13);
    check("{ type polygon; vertices ((1.6 -2.3) (2.9 -4) (0.9 -4));", polygon, 1e-13);
    // An L: concave
    check("{ type polygon; vertices ((0.7 -5) (3.1 -5) (3.1 -4) (1.7 -4) (1.7 -1) (0.7 -1));",
          (3.1 * 3.1 - 0.7 * 0.7) / 2 + (1.7 * 1.7 - 0.7 * 0.7) / 2 * 3, 1e-13);
    check("{ type circle; centre (2.2 -2.5); radius 0.8;", circle, 1e-5);
}

TEST(Seeding, cellsLeftWithoutPointsAreCounted)
{
    // The box reaches 0.05 into the column of cells from 1 to 1.5, short of their first points at 1.13, and
    // ends 1e-9 beyond the line z = 0: that is rounding.
    const auto box = [](const std::string& points) {
        return "{ type box; min (0 -6); max (1.05 1e-9); material sand; pointsPerCell " + points + "; }";
    };
    const Filled coarse = fill(domain(), box("(2 2)"));
    ASSERT_TRUE(coarse.problems.empty()) << coarse.problems[0];
    EXPECT_EQ(coarse.seeded.regions[0].emptyCells, 6u) << "rows below z = 0";
    EXPECT_EQ(fill(domain(), box("(10 2)")).seeded.regions[0].emptyCells, 0u);
    // A later region may fill what the first leaves.
    const Filled both = fill(domain(), box("(2 2)") + "{ type all; material clay; }");
    EXPECT_EQ(both.seeded.regions[0].emptyCells, 0u);
    EXPECT_EQ(both.seeded.regions[1].emptyCells, 0u);
}

TEST(Seeding, refinementsRaiseThePointsOfTheCellsInTheirBox)
{
    const Filled filled = fill(domain(), "{ type box; min (0 -6); max (4 0); material sand;"
                                         "  refinements ( { box ((0 -3) (4 -1.2)); maxSpacing (1 0.1); }"
                                         "                { box ((0.4 -6) (1 -4.5)); maxSpacing 0.2; } ); }");
    ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
    const BackgroundMesh mesh = domain();
    std::map<int, int> pointsOfCell;
    for (const int cell : filled.seeded.points.cell) {
        ++pointsOfCell[cell];
    }
    EXPECT_EQ(pointsOfCell[0], 4);
    EXPECT_EQ(pointsOfCell[1], 3 * 8) << "0.6/0.2 by 1.5/0.2";
    EXPECT_EQ(pointsOfCell[12], 2 * 10) << "1 m high";
    EXPECT_EQ(pointsOfCell[18], 2 * 8) << "0.8 m high";
    EXPECT_NEAR(total(filled.seeded.points.volume), 48, 1e-12);
}

TEST(Seeding, refinementsMaySayHowManyPointsACellHasAtLeast)
{
    const auto points = [](const std::string& region, bool triangles) {
        const Filled filled = fill(domain(triangles), region);
        EXPECT_TRUE(filled.problems.empty()) << filled.problems[0];
        std::map<int, int> ofCell;
        for (const int cell : filled.seeded.points.cell) {
            ++ofCell[cell];
        }
        return ofCell;
    };
    const auto quadrilaterals =
        points("{ type box; min (0 -6); max (4 0); material sand; pointsPerCell (2 3);"
               "  refinements ( { box ((0.4 -6) (1 -4.5)); pointsPerCell (4 2); } ); }",
               false);
    EXPECT_EQ(quadrilaterals.at(0), 2 * 3);
    EXPECT_EQ(quadrilaterals.at(1), 4 * 3) << "no fewer than elsewhere in either direction";
    const auto triangles = points(
        "{ type all; material sand; refinements ( { box ((0 -6) (1 -4.5)); pointsPerCell 12; } ); }", true);
    EXPECT_EQ(triangles.at(0), 12);
    EXPECT_EQ(triangles.rbegin()->second, 3);
}

TEST(Seeding, initialVelocitiesAreFunctionsOfRAndZ)
{
    const Filled filled =
        fill(domain(), "{ type all; material sand; velocity { r table ((0 0) (4 2)); z 0.3; } }");
    ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
    const MaterialPoints& points = filled.seeded.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        EXPECT_NEAR(points.vr[p], points.r[p] / 2, 1e-15);
        EXPECT_EQ(points.vz[p], 0.3);
    }
}

TEST(Seeding, everyMistakeIsAProblemWithItsLine)
{
    const auto expect = [](const std::string& region, const std::string& message, int line,
                           bool triangles = false) {
        const Filled filled = fill(domain(triangles), region);
        ASSERT_EQ(filled.problems.size(), 1u) << "expected only: " << message;
        EXPECT_NE(filled.problems[0].find(message), std::string::npos)
            << "expected " << message << ", got " << filled.problems[0];
        EXPECT_EQ(filled.where[0].file, "setMaterialPointsDict");
        EXPECT_EQ(filled.where[0].line, line) << message;
    };
    expect("{ type all;\n material snad; }", "there is no material 'snad'", 4);
    expect("{ type bocks; material sand; min (0 0); max (1 1); }", "unknown word 'bocks'", 3);
    expect("{ material sand; }", "missing key 'type'", 3);
    expect("{ type box; material sand;\n min (0 0); }", "missing key 'max'", 3);
    expect("{ type box; material sand; min (0 0 0);\n max (1 1); }", "3 numbers, not the two", 3);
    expect("{ type box; material sand; min (0 0);\n max (0 1); }", "no extent", 4);
    expect("{ type cellZone; material sand;\n name soil; }", "no cellZone 'soil'", 4);
    expect("{ type circle; centre (1 -1); material sand;\n radius 0; }", "radius 0 is outside", 4);
    expect("{ type polygon; material sand;\n vertices ((0 0) (1 -1)); }", "three vertices", 4);
    expect("{ type all; material sand;\n pointsPerCell 4; }", "quadrilaterals need two", 4);
    expect("{ type all; material sand;\n pointsPerCell (2 2); }", "triangles need 1, 3 or 6", 4, true);
    expect("{ type all; material sand;\n pointsPerCell 5; }", "triangles need 1, 3 or 6", 4, true);
    expect("{ type all; material sand; refinements ( { box ((0 0) (1 1));\n maxSpacing 0; } ); }",
           "positive numbers", 4);
    expect("{ type all; material sand; refinements (\n { box ((0 0) (1 1)); } ); }",
           "maxSpacing, pointsPerCell", 4);
    expect("{ type all; material sand; refinements ( { box ((0 0) (1 1));\n pointsPerCell 3; } ); }",
           "quadrilaterals need two", 4);
    expect("{ type box; material sand; min (5 -1); max (6 0); }", "meets no cell", 3);
    expect("{ type box; material sand; min (0 -1); max (0.001 -0.999); }", "smaller than the sub-cells", 3);
    expect("{ type box; material sand; min (1 -3); max (2 -1); }\n{ type all; material clay; }",
           "belongs to later regions", 3);
}

TEST(Seeding, noCellThatTheMotionBringsByRunsEmpty)
{
    const MeshMotion motion({-6, -1, -0.5, 0}, "caisson");
    std::vector<double> z = evenLines(-6, -1, 10);
    for (const double level : {-0.9, -0.8, -0.7, -0.6, -0.5, -0.4, -0.3, -0.2, -0.1, 0.0, 0.5}) {
        z.push_back(level);
    }
    BackgroundMesh mesh = structuredMesh({0, 0.4, 1}, z, Geometry::axisymmetric);
    const Filled filled =
        fill(mesh, "{ type box; min (0 -6); max (1 0); material sand; meshDisplacement -2; }", {}, motion);
    ASSERT_TRUE(filled.problems.empty()) << filled.problems[0];
    const MaterialPoints& points = filled.seeded.points;
    const std::vector<double> reference = mesh.z;
    for (int i = 0; i <= 40; ++i) {
        motion.place(mesh, reference, -0.05 * i);
        const CellLocator locator(mesh);
        std::vector<double> volume(mesh.cells(), 0);
        for (std::size_t p = 0; p < points.size(); ++p) {
            volume[locator.find(points.r[p], points.z[p])] += points.volume[p];
        }
        for (int cell = 0; cell < mesh.cells(); ++cell) {
            if (mesh.z[mesh.node(cell, 2)] <= 1e-9) {
                EXPECT_GT(volume[cell] / cellVolume(mesh, cell), 0.3)
                    << "cell " << cell << " at displacement " << -0.05 * i;
            }
        }
    }
}

TEST(Seeding, aDisplacementThatTheMeshCannotTakeIsAProblem)
{
    const std::string region = "{ type all; material sand; meshDisplacement -6; }";
    EXPECT_EQ(fill(domain(), region).problems.at(0), "the mesh of this case rests");
    EXPECT_EQ(fill(domain(), region, {}, MeshMotion({-6, -1, -0.5, 0}, "caisson")).problems.at(0),
              "the mesh cannot move as far");
}
