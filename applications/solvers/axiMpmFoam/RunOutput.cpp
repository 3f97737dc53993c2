#include "RunOutput.h"

#include "dictionary/Text.h"
#include "materialPoints/CloudConversion.h"
#include "output/Vtk.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

namespace caisson {

namespace {

/// Points that had no other above them at the start, closer to the vertical than 45 degrees: none has both
/// z - r and z + r greater.
std::vector<int> topmostPoints(const MaterialPoints& points)
{
    std::vector<std::array<double, 3>> order; // z - r, z + r, point
    for (std::size_t p = 0; p < points.size(); ++p) {
        order.push_back({points.initialZ[p] - points.initialR[p], points.initialZ[p] + points.initialR[p],
                         static_cast<double>(p)});
    }
    std::ranges::sort(order, std::greater());
    std::vector<int> topmost;
    double greatest = -std::numeric_limits<double>::max();
    for (const auto& [difference, sum, p] : order) {
        if (sum > greatest) {
            greatest = sum;
            topmost.push_back(static_cast<int>(p));
        }
    }
    return topmost;
}

} // namespace

SurfaceHeave::SurfaceHeave(const State& state, const RigidBody& body)
{
    double inner = std::numeric_limits<double>::max();
    double outer = 0;
    for (const ProfileEdge& edge : body.profile) {
        if (edge.part == SurfacePart::inner) {
            inner = std::min(inner, edge.from[0]);
        }
        outer = std::max({outer, edge.from[0], edge.to[0]});
    }
    if (state.mesh.geometry != Geometry::axisymmetric || inner > outer) {
        return;
    }
    innerRadius_ = inner;
    outerRadius_ = outer;
    initialPenetration_ = body.surfaceLevel - body.initialTipLevel;

    // Strips between the radii that occur among the topmost points.
    const MaterialPoints& points = state.points;
    const auto distinctRadii = [&](const std::vector<int>& of) {
        std::vector<double> radii;
        radii.reserve(of.size());
        for (const int p : of) {
            radii.push_back(points.initialR[p]);
        }
        std::ranges::sort(radii);
        const auto same = [&](double a, double b) { return b - a <= 1e-6 * outerRadius_; };
        radii.erase(std::unique(radii.begin(), radii.end(), same), radii.end());
        return radii;
    };
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<double> distinct = distinctRadii(all);
    // Regular filling repeats its radii; for an irregular one, strips hold some hundred points each.
    if (distinct.size() > points.size() / 4) {
        std::vector<double> coarse;
        for (std::size_t i = 0; i < distinct.size(); i += 100) {
            coarse.push_back(distinct[i]);
        }
        distinct = coarse;
    } else {
        distinct = distinctRadii(topmostPoints(points));
    }
    std::vector<double> edges(1, 0.0);
    for (std::size_t i = 1; i < distinct.size(); ++i) {
        double middle = 0.5 * (distinct[i - 1] + distinct[i]);
        if (distinct[i - 1] < innerRadius_ && distinct[i] > innerRadius_) {
            middle = innerRadius_;
        } else if (distinct[i - 1] < outerRadius_ && distinct[i] > outerRadius_) {
            middle = outerRadius_;
        }
        edges.push_back(middle);
    }
    edges.push_back(*std::ranges::max_element(state.mesh.r));
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i] < innerRadius_ || edges[i] >= outerRadius_) {
            columns_.push_back({edges[i], edges[i + 1], {}});
        }
    }
    std::vector<double> top(columns_.size(), -std::numeric_limits<double>::max());
    const auto columnOf = [this](double r) {
        const auto above = std::ranges::upper_bound(columns_, r, {}, &Column::from);
        const std::ptrdiff_t i = above - columns_.begin() - 1;
        return i >= 0 && r <= columns_[i].to ? i : -1;
    };
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (const auto i = columnOf(points.initialR[p]); i >= 0) {
            top[i] = std::max(top[i], points.initialZ[p]);
        }
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (const auto i = columnOf(points.initialR[p]);
            i >= 0 && points.initialZ[p] >= top[i] - 1e-9 * outerRadius_) {
            columns_[i].ids.push_back(points.id[p]);
        }
    }
    std::erase_if(columns_, [](const Column& column) { return column.ids.empty(); });
}

SurfaceHeave::Result SurfaceHeave::measure(const State& state, const RigidBody& body) const
{
    std::vector<int> place;
    const MaterialPoints& points = state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points.id[p] >= static_cast<int>(place.size())) {
            place.resize(points.id[p] + 1, -1);
        }
        place[points.id[p]] = static_cast<int>(p);
    }
    Result result;
    bool first = true;
    for (const Column& column : columns_) {
        double rise = 0;
        for (const int id : column.ids) {
            rise +=
                (points.z[place[id]] - points.initialZ[place[id]]) / static_cast<double>(column.ids.size());
        }
        const double area = std::numbers::pi * (column.to * column.to - column.from * column.from);
        if (column.from < innerRadius_) {
            result.inside += area * rise;
            result.wall = rise; // the last one inside stands
            result.centre = first ? rise : result.centre;
            first = false;
        } else {
            result.outside += area * rise;
        }
    }
    result.wallVolume = std::numbers::pi * (outerRadius_ * outerRadius_ - innerRadius_ * innerRadius_) *
                        (body.penetration() - initialPenetration_);
    return result;
}

// ---------------------------------------------------------------------------------------------------------

RunOutput::RunOutput(RunTime& runTime, const CaseScene& caseScene, Log& log)
    : runTime_(runTime), case_(caseScene), log_(log)
{
    const State& state = caseScene.state;
    const bool axisymmetric = state.mesh.geometry == Geometry::axisymmetric;
    whole_ = axisymmetric ? 2 * std::numbers::pi : 1;
    const std::string force = axisymmetric ? "N" : "N/m";
    for (const RigidBody& body : state.bodies) {
        SurfaceHeave heave(state, body);
        std::vector<MonitorColumn> columns{{"penetration", "m"}, {"velocity", "m/s"},   {"totalForce", force},
                                           {"tipForce", force},  {"innerForce", force}, {"outerForce", force},
                                           {"lidForce", force}};
        if (state.points.twoPhase()) {
            columns.push_back({"waterForce", force});
            columns.push_back({"suction", "Pa"});
        }
        BodyOutput output{Monitor(runTime.caseDirectory(), body.name, runTime.startName(), body.name, columns,
                                  caseScene.monitorInterval),
                          nullptr,
                          std::move(heave),
                          {}};
        if (output.heave.applies()) {
            output.plugMonitor =
                std::make_unique<Monitor>(runTime.caseDirectory(), "plug", runTime.startName(), body.name,
                                          std::vector<MonitorColumn>{{"penetration", "m"},
                                                                     {"heaveAtCentre", "m"},
                                                                     {"heaveAtWall", "m"},
                                                                     {"volumeInside", "m3"},
                                                                     {"volumeOutside", "m3"},
                                                                     {"wallVolume", "m3"}},
                                          10 * caseScene.monitorInterval);
        }
        output.last.name = body.name;
        bodies_.push_back(std::move(output));
    }
    touchCaseFile(runTime.caseDirectory());
    if (!runTime.restarted()) {
        writeVtk(state);
    }
    lastMark_ = Log::processorSeconds();
}

bool RunOutput::logDue() const { return runTime_.index() % std::max(1, runTime_.control().logInterval) == 0; }

void RunOutput::recordBodies(State& state)
{
    const double time = runTime_.time();
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        BodyOutput& output = bodies_[b];
        if (!output.monitor.due(time)) {
            continue;
        }
        const RigidBody& body = state.bodies[b];
        BodyReaction& reaction = state.reactions[b];
        const double share = reaction.duration > 0 ? whole_ / reaction.duration : 0;
        const auto part = [&](SurfacePart surface) {
            return share * reaction.verticalImpulse[static_cast<int>(surface)];
        };
        BodyReport& report = output.last;
        report.tipForce = part(SurfacePart::tip);
        report.innerForce = part(SurfacePart::inner);
        report.outerForce = part(SurfacePart::outer);
        report.lidForce = part(SurfacePart::lid);
        report.totalForce = report.tipForce + report.innerForce + report.outerForce + report.lidForce;
        report.penetration = body.penetration();
        report.normalisedPenetration = body.penetration() / body.referenceLength;
        report.velocity = body.velocity;
        report.suction = reaction.suction;
        std::vector<double> values{report.penetration, report.velocity,   report.totalForce, report.tipForce,
                                   report.innerForce,  report.outerForce, report.lidForce};
        if (state.points.twoPhase()) {
            values.push_back(share * reaction.waterImpulse);
            values.push_back(reaction.suction);
        }
        output.monitor.record(time, values);
        reaction.restartCollection();
        if (output.plugMonitor && output.plugMonitor->due(time)) {
            const SurfaceHeave::Result heave = output.heave.measure(state, body);
            report.plugHeave = heave.centre;
            const double plug[] = {report.penetration, heave.centre,  heave.wall,
                                   heave.inside,       heave.outside, heave.wallVolume};
            output.plugMonitor->record(time, plug);
        }
    }
}

void RunOutput::watchGates(const State& state, double kinetic, double work)
{
    const SolutionControls& controls = case_.scene.controls;
    double longestRamp = 0;
    for (const RigidBody& body : state.bodies) {
        longestRamp = std::max(longestRamp, body.ramp);
    }
    if (!warnedOfEnergy_ && work > 0 && state.time > 2 * longestRamp &&
        kinetic > controls.energyGate * work) {
        warnedOfEnergy_ = true;
        log_.warning(
            text("kinetic energy is %.3g of the work done, above energyGate %.3g: the process is not "
                 "quasi-static; lower massScaling or the rate",
                 kinetic / work, controls.energyGate));
    }
    if (warnedOfInertia_ || state.massScaling <= 1 ||
        controls.massScalingBy == SolutionControls::MassScaling::gates) {
        return;
    }
    for (const RigidBody& body : state.bodies) {
        const Material& soil = case_.scene.materials.front();
        const double weight =
            soil.weighingDensity() * std::hypot(case_.scene.gravity[0], case_.scene.gravity[1]);
        const double vertical = weight * body.penetration();
        const double inertia = state.massScaling * soil.inertialDensity() * body.velocity * body.velocity;
        if (vertical > 0 && inertia > controls.inertiaGate * vertical) {
            warnedOfInertia_ = true;
            log_.warning(text(
                "scaled inertia rho v^2 = %.3g Pa is %.3g of the vertical effective stress at the tip of %s, "
                "above inertiaGate %.3g: forces are too high by a like share; lower massScaling",
                inertia, inertia / vertical, body.name.c_str(), controls.inertiaGate));
        }
    }
}

void RunOutput::afterStep(State& state, const TimeStep& step, double courant,
                          const QuasiSteadySeepage* seepage)
{
    const double now = Log::processorSeconds();
    stepSeconds_ += now - lastMark_;
    const double points = static_cast<double>(state.points.size());
    pointSteps_ += points;
    recordBodies(state);
    if (state.points.twoPhase() && state.step % CheckerboardWatch::interval == 0) {
        const double index = step.checkerboardIndex(state);
        if (checkerboardWatch_.warns(index)) {
            log_.warning(text("pore pressures alternate from cell to cell (checkerboard index %.2f): do not "
                              "trust them; with stiff water use pressureCoupling projection, or less "
                              "massScaling",
                              index));
        }
    }
    if (logDue() || runTime_.writeTime() || !runTime_.running()) {
        const Energies energies = sumEnergies(state);
        double work = 0;
        for (const BodyReaction& reaction : state.reactions) {
            work += whole_ * reaction.work;
        }
        watchGates(state, whole_ * energies.kineticScaled, work);
        StepReport report;
        report.courantMean = report.courantMax = courant;
        report.kineticEnergy = whole_ * energies.kinetic;
        report.strainWork = work;
        for (const BodyOutput& output : bodies_) {
            report.bodies.push_back(output.last);
        }
        report.pointSteps = points;
        const CellCounts cells = step.cellCounts(state);
        report.lines.push_back(text("Cells: FEM = %d, filled = %d, partly filled = %d, empty = %d", cells.fem,
                                    cells.filled, cells.partial, cells.empty));
        if (state.points.twoPhase()) {
            report.lines.push_back(
                text("Pore pressure: checkerboard index = %.4f", step.checkerboardIndex(state)));
        }
        if (seepage) {
            report.lines.push_back(seepage->report());
            if (!warnedOfSeepage_ && seepage->leftOut() > case_.scene.controls.seepageGate) {
                warnedOfSeepage_ = true;
                log_.warning(text(
                    "what quasi-steady seepage leaves out is %.3g of its pressures, above seepageGate %.3g: "
                    "the soil is not drained at this rate; phases 2 computes it",
                    seepage->leftOut(), case_.scene.controls.seepageGate));
            }
        }
        if (case_.scene.controls.massScalingBy == SolutionControls::MassScaling::gates) {
            report.lines.push_back(text("Mass scaling = %.4g", state.massScaling));
        }
        log_.step(runTime_, report);
    } else {
        StepReport silent;
        silent.pointSteps = points;
        log_.step(runTime_, silent);
    }
    lastMark_ = Log::processorSeconds();
}

void RunOutput::write(const State& state, const TimeStep& step)
{
    runTime_.kept = keptNumbers(state);
    const WriteStyle& style = runTime_.control().writeStyle;
    const BackgroundMesh& mesh = state.mesh;
    const Cloud points = cloud(state.points, case_.stateNames);
    runTime_.write([&](const std::filesystem::path& folder) {
        writeCloud(folder, points, style);
        if (case_.scene.movingBody >= 0) {
            writePoints(folder, polyMeshPoints(mesh), style);
        }
        NamedField velocity{"U", FieldKind::vector,
                            std::vector<double>(3 * static_cast<std::size_t>(mesh.polyMeshPoints), 0.0)};
        const auto nodal = step.nodalVelocities(state);
        for (int i = 0; i < mesh.nodes(); ++i) {
            for (const int point : mesh.nodePoints[i]) {
                const std::size_t place = 3 * static_cast<std::size_t>(point);
                velocity.values[place] = nodal[i][0];
                velocity.values[place + 2] = nodal[i][1];
            }
        }
        writeField(folder, velocity, true, "[0 1 -1 0 0 0 0]", case_.patchEntries, style);
        if (!case_.pressureEntries.empty()) {
            NamedField pressure{"p", FieldKind::scalar,
                                std::vector<double>(static_cast<std::size_t>(mesh.polyMeshPoints), 0.0)};
            const auto nodalPressure = step.nodalPressures(state);
            for (int i = 0; i < mesh.nodes(); ++i) {
                for (const int point : mesh.nodePoints[i]) {
                    pressure.values[point] = nodalPressure[i];
                }
            }
            writeField(folder, pressure, true, "[1 -1 -2 0 0 0 0]", case_.pressureEntries, style);
        }

        std::vector<std::pair<std::string, std::string>> calculated;
        for (const auto& [patch, entries] : case_.patchEntries) {
            const bool constraint =
                entries.find("wedge") != std::string::npos || entries.find("empty") != std::string::npos;
            calculated.emplace_back(patch, constraint ? entries : "type zeroGradient;");
        }
        NamedField filled{"filled", FieldKind::scalar, {state.filled.begin(), state.filled.end()}};
        writeField(folder, filled, false, "[0 0 0 0 0 0 0]", calculated, style);
        if (case_.scene.controls.isViscous()) {
            const NamedField rate{"dilatationRate", FieldKind::scalar, state.cellDivergence};
            writeField(folder, rate, false, "[0 0 -1 0 0 0 0]", calculated, style);
        }
    });
    writeVtk(state);
    lastMark_ = Log::processorSeconds();
}

void RunOutput::writeVtk(const State& state) const
{
    const std::filesystem::path folder = runTime_.caseDirectory() / "VTK/materialPoints";
    std::filesystem::create_directories(folder);
    writeVtp(vtkSeriesFile(folder, "materialPoints", runTime_.timeName(), "vtp"),
             cloud(state.points, case_.stateNames), state.time);
    writeVtkSeries(folder, "materialPoints", "vtp", state.time);
}

void RunOutput::summary(const State& state) const
{
    if (pointSteps_ > 0) {
        log_.line(text("Speed: %.1f ns per point and step (processor time of all threads, %zu points, output "
                       "apart)",
                       1e9 * stepSeconds_ / pointSteps_, state.points.size()));
    }
}

} // namespace caisson
