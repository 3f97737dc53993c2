#pragma once

#include "Scenes.h"

#include <functional>

namespace caisson::stability {

/// What became of a run.
enum class Verdict {
    holds,   ///< all demands met
    refused, ///< the scene was not accepted, with a message
    stopped, ///< it went wrong, and the solver said so and ended
    breaks   ///< it went wrong and nobody noticed, or a demand was not met
};
std::string name(Verdict verdict);

struct Outcome
{
    Verdict verdict = Verdict::holds;
    std::string remark; ///< one line
};

/// What a run is held to besides: values that are finite; points slower than ten wave speeds; porosities
/// within (0.05, 0.95); stresses within 1e-8 of the yield surface; finite reactions; and whatever has gone
/// wrong noticed by the solver within 100 steps.
struct Demands
{
    double energyGrowth = 0; ///< most kinetic energy over that at the start; 0: any
    std::function<std::string(const Simulation&)> atTheEnd; ///< empty where it is content
    std::function<std::string(const Simulation&)> figures;  ///< for the remark of a run that holds
};

/// Makes steps of `courant` times the stable one, as axiMpmFoam does, with its watch.
Outcome drive(Simulation& simulation, const Soil& soil, long steps, double courant,
              const Demands& demands = {});

/// The same from the making of the scene on: input that is refused is an outcome.
Outcome outcomeOf(const std::function<Outcome()>& run);

} // namespace caisson::stability
