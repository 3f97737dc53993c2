// seepageFoam: steady or transient seepage through the soil of a two-phase case, by finite elements.
//
// Usage: seepageFoam [-case <directory>] [-dry-run]
//
// Reads the case as axiMpmFoam does, with the body (but for `penetration`) and the material points where the
// start time has them, and system/seepageDict. Writes postProcessing/seepage/<start>/seepage.dat and
// VTK/seepage.

#include "case/FileIO.h"
#include "case/Log.h"
#include "case/Monitor.h"
#include "case/Program.h"
#include "case/RunTime.h"
#include "dictionary/Text.h"
#include "output/Vtk.h"
#include "scene/CaseScene.h"
#include "scene/SeepageScene.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>
#include <optional>

namespace {

using namespace caisson;

struct Controls
{
    bool transient = false;
    double deltaT = 0, endTime = 0, theta = 1;
    bool compressibleSkeleton = true;
    int writeInterval = 1;
    std::optional<double> penetration;
};

Controls readControls(const std::filesystem::path& caseDirectory, InputProblems& problems)
{
    Controls controls;
    if (!fileExists(caseDirectory / "system/seepageDict")) {
        return controls; // steady
    }
    const Dictionary dictionary =
        readDictionary(caseDirectory / "system/seepageDict", caseDirectory, "system/seepageDict");
    const KeywordReader reader(dictionary, seepageKeywords(), "seepageDict", problems);
    controls.transient = reader.word("mode") == "transient";
    controls.theta = reader.word("timeScheme") == "CrankNicolson" ? 0.5 : 1;
    controls.compressibleSkeleton = reader.flag("compressibleSkeleton");
    controls.writeInterval = static_cast<int>(reader.integer("writeInterval"));
    for (const char* key : {"deltaT", "endTime"}) {
        if (controls.transient && !reader.has(key)) {
            reader.problem(key, std::string("mode transient needs '") + key + "'");
        }
    }
    if (reader.has("penetration")) {
        controls.penetration = reader.number("penetration");
    }
    controls.deltaT = reader.has("deltaT") ? reader.number("deltaT") : 0;
    controls.endTime = reader.has("endTime") ? reader.number("endTime") : 0;
    return controls;
}

/// What is read off a pressure field.
struct Figures
{
    double plugFlow = 0, seabedFlow = 0, patchFlow = 0; ///< out of the soil [m3/s] or [m2/s]
    std::vector<double> flowOfPatch;                    ///< likewise, per patch of the mesh
    double tipExcess = 0;                               ///< mean over the tip [Pa]
    double exitAtAxis = 0, exitAtWall = 0;              ///< upward gradients at the plug's surface [-]
};

Figures readOff(const Seepage& seepage, const SeepageScene& setup, const State& state,
                const std::vector<BodySurface>& surfaces, const std::vector<int>& openPatches,
                const std::vector<double>& excess, double unitWeight)
{
    const BackgroundMesh& mesh = state.mesh;
    const double whole = mesh.geometry == Geometry::axisymmetric ? 2 * std::numbers::pi : 1.0;
    Figures figures;
    figures.flowOfPatch.resize(mesh.patches.size(), 0);
    const std::vector<double> inflow = seepage.nodalInflow(excess);
    for (const int i : seepage.nodes()) {
        double& flow = setup.insideSurface[i]    ? figures.plugFlow
                       : setup.outsideSurface[i] ? figures.seabedFlow
                                                 : figures.patchFlow;
        // Where nothing is given only what is fed in crosses the boundary; the rest of transient flow is
        // storage.
        const double out = -whole * (std::isnan(setup.given[i]) ? setup.inflow[i] : inflow[i]);
        flow += out;
        if (!setup.insideSurface[i] && !setup.outsideSurface[i] && openPatches[i] >= 0) {
            figures.flowOfPatch[openPatches[i]] += out;
        }
    }
    double nearest = std::numeric_limits<double>::max();
    double farthest = -1;
    for (int c = 0; c < mesh.cells(); ++c) {
        int onSurface = 0;
        double centre = 0;
        for (int k = 0; k < mesh.corners; ++k) {
            onSurface += setup.insideSurface[mesh.node(c, k)];
            centre += mesh.r[mesh.node(c, k)] / mesh.corners;
        }
        if (!setup.soil[c] || onSurface < 2) {
            continue;
        }
        const double exit = -seepage.gradient(c, excess)[1] / unitWeight;
        if (centre < nearest) {
            nearest = centre;
            figures.exitAtAxis = exit;
        }
        if (centre > farthest) {
            farthest = centre;
            figures.exitAtWall = exit;
        }
    }
    double area = 0;
    for (const BodySurface& surface : surfaces) {
        for (const SurfaceNode& node : surface.nodes) {
            for (int f = 0; f < node.faces; ++f) {
                if (node.part[f] == SurfacePart::tip) {
                    figures.tipExcess += node.area[f] * excess[node.node];
                    area += node.area[f];
                }
            }
        }
    }
    figures.tipExcess = area > 0 ? figures.tipExcess / area : 0;
    return figures;
}

void writeGrid(const std::filesystem::path& caseDirectory, const Seepage& seepage, const SeepageScene& setup,
               const BackgroundMesh& mesh, const std::vector<double>& excess, double unitWeight, double time)
{
    VtkGrid grid;
    grid.corners = mesh.corners;
    NamedField pressure{"p", FieldKind::scalar, {}};
    NamedField excessField{"excessPressure", FieldKind::scalar, excess};
    for (int i = 0; i < mesh.nodes(); ++i) {
        grid.points.push_back({mesh.r[i], 0, mesh.z[i]});
        pressure.values.push_back(excess[i] - unitWeight * mesh.z[i]);
    }
    NamedField discharge{"discharge", FieldKind::vector, {}};
    for (int c = 0; c < mesh.cells(); ++c) {
        if (!setup.soil[c]) {
            continue;
        }
        for (int k = 0; k < mesh.corners; ++k) {
            grid.cellPoints.push_back(mesh.node(c, k));
        }
        const auto gradient = seepage.gradient(c, excess);
        discharge.values.push_back(-setup.conductivity[c] * gradient[0]);
        discharge.values.push_back(0);
        discharge.values.push_back(-setup.conductivity[c] * gradient[1]);
    }
    grid.pointFields = {pressure, excessField};
    grid.cellFields = {discharge};
    const std::filesystem::path folder = caseDirectory / "VTK/seepage";
    std::filesystem::create_directories(folder);
    writeVtu(vtkSeriesFile(folder, "seepage", text("%g", time), "vtu"), grid, time);
    writeVtkSeries(folder, "seepage", "vtu", time);
}

int run(const std::filesystem::path& caseDirectory, bool dryRun, const std::string& commandLine)
{
    Log log(std::cout);
    log.banner(commandLine, caseDirectory);
    const std::string subject = "case " + caseDirectory.string();
    InputProblems problems;
    const ControlDict control = readControlDict(caseDirectory, problems);
    problems.throwIfAny(subject);
    RunTime runTime(caseDirectory, control, log);
    const Controls controls = readControls(caseDirectory, problems);
    CaseScene caseScene =
        readCaseScene(caseDirectory, runTime.startDirectory(), runTime.restarted(), runTime.kept, problems);
    if (caseScene.scene.controls.phases != 2) {
        problems.add({"system/mpmSolution", 0}, "the case has one phase, so no water flows", "phases 2;");
    }
    if (controls.transient && controls.endTime <= runTime.time()) {
        problems.add({"system/seepageDict", 0},
                     text("endTime %g s is not after the start at %g s", controls.endTime, runTime.time()));
    }
    problems.throwIfAny(subject);
    State& state = caseScene.state;
    const Scene& scene = caseScene.scene;
    state.time = runTime.time();
    const double unitWeight = -scene.materials.front().liquidDensity * scene.gravity[1];
    const double whole = state.mesh.geometry == Geometry::axisymmetric ? 2 * std::numbers::pi : 1.0;

    std::optional<double> surfaceLevel;
    if (controls.penetration) {
        placeBody(scene, state, *controls.penetration);
        surfaceLevel = state.bodies.front().surfaceLevel;
        log.line(
            text("Body %s: penetration %.6g m", state.bodies.front().name.c_str(), *controls.penetration));
    }
    const std::vector<BodySurface> surfaces = surfacesOfBodies(scene, state);
    SeepageScene setup = seepageScene(scene, state, controls.compressibleSkeleton, surfaceLevel);
    Seepage seepage(state.mesh, setup.soil, setup.conductivity, setup.storage);
    log.line(text("Seepage: %zu nodes, %td cells of soil", seepage.nodes().size(),
                  std::ranges::count(setup.soil, 1)));
    const std::string flowUnit = whole > 1 ? "m3/s" : "m2/s";
    if (dryRun) {
        log.line("Dry run: everything was read and checked; nothing is written");
        return 0;
    }
    const std::vector<int> openPatches = scene.liquidBoundary.openPatches(state.mesh);
    std::vector<MonitorColumn> columns = {{"plugFlow", flowUnit},      {"seabedFlow", flowUnit},
                                          {"patchFlow", flowUnit},     {"tipExcessPressure", "Pa"},
                                          {"exitGradientAtAxis", "-"}, {"exitGradientAtWall", "-"}};
    std::vector<int> listed; // patches that let water through
    for (int p = 0; p < static_cast<int>(state.mesh.patches.size()); ++p) {
        if (std::ranges::find(openPatches, p) != openPatches.end()) {
            listed.push_back(p);
            columns.push_back({"patch_" + state.mesh.patches[p].name, flowUnit});
        }
    }
    Monitor monitor(caseDirectory, "seepage", runTime.startName(), "seepage", columns);
    const std::clock_t begin = std::clock();
    const auto report = [&](const std::vector<double>& excess, bool write) {
        const Figures figures = readOff(seepage, setup, state, surfaces, openPatches, excess, unitWeight);
        std::vector<double> values = {figures.plugFlow,  figures.seabedFlow, figures.patchFlow,
                                      figures.tipExcess, figures.exitAtAxis, figures.exitAtWall};
        log.line(text("Time = %g", state.time));
        for (const int p : listed) {
            values.push_back(figures.flowOfPatch[p]);
            log.line(text("Flow out of patch %s: %.6g %s", state.mesh.patches[p].name.c_str(),
                          figures.flowOfPatch[p], flowUnit.c_str()));
        }
        monitor.record(state.time, values);
        log.line(text("Flow out of the soil: plug %.6g, seabed %.6g, patches %.6g %s", figures.plugFlow,
                      figures.seabedFlow, figures.patchFlow, flowUnit.c_str()));
        log.line(text("Tip: mean excess pressure %.6g Pa; exit gradient at the axis %.5g, at the wall %.5g",
                      figures.tipExcess, figures.exitAtAxis, figures.exitAtWall));
        log.line(text("ExecutionTime = %.2f s", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC));
        if (write) {
            writeGrid(caseDirectory, seepage, setup, state.mesh, excess, unitWeight, state.time);
        }
    };
    if (!controls.transient) {
        report(seepage.steady(setup.given, setup.inflow), true);
    } else {
        // From the pressures of the points
        std::vector<double> excess(state.mesh.nodes(), 0);
        const auto step = makeTimeStep(scene, state);
        const std::vector<double> nodal = step->nodalPressures(state);
        for (const int i : seepage.nodes()) {
            excess[i] = std::isnan(setup.given[i]) ? nodal[i] + unitWeight * state.mesh.z[i] : setup.given[i];
        }
        report(excess, true);
        const long steps = std::lround((controls.endTime - state.time) / controls.deltaT);
        for (long i = 1; i <= steps; ++i) {
            state.time += controls.deltaT;
            const SeepageScene now = seepageScene(scene, state, controls.compressibleSkeleton, surfaceLevel);
            setup.given = now.given;
            setup.inflow = now.inflow;
            excess = seepage.advance(excess, controls.deltaT, controls.theta, setup.given, setup.inflow);
            report(excess, i % controls.writeInterval == 0 || i == steps);
        }
    }
    log.line("\nEnd\n");
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"seepageFoam", "[-case DIR] [-dry-run]",
                    "Steady or transient seepage through the soil of a two-phase case, by finite elements on "
                    "the mesh, round\n"
                    "its body where the start time, or system/seepageDict, has it."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")("dry-run",
                                                        "read and check everything, write nothing");
    program.run = [](const options::variables_map& given, const std::string& commandLine) {
        return run(given["case"].as<std::string>(), given.contains("dry-run"), commandLine);
    };
    return runProgram(std::move(program), argc, argv);
}
