#include "installation/InstallationMethod.h"

#include <sstream>

namespace caisson {

double InstallationMethod::greatestSuction(double /*h*/) const
{
    return std::numeric_limits<double>::infinity();
}

void InstallationMethod::throwLimitReached(const double h, const double limit) const
{
    std::ostringstream message;
    message << "at penetration " << h << " m the suction that is needed exceeds " << limit << " Pa, "
            << greatestSuctionName() << ": the caisson does not go deeper";
    throw SuctionLimitReached(message.str(), h, limit);
}

double InstallationMethod::selfWeightPenetration() const
{
    const double deepest = caisson_.skirtLength;
    const auto surplus = [&](const double h) { return resistance(h, 0).total() - caisson_.submergedWeight; };
    if (surplus(deepest) <= 0)
        return deepest;
    if (surplus(0) >= 0)
        return 0;
    return increasingRoot(surplus, 0, deepest);
}

} // namespace caisson
