#pragma once

#include "mesh/BackgroundMesh.h"

namespace caisson {

/// The mesh with two triangles in the place of each quadrilateral. Diagonals alternate from cell to cell, so
/// that none of the two directions is stiffer than the other; nodes, patches, zones and the planes of the
/// layer stay. A mesh of triangles is a problem.
PolyMesh triangulated(const PolyMesh& polyMesh, InputProblems& problems);

} // namespace caisson
