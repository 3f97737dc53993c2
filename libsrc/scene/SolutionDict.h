#pragma once

#include "timeStepping/Scene.h"

namespace caisson {

/// Reads system/mpmSolution.
SolutionControls readSolutionControls(const Dictionary& mpmSolution, bool triangles, InputProblems& problems);

/// Least time between two records of the monitors [s].
double readMonitorInterval(const Dictionary& mpmSolution);

/// Its table, for the user guide.
std::span<const Keyword> solutionKeywords();

} // namespace caisson
