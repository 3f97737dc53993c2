#include "Plan.h"

#include "dictionary/Text.h"
#include "installation/Seepage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace caisson {

namespace {

/// Bytes of the points' arrays, and of the step's own per point.
double bytesPerPoint(const State& state)
{
    constexpr int hotAndCold = 6 + 4 + 2; // place, velocity, mass, volume; stress; initial place
    constexpr int strainAndSpin = 5;
    return 8.0 * (hotAndCold + strainAndSpin + static_cast<int>(state.points.state.size())) + 4.0 * (3 + 1);
}

/// Warns of a suction on a plug that would make its sand flow: steady seepage, by penetration.
void checkSuction(Log& log, const Scene& scene, const State& state)
{
    for (const FreeSurface& surface : scene.freeSurfaces) {
        const auto body = std::ranges::find(state.bodies, surface.body, &RigidBody::name);
        if (surface.region != FreeSurface::Region::inside || !surface.pressure ||
            body == state.bodies.end() || surface.variable != FreeSurface::Variable::penetration) {
            continue;
        }
        const double g = std::abs(scene.gravity[1]);
        const double unitWeight = scene.materials.front().weighingDensity() * g;
        const double diameter = 2 * body->innerRadius();
        for (int i = 0; i <= 100; ++i) {
            const double h = body->penetration() + 0.01 * i * (body->referenceLength - body->penetration());
            if (h <= 0 || h > surface.pressure->end()) {
                continue;
            }
            const double suction = -surface.pressure->value(h);
            const double limit = unitWeight * h * exitGradientFactor(h / diameter);
            if (suction > limit) {
                log.warning(text(
                    "suction %.4g Pa on free surface %s at penetration %.3g m is above %.4g Pa, at which "
                    "steady seepage makes the sand at the wall flow (critical exit gradient): piping is to "
                    "be expected",
                    suction, surface.name.c_str(), h, limit));
                break;
            }
        }
    }
}

} // namespace

void printPlan(Log& log, const ControlDict& control, const Scene& scene, const State& state,
               const TimeStep& step)
{
    const bool axisymmetric = state.mesh.geometry == Geometry::axisymmetric;
    const double whole = axisymmetric ? 2 * std::numbers::pi : 1.0;
    const CellCounts cells = step.cellCounts(state);
    log.line(text("Kernel: %s", step.description().c_str()));
    log.line(
        text("Mesh: %d cells (%d FEM, %d filled, %d partly filled, %d empty, %d inside bodies), %d nodes",
             state.mesh.cells(), cells.fem, cells.filled, cells.partial, cells.empty, cells.inside,
             state.mesh.nodes()));

    std::vector<double> mass(scene.materials.size(), 0);
    std::vector<double> volume(scene.materials.size(), 0);
    std::vector<long> points(scene.materials.size(), 0);
    for (std::size_t p = 0; p < state.points.size(); ++p) {
        const int m = state.points.material[p];
        mass[m] += state.points.mass[p];
        volume[m] += state.points.volume[p];
        ++points[m];
    }
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        log.line(text("Material %s: %s; %ld points, volume %.8g %s, mass %.8g %s",
                      scene.materials[m].name.c_str(), scene.materials[m].law->description().c_str(),
                      points[m], whole * volume[m], axisymmetric ? "m3" : "m2", whole * mass[m],
                      axisymmetric ? "kg" : "kg/m"));
    }
    // Points against the cells that hold them: what is missing is free surface, or points too many.
    double cellsVolume = 0;
    double pointsVolume = 0;
    for (int c = 0; c < state.mesh.cells(); ++c) {
        cellsVolume += state.filled[c] ? cellVolume(state.mesh, c) : 0;
    }
    for (std::size_t p = 0; p < state.points.size(); ++p) {
        pointsVolume += state.filled[state.points.cell[p]] ? state.points.volume[p] : 0;
    }
    if (cellsVolume > 0) {
        log.line(text("Volume of the points in filled cells over that of the cells: %.6f",
                      pointsVolume / cellsVolume));
    }
    for (const RigidBody& body : state.bodies) {
        log.line(text("Body %s: tip at z = %.6g m (penetration %.6g m), friction %.4g, adhesion %.4g Pa",
                      body.name.c_str(), body.tipLevel, body.penetration(), body.friction, body.adhesion));
    }
    if (scene.movingBody >= 0) {
        const DisplacementRange range = scene.motion.allowedDisplacements();
        log.line(text("Mesh follows %s; its displacement may be %.6g to %.6g m",
                      state.bodies[scene.movingBody].name.c_str(), range.lowest, range.highest));
    }
    const StableStep stable = step.stableStep(state);
    log.line(text("Stable step: %.6g s, limited by cell %d (size %.4g m, wave speed %.5g m/s)", stable.step,
                  stable.cell, stable.size, stable.waveSpeed));
    log.line(text("Memory of the points: %.0f byte each, %.4g MB", bytesPerPoint(state),
                  1e-6 * bytesPerPoint(state) * static_cast<double>(state.points.size())));
    checkSuction(log, scene, state);
    for (const std::string& remark : control.remarks) {
        log.line(remark);
    }
}

void timeSteps(Log& log, const ControlDict& control, const RunTime& runTime, const Scene& scene, State& state,
               TimeStep& step)
{
    const double deltaT = runTime.wantedDeltaT(step.stableStep(state).step);
    const double steps = std::ceil((control.endTime - runTime.time()) / deltaT);
    // With one sort, for which the points of FEM cells wake.
    const int trial =
        scene.controls.mayHaveFemCells() ? std::clamp(scene.controls.sortInterval, 20, 100) : 20;
    step.advance(state, deltaT);
    const double start = log.clockSeconds();
    for (int i = 0; i < trial; ++i) {
        step.advance(state, deltaT);
    }
    const double perStep = (log.clockSeconds() - start) / trial;
    const double points = static_cast<double>(state.points.size());
    log.line(text("Steps: about %.0f of %.4g s", steps, deltaT));
    log.line(text("Speed: %.4g s of the clock per step, %.1f ns per point and step", perStep,
                  1e9 * perStep / points));
    log.line(text("Run time: about %.0f s", steps * perStep));
    double writes = 0;
    if (control.writeControl == WriteControl::timeStep) {
        writes = steps / control.writeInterval;
    } else if (control.writeControl == WriteControl::runTime ||
               control.writeControl == WriteControl::adjustableRunTime) {
        writes = (control.endTime - runTime.time()) / control.writeInterval;
    }
    if (control.purgeWrite > 0) {
        writes = std::min(writes, static_cast<double>(control.purgeWrite));
    }
    // cloud of doubles, and the same points in single precision for VTK
    const double perWrite =
        points * (8.0 * (3 + 3 + 6 + 2 + 3 + static_cast<double>(state.points.state.size())) + 12) * 1.4;
    log.line(text("Disk: about %.3g MB per write, %.0f writes, %.4g MB", 1e-6 * perWrite, writes,
                  1e-6 * perWrite * writes));
    log.line("Dry run: everything was read and checked; nothing is written");
}

} // namespace caisson
