#pragma once

#include "timeStepping/TimeStep.h"

namespace caisson {

/// Ends a run that has blown up: states that are no numbers, points without volume or pores, and points that
/// outrun the waves. Looked for every few steps, which is cheap beside them, and before every write, so that
/// the time directories of a case are good ones.
class StabilityWatch
{
public:
    static constexpr int interval = 50; ///< steps between two looks

    /// After every step.
    /// @param stable   what was stable before the step
    /// @param writing  whether the state is to be written: then it is looked at in any case
    /// @throws InputError that names the first point found, its place, and what is known of the cause
    void afterStep(const Scene& scene, const State& state, const StableStep& stable, bool writing);

    /// Looks now. A step that has ended with an exception can be asked whether instability was its cause.
    void look(const Scene& scene, const State& state, const StableStep& stable);

private:
    static void lookAtBodies(const State& state, const StableStep& stable);

    /// The fastest point of a look that found nothing wrong: where a blow-up may have begun.
    struct Fastest
    {
        int id = -1, cell = -1;
        double r = 0, z = 0, speed = 0;
        long step = 0;
    };
    Fastest last_;
};

} // namespace caisson
