#pragma once

#include "installation/Caisson.h"

namespace caisson {

/// How much of the soil that the wall displaces goes into the plug, and how much the plug swells.
struct PlugHeaveShares
{
    double inwardByWeight = 0.5; ///< share of the wall's volume that moves inwards without suction
    double inwardBySuction = 1;  ///< and under suction
    double expansion = 0;        ///< swelling of the plug per length penetrated under suction
};

/// Mean rise of the plug's surface at penetration h [m]: inward share * [(Do/Di)^2 - 1] per length, plus the
/// swelling; `byWeight` [m] of h were penetrated without suction.
double plugHeave(const Caisson& caisson, const PlugHeaveShares& shares, double h, double byWeight);

/// Penetration at which the heaved plug meets the lid [m]; larger than the skirt length where it never does.
/// @param lidHeight  of the lid's underside above the tip [m]
double lidContactPenetration(const Caisson& caisson, const PlugHeaveShares& shares, double byWeight,
                             double lidHeight);

} // namespace caisson
