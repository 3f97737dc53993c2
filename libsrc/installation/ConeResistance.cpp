#include "installation/ConeResistance.h"

#include <algorithm>
#include <cmath>

namespace caisson {

ConeResistance::ConeResistance(const Caisson& caisson, ConeResistanceSoil soil)
    : InstallationMethod(caisson), soil_(std::move(soil))
{
    for (const DepthProfile* profile : {&soil_.tipResistance, &soil_.frictionResistance})
        if (std::ranges::any_of(profile->values(), [](const double value) { return value < 0; }))
            throw std::invalid_argument("cone resistance and its factors must not be negative");
}

Resistance ConeResistance::resistance(const double h, double /*suction*/) const
{
    const double friction = soil_.frictionResistance.integral(h);
    return {friction * caisson().outerPerimeter(), friction * caisson().innerPerimeter(),
            soil_.tipResistance.value(h) * caisson().tipArea()};
}

SuctionLimits ConeResistance::limits(double /*h*/) const { return {}; }

double openPileFrictionFactor(const Caisson& caisson, const double coefficient,
                              const double interfaceFrictionAngle)
{
    const double ratio = caisson.innerDiameter() / caisson.outerDiameter;
    return coefficient * std::pow(1 - ratio * ratio, 0.3) * std::tan(interfaceFrictionAngle);
}

CriticalSuctionMethod::CriticalSuctionMethod(const Caisson& caisson, ConeResistanceSoil soil,
                                             const CriticalSuction formula)
    : ConeResistance(caisson, std::move(soil)), formula_(formula)
{
    if (!(this->soil().effectiveUnitWeight > 0))
        throw std::invalid_argument("the effective unit weight must be positive");
}

double CriticalSuctionMethod::greatestSuction(const double h) const
{
    return soil().effectiveUnitWeight * h * criticalSuctionFactor(formula_, h / caisson().outerDiameter);
}

Resistance CriticalSuctionMethod::resistance(const double h, const double suction) const
{
    Resistance result = ConeResistance::resistance(h, 0);
    if (suction > 0) {
        const double left = std::max(0.0, 1 - suction / greatestSuction(h));
        result.inside *= left;
        result.tip *= left;
    }
    return result;
}

SuctionLimits CriticalSuctionMethod::limits(const double h) const
{
    SuctionLimits limits;
    limits.exitGradient = greatestSuction(h);
    const double relative = h / caisson().meanDiameter();
    limits.liquefaction = soil().effectiveUnitWeight * h / (1 - porePressureFactor(relative));
    return limits;
}

} // namespace caisson
