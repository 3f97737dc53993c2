#pragma once

#include "scene/SeepageScene.h"
#include "timeStepping/TimeStep.h"

#include <string>

namespace caisson {

/// Quasi-steady seepage beside drained soil: the pore pressures are those of steady flow between free
/// surfaces and patches as they are now, and load the soil with their gradient. What storage and the change
/// of the pores' volume would add is left out, and measured: the pressure that drives their flow through the
/// soil.
class QuasiSteadySeepage
{
public:
    explicit QuasiSteadySeepage(const Scene& scene);

    /// Loads `step` with seepage where a body has gone on by seepageInterval, or a pressure has changed by
    /// one per cent, since the last solution, or where `anew` (at the start and after every write, so that a
    /// restart sees the same).
    /// @returns whether it did
    /// @throws InputError where a part of the soil has no given pressure
    bool update(const State& state, TimeStep& step, bool anew);

    /// Largest pressure that is left out, over the largest difference of the given ones, as last measured
    /// [-].
    [[nodiscard]] double leftOut() const { return leftOut_; }
    /// A line for the log.
    [[nodiscard]] std::string report() const;

private:
    [[nodiscard]] bool movedOn(const State& state) const;
    void solve(const State& state);
    [[nodiscard]] std::vector<double> surfacePressures(const State& state) const;
    void measure(const State& state, const Seepage& seepage, const SeepageScene& setup);

    const Scene& scene_;
    std::vector<double> penetrations_, pressures_; ///< of bodies and free surfaces at the last solution
    std::vector<double> excess_;                   ///< per node, of the last solution [Pa]
    std::vector<double> volumes_;                  ///< per point (by id) when last measured [m3/rad or m2]
    std::vector<double> measuredExcess_;           ///< per node, then
    double measuredTime_ = 0;
    double share_ = 0; ///< of the pressures that has set in
    double difference_ = 0, leftOutPressure_ = 0, leftOut_ = 0;
    long solutions_ = 0;
};

} // namespace caisson
