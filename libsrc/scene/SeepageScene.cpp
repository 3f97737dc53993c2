#include "scene/SeepageScene.h"

#include "timeStepping/CellShapes.h"

#include <cmath>

namespace caisson {

namespace {

template <class Shape>
double interpolateIn(const BackgroundMesh& mesh, int cell, double r, double z,
                     const std::vector<double>& nodal)
{
    double cornerR[Shape::corners];
    double cornerZ[Shape::corners];
    for (int k = 0; k < Shape::corners; ++k) {
        cornerR[k] = mesh.r[mesh.node(cell, k)];
        cornerZ[k] = mesh.z[mesh.node(cell, k)];
    }
    shapes::Values<Shape::corners> values;
    Shape::evaluate(Shape::make(cornerR, cornerZ), r, z, values);
    double sum = 0;
    for (int k = 0; k < Shape::corners; ++k) {
        sum += values.N[k] * nodal[mesh.node(cell, k)];
    }
    return sum;
}

double interpolate(const BackgroundMesh& mesh, int cell, double r, double z, const std::vector<double>& nodal)
{
    return mesh.corners == 3 ? interpolateIn<shapes::Triangle<false>>(mesh, cell, r, z, nodal)
                             : interpolateIn<shapes::Quadrilateral<false>>(mesh, cell, r, z, nodal);
}

} // namespace

std::span<const Keyword> seepageKeywords()
{
    static constexpr Keyword table[] = {
        {"mode", "word", "steady", "steady transient", "steady flow, or from the pressures of the points on"},
        {"deltaT", "s", "-", "(0, inf)", "step of transient flow"},
        {"endTime", "s", "-", "(0, inf)", "end of transient flow"},
        {"timeScheme", "word", "backwardEuler", "backwardEuler CrankNicolson", "of transient flow"},
        {"compressibleSkeleton", "flag", "yes", "",
         "whether the storage of transient flow holds the skeleton, 1/M, besides the liquid, n/Kw"},
        {"writeInterval", "integer", "1", "[1, 1000000]", "steps between two files for VTK"},
    };
    return table;
}

SeepageScene seepageScene(const Scene& scene, const State& state, bool compressibleSkeleton)
{
    const BackgroundMesh& mesh = state.mesh;
    const MaterialPoints& points = state.points;
    SeepageScene result;
    result.soil.assign(mesh.cells(), 0);
    result.conductivity.assign(mesh.cells(), 0);
    result.storage.assign(mesh.cells(), 0);
    std::vector<double> volume(mesh.cells(), 0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Material& material = scene.materials[points.material[p]];
        const double solidShare =
            (1 - material.porosity) * material.solidDensity / material.inertialDensity();
        const double n = 1 - points.mass[p] * solidShare / (material.solidDensity * points.volume[p]);
        const int c = points.cell[p];
        const double v = points.volume[p];
        result.soil[c] = 1;
        volume[c] += v;
        result.conductivity[c] += v * material.permeability(n) / material.liquidViscosity;
        result.storage[c] += v * (n / material.liquidBulkModulus +
                                  (compressibleSkeleton ? 1 / material.law->pWaveModulus() : 0));
    }
    std::vector<unsigned char> inside(mesh.cells(), 0);
    InputProblems problems;
    for (const RigidBody& body : state.bodies) {
        const BodySurface surface = findBodySurface(body, mesh, problems);
        for (int c = 0; c < mesh.cells(); ++c) {
            inside[c] |= surface.voidCell[c];
        }
    }
    problems.throwIfAny("the mesh and its bodies");

    const double unitWeight = scene.materials.front().liquidDensity * scene.gravity[1];
    result.given.assign(mesh.nodes(), Seepage::free);
    result.inflow.assign(mesh.nodes(), 0);
    result.insideSurface.assign(mesh.nodes(), 0);
    result.outsideSurface.assign(mesh.nodes(), 0);
    std::vector<unsigned char> soilNode(mesh.nodes(), 0);
    for (int c = 0; c < mesh.cells(); ++c) {
        if (result.soil[c]) {
            result.conductivity[c] /= volume[c];
            result.storage[c] /= volume[c];
            for (int k = 0; k < mesh.corners; ++k) {
                soilNode[mesh.node(c, k)] = 1;
            }
        }
    }
    scene.liquidBoundary.setPressures(mesh, state.time, unitWeight, result.given);
    scene.liquidBoundary.addInflows(mesh, state.time, result.inflow);
    for (int c = 0; c < mesh.cells(); ++c) {
        if (result.soil[c] || inside[c]) {
            continue;
        }
        double centre = 0;
        for (int k = 0; k < mesh.corners; ++k) {
            centre += mesh.r[mesh.node(c, k)] / mesh.corners;
        }
        const int s = freeSurfaceAt(scene.freeSurfaces, state.bodies, centre);
        bool within = false;
        for (const RigidBody& body : state.bodies) {
            within = within || std::abs(centre) < body.innerRadius();
        }
        const double pressure =
            s < 0 ? 0
                  : excessPressure(scene.freeSurfaces[s], state.bodies, state.time, unitWeight) +
                        (state.pumped.empty() ? 0 : state.pumped[s]);
        for (int k = 0; k < mesh.corners; ++k) {
            const int i = mesh.node(c, k);
            if (soilNode[i]) {
                result.given[i] = pressure;
                (within ? result.insideSurface : result.outsideSurface)[i] = 1;
            }
        }
    }
    return result;
}

std::vector<double> steadyPorePressure(const Scene& scene, const State& state)
{
    const SeepageScene setup = seepageScene(scene, state, false);
    const Seepage seepage(state.mesh, setup.soil, setup.conductivity);
    const std::vector<double> excess = seepage.steady(setup.given, setup.inflow);
    const double unitWeight = scene.materials.front().liquidDensity * scene.gravity[1];
    const MaterialPoints& points = state.points;
    std::vector<double> pressure(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        pressure[p] = interpolate(state.mesh, points.cell[p], points.r[p], points.z[p], excess) +
                      unitWeight * points.z[p];
    }
    return pressure;
}

} // namespace caisson
