#pragma once

#include "mesh/BackgroundMesh.h"

#include <vector>

namespace caisson::testing {

/// Background mesh of a tensor grid of lines, without files. Cells are quadrilaterals, or triangles (two per
/// rectangle, diagonals alternating). Patches: left (at r[0], unless that is the axis), right, bottom, top.
BackgroundMesh structuredMesh(const std::vector<double>& rLines, const std::vector<double>& zLines,
                              Geometry geometry, bool triangles = false);

/// The polyMesh of a structured mesh: a layer with the patches above and front and back.
PolyMesh layerOf(BackgroundMesh mesh);

/// n equal intervals from a to b.
std::vector<double> evenLines(double a, double b, int n);

} // namespace caisson::testing
