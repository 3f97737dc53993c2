#pragma once

#include "timeStepping/Scene.h"

namespace caisson {

/// Steps between two looks at the gates of adapted mass scaling.
inline constexpr int massScalingInterval = 50;

/// Largest factor on the inertia of the soil that keeps, of every body that moves,
///   - the scaled inertia rho v^2 below inertiaGate times the vertical effective stress at its tip: the soil
///     that is pushed aside has to be accelerated, and that is felt as force;
///   - its changes of speed slow against the waves of the scaled soil: they take twenty times the time in
///     which a wave crosses the body's wall;
/// and the scaled kinetic energy below energyGate times the work done. At most massScaling; at least 1; and
/// little more than now, for what is let go at once comes back as waves.
double adaptedMassScaling(const Scene& scene, const State& state);

} // namespace caisson
