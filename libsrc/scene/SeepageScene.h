#pragma once

#include "fem/Seepage.h"
#include "timeStepping/Scene.h"

#include <optional>

namespace caisson {

/// Seepage through the soil of a two-phase scene as its points are now: where it is, how permeable, and what
/// patches and free surfaces give.
struct SeepageScene
{
    std::vector<unsigned char> soil;           ///< per cell: holds points
    std::vector<double> conductivity, storage; ///< per cell, see Seepage
    std::vector<double> given, inflow;         ///< per node
    std::vector<unsigned char> insideSurface,
        outsideSurface; ///< per node: free surface within, beyond the body
};

/// Keys of system/seepageDict.
std::span<const Keyword> seepageKeywords();

/// @param compressibleSkeleton  whether the storage holds that of the skeleton in one dimension, 1/M, too
/// @param surfaceLevel  where given, all cells below it that are no body's are soil, and those without points
///                      like their neighbours; else the cells that hold points are
SeepageScene seepageScene(const Scene& scene, const State& state, bool compressibleSkeleton,
                          std::optional<double> surfaceLevel = {});

/// Surfaces of the bodies in the mesh as it is now; found where constant/polyMesh has them, as the step does.
/// @throws InputError where a body does not fit the mesh
std::vector<BodySurface> surfacesOfBodies(const Scene& scene, const State& state);

/// Puts the first body, and the mesh that follows it, where it has the penetration [m], and finds the points
/// in the mesh again. The soil stays: points may be in the body then.
/// @throws InputError where there is no body, or the mesh cannot follow it
void placeBody(const Scene& scene, State& state, double penetration);

/// Pore pressure of the points [Pa] in steady seepage.
/// @throws InputError where a part of the soil has no given pressure
std::vector<double> steadyPorePressure(const Scene& scene, const State& state);

} // namespace caisson
