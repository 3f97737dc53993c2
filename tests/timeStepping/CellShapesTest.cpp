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
{
};
using Shapes = ::testing::Types<Rectangle<true>, Rectangle<false>, Quadrilateral<true>, Quadrilateral<false>,
                                Triangle<true>, Triangle<false>>;
TYPED_TEST_SUITE(CellShapes, Shapes);

template <class Shape>
constexpr bool axisymmetric =
    std::is_same_v<Shape, Rectangle<true>> || std::is_same_v<Shape, Quadrilateral<true>> ||
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

TYPED_TEST(CellShapes, momentsOfTheStrainOperatorAreThoseOfFineQuadrature)
{
    constexpr int n = TypeParam::corners;
    constexpr int moments = Moments<n>::count;
    for (const auto& cell : sampleCells<TypeParam>()) {
        const Moments<n> m = TypeParam::moments(cell);
        // Midpoint rule over a fine grid of the cell's box.
        double gr[moments][n] = {}, gz[moments][n] = {}, h[moments][n] = {}, mean[n] = {};
        double volume = 0, xiCentre = 0, inertiaXi = 0, inertiaEta = 0;
        double nodeR[n], nodeZ[n];
        corners<TypeParam>(cell, nodeR, nodeZ);
        const int fine = 400;
        for (const bool first : {true, false}) {
            for (int i = 0; i < fine; ++i) {
                for (int j = 0; j < fine; ++j) {
                    const double r = nodeR[0] + 0.4 * (i + 0.5) / fine;
                    const double z = -1 + 0.7 * (j + 0.5) / fine;
                    if (!TypeParam::contains(cell, r, z)) {
                        continue;
                    }
                    const double weight = 0.4 * 0.7 / (fine * fine) * (axisymmetric<TypeParam> ? r : 1);
                    const auto [xi, eta] = TypeParam::local(cell, r, z);
                    if (first) {
                        volume += weight;
                        xiCentre += weight * xi;
                        continue;
                    }
                    Values<n> v;
                    TypeParam::evaluate(cell, r, z, v);
                    const double factor[3] = {weight, weight * (xi - xiCentre), weight * eta};
                    inertiaXi += factor[1] * (xi - xiCentre);
                    inertiaEta += factor[2] * eta;
                    for (int k = 0; k < n; ++k) {
                        mean[k] += weight * v.N[k];
                        for (int q = 0; q < moments; ++q) {
                            gr[q][k] += factor[q] * v.dr[k];
                            gz[q][k] += factor[q] * v.dz[k];
                            h[q][k] += axisymmetric<TypeParam> ? factor[q] * v.N[k] / r : 0;
                        }
                    }
                }
            }
            xiCentre /= first ? volume : 1;
        }
        // Tolerance: the midpoint rule on the slanted sides of the triangle; elsewhere its second order.
        const double tolerance = n == 3 ? 8e-3 : 2e-5;
        EXPECT_NEAR(m.volume, volume, tolerance * volume);
        if (moments == 3) {
            EXPECT_NEAR(m.xiCentre, xiCentre, tolerance);
            EXPECT_NEAR(m.inertiaXi, inertiaXi / volume, tolerance);
            EXPECT_NEAR(m.inertiaEta, inertiaEta / volume, tolerance);
        }
        for (int k = 0; k < n; ++k) {
            EXPECT_NEAR(m.n[k], mean[k] / volume, tolerance);
            for (int q = 0; q < moments; ++q) {
                EXPECT_NEAR(m.gr[q][k], gr[q][k] / volume, 5 * tolerance)
                    << "moment " << q << " corner " << k;
                EXPECT_NEAR(m.gz[q][k], gz[q][k] / volume, 5 * tolerance)
                    << "moment " << q << " corner " << k;
                EXPECT_NEAR(m.h[q][k], h[q][k] / volume, 5 * tolerance) << "moment " << q << " corner " << k;
            }
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

TEST(RectangleShape, hasTheMomentsOfTheGeneralQuadrilateral)
{
    const double r[4] = {0.3, 0.8, 0.8, 0.3};
    const double z[4] = {-1, -1, -0.7, -0.7};
    const Moments<4> closed = Rectangle<true>::moments(Rectangle<true>::make(r, z));
    const double slanted[4] = {-1, -1 + 1e-9, -0.7, -0.7}; // as little as makes it a general one
    const auto general = Quadrilateral<true>::make(r, slanted);
    ASSERT_FALSE(general.isStraight);
    ASSERT_TRUE(Quadrilateral<true>::make(r, z).isStraight);
    const Moments<4> gauss = Quadrilateral<true>::moments(general);
    EXPECT_NEAR(closed.volume, gauss.volume, 1e-9);
    for (int q = 0; q < 3; ++q) { // the 2 x 2 points integrate these cubics exactly
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(closed.gr[q][k], gauss.gr[q][k], 1e-7);
            EXPECT_NEAR(closed.gz[q][k], gauss.gz[q][k], 1e-7);
            EXPECT_NEAR(closed.h[q][k], gauss.h[q][k], 1e-7);
        }
    }
}

} // namespace
} // namespace caisson::shapes
