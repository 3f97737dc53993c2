#pragma once

#include "installation/InstallationMethod.h"

namespace caisson {

/// exp(x) - 1 - x without loss of digits for small x.
double expLessLinear(double x);

/// Bearing factor exp(pi tan(phi)) tan^2(45 + phi/2) of surcharge [Prandtl, Reissner]; phi in radians.
double bearingFactorNq(double frictionAngle);

/// Formulas for the bearing factor of the soil's own weight; there is no agreed one.
enum class NgammaFormula {
    vesic,    ///< 2 (Nq + 1) tan(phi)
    hansen,   ///< 1.5 (Nq - 1) tan(phi)
    meyerhof, ///< (Nq - 1) tan(1.4 phi)
    eurocode7 ///< 2 (Nq - 1) tan(phi)
};
double bearingFactorNgamma(double frictionAngle, NgammaFormula formula);

/// How the skirt's friction adds to the vertical stress beside it.
enum class StressEnhancement {
    none,       ///< not at all
    uniform,    ///< inside over the whole plug, outside over an annulus out to annulusRatio * outerDiameter
    loadSpread, ///< over annuli that widen with depth by loadSpreadInside and loadSpreadOutside per side
};

/// Bearing stress under the tip.
enum class TipRule {
    /// Rising from both edges of the rim, so that the soil flows to the side of less stress.
    full,
    /// Inside stress * Nq + half of the rim's width in the Ngamma term.
    simpleInner,
};

struct HoulsbyByrneSandSoil
{
    double effectiveUnitWeight = 0; ///< [N/m3]
    double bearingFactorNq = 0;
    double bearingFactorNgamma = 0;
    double sideFactorInside = 0;  ///< K tan(delta)
    double sideFactorOutside = 0; ///< K tan(delta)
    StressEnhancement enhancement = StressEnhancement::none;
    double annulusRatio = 0;      ///< m > 1, for uniform
    double loadSpreadInside = 0;  ///< f, for loadSpread
    double loadSpreadOutside = 0; ///< f, for loadSpread
    TipRule tipRule = TipRule::full;
    double permeabilityRatio = 1; ///< inside/outside
};

/// Installation in uniform sand [Houlsby & Byrne 2005, Proc. ICE Geotech. Eng. 158(3):135].
///
/// V' + s pi Di^2/4 = outside + inside friction + tip, with the effective unit weight gamma' + a s/h outside
/// and gamma' - (1-a) s/h inside the caisson, a = porePressureFactor(h/D) with the mean diameter. The
/// vertical stress beside the skirt, d sigma/dz = gamma' + sigma/Z, grows by friction: Z = Di/(4 K
/// tan(delta)) inside, Do (m^2-1)/(4 K tan(delta)) outside.
class HoulsbyByrneSand final : public InstallationMethod
{
public:
    /// @throws std::invalid_argument for values that cannot be: weights and factors not positive, m <= 1,
    ///   K tan(delta) >= f (the stress is then infinite at once)
    HoulsbyByrneSand(const Caisson& caisson, const HoulsbyByrneSandSoil& soil);

    [[nodiscard]] Resistance resistance(double h, double suction) const override;
    [[nodiscard]] SuctionLimits limits(double h) const override;
    [[nodiscard]] double greatestSuction(double h) const override { return limits(h).liquefaction; }
    [[nodiscard]] std::string greatestSuctionName() const override;
    /// As the base class; the vertical stresses, which do not depend on the suction, are found once.
    [[nodiscard]] double suction(double h) const override;
    [[nodiscard]] double porePressureShare(double h) const; ///< a at penetration h

private:
    /// Vertical stress at depth h and its integral from the surface, for unit weight 1.
    struct Stress
    {
        double atDepth;
        double integral;
    };
    struct Stresses
    {
        Stress outside, inside;
    };
    [[nodiscard]] Stresses unitStresses(double h) const;
    [[nodiscard]] Resistance resistance(double h, double suction, const Stresses& unit) const;
    [[nodiscard]] double tipStress(double outside, double inside) const;

    HoulsbyByrneSandSoil soil_;
};

} // namespace caisson
