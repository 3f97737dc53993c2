#pragma once

#include "constitutive/ConstitutiveLaw.h"
#include "constitutive/MohrCoulombSurface.h"

namespace caisson {

/// Linear elasticity with a Mohr-Coulomb (or, with phi = psi = 0, Tresca) yield surface, Jaumann rate.
///
/// State variables:
/// - plasticShearStrain: sum of sqrt(2/3 de:de), de the plastic strain increment's deviator [-]; in triaxial
///   compression |d eps_axial - d eps_radial| 2/3.
/// - tensileVolumetricStrain: with gapClosing, volumetric strain that opened at the apex [-]. The grains have
///   parted: the stress stays at the apex until compression has closed the opening again. Off by default:
///   where soil flows round a corner, strains of opening add up that no gap is left of, and the soil beside a
///   penetrating wall ends up without any stress (doc/theory).
class MohrCoulomb final : public ConstitutiveLaw
{
public:
    /// @param name  type word for the log line
    /// @throws std::invalid_argument where the flow rule has no unique return (MohrCoulombSurface::wellPosed)
    MohrCoulomb(const IsotropicElasticity& elasticity, const MohrCoulombStrength& strength,
                std::string name = "mohrCoulomb");
    bool update(const StressBatch& batch) const override;
    [[nodiscard]] const std::vector<std::string>& stateNames() const override;
    [[nodiscard]] std::vector<double> initialState() const override { return {0, 0}; }
    [[nodiscard]] double pWaveModulus() const override { return elasticity_.pWaveModulus(); }
    [[nodiscard]] double shearModulus() const override { return elasticity_.shearModulus(); }
    [[nodiscard]] bool plastic() const override { return true; }
    [[nodiscard]] std::string description() const override;

private:
    struct Point;
    bool updateChunk(const StressBatch& batch, int begin, int size) const;

    IsotropicElasticity elasticity_;
    MohrCoulombStrength strength_;
    MohrCoulombSurface surface_;
    std::string name_;
};

} // namespace caisson
