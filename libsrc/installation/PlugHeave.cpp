#include "installation/PlugHeave.h"

#include <algorithm>

namespace caisson {
namespace {

double wallVolumeRatio(const Caisson& caisson)
{
    const double ratio = caisson.outerDiameter / caisson.innerDiameter();
    return ratio * ratio - 1;
}

} // namespace

double plugHeave(const Caisson& caisson, const PlugHeaveShares& shares, const double h, const double byWeight)
{
    const double wall = wallVolumeRatio(caisson);
    const double first = std::min(h, byWeight);
    return shares.inwardByWeight * wall * first +
           (shares.inwardBySuction * wall + shares.expansion) * (h - first);
}

double lidContactPenetration(const Caisson& caisson, const PlugHeaveShares& shares, const double byWeight,
                             const double lidHeight)
{
    // h + heave(h) = lidHeight, with heave linear in two pieces
    const double wall = wallVolumeRatio(caisson);
    const double first = lidHeight / (1 + shares.inwardByWeight * wall);
    if (first <= byWeight)
        return first;
    const double rise = shares.inwardBySuction * wall + shares.expansion;
    return (lidHeight - plugHeave(caisson, shares, byWeight, byWeight) + rise * byWeight) / (1 + rise);
}

} // namespace caisson
