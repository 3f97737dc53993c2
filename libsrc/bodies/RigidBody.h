#pragma once

#include "function1/Function1.h"
#include "mesh/BackgroundMesh.h"

#include <string>
#include <utility>
#include <vector>

namespace caisson {

/// Part of a body's surface, for the split of its reaction.
enum class SurfacePart { tip, inner, outer, lid };

/// A rigid body of revolution (axisymmetric) or prism (plane strain), given by its profile in (r, z) relative
/// to its lowest point, moving vertically.
struct RigidBody
{
    std::string name;
    /// closed polygon, counter-clockwise, z = 0 at the tip [m]
    std::vector<std::array<double, 2>> profile;
    double tipLevel = 0;        ///< z of the lowest point now [m]
    double initialTipLevel = 0; ///< ... at the start of the simulation [m]
    double velocity = 0;        ///< upward positive [m/s]

    double friction = 0; ///< coefficient of the interface [-]
    double adhesion = 0; ///< [Pa]

    enum class Variable { time, penetration };
    Variable variable = Variable::time;
    std::shared_ptr<const Function1> penetrationRate; ///< downward positive [m/s] against `variable`
    double ramp = 0;    ///< time over which the rate rises from rest [s]
    double reference = 0; ///< length that depths are normalised with in output (the skirt length) [m]

    [[nodiscard]] double penetration(double surfaceLevel) const { return surfaceLevel - tipLevel; }
    /// Whether (r, z) is inside the body now (strictly, by more than `tolerance` [m]).
    [[nodiscard]] bool contains(double r, double z, double tolerance) const;
};

/// Reads constant/bodies: one sub-dictionary per body.
std::vector<RigidBody> readBodies(const Dictionary& bodies, InputProblems& problems);

} // namespace caisson
