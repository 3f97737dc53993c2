#pragma once

#include "case/FoamFile.h"
#include "materialPoints/MaterialPoints.h"

#include <string>
#include <vector>

namespace caisson {

/// Material points as OpenFOAM keeps a cloud, every bit of them: positions (r 0 z) and the fields velocity,
/// stress (symmTensor; effective, tension positive), mass, volume (per radian or per metre), material, id,
/// initialPosition, for two-phase soil liquidVelocity and porePressure, and a scalar field for each state
/// variable.
/// @param stateNames  names of the state variables, in their order; as many as the points have
Cloud cloud(const MaterialPoints& points, const std::vector<std::string>& stateNames);

/// The way back. Fields of other names (written for the eye) are left aside.
/// @throws InputError naming the field that is missing, of another kind or length, or positions off y = 0
MaterialPoints materialPoints(const Cloud& cloud, const std::vector<std::string>& stateNames);

} // namespace caisson
