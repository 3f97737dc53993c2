#pragma once

#include "function1/Function1.h"
#include "mesh/BackgroundMesh.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace caisson {

/// Part of a body's surface, for the split of its reaction.
enum class SurfacePart { tip, inner, outer, lid };
inline constexpr int surfaceParts = 4;

/// How the corner between tip and skirt face pushes the soil (see BodySurface.h).
enum class TipCorner { full, shared, rounded };

/// One straight piece of a body's profile.
struct ProfileEdge
{
    std::array<double, 2> from, to; ///< relative to the lowest point of the body [m]
    std::array<double, 2> normal;   ///< unit, out of the body (into the soil)
    SurfacePart part;
};

/// A rigid body of revolution (axisymmetric) or prism (plane strain), given by its profile in (r, z) relative
/// to its lowest point, moving vertically at a prescribed rate, or under loads against the soil's reaction.
struct RigidBody
{
    std::string name;
    std::vector<ProfileEdge> profile; ///< closed polygon, counter-clockwise, z = 0 at the tip
    double tipLevel = 0;              ///< z of the lowest point now [m]
    double initialTipLevel = 0;       ///< ... where the mesh of constant/polyMesh has it [m]
    double velocity = 0;              ///< vertical, upward positive [m/s]
    double surfaceLevel = 0;          ///< z that penetration is measured from [m]

    double friction = 0; ///< coefficient of the interface [-]
    double adhesion = 0; ///< [Pa]
    TipCorner tipCorner = TipCorner::rounded;

    enum class Variable { time, penetration };
    Variable variable = Variable::time;
    std::shared_ptr<const Function1> penetrationRate; ///< downward positive [m/s]; none: at rest
    double ramp = 0; ///< time over which the rate, or the weight, rises from rest [s]

    bool loadControlled = false;           ///< the loads below drive it, and penetrationRate does not
    double submergedWeight = 0;            ///< of the whole body [N], or per metre in plane strain
    double mass = 0;                       ///< its inertia, likewise [kg]
    std::shared_ptr<const Function1> load; ///< downward besides its weight, of time [N]; none: zero
    /// A loaded body is at rest, and the run ends, where it moves less than restPenetration [m] in restTime
    /// [s]; 0: it goes on.
    double restTime = 0, restPenetration = 0;
    bool stopAtLid = true;      ///< whether the run ends where the soil meets the lid
    double referenceLength = 0; ///< length that depths are normalised with in output (the skirt length) [m]

    [[nodiscard]] double penetration() const { return surfaceLevel - tipLevel; }
    /// Prescribed velocity (upward positive) at a time [s] and the present penetration.
    [[nodiscard]] double prescribedVelocity(double time) const;
    [[nodiscard]] bool moves() const { return loadControlled || penetrationRate != nullptr; }
    /// Weight and load at a time [N], downward positive; the weight sets in over the ramp.
    [[nodiscard]] double drivingLoad(double time) const;
    /// Radius of the space that the body encloses: of its inner face; 0 where it has none [m].
    [[nodiscard]] double innerRadius() const;
    /// Cross-section of that space [m2], or its width from the plane of symmetry [m].
    [[nodiscard]] double enclosedArea(bool axisymmetric) const
    {
        return axisymmetric ? M_PI * innerRadius() * innerRadius() : innerRadius();
    }
    /// Whether (r, z) is inside the body now.
    [[nodiscard]] bool contains(double r, double z) const;
};

/// The closed polygon (counter-clockwise, any reference height) as profile edges relative to its lowest
/// point; parts by normal: downward tip, towards the axis inner, away from it outer, upward lid.
std::vector<ProfileEdge> profileFromPolygon(std::vector<std::array<double, 2>> polygon);

/// Skirt of a caisson: rectangle between the inner and the outer radius, with a lid where `lidHeight` > 0
/// (height of the lid's lower face above the tip).
std::vector<ProfileEdge> caissonProfile(double outerRadius, double wallThickness, double skirtLength,
                                        double lidHeight, double lidThickness);

/// Reads constant/bodies: one sub-dictionary per body.
std::vector<RigidBody> readBodies(const Dictionary& bodies, InputProblems& problems);

/// Keywords of a body of the given shape word (caisson, polygon), for reading and the user guide.
std::vector<Keyword> bodyKeywords(const std::string& shape);
std::vector<std::string> bodyShapes();

} // namespace caisson
