#pragma once

#include "timeStepping/Scene.h"

namespace caisson {

/// Reads system/mpmSolution.
SolutionControls readSolutionControls(const Dictionary& mpmSolution, bool triangles, InputProblems& problems);

/// Its table, for the user guide.
std::span<const Keyword> solutionKeywords();

} // namespace caisson
