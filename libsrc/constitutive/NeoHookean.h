#pragma once

#include "constitutive/ConstitutiveLaw.h"
#include "constitutive/IsotropicElasticity.h"

namespace caisson {

/// Compressible neo-Hookean solid, P = lambda ln(J) F^-T + mu (F - F^-T); Cauchy stress
/// [lambda ln(J) 1 + mu (F F^T - 1)] / J, from the deformation gradient kept per point.
///
/// F grows by F <- (1 + dL) F with the velocity gradient rebuilt from strain and spin,
/// v_r,z dt = gamma/2 - w and v_z,r dt = gamma/2 + w. The stress is a function of F alone: a stress that the
/// points start with is forgotten at the first update. lambda and mu follow from E and nu at small strain.
class NeoHookean final : public ConstitutiveLaw
{
public:
    explicit NeoHookean(const IsotropicElasticity& elasticity);
    bool update(const StressBatch& batch) const override;
    [[nodiscard]] const std::vector<std::string>& stateNames() const override; ///< F_rr F_rz F_zr F_zz F_tt
    [[nodiscard]] std::vector<double> initialState() const override { return {1, 0, 0, 1, 1}; }
    /// Of the undeformed state; a stretch s raises it towards lambda + 2 mu s^2.
    [[nodiscard]] double pWaveModulus() const override { return elasticity_.pWaveModulus(); }
    [[nodiscard]] double shearModulus() const override { return elasticity_.shearModulus(); }
    [[nodiscard]] bool plastic() const override { return false; }
    [[nodiscard]] std::string description() const override;

private:
    IsotropicElasticity elasticity_;
};

} // namespace caisson
