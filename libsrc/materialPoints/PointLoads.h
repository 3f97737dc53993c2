#pragma once

#include "function1/Function1.h"
#include "materialPoints/MaterialPoints.h"
#include "materialPoints/PointVector.h"
#include "materialPoints/SeedRegions.h"

namespace caisson {

/// A load on material points, of constant/pointLoads. Each loaded point keeps the index of its load and an
/// area of its own (MaterialPoints::load, loadArea).
struct PointLoad
{
    enum class Type { traction, pressure, force, expression };
    std::string name;
    Type type = Type::traction;
    std::array<double, 2> direction{}; ///< of a pressure: unit vector (r z)
    /// traction [Pa], pressure [Pa] in component 0, or force [N] ([N/m] in plane strain) of all its points,
    /// of time [s]
    VectorFunction1 value;
    PointVector expression;   ///< traction [Pa] of each of its points, in place of value
    bool areaFollows = false; ///< axisymmetry: the areas grow with r of the surface over its initial r

    /// Force over area (r z) [Pa].
    /// @param area  of all points of the load, round the whole axis [m2] (or [m]); a force is shared by it
    [[nodiscard]] std::array<double, 2> traction(double time, double area) const;
};

std::vector<std::string> pointLoadTypes();
/// Keywords of a load of the given type, for reading and the user guide.
std::vector<Keyword> pointLoadKeywords(const std::string& type);
/// Reads `cavity { type pressure; direction (1 0 0); uniformValue table ((0 0) (1 5e4)); }` ...
std::vector<PointLoad> readPointLoads(const Dictionary& loads, Geometry geometry, InputProblems& problems);

/// A surface whose points a load acts on, of system/setMaterialPointsDict.
struct LoadedSurface
{
    enum class Face { top, bottom, inner, outer, any, all };
    SeedRegion region; ///< shape and place alone
    int load = 0;      ///< index into constant/pointLoads
    Face face = Face::any;
    double area = 0; ///< of all its points [m2] ([m] in plane strain); 0: as the mesh has it
};

/// What loadPoints() came to.
struct LoadedPoints
{
    std::size_t points = 0;
    double area = 0; ///< [m2/rad] or [m]
};

std::vector<Keyword> loadedSurfaceKeywords(const std::string& regionType);
/// Reads `loadedPoints ( { load cavity; type box; min (1 0); max (1.1 1); face inner; } ... );`.
std::vector<LoadedSurface> readLoadedSurfaces(const std::vector<Dictionary>& surfaces,
                                              const BackgroundMesh& mesh, const std::vector<PointLoad>& loads,
                                              InputProblems& problems);

/// Gives points their loads. The surface of the soil are the sides between cells with points and cells
/// without; those that look towards the face (to within 45 degrees) and belong to points in the region are
/// shared out among the points next to them. With face `all` every point in the region
/// carries a share of the area by its volume.
/// A surface that catches no point becomes a problem, and so does a point with two loads.
/// @returns one per surface
std::vector<LoadedPoints> loadPoints(MaterialPoints& points, const BackgroundMesh& mesh,
                                     const std::vector<LoadedSurface>& surfaces, InputProblems& problems);

/// Area of each load's points round the whole axis [m2], or per metre [m]; summed by id, so that it does not
/// depend on the order of the points.
std::vector<double> loadedAreas(const MaterialPoints& points, std::size_t loads, Geometry geometry);

} // namespace caisson
