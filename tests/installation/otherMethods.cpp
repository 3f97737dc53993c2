#include "installation/ConeResistance.h"
#include "installation/HoulsbyByrneClay.h"
#include "installation/PlugHeave.h"
#include "installation/PrescribedSuction.h"
#include "installation/Seepage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace caisson {
namespace {

HoulsbyByrneClaySoil clay(const double alpha)
{
    const DepthProfile strength({0, 100}, {0, 150e3});
    const DepthProfile adhesion({0, 100}, {0, alpha * 150e3});
    return {DepthProfile(6e3), strength, adhesion, adhesion, 9, 1};
}

TEST(HoulsbyByrneClay, matchesTheRegressionNumbers)
{
    const HoulsbyByrneClay method({5, 0.05, 10, 300e3}, clay(0.6));
    constexpr std::array<std::array<double, 2>, 5> resistance{
        {{2, 86.307}, {4, 284.581}, {6, 594.821}, {8, 1017.028}, {10, 1551.201}}};
    for (const auto& [h, r] : resistance)
        EXPECT_NEAR(method.resistance(h, 0).total() / (r * 1e3), 1, 1e-5) << h;
    constexpr std::array<std::array<double, 2>, 3> suction{{{6, 15.015}, {8, 36.518}, {10, 63.723}}};
    for (const auto& [h, s] : suction)
        EXPECT_NEAR(method.suction(h), s * 1e3, 0.6) << h; // printed to 1 Pa
    EXPECT_NEAR(method.limits(10).reverseBearing / 170.235e3, 1, 1e-5);
    EXPECT_EQ(method.suction(4), 0);
    EXPECT_NEAR(method.resistance(method.selfWeightPenetration(), 0).total() / 300e3, 1, 1e-12);
}

/// Without weight and wall: h/D = Nc/(4 alpha) su2/su1 (1 - 1/(1 + 2 f h/D)^2) [Houlsby & Byrne 2005].
TEST(HoulsbyByrneClay, stopsAtTheDepthOfTheory)
{
    constexpr double alpha = 0.9;
    double ratio = 5; // h/D, su2/su1 = 2 for a strength from zero
    for (int i = 0; i < 100; ++i)
        ratio = 9 / (4 * alpha) * 2 * (1 - std::pow(1 + 2 * ratio, -2));
    HoulsbyByrneClaySoil soil = clay(alpha);
    const HoulsbyByrneClay method({5, 1e-7, 100, 0}, soil);
    const double h = 5 * ratio;
    EXPECT_NO_THROW((void)method.suction(0.999 * h));
    EXPECT_THROW((void)method.suction(1.001 * h), SuctionLimitReached);
}

TEST(HoulsbyByrneClay, takesLayers)
{
    HoulsbyByrneClaySoil soil = clay(0.6);
    soil.undrainedShearStrength = DepthProfile({0, 3, 3, 10}, {10e3, 10e3, 30e3, 30e3});
    soil.adhesionStressInside = DepthProfile({0, 3, 3, 10}, {5e3, 5e3, 9e3, 9e3});
    soil.adhesionStressOutside = soil.adhesionStressInside;
    const HoulsbyByrneClay method({5, 0.05, 10, 0}, soil);
    EXPECT_NEAR(method.resistance(5, 0).outside, (3 * 5e3 + 2 * 9e3) * std::numbers::pi * 5, 1e-6);
    EXPECT_NEAR(method.resistance(2.999, 0).tip / (std::numbers::pi * 4.95 * 0.05), 6e3 * 2.999 + 9 * 10e3,
                1e-6);
    EXPECT_NEAR(method.resistance(3.001, 0).tip / (std::numbers::pi * 4.95 * 0.05), 6e3 * 3.001 + 9 * 30e3,
                1e-6);
}

TEST(ConeResistance, integratesTheProfile)
{
    // qc = 2 MPa/m, kp = 0.3, kf = 0.001
    const ConeResistance method({5, 0.05, 5, 1e6}, {DepthProfile({0, 10}, {0, 0.3 * 20e6}),
                                                    DepthProfile({0, 10}, {0, 0.001 * 20e6}), 0});
    const Resistance r = method.resistance(4, 0);
    EXPECT_NEAR(r.outside, 0.001 * 2e6 * 8 * std::numbers::pi * 5, 1e-6);
    EXPECT_NEAR(r.inside, 0.001 * 2e6 * 8 * std::numbers::pi * 4.9, 1e-6);
    EXPECT_NEAR(r.tip, 0.3 * 8e6 * std::numbers::pi * 4.95 * 0.05, 1e-6);
    EXPECT_NEAR(method.suction(4), (r.total() - 1e6) / (std::numbers::pi / 4 * 4.9 * 4.9), 1e-6);
}

TEST(CriticalSuction, formulasMeetTheSeepageSolutionAndTheirLimits)
{
    const auto sendersRandolph = [](const double x) {
        return criticalSuctionFactor(CriticalSuction::sendersRandolph, x);
    };
    EXPECT_NEAR(sendersRandolph(1e-12), std::numbers::pi, 1e-6); // sheet pile
    EXPECT_NEAR(sendersRandolph(1e12), 1, 1e-6);                 // long column
    constexpr std::array<std::array<double, 3>, 4> table{
        {{0.1, 2.303, 2.347}, {0.5, 1.472, 1.570}, {1, 1.269, 1.320}, {1.5, 1.192, 1.193}}};
    for (const auto& [x, senders, feld] : table) {
        EXPECT_NEAR(sendersRandolph(x), senders, 6e-4);
        EXPECT_NEAR(criticalSuctionFactor(CriticalSuction::feld, x), feld, 6e-4);
        EXPECT_NEAR(sendersRandolph(x) / exitGradientFactor(x), 1, 0.042);
    }
}

TEST(CriticalSuction, methodHasItsClosedFormAndStopsAtTheCriticalSuction)
{
    const Caisson caisson{5, 0.05, 5, 500e3};
    const ConeResistanceSoil soil{DepthProfile({0, 10}, {0, 0.2 * 40e6}),
                                  DepthProfile({0, 10}, {0, 0.002 * 40e6}), 10.5e3};
    const CriticalSuctionMethod method(caisson, soil, CriticalSuction::sendersRandolph);
    constexpr double h = 4;
    const Resistance r = method.resistance(h, 0);
    const double critical = 10.5e3 * h * criticalSuctionFactor(CriticalSuction::sendersRandolph, h / 5);
    const double closed =
        (r.total() - caisson.submergedWeight) / (caisson.plugArea() + (r.inside + r.tip) / critical);
    EXPECT_NEAR(method.suction(h) / closed, 1, 1e-12);
    EXPECT_EQ(method.resistance(h, critical).tip, 0);
    EXPECT_NEAR(method.resistance(h, critical).outside, r.outside, 1e-9);

    const CriticalSuctionMethod hard(caisson, {DepthProfile(10e6), DepthProfile(0.3e6), 10.5e3},
                                     CriticalSuction::feld);
    EXPECT_THROW((void)hard.suction(h), SuctionLimitReached);
}

TEST(CriticalSuction, frictionFactorIsThatOfAnOpenPile)
{
    const Caisson caisson{5, 0.05, 5, 0};
    EXPECT_NEAR(openPileFrictionFactor(caisson, 0.021, std::atan(0.5)),
                0.021 * std::pow(1 - 0.98 * 0.98, 0.3) * 0.5, 1e-15);
}

TEST(PrescribedSuction, isTheTableAndEndsWithIt)
{
    const PrescribedSuction method({5, 0.05, 5, 0}, 10.5e3, {0, 0.5, 0.8}, {0, 0.4, 0.8});
    EXPECT_EQ(method.suction(0), 0);
    EXPECT_NEAR(method.suction(1.25), 0.2 * 10.5e3 * 5, 1e-9);
    EXPECT_NEAR(method.suction(4), 0.8 * 10.5e3 * 5, 1e-9);
    EXPECT_THROW((void)method.suction(4.1), std::out_of_range);
    EXPECT_THROW(PrescribedSuction({5, 0.05, 5, 0}, 10.5e3, {0, 0.5}, {0, -0.4}), std::invalid_argument);
    EXPECT_THROW(PrescribedSuction({5, 0.05, 5, 0}, 10.5e3, {0, 0}, {0, 1}), std::invalid_argument);
}

TEST(DepthProfile, interpolatesAndIntegratesWithStepsAndEnds)
{
    const DepthProfile profile({1, 2, 2, 4}, {3, 5, 1, 2});
    EXPECT_EQ(profile.value(0), 3);
    EXPECT_EQ(profile.value(1.5), 4);
    EXPECT_EQ(profile.value(2), 1);
    EXPECT_EQ(profile.valueAbove(2), 5);
    EXPECT_EQ(profile.valueAbove(1), 3);
    EXPECT_EQ(profile.valueAbove(3), 1.5);
    EXPECT_EQ(profile.value(3), 1.5);
    EXPECT_EQ(profile.value(9), 2);
    EXPECT_EQ(profile.integral(0.5), 1.5);
    EXPECT_EQ(profile.integral(2), 3 + 4);
    EXPECT_EQ(profile.integral(4), 3 + 4 + 3);
    EXPECT_EQ(profile.integral(5), 3 + 4 + 3 + 2);
    EXPECT_THROW(DepthProfile({1, 0}, {1, 1}), std::invalid_argument);
    EXPECT_THROW(DepthProfile({1, 2}, {1}), std::invalid_argument);
    EXPECT_THROW(DepthProfile({}, {}), std::invalid_argument);
}

TEST(PlugHeave, isTheVolumeOfTheWall)
{
    const Caisson caisson{5, 0.05, 5, 0};
    // t/D 1 %: 0.0412 f per metre
    EXPECT_NEAR(plugHeave(caisson, {1, 1, 0}, 1, 0), 0.0412, 5e-5);
    EXPECT_NEAR(plugHeave(caisson, {0.5, 1, 0}, 1, 1), 0.0206, 5e-5);
    EXPECT_NEAR(plugHeave(caisson, {0.5, 1, 0.02}, 3, 1), 0.0206 + 2 * 0.0612, 2e-4);
}

TEST(PlugHeave, meetsTheLidWhereRiseAndPenetrationFillTheCaisson)
{
    const Caisson caisson{5, 0.05, 5, 0};
    for (const double byWeight : {0.0, 1.4, 5.0})
        for (const double lid : {4.0, 5.0}) {
            const PlugHeaveShares shares{0.5, 1, 0.01};
            const double h = lidContactPenetration(caisson, shares, byWeight, lid);
            EXPECT_NEAR(h + plugHeave(caisson, shares, h, byWeight), lid, 1e-12);
        }
    EXPECT_NEAR(lidContactPenetration(caisson, {0.5, 1, 0}, 1.4, 5) / 5, 0.966, 5e-4);
}

} // namespace
} // namespace caisson
