#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace caisson;
using namespace caisson::testing;

namespace {

/// A mesh of one cell.
BackgroundMesh oneCell(std::vector<double> r, std::vector<double> z, Geometry geometry)
{
    BackgroundMesh mesh;
    mesh.geometry = geometry;
    mesh.corners = static_cast<int>(r.size());
    mesh.cellNodes.resize(r.size());
    std::iota(mesh.cellNodes.begin(), mesh.cellNodes.end(), 0);
    mesh.r = std::move(r);
    mesh.z = std::move(z);
    return mesh;
}

/// Integral of r over a quadrilateral by its bilinear map and 3 x 3 Gauss points: exact, and another way.
double gaussVolume(const BackgroundMesh& mesh)
{
    const double place[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
    const double weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double xi = place[i], eta = place[j];
            const double N[4] = {(1 - xi) * (1 - eta) / 4, (1 + xi) * (1 - eta) / 4, (1 + xi) * (1 + eta) / 4,
                                 (1 - xi) * (1 + eta) / 4};
            const double Nx[4] = {-(1 - eta) / 4, (1 - eta) / 4, (1 + eta) / 4, -(1 + eta) / 4};
            const double Ne[4] = {-(1 - xi) / 4, -(1 + xi) / 4, (1 + xi) / 4, (1 - xi) / 4};
            double r = 0, rx = 0, re = 0, zx = 0, ze = 0;
            for (int k = 0; k < 4; ++k) {
                r += N[k] * mesh.r[k];
                rx += Nx[k] * mesh.r[k];
                re += Ne[k] * mesh.r[k];
                zx += Nx[k] * mesh.z[k];
                ze += Ne[k] * mesh.z[k];
            }
            sum += weight[i] * weight[j] * (rx * ze - re * zx) * r;
        }
    }
    return sum;
}

} // namespace

TEST(CellMeasures, volumeOfARingIsExact)
{
    const std::vector<double> r = {0, 0.2, 0.5, 1.1};
    const std::vector<double> z = {-1, -0.7, 0.4};
    for (const bool triangles : {false, true}) {
        const BackgroundMesh mesh = structuredMesh(r, z, Geometry::axisymmetric, triangles);
        double sum = 0;
        for (int c = 0; c < mesh.cells(); ++c) {
            sum += cellVolume(mesh, c);
        }
        EXPECT_NEAR(sum, 1.1 * 1.1 / 2 * 1.4, 1e-15);
        if (!triangles) {
            EXPECT_NEAR(cellVolume(mesh, 1), (0.25 - 0.04) / 2 * 0.3, 1e-16);
        }
    }
}

TEST(CellMeasures, volumeOfAnyQuadrilateralAgreesWithGaussPoints)
{
    const BackgroundMesh mesh = oneCell({0.3, 1.4, 1.2, 0.1}, {0.2, 0.1, 1.3, 0.9}, Geometry::axisymmetric);
    EXPECT_NEAR(cellVolume(mesh, 0), gaussVolume(mesh), 1e-15);
    // r -> r + 1 adds the area.
    BackgroundMesh shifted = mesh;
    for (double& r : shifted.r) {
        r += 1;
    }
    EXPECT_NEAR(cellVolume(shifted, 0) - cellVolume(mesh, 0), cellArea(mesh, 0), 1e-15);
    shifted.geometry = Geometry::planeStrain;
    EXPECT_DOUBLE_EQ(cellVolume(shifted, 0), cellArea(shifted, 0));
}

TEST(CellMeasures, smallCellsFarFromTheOriginLoseNoDigits)
{
    const double h = std::ldexp(1.0, -20); // places and sizes are exact binary numbers
    const BackgroundMesh mesh =
        oneCell({512, 512 + h, 512 + h, 512}, {-64, -64, -64 + h, -64 + h}, Geometry::axisymmetric);
    EXPECT_DOUBLE_EQ(cellArea(mesh, 0), h * h);
    EXPECT_DOUBLE_EQ(cellVolume(mesh, 0), h * h * (512 + h / 2));
}

TEST(CellMeasures, sizeOfQuadrilateralsCombinesBothExtents)
{
    const BackgroundMesh rectangle = oneCell({0, 3, 3, 0}, {0, 0, 4, 4}, Geometry::planeStrain);
    EXPECT_DOUBLE_EQ(cellSize(rectangle, 0), 12.0 / 5); // 1/sqrt(1/9 + 1/16)
    // Sheared: the height stays 4, the other extent shrinks to 12/5 (area over the length 5 of the side).
    const BackgroundMesh sheared = oneCell({0, 3, 6, 3}, {0, 0, 4, 4}, Geometry::planeStrain);
    EXPECT_DOUBLE_EQ(cellSize(sheared, 0), 1 / std::sqrt(1.0 / 16 + 25.0 / 144));
}

TEST(CellMeasures, sizeOfTrianglesIsTheSmallestAltitude)
{
    const BackgroundMesh right = oneCell({0, 3, 0}, {0, 0, 4}, Geometry::planeStrain);
    EXPECT_DOUBLE_EQ(cellSize(right, 0), 12.0 / 5);
    const BackgroundMesh flat = oneCell({0, 10, 5}, {0, 0, 0.1}, Geometry::planeStrain);
    EXPECT_DOUBLE_EQ(cellSize(flat, 0), 0.1);
}
