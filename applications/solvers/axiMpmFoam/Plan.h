#pragma once

#include "case/Log.h"
#include "case/RunTime.h"
#include "timeStepping/TimeStep.h"

namespace caisson {

/// Prints what will be run: cells, points, mass, stable step and what limits it, the kernel.
void printPlan(Log& log, const ControlDict& control, const Scene& scene, const State& state,
               const TimeStep& step);

/// Times a few steps (on the state given, which is then no longer the start) and prints the steps, the time
/// and the disk that the run will take.
void timeSteps(Log& log, const ControlDict& control, const RunTime& runTime, const Scene& scene, State& state,
               TimeStep& step);

} // namespace caisson
