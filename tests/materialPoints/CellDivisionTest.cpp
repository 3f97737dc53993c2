#include "materialPoints/CellDivision.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace caisson;
using namespace caisson::testing;

namespace {

/// Graded cells far from the origin, inner nodes out of line.
BackgroundMesh oddMesh(Geometry geometry, bool triangles)
{
    BackgroundMesh mesh =
        structuredMesh({2.45, 2.475, 2.5, 2.53, 2.6}, {-20, -19.98, -19.95, -19.9}, geometry, triangles);
    for (const int node : {6, 7, 8, 11, 12, 13}) {
        mesh.r[node] += 0.004 * std::sin(node);
        mesh.z[node] += 0.004 * std::cos(node);
    }
    return mesh;
}

double sum(const std::vector<SubCell>& subCells)
{
    double volume = 0;
    for (const SubCell& subCell : subCells) {
        volume += subCell.volume;
    }
    return volume;
}

} // namespace

TEST(CellDivision, volumesOfSubCellsAddUpToTheCell)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        for (const bool triangles : {false, true}) {
            const BackgroundMesh mesh = oddMesh(geometry, triangles);
            std::vector<CellDivision> divisions;
            for (const int n : {1, 2, 3, 7}) {
                CellDivision division;
                division.along = {n, n + 1};
                for (const int pattern : {1, 3, 6}) {
                    division.split = n;
                    division.pattern = pattern;
                    divisions.push_back(division);
                }
            }
            for (const CellDivision& division : divisions) {
                for (int c = 0; c < mesh.cells(); ++c) {
                    const auto subCells = subdivide(mesh, c, division);
                    const int expected = triangles ? division.pattern * division.split * division.split
                                                   : division.along[0] * division.along[1];
                    ASSERT_EQ(static_cast<int>(subCells.size()), expected);
                    EXPECT_NEAR(sum(subCells) / cellVolume(mesh, c), 1, 1e-14)
                        << "cell " << c << " with " << subCells.size() << " points";
                    EXPECT_GT(std::ranges::min(subCells, {}, &SubCell::volume).volume, 0);
                }
            }
        }
    }
}

TEST(CellDivision, pointsOfARectangleAreTheCentresOfVolumeOfARegularGrid)
{
    const BackgroundMesh mesh = structuredMesh({1, 1.6}, {0, 0.4}, Geometry::axisymmetric);
    CellDivision division;
    division.along = {3, 2};
    const auto subCells = subdivide(mesh, 0, division);
    ASSERT_EQ(subCells.size(), 6u);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 3; ++i) {
            const SubCell& subCell = subCells[3 * j + i];
            const double middle = 1.1 + 0.2 * i;
            EXPECT_NEAR(subCell.r, middle + 0.2 * 0.2 / (12 * middle), 1e-15) << "of a ring's section";
            EXPECT_NEAR(subCell.z, 0.1 + 0.2 * j, 1e-15);
            EXPECT_NEAR(subCell.volume, 0.2 * 0.2 * middle, 1e-15) << "area times mean r";
            EXPECT_NEAR(subCell.lowest, 0.2 * j, 1e-15);
            EXPECT_NEAR(subCell.highest, 0.2 * (j + 1), 1e-15);
        }
    }
}

TEST(CellDivision, directionsFollowRAndZWhereverTheCornersStart)
{
    BackgroundMesh mesh = structuredMesh({1, 1.6}, {0, 0.4}, Geometry::axisymmetric);
    std::ranges::rotate(mesh.cellNodes, mesh.cellNodes.begin() + 1);
    CellDivision division;
    division.along = {5, 1};
    for (const SubCell& subCell : subdivide(mesh, 0, division)) {
        EXPECT_NEAR(subCell.z, 0.2, 1e-15) << "one row of five";
    }
}

TEST(CellDivision, pointsIntegrateTheShapeFunctionsExactlySoThatWeightsAreRight)
{
    // Over a triangle, int r z dA = A (sum r sum z + sum of r_i z_i)/12, and so for r^2.
    const BackgroundMesh mesh = oddMesh(Geometry::axisymmetric, true);
    for (const int points : {1, 3, 4, 6, 12, 24}) {
        CellDivision division;
        ASSERT_TRUE(divideTriangle(points, division));
        for (int c = 0; c < mesh.cells(); ++c) {
            double sumR = 0, sumZ = 0, sumRR = 0, sumRZ = 0;
            for (int k = 0; k < 3; ++k) {
                const double r = mesh.r[mesh.node(c, k)], z = mesh.z[mesh.node(c, k)];
                sumR += r;
                sumZ += z;
                sumRR += r * r;
                sumRZ += r * z;
            }
            double momentR = 0, momentZ = 0;
            for (const SubCell& subCell : subdivide(mesh, c, division)) {
                momentR += subCell.volume * subCell.r;
                momentZ += subCell.volume * subCell.z;
            }
            const double area = cellArea(mesh, c);
            EXPECT_NEAR(momentR / (area * (sumR * sumR + sumRR) / 12), 1, 1e-14) << points << " points";
            EXPECT_NEAR(momentZ / (area * (sumR * sumZ + sumRZ) / 12), 1, 1e-14) << points << " points";
        }
    }
    const BackgroundMesh rectangle = structuredMesh({0.1, 0.6}, {-1, -0.6}, Geometry::axisymmetric);
    double momentR = 0, momentZ = 0, momentRZ = 0;
    for (const SubCell& subCell : subdivide(rectangle, 0, {})) {
        momentR += subCell.volume * subCell.r;
        momentZ += subCell.volume * subCell.z;
        momentRZ += subCell.volume * subCell.r * subCell.z;
    }
    const double thirdMoment = (0.216 - 0.001) / 3, half = (0.36 - 0.01) / 2, z = (0.36 - 1) / 2;
    EXPECT_NEAR(momentR, thirdMoment * 0.4, 1e-16);
    EXPECT_NEAR(momentZ, half * z, 1e-16);
    EXPECT_NEAR(momentRZ, thirdMoment * z, 1e-16);
}

TEST(CellDivision, numbersOfPointsInTriangles)
{
    for (const auto& [points, pattern, split] :
         {std::array{1, 1, 1}, {3, 3, 1}, {4, 1, 2}, {6, 6, 1}, {12, 3, 2}, {24, 6, 2}, {27, 3, 3}}) {
        CellDivision division;
        EXPECT_TRUE(divideTriangle(points, division)) << points;
        EXPECT_EQ(division.pattern, pattern) << points;
        EXPECT_EQ(division.split, split) << points;
    }
    for (const int points : {-3, 0, 2, 5, 7, 10}) {
        CellDivision division;
        EXPECT_FALSE(divideTriangle(points, division)) << points;
    }
}

TEST(CellDivision, refinementReachesTheSpacingAndNoFurther)
{
    const BackgroundMesh mesh = structuredMesh({0, 0.3}, {0, 1}, Geometry::axisymmetric);
    const CellDivision division = refined(mesh, 0, {}, {0.1, 0.125});
    EXPECT_EQ(division.along[0], 3) << "0.3/0.1 in spite of rounding";
    EXPECT_EQ(division.along[1], 8);
    EXPECT_EQ(refined(mesh, 0, {}, {1, 1}).along, (std::array{2, 2})) << "never coarser";

    const BackgroundMesh triangles = structuredMesh({0, 1}, {0, 1}, Geometry::axisymmetric, true);
    const CellDivision split = refined(triangles, 0, {}, {10, 0.1});
    const auto points = subdivide(triangles, 0, split);
    double farthest = 0;
    for (const SubCell& a : points) {
        double nearest = 1;
        for (const SubCell& b : points) {
            const double distance = std::hypot(a.r - b.r, a.z - b.z);
            nearest = distance > 0 ? std::min(nearest, distance) : nearest;
        }
        farthest = std::max(farthest, nearest);
    }
    EXPECT_LE(farthest, 0.1 + 1e-12) << "each point has another within the spacing";
    EXPECT_EQ(split.split, 5);
}
