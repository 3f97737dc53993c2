#pragma once

#include "constitutive/ConstitutiveLaw.h"
#include "constitutive/IsotropicElasticity.h"

namespace caisson {

/// Isotropic elasticity in rate form with the Jaumann rate (hypoelastic).
///
/// Exact for small strains and any rotation. In finite shear the stress oscillates, s_rz = G sin(gamma)
/// [Dienes 1979]: a property of the rate, not of its integration.
class LinearElastic final : public ConstitutiveLaw
{
public:
    explicit LinearElastic(const IsotropicElasticity& elasticity);
    bool update(const StressBatch& batch) const override;
    [[nodiscard]] const std::vector<std::string>& stateNames() const override;
    [[nodiscard]] std::vector<double> initialState() const override { return {}; }
    [[nodiscard]] double pWaveModulus() const override { return elasticity_.pWaveModulus(); }
    [[nodiscard]] double shearModulus() const override { return elasticity_.shearModulus(); }
    [[nodiscard]] bool plastic() const override { return false; }
    [[nodiscard]] std::string description() const override;

private:
    IsotropicElasticity elasticity_;
};

} // namespace caisson
