#pragma once

namespace caisson {

/// Isotropic linear elasticity by Young's modulus [Pa] and Poisson's ratio [-].
struct IsotropicElasticity
{
    double youngsModulus = 0; ///< [Pa], > 0
    double poissonsRatio = 0; ///< [-], in (-1, 0.5)

    [[nodiscard]] constexpr double shearModulus() const { return youngsModulus / (2 * (1 + poissonsRatio)); }
    [[nodiscard]] constexpr double bulkModulus() const
    {
        return youngsModulus / (3 * (1 - 2 * poissonsRatio));
    }
    /// Lame's first parameter [Pa].
    [[nodiscard]] constexpr double lambda() const
    {
        return youngsModulus * poissonsRatio / ((1 + poissonsRatio) * (1 - 2 * poissonsRatio));
    }
    /// Constrained (oedometric) modulus [Pa].
    [[nodiscard]] constexpr double pWaveModulus() const { return lambda() + 2 * shearModulus(); }
};

/// Change of the in-plane stress by a rotation: of (s_rr - s_zz)/2 and of s_rz; the mean stays.
struct RotationChange
{
    double halfDifference;
    double shear;
};

/// What a rotation by `spin` (radians, from r to z) adds to the in-plane stress.
///
/// The Jaumann rate integrated over the step: (halfDifference, shear) turns by 2 spin. The rotation is in
/// Cayley's form, cos = (1-t^2)/(1+t^2), sin = 2t/(1+t^2) with t = tan(spin) by its series: orthogonal to
/// rounding whatever the angle, so that the invariants of the stress stay; the angle itself is in error by
/// 0.11 spin^7. No branches, one division; no spin changes no bit.
inline RotationChange changeByRotation(const double halfDifference, const double shear, const double spin)
{
    const double square = spin * spin;
    const double t = spin * (1 + square * (1.0 / 3 + square * (2.0 / 15)));
    const double sine = 2 * t / (1 + t * t);
    return {-sine * (t * halfDifference + shear), sine * (halfDifference - t * shear)}; // cos - 1 = -t sin
}

} // namespace caisson
