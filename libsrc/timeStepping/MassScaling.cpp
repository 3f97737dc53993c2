#include "timeStepping/MassScaling.h"

#include "timeStepping/TimeStep.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

constexpr double growth = 1.1;           // per interval
constexpr double transitsOfAJump = 20.0; // of a wave through the wall, at least

/// Width of the body at its tip [m].
double wallWidth(const RigidBody& body)
{
    double tip = 0;
    for (const ProfileEdge& edge : body.profile) {
        if (edge.part == SurfacePart::tip) {
            tip += std::hypot(edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]);
        }
    }
    return tip;
}

} // namespace

double adaptedMassScaling(const Scene& scene, const State& state)
{
    const SolutionControls& controls = scene.controls;
    const Material& soil = scene.materials.front();
    const double density = soil.inertialDensity();
    const double weight = soil.weighingDensity() * std::hypot(scene.gravity[0], scene.gravity[1]);
    const double waveSpeed = std::sqrt(soil.law->pWaveModulus() / density);

    double factor = std::min(controls.massScaling, growth * state.massScaling);
    double work = 0;
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        const RigidBody& body = state.bodies[b];
        const double speed = std::abs(body.velocity);
        work += state.reactions[b].work;
        if (speed == 0) {
            continue;
        }
        const double vertical = weight * std::max(0.0, body.penetration());
        factor = std::min(factor, controls.inertiaGate * vertical / (density * speed * speed));
        if (!body.loadControlled) {
            const double later = std::abs(body.prescribedVelocity(state.time + state.timeStep));
            const double change = std::abs(later - speed) / state.timeStep; // [m/s2]
            const double transits = speed * waveSpeed / (transitsOfAJump * wallWidth(body));
            if (change > 0) {
                factor = std::min(factor, transits / change * (transits / change));
            }
        }
    }
    const double kinetic = sumEnergies(state).kinetic;
    if (kinetic > 0) {
        factor = std::min(factor, controls.energyGate * std::max(0.0, work) / kinetic);
    }
    return std::max(1.0, factor);
}

} // namespace caisson
