#pragma once

#include "fem/Seepage.h"
#include "timeStepping/Scene.h"

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
SeepageScene seepageScene(const Scene& scene, const State& state, bool compressibleSkeleton);

/// Pore pressure of the points [Pa] in steady seepage.
/// @throws InputError where a part of the soil has no given pressure
std::vector<double> steadyPorePressure(const Scene& scene, const State& state);

} // namespace caisson
