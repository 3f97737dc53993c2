#pragma once

#include "installation/DepthProfile.h"
#include "installation/InstallationMethod.h"
#include "installation/Seepage.h"

namespace caisson {

/// Resistance from the cone resistance qc of a penetration test: tip kp qc, friction kf qc on each face. Both
/// factors may change from layer to layer.
struct ConeResistanceSoil
{
    DepthProfile tipResistance;      ///< kp qc [Pa]
    DepthProfile frictionResistance; ///< kf qc [Pa]
    double effectiveUnitWeight = 0;  ///< [N/m3], for the critical suction; not used by ConeResistance
};

/// Method of kp and kf [DNV Classification Notes 30.4]. The seepage's help is left out: suction is a pressure
/// on the lid and nothing else.
class ConeResistance : public InstallationMethod
{
public:
    /// @throws std::invalid_argument for negative resistances
    ConeResistance(const Caisson& caisson, ConeResistanceSoil soil);
    [[nodiscard]] Resistance resistance(double h, double suction) const override;
    [[nodiscard]] SuctionLimits limits(double h) const override;

protected:
    [[nodiscard]] const ConeResistanceSoil& soil() const { return soil_; }

private:
    ConeResistanceSoil soil_;
};

/// Friction factor kf = C [1 - (Di/Do)^2]^0.3 tan(delta) of an open pile by the UWA-05 method, used for
/// skirts by Senders & Randolph (2009).
double openPileFrictionFactor(const Caisson& caisson, double coefficient, double interfaceFrictionAngle);

/// Cone resistance with the friction inside and the tip resistance falling linearly to zero at the critical
/// suction, V' + s pi Di^2/4 = Fo + (Fi + Qtip)(1 - s/s_cr) [Senders & Randolph 2009, J. Geotech. Geoenviron.
/// Eng. 135(1):14]. With Feld's critical suction the same linear loss is taken.
class CriticalSuctionMethod final : public ConeResistance
{
public:
    /// @throws std::invalid_argument for values that cannot be
    CriticalSuctionMethod(const Caisson& caisson, ConeResistanceSoil soil, CriticalSuction formula);
    [[nodiscard]] Resistance resistance(double h, double suction) const override;
    [[nodiscard]] SuctionLimits limits(double h) const override;
    [[nodiscard]] double greatestSuction(double h) const override;
    [[nodiscard]] std::string greatestSuctionName() const override
    {
        return "the critical suction (the plug turns quick)";
    }

private:
    CriticalSuction formula_;
};

} // namespace caisson
