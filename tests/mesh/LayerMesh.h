#pragma once

#include "mesh/BackgroundMesh.h"

#include <functional>

namespace caisson::testing {

/// Name of the patch of a boundary side, by the place of its middle.
using PatchOfSide = std::function<std::string(double r, double z)>;

/// The polyMesh that the cells of a 2-D mesh (its r, z, cellNodes, corners, geometry) make as one layer: a
/// wedge of `wedgeHalfAngle` about the z axis, collapsed there, or a slab of `halfThickness`. Side patches in
/// the order of `patches`, then front and back.
PolyMesh layerMesh(BackgroundMesh flat, const std::vector<std::string>& patches,
                   const PatchOfSide& patchOfSide);

/// left, right, bottom, top of a rectangle [lowR, highR] x [lowZ, highZ].
PatchOfSide rectanglePatches(double lowR, double highR, double lowZ, double highZ);

} // namespace caisson::testing
