#pragma once

#include "timeStepping/Scene.h"

#include <memory>
#include <string>

namespace caisson {

/// Sums over the scene, for logs and checks. Per radian (axisymmetric) or per metre.
struct Energies
{
    double kinetic = 0;       ///< of the soil with its true mass [J]
    double kineticScaled = 0; ///< with scaled inertia [J]
    double mass = 0, volume = 0;
    std::array<double, 2> momentum{};
};
Energies sumEnergies(const State& state);

/// What limits the time step.
struct StableStep
{
    double step = 0;                ///< [s]
    int cell = -1;                  ///< the cell that limits it
    double waveSpeed = 0, size = 0; ///< there [m/s], [m]
};

/// Counts of cells by how they are treated now.
struct CellCounts
{
    int fem = 0, filled = 0, partial = 0, empty = 0, inside = 0;
};

/// One explicit step of the whole scene; the only thing that changes a State.
class TimeStep
{
public:
    virtual ~TimeStep() = default;
    virtual void advance(State& state, double dt) = 0;
    /// Largest stable step [s] for the mesh and points as they are.
    [[nodiscard]] virtual StableStep stableStep(const State& state) const = 0;
    /// Rebuilds what is not state (order of the points, lists) from the state: at the start and after every
    /// write, so that a restart sees the same.
    virtual void rebuild(State& state) = 0;
    /// Loads drained soil and bodies with the excess pore pressures of the nodes [Pa], until new ones come.
    virtual void setSeepage(const State& state, const std::vector<double>& excess) = 0;
    [[nodiscard]] virtual CellCounts cellCounts(const State& state) const = 0;
    [[nodiscard]] virtual std::string description() const = 0; ///< of the kernel chosen, for the log
    /// Velocity of the soil at the nodes of the mesh [m/s], mapped from the points; for output.
    [[nodiscard]] virtual std::vector<std::array<double, 2>> nodalVelocities(const State& state) const = 0;
    /// Pore pressure at the nodes [Pa]: the mean of the points round each, or that of quasi-steady seepage;
    /// zero where there is none.
    [[nodiscard]] virtual std::vector<double> nodalPressures(const State& state) const = 0;
    /// Standard deviation of the cells' excess pore pressures from the means of their nodes, over that of the
    /// pressures; 0 where there are none. A checkerboard has 1, a smooth field O(h^2).
    [[nodiscard]] virtual double checkerboardIndex(const State& state) const = 0;
};

/// Chooses the compiled kernel for a scene (geometry, kind of cells) and prepares the state.
/// @throws InputError where bodies do not fit the mesh or points lie outside it
std::unique_ptr<TimeStep> makeTimeStep(const Scene& scene, State& state);

} // namespace caisson
