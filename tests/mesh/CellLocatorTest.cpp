#include "mesh/CellLocator.h"

#include "LayerMesh.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace caisson;
using namespace caisson::testing;

namespace {

constexpr int places = 100000;

bool holds(const BackgroundMesh& mesh, int cell, double r, double z)
{
    for (int k = 0; k < mesh.corners; ++k) {
        const int a = mesh.node(cell, k);
        const int b = mesh.node(cell, (k + 1) % mesh.corners);
        if ((mesh.r[b] - mesh.r[a]) * (z - mesh.z[a]) - (mesh.z[b] - mesh.z[a]) * (r - mesh.r[a]) < 0) {
            return false;
        }
    }
    return true;
}

int bruteForce(const BackgroundMesh& mesh, double r, double z)
{
    for (int c = 0; c < mesh.cells(); ++c) {
        if (holds(mesh, c, r, z)) {
            return c;
        }
    }
    return -1;
}

/// Graded, and with inner nodes shaken: convex cells of all sorts.
BackgroundMesh shakenMesh(bool triangles)
{
    std::vector<double> r, z;
    for (int i = 0; i <= 24; ++i) {
        r.push_back(0.01 * std::pow(1.2, i) - 0.01);
        z.push_back(0.3 * i - 5);
    }
    BackgroundMesh mesh = structuredMesh(r, z, Geometry::axisymmetric, triangles);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> shake(-0.2, 0.2);
    for (std::size_t j = 1; j < 24; ++j) {
        for (std::size_t i = 1; i < 24; ++i) {
            mesh.r[j * 25 + i] += shake(random) * (r[i] - r[i - 1]);
            mesh.z[j * 25 + i] += shake(random) * 0.3;
        }
    }
    return mesh;
}

/// Every random place, in the mesh or around it, must be found where looking at all cells finds it.
void expectAgreement(const BackgroundMesh& mesh)
{
    const CellLocator locator(mesh);
    const auto [lowR, highR] = std::minmax_element(mesh.r.begin(), mesh.r.end());
    const auto [lowZ, highZ] = std::minmax_element(mesh.z.begin(), mesh.z.end());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> anyR(*lowR - 0.1 * *highR, 1.1 * *highR),
        anyZ(*lowZ - 0.3, *highZ + 0.3);
    std::uniform_int_distribution<int> anyCell(0, mesh.cells() - 1);
    int inside = 0, wrong = 0;
    for (int i = 0; i < places; ++i) {
        const double r = anyR(random), z = anyZ(random);
        const int expected = bruteForce(mesh, r, z);
        inside += expected >= 0;
        wrong += locator.find(r, z) != expected;
        wrong += locator.walk(r, z, anyCell(random)) != expected;
    }
    EXPECT_EQ(wrong, 0) << "of " << 2 * places << " answers";
    EXPECT_GT(inside, places / 4);
    EXPECT_LT(inside, places - places / 20);
}

} // namespace

TEST(CellLocator, agreesWithBruteForceOnQuadrilaterals) { expectAgreement(shakenMesh(false)); }

TEST(CellLocator, agreesWithBruteForceOnTriangles) { expectAgreement(shakenMesh(true)); }

TEST(CellLocator, walksAroundHolesAndSlits)
{
    // A wall of missing cells from the top down: the straight walk ends at it.
    BackgroundMesh flat = structuredMesh(evenLines(0, 3, 15), evenLines(-3, 0, 15), Geometry::planeStrain);
    std::vector<int> kept;
    for (int c = 0; c < flat.cells(); ++c) {
        if (c % 15 != 7 || c / 15 < 3) {
            kept.insert(kept.end(), flat.cellNodes.begin() + 4 * c, flat.cellNodes.begin() + 4 * c + 4);
        }
    }
    flat.cellNodes = kept;
    flat.halfThickness = 1;
    InputProblems problems;
    const BackgroundMesh mesh =
        buildBackgroundMesh(layerMesh(flat, {"wall"}, [](double, double) { return "wall"; }), problems);
    ASSERT_TRUE(problems.empty());
    expectAgreement(mesh);
}

TEST(CellLocator, findsTheCellsOfAMovedMeshFromItsOldBins)
{
    BackgroundMesh mesh = shakenMesh(false);
    const CellLocator locator(mesh);
    for (double& z : mesh.z) {
        z = z > -4.9 && z < 2 ? z - 0.09 * (z + 5) : z;
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anyR(0, 0.7), anyZ(-5, 2);
    for (int i = 0; i < places; ++i) {
        const double r = anyR(random), z = anyZ(random);
        const int cell = locator.find(r, z);
        ASSERT_GE(cell, 0);
        EXPECT_TRUE(holds(mesh, cell, r, z)) << r << ' ' << z << " in cell " << cell;
    }
}

TEST(CellLocator, placesOnSidesAndBoundariesHaveACellAndNoNumbersHaveNone)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(0, 1, 4), evenLines(0, 1, 4), Geometry::axisymmetric);
    const CellLocator locator(mesh);
    for (int start = 0; start < mesh.cells(); ++start) {
        for (double r = 0; r <= 1; r += 0.125) {
            for (double z = 0; z <= 1; z += 0.125) {
                const int cell = locator.walk(r, z, start);
                ASSERT_GE(cell, 0) << r << ' ' << z;
                EXPECT_TRUE(holds(mesh, cell, r, z));
            }
        }
    }
    EXPECT_GE(locator.find(1 + 1e-15, 0.3), 0) << "beyond the boundary by rounding";
    EXPECT_EQ(locator.find(1 + 1e-6, 0.3), -1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(locator.find(nan, 0.3), -1);
    EXPECT_EQ(locator.walk(nan, 0.3, 2), -1);
    EXPECT_EQ(locator.walk(0.3, nan, 2), -1);
    EXPECT_EQ(locator.find(std::numeric_limits<double>::infinity(), 0.3), -1);
}
