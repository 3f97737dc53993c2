#pragma once

namespace caisson {

/// Steady seepage around a caisson in uniform sand, relative penetration x = h/D.

/// Share of the suction that is felt at the tip as excess pore pressure, equal permeability inside and
/// outside: a1 = 0.45 - 0.36 [1 - exp(-x/0.48)] [Houlsby & Byrne 2005 (sand), eq. 32].
double porePressureFactor(double relativePenetration);

/// The same for a plug of another permeability, k_inside/k_outside: a1 k / (1 - a1 + a1 k) [eq. 33].
double porePressureFactor(double relativePenetration, double permeabilityRatio);

/// Critical suction formulas: suction that makes the sand of the plug flow.
enum class CriticalSuction {
    /// gamma' h {pi - arctan[5 (h/D)^0.85] (2 - 2/pi)} [Senders & Randolph 2009]
    sendersRandolph,
    /// gamma' D 1.32 (h/D)^0.75 [Feld 2001]
    feld,
};
/// Critical suction over (effective unit weight * h) at the relative penetration h/D.
double criticalSuctionFactor(CriticalSuction formula, double relativePenetration);

/// Suction over (effective unit weight * h) at which the upward gradient at the plug's surface beside the
/// wall is critical, from finite-volume solutions of the seepage (equal permeability, thin skirt, boundaries
/// at 20 D) for h/D 0.05 to 1.5. Between them and beyond, the correction to the formula of Senders &
/// Randolph, at most 4 %, is interpolated; it vanishes towards a sheet pile (pi) and a long column (1).
double exitGradientFactor(double relativePenetration);

/// Flow into the caisson over (k_outside D s / unit weight of water), from the same solutions for h/D 0.2 to
/// 1; beyond, continued with the resistance of the plug. A plug of another permeability changes the plug's
/// part of the resistance, 4 h/(pi D).
double seepageFlowFactor(double relativePenetration, double permeabilityRatio);

} // namespace caisson
