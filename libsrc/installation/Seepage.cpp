#include "installation/Seepage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace caisson {
namespace {

template <std::size_t n>
double interpolate(const std::array<double, n>& x, const std::array<double, n>& y, const double at)
{
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
    const auto i = static_cast<std::size_t>(above - x.begin());
    return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

} // namespace

double porePressureFactor(const double relativePenetration)
{
    return 0.45 - 0.36 * (1 - std::exp(-relativePenetration / 0.48));
}

double porePressureFactor(const double relativePenetration, const double permeabilityRatio)
{
    const double a1 = porePressureFactor(relativePenetration);
    return a1 * permeabilityRatio / (1 - a1 + a1 * permeabilityRatio);
}

double criticalSuctionFactor(const CriticalSuction formula, const double relativePenetration)
{
    constexpr double pi = std::numbers::pi;
    if (formula == CriticalSuction::feld)
        return 1.32 * std::pow(relativePenetration, -0.25);
    return pi - std::atan(5 * std::pow(relativePenetration, 0.85)) * (2 - 2 / pi);
}

double exitGradientFactor(const double relativePenetration)
{
    constexpr std::array x{0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.0, 1.5, 10.0};
    constexpr std::array computed{0.0, 2.614, 2.322, 1.976, 1.766, 1.525, 1.348, 1.284, 1.193, 0.0};
    std::array<double, x.size()> correction{};
    correction.front() = correction.back() = 1;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        correction[i] = computed[i] / criticalSuctionFactor(CriticalSuction::sendersRandolph, x[i]);
    return criticalSuctionFactor(CriticalSuction::sendersRandolph, relativePenetration) *
           interpolate(x, correction, std::min(relativePenetration, x.back()));
}

double seepageFlowFactor(const double relativePenetration, const double permeabilityRatio)
{
    constexpr std::array x{0.2, 0.4, 0.6, 0.8, 1.0};
    constexpr std::array flow{1.756, 1.181, 0.8985, 0.7273, 0.6117};
    // Resistance 1/F = plug + soil below and outside; the second varies slowly.
    constexpr double plug = 4 / std::numbers::pi;
    std::array<double, x.size()> outside{};
    for (std::size_t i = 0; i < x.size(); ++i)
        outside[i] = 1 / flow[i] - plug * x[i];
    const double inPlug = plug * relativePenetration / permeabilityRatio;
    if (relativePenetration >= x.back())
        return 1 / (inPlug + outside.back());
    if (relativePenetration >= x.front())
        return 1 / (inPlug + interpolate(x, outside, relativePenetration));
    // A shallow skirt: the flow grows with the logarithm of D/h, as round any edge.
    const double shallow = flow.front() + std::log(x.front() / relativePenetration);
    return 1 / (inPlug + std::max(0.0, 1 / shallow - plug * relativePenetration));
}

} // namespace caisson
