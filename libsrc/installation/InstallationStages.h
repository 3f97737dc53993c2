#pragma once

#include "installation/InstallationMethod.h"
#include "installation/PlugHeave.h"

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace caisson {

/// The sea and the pump's side of an installation.
struct InstallationSite
{
    double waterDepth = 0;               ///< above the lid or the pump, whichever is higher [m]
    double waterUnitWeight = 9810;       ///< [N/m3]
    double waterViscosity = 1e-3;        ///< dynamic [Pa s]
    double atmosphericPressure = 101325; ///< absolute [Pa]
    double vapourPressure = 2000;        ///< absolute [Pa]
    double intrinsicPermeability = 0;    ///< of the sand outside the plug [m2]; 0 where unknown
    double permeabilityRatio = 1;        ///< plug/outside
    PlugHeaveShares plug;
    double lidHeight = std::numeric_limits<double>::infinity(); ///< lid's underside above the tip [m]

    /// At which the water under the lid boils: p_atm + gamma_w * depth - p_vapour [Pa].
    [[nodiscard]] double cavitationSuction() const;
};

/// The caisson at one penetration. What is not known is NaN.
struct InstallationStage
{
    double penetration = 0;  ///< [m]
    Resistance jacking;      ///< without suction [N]
    Resistance underSuction; ///< [N]
    double suction = 0;      ///< [Pa]
    SuctionLimits limits;    ///< [Pa]
    double seepageFlow = 0;  ///< into the caisson [m3/s]
    double pumpFlow = 0;     ///< seepage and the water that the plug displaces [m3/s]
    double plugHeave = 0;    ///< [m]
};

/// The stage at penetration h.
/// @param jacked  driven by an outside force: the suction is zero
/// @param byWeight  penetration reached without suction [m], for the heave of the plug
/// @param rate  of penetration as a function of it [m/s]; may be empty
/// @throws SuctionLimitReached where the method has no suction, or one beyond liquefaction or cavitation;
///   std::out_of_range as the method does
InstallationStage installationStage(const InstallationMethod& method, const InstallationSite& site, double h,
                                    bool jacked, double byWeight,
                                    const std::function<double(double)>& rate = {});

/// Deepest penetration up to which suction brings the caisson, between 0 and `deepest` [m].
double greatestPenetration(const InstallationMethod& method, const InstallationSite& site, double deepest);

} // namespace caisson
