#include "installation/HoulsbyByrneClay.h"

#include <algorithm>
#include <cmath>

namespace caisson {
namespace {

bool anyNegative(const DepthProfile& profile)
{
    return std::ranges::any_of(profile.values(), [](const double value) { return value < 0; });
}

} // namespace

HoulsbyByrneClay::HoulsbyByrneClay(const Caisson& caisson, HoulsbyByrneClaySoil soil)
    : InstallationMethod(caisson), soil_(std::move(soil))
{
    if (anyNegative(soil_.effectiveUnitWeight) || anyNegative(soil_.undrainedShearStrength) ||
        anyNegative(soil_.adhesionStressInside) || anyNegative(soil_.adhesionStressOutside))
        throw std::invalid_argument("unit weights and strengths must not be negative");
    if (!(soil_.bearingFactorNc > 0) || !(soil_.loadSpread > 0))
        throw std::invalid_argument("bearing factor and load spread must be positive");
}

Resistance HoulsbyByrneClay::resistance(const double h, const double suction) const
{
    const double tipStress = soil_.effectiveUnitWeight.integral(h) - suction +
                             soil_.bearingFactorNc * soil_.undrainedShearStrength.value(h);
    return {soil_.adhesionStressOutside.integral(h) * caisson().outerPerimeter(),
            soil_.adhesionStressInside.integral(h) * caisson().innerPerimeter(),
            tipStress * caisson().tipArea()};
}

SuctionLimits HoulsbyByrneClay::limits(const double h) const
{
    const double outer = caisson().outerDiameter;
    const double ratio = 1 + 2 * soil_.loadSpread * h / outer;
    const double bearing = soil_.bearingFactorNc * soil_.undrainedShearStrength.value(h);
    const double inside = 4 * soil_.adhesionStressInside.integral(h) / caisson().innerDiameter();
    // outside friction over the annulus pi/4 Do^2 (m^2 - 1)
    const double outside =
        h > 0 ? 4 * soil_.adhesionStressOutside.integral(h) / (outer * (ratio * ratio - 1)) : 0;
    SuctionLimits limits;
    limits.reverseBearing = std::max(0.0, bearing + inside - outside);
    return limits;
}

} // namespace caisson
