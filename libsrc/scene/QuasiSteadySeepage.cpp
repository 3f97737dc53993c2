#include "scene/QuasiSteadySeepage.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

constexpr double leastChange = 0.01;    // of pressure or stress, that asks for a new solution
constexpr int solutionsPerMeasure = 10; // a measure costs as much as a solution

} // namespace

QuasiSteadySeepage::QuasiSteadySeepage(const Scene& scene) : scene_(scene) {}

std::vector<double> QuasiSteadySeepage::surfacePressures(const State& state) const
{
    const double unitWeight = scene_.materials.front().liquidDensity * scene_.gravity[1];
    std::vector<double> pressures;
    pressures.reserve(scene_.freeSurfaces.size());
    for (const FreeSurface& surface : scene_.freeSurfaces) {
        pressures.push_back(excessPressure(surface, state.bodies, state.time, unitWeight));
    }
    return pressures;
}

bool QuasiSteadySeepage::update(const State& state, TimeStep& step, bool anew)
{
    const double share =
        scene_.controls.seepageRamp > 0 ? std::min(1.0, state.time / scene_.controls.seepageRamp) : 1.0;
    const bool solved = anew || movedOn(state);
    if (solved) {
        solve(state);
    }
    if (solved || share > share_ + leastChange || (share == 1 && share_ < 1)) {
        std::vector<double> loading = excess_;
        std::ranges::transform(loading, loading.begin(),
                               [share](double pressure) { return share * pressure; });
        step.setSeepage(state, loading);
        share_ = share;
    }
    return solved;
}

/// Whether a body or a pressure is another than at the last solution.
bool QuasiSteadySeepage::movedOn(const State& state) const
{
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        if (std::abs(state.bodies[b].penetration() - penetrations_[b]) >= scene_.controls.seepageInterval) {
            return true;
        }
    }
    const Material& soil = scene_.materials.front();
    double stress =
        0; // what a small pressure is small against: the vertical effective stress at the deepest tip
    for (const RigidBody& body : state.bodies) {
        stress = std::max(stress, -soil.weighingDensity() * scene_.gravity[1] * body.penetration());
    }
    const std::vector<double> pressures = surfacePressures(state);
    for (std::size_t s = 0; s < pressures.size(); ++s) {
        if (std::abs(pressures[s] - pressures_[s]) > leastChange * std::max(stress, std::abs(pressures[s]))) {
            return true;
        }
    }
    return false;
}

void QuasiSteadySeepage::solve(const State& state)
{
    const SeepageScene setup = seepageScene(scene_, state, false);
    const Seepage seepage(state.mesh, setup.soil, setup.conductivity);
    excess_ = seepage.steady(setup.given, setup.inflow);
    penetrations_.clear();
    for (const RigidBody& body : state.bodies) {
        penetrations_.push_back(body.penetration());
    }
    pressures_ = surfacePressures(state);
    const auto [least, most] = std::ranges::minmax_element(excess_);
    difference_ = *most - *least;
    if (solutions_++ % solutionsPerMeasure == 0) {
        measure(state, seepage, setup);
    }
}

/// Steady flow that feeds what the pores of the points and the storage of their liquid have taken up per time
/// since the last measure, with no pressure on the surfaces.
void QuasiSteadySeepage::measure(const State& state, const Seepage& seepage, const SeepageScene& setup)
{
    const MaterialPoints& points = state.points;
    const BackgroundMesh& mesh = state.mesh;
    std::vector<double> volumes(1 + *std::ranges::max_element(points.id), 0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        volumes[points.id[p]] = points.volume[p];
    }
    const double duration = state.time - measuredTime_;
    if (duration > 0 && volumes_.size() == volumes.size() && share_ == 1) {
        std::vector<double> inflow(mesh.nodes(), 0);
        for (std::size_t p = 0; p < points.size(); ++p) {
            const int c = points.cell[p];
            const double stored = setup.storage[c] * points.volume[p] *
                                  (seepage.cellMean(c, excess_) - seepage.cellMean(c, measuredExcess_));
            const double taken = points.volume[p] - volumes_[points.id[p]] + stored;
            for (int k = 0; k < mesh.corners; ++k) {
                inflow[mesh.node(c, k)] -= taken / (duration * mesh.corners);
            }
        }
        std::vector<double> given = setup.given;
        std::ranges::transform(given, given.begin(), [](double p) { return std::isnan(p) ? p : 0.0; });
        leftOutPressure_ = 0;
        for (const double pressure : seepage.steady(given, inflow)) {
            leftOutPressure_ = std::max(leftOutPressure_, std::abs(pressure));
        }
        leftOut_ = difference_ > 0 ? leftOutPressure_ / difference_ : 0;
    }
    volumes_ = std::move(volumes);
    measuredExcess_ = excess_;
    measuredTime_ = state.time;
}

std::string QuasiSteadySeepage::report() const
{
    return text("Seepage: quasi-steady, excess pressures over %.5g Pa; storage and dilatation would add up "
                "to %.3g Pa "
                "(%.3g of them)",
                difference_, leftOutPressure_, leftOut_);
}

} // namespace caisson
