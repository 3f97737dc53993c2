#pragma once

#include <cmath>
#include <limits>

namespace caisson {

/// Where an increasing function passes through zero between `low` and `high`, to rounding: the Illinois form
/// of false position (exact at once for linear functions), with a bisection wherever that is slower.
/// Outside the bracket the nearer end is returned.
template <class Function>
double increasingRoot(const Function& function, double low, double high)
{
    double atLow = function(low);
    double atHigh = function(high);
    if (atLow >= 0)
        return low;
    if (atHigh <= 0)
        return high;
    constexpr double epsilon = 4 * std::numeric_limits<double>::epsilon();
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double width = high - low;
        if (width <= epsilon * (std::abs(low) + std::abs(high)))
            break;
        double at = iteration % 3 == 2 ? 0.5 * (low + high) : low - atLow * width / (atHigh - atLow);
        if (!(at > low && at < high))
            at = 0.5 * (low + high);
        const double value = function(at);
        if (value == 0)
            return at;
        if (value < 0) {
            low = at;
            atLow = value;
            atHigh *= 0.5;
        } else {
            high = at;
            atHigh = value;
            atLow *= 0.5;
        }
    }
    return 0.5 * (low + high);
}

} // namespace caisson
