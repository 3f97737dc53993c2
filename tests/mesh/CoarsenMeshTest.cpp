#include "mesh/CoarsenMesh.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace caisson;
using namespace caisson::testing;

namespace {

/// Lines from a to b, each row `growth` times as long as the one before; lines added to those given.
std::vector<double> grown(std::vector<double> lines, double to, int n, double growth)
{
    const double from = lines.back();
    const double first = (to - from) * (growth - 1) / (std::pow(growth, n) - 1);
    for (int i = 1; i <= n; ++i) {
        lines.push_back(i == n ? to : from + first * (std::pow(growth, i) - 1) / (growth - 1));
    }
    return lines;
}

/// A small caisson's mesh: fine columns about r = 2.5, fine rows about z = -0.5, surface at z = 0.
const std::vector<double> caissonR = [] {
    const std::vector<double> towardsAxis = grown({0}, 2.4, 10, 1 / 1.4);
    return grown(grown(towardsAxis, 2.6, 8, 1.000001), 15, 16, 1.35);
}();
const std::vector<double> caissonZ = [] {
    std::vector<double> z = grown({-20}, -0.8, 24, 1 / 1.2);
    z = grown(z, -0.35, 18, 1.000001);
    return grown(grown(z, 0, 14, 1.000001), 1, 5, 1.3);
}();
const MeshMotionHeights levels = {-6, -0.8, -0.35, 0};

Coarsening caissonWish()
{
    Coarsening wish;
    wish.rowsMergeOutside = {2.4, 2.6};
    wish.columnsMergeBelow = -3;
    wish.keptLevels = {0};
    wish.motion = MeshMotion(levels, "caisson");
    wish.displacements = {-1.3, 0};
    return wish;
}

PolyMesh caissonLayer(Geometry geometry) { return layerOf(structuredMesh(caissonR, caissonZ, geometry)); }

BackgroundMesh extract(const PolyMesh& poly)
{
    InputProblems problems;
    BackgroundMesh mesh = buildBackgroundMesh(poly, problems);
    problems.throwIfAny("the mesh");
    return mesh;
}

/// The coarsened mesh as the solver reads it, which refuses what does not conform or is not convex.
BackgroundMesh coarse(const PolyMesh& fine, const Coarsening& wish)
{
    InputProblems problems;
    const PolyMesh poly = coarsened(fine, wish, problems);
    problems.throwIfAny("the mesh");
    return extract(poly);
}

std::string problemsOf(const PolyMesh& fine, const Coarsening& wish)
{
    InputProblems problems;
    coarsened(fine, wish, problems);
    std::string all;
    for (const InputProblem& problem : problems.all()) {
        all += problem.message + " | " + problem.hint + "; ";
    }
    return all;
}

double volume(const BackgroundMesh& mesh)
{
    double sum = 0;
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        sum += cellVolume(mesh, cell);
    }
    return sum;
}

/// Area of a patch per radian or per metre.
double area(const BackgroundMesh& mesh, const BoundaryPatch& patch)
{
    double sum = 0;
    for (const auto& [node, cell, side] : patch.edges) {
        const double length =
            std::hypot(mesh.r[node[1]] - mesh.r[node[0]], mesh.z[node[1]] - mesh.z[node[0]]);
        sum +=
            length * (mesh.geometry == Geometry::axisymmetric ? (mesh.r[node[0]] + mesh.r[node[1]]) / 2 : 1);
    }
    return sum;
}

std::array<double, 2> extent(const BackgroundMesh& mesh, int cell, const std::vector<double>& of)
{
    double low = of[mesh.node(cell, 0)], high = low;
    for (int k = 1; k < mesh.corners; ++k) {
        low = std::min(low, of[mesh.node(cell, k)]);
        high = std::max(high, of[mesh.node(cell, k)]);
    }
    return {low, high};
}

/// Sine of the sharpest corner; negative where a cell is not convex.
double leastSine(const BackgroundMesh& mesh)
{
    double least = 1;
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        for (int k = 0; k < 4; ++k) {
            const int a = mesh.node(cell, k), b = mesh.node(cell, (k + 1) % 4),
                      c = mesh.node(cell, (k + 2) % 4);
            const double r1 = mesh.r[b] - mesh.r[a], z1 = mesh.z[b] - mesh.z[a];
            const double r2 = mesh.r[c] - mesh.r[b], z2 = mesh.z[c] - mesh.z[b];
            least = std::min(least, (r1 * z2 - z1 * r2) / (std::hypot(r1, z1) * std::hypot(r2, z2)));
        }
    }
    return least;
}

std::vector<double> edgeLengths(const BackgroundMesh& mesh, const std::string& patch)
{
    std::vector<double> lengths;
    for (const auto& [node, cell, side] :
         std::ranges::find(mesh.patches, patch, &BoundaryPatch::name)->edges) {
        lengths.push_back(std::hypot(mesh.r[node[1]] - mesh.r[node[0]], mesh.z[node[1]] - mesh.z[node[0]]));
    }
    return lengths;
}

} // namespace

TEST(CoarsenMesh, fourCellsLeadFromThreeRowsToOne)
{
    const PolyMesh fine =
        layerOf(structuredMesh(evenLines(0, 4, 4), evenLines(0, 0.9, 3), Geometry::planeStrain));
    Coarsening wish;
    wish.rowsMergeOutside = {0, 1};
    const BackgroundMesh mesh = coarse(fine, wish);
    EXPECT_EQ(mesh.cells(), 3 + 4 + 1 + 1);
    std::map<std::pair<double, double>, int> inner;
    for (int i = 0; i < mesh.nodes(); ++i) {
        if (mesh.r[i] == 1.5) {
            ++inner[{mesh.r[i], mesh.z[i]}];
        }
    }
    const double lower = evenLines(0, 0.9, 3)[1], upper = evenLines(0, 0.9, 3)[2];
    EXPECT_EQ(inner, (std::map<std::pair<double, double>, int>{{{1.5, lower}, 1}, {{1.5, upper}, 1}}));
}

TEST(CoarsenMesh, rowsMergeAgainAndAgainOnBothSides)
{
    const PolyMesh fine =
        layerOf(structuredMesh(evenLines(-10, 10, 20), evenLines(0, 0.81, 27), Geometry::planeStrain));
    Coarsening wish;
    wish.rowsMergeOutside = {-1, 1};
    const BackgroundMesh mesh = coarse(fine, wish);
    for (const char* side : {"left", "right"}) {
        const std::vector<double> lengths = edgeLengths(mesh, side);
        ASSERT_EQ(lengths.size(), 1U) << "27 rows became 9, 3 and 1";
        EXPECT_NEAR(lengths[0], 0.81, 1e-15);
    }
    // 2 columns of 27; on each side transitions 9 * 4, 3 * 4 and 4, and 6 columns of one row
    EXPECT_EQ(mesh.cells(), 2 * 27 + 2 * (36 + 12 + 4 + 6));
}

TEST(CoarsenMesh, columnsMergeDownwards)
{
    const PolyMesh fine =
        layerOf(structuredMesh(evenLines(0, 0.9, 9), evenLines(-5, 0, 5), Geometry::axisymmetric));
    Coarsening wish;
    wish.columnsMergeBelow = -1;
    const BackgroundMesh mesh = coarse(fine, wish);
    EXPECT_EQ(mesh.cells(), 9 + 3 * 4 + 4 + 1 + 1);
    EXPECT_EQ(edgeLengths(mesh, "bottom").size(), 1U);
    EXPECT_EQ(edgeLengths(mesh, "top").size(), 9U);
}

TEST(CoarsenMesh, volumeAndAreasOfPatchesStay)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        const PolyMesh layer = caissonLayer(geometry);
        const BackgroundMesh fine = extract(layer);
        const BackgroundMesh mesh = coarse(layer, caissonWish());
        EXPECT_LT(mesh.cells(), 0.75 * fine.cells()) << "cells are fewer, or this test tests nothing";
        EXPECT_NEAR(volume(mesh) / volume(fine), 1, 1e-12);
        ASSERT_EQ(mesh.patches.size(), fine.patches.size());
        for (std::size_t i = 0; i < fine.patches.size(); ++i) {
            EXPECT_EQ(mesh.patches[i].name, fine.patches[i].name);
            EXPECT_EQ(mesh.patches[i].type, fine.patches[i].type);
            EXPECT_NEAR(area(mesh, mesh.patches[i]), area(fine, fine.patches[i]),
                        1e-12 * area(fine, fine.patches[i]))
                << fine.patches[i].name;
        }
        EXPECT_EQ(mesh.wedgeHalfAngle, fine.wedgeHalfAngle);
        EXPECT_EQ(mesh.halfThickness, fine.halfThickness);
    }
}

TEST(CoarsenMesh, everyInnerFaceHasTwoCellsInTheOrderOfOpenFoam)
{
    InputProblems problems;
    const PolyMesh poly = coarsened(caissonLayer(Geometry::axisymmetric), caissonWish(), problems);
    ASSERT_TRUE(problems.empty());
    std::array<int, 2> last = {-1, -1};
    for (std::size_t f = 0; f < poly.neighbour.size(); ++f) {
        const std::array<int, 2> cells = {poly.owner[f], poly.neighbour[f]};
        EXPECT_LT(cells[0], cells[1]);
        EXPECT_LT(last, cells) << "face " << f;
        last = cells;
    }
    // Each point of an edge of a cell lies in a corner of the cell across: nothing hangs.
    const BackgroundMesh mesh = extract(poly);
    std::size_t boundary = 0, alone = 0;
    for (const BoundaryPatch& patch : mesh.patches) {
        boundary += patch.edges.size();
    }
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        for (int k = 0; k < 4; ++k) {
            const bool onAxis = mesh.r[mesh.node(cell, k)] == 0 && mesh.r[mesh.node(cell, (k + 1) % 4)] == 0;
            alone += mesh.neighbour[4 * cell + k] < 0 && !onAxis ? 1 : 0;
        }
    }
    EXPECT_EQ(alone, boundary);
}

TEST(CoarsenMesh, cellsStayConvexOverTheWholeMotion)
{
    const Coarsening wish = caissonWish();
    BackgroundMesh mesh = coarse(caissonLayer(Geometry::axisymmetric), wish);
    const std::vector<double> reference = mesh.z;
    const DisplacementRange range = wish.motion.allowedDisplacements();
    for (int i = 0; i <= 20; ++i) {
        const double displacement = range.lowest + i * (range.highest - range.lowest) / 20;
        wish.motion.place(mesh, reference, displacement);
        EXPECT_GT(leastSine(mesh), 0) << "displacement " << displacement;
    }
}

TEST(CoarsenMesh, noCellReachesAcrossAKeptLevel)
{
    const BackgroundMesh mesh = coarse(caissonLayer(Geometry::axisymmetric), caissonWish());
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        const auto [low, high] = extent(mesh, cell, mesh.z);
        for (const double level : {-0.8, -0.35, 0.0}) {
            EXPECT_FALSE(low < level - 1e-9 && high > level + 1e-9) << level << ": " << low << " to " << high;
        }
    }
}

TEST(CoarsenMesh, aRowWithAKinkOfTheMotionStaysAsItIs)
{
    Coarsening wish;
    wish.rowsMergeOutside = {0, 1};
    wish.motion = MeshMotion({0.35, 1.2, 1.5, 1.8}, "caisson"); // 0.35 lies within the row from 0.3 to 0.4
    const PolyMesh fine =
        layerOf(structuredMesh(evenLines(0, 9, 9), evenLines(0, 1.8, 18), Geometry::planeStrain));
    const BackgroundMesh mesh = coarse(fine, wish);
    // 3 rows to 0.3, the one with the kink, 8 to 1.2 (first 3 + 3 + 1 + 1, then 3 + 5), 3 and 3
    EXPECT_EQ(edgeLengths(mesh, "right").size(), 1U + 1 + 2 + 1 + 1);
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        const auto [low, high] = extent(mesh, cell, mesh.z);
        EXPECT_FALSE(low < 0.35 && high > 0.35 && high - low > 0.1 + 1e-12) << low << " to " << high;
    }
}

TEST(CoarsenMesh, rowsThatWillBeStretchedCountWithTheirGreatestHeight)
{
    Coarsening wish;
    wish.rowsMergeOutside = {0, 1};
    wish.motion = MeshMotion({0, 0.9, 1.8, 2.7}, "caisson");
    wish.displacements = {-0.45, 0}; // stretches the rows on top by a half
    const PolyMesh fine =
        layerOf(structuredMesh(evenLines(0, 9, 9), evenLines(0, 2.7, 27), Geometry::planeStrain));
    // Rows of 0.1 m, 0.15 m on top; with 1/7 m as the limit, those on top stay.
    wish.aspectRatio = 7;
    EXPECT_EQ(edgeLengths(coarse(fine, wish), "right").size(), 3U + 3 + 9);
}

TEST(CoarsenMesh, zonesAndDividedPatchesKeepTheirExtent)
{
    BackgroundMesh flat = structuredMesh(caissonR, caissonZ, Geometry::axisymmetric);
    for (int cell = 0; cell < flat.cells(); ++cell) {
        const auto [low, high] = extent(flat, cell, flat.z);
        flat.cellZones[high < caissonZ[20] + 1e-9 ? "clay" : "sand"].push_back(cell);
    }
    flat.patches.push_back({"drain", "wall", {}}); // the lowest five sides of right
    auto& right = flat.patches[1].edges;
    flat.patches.back().edges.assign(right.begin(), right.begin() + 5);
    right.erase(right.begin(), right.begin() + 5);

    const PolyMesh layer = layerOf(flat);
    const BackgroundMesh fine = extract(layer);
    const BackgroundMesh mesh = coarse(layer, caissonWish());
    for (std::size_t i = 0; i < fine.patches.size(); ++i) {
        EXPECT_NEAR(area(mesh, mesh.patches[i]), area(fine, fine.patches[i]), 1e-10) << fine.patches[i].name;
    }
    for (const auto& [name, cells] : fine.cellZones) {
        double before = 0, after = 0;
        for (const int cell : cells) {
            before += cellVolume(fine, cell);
        }
        for (const int cell : mesh.cellZones.at(name)) {
            after += cellVolume(mesh, cell);
        }
        EXPECT_NEAR(after / before, 1, 1e-12) << name;
    }
}

TEST(CoarsenMesh, whatIsNoGridOfRectanglesIsRefused)
{
    const auto refused = [](const PolyMesh& poly, const char* part) {
        const std::string problems = problemsOf(poly, caissonWish());
        EXPECT_NE(problems.find(part), std::string::npos) << part << " is not in: " << problems;
        EXPECT_NE(problems.find("run blockMesh again first"), std::string::npos) << problems;
    };
    refused(layerOf(structuredMesh(caissonR, caissonZ, Geometry::planeStrain, true)), "are triangles");
    BackgroundMesh skew = structuredMesh(evenLines(0, 1, 3), evenLines(-1, 0, 3), Geometry::planeStrain);
    skew.r[5] += 0.01;
    refused(layerOf(skew), "are no grid");
    InputProblems problems;
    refused(coarsened(caissonLayer(Geometry::axisymmetric), caissonWish(), problems), "are no grid");
}

TEST(CoarsenMesh, aKeptLevelMustBeALineOfTheMesh)
{
    Coarsening wish = caissonWish();
    wish.keptLevels = {0.01};
    EXPECT_EQ(problemsOf(caissonLayer(Geometry::axisymmetric), wish),
              "the mesh has no line at z = 0.01 | the nearest is at 0; ");
}

TEST(CoarsenMesh, isReadFromCoarsenMeshDict)
{
    InputProblems problems;
    const Dictionary dictionary = parseDictionary(
        "rowsMergeOutside (2.2 2.75); columnsMergeBelow -3; keepLevels (0 -4.5); meshDisplacement -1.3;",
        "system/coarsenMeshDict");
    const Coarsening wish = readCoarsening(dictionary, MeshMotion(levels, "caisson"), problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(wish.aspectRatio, 2);
    EXPECT_EQ(wish.rowsMergeOutside, (std::array<double, 2>{2.2, 2.75}));
    EXPECT_EQ(wish.columnsMergeBelow, -3);
    EXPECT_EQ(wish.keptLevels, (std::vector<double>{0, -4.5}));
    EXPECT_EQ(wish.displacements.lowest, -1.3);
    EXPECT_EQ(wish.displacements.highest, 0);
}

TEST(CoarsenMesh, everyMistakeInCoarsenMeshDictIsAProblem)
{
    const auto messages = [](const std::string& text, const MeshMotion& motion = {}) {
        InputProblems problems;
        const Dictionary dictionary = parseDictionary(text, "system/coarsenMeshDict");
        readCoarsening(dictionary, motion, problems);
        std::string all;
        for (const InputProblem& problem : problems.all()) {
            all += problem.message + "; ";
        }
        return all;
    };
    EXPECT_EQ(messages(""), "nothing would merge; ");
    EXPECT_EQ(messages("rowsMergeOutside (3 2);"),
              "rowsMergeOutside needs two radii, the smaller one first; ");
    EXPECT_EQ(messages("columnsMergeBelow -3; aspectRatio 0.5;"), "aspectRatio 0.5 is outside [1, inf); ");
    EXPECT_EQ(messages("columnsMergeBelow -3; meshDisplacement -1;"), "the mesh of this case rests; ");
    EXPECT_EQ(messages("columnsMergeBelow -3; meshDisplacement -6;", MeshMotion(levels, "caisson")),
              "the mesh cannot move as far; ");
    EXPECT_EQ(messages("columnsMergeBelow -3; keepLevel (0);"),
              "unknown key 'keepLevel' in coarsenMeshDict; ");
}
