#pragma once

#include "boundary/LiquidConditions.h"
#include "mesh/BackgroundMesh.h"

namespace caisson {

/// The conditions on the pore liquid of all patches, resolved for the nodes of a mesh whose boundary moves
/// along itself alone.
class LiquidBoundary
{
public:
    LiquidBoundary() = default;
    /// The axis (nodes at r = 0 of an axisymmetric mesh) is impermeable without being asked.
    LiquidBoundary(const BackgroundMesh& mesh, std::map<std::string, PatchPressure>&& patches);

    /// A node with one or two directions along which the liquid's flow relative to the solid is given.
    struct Node
    {
        int node;
        int directions = 1;
        std::array<std::array<double, 2>, 2> normal{}; ///< unit, into the soil
        std::array<const PatchPressure*, 2> flux{};    ///< nullptr: none, impermeable
    };
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

    /// Nodes of the patches that give a pressure, each as often as it has edges there.
    [[nodiscard]] std::vector<int> openNodes(const BackgroundMesh& mesh) const;
    /// Adds the forces on the mixture [N/rad or N/m] of the given pressures, less the hydrostatic part
    /// rho_w g_z z [Pa] at the place.
    void addPressures(const BackgroundMesh& mesh, double time, double unitWeight,
                      std::vector<std::array<double, 2>>& force) const;
    /// Adds what prescribed fluxes feed in at the nodes [m3/s/rad or m2/s].
    void addInflows(const BackgroundMesh& mesh, double time, std::vector<double>& inflow) const;
    /// Sets the given pressures, less the hydrostatic part, at the nodes of their patches.
    void setPressures(const BackgroundMesh& mesh, double time, double unitWeight,
                      std::vector<double>& excessPressure) const;
    /// Per node: the patch, an index of the mesh's, whose pressure or flux lets water through there, or -1;
    /// of two the first.
    [[nodiscard]] std::vector<int> openPatches(const BackgroundMesh& mesh) const;
    [[nodiscard]] bool hasPressures() const { return !open_.empty(); }

private:
    std::map<std::string, std::shared_ptr<const PatchPressure>> patches_;
    std::vector<Node> nodes_;
    std::vector<std::pair<int, std::shared_ptr<const PatchPressure>>> fed_;  ///< likewise, with a flux
    std::vector<std::pair<int, std::shared_ptr<const PatchPressure>>> open_; ///< patch of the mesh, condition
};

} // namespace caisson
