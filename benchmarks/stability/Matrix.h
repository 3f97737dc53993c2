#pragma once

#include "Drive.h"

#include <vector>

namespace caisson::stability {

/// One square of the map.
struct Case
{
    std::string sweep, value, kernel;
    /// Beyond what the code promises, as a step above the limit: to stop with a message is then as good as to
    /// hold.
    bool mayStop = false;
    bool quick = false; ///< part of the tests
    std::function<Outcome()> run;

    /// Whether an outcome is as it has to be.
    [[nodiscard]] bool content(const Outcome& outcome) const
    {
        return outcome.verdict == Verdict::holds ||
               (mayStop && (outcome.verdict == Verdict::stopped || outcome.verdict == Verdict::refused));
    }
};

/// All squares.
std::vector<Case> stabilityMatrix();

} // namespace caisson::stability
