#include "installation/HoulsbyByrneSand.h"

#include "installation/Seepage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace caisson {
namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr Caisson referenceCaisson{5, 0.05, 5, 774.392e3};

HoulsbyByrneSandSoil referenceSand()
{
    HoulsbyByrneSandSoil soil;
    soil.effectiveUnitWeight = 10.5e3;
    soil.bearingFactorNq = bearingFactorNq(38 * degree);
    soil.bearingFactorNgamma = bearingFactorNgamma(38 * degree, NgammaFormula::vesic);
    soil.sideFactorInside = soil.sideFactorOutside = 0.30;
    soil.enhancement = StressEnhancement::uniform;
    soil.annulusRatio = 1.5;
    return soil;
}

void expectRelative(const double got, const double expected, const double tolerance, const char* what)
{
    EXPECT_NEAR(got / expected, 1, tolerance) << what << ": expected " << expected << ", got " << got;
}

TEST(HoulsbyByrneSand, matchesTheRegressionNumbers)
{
    struct Row
    {
        double h, outside, inside, tip, total, suction; // m, kN, kPa
    };
    constexpr std::array rows{
        Row{0.75, 14.609, 14.513, 341.343, 370.465, 0},
        Row{1.50, 61.417, 61.893, 721.767, 845.077, 1.9549},
        Row{2.55, 190.682, 196.309, 1346.176, 1733.167, 16.3743},
        Row{4.00, 520.050, 552.842, 2436.040, 3508.932, 36.9012},
        Row{5.00, 874.729, 952.378, 3385.367, 5212.474, 51.5880},
    };
    const HoulsbyByrneSand method(referenceCaisson, referenceSand());
    for (const Row& row : rows) {
        SCOPED_TRACE(row.h);
        const Resistance r = method.resistance(row.h, 0);
        // the numbers are printed to 1 N and 0.1 Pa
        EXPECT_NEAR(r.outside, row.outside * 1e3, std::max(0.5, 1e-5 * row.outside * 1e3));
        EXPECT_NEAR(r.inside, row.inside * 1e3, std::max(0.5, 1e-5 * row.inside * 1e3));
        expectRelative(r.tip, row.tip * 1e3, 1e-5, "tip");
        expectRelative(r.total(), row.total * 1e3, 1e-5, "total");
        if (row.suction > 0)
            EXPECT_NEAR(method.suction(row.h), row.suction * 1e3, std::max(0.06, 1e-5 * row.suction * 1e3));
        else
            EXPECT_EQ(method.suction(row.h), 0);
    }
    expectRelative(method.resistance(1.4, 0).total(), 774.392e3, 1e-6, "weight that jacks to 1.4 m");
    EXPECT_NEAR(method.selfWeightPenetration(), 1.4, 1e-6);
}

TEST(HoulsbyByrneSand, reproducesTheNearlyLinearSuctionOfTheReferenceProblem)
{
    const HoulsbyByrneSand method(referenceCaisson, referenceSand());
    constexpr std::array<std::array<double, 2>, 6> points{
        {{0.3, 0.037}, {0.4, 0.167}, {0.51, 0.312}, {0.6, 0.431}, {0.8, 0.703}, {1.0, 0.983}}};
    for (const auto& [z, s] : points)
        EXPECT_NEAR(method.suction(5 * z) / (10.5e3 * 5), s, 6e-4) << "z/L " << z; // printed to 3 decimals
}

TEST(HoulsbyByrneSand, bearingFactorsHaveTheirPublishedValues)
{
    EXPECT_NEAR(bearingFactorNq(38 * degree), 48.933, 5e-4);
    EXPECT_NEAR(bearingFactorNgamma(38 * degree, NgammaFormula::vesic), 78.02, 5e-3);
    EXPECT_NEAR(bearingFactorNgamma(38 * degree, NgammaFormula::hansen), 56.17, 5e-3);
    EXPECT_NEAR(bearingFactorNgamma(38 * degree, NgammaFormula::meyerhof), 64.07, 5e-3);
    EXPECT_NEAR(bearingFactorNgamma(38 * degree, NgammaFormula::eurocode7), 74.90, 5e-3);
}

TEST(HoulsbyByrneSand, expLessLinearKeepsItsDigitsNearZero)
{
    for (const double x : {1e-8, 1e-5, 1e-4, 9.9e-3})
        EXPECT_NEAR(expLessLinear(x) / (x * x / 2 + x * x * x / 6 + x * x * x * x / 24), 1, 1e-7) << x;
    EXPECT_NEAR(expLessLinear(1e-8), 5e-17, 1e-24);
    EXPECT_NEAR(expLessLinear(0.010001) / expLessLinear(0.009999), std::pow(1.0002, 2), 1e-6);
    EXPECT_DOUBLE_EQ(expLessLinear(1), std::numbers::e - 2);
    EXPECT_EQ(expLessLinear(0), 0);
}

TEST(HoulsbyByrneSand, enhancementVanishesWithTheFriction)
{
    HoulsbyByrneSandSoil plain = referenceSand();
    plain.enhancement = StressEnhancement::none;
    plain.sideFactorInside = plain.sideFactorOutside = 1e-7;
    HoulsbyByrneSandSoil uniform = plain;
    uniform.enhancement = StressEnhancement::uniform;
    HoulsbyByrneSandSoil spread = plain;
    spread.enhancement = StressEnhancement::loadSpread;
    spread.loadSpreadInside = spread.loadSpreadOutside = 1;
    const Resistance a = HoulsbyByrneSand(referenceCaisson, plain).resistance(5, 0);
    // without enhancement: gamma' h^2/2 K tan(delta) pi Do, and (gamma' h Nq + gamma' t/2 Ngamma) pi D t
    EXPECT_NEAR(a.outside, 10.5e3 * 12.5 * 1e-7 * std::numbers::pi * 5, 1e-9);
    EXPECT_NEAR(a.tip,
                (10.5e3 * 5 * plain.bearingFactorNq + 10.5e3 * 0.025 * plain.bearingFactorNgamma) *
                    std::numbers::pi * 4.95 * 0.05,
                1e-6 * a.tip);
    for (const HoulsbyByrneSandSoil& soil : {uniform, spread}) {
        const Resistance b = HoulsbyByrneSand(referenceCaisson, soil).resistance(5, 0);
        EXPECT_NEAR(b.outside / a.outside, 1, 1e-6);
        EXPECT_NEAR(b.inside / a.inside, 1, 1e-6);
        EXPECT_NEAR(b.tip / a.tip, 1, 1e-6);
    }
}

TEST(HoulsbyByrneSand, loadSpreadStartsLinearlyAndEndsInTheFullPlug)
{
    HoulsbyByrneSandSoil soil = referenceSand();
    soil.enhancement = StressEnhancement::loadSpread;
    soil.loadSpreadInside = soil.loadSpreadOutside = 1;
    // Near the surface sigma = gamma' h/(1 - K tan(delta)/f): friction gamma' h^2/2 K tan(delta)/(1 - 0.3)
    constexpr double h = 1e-4;
    const Resistance shallow = HoulsbyByrneSand(referenceCaisson, soil).resistance(h, 0);
    EXPECT_NEAR(shallow.outside / (10.5e3 * h * h / 2 * 0.3 / 0.7 * std::numbers::pi * 5), 1, 1e-4);
    // An immediate spread over everything inside is the full plug of the uniform form.
    soil.loadSpreadInside = 1e7;
    const double spread = HoulsbyByrneSand(referenceCaisson, soil).resistance(5, 0).inside;
    const double uniform = HoulsbyByrneSand(referenceCaisson, referenceSand()).resistance(5, 0).inside;
    EXPECT_NEAR(spread / uniform, 1, 1e-6);
}

TEST(HoulsbyByrneSand, loadSpreadIsRefusedWhereTheStressWouldBeInfinite)
{
    HoulsbyByrneSandSoil soil = referenceSand();
    soil.enhancement = StressEnhancement::loadSpread;
    soil.loadSpreadInside = 1;
    for (const double f : {0.30, 0.2}) {
        soil.loadSpreadOutside = f;
        EXPECT_THROW(HoulsbyByrneSand(referenceCaisson, soil), std::invalid_argument);
    }
    soil.loadSpreadOutside = 0.31;
    EXPECT_NO_THROW(HoulsbyByrneSand(referenceCaisson, soil));
}

/// Two more ways to the tip stress: the closed form of the definition by quadrature, and its limits.
TEST(HoulsbyByrneSand, tipStressIsTheMeanOfThePressuresRisingFromBothEdges)
{
    HoulsbyByrneSandSoil soil = referenceSand();
    soil.permeabilityRatio = 1.5;
    const HoulsbyByrneSand method(referenceCaisson, soil);
    constexpr double h = 3;
    const double a = method.porePressureShare(h);
    const double zi = 4.9 / (4 * 0.3);
    const double zo = 5 * 1.25 / (4 * 0.3);
    for (const double s : {0.0, 1e3, 5e3, 20e3, 35e3}) {
        const double outside = (10.5e3 + a * s / h) * zo * std::expm1(h / zo);
        const double inside = (10.5e3 - (1 - a) * s / h) * zi * std::expm1(h / zi);
        double mean = 0;
        constexpr int points = 100000;
        for (int i = 0; i < points; ++i) {
            const double x = (i + 0.5) * 0.05 / points;
            const double slope = 2 * 10.5e3 * soil.bearingFactorNgamma;
            mean += std::min(outside * soil.bearingFactorNq + slope * x,
                             inside * soil.bearingFactorNq + slope * (0.05 - x)) /
                    points;
        }
        EXPECT_NEAR(method.resistance(h, s).tip / (mean * std::numbers::pi * 4.95 * 0.05), 1, 1e-8) << s;
    }
}

TEST(HoulsbyByrneSand, simpleTipMakesTheSuctionLinear)
{
    HoulsbyByrneSandSoil soil = referenceSand();
    soil.tipRule = TipRule::simpleInner;
    const HoulsbyByrneSand method(referenceCaisson, soil);
    for (const double h : {1.5, 3.0, 5.0}) {
        const double at0 = method.resistance(h, 0).total();
        const double slope = (method.resistance(h, 1e3).total() - at0) / 1e3;
        const double closed =
            (at0 - referenceCaisson.submergedWeight) / (referenceCaisson.plugArea() - slope);
        EXPECT_NEAR(method.suction(h) / closed, 1, 1e-10) << h;
    }
}

TEST(HoulsbyByrneSand, balancesTheForcesAtTheSuctionItReturns)
{
    const HoulsbyByrneSand method(referenceCaisson, referenceSand());
    for (int step = 29; step <= 100; ++step) {
        const double h = 0.05 * step;
        const double s = method.suction(h);
        const double driving = referenceCaisson.submergedWeight + s * referenceCaisson.plugArea();
        EXPECT_NEAR(method.resistance(h, s).total() / driving, 1, 1e-12) << h;
    }
}

TEST(HoulsbyByrneSand, stopsAtLiquefactionWithAReason)
{
    // Without weight, enhancement and wall, h_max = D/(2 K tan(delta)) whatever a [Houlsby & Byrne 2005].
    HoulsbyByrneSandSoil soil = referenceSand();
    soil.enhancement = StressEnhancement::none;
    soil.sideFactorInside = soil.sideFactorOutside = 0.5;
    soil.bearingFactorNq = 1;
    soil.bearingFactorNgamma = 1e-9;
    const Caisson thin{5, 1e-6, 10, 0};
    const HoulsbyByrneSand method(thin, soil);
    EXPECT_NO_THROW((void)method.suction(4.99));
    try {
        (void)method.suction(5.01);
        FAIL() << "expected SuctionLimitReached";
    } catch (const SuctionLimitReached& limit) {
        EXPECT_DOUBLE_EQ(limit.penetration(), 5.01);
        EXPECT_DOUBLE_EQ(limit.limit(), method.limits(5.01).liquefaction);
        EXPECT_NE(std::string(limit.what()).find("liquefies"), std::string::npos);
    }
}

TEST(HoulsbyByrneSand, limitsAreThoseOfTheirDefinitions)
{
    const HoulsbyByrneSand method(referenceCaisson, referenceSand());
    constexpr std::array<std::array<double, 2>, 4> liquefaction{
        {{1e-12, 1.818}, {0.2, 1.487}, {0.5, 1.277}, {1, 1.156}}};
    for (const auto& [x, factor] : liquefaction) {
        const double h = x * referenceCaisson.meanDiameter();
        EXPECT_NEAR(method.limits(h).liquefaction / (10.5e3 * h), factor, 1e-3);
    }
    constexpr double h = 4;
    const double s = method.limits(h).reverseBearing;
    const double a = method.porePressureShare(h);
    const double zi = 4.9 / (4 * 0.3);
    const double zo = 5 * 1.25 / (4 * 0.3);
    const double outside = (10.5e3 + a * s / h) * zo * std::expm1(h / zo);
    const double inside = (10.5e3 - (1 - a) * s / h) * zi * std::expm1(h / zi);
    EXPECT_NEAR(outside / (inside * bearingFactorNq(38 * degree)), 1, 1e-10);
    EXPECT_LT(s, method.limits(h).liquefaction);
    EXPECT_GT(s, 0.9 * method.limits(h).liquefaction);
}

TEST(Seepage, porePressureFactorFollowsFigure4)
{
    EXPECT_NEAR(porePressureFactor(0), 0.450, 1e-4);
    EXPECT_NEAR(porePressureFactor(0.2), 0.3273, 1e-4);
    EXPECT_NEAR(porePressureFactor(0.5), 0.2170, 1e-4);
    EXPECT_NEAR(porePressureFactor(1), 0.1348, 1e-4);
    EXPECT_NEAR(porePressureFactor(0, 5), 0.8036, 1e-4);
    EXPECT_NEAR(porePressureFactor(1, 5), 0.4379, 1e-4);
    EXPECT_NEAR(porePressureFactor(0, 2), 0.6207, 1e-4);
    EXPECT_NEAR(porePressureFactor(1, 2), 0.2376, 1e-4);
}

TEST(Seepage, exitGradientAndFlowMeetTheirTableAndTheirEnds)
{
    EXPECT_NEAR(exitGradientFactor(0), std::numbers::pi, 1e-12); // sheet pile, gradient s/(pi h)
    EXPECT_NEAR(exitGradientFactor(0.5), 1.525, 1e-12);
    EXPECT_NEAR(exitGradientFactor(1), 1.284, 1e-12);
    EXPECT_NEAR(exitGradientFactor(1e6), 1, 1e-5);
    EXPECT_NEAR(seepageFlowFactor(0.2, 1), 1.756, 1e-9);
    EXPECT_NEAR(seepageFlowFactor(0.8, 1), 0.7273, 1e-9);
    EXPECT_NEAR(seepageFlowFactor(1, 1), 0.6117, 1e-9);
    EXPECT_NEAR(seepageFlowFactor(1e3, 1) * 1e3, std::numbers::pi / 4, 1e-3); // Darcy's column
    double previous = seepageFlowFactor(1e-3, 1);
    for (int step = 1; step < 150; ++step) {
        const double x = 2e-3 * std::pow(1.05, step);
        EXPECT_LT(seepageFlowFactor(x, 1), previous) << x;
        EXPECT_GT(seepageFlowFactor(x, 2), seepageFlowFactor(x, 1)) << x;
        previous = seepageFlowFactor(x, 1);
    }
}

} // namespace
} // namespace caisson
