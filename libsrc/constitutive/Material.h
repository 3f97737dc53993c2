#pragma once

#include "constitutive/ConstitutiveLaw.h"

#include <limits>

namespace caisson {

/// What a one-phase soil weighs: under water the liquid's own weight is carried by the hydrostatic pressure.
enum class Weight { submerged, saturated, dry };

/// A soil (or other solid) of constant/materialProperties.
struct Material
{
    std::string name;
    std::unique_ptr<ConstitutiveLaw> law;
    double porosity = 0;      ///< [-]
    double solidDensity = 0;  ///< of the grains [kg/m3]
    double liquidDensity = 0; ///< [kg/m3]
    Weight weight = Weight::submerged;
    double intrinsicPermeability = 0; ///< [m2]; 0 where not given: a two-phase scene has to ask for it
    double liquidBulkModulus = 0;     ///< [Pa]
    double liquidViscosity = 0;       ///< dynamic [Pa s]
    bool kozenyCarman = false;        ///< permeability follows the porosity
    double cavitationPressure = std::numeric_limits<double>::lowest(); ///< least pore pressure [Pa]

    /// Mass that is accelerated per volume [kg/m3]: saturated (dry for Weight::dry).
    [[nodiscard]] double inertialDensity() const;
    /// Mass that gravity acts on per volume [kg/m3]: (1-n)(rho_s-rho_w), (1-n)rho_s + n rho_w, or (1-n)rho_s.
    [[nodiscard]] double weighingDensity() const;
    /// Intrinsic permeability at a porosity n [m2]; Kozeny and Carman: proportional to n^3/(1-n)^2.
    [[nodiscard]] double permeability(double n) const
    {
        if (!kozenyCarman) {
            return intrinsicPermeability;
        }
        const double ratio = n / porosity;
        const double solid = (1 - n) / (1 - porosity);
        return intrinsicPermeability * ratio * ratio * ratio / (solid * solid);
    }
};

/// Reads constant/materialProperties: one sub-dictionary per material, its keys and those of its law flat in
/// it: `sand { law mohrCoulomb; porosity 0.35; solidDensity 2650; liquidDensity 1000; weight submerged;
/// youngsModulus 60e6; poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 1; cohesion 0; }`
/// @returns the materials in the order of the file; one with a problem has an elastic law instead of none
std::vector<Material> readMaterials(const Dictionary& materialProperties, InputProblems& problems);

/// Keywords of a material with law `type` (general ones and the law's), for reading and the user guide.
/// @throws std::out_of_range for an unknown type
std::vector<Keyword> materialKeywords(const std::string& type);

} // namespace caisson
