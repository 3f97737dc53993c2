#pragma once

#include "installation/DepthProfile.h"
#include "installation/InstallationMethod.h"

namespace caisson {

/// Clay in layers: profiles may step from layer to layer.
struct HoulsbyByrneClaySoil
{
    DepthProfile effectiveUnitWeight;    ///< [N/m3]
    DepthProfile undrainedShearStrength; ///< [Pa]
    DepthProfile adhesionStressInside;   ///< adhesion factor * undrained shear strength [Pa]
    DepthProfile adhesionStressOutside;  ///< [Pa]
    double bearingFactorNc = 9;
    double loadSpread = 1; ///< f of the annulus outside that bears the friction, in the plug's failure
};

/// Installation in clay [Houlsby & Byrne 2005, Proc. ICE Geotech. Eng. 158(2):75]:
/// V' + s pi Di^2/4 = adhesion inside and outside + (gamma' h - s + Nc su) pi D t.
class HoulsbyByrneClay final : public InstallationMethod
{
public:
    /// @throws std::invalid_argument for values that cannot be
    HoulsbyByrneClay(const Caisson& caisson, HoulsbyByrneClaySoil soil);

    [[nodiscard]] Resistance resistance(double h, double suction) const override;
    /// Only reverseBearing: the plug is lifted, Nc su + 4 adhesion inside h/Di - the outside friction's
    /// pressure on the annulus Do to Do + 2 f h.
    [[nodiscard]] SuctionLimits limits(double h) const override;
    [[nodiscard]] double greatestSuction(double h) const override { return limits(h).reverseBearing; }
    [[nodiscard]] std::string greatestSuctionName() const override
    {
        return "at which the plug is lifted (reverse end bearing)";
    }

private:
    HoulsbyByrneClaySoil soil_;
};

} // namespace caisson
