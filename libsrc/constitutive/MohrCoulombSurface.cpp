#include "constitutive/MohrCoulombSurface.h"

#include <limits>

namespace caisson {

MohrCoulombSurface::MohrCoulombSurface(const IsotropicElasticity& elasticity,
                                       const MohrCoulombStrength& strength)
{
    const double sinPhi = std::sin(strength.frictionAngle);
    const double sinPsi = std::sin(strength.dilatancyAngle);
    slope1_ = 1 + sinPhi;
    slope3_ = 1 - sinPhi;
    inverseSlope3_ = 1 / slope3_;
    strength_ = 2 * strength.cohesion * std::cos(strength.frictionAngle);
    slopeRatio_ = slope3_ / slope1_;
    uniaxialTension_ = strength_ / slope1_;
    apex_ = sinPhi > 0 ? strength_ / (2 * sinPhi) : std::numeric_limits<double>::infinity();

    // D b13 with b13 = (1 + sin psi, 0, -(1 - sin psi)), whose trace is 2 sin psi.
    const double shear = elasticity.shearModulus();
    flowMiddle_ = 2 * elasticity.lambda() * sinPsi;
    flowMajor_ = flowMiddle_ + 2 * shear * (1 + sinPsi);
    flowMinor_ = flowMiddle_ - 2 * shear * (1 - sinPsi);
    face_ = slope1_ * flowMajor_ - slope3_ * flowMinor_;
    faceCompliance_ = 1 / face_;
    edge12_ = slope1_ * flowMiddle_ - slope3_ * flowMinor_;
    edge23_ = slope1_ * flowMajor_ - slope3_ * flowMiddle_;
    compliance12_ = 1 / (face_ * face_ - edge12_ * edge12_);
    compliance23_ = 1 / (face_ * face_ - edge23_ * edge23_);
}

bool MohrCoulombSurface::wellPosed() const { return face_ > std::abs(edge12_) && face_ > std::abs(edge23_); }

} // namespace caisson
