#pragma once

#include "materialPoints/Seeding.h"

namespace caisson {

/// Stress of the points at the start.
struct InitialState
{
    enum class Type { zero, uniform, K0, fromTime };
    Type type = Type::zero;
    std::array<double, 4> stress{}; ///< uniform: rr zz tt rz [Pa]
    double K0 = 0;                  ///< horizontal over vertical effective stress [-]
    double surfaceLevel = 0;        ///< z of the soil surface [m]
    double overburden = 0;          ///< vertical effective pressure on the surface [Pa]
    std::string caseDirectory;      ///< fromTime: of the earlier run, relative to the case
    double time = 0;                ///< fromTime: that the earlier run wrote [s]
    SourceLocation where;
};

std::vector<std::string> initialStateTypes();
/// Keywords of an initial state of the given type, for reading and the user guide.
std::vector<Keyword> initialStateKeywords(const std::string& type);

/// Reads `initialState { type K0; K0 0.384; surfaceLevel 0; overburden 0; }`.
InitialState readInitialState(const Dictionary& dictionary, InputProblems& problems);

/// Pore pressure of the points at the start, of two-phase soil.
struct InitialPorePressure
{
    double level = 0;         ///< where the hydrostatic part is zero [m]
    double pressure = 0;      ///< added to it [Pa]
    bool hydrostatic = false; ///< whether there is one
    bool seepage = false;     ///< from the steady seepage between the conditions of 0/p instead
};

std::vector<Keyword> initialPorePressureKeywords(const std::string& type);
std::vector<std::string> initialPorePressureTypes();

/// Reads `porePressure { type hydrostatic; level 0; pressure 0; }` or `{ type uniform; pressure 5e3; }`.
InitialPorePressure readInitialPorePressure(const Dictionary& dictionary, InputProblems& problems);

/// Makes the points two-phase: rho_w g (level - z) + pressure, the liquid moving with the solid.
void setInitialPorePressure(SeededPoints& seeded, const std::vector<Material>& materials,
                            const InitialPorePressure& initial, const std::array<double, 2>& gravity);

/// Sets the stress of all points. K0: the vertical stress carries the overburden and the weight
/// (weighingDensity) of what lies above; materials of different weight must lie in horizontal layers, the
/// uppermost of which reaches to surfaceLevel. fromTime: zero; see takeEarlierState() (StateTransfer.h).
/// @param gravity  [m/s2], r and z; K0 needs it downward
void setInitialStress(SeededPoints& seeded, const std::vector<Material>& materials, const InitialState& state,
                      const std::array<double, 2>& gravity, InputProblems& problems);

} // namespace caisson
