#pragma once

#include "bodies/RigidBody.h"

#include <string>
#include <vector>

namespace caisson {

/// Water pressure on the free surfaces of two-phase soil: the void above the soil, in empty and partly filled
/// cells, holds water of the pressure rho_w g (level - z) + pressure. It loads the soil (both phases) there
/// with exactly the integral that the cells use for the pore pressure, so that soil whose pore pressure is
/// that of the void feels nothing, wherever its points are.
struct FreeSurface
{
    /// Which voids: all, those inside a body (the plug of a caisson) or outside it.
    enum class Region { all, inside, outside };
    enum class Variable { time, penetration };

    std::string name;
    Region region = Region::all;
    std::string body;                          ///< for inside and outside
    double level = 0;                          ///< where the hydrostatic part is zero [m]
    std::shared_ptr<const Function1> pressure; ///< added to it [Pa]; suction is negative
    /// A pump that takes water out of a closed void [m3/s or m2/s, whole body of revolution], of time; the
    /// pressure follows from what the soil and the body leave of the void: compliance dp/dt = inflow - flow.
    std::shared_ptr<const Function1> pumpFlow;
    /// Seepage that leaves the soil through a covered surface [m3/s or m2/s, likewise], of time; 0 is
    /// impermeable. Water of one pressure stands below the cover: compliance dp/dt = seepage - seepageFlow.
    std::shared_ptr<const Function1> seepageFlow;
    [[nodiscard]] bool givesFlow() const { return pumpFlow || seepageFlow; }
    double compliance = 0;              ///< volume of water that a pressure takes up [m3/Pa or m2/Pa]
    double sealedFrom = 0;              ///< time until which a given flow is not yet one [s]
    Variable variable = Variable::time; ///< of `pressure` [s], or penetration of `body` [m]
};

/// The free surface that voids at a radius belong to: index of the first that holds, or -1.
int freeSurfaceAt(const std::vector<FreeSurface>& surfaces, const std::vector<RigidBody>& bodies,
                  double radius);

/// Whether a radius is that of a body's wall, over which there is neither inside nor outside: soil that is
/// level with the top of a wall has the pressures of its two sides.
bool overWall(const std::vector<RigidBody>& bodies, double radius);

/// Pressure on a free surface less its hydrostatic part rho_w g_z z [Pa].
/// @param unitWeight  of the liquid along z, rho_w g_z: negative [N/m3]
double excessPressure(const FreeSurface& surface, const std::vector<RigidBody>& bodies, double time,
                      double unitWeight);

/// Reads `freeSurfaces { plug { region inside; body caisson; ... } ... }` of 0/p.
/// @param bodies  names of the bodies of the case
std::vector<FreeSurface> readFreeSurfaces(const Dictionary& freeSurfaces,
                                          const std::vector<std::string>& bodies, InputProblems& problems);

/// Keys of one free surface.
std::span<const Keyword> freeSurfaceKeywords();

} // namespace caisson
