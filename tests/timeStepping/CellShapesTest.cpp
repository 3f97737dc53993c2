#include "timeStepping/CellShapes.h"

#include <gtest/gtest.h>

#include <random>

namespace caisson::shapes {
namespace {

/// Cells away from and at the axis, corners of an axis-parallel rectangle or something less regular.
template <class Shape>
std::vector<typename Shape::Cell> sampleCells()
{
    std::vector<typename Shape::Cell> cells;
    for (const double shift : {0.0, 1.7}) {
        if constexpr (Shape::corners == 3) {
            const double r[3] = {shift, shift + 0.4, shift + 0.1};
            const double z[3] = {-1, -0.9, -0.3};
            cells.push_back(Shape::make(r, z));
        } else {
            const double r[4] = {shift, shift + 0.4, shift + 0.4, shift};
            const double z[4] = {-1, -1, -0.3, -0.3};
            cells.push_back(Shape::make(r, z));
        }
    }
    return cells;
}

template <class Shape>
std::array<double, 2> placeInside(const typename Shape::Cell& cell, std::mt19937& random)
{
    std::uniform_real_distribution<double> r(0, 2.2);
    std::uniform_real_distribution<double> z(-1, 0);
    for (;;) {
        const std::array<double, 2> place{r(random), z(random)};
        if (Shape::contains(cell, place[0], place[1])) {
            return place;
        }
    }
}

/// Node places through the map of the identity: sum of N r is r for a linear basis.
template <class Shape>
void corners(const typename Shape::Cell& cell, double (&r)[Shape::corners], double (&z)[Shape::corners])
{
    if constexpr (requires { cell.invDr; }) {
        const double rs[4] = {cell.r0, cell.r0 + cell.dr, cell.r0 + cell.dr, cell.r0};
        const double zs[4] = {cell.z0, cell.z0, cell.z0 + cell.dz, cell.z0 + cell.dz};
        std::copy_n(rs, 4, r);
        std::copy_n(zs, 4, z);
    } else {
        std::copy_n(cell.r, Shape::corners, r);
        std::copy_n(cell.z, Shape::corners, z);
    }
}

template <class Shape>
class CellShapes : public ::testing::Test
{};
using Shapes = ::testing::Types<Rectangle<true>, Rectangle<false>, Quadrilateral<true>, Quadrilateral<false>,
                                Triangle<true>, Triangle<false>>;
TYPED_TEST_SUITE(CellShapes, Shapes);

template <class Shape>
constexpr bool axisymmetric = std::is_same_v<Shape, Rectangle<true>> || std::is_same_v<Shape, Quadrilateral<true>> ||
                              std::is_same_v<Shape, Triangle<true>>;

TYPED_TEST(CellShapes, reproducesLinearFieldsAndTheirGradients)
{
    constexpr int n = TypeParam::corners;
    std::mt19937 random(1);
    for (const auto& cell : sampleCells<TypeParam>()) {
        double r[n], z[n];
        corners<TypeParam>(cell, r, z);
        for (int i = 0; i < 50; ++i) {
            const auto [pr, pz] = placeInside<TypeParam>(cell, random);
            Values<n> v;
            TypeParam::evaluate(cell, pr, pz, v);
            double field = 0, dr = 0, dz = 0;
            for (int k = 0; k < n; ++k) {
                const double nodal = 3 + 2 * r[k] - 5 * z[k];
                field += v.N[k] * nodal;
                dr += v.dr[k] * nodal;
                dz += v.dz[k] * nodal;
            }
            EXPECT_NEAR(field, 3 + 2 * pr - 5 * pz, 1e-12);
            EXPECT_NEAR(dr, 2, 1e-11);
            EXPECT_NEAR(dz, -5, 1e-11);
        }
    }
}

TYPED_TEST(CellShapes, forcesOfAConstantStressAreThoseOfFineQuadrature)
{
    constexpr int n = TypeParam::corners;
    const double sigma[4] = {-3, 2, 5, 0.7};
    for (const auto& cell : sampleCells<TypeParam>()) {
        LinearStress stress{};
        std::copy_n(sigma, 4, stress.mean);
        double fr[n], fz[n], exactR[n] = {}, exactZ[n] = {};
        TypeParam::force(cell, stress, fr, fz);
        // Midpoint rule over a fine grid of the cell's box.
        const int m = 400;
        const double r0 = [&] { double r[n], z[n]; corners<TypeParam>(cell, r, z); return r[0]; }();
        for (int i = 0; i < m; ++i) {
            for (int j = 0; j < m; ++j) {
                const double r = r0 + 0.4 * (i + 0.5) / m;
                const double z = -1 + 0.7 * (j + 0.5) / m;
                if (!TypeParam::contains(cell, r, z)) {
                    continue;
                }
                Values<n> v;
                TypeParam::evaluate(cell, r, z, v);
                const double weight = 0.4 * 0.7 / (m * m) * (axisymmetric<TypeParam> ? r : 1);
                for (int k = 0; k < n; ++k) {
                    exactR[k] += weight * (sigma[0] * v.dr[k] + sigma[3] * v.dz[k] +
                                           (axisymmetric<TypeParam> ? sigma[2] * v.N[k] / r : 0));
                    exactZ[k] += weight * (sigma[1] * v.dz[k] + sigma[3] * v.dr[k]);
                }
            }
        }
        for (int k = 0; k < n; ++k) { // tolerance: the quadrature at the slanted sides of a triangle
            EXPECT_NEAR(fr[k], exactR[k], n == 3 ? 4e-3 : 2e-5);
            EXPECT_NEAR(fz[k], exactZ[k], n == 3 ? 4e-3 : 2e-5);
        }
    }
}

TYPED_TEST(CellShapes, meanDilatationOfALinearFieldIsExact)
{
    // v_r = a r, v_z = b z: div v = 2 a + b (axisymmetric), a + b (plane), at every place and so in the mean.
    constexpr int n = TypeParam::corners;
    for (const auto& cell : sampleCells<TypeParam>()) {
        double r[n], z[n];
        corners<TypeParam>(cell, r, z);
        const auto mean = TypeParam::meanDilatation(cell);
        double rate = 0;
        for (int k = 0; k < n; ++k) {
            rate += mean.br[k] * 0.3 * r[k] + mean.bz[k] * -0.7 * z[k];
        }
        EXPECT_NEAR(rate, (axisymmetric<TypeParam> ? 0.6 : 0.3) - 0.7, 1e-13);
    }
}

TEST(RectangleShape, hasTheForcesOfTheGeneralQuadrilateralForALinearStress)
{
    const double r[4] = {0.3, 0.8, 0.8, 0.3};
    const double z[4] = {-1, -1, -0.7, -0.7};
    const LinearStress stress{{1, -2, 3, 0.5}, {0.2, 0.4, -0.3, 0.7}, {-0.6, 0.1, 0.9, -0.2}};
    double fr[4], fz[4], generalR[4], generalZ[4];
    Rectangle<true>::force(Rectangle<true>::make(r, z), stress, fr, fz);
    Quadrilateral<true>::force(Quadrilateral<true>::make(r, z), stress, generalR, generalZ);
    for (int k = 0; k < 4; ++k) { // the 2 x 2 points integrate these cubics exactly
        EXPECT_NEAR(fr[k], generalR[k], 1e-14);
        EXPECT_NEAR(fz[k], generalZ[k], 1e-14);
    }
}

} // namespace
} // namespace caisson::shapes
