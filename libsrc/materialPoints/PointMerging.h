#pragma once

#include "materialPoints/MaterialPoints.h"

#include <array>

namespace caisson {

/// Makes one point of two of one material, neither of which bears a load. Mass, volume, the centre of mass,
/// momenta of solid and liquid, and the integrals over the volume of stress, pore pressure and the variables
/// of the laws stay; the energy of their motion against each other goes. `poreVolume`: of the one that stays
/// and the one that goes [m3/rad or m2], with a liquid only.
void mergePoints(MaterialPoints& points, int stays, int goes, std::array<double, 2> poreVolume);

/// What merging two points takes from the second moments of mass in a cell of this width and height [m],
/// whose size counts as one: the pair that takes least is the one to merge (J. H. Ward 1963, J. Am. Stat.
/// Assoc. 58, 236). [kg/rad or kg/m]
double mergingCost(const MaterialPoints& points, int one, int other, double width, double height);

} // namespace caisson
