#pragma once

#include "mesh/MeshMotion.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace caisson {

/// Which rows and columns of a mesh of rectangles become one where they leave the place that they are fine
/// for: system/coarsenMeshDict.
struct Coarsening
{
    double aspectRatio = 2;                                ///< three cells merge that are longer than this
    std::optional<std::array<double, 2>> rowsMergeOutside; ///< these radii [m]; none: rows stay
    std::optional<double> columnsMergeBelow;               ///< this level [m]; none: columns stay
    std::vector<double> keptLevels;                        ///< lines of the mesh that stay lines [m]
    SourceLocation whereLevels;                            ///< of those in the dictionary
    MeshMotion motion;                                     ///< its levels are kept
    DisplacementRange displacements; ///< of its moving zone: heights are the greatest of these
};

/// Keys of system/coarsenMeshDict.
std::span<const Keyword> coarsenMeshKeywords();

/// Reads system/coarsenMeshDict.
Coarsening readCoarsening(const Dictionary& coarsenMeshDict, MeshMotion motion, InputProblems& problems);

/// A coarser mesh of the same body: away from the given radii three rows become one, further out three of
/// those again, and below the given level three columns. In the column (or row) before, four cells lead from
/// three to one:
///
///     L3 ------------ R1
///      |           /   |
///     L2 ----- B       |
///      |       |       |      A and B half-way, at the heights of L1 and L2
///     L1 ----- A       |
///      |           \   |
///     L0 ------------ R0
///
/// (refinement by thirds [Schneiders 1996]); all are convex, and stay so when rows are stretched. Patches,
/// zones and the planes of the layer stay. A mesh that is no grid of rectangles is a problem.
PolyMesh coarsened(const PolyMesh& polyMesh, const Coarsening& coarsening, InputProblems& problems);

} // namespace caisson
