#pragma once

#include "Drive.h"

#include <vector>

namespace caisson::stability {

struct LongRun
{
    std::string name;
    /// @param share  of the full length, in (0, 1]
    /// @returns what became of it; the remark has the figures
    std::function<Outcome(double share)> run;
};

std::vector<LongRun> longRuns();

} // namespace caisson::stability
