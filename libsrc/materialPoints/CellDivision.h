#pragma once

#include "mesh/BackgroundMesh.h"

#include <array>
#include <vector>

namespace caisson {

/// How a background cell is divided into sub-cells, one for each material point.
struct CellDivision
{
    /// quadrilaterals: sub-cells in the direction of r and in that of z, uniform in the cell's coordinates
    std::array<int, 2> along = {2, 2};
    /// triangles: sub-triangles per side, all alike ...
    int split = 1;
    /// ... and points in each: 1, 3 (the parts next to the corners, bounded by the lines from the centre to
    /// the middles of the sides) or 6 (the triangles that the medians make)
    int pattern = 3;
};

/// The sub-cell of a material point.
struct SubCell
{
    double r, z;            ///< place of the point [m]: the sub-cell's centre of volume
    double volume;          ///< [m3/rad] or [m2], exact
    double lowest, highest; ///< extent of the sub-cell in z [m]
};

/// Triangles: the division into `points`, or nothing where that number is not 1, 3 or 6 times a square.
bool divideTriangle(int points, CellDivision& division);

/// The finer of two divisions: quadrilaterals in each direction, triangles in the number of points.
CellDivision finer(const CellDivision& one, const CellDivision& other);

/// `division` with as many more sub-cells as keep the points' spacing in the directions of r and z within
/// `maxSpacing` [m].
CellDivision refined(const BackgroundMesh& mesh, int cell, CellDivision division,
                     const std::array<double, 2>& maxSpacing);

/// The sub-cells of a cell. Their volumes add up to cellVolume() but for the rounding of the sum.
std::vector<SubCell> subdivide(const BackgroundMesh& mesh, int cell, const CellDivision& division);

/// Volume of a polygon (counter-clockwise) given relative to (baseR, any z): the exact integral of r over it
/// per radian [m3/rad], or its area [m2] in plane strain.
double polygonVolume(Geometry geometry, double baseR, const std::vector<std::array<double, 2>>& offsets);

} // namespace caisson
