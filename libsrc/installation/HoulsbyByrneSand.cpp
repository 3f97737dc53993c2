#include "installation/HoulsbyByrneSand.h"

#include "installation/Root.h"
#include "installation/Seepage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace caisson {
namespace {

void require(const bool holds, const char* message)
{
    if (!holds)
        throw std::invalid_argument(message);
}

} // namespace

double expLessLinear(const double x)
{
    if (std::abs(x) > 0.01)
        return std::expm1(x) - x;
    return x * x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6))));
}

double bearingFactorNq(const double frictionAngle)
{
    const double tangent = std::tan(std::numbers::pi / 4 + frictionAngle / 2);
    return std::exp(std::numbers::pi * std::tan(frictionAngle)) * tangent * tangent;
}

double bearingFactorNgamma(const double frictionAngle, const NgammaFormula formula)
{
    const double nq = bearingFactorNq(frictionAngle);
    switch (formula) {
    case NgammaFormula::vesic:
        return 2 * (nq + 1) * std::tan(frictionAngle);
    case NgammaFormula::hansen:
        return 1.5 * (nq - 1) * std::tan(frictionAngle);
    case NgammaFormula::meyerhof:
        return (nq - 1) * std::tan(1.4 * frictionAngle);
    case NgammaFormula::eurocode7:
        break;
    }
    return 2 * (nq - 1) * std::tan(frictionAngle);
}

HoulsbyByrneSand::HoulsbyByrneSand(const Caisson& caisson, const HoulsbyByrneSandSoil& soil)
    : InstallationMethod(caisson), soil_(soil)
{
    require(soil.effectiveUnitWeight > 0, "the effective unit weight must be positive");
    require(soil.bearingFactorNq > 0 && soil.bearingFactorNgamma > 0, "the bearing factors must be positive");
    require(soil.sideFactorInside > 0 && soil.sideFactorOutside > 0, "K tan(delta) must be positive");
    require(soil.permeabilityRatio > 0, "the ratio of permeabilities must be positive");
    require(soil.enhancement != StressEnhancement::uniform || soil.annulusRatio > 1,
            "the enhanced annulus must be wider than the caisson: annulusRatio > 1");
    require(
        soil.enhancement != StressEnhancement::loadSpread ||
            (soil.sideFactorInside < soil.loadSpreadInside &&
             soil.sideFactorOutside < soil.loadSpreadOutside),
        "load spread has no solution unless K tan(delta) < f: the stress would be infinite at the surface");
}

std::string HoulsbyByrneSand::greatestSuctionName() const
{
    return "at which the plug liquefies (no effective stress is left in it)";
}

double HoulsbyByrneSand::porePressureShare(const double h) const
{
    return porePressureFactor(h / caisson().meanDiameter(), soil_.permeabilityRatio);
}

HoulsbyByrneSand::Stresses HoulsbyByrneSand::unitStresses(const double h) const
{
    const double outerDiameter = caisson().outerDiameter;
    const double innerDiameter = caisson().innerDiameter();
    if (soil_.enhancement == StressEnhancement::none)
        return {{h, h * h / 2}, {h, h * h / 2}};

    const double fullPlug = innerDiameter / (4 * soil_.sideFactorInside);
    if (soil_.enhancement == StressEnhancement::uniform) {
        const auto exponential = [h](const double length) -> Stress {
            return {length * std::expm1(h / length), length * length * expLessLinear(h / length)};
        };
        const double m = soil_.annulusRatio;
        return {exponential(outerDiameter * (m * m - 1) / (4 * soil_.sideFactorOutside)),
                exponential(fullPlug)};
    }

    // d sigma/dz = 1 + sigma/Z(z), from sigma = z/(1 - K tan(delta)/f) near the surface, by Runge-Kutta
    // steps.
    const auto integrate = [h](const double linear, const auto& length) -> Stress {
        constexpr int steps = 500;
        const double dz = h / steps;
        const auto slope = [&](const double z, const double stress) {
            return z > 0 ? 1 + stress / length(z) : linear;
        };
        double stress = 0;
        double integral = 0;
        for (int step = 0; step < steps; ++step) {
            const double z = step * dz;
            const double k1 = slope(z, stress);
            const double k2 = slope(z + dz / 2, stress + dz / 2 * k1);
            const double k3 = slope(z + dz / 2, stress + dz / 2 * k2);
            const double k4 = slope(z + dz, stress + dz * k3);
            // the integral is the second unknown of the same scheme: its slopes are the stages' stresses
            integral += dz * (stress + dz / 6 * (k1 + k2 + k3));
            stress += dz / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        return {stress, integral};
    };
    const double sideOutside = soil_.sideFactorOutside;
    const double sideInside = soil_.sideFactorInside;
    const auto outside = [&](const double z) {
        const double ratio = 1 + 2 * soil_.loadSpreadOutside * z / outerDiameter;
        return outerDiameter * (ratio * ratio - 1) / (4 * sideOutside);
    };
    const auto inside = [&](const double z) {
        const double ratio = std::max(0.0, 1 - 2 * soil_.loadSpreadInside * z / innerDiameter);
        return fullPlug * (1 - ratio * ratio);
    };
    return {integrate(1 / (1 - sideOutside / soil_.loadSpreadOutside), outside),
            integrate(1 / (1 - sideInside / soil_.loadSpreadInside), inside)};
}

double HoulsbyByrneSand::tipStress(const double outside, const double inside) const
{
    const double thickness = caisson().wallThickness;
    const double own = soil_.effectiveUnitWeight * soil_.bearingFactorNgamma;
    const double nq = soil_.bearingFactorNq;
    if (soil_.tipRule == TipRule::simpleInner)
        return inside * nq + own * thickness / 2;
    // q = min(outside Nq + 2 gamma' Ngamma x, inside Nq + 2 gamma' Ngamma (t - x)), averaged over the rim; x
    // is the width from which the soil flows to the side of the larger stress.
    const double lesser = std::min(outside, inside);
    const double x = std::max(0.0, thickness / 2 - std::abs(outside - inside) * nq / (4 * own));
    return lesser * nq + own * (thickness - 2 * x * x / thickness);
}

Resistance HoulsbyByrneSand::resistance(const double h, const double suction, const Stresses& unit) const
{
    double weightOutside = soil_.effectiveUnitWeight;
    double weightInside = soil_.effectiveUnitWeight;
    if (suction > 0) {
        const double a = porePressureShare(h);
        weightOutside += a * suction / h;
        weightInside = std::max(0.0, weightInside - (1 - a) * suction / h);
    }
    return {weightOutside * unit.outside.integral * soil_.sideFactorOutside * caisson().outerPerimeter(),
            weightInside * unit.inside.integral * soil_.sideFactorInside * caisson().innerPerimeter(),
            tipStress(weightOutside * unit.outside.atDepth, weightInside * unit.inside.atDepth) *
                caisson().tipArea()};
}

Resistance HoulsbyByrneSand::resistance(const double h, const double suction) const
{
    return resistance(h, suction, unitStresses(h));
}

double HoulsbyByrneSand::suction(const double h) const
{
    const Stresses unit = unitStresses(h);
    return solveSuction(h, [&](const double s) { return resistance(h, s, unit).total(); });
}

SuctionLimits HoulsbyByrneSand::limits(const double h) const
{
    const double a = porePressureShare(h);
    const double weight = soil_.effectiveUnitWeight * h;
    SuctionLimits limits;
    limits.liquefaction = weight / (1 - a);
    limits.exitGradient = weight * exitGradientFactor(h / caisson().meanDiameter());
    // outside stress = Nq * inside stress, both linear in the suction
    const Stresses unit = unitStresses(h);
    const double inside = soil_.bearingFactorNq * unit.inside.atDepth;
    const double outside = unit.outside.atDepth;
    limits.reverseBearing =
        h > 0 ? std::max(0.0, weight * (inside - outside) / (a * outside + (1 - a) * inside)) : 0;
    return limits;
}

} // namespace caisson
