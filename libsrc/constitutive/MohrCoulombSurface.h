#pragma once

#include "constitutive/IsotropicElasticity.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace caisson {

/// Strength and dilatancy; angles in radians.
struct MohrCoulombStrength
{
    double frictionAngle = 0;  ///< [rad], in [0, pi/2)
    double dilatancyAngle = 0; ///< [rad], at most the friction angle; negative: contractant
    double cohesion = 0;       ///< [Pa], >= 0
    /// Whether grains that parted at the apex bear stress again only when they have closed the gap.
    bool gapClosing = false;
};

/// Part of the yield surface that a stress was returned to; stresses in the order s1 >= s2 >= s3. As wide as
/// a stress, for loops over points that the compiler computes several at a time.
enum class ReturnRegion : std::int64_t { face, edgeS1S2, edgeS2S3, apex };

/// Non-associated Mohr-Coulomb plasticity in principal stresses, tension positive.
///
/// Yield: f = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi); potential: the same with psi for phi. The yield
/// planes and the elasticity are linear, so the backward-Euler return has a closed form without iteration
/// [Clausen, Damkilde & Andersen 2006, Eng. Comput. 23:15]: to the face; where that leaves the order of the
/// stresses, to the edge between two faces; where that lies beyond the apex, to the apex c cot(phi).
class MohrCoulombSurface
{
public:
    using Principal = std::array<double, 3>;

    struct Return
    {
        Principal stress; ///< s1 >= s2 >= s3 [Pa]
        ReturnRegion region;
        std::array<double, 2> multiplier; ///< plastic multipliers of the active faces; zero at the apex
    };

    MohrCoulombSurface(const IsotropicElasticity& elasticity, const MohrCoulombStrength& strength);

    /// Yield function [Pa] from the largest and the smallest principal stress; elastic where <= 0.
    [[nodiscard]] double yield(const double s1, const double s3) const
    {
        return slope1_ * s1 - slope3_ * s3 - strength_;
    }

    /// Yield function less what rounding may leave of it: a returned stress is not returned again.
    [[nodiscard]] double excess(const double s1, const double s3) const
    {
        return yield(s1, s3) - 1e-13 * (std::abs(s1) + std::abs(s3));
    }

    /// Where the flow rule takes an elastic trial stress that is beyond yield.
    /// @param trial  s1 >= s2 >= s3 [Pa], yield(s1, s3) > 0
    [[nodiscard]] Return returned(const Principal& trial) const;

    /// Whether every face and edge has one return. False only for strongly contractant flow at a Poisson's
    /// ratio near 0.5.
    [[nodiscard]] bool wellPosed() const;

    [[nodiscard]] double apexStress() const { return apex_; } ///< c cot(phi) [Pa]; infinite where phi = 0

private:
    [[nodiscard]] double majorOnFace(const double s3) const { return slopeRatio_ * s3 + uniaxialTension_; }

    double slope1_, slope3_;              // gradient of the yield function: (slope1, 0, -slope3)
    double inverseSlope3_, strength_;     // 1/slope3, 2 c cos(phi)
    double slopeRatio_, uniaxialTension_; // slope3/slope1, strength/slope1
    double apex_;
    double flowMajor_, flowMiddle_, flowMinor_; // stress taken off by a unit multiplier of the face: D b
    double face_, faceCompliance_;              // a13 . D b13 and its inverse
    double edge12_, edge23_;                    // a13 . D b23, a13 . D b12
    double compliance12_, compliance23_;        // 1 over the determinants of the edges
};

/// Without branches: all regions are computed, and one is chosen.
[[gnu::always_inline]] inline MohrCoulombSurface::Return
MohrCoulombSurface::returned(const Principal& trial) const
{
    // The last stress of each region follows from the others by f = 0, which then holds to rounding of the
    // result however far the trial stress was.
    const double f13 = yield(trial[0], trial[2]);
    const double multiplier = f13 * faceCompliance_;
    const double s2 = trial[1] - multiplier * flowMiddle_;
    const double s3 = trial[2] - multiplier * flowMinor_;
    const double s1 = majorOnFace(s3);
    const bool face = (s1 >= s2) & (s2 >= s3);

    const double f23 = yield(trial[1], trial[2]);
    const double first12 = (face_ * f13 - edge12_ * f23) * compliance12_;
    const double second12 = (face_ * f23 - edge12_ * f13) * compliance12_;
    const double minor12 = trial[2] - (first12 + second12) * flowMinor_;
    const double major12 = majorOnFace(minor12);
    const bool edge12 = !face & (s1 < s2) & (minor12 <= apex_);

    const double f12 = yield(trial[0], trial[1]);
    const double first23 = (face_ * f13 - edge23_ * f12) * compliance23_;
    const double second23 = (face_ * f12 - edge23_ * f13) * compliance23_;
    const double major23 = trial[0] - (first23 + second23) * flowMajor_;
    const double minor23 = (slope1_ * major23 - strength_) * inverseSlope3_;
    const bool edge23 = !face & !edge12 & (s2 < s3) & (major23 <= apex_);

    Return result;
    result.stress = {face     ? s1
                     : edge12 ? major12
                     : edge23 ? major23
                              : apex_,
                     face     ? s2
                     : edge12 ? major12
                     : edge23 ? minor23
                              : apex_,
                     face     ? s3
                     : edge12 ? minor12
                     : edge23 ? minor23
                              : apex_};
    result.region = face     ? ReturnRegion::face
                    : edge12 ? ReturnRegion::edgeS1S2
                    : edge23 ? ReturnRegion::edgeS2S3
                             : ReturnRegion::apex;
    result.multiplier = {face     ? multiplier
                         : edge12 ? first12
                         : edge23 ? first23
                                  : 0,
                         edge12   ? second12
                         : edge23 ? second23
                                  : 0};
    return result;
}

} // namespace caisson
