#pragma once

#include "dictionary/KeywordReader.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace caisson {

/// A run of consecutive points of one material, as pointers into structure-of-arrays storage.
/// Stress: effective, tension positive [Pa]; components 0 rr, 1 zz, 2 tt (hoop / out of plane), 3 rz.
struct StressBatch
{
    int size = 0;
    /// increments of strain in the step: rr, zz, tt and engineering shear gamma_rz = v_r,z + v_z,r, times dt
    std::array<const double*, 4> strain{};
    const double* spin = nullptr; ///< (v_z,r - v_r,z)/2 times dt
    std::array<double*, 4> stress{};
    std::vector<double*> const* state = nullptr; ///< [variable] -> array of `size` values
};

/// A constitutive law. One virtual call per batch, never per point.
/// Large rotation: laws in rate form use the Jaumann rate (stress turned by the spin before the increment):
///   s_rr -= 2 w s_rz, s_zz += 2 w s_rz, s_rz += w (s_rr - s_zz).
class ConstitutiveLaw
{
public:
    virtual ~ConstitutiveLaw() = default;
    /// @returns whether soil of the batch yields; false where all of it stays elastic
    virtual bool update(const StressBatch& batch) const = 0;
    /// Names of the variables kept per point (also the names of the output fields), e.g.
    /// "plasticShearStrain".
    [[nodiscard]] virtual const std::vector<std::string>& stateNames() const = 0;
    /// Values that the variables start from.
    [[nodiscard]] virtual std::vector<double> initialState() const = 0;
    [[nodiscard]] virtual double pWaveModulus() const = 0; ///< largest tangent M, for the time step [Pa]
    [[nodiscard]] virtual double shearModulus() const = 0; ///< [Pa]
    [[nodiscard]] virtual bool plastic() const = 0;
    [[nodiscard]] virtual std::string description() const = 0; ///< one line for the log
};

/// Valid words for `type`.
std::vector<std::string> constitutiveLawTypes();

/// Keywords of a law, without the porosity and densities that belong to the material (for reading, checking
/// and the user guide). @throws std::out_of_range for an unknown type
std::span<const Keyword> constitutiveLawKeywords(const std::string& type);

/// Makes the law `type` from the sub-dictionary `<type>Coeffs`-style reader over its own keywords.
std::unique_ptr<ConstitutiveLaw> makeConstitutiveLaw(const std::string& type, const KeywordReader& reader);

} // namespace caisson
