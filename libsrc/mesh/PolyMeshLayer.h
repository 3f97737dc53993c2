#pragma once

#include "mesh/BackgroundMesh.h"

namespace caisson {

/// The polyMesh that the cells of a 2-D mesh make as one layer: a wedge about the z axis, collapsed there, or
/// a slab. Faces come in the order that OpenFOAM wants.
/// @param flat  its geometry, nodes, cells, zones and patches; what joins cells (neighbour, nodeCells,
///              nodePoints) is not read
/// @param frontPatch, backPatch  the patches that the two planes belong to, perhaps one and the same
PolyMesh polyMeshLayer(const BackgroundMesh& flat, int frontPatch, int backPatch);

/// The patches that the front and the back plane of a layer belong to.
std::array<int, 2> planePatches(const PolyMesh& polyMesh, const BackgroundMesh& flat);

} // namespace caisson
