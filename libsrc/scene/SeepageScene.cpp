#include "scene/SeepageScene.h"

#include "dictionary/Text.h"
#include "mesh/CellLocator.h"
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
        {"penetration", "m", "-", "(0, inf)",
         "of the first body, in place of that of the start time: the mesh follows it, and all below its "
         "surfaceLevel is soil"},
        {"writeInterval", "integer", "1", "[1, 1000000]", "steps between two files for VTK"},
    };
    return table;
}

std::vector<BodySurface> surfacesOfBodies(const Scene& scene, const State& state)
{
    BackgroundMesh reference = state.mesh;
    if (!scene.referenceZ.empty()) {
        reference.z = scene.referenceZ;
    }
    std::vector<BodySurface> surfaces;
    InputProblems problems;
    for (RigidBody body : state.bodies) {
        if (!scene.referenceZ.empty()) {
            body.tipLevel = body.initialTipLevel;
        }
        surfaces.push_back(findBodySurface(body, reference, problems));
    }
    problems.throwIfAny("the mesh and its bodies");
    for (BodySurface& surface : surfaces) {
        updateAreas(surface, state.mesh);
    }
    return surfaces;
}

void placeBody(const Scene& scene, State& state, double penetration)
{
    if (state.bodies.empty()) {
        throw InputError("the seepage", {{{"system/seepageDict", 0},
                                          "penetration is given, but there is no body",
                                          "leave the key out, or add constant/bodies"}});
    }
    RigidBody& body = state.bodies.front();
    body.tipLevel = body.surfaceLevel - penetration;
    const double displacement = body.tipLevel - body.initialTipLevel;
    const DisplacementRange range = scene.motion.allowedDisplacements();
    if (scene.movingBody != 0 || displacement < range.lowest || displacement > range.highest) {
        throw InputError(
            "the seepage",
            {{{"constant/dynamicMeshDict", 0},
              text("the mesh cannot follow '%s' to a penetration of %.6g m", body.name.c_str(), penetration),
              scene.movingBody != 0 ? text("type followBody; body %s;", body.name.c_str())
                                    : text("it can from %.6g to %.6g m",
                                           body.surfaceLevel - body.initialTipLevel - range.highest,
                                           body.surfaceLevel - body.initialTipLevel - range.lowest)}});
    }
    scene.motion.place(state.mesh, scene.referenceZ, displacement);
    const CellLocator locator(state.mesh);
    for (std::size_t p = 0; p < state.points.size(); ++p) {
        state.points.cell[p] = locator.find(state.points.r[p], state.points.z[p]);
    }
}

namespace {

/// Cells of soil without points are as permeable as those beside them.
void fillFromNeighbours(const BackgroundMesh& mesh, std::vector<double>& values,
                        const std::vector<unsigned char>& soil)
{
    for (bool missing = true; missing;) {
        missing = false;
        bool filled = false;
        const std::vector<double> known = values;
        for (int c = 0; c < mesh.cells(); ++c) {
            if (!soil[c] || known[c] > 0) {
                continue;
            }
            double sum = 0;
            int count = 0;
            for (int k = 0; k < mesh.corners; ++k) {
                const int next = mesh.neighbour[c * mesh.corners + k];
                if (next >= 0 && soil[next] && known[next] > 0) {
                    sum += known[next];
                    ++count;
                }
            }
            filled = filled || count > 0;
            missing = missing || count == 0;
            values[c] = count > 0 ? sum / count : 0;
        }
        if (missing && !filled) {
            throw InputError("the seepage",
                             {{{},
                               "a part of the soil below surfaceLevel holds no material points",
                               "fill it, or leave penetration out of system/seepageDict"}});
        }
    }
}

} // namespace

SeepageScene seepageScene(const Scene& scene, const State& state, bool compressibleSkeleton,
                          std::optional<double> surfaceLevel)
{
    const BackgroundMesh& mesh = state.mesh;
    const MaterialPoints& points = state.points;
    SeepageScene result;
    std::vector<unsigned char> inside(mesh.cells(), 0);
    for (const BodySurface& surface : surfacesOfBodies(scene, state)) {
        for (int c = 0; c < mesh.cells(); ++c) {
            inside[c] |= surface.voidCell[c];
        }
    }
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
    for (int c = 0; c < mesh.cells(); ++c) {
        if (volume[c] > 0) {
            result.conductivity[c] /= volume[c];
            result.storage[c] /= volume[c];
        }
        if (surfaceLevel) {
            double centre = 0;
            for (int k = 0; k < mesh.corners; ++k) {
                centre += mesh.z[mesh.node(c, k)] / mesh.corners;
            }
            result.soil[c] = !inside[c] && centre < *surfaceLevel;
        }
    }
    if (surfaceLevel) {
        fillFromNeighbours(mesh, result.conductivity, result.soil);
        fillFromNeighbours(mesh, result.storage, result.soil);
    }

    const double unitWeight = scene.materials.front().liquidDensity * scene.gravity[1];
    result.given.assign(mesh.nodes(), Seepage::free);
    result.inflow.assign(mesh.nodes(), 0);
    result.insideSurface.assign(mesh.nodes(), 0);
    result.outsideSurface.assign(mesh.nodes(), 0);
    std::vector<unsigned char> soilNode(mesh.nodes(), 0);
    for (int c = 0; c < mesh.cells(); ++c) {
        if (result.soil[c]) {
            for (int k = 0; k < mesh.corners; ++k) {
                soilNode[mesh.node(c, k)] = 1;
            }
        }
    }
    scene.liquidBoundary.setPressures(mesh, state.time, unitWeight, result.given);
    scene.liquidBoundary.addInflows(mesh, state.time, result.inflow);
    const auto setSurface = [&](int c, double centre) {
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
                result.insideSurface[i] = within;
                result.outsideSurface[i] = !within;
            }
        }
    };
    for (const bool wall : {true, false}) { // the sides of a wall count more than what is over it
        for (int c = 0; c < mesh.cells(); ++c) {
            if (result.soil[c] || inside[c]) {
                continue;
            }
            double centre = 0;
            for (int k = 0; k < mesh.corners; ++k) {
                centre += mesh.r[mesh.node(c, k)] / mesh.corners;
            }
            if (overWall(state.bodies, centre) == wall) {
                setSurface(c, centre);
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
