#pragma once

#include "Scenes.h"

#include <vector>

namespace caisson::stability {

/// A scene whose true limit is sought, and what was found.
struct Limit
{
    std::string kernel, cells, drag, surface; ///< in words
    Block block;
    double estimate = 0; ///< stableStep() [s]
    double truth = 0;    ///< largest step without growth, by bisection [s]
    [[nodiscard]] double share() const { return estimate / truth; }
};

/// All scenes; `truth` and `estimate` are yet to be found.
std::vector<Limit> limitScenes();

/// Whether small noise grows at this share of the estimate.
bool grows(const Block& block, double share, long steps);

/// Finds the truth to within half a per cent.
void findLimit(Limit& limit);

} // namespace caisson::stability
