#include "PointBatch.h"
#include "constitutive/LinearElastic.h"
#include "constitutive/MohrCoulomb.h"
#include "constitutive/NeoHookean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace caisson::testing {
namespace {

constexpr IsotropicElasticity sand{60e6, 0.25};

double largestDifference(const PointBatch& points, const std::array<double, 4>& expected)
{
    double worst = 0;
    for (int k = 0; k < 4; ++k)
        worst = std::max(worst, std::abs(points.stress[k][0] - expected[k]));
    return worst;
}

void setStress(PointBatch& points, const std::array<double, 4>& stress)
{
    for (int k = 0; k < 4; ++k)
        points.stress[k][0] = stress[k];
}

TEST(LinearElastic, isHookesLawForSmallStrain)
{
    const LinearElastic law(sand);
    PointBatch points(law);
    const std::array<double, 4> strain{1e-4, -2e-4, 3e-5, 5e-5};
    for (int k = 0; k < 4; ++k)
        points.strain[k][0] = strain[k];
    points.update();
    // E/((1+nu)(1-2nu)) = 96 MPa: rows of Hooke's law for E = 60 MPa, nu = 0.25.
    const double volumetric = 24e6 * (1e-4 - 2e-4 + 3e-5);
    EXPECT_NEAR(points.stress[0][0], volumetric + 48e6 * 1e-4, 1e-9);
    EXPECT_NEAR(points.stress[1][0], volumetric - 48e6 * 2e-4, 1e-9);
    EXPECT_NEAR(points.stress[2][0], volumetric + 48e6 * 3e-5, 1e-9);
    EXPECT_NEAR(points.stress[3][0], 24e6 * 5e-5, 1e-9);
    EXPECT_DOUBLE_EQ(law.pWaveModulus(), 72e6);
}

TEST(LinearElastic, closedStrainLoopsLeaveNoStress)
{
    const LinearElastic law(sand);
    PointBatch points(law);
    constexpr std::array<double, 4> start{-30e3, -60e3, -30e3, 5e3};
    setStress(points, start);
    constexpr int steps = 100;
    for (int cycle = 0; cycle < 1000; ++cycle)
        for (int step = 0; step < steps; ++step) {
            const double from = 2 * std::numbers::pi * step / steps;
            const double to = 2 * std::numbers::pi * (step + 1) / steps;
            points.strain[0][0] = 1e-3 * (std::sin(to) - std::sin(from));
            points.strain[1][0] = 2e-3 * (std::cos(to) - std::cos(from));
            points.strain[2][0] = -1e-3 * (std::sin(2 * to) - std::sin(2 * from));
            points.strain[3][0] = 3e-3 * (std::sin(to) - std::sin(from));
            points.update();
        }
    const double swing = 2e-3 * sand.pWaveModulus();
    EXPECT_LE(largestDifference(points, start) / swing, 1e-10); // 1e5 additions at rounding
}

TEST(LinearElastic, returnsToItsStressAfterTurnsOfAFullCircle)
{
    const LinearElastic law(sand);
    for (const int turns : {1, 10}) {
        PointBatch points(law);
        constexpr std::array<double, 4> start{-38e3, -100e3, -50e3, 12e3};
        setStress(points, start);
        points.spin[0] = 2 * std::numbers::pi / 3600;
        const double invariant = std::hypot(0.5 * (start[0] - start[1]), start[3]);
        for (int step = 0; step < 3600 * turns; ++step)
            points.update();
        const double error = largestDifference(points, start) / 100e3;
        const double drift = std::abs(
            std::hypot(0.5 * (points.stress[0][0] - points.stress[1][0]), points.stress[3][0]) / invariant -
            1);
        RecordProperty("error", std::to_string(error));
        EXPECT_LE(error, 1e-10) << turns << " turns"; // asked: 1e-6; the series leaves 1e-16 per step
        EXPECT_LE(drift, 1e-11) << turns << " turns";
    }
}

TEST(LinearElastic, aQuarterTurnCarriesTheStressAlong)
{
    const LinearElastic law(sand);
    PointBatch points(law);
    setStress(points, {-38e3, -100e3, -50e3, 12e3});
    points.spin[0] = std::numbers::pi / 2 / 900;
    for (int step = 0; step < 900; ++step)
        points.update();
    EXPECT_LE(largestDifference(points, {-100e3, -38e3, -50e3, -12e3}), 1e-6);
}

TEST(LinearElastic, turnsByTheDeclaredSign)
{
    const LinearElastic law(sand);
    PointBatch points(law);
    setStress(points, {2, 1, 0, 0.25});
    constexpr double w = 1e-7;
    points.spin[0] = w;
    points.update();
    // s_rr -= 2 w s_rz, s_zz += 2 w s_rz, s_rz += w (s_rr - s_zz)
    EXPECT_NEAR(points.stress[0][0], 2 - 2 * w * 0.25, 1e-13);
    EXPECT_NEAR(points.stress[1][0], 1 + 2 * w * 0.25, 1e-13);
    EXPECT_NEAR(points.stress[3][0], 0.25 + w, 1e-13);
}

/// The known flaw of the Jaumann rate: a hypoelastic solid in simple shear has s_rz = G sin(gamma),
/// s_rr = -s_zz = G (1 - cos(gamma)) [Dienes 1979]. Kept as a test so that nobody takes it for a mistake.
TEST(LinearElastic, simpleShearFollowsTheSineOfTheJaumannRate)
{
    const LinearElastic law(sand);
    const double shear = sand.shearModulus();
    double previous = 0;
    for (const int steps : {2000, 4000}) {
        PointBatch points(law);
        const double increment = 10.0 / steps;
        points.strain[3][0] = increment; // v_r,z = gamma, v_z,r = 0
        points.spin[0] = -0.5 * increment;
        for (int step = 0; step < steps; ++step)
            points.update();
        const double error =
            largestDifference(points, {shear * (1 - std::cos(10.0)), -shear * (1 - std::cos(10.0)), 0,
                                       shear * std::sin(10.0)}) /
            shear;
        EXPECT_LE(error, increment); // first order: the increment is added at the end of the turn
        if (previous > 0) {
            EXPECT_NEAR(previous / error, 2, 0.1);
        }
        previous = error;
    }
}

TEST(NeoHookean, matchesItsClosedFormInSimpleShear)
{
    const NeoHookean law(sand);
    PointBatch points(law);
    constexpr int steps = 1000;
    points.strain[3][0] = 10.0 / steps;
    points.spin[0] = -5.0 / steps;
    for (int step = 1; step <= steps; ++step) {
        points.update();
        const double gamma = 10.0 * step / steps;
        const double mu = sand.shearModulus();
        // F = (1 gamma; 0 1), J = 1: Cauchy stress mu (F F^T - 1)
        ASSERT_LE(largestDifference(points, {mu * gamma * gamma, 0, 0, mu * gamma}) / mu, 1e-10) << gamma;
    }
}

TEST(NeoHookean, matchesItsClosedFormInStretch)
{
    const NeoHookean law(sand);
    PointBatch points(law);
    points.strain[0][0] = 0.2;
    points.strain[1][0] = -0.1;
    points.strain[2][0] = 0.3;
    points.update();
    const double j = 1.2 * 0.9 * 1.3;
    const auto cauchy = [&](const double stretch) {
        return (sand.lambda() * std::log(j) + sand.shearModulus() * (stretch * stretch - 1)) / j;
    };
    EXPECT_LE(largestDifference(points, {cauchy(1.2), cauchy(0.9), cauchy(1.3), 0}), 1e-7);
    // The same from the nominal stress of the verification problems: P = J sigma F^-T.
    const double nominal = sand.lambda() * std::log(j) / 1.2 + sand.shearModulus() * (1.2 - 1 / 1.2);
    EXPECT_NEAR(points.stress[0][0] * j / 1.2, nominal, 1e-7);
}

TEST(NeoHookean, closedLoopsLeaveNoStress)
{
    const NeoHookean law(sand);
    PointBatch points(law);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int cycle = 0; cycle < 1000; ++cycle) {
        const std::array<double, 4> l{0.2 * unit(random), 0.2 * unit(random), 0.2 * unit(random),
                                      0.2 * unit(random)}; // rr, rz, zr, zz of 1 + dL
        const double hoop = 0.2 * unit(random);
        const auto apply = [&](const double rr, const double rz, const double zr, const double zz,
                               const double tt) {
            points.strain[0][0] = rr;
            points.strain[1][0] = zz;
            points.strain[2][0] = tt;
            points.strain[3][0] = rz + zr;
            points.spin[0] = 0.5 * (zr - rz);
            points.update();
        };
        apply(l[0], l[1], l[2], l[3], hoop);
        const double determinant = (1 + l[0]) * (1 + l[3]) - l[1] * l[2];
        apply((1 + l[3]) / determinant - 1, -l[1] / determinant, -l[2] / determinant,
              (1 + l[0]) / determinant - 1, 1 / (1 + hoop) - 1);
    }
    EXPECT_LE(largestDifference(points, {0, 0, 0, 0}) / sand.pWaveModulus(), 1e-10);
}

TEST(NeoHookean, carriesTheStressThroughARigidRotation)
{
    const NeoHookean law(sand);
    PointBatch points(law);
    points.strain[0][0] = 0.1;
    points.update();
    const double axial = points.stress[0][0];
    const double lateral = points.stress[1][0];
    // A quarter turn in one step: F <- R F, v_z,r dt = 1 and v_r,z dt = -1 with -1 on the diagonal.
    points.strain[0][0] = points.strain[1][0] = -1;
    points.spin[0] = 1;
    points.update();
    EXPECT_LE(largestDifference(points, {lateral, axial, lateral, 0}), 1e-6);
}

TEST(RateLaws, agreeWhereNothingYields)
{
    const LinearElastic linear(sand);
    const MohrCoulomb tresca(sand, {0, 0, 1e12});
    PointBatch a(linear, 1000);
    PointBatch b(tresca, 1000);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        for (int k = 0; k < 4; ++k) {
            a.strain[k][i] = b.strain[k][i] = 1e-3 * unit(random);
            a.stress[k][i] = b.stress[k][i] = 1e5 * unit(random);
        }
        a.spin[i] = b.spin[i] = 0.1 * unit(random);
    }
    a.update();
    b.update();
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 1000; ++i)
            ASSERT_NEAR(a.stress[k][i], b.stress[k][i], 1e-9) << k << ' ' << i;
}

} // namespace
} // namespace caisson::testing
