#include "installation/PrescribedSuction.h"

#include "installation/Seepage.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace caisson {

PrescribedSuction::PrescribedSuction(const Caisson& caisson, const double effectiveUnitWeight,
                                     std::vector<double> relativePenetration,
                                     std::vector<double> relativeSuction)
    : InstallationMethod(caisson), effectiveUnitWeight_(effectiveUnitWeight),
      penetration_(std::move(relativePenetration)), suction_(std::move(relativeSuction))
{
    if (!(effectiveUnitWeight > 0))
        throw std::invalid_argument("the effective unit weight must be positive");
    if (penetration_.size() < 2 || penetration_.size() != suction_.size() || penetration_.front() < 0 ||
        std::ranges::adjacent_find(penetration_, std::greater_equal{}) != penetration_.end())
        throw std::invalid_argument("a suction table needs two or more points with increasing z/L >= 0");
    if (std::ranges::any_of(suction_, [](const double s) { return s < 0; }))
        throw std::invalid_argument("a suction table must not hold negative suctions");
    for (double& z : penetration_)
        z *= caisson.skirtLength;
    for (double& s : suction_)
        s *= effectiveUnitWeight * caisson.outerDiameter;
}

Resistance PrescribedSuction::resistance(double /*h*/, double /*suction*/) const
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
}

SuctionLimits PrescribedSuction::limits(const double h) const
{
    const double relative = h / caisson().meanDiameter();
    SuctionLimits limits;
    limits.liquefaction = effectiveUnitWeight_ * h / (1 - porePressureFactor(relative));
    limits.exitGradient = effectiveUnitWeight_ * h * exitGradientFactor(relative);
    return limits;
}

double PrescribedSuction::end() const { return penetration_.back(); }

double PrescribedSuction::suction(const double h) const
{
    if (h > end() * (1 + 1e-12)) {
        std::ostringstream message;
        message << "the suction table ends at penetration " << end() << " m, before " << h << " m";
        throw std::out_of_range(message.str());
    }
    if (h <= penetration_.front())
        return suction_.front();
    const auto above =
        std::min(std::upper_bound(penetration_.begin(), penetration_.end(), h), penetration_.end() - 1);
    const auto i = static_cast<std::size_t>(above - penetration_.begin());
    return suction_[i - 1] + (suction_[i] - suction_[i - 1]) * (h - penetration_[i - 1]) /
                                 (penetration_[i] - penetration_[i - 1]);
}

} // namespace caisson
