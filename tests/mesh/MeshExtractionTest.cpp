#include "LayerMesh.h"
#include "support/StructuredMesh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>
#include <set>

using namespace caisson;
using namespace caisson::testing;

namespace {

const std::vector<std::string> rectangleNames = {"left", "right", "bottom", "top"};
const std::vector<double> gradedR = {0, 0.11, 0.3, 0.72, 1.5};
const std::vector<double> gradedZ = {-2, -1.1, -0.4, -0.13, 0, 0.25};

PolyMesh gradedLayer(Geometry geometry, bool triangles, double firstR = 0)
{
    std::vector<double> r = gradedR;
    r[0] = firstR;
    const BackgroundMesh flat = structuredMesh(r, gradedZ, geometry, triangles);
    return layerMesh(flat, rectangleNames, rectanglePatches(firstR, 1.5, -2, 0.25));
}

BackgroundMesh extract(const PolyMesh& poly)
{
    InputProblems problems;
    BackgroundMesh mesh = buildBackgroundMesh(poly, problems);
    problems.throwIfAny("the mesh");
    return mesh;
}

/// The only problem of a mesh that must have one.
InputProblem problemOf(const PolyMesh& poly)
{
    InputProblems problems;
    buildBackgroundMesh(poly, problems);
    if (problems.all().size() != 1) {
        ADD_FAILURE() << "expected one problem, got " << problems.all().size();
        return {};
    }
    return problems.all()[0];
}

void expectMentions(const std::string& text, const std::string& part)
{
    EXPECT_NE(text.find(part), std::string::npos) << "expected to read '" << part << "' in: " << text;
}

void rotate(PolyMesh& poly, const Eigen::Matrix3d& rotation)
{
    for (auto& point : poly.points) {
        Eigen::Vector3d::Map(point.data()) = rotation * Eigen::Vector3d::Map(point.data());
    }
}

/// Does to the points what the transformPoints commands of a hint do.
void obey(PolyMesh& poly, const std::string& hint)
{
    const std::string number = R"(([-+.e0-9]+))";
    const std::string vector = R"(\()" + number + " " + number + " " + number + R"(\))";
    const std::regex command("-rotate '\\(" + vector + " " + vector + "\\)'|-rotate-angle '\\(" + vector +
                             " " + number + "\\)'");
    for (std::sregex_iterator match(hint.begin(), hint.end(), command), end; match != end; ++match) {
        const auto value = [&](int i) { return std::stod((*match)[i].str()); };
        if ((*match)[1].matched) {
            const Eigen::Vector3d from(value(1), value(2), value(3)), to(value(4), value(5), value(6));
            rotate(poly, Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix());
        } else {
            const Eigen::Vector3d axis(value(7), value(8), value(9));
            rotate(poly, Eigen::AngleAxisd(value(10) * M_PI / 180, axis).toRotationMatrix());
        }
    }
}

class Layers : public ::testing::TestWithParam<std::tuple<Geometry, bool>>
{
protected:
    const Geometry geometry = std::get<0>(GetParam());
    const bool triangles = std::get<1>(GetParam());
};

} // namespace

TEST_P(Layers, extractionGivesBackTheMeshThatTheLayerWasMadeOf)
{
    const BackgroundMesh flat = structuredMesh(gradedR, gradedZ, geometry, triangles);
    const BackgroundMesh mesh = extract(gradedLayer(geometry, triangles));
    ASSERT_EQ(mesh.geometry, geometry);
    ASSERT_EQ(mesh.corners, flat.corners);
    ASSERT_EQ(mesh.nodes(), flat.nodes());
    ASSERT_EQ(mesh.cells(), flat.cells());
    for (int i = 0; i < mesh.nodes(); ++i) {
        EXPECT_NEAR(mesh.r[i], flat.r[i], 1e-15) << "node " << i << ": one rounding of cos and hypot";
        EXPECT_EQ(mesh.z[i], flat.z[i]) << "node " << i;
    }
    EXPECT_EQ(mesh.cellNodes.size(), flat.cellNodes.size());
    for (int c = 0; c < mesh.cells(); ++c) {
        std::set<int> expected, got;
        for (int k = 0; k < mesh.corners; ++k) {
            expected.insert(flat.node(c, k));
            got.insert(mesh.node(c, k));
        }
        EXPECT_EQ(got, expected) << "corners of cell " << c;
        EXPECT_GT(cellArea(mesh, c), 0) << "cell " << c << " must run counter-clockwise";
        if (!triangles) {
            EXPECT_EQ(mesh.node(c, 0), flat.node(c, 0))
                << "corner 0 of cell " << c << " is the lower left one";
        }
    }
}

TEST_P(Layers, neighboursAndBoundaryEdgesCoverEverySideOnce)
{
    const BackgroundMesh mesh = extract(gradedLayer(geometry, triangles));
    std::map<std::pair<int, int>, std::string> patchOf;
    for (const BoundaryPatch& patch : mesh.patches) {
        for (const BoundaryEdge& edge : patch.edges) {
            EXPECT_EQ(edge.node[0], mesh.node(edge.cell, edge.side));
            EXPECT_EQ(edge.node[1], mesh.node(edge.cell, (edge.side + 1) % mesh.corners));
            EXPECT_TRUE(patchOf.emplace(std::pair(edge.cell, edge.side), patch.name).second);
        }
    }
    int axisSides = 0;
    for (int c = 0; c < mesh.cells(); ++c) {
        for (int k = 0; k < mesh.corners; ++k) {
            const int other = mesh.neighbour[c * mesh.corners + k];
            if (other >= 0) {
                const int* back = &mesh.neighbour[other * mesh.corners];
                EXPECT_EQ(std::count(back, back + mesh.corners, c), 1) << "cell " << other << " knows " << c;
                EXPECT_FALSE(patchOf.contains({c, k}));
            } else if (!patchOf.contains({c, k})) {
                EXPECT_EQ(mesh.r[mesh.node(c, k)], 0);
                EXPECT_EQ(mesh.r[mesh.node(c, (k + 1) % mesh.corners)], 0);
                ++axisSides;
            }
        }
    }
    EXPECT_EQ(axisSides, geometry == Geometry::axisymmetric ? 5 : 0)
        << "sides on the axis belong to no patch";
    ASSERT_EQ(mesh.patches.size(), 6u);
    for (const auto& [name, edges] :
         std::map<std::string, std::size_t>{{"left", geometry == Geometry::axisymmetric ? 0 : 5},
                                            {"right", 5},
                                            {"bottom", 4},
                                            {"top", 4},
                                            {"front", 0},
                                            {"back", 0}}) {
        const auto found = std::ranges::find(mesh.patches, name, &BoundaryPatch::name);
        ASSERT_NE(found, mesh.patches.end());
        EXPECT_EQ(found->edges.size(), edges) << name;
    }
}

TEST_P(Layers, nodeCellsListEveryCornerOfEveryNodeInOrder)
{
    const BackgroundMesh mesh = extract(gradedLayer(geometry, triangles));
    std::vector<int> seen;
    for (int i = 0; i < mesh.nodes(); ++i) {
        for (int k = mesh.nodeCells.start[i]; k < mesh.nodeCells.start[i + 1]; ++k) {
            EXPECT_EQ(mesh.cellNodes[mesh.nodeCells.item[k]], i);
            EXPECT_TRUE(k == mesh.nodeCells.start[i] || mesh.nodeCells.item[k - 1] < mesh.nodeCells.item[k]);
            seen.push_back(mesh.nodeCells.item[k]);
        }
    }
    EXPECT_EQ(seen.size(), mesh.cellNodes.size());
}

TEST_P(Layers, polyMeshPointsAreThoseThatTheMeshWasTakenFrom)
{
    PolyMesh poly = gradedLayer(geometry, triangles);
    if (geometry == Geometry::planeStrain) {
        for (auto& point : poly.points) {
            point[1] += 3; // a slab need not lie symmetric about y = 0
        }
    }
    const auto points = polyMeshPoints(extract(poly));
    ASSERT_EQ(points.size(), poly.points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(points[p][k], poly.points[p][k], 1e-15 * 8) << "a few roundings; point " << p;
        }
    }
}

TEST_P(Layers, orderOfTheCornersInFacesDoesNotMatter)
{
    PolyMesh poly = gradedLayer(geometry, triangles);
    const BackgroundMesh expected = extract(poly);
    std::mt19937 random(7);
    for (auto& face : poly.faces) {
        std::rotate(face.begin(), face.begin() + static_cast<int>(random() % face.size()), face.end());
    }
    const BackgroundMesh got = extract(poly);
    EXPECT_EQ(got.neighbour.size(), expected.neighbour.size());
    for (int c = 0; c < got.cells(); ++c) {
        EXPECT_DOUBLE_EQ(cellVolume(got, c), cellVolume(expected, c));
        if (!triangles) {
            EXPECT_EQ(got.node(c, 0), expected.node(c, 0));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(allKinds, Layers,
                         ::testing::Combine(::testing::Values(Geometry::axisymmetric, Geometry::planeStrain),
                                            ::testing::Bool()));

TEST(MeshExtraction, wedgeWithoutAnAxisKeepsItsInnerPatch)
{
    const BackgroundMesh mesh = extract(gradedLayer(Geometry::axisymmetric, false, 0.05));
    EXPECT_EQ(mesh.patches[0].name, "left");
    EXPECT_EQ(mesh.patches[0].edges.size(), 5u);
}

TEST(MeshExtraction, hintsOnOrientationPutTheMeshRight)
{
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                          z = Eigen::Vector3d::UnitZ();
    const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
        return Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()).toRotationMatrix();
    };
    const std::vector<Eigen::Matrix3d> turns = {turn(-90, x),        turn(90, y), turn(2.5, z),
                                                turn(180, z),        turn(90, z), turn(90, x),
                                                turn(90, y + z + x), turn(30, x), turn(33, x + 2 * y - z)};
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        for (std::size_t i = 0; i < turns.size(); ++i) {
            if (geometry == Geometry::planeStrain && (i == 1 || i == 3)) {
                continue; // a slab turned about its normal, or turned round, is as good as before
            }
            PolyMesh poly = gradedLayer(geometry, false);
            rotate(poly, turns[i]);
            const InputProblem problem = problemOf(poly);
            EXPECT_EQ(problem.where.file, "constant/polyMesh/boundary");
            expectMentions(problem.hint, "transformPoints -rotate");
            obey(poly, problem.hint);
            InputProblems left;
            buildBackgroundMesh(poly, left);
            EXPECT_TRUE(left.empty()) << "turn " << i << ": after '" << problem.hint << "' there is still "
                                      << (left.empty() ? "" : left.all()[0].message);
        }
    }
}

TEST(MeshExtraction, slabDrawnInXYIsRotatedSoThatItsYBecomesZ)
{
    PolyMesh poly = gradedLayer(Geometry::planeStrain, false);
    for (auto& [px, py, pz] : poly.points) {
        std::swap(py, pz); // x right, y up
        pz = -pz;
    }
    expectMentions(problemOf(poly).hint, "transformPoints -rotate '((0 1 0) (0 0 1))'");
}

TEST(MeshExtraction, severalLayersAreRefused)
{
    // Two slabs on top of each other in y: the faces between them are internal.
    PolyMesh one = gradedLayer(Geometry::planeStrain, false);
    PolyMesh two = one;
    const auto points = static_cast<int>(one.points.size());
    const int cells = 20;
    for (auto& point : two.points) {
        point[1] += 1;
    }
    one.points.insert(one.points.end(), two.points.begin(), two.points.end());
    for (auto& face : two.faces) {
        for (int& p : face) {
            p += points;
        }
    }
    for (int& owner : two.owner) {
        owner += cells;
    }
    // The back faces of the first and the front faces of the second are left out of the empty patches.
    PolyMesh both = one;
    both.neighbour.clear();
    both.faces.clear();
    both.owner.clear();
    both.patches = {{"frontAndBack", "empty", 0, 2 * cells}, {"rest", "patch", 2 * cells, 2 * cells}};
    for (const auto& [mesh, plane] : {std::pair(&one, 4), {&two, 5}, {&one, 5}, {&two, 4}}) {
        for (int f = mesh->patches[plane].startFace; f < mesh->patches[plane].startFace + cells; ++f) {
            both.faces.push_back(mesh->faces[f]);
            both.owner.push_back(mesh->owner[f]);
        }
    }
    const InputProblem problem = problemOf(both);
    expectMentions(problem.message, "several layers");
    expectMentions(problem.message, "40 of 40 cells");
    expectMentions(problem.hint, "one cell in the direction of y");
}

TEST(MeshExtraction, wrongPatchTypesAreNamed)
{
    PolyMesh poly = gradedLayer(Geometry::planeStrain, false);
    poly.patches[4].type = poly.patches[5].type = "patch";
    expectMentions(problemOf(poly).message, "neither wedge nor empty");
    poly.patches[4].type = "empty";
    expectMentions(problemOf(poly).message, "same side");
    poly.patches[4].type = poly.patches[5].type = "wedge";
    expectMentions(problemOf(poly).hint, "type empty");
    poly.patches[4].type = "empty";
    expectMentions(problemOf(poly).message, "type wedge and on patches of type empty");

    poly = gradedLayer(Geometry::axisymmetric, false);
    poly.patches[4].type = poly.patches[5].type = "empty";
    expectMentions(problemOf(poly).hint, "type wedge");
}

TEST(MeshExtraction, wedgeBesideTheZAxisIsRefused)
{
    PolyMesh poly = gradedLayer(Geometry::axisymmetric, false);
    for (auto& point : poly.points) {
        point[0] += 0.2;
    }
    const InputProblem problem = problemOf(poly);
    expectMentions(problem.message, "must meet in the z axis");
    expectMentions(problem.hint, "transformPoints -translate");
}

TEST(MeshExtraction, mixedPolygonalAndConcaveCellsAreRefused)
{
    BackgroundMesh flat;
    flat.geometry = Geometry::planeStrain;
    flat.halfThickness = 0.5;
    flat.r = {0, 1, 1, 0.5, 0};
    flat.z = {0, 0, 1, 1, 1};
    flat.corners = 5;
    flat.cellNodes = {0, 1, 2, 3, 4};
    const auto wall = [](double, double) { return "wall"; };
    expectMentions(problemOf(layerMesh(flat, {"wall"}, wall)).message, "more than four corners");

    PolyMesh mixed = gradedLayer(Geometry::planeStrain, false);
    const int front = mixed.patches[4].startFace;
    mixed.faces[front].pop_back();
    expectMentions(problemOf(mixed).message, "mixes 1 triangles and 19 quadrilaterals");

    flat.corners = 4;
    flat.r = {0, 1, 0.2, 0};
    flat.z = {0, 0, 0.2, 1};
    flat.cellNodes = {0, 1, 2, 3};
    expectMentions(problemOf(layerMesh(flat, {"wall"}, wall)).message, "not convex");
}

TEST(MeshExtraction, blockMeshWedgeHasItsExactVolumeAndZones)
{
    const BackgroundMesh mesh =
        extract(readPolyMesh(std::string(CAISSON_SOURCE_DIR) + "/tests/case/data/wedge/ascii"));
    double area = 0, volume = 0, radius = 0, low = 0, high = 0;
    for (int c = 0; c < mesh.cells(); ++c) {
        area += cellArea(mesh, c);
        volume += cellVolume(mesh, c);
    }
    for (int i = 0; i < mesh.nodes(); ++i) {
        radius = std::max(radius, mesh.r[i]);
        low = std::min(low, mesh.z[i]);
        high = std::max(high, mesh.z[i]);
    }
    EXPECT_NEAR(area, radius * (high - low), 1e-14 * area);
    EXPECT_NEAR(volume, radius * radius / 2 * (high - low), 1e-14 * volume);
    ASSERT_EQ(mesh.cellZones.count("soil"), 1u);
    EXPECT_EQ(mesh.cellZones.at("soil"), (std::vector<int>{0, 1, 2, 3}));
}
