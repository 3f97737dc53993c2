#include "materialPoints/PointLoads.h"

#include "materialPoints/CloudConversion.h"
#include "materialPoints/Seeding.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

using namespace caisson;
using namespace caisson::testing;

namespace {

/// Messages of the problems that `read` finds.
template <class Read>
std::vector<std::string> messages(const Read& read)
{
    InputProblems problems;
    read(problems);
    std::vector<std::string> result;
    for (const InputProblem& problem : problems.all()) {
        result.push_back(problem.message + " | " + problem.hint);
    }
    return result;
}

std::vector<PointLoad> loadsOf(const std::string& text, Geometry geometry = Geometry::axisymmetric)
{
    InputProblems problems;
    auto loads = readPointLoads(parseDictionary(text, "constant/pointLoads"), geometry, problems);
    problems.throwIfAny("test loads");
    return loads;
}

/// A ring 1 < r < 2, 0 < z < 1 with room around it, filled with points.
struct Ring
{
    BackgroundMesh mesh;
    std::vector<Material> materials;
    MaterialPoints points;
    std::vector<LoadedPoints> loaded;
    std::vector<std::string> problems;

    explicit Ring(const std::string& surfaces, bool triangles = false,
                  Geometry geometry = Geometry::axisymmetric)
        : mesh(structuredMesh({0.5, 1, 1.3, 1.7, 2, 2.5}, {-0.5, 0, 0.4, 1, 1.5}, geometry, triangles))
    {
        InputProblems found;
        materials = readMaterials(
            parseDictionary("clay { law linearElastic; porosity 0.5; solidDensity 2700; youngsModulus 5e6; "
                            "poissonsRatio 0.4; }"),
            found);
        const auto list = [&](const std::string& text) {
            const Dictionary dictionary = parseDictionary("list (" + text + ");", "setMaterialPointsDict");
            return dictionariesIn(*dictionary.find("list"), found);
        };
        const auto regions = readSeedRegions(list("{ type box; min (1 0); max (2 1); material clay; }"), mesh,
                                             materials, found);
        points = seedPoints(mesh, regions, materials, {}, found).points;
        const std::vector<PointLoad> loads =
            loadsOf("push { type pressure; direction (1 0 0); uniformValue 5; }"
                    "weigh { type traction; uniformValue (0 0 -1); }");
        const auto read = readLoadedSurfaces(list(surfaces), mesh, loads, found);
        if (found.empty()) {
            loaded = loadPoints(points, mesh, read, found);
        }
        for (const InputProblem& problem : found.all()) {
            problems.push_back(problem.message + " | " + problem.hint);
        }
    }
};

} // namespace

TEST(PointLoads, areTractionsPressuresAndForcesOfTime)
{
    const auto loads = loadsOf("a { type traction; uniformValue table ((0 (0 0 0)) (2 (4 0 -8))); }"
                               "b { type pressure; direction (3 0 -4); uniformValue 10; areaFollows yes; }"
                               "c { type force; uniformValue (0 0 -100); }");
    ASSERT_EQ(loads.size(), 3);
    EXPECT_EQ(loads[0].traction(1, 7), (std::array<double, 2>{2, -4}));
    EXPECT_EQ(loads[1].traction(1, 7), (std::array<double, 2>{6, -8}));
    EXPECT_EQ(loads[2].traction(1, 8), (std::array<double, 2>{0, -12.5}));
    EXPECT_FALSE(loads[0].areaFollows);
    EXPECT_TRUE(loads[1].areaFollows);
}

TEST(PointLoads, wrongOnesAreNamed)
{
    const auto wrong = [](const std::string& text, Geometry geometry = Geometry::axisymmetric) {
        return messages([&](InputProblems& problems) {
            static_cast<void>(readPointLoads(parseDictionary(text), geometry, problems));
        });
    };
    EXPECT_EQ(wrong("a { type presure; uniformValue 1; }").at(0),
              "unknown word 'presure' for type of a load | did you mean 'pressure'?  valid types: expression "
              "force pressure "
              "traction");
    EXPECT_EQ(wrong("a { type pressure; direction (0 1 0); uniformValue 1; }").at(0),
              "the direction must lie in the plane of r and z | direction (1 0 0);");
    EXPECT_EQ(wrong("a { type pressure; direction (1 0 0); uniformValue 1; areaFollows yes; }",
                    Geometry::planeStrain)
                  .at(0),
              "areas do not grow with r in plane strain | areaFollows no;");
    EXPECT_EQ(wrong("a { type traction; }").at(0), "missing key 'uniformValue' in 'a' | ");
}

TEST(LoadedPoints, shareTheAreaOfTheirFaceExactly)
{
    for (const bool triangles : {false, true}) {
        const auto area = [&](const std::string& face) {
            const Ring ring("{ load push; type box; min (1 0); max (2 1); face " + face + "; }", triangles);
            EXPECT_EQ(ring.problems, std::vector<std::string>{});
            EXPECT_NEAR(ring.loaded.at(0).area,
                        std::accumulate(ring.points.loadArea.begin(), ring.points.loadArea.end(), 0.0),
                        1e-12);
            return ring.loaded.at(0).area;
        };
        EXPECT_NEAR(area("inner"), 1, 1e-12); // r dz, per radian
        EXPECT_NEAR(area("outer"), 2, 1e-12);
        EXPECT_NEAR(area("top"), 1.5, 1e-12); // r dr
        EXPECT_NEAR(area("bottom"), 1.5, 1e-12);
        EXPECT_NEAR(area("any"), 6, 1e-12);
        EXPECT_NEAR(area("all; area 12.566370614359172"), 2, 1e-12);
    }
    const Ring plane("{ load push; type all; face inner; }", false, Geometry::planeStrain);
    EXPECT_NEAR(plane.loaded.at(0).area, 1, 1e-12);
}

TEST(LoadedPoints, areTheOutermostRowAlone)
{
    const Ring ring("{ load weigh; type all; face top; }");
    ASSERT_EQ(ring.problems, std::vector<std::string>{});
    EXPECT_EQ(ring.loaded.at(0).points, 6); // three cells of 2 x 2
    for (std::size_t p = 0; p < ring.points.size(); ++p) {
        const bool topmost = ring.points.z[p] > 0.75;
        EXPECT_EQ(ring.points.load[p], topmost ? 1 : -1);
        if (topmost) { // half of a cell each, up to the places of the points
            const double width = ring.points.r[p] < 1.3 ? 0.15 : ring.points.r[p] < 1.7 ? 0.2 : 0.15;
            EXPECT_NEAR(ring.points.loadArea[p] / (width * ring.points.r[p]), 1, 0.02);
        }
    }
}

TEST(LoadedPoints, giveAForceWholeWhateverTheOrderOfThePoints)
{
    Ring ring(
        "{ load weigh; type all; face top; } { load push; type box; min (1 0); max (1.1 0.6); face inner; }");
    ASSERT_EQ(ring.problems, std::vector<std::string>{});
    const auto before = loadedAreas(ring.points, 2, Geometry::axisymmetric);
    EXPECT_NEAR(before[1], 2 * std::numbers::pi * 1.5, 1e-12);
    EXPECT_NEAR(before[0], 2 * std::numbers::pi * 0.7, 1e-12); // the rows up to z = 0.7
    std::vector<int> order(ring.points.size());
    std::iota(order.rbegin(), order.rend(), 0);
    ring.points.reorder(order);
    EXPECT_EQ(loadedAreas(ring.points, 2, Geometry::axisymmetric), before);
}

TEST(LoadedPoints, comeBackFromACloud)
{
    const Ring ring("{ load weigh; type all; face top; }");
    const std::vector<std::string> names(ring.points.state.size());
    const MaterialPoints back = materialPoints(cloud(ring.points, names), names);
    EXPECT_EQ(back.load, ring.points.load);
    EXPECT_EQ(back.loadArea, ring.points.loadArea);
    EXPECT_FALSE(materialPoints(cloud(MaterialPoints{}, {}), {}).loaded());
}

TEST(LoadedPoints, wrongOnesAreNamed)
{
    EXPECT_EQ(
        Ring("{ load pusch; type all; }").problems.at(0),
        "there is no load 'pusch' in constant/pointLoads | did you mean 'push'?  valid loads: push weigh");
    EXPECT_EQ(
        Ring("{ load push; type box; min (2 0); max (3 1); }").problems.at(0),
        "there is no material point in the region of loadedPoints | give a region that the regions above "
        "fill");
    EXPECT_EQ(
        Ring("{ load push; type box; min (1.3 0); max (1.7 0.4); face inner; }").problems.at(0),
        "none of the 4 points in the region of loadedPoints is on a surface of the soil that looks to the "
        "face | the outermost points of the soil must lie in the region");
    EXPECT_EQ(Ring("{ load push; type all; face top; } { load weigh; type all; face outer; }").problems.at(0),
              "1 points have a load already | a point carries one load: let the regions of loadedPoints not "
              "overlap");
    EXPECT_EQ(Ring("{ load push; type all; face all; }").problems.at(0),
              "face all needs the 'area' that the points of the region share | area 1; where only a force is "
              "shared out");
    EXPECT_NE(Ring("{ load push; type all; fase top; }").problems.at(0).find("'fase'"), std::string::npos);
}
