#pragma once

#include "function1/Function1.h"
#include "mesh/BackgroundMesh.h"

#include <map>

namespace caisson {

/// What one patch of 0/U asks of the solid's velocity. Types and their keys:
/// - fixedValue: all components given; `value uniform (x y z)`
/// - uniformFixedValue: all components given as a Function1 of time; `uniformValue`
/// - slip, symmetryPlane: no velocity normal to the patch (roller), tangential free
/// - zeroGradient: free
/// - traction: traction vector on the edges [Pa], Function1 of time; `uniformValue`
/// - pressure: pressure [Pa], normal into the soil, Function1 of time; `uniformValue`
/// - wedge, empty: the planes of the 2-D model
struct PatchVelocity
{
    enum class Kind { free, fixed, slip, traction, pressure };
    Kind kind = Kind::free;
    VectorFunction1 value; ///< velocity [m/s] or traction [Pa]; pressure in component 0
};

/// Conditions of all patches of the mesh by name, and the values at the start of the internal field (ignored:
/// nodal velocities follow from the material points).
std::map<std::string, PatchVelocity> readPatchVelocities(const Dictionary& fieldU, const BackgroundMesh& mesh,
                                                         const std::vector<std::string>& constraintPatches,
                                                         InputProblems& problems);
std::vector<std::string> patchVelocityTypes();

/// The conditions resolved for the nodes of a mesh.
class VelocityConditions
{
public:
    VelocityConditions() = default;
    /// The axis (nodes at r = 0 of an axisymmetric mesh) is held radially without being asked.
    VelocityConditions(const BackgroundMesh& mesh, std::map<std::string, PatchVelocity>&& patches);

    /// A node whose velocity is given, wholly or along one direction.
    struct Node
    {
        int node;
        bool fixed;                     ///< both components
        std::array<double, 2> normal{}; ///< direction held, where not fixed
        const VectorFunction1* value;   ///< nullptr: zero
    };
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

    /// Adds the forces of tractions and pressures [N/rad or N/m] at the time to the nodal forces.
    void addTractions(const BackgroundMesh& mesh, double time,
                      std::vector<std::array<double, 2>>& force) const;
    [[nodiscard]] bool hasTractions() const { return !loaded_.empty(); }

private:
    std::map<std::string, std::shared_ptr<const PatchVelocity>> patches_;
    std::vector<Node> nodes_;
    std::vector<std::pair<int, std::shared_ptr<const PatchVelocity>>>
        loaded_; ///< patch of the mesh, condition
};

} // namespace caisson
