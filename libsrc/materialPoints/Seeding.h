#pragma once

#include "materialPoints/MaterialPoints.h"
#include "materialPoints/SeedRegions.h"

#include <functional>

namespace caisson {

/// What filling a region came to. Volumes and masses per radian (axisymmetric) or per metre (plane strain).
struct SeededRegion
{
    std::size_t points = 0;
    double volume = 0;          ///< of the points [m3/rad] or [m2]
    double mass = 0;            ///< of the points [kg/rad] or [kg/m]
    double exactVolume = 0;     ///< of the region within the mesh, without the bodies' cells
    double coveredVolume = 0;   ///< of the sub-cells with their centre in the region: error of its cut cells
    std::size_t emptyCells = 0; ///< that the region reaches into, but no region has a point in
};

/// Levels between which a material lies, with the extent of the points' sub-cells [m].
struct MaterialExtent
{
    double lowest, highest;           ///< of the sub-cells
    double lowestPoint, highestPoint; ///< of the points
};

struct SeededPoints
{
    MaterialPoints points;              ///< ascending by cell; stress zero
    std::vector<SeededRegion> regions;  ///< one per region
    std::vector<MaterialExtent> extent; ///< one per material; lowest > highest where it has no points
};

/// Fills the mesh with material points, one in each sub-cell whose centre lies in a region; where regions
/// overlap the later one wins. The mass is that of inertialDensity().
/// @param insideBody  cells with their centre in a body, and points within one, stay empty; may be empty
/// Regions that catch no point become problems.
SeededPoints seedPoints(const BackgroundMesh& mesh, const std::vector<SeedRegion>& regions,
                        const std::vector<Material>& materials,
                        const std::function<bool(double, double)>& insideBody, InputProblems& problems);

} // namespace caisson
