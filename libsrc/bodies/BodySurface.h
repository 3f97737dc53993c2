#pragma once

#include "bodies/RigidBody.h"
#include "mesh/BackgroundMesh.h"

namespace caisson {

/// A node of the background mesh on the surface of a body, with soil cells on one side of it and void cells
/// (inside the body) on the other.
struct SurfaceNode
{
    int node;
    int faces = 1; ///< 1, or 2 at a corner: [0] is the tip face, [1] the skirt face
    std::array<std::array<double, 2>, 2> normal{}; ///< unit, into the soil
    std::array<SurfacePart, 2> part{};
    std::array<double, 2> area{}; ///< share of each face: integral of N r ds [m2/rad], plane: of N ds [m]
    /// Corner of the tip: share of the node's hat function along the tip's level that lies under the tip,
    /// and the next node away from the tip on that level.
    double tipShare = 1;
    int beside = -1;
    std::array<double, 2> roundedNormal{}; ///< there: integral of N n over both faces, as a unit vector
};

/// Contact of one body with the soil at the nodes of the mesh that lie on its surface.
///
/// The mesh conforms to the body: its cells are inside or outside, and soil on either side of a wall shares
/// no node across it. Contact is a condition on known nodes: no penetration, separation allowed, Coulomb
/// friction and adhesion [Bardenhagen, Brackbill & Sulsky 2000, Bardenhagen et al. 2001, for a rigid body].
///
/// Corner of the tip: the hat function of the corner node reaches one cell h beyond the tip, so a node
/// that simply moves with the body (`full`) makes the tip act with a width of t + h: the flux of soil pushed
/// down is not that of the tip. `shared` centres the velocity jump between tip and neighbouring soil on the
/// corner: the node takes at least w V + (1 - w) v_beside downward, w the share of its hat function under the
/// tip and v_beside the soil's velocity at the next node, so that the swept volume is the tip's own at any
/// cell size. `rounded` (the default) lets the soil slip along the surface of a tip rounded over that cell:
/// the normal is the integral of N n over both faces.
struct BodySurface
{
    /// A side of a soil cell on the surface: its two nodes (indices into `nodes`) and their faces.
    struct Edge
    {
        std::array<int, 2> node, face;
    };

    std::vector<SurfaceNode> nodes;
    std::vector<Edge> edges;
    std::vector<unsigned char> voidCell; ///< per cell of the mesh: inside the body
};

/// Finds the void cells and the surface nodes of a body in a mesh that conforms to it.
/// A face of the body that cuts through cells becomes a problem that names the face and the nearest line.
BodySurface findBodySurface(const RigidBody& body, const BackgroundMesh& mesh, InputProblems& problems);

/// Sets the areas of the faces at the nodes for the mesh as it is now.
void updateAreas(BodySurface& surface, const BackgroundMesh& mesh);

/// Nearest place outside the body, `clearance` [m] off its nearest face, for a place inside.
std::array<double, 2> pushOut(const RigidBody& body, double r, double z, double clearance);

} // namespace caisson
