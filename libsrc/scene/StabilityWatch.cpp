#include "scene/StabilityWatch.h"

#include "dictionary/Text.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>

namespace caisson {

namespace {

/// No number where any of its quantities is none.
double sumOfQuantities(const MaterialPoints& points, std::size_t p)
{
    double sum = points.r[p] + points.z[p] + points.vr[p] + points.vz[p] + points.volume[p];
    for (const auto& component : points.stress) {
        sum += component[p];
    }
    if (points.twoPhase()) {
        sum += points.wr[p] + points.wz[p] + points.porePressure[p];
    }
    return sum;
}

/// Volume of the grains per mass of the points [m3/kg].
double grainVolume(const Material& soil) { return (1 - soil.porosity) / soil.inertialDensity(); }

double porosity(const Scene& scene, const MaterialPoints& points, std::size_t p)
{
    return 1 - points.mass[p] * grainVolume(scene.materials[points.material[p]]) / points.volume[p];
}

/// The first of the point's quantities that is no number.
std::string notANumber(const MaterialPoints& points, std::size_t p)
{
    const auto no = [](double value) { return !std::isfinite(value); };
    if (no(points.r[p]) || no(points.z[p])) {
        return "place";
    }
    if (no(points.vr[p]) || no(points.vz[p])) {
        return "velocity";
    }
    if (points.twoPhase() && (no(points.wr[p]) || no(points.wz[p]))) {
        return "liquid velocity";
    }
    if (points.twoPhase() && no(points.porePressure[p])) {
        return "pore pressure";
    }
    return no(points.volume[p]) ? "volume" : "stress";
}

std::string place(const MaterialPoints& points, std::size_t p)
{
    return text("material point %d in cell %d at r = %.6g m, z = %.6g m", points.id[p], points.cell[p],
                points.r[p], points.z[p]);
}

/// What is wrong with a point; empty where nothing is.
std::string finding(const Scene& scene, const MaterialPoints& points, std::size_t p, double speed,
                    double limit)
{
    if (!std::isfinite(sumOfQuantities(points, p))) {
        return "the " + notANumber(points, p) + " of " + place(points, p) + " is not a finite number";
    }
    if (points.volume[p] <= 0) {
        return place(points, p) + " has lost its volume";
    }
    if (points.twoPhase() && porosity(scene, points, p) <= 0) {
        return place(points, p) + text(" has the porosity %.4g", porosity(scene, points, p));
    }
    if (speed > limit) {
        return place(points, p) + text(" moves at %.4g m/s, faster than waves of %.4g m/s", speed, limit);
    }
    return {};
}

/// Of the faster of its phases [m2/s2].
double squareOfSpeed(const MaterialPoints& points, std::size_t p)
{
    const double solid = points.vr[p] * points.vr[p] + points.vz[p] * points.vz[p];
    return points.twoPhase() ? std::max(solid, points.wr[p] * points.wr[p] + points.wz[p] * points.wz[p])
                             : solid;
}

Eigen::Map<const Eigen::ArrayXd> arrayOf(const std::vector<double>& values)
{
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

std::size_t fastestOf(const MaterialPoints& points)
{
    double square = (arrayOf(points.vr).square() + arrayOf(points.vz).square()).maxCoeff();
    if (points.twoPhase()) {
        square = std::max(square, (arrayOf(points.wr).square() + arrayOf(points.wz).square()).maxCoeff());
    }
    constexpr double rounded = 1 - 1e-12;
    std::size_t p = 0;
    while (p + 1 < points.size() && squareOfSpeed(points, p) < rounded * square) {
        ++p;
    }
    return p;
}

/// The first point with a quantity that is no finite number, or without volume or pores. Whole arrays are
/// looked at before points are: most runs have none.
std::optional<std::size_t> firstUnsound(const Scene& scene, const MaterialPoints& points)
{
    const auto finite = [](const std::vector<double>& values) { // no number stays one, times zero
        return (0 * arrayOf(values)).sum() == 0;
    };
    double grains = 0;
    for (const Material& soil : scene.materials) {
        grains = std::max(grains, points.twoPhase() ? grainVolume(soil) : 0.0);
    }
    bool sound = finite(points.r) && finite(points.z) && finite(points.vr) && finite(points.vz) &&
                 finite(points.volume) && std::ranges::all_of(points.stress, finite) &&
                 (arrayOf(points.volume) - grains * arrayOf(points.mass)).minCoeff() > 0;
    if (points.twoPhase()) {
        sound = sound && finite(points.wr) && finite(points.wz) && finite(points.porePressure);
    }
    for (std::size_t p = 0; !sound && p < points.size(); ++p) {
        if (!finding(scene, points, p, 0, 0).empty()) {
            return p;
        }
    }
    return std::nullopt;
}

/// What may have been the cause, and what can be done.
std::string hint(const State& state, int cell, const StableStep& stable)
{
    double held = 0;
    int count = 0;
    for (std::size_t p = 0; p < state.points.size(); ++p) {
        if (state.points.cell[p] == cell) {
            ++count;
            held += state.points.volume[p];
        }
    }
    std::string result =
        text("the step was %.4g s, %.3g of the stable one (cell %d: size %.4g m, wave speed %.4g m/s); ",
             state.timeStep, state.timeStep / stable.step, stable.cell, stable.size, stable.waveSpeed);
    if (cell >= 0 && cell < state.mesh.cells()) {
        result += text("cell %d holds %d points with %.3g of its volume, ", cell, count,
                       held / cellVolume(state.mesh, cell));
        result += state.filled[cell] ? "and counts as filled" : "and is integrated at its points";
    }
    result += "\n    try a smaller maxCo, more points per cell, ";
    result += state.massScaling > 1 ? text("less massScaling (%.4g now), ", state.massScaling) : "";
    return result + "or slower loads; the time directories written before are good";
}

[[noreturn]] void stop(const State& state, const std::string& finding, const std::string& cause)
{
    throw InputError("the run", {{{},
                                  text("the run has become unstable: %s at t = %.6g s, step %ld",
                                       finding.c_str(), state.time, state.step),
                                  cause}});
}

} // namespace

void StabilityWatch::afterStep(const Scene& scene, const State& state, const StableStep& stable, bool writing)
{
    lookAtBodies(state, stable); // in every step: the mesh follows them
    if (writing || state.step % interval == 0) {
        look(scene, state, stable);
    }
}

void StabilityWatch::lookAtBodies(const State& state, const StableStep& stable)
{
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        if (!std::isfinite(state.bodies[b].tipLevel + state.bodies[b].velocity + state.reactions[b].force)) {
            stop(state,
                 text("the motion or the reaction of %s is not a number", state.bodies[b].name.c_str()),
                 hint(state, -1, stable));
        }
    }
}

void StabilityWatch::look(const Scene& scene, const State& state, const StableStep& stable)
{
    const MaterialPoints& points = state.points;
    // Waves of soil with scaled inertia are slower.
    const double limit = std::min(stable.waveSpeed, stable.size / stable.step);
    if (points.size() == 0) {
        return;
    }
    const std::size_t fastest = firstUnsound(scene, points).value_or(fastestOf(points));
    const double speed = std::sqrt(squareOfSpeed(points, fastest));
    const std::string found = finding(scene, points, fastest, speed, limit);
    if (found.empty()) {
        last_ = {points.id[fastest], points.cell[fastest], points.r[fastest], points.z[fastest], speed,
                 state.step};
        return;
    }
    if (last_.id < 0) {
        stop(state, found, hint(state, points.cell[fastest], stable));
    }
    // What is not finite has spread since: it began nearer to the fastest point of the look before.
    const bool spread = !std::isfinite(sumOfQuantities(points, fastest));
    stop(state, found,
         hint(state, spread ? last_.cell : points.cell[fastest], stable) +
             text("\n    at step %ld the fastest was material point %d in cell %d at r = %.6g m, "
                  "z = %.6g m, with %.4g m/s",
                  last_.step, last_.id, last_.cell, last_.r, last_.z, last_.speed));
}

} // namespace caisson
