#include "PointBatch.h"
#include "constitutive/MohrCoulomb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace caisson::testing {
namespace {

using Principal = MohrCoulombSurface::Principal;

constexpr double degree = std::numbers::pi / 180;

struct Reference
{
    Principal trial; // kPa
    double phi, psi, cohesion;
    Principal result;
    ReturnRegion region;
    std::array<double, 2> multiplier;
};

constexpr IsotropicElasticity elasticity{60000, 0.25}; // kPa, as the reference values

/// From an enumeration of the active planes (Koiter), computed independently of this code.
const std::array<Reference, 12> references{{
    {{-50, -100, -300},
     38,
     1,
     0,
     {-67.485908151, -100.294878497, -283.693605838},
     ReturnRegion::face,
     {3.52003149e-4, 0}},
    {{-10, -60, -300},
     38,
     1,
     0,
     {-60.223508631, -60.846958169, -253.164324045},
     ReturnRegion::face,
     {1.01103317e-3, 0}},
    {{-20, -25, -200},
     38,
     1,
     0,
     {-39.958989962, -39.958989962, -167.977437936},
     ReturnRegion::edgeS1S2,
     {3.96822542e-4, 2.9444265e-4}},
    {{-20, -190, -200},
     38,
     1,
     0,
     {-43.795565235, -184.105425288, -184.105425288},
     ReturnRegion::edgeS2S3,
     {3.45527322e-4, 1.33493488e-4}},
    {{30, -10, -60},
     38,
     1,
     0,
     {-6.23478211, -10.611055371, -26.209439375},
     ReturnRegion::face,
     {7.29430653e-4, 0}},
    {{50, 40, 30}, 38, 1, 0, {0, 0, 0}, ReturnRegion::apex, {0, 0}},
    {{-100, -150, -400},
     30,
     0,
     10,
     {-116.339745962, -150, -383.660254038},
     ReturnRegion::face,
     {3.40411374e-4, 0}},
    {{-100, -150, -400},
     30,
     30,
     10,
     {-121.78632795, -155.446581987, -400},
     ReturnRegion::face,
     {2.26940916e-4, 0}},
    {{20, 0, -400}, 0, 0, 50, {-280.0 / 3, -280.0 / 3, -580.0 / 3}, ReturnRegion::edgeS1S2, {}},
    {{200, 190, -400}, 0, 0, 50, {30, 30, -70}, ReturnRegion::edgeS1S2, {}},
    {{100, 50, 0}, 35, 10, 5, {7.140740034, 7.140740034, 7.140740034}, ReturnRegion::apex, {0, 0}},
    {{-1, -4.9, -5}, 38, 1, 0, {-1.160085879, -4.876706193, -4.876706193}, ReturnRegion::edgeS2S3, {}},
}};

MohrCoulombStrength strengthOf(const Reference& reference)
{
    return {reference.phi * degree, reference.psi * degree, reference.cohesion};
}

constexpr double referenceTolerance = 1e-8; // kPa; the values are printed to 9 decimals

TEST(MohrCoulombSurface, returnsTheTwelveReferenceStresses)
{
    for (const Reference& reference : references) {
        const MohrCoulombSurface surface(elasticity, strengthOf(reference));
        const MohrCoulombSurface::Return result = surface.returned(reference.trial);
        SCOPED_TRACE(::testing::PrintToString(reference.trial));
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(result.stress[k], reference.result[k], referenceTolerance);
        EXPECT_EQ(result.region, reference.region);
        for (int k = 0; k < 2; ++k)
            if (reference.multiplier[k] > 0) {
                EXPECT_NEAR(result.multiplier[k] / reference.multiplier[k], 1, 1e-8);
            }
    }
}

/// In-plane principal stresses along axes that are turned by `angle` from r.
void setInPlane(PointBatch& points, const double first, const double second, const double angle)
{
    const double mean = 0.5 * (first + second);
    const double radius = 0.5 * (first - second);
    points.stress[0][0] = mean + radius * std::cos(2 * angle);
    points.stress[1][0] = mean - radius * std::cos(2 * angle);
    points.stress[3][0] = radius * std::sin(2 * angle);
}

TEST(MohrCoulomb, returnsTheReferenceStressesWhateverTheAxes)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Reference& reference : references)
        for (int hoop = 0; hoop < 3; ++hoop)
            for (int sample = 0; sample < 20; ++sample) {
                const MohrCoulomb law(elasticity, strengthOf(reference));
                PointBatch points(law);
                const double angle = 2 * std::numbers::pi * unit(random);
                const double turn = 0.1 * (unit(random) - 0.5); // done by the spin of the step
                const int first = hoop == 0 ? 1 : 0;
                const int second = hoop == 2 ? 1 : 2;
                setInPlane(points, reference.trial[first], reference.trial[second], angle - turn);
                points.stress[2][0] = reference.trial[hoop];
                points.spin[0] = turn;
                // A part of the trial stress comes as a strain increment.
                const double volumetric = 1e-3 * unit(random);
                for (int k = 0; k < 3; ++k) {
                    points.strain[k][0] = volumetric / 3;
                    points.stress[k][0] -= elasticity.bulkModulus() * volumetric;
                }
                points.update();

                PointBatch expected(law);
                setInPlane(expected, reference.result[first], reference.result[second], angle);
                expected.stress[2][0] = reference.result[hoop];
                for (int k = 0; k < 4; ++k)
                    ASSERT_NEAR(points.stress[k][0], expected.stress[k][0], 2 * referenceTolerance)
                        << "trial " << ::testing::PrintToString(reference.trial) << " hoop " << hoop
                        << " angle " << angle << " component " << k;
            }
}

/// The flow rule solved by trying all sets of one and two active planes out of six: slow and independent of
/// the order of tests in the closed form. Nothing where no set fits, which leaves the apex.
std::optional<Principal> koiter(const Principal& trial, const MohrCoulombStrength& strength)
{
    const double lambda = elasticity.lambda();
    const double shear = elasticity.shearModulus();
    const double k = 2 * strength.cohesion * std::cos(strength.frictionAngle);
    std::vector<Principal> gradients;
    std::vector<Principal> flows;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (i == j)
                continue;
            Principal a{};
            Principal b{};
            a[i] = 1 + std::sin(strength.frictionAngle);
            a[j] = -1 + std::sin(strength.frictionAngle);
            b[i] = 1 + std::sin(strength.dilatancyAngle);
            b[j] = -1 + std::sin(strength.dilatancyAngle);
            const double trace = b[0] + b[1] + b[2];
            gradients.push_back(a);
            flows.push_back({lambda * trace + 2 * shear * b[0], lambda * trace + 2 * shear * b[1],
                             lambda * trace + 2 * shear * b[2]});
        }
    const auto dot = [](const Principal& a, const Principal& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const double scale = std::abs(trial[0]) + std::abs(trial[2]) + k;
    const auto accept = [&](const std::vector<int>& planes,
                            const std::vector<double>& multipliers) -> std::optional<Principal> {
        Principal s = trial;
        for (std::size_t n = 0; n < planes.size(); ++n) {
            if (multipliers[n] * shear < -1e-11 * scale)
                return {};
            for (int c = 0; c < 3; ++c)
                s[c] -= multipliers[n] * flows[planes[n]][c];
        }
        for (const Principal& a : gradients)
            if (dot(a, s) - k > 1e-11 * scale)
                return {};
        return s;
    };
    for (int m = 0; m < 6; ++m) {
        const double fm = dot(gradients[m], trial) - k;
        const double mm = dot(gradients[m], flows[m]);
        if (const auto s = accept({m}, {fm / mm}))
            return s;
        for (int n = m + 1; n < 6; ++n) {
            const double fn = dot(gradients[n], trial) - k;
            const double mn = dot(gradients[m], flows[n]);
            const double nm = dot(gradients[n], flows[m]);
            const double nn = dot(gradients[n], flows[n]);
            const double determinant = mm * nn - mn * nm;
            if (std::abs(determinant) < 1e-9 * mm * nn)
                continue;
            if (const auto s =
                    accept({m, n}, {(nn * fm - mn * fn) / determinant, (mm * fn - nm * fm) / determinant}))
                return s;
        }
    }
    return {};
}

struct RandomCase
{
    MohrCoulombStrength strength;
    Principal trial;
};

/// Friction 0-45 deg, dilatancy -5 deg up to the friction angle, cohesion 0 in a third of the cases.
RandomCase randomCase(std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(0, 1);
    RandomCase result;
    const double phi = 45 * unit(random);
    result.strength.frictionAngle = (unit(random) < 0.05 ? 0 : phi) * degree;
    result.strength.dilatancyAngle =
        -5 * degree + unit(random) * (result.strength.frictionAngle + 5 * degree);
    result.strength.cohesion = unit(random) < 0.33 ? 0 : 100 * unit(random);
    const double size = std::pow(10, 1 + 3 * unit(random));
    for (double& s : result.trial)
        s = size * (2 * unit(random) - 1.4);
    std::ranges::sort(result.trial, std::greater{});
    return result;
}

TEST(MohrCoulombSurface, agreesWithTheEnumerationOfActivePlanes)
{
    std::mt19937 random(11);
    std::array<int, 4> hits{};
    for (int sample = 0; sample < 100000; ++sample) {
        const RandomCase c = randomCase(random);
        const MohrCoulombSurface surface(elasticity, c.strength);
        const bool fluid = c.strength.frictionAngle == 0 && c.strength.cohesion == 0;
        if (fluid || surface.excess(c.trial[0], c.trial[2]) <= 0)
            continue; // of a fluid's planes only their intersection is left, which no two of them define
        const MohrCoulombSurface::Return result = surface.returned(c.trial);
        const std::optional<Principal> enumerated = koiter(c.trial, c.strength);
        const double scale = std::abs(c.trial[0]) + std::abs(c.trial[2]) + c.strength.cohesion;
        ++hits[static_cast<int>(result.region)];
        for (int k = 0; k < 3; ++k) {
            const double expected = enumerated ? (*enumerated)[k] : surface.apexStress();
            ASSERT_NEAR(result.stress[k], expected, 1e-8 * scale)
                << "trial " << ::testing::PrintToString(c.trial) << " phi "
                << c.strength.frictionAngle / degree << " psi " << c.strength.dilatancyAngle / degree << " c "
                << c.strength.cohesion << " region " << static_cast<int>(result.region);
        }
    }
    for (const int count : hits)
        EXPECT_GE(count, 1000) << "every region is met often enough to mean something";
}

TEST(MohrCoulomb, leavesNoStressBeyondYieldAndNoAdmissibleStressChanged)
{
    std::mt19937 random(13);
    std::uniform_real_distribution<double> unit(0, 1);
    double worstYield = 0;
    double worstChange = 0;
    for (int sample = 0; sample < 100000; ++sample) {
        const RandomCase c = randomCase(random);
        const MohrCoulomb law(elasticity, c.strength);
        const MohrCoulombSurface surface(elasticity, c.strength);
        PointBatch points(law);
        const int hoop = sample % 3;
        setInPlane(points, c.trial[(hoop + 1) % 3], c.trial[(hoop + 2) % 3], std::numbers::pi * unit(random));
        points.stress[2][0] = c.trial[hoop];
        points.update();
        const double radius =
            std::hypot(0.5 * (points.stress[0][0] - points.stress[1][0]), points.stress[3][0]);
        const double mean = 0.5 * (points.stress[0][0] + points.stress[1][0]);
        const double f = surface.yield(std::max(mean + radius, points.stress[2][0]),
                                       std::min(mean - radius, points.stress[2][0]));
        const double reference = std::abs(c.trial[0]) + std::abs(c.trial[2]) + c.strength.cohesion;
        worstYield = std::max(worstYield, f / reference);
        ASSERT_LE(f, 1e-8 * reference) << ::testing::PrintToString(c.trial);

        std::array<double, 4> before{};
        for (int k = 0; k < 4; ++k)
            before[k] = points.stress[k][0];
        points.update();
        for (int k = 0; k < 4; ++k)
            worstChange = std::max(worstChange, std::abs(points.stress[k][0] - before[k]) / reference);
    }
    EXPECT_LE(worstYield, 1e-12);
    EXPECT_LE(worstChange, 1e-15);
}

/// The law returns several points at a time where one of them yields: neighbours must not feel it.
TEST(MohrCoulomb, givesEveryPointOfABatchWhatItGetsAloneAndSaysWhetherSomeYield)
{
    std::mt19937 random(29);
    std::uniform_real_distribution<double> unit(0, 1);
    int elasticBatches = 0;
    for (int sample = 0; sample < 3000; ++sample) {
        MohrCoulombStrength strength = randomCase(random).strength;
        strength.gapClosing = sample % 2 == 0;
        const MohrCoulomb law(elasticity, strength);
        const int size = 1 + sample % 37;
        const double safe = sample % 3 == 0 ? 1 : 0.9; // so that batches without any that yields are met
        PointBatch together(law, size);
        std::vector<PointBatch> alone;
        bool oneYields = false;
        for (int i = 0; i < size; ++i) {
            PointBatch& point = alone.emplace_back(law);
            const double pressure = 10 + 1000 * unit(random);
            for (int k = 0; k < 4; ++k) {
                const bool shears = unit(random) > safe;
                point.stress[k][0] = k < 3 ? -pressure : 0;
                point.strain[k][0] = (shears ? 1e-1 : 1e-6) * (unit(random) - 0.5);
            }
            point.spin[0] = 1e-3 * unit(random);
            point.state[1][0] = strength.gapClosing ? 1e-6 * unit(random) : 0;
            for (int k = 0; k < 4; ++k) {
                together.stress[k][i] = point.stress[k][0];
                together.strain[k][i] = point.strain[k][0];
            }
            together.spin[i] = point.spin[0];
            together.state[1][i] = point.state[1][0];
            oneYields = point.update() || oneYields;
        }
        EXPECT_EQ(together.update(), oneYields) << "batch of " << size << " points";
        elasticBatches += oneYields ? 0 : 1;
        for (int i = 0; i < size; ++i) {
            const std::string where = "point " + std::to_string(i) + " of " + std::to_string(size);
            for (int k = 0; k < 4; ++k) {
                const double expected = alone[i].stress[k][0];
                ASSERT_NEAR(together.stress[k][i], expected, 1e-11 * (1 + std::abs(expected))) << where;
            }
            for (int k = 0; k < 2; ++k) {
                ASSERT_NEAR(together.state[k][i], alone[i].state[k][0], 1e-14) << where;
            }
        }
    }
    EXPECT_GE(elasticBatches, 100);
    EXPECT_LE(elasticBatches, 2900);
}

/// Plastic work of the returned stress. With psi >= 0 it cannot be negative. Contractant flow (psi < 0) takes
/// energy from the tensile tip of a cohesive cone, s1 + s3 > 2 c cos(phi)/(sin(phi) - sin(psi)), by its
/// definition: such stresses are left out.
TEST(MohrCoulombSurface, dissipates)
{
    std::mt19937 random(17);
    const double shear = elasticity.shearModulus();
    const double bulk = elasticity.bulkModulus();
    int tested = 0;
    for (int sample = 0; sample < 100000; ++sample) {
        const RandomCase c = randomCase(random);
        const MohrCoulombSurface surface(elasticity, c.strength);
        if (surface.excess(c.trial[0], c.trial[2]) <= 0)
            continue;
        const Principal s = surface.returned(c.trial).stress;
        const double sinPhi = std::sin(c.strength.frictionAngle);
        const double sinPsi = std::sin(c.strength.dilatancyAngle);
        if (sinPsi < 0 &&
            (s[0] + s[2]) * (sinPhi - sinPsi) >= 2 * c.strength.cohesion * std::cos(c.strength.frictionAngle))
            continue;
        const double taken = (c.trial[0] - s[0] + c.trial[1] - s[1] + c.trial[2] - s[2]) / 3;
        double work = 0;
        for (int k = 0; k < 3; ++k)
            work += s[k] * ((c.trial[k] - s[k] - taken) / (2 * shear) + taken / (3 * bulk));
        const double scale = std::abs(c.trial[0]) + std::abs(c.trial[2]);
        ASSERT_GE(work, -1e-13 * scale * scale / shear)
            << ::testing::PrintToString(c.trial) << " phi " << c.strength.frictionAngle / degree << " psi "
            << c.strength.dilatancyAngle / degree << " c " << c.strength.cohesion;
        ++tested;
    }
    EXPECT_GE(tested, 50000);
}

TEST(MohrCoulombSurface, knowsWhereContractantFlowHasNoUniqueReturn)
{
    EXPECT_TRUE(MohrCoulombSurface(elasticity, {45 * degree, -5 * degree, 0}).wellPosed());
    EXPECT_FALSE(MohrCoulombSurface({60e6, 0.4999}, {45 * degree, -5 * degree, 0}).wellPosed());
    EXPECT_THROW(MohrCoulomb({60e6, 0.4999}, {45 * degree, -5 * degree, 0}), std::invalid_argument);
}

TEST(MohrCoulomb, strengthlessFluidKeepsItsPressureOnly)
{
    const MohrCoulomb law(elasticity, {0, 0, 0});
    PointBatch points(law);
    setInPlane(points, -20, -50, 0.3);
    points.stress[2][0] = -80;
    points.update();
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(points.stress[k][0], -50, 1e-11);
    EXPECT_NEAR(points.stress[3][0], 0, 1e-12);
}

TEST(MohrCoulomb, anOpeningIsForgottenUnlessAskedFor)
{
    const MohrCoulomb law(elasticity, {38 * degree, 1 * degree, 0});
    PointBatch points(law);
    for (const double each : {3e-4, -1e-4}) {
        for (int k = 0; k < 3; ++k)
            points.strain[k][0] = each;
        points.strain[3][0] = 0;
        points.update();
        EXPECT_EQ(points.state[1][0], 0);
    }
    EXPECT_NEAR(points.stress[0][0], -3e-4 * elasticity.bulkModulus(), 1e-12);
}

TEST(MohrCoulomb, anOpeningClosesBeforeItBearsStress)
{
    const MohrCoulomb law(elasticity, {38 * degree, 1 * degree, 0, true});
    PointBatch points(law);
    const auto strain = [&](const double each, const double shear) {
        for (int k = 0; k < 3; ++k)
            points.strain[k][0] = each;
        points.strain[3][0] = shear;
        points.update();
    };
    strain(-1e-4, 0);
    const double pressure = points.stress[0][0];
    EXPECT_NEAR(pressure, -3e-4 * elasticity.bulkModulus(), 1e-12);
    for (int step = 0; step < 10; ++step)
        strain(3e-5, 0); // 3e-4 in all: 2e-4 more than the compression before
    EXPECT_EQ(points.stress[0][0], 0);
    EXPECT_NEAR(points.state[1][0], 6e-4, 1e-15);
    for (int step = 0; step < 19; ++step)
        strain(-1e-5, 1e-7); // closes 1.9e-4, sheared a little
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(points.stress[k][0], 0) << k;
    strain(-1.1e-4, 0);
    EXPECT_NEAR(points.stress[0][0], pressure, 1e-9);
    EXPECT_EQ(points.state[1][0], 0);
}

TEST(MohrCoulomb, aBatchOfAnySizeTreatsEveryPointAlike)
{
    const MohrCoulomb law(elasticity, {38 * degree, 1 * degree, 0});
    constexpr int size = 1000; // more than one chunk, and no multiple of it
    PointBatch all(law, size);
    std::mt19937 random(19);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < size; ++i) {
        for (int k = 0; k < 4; ++k) {
            all.stress[k][i] = k < 3 ? -50 + 50 * unit(random) : 20 * unit(random);
            all.strain[k][i] = 1e-3 * unit(random);
        }
        all.spin[i] = 0.01 * unit(random);
    }
    std::vector<std::array<double, 4>> single(size);
    for (int i = 0; i < size; ++i) {
        PointBatch one(law);
        for (int k = 0; k < 4; ++k) {
            one.stress[k][0] = all.stress[k][i];
            one.strain[k][0] = all.strain[k][i];
        }
        one.spin[0] = all.spin[i];
        one.update();
        for (int k = 0; k < 4; ++k)
            single[i][k] = one.stress[k][0];
    }
    all.update();
    for (int i = 0; i < size; ++i)
        for (int k = 0; k < 4; ++k)
            // the vectorised loop may contract differently from its remainder
            ASSERT_NEAR(all.stress[k][i], single[i][k], 1e-11) << i << ' ' << k;
}

/// Triaxial compression test on one point: the axis is z, the radial and the hoop stress are held by
/// adjusting the lateral strain.
struct Triaxial
{
    double stressRatio = 0;
    double dilationRate = 0; // volumetric per axial strain, compression positive
    double plasticShearPerAxial = 0;
};

Triaxial triaxialCompression(const MohrCoulombStrength& strength)
{
    constexpr double cell = -100;
    const MohrCoulomb law(elasticity, strength);
    PointBatch points(law);
    for (int k = 0; k < 3; ++k)
        points.stress[k][0] = cell;
    constexpr double axialStep = -1e-4;
    double lateralStep = 0;
    Triaxial result;
    for (int step = 0; step < 400; ++step) {
        const PointBatch start = points;
        for (int iteration = 0; iteration < 200; ++iteration) {
            for (int k = 0; k < 3; ++k)
                points.stress[k][0] = start.stress[k][0];
            points.state = start.state;
            points.strain[0][0] = points.strain[2][0] = lateralStep;
            points.strain[1][0] = axialStep;
            points.update();
            const double residual = points.stress[0][0] - cell;
            if (std::abs(residual) < 1e-12)
                break;
            lateralStep -= residual / (2 * elasticity.pWaveModulus());
        }
        result.stressRatio = points.stress[1][0] / points.stress[0][0];
        result.dilationRate = (2 * lateralStep + axialStep) / axialStep;
        result.plasticShearPerAxial = (points.state[0][0] - start.state[0][0]) / std::abs(axialStep);
    }
    return result;
}

TEST(MohrCoulomb, triaxialCompressionReachesTheStressRatioAndDilationOfTheory)
{
    const Triaxial sand = triaxialCompression({38 * degree, 1 * degree, 0});
    EXPECT_NEAR(sand.stressRatio, 4.203745842795, 1e-10); // (1 + sin 38)/(1 - sin 38)
    const double sinPsi = std::sin(1 * degree);
    EXPECT_NEAR(sand.dilationRate, -2 * sinPsi / (1 - sinPsi), 1e-9);
    EXPECT_NEAR(sand.dilationRate, -0.035525, 5e-7);
    // Deviatoric plastic strain of the definition: 2/3 |d eps_axial - d eps_radial|.
    const double radial = -(1 - sand.dilationRate) / 2;
    EXPECT_NEAR(sand.plasticShearPerAxial, 2.0 / 3 * (1 - radial), 1e-8);
}

TEST(Tresca, triaxialCompressionReachesTwiceTheUndrainedStrength)
{
    const Triaxial clay = triaxialCompression({0, 0, 50});
    EXPECT_NEAR(clay.stressRatio, 2, 1e-10); // (100 + 2 x 50)/100
    EXPECT_NEAR(clay.dilationRate, 0, 1e-9);
}

TEST(MohrCoulomb, cyclesDissipateAndElasticOnesDoNot)
{
    const MohrCoulomb law(elasticity, {38 * degree, 0, 5}); // dilatancy would lock the volume
    for (const double amplitude : {1e-5, 5e-3}) {
        PointBatch points(law);
        points.stress[0][0] = points.stress[2][0] = -50;
        points.stress[1][0] = -100;
        double work = 0;
        constexpr int steps = 100;
        for (int cycle = 0; cycle < 1000; ++cycle)
            for (int step = 0; step < steps; ++step) {
                const double from = amplitude * std::sin(2 * std::numbers::pi * step / steps);
                const double to = amplitude * std::sin(2 * std::numbers::pi * (step + 1) / steps);
                points.strain[3][0] = to - from;
                const double before = points.stress[3][0];
                points.update();
                work += 0.5 * (before + points.stress[3][0]) * points.strain[3][0];
            }
        if (amplitude < 1e-4) {
            EXPECT_EQ(points.state[0][0], 0);
            EXPECT_LE(std::abs(points.stress[3][0]), 1e-10);
            EXPECT_LE(std::abs(work), 1e-10);
        } else {
            EXPECT_GT(points.state[0][0], 1);
            EXPECT_GT(work, 0);
        }
    }
}

} // namespace
} // namespace caisson::testing
