#pragma once

#include "mesh/BackgroundMesh.h"

#include <array>
#include <optional>

namespace caisson {

/// A wrong orientation: what is seen, and the commands that put it right.
struct OrientationProblem
{
    std::string message;
    std::string hint;
};

/// Checks the directions of the two planes that a one-layer mesh lies between: wedge planes meet in an axis
/// along z and lie symmetric about y = 0 on the side of positive x, empty planes are normal to y.
/// @param first, second  unit normals out of the mesh
std::optional<OrientationProblem> checkOrientation(Geometry geometry, const std::array<double, 3>& first,
                                                   const std::array<double, 3>& second);

} // namespace caisson
