#pragma once

#include "function1/Function1.h"
#include "mesh/BackgroundMesh.h"

#include <map>
#include <string>

namespace caisson {

/// What one patch of 0/p asks of the pore liquid. Pressures are compression positive [Pa].
///
/// | type                      | meaning                                | keys                       |
/// |---------------------------|----------------------------------------|----------------------------|
/// | fixedValue                | given pressure                         | value uniform p            |
/// | uniformFixedValue         | given pressure, Function1 of time      | uniformValue               |
/// | hydrostatic               | rho_w g (level - z) + pressure(time)   | level, pressure (optional) |
/// | prescribedFlux            | discharge into the soil per area [m/s] | uniformValue               |
/// | impermeable, zeroGradient | no flow                                |                            |
/// | slip, symmetryPlane       | no flow                                |                            |
/// | wedge, empty              | the planes of the 2-D model            |                            |
struct PatchPressure
{
    enum class Kind { impermeable, pressure, flux };
    Kind kind = Kind::impermeable;
    std::shared_ptr<const Function1> value; ///< pressure [Pa] or discharge [m/s] of time; none: zero
    double unitWeight = 0;                  ///< hydrostatic: of the liquid, positive [N/m3]
    double level = 0;                       ///< hydrostatic: where that part is zero [m]

    [[nodiscard]] bool givesPressure() const { return kind == Kind::pressure; }
    [[nodiscard]] bool givesFlux() const { return kind == Kind::flux; }
    /// Pressure at a height z, or the discharge.
    [[nodiscard]] double at(double time, double z) const
    {
        return (value ? value->value(time) : 0) + unitWeight * (level - z);
    }
};

/// Conditions of all patches of the mesh by name.
/// @param unitWeight  of the liquid, rho_w g, positive [N/m3]
std::map<std::string, PatchPressure> readPatchPressures(const Dictionary& fieldP, const BackgroundMesh& mesh,
                                                        const std::vector<std::string>& constraintPatches,
                                                        double unitWeight, InputProblems& problems);

std::vector<std::string> patchPressureTypes();
/// Keys of a condition, for reading and the user guide; empty for an unknown type.
std::vector<Keyword> patchPressureKeywords(const std::string& type);

} // namespace caisson
