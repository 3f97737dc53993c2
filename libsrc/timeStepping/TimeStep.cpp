#include "timeStepping/ExplicitStep.h"

#include <cmath>

namespace caisson {

namespace {

bool allRectangles(const BackgroundMesh& mesh)
{
    if (mesh.corners != 4) {
        return false;
    }
    for (int c = 0; c < mesh.cells(); ++c) {
        const double tolerance = 1e-9 * std::sqrt(cellArea(mesh, c));
        for (int k = 0; k < 4; ++k) {
            const int a = mesh.node(c, k);
            const int b = mesh.node(c, (k + 1) % 4);
            if (std::abs(mesh.r[a] - mesh.r[b]) > tolerance && std::abs(mesh.z[a] - mesh.z[b]) > tolerance) {
                return false;
            }
        }
    }
    return true;
}

template <int phases, bool axisymmetric>
std::unique_ptr<TimeStep> makeForMesh(const Scene& scene, State& state)
{
    if (state.mesh.corners == 3) {
        return std::make_unique<ExplicitStep<shapes::Triangle<axisymmetric>, phases>>(scene, state);
    }
    if (allRectangles(state.mesh)) {
        return std::make_unique<ExplicitStep<shapes::Rectangle<axisymmetric>, phases>>(scene, state);
    }
    return std::make_unique<ExplicitStep<shapes::Quadrilateral<axisymmetric>, phases>>(scene, state);
}

} // namespace

std::unique_ptr<TimeStep> makeTimeStep(const Scene& scene, State& state)
{
    const bool axisymmetric = state.mesh.geometry == Geometry::axisymmetric;
    if (scene.controls.phases == 2) {
        return axisymmetric ? makeForMesh<2, true>(scene, state) : makeForMesh<2, false>(scene, state);
    }
    return axisymmetric ? makeForMesh<1, true>(scene, state) : makeForMesh<1, false>(scene, state);
}

Energies sumEnergies(const State& state)
{
    Energies sum;
    const MaterialPoints& points = state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double m = points.mass[p];
        sum.mass += m;
        sum.volume += points.volume[p];
        sum.momentum[0] += m * points.vr[p];
        sum.momentum[1] += m * points.vz[p];
        sum.kinetic += 0.5 * m * (points.vr[p] * points.vr[p] + points.vz[p] * points.vz[p]);
    }
    sum.kineticScaled = sum.kinetic * state.massScaling;
    return sum;
}

} // namespace caisson
