#include "support/Simulation.h"

#include "materialPoints/CellDivision.h"

#include <cmath>

namespace caisson::testing {

int Simulation::addMaterial(const std::string& name, const std::string& dictionary)
{
    InputProblems problems;
    const Dictionary parsed = parseDictionary(name + " { " + dictionary + " }", "materialProperties");
    auto materials = readMaterials(parsed, problems);
    problems.throwIfAny("test material");
    scene.materials.push_back(std::move(materials.front()));
    return static_cast<int>(scene.materials.size()) - 1;
}

void Simulation::setConditions(const std::string& boundaryField)
{
    InputProblems problems;
    const Dictionary parsed = parseDictionary("boundaryField { " + boundaryField + " }", "0/U");
    scene.conditions = VelocityConditions(state.mesh, readPatchVelocities(parsed, state.mesh, {}, problems));
    problems.throwIfAny("test conditions");
}

void Simulation::setPressures(const std::string& boundaryField)
{
    InputProblems problems;
    const Dictionary parsed = parseDictionary("boundaryField { " + boundaryField + " }", "0/p");
    scene.liquidBoundary =
        LiquidBoundary(state.mesh, readPatchPressures(parsed, state.mesh, {}, 9810, problems));
    problems.throwIfAny("test pressures");
}

void Simulation::fill(int material, int n, int m, const std::function<bool(double, double)>& wanted)
{
    const BackgroundMesh& mesh = state.mesh;
    MaterialPoints& points = state.points;
    const Material& soil = scene.materials[material];
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    const std::vector<double> initial = soil.law->initialState();
    points.state.resize(std::max(points.state.size(), initial.size()));
    const auto add = [&](int cell, double r, double z, double volume) {
        points.r.push_back(r);
        points.z.push_back(z);
        points.vr.push_back(0);
        points.vz.push_back(0);
        points.volume.push_back(volume);
        points.mass.push_back(volume * soil.inertialDensity());
        for (auto& component : points.stress) {
            component.push_back(0);
        }
        for (std::size_t k = 0; k < points.state.size(); ++k) {
            points.state[k].push_back(k < initial.size() ? initial[k] : 0);
        }
        points.cell.push_back(cell);
        points.material.push_back(material);
        points.id.push_back(static_cast<int>(points.id.size()));
        points.initialR.push_back(r);
        points.initialZ.push_back(z);
    };
    for (int c = 0; c < mesh.cells(); ++c) {
        double r[4], z[4], centreR = 0, centreZ = 0;
        for (int k = 0; k < mesh.corners; ++k) {
            r[k] = mesh.r[mesh.node(c, k)];
            z[k] = mesh.z[mesh.node(c, k)];
            centreR += r[k] / mesh.corners;
            centreZ += z[k] / mesh.corners;
        }
        if (wanted && !wanted(centreR, centreZ)) {
            continue;
        }
        if (mesh.corners == 4) {
            for (const SubCell& part : subdivide(mesh, c, {.along = {n, m}})) {
                add(c, part.r, part.z, part.volume);
            }
        } else {
            double weight = 0;
            std::vector<std::array<double, 2>> places;
            for (int k = 0; k < n; ++k) {
                const double own = n == 1 ? 1.0 / 3 : 2.0 / 3;
                const double other = (1 - own) / 2;
                const int a = (k + 1) % 3, b = (k + 2) % 3;
                places.push_back({own * r[k] + other * (r[a] + r[b]), own * z[k] + other * (z[a] + z[b])});
                weight += axisymmetric ? places.back()[0] : 1;
            }
            for (const auto& place : places) {
                add(c, place[0], place[1], cellVolume(mesh, c) * (axisymmetric ? place[0] : 1) / weight);
            }
        }
    }
}

void Simulation::setStress(const std::function<std::array<double, 4>(double, double)>& stress)
{
    MaterialPoints& points = state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto s = stress(points.r[p], points.z[p]);
        for (int j = 0; j < 4; ++j) {
            points.stress[j][p] = s[j];
        }
    }
}

void Simulation::setVelocity(const std::function<std::array<double, 2>(double, double)>& velocity)
{
    MaterialPoints& points = state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto v = velocity(points.r[p], points.z[p]);
        points.vr[p] = v[0];
        points.vz[p] = v[1];
    }
}

void Simulation::start()
{
    scene.referenceZ = state.mesh.z;
    step = makeTimeStep(scene, state);
}

void Simulation::run(double time, double courant)
{
    const double limit = courant * step->stableStep(state).step;
    const long steps = std::max(1L, static_cast<long>(std::ceil((time - state.time) / limit - 1e-9)));
    const double dt = (time - state.time) / static_cast<double>(steps);
    for (long i = 0; i < steps; ++i) {
        step->advance(state, dt);
    }
}

} // namespace caisson::testing
