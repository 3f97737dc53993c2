#include "Drive.h"

#include "dictionary/Text.h"
#include "scene/StabilityWatch.h"

#include <algorithm>
#include <cmath>

namespace caisson::stability {

namespace {

constexpr long toNotice = 100; ///< steps within which a blow-up has to be noticed
constexpr int looksAtAll = 25; ///< steps between two looks at porosity and yield
constexpr double yieldTolerance = 1e-8;

/// What is wrong beyond doubt, found independently of the solver.
std::string blownUp(const Simulation& simulation, double fastestWave)
{
    const MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double speed = std::hypot(points.vr[p], points.vz[p]);
        if (!std::isfinite(speed) || !std::isfinite(points.stress[0][p] + points.stress[1][p])) {
            return "values are not finite";
        }
        if (speed > 10 * fastestWave) {
            return "speed above ten wave speeds";
        }
    }
    for (const BodyReaction& reaction : simulation.state.reactions) {
        if (!std::isfinite(reaction.force)) {
            return "the reaction is not finite";
        }
    }
    return {};
}

std::string unmet(const Simulation& simulation, const Soil& soil)
{
    const MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double initial = points.mass[p] / simulation.scene.materials[0].inertialDensity();
        const double porosity = 1 - (1 - Soil::porosity) * initial / points.volume[p];
        if (!(porosity > 0.05 && porosity < 0.95)) {
            return text("porosity %.3g", porosity);
        }
    }
    const double excess = soil.yieldExcess(points);
    return excess > yieldTolerance ? text("yield function %.1e of the stress", excess) : "";
}

/// First sentence of what a user would read.
std::string firstProblem(const InputError& error)
{
    return error.problems().empty() ? error.what() : error.problems().front().message;
}

} // namespace

std::string name(Verdict verdict)
{
    switch (verdict) {
    case Verdict::holds:
        return "holds";
    case Verdict::refused:
        return "refused";
    case Verdict::stopped:
        return "stopped";
    case Verdict::breaks:
        break;
    }
    return "breaks";
}

Outcome drive(Simulation& simulation, const Soil& soil, long steps, double courant, const Demands& demands)
{
    if (!simulation.step) {
        simulation.start();
    }
    State& state = simulation.state;
    StabilityWatch watch;
    const double before = kineticEnergy(simulation);
    long wrongSince = -1;
    std::string wrong;
    double growth = 0;
    for (long i = 0; i < steps; ++i) {
        const StableStep stable = simulation.step->stableStep(state);
        try {
            try {
                simulation.step->advance(state, courant * stable.step);
            } catch (const InputError&) {
                watch.look(simulation.scene, state, stable);
                throw;
            }
            watch.afterStep(simulation.scene, state, stable, i + 1 == steps);
        } catch (const InputError& error) {
            return {Verdict::stopped, text("step %ld: ", i) + firstProblem(error)};
        }
        if (wrong.empty()) {
            wrong = blownUp(simulation, stable.waveSpeed);
            wrongSince = i;
        } else if (i - wrongSince > toNotice) {
            return {Verdict::breaks, wrong + text(" since step %ld, unnoticed", wrongSince)};
        }
        if (wrong.empty() && i % looksAtAll == 0) {
            if (const std::string demand = unmet(simulation, soil); !demand.empty()) {
                if (courant <= 1) {
                    return {Verdict::breaks, text("step %ld: ", i) + demand};
                }
                wrong = demand; // which is to be expected, as long as somebody notices
                wrongSince = i;
                continue;
            }
            growth = std::max(growth, before > 0 ? kineticEnergy(simulation) / before : 0);
            if (demands.energyGrowth > 0 && growth > demands.energyGrowth) {
                // Growth is no failure of a step beyond its limit as long as somebody notices in the end.
                if (courant <= 1) {
                    return {Verdict::breaks, text("step %ld: kinetic energy has grown by %.3g", i, growth)};
                }
            }
        }
    }
    if (demands.energyGrowth > 0 && growth > demands.energyGrowth) {
        return {Verdict::breaks, text("kinetic energy has grown by %.3g, unnoticed", growth)};
    }
    if (demands.atTheEnd) {
        if (const std::string demand = demands.atTheEnd(simulation); !demand.empty()) {
            return {Verdict::breaks, demand};
        }
    }
    return {Verdict::holds, demands.figures ? demands.figures(simulation) : ""};
}

Outcome outcomeOf(const std::function<Outcome()>& run)
{
    try {
        return run();
    } catch (const InputError& error) {
        return {Verdict::refused, firstProblem(error)};
    } catch (const std::exception& error) {
        return {Verdict::breaks, error.what()};
    }
}

} // namespace caisson::stability
