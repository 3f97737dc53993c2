#include "LongRuns.h"

#include "dictionary/Text.h"
#include "support/StructuredMesh.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <unistd.h>

namespace caisson::stability {

namespace {

constexpr double courant = 0.8;

/// Memory of this program [MB].
double residentMemory()
{
    std::ifstream statistics("/proc/self/statm");
    long total = 0, resident = 0;
    statistics >> total >> resident;
    return 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double sum(const std::vector<double>& values)
{
    double result = 0;
    for (const double value : values) {
        result += value;
    }
    return result;
}

double largestSpeed(const MaterialPoints& points)
{
    double largest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        largest = std::max(largest, std::hypot(points.vr[p], points.vz[p]));
    }
    return largest;
}

Outcome judged(Outcome outcome, bool content, const std::string& figures)
{
    if (outcome.verdict == Verdict::holds && !content) {
        outcome.verdict = Verdict::breaks;
    }
    outcome.remark = outcome.remark.empty() ? figures : outcome.remark + "; " + figures;
    return outcome;
}

/// Saturated sand under water, disturbed a little, for a million steps.
Outcome millionSteps(bool triangles, double share)
{
    Block block{.kernel = {2, triangles, Geometry::axisymmetric}};
    block.columns = 3;
    block.rows = 4;
    block.soil.plastic = true;
    block.noise = 1e-6;
    Simulation simulation = make(block);
    simulation.start();
    const MaterialPoints& points = simulation.state.points;
    const long steps = std::lround(share * 1e6);
    Outcome outcome = drive(simulation, block.soil, steps / 10, courant);
    const double mass = sum(points.mass), volume = sum(points.volume), memory = residentMemory();
    const double early = kineticEnergy(simulation), before = largestSpeed(points);
    if (outcome.verdict == Verdict::holds) {
        outcome = drive(simulation, block.soil, steps - steps / 10, courant);
    }
    const double massDrift = std::abs(sum(points.mass) / mass - 1);
    const double volumeDrift = std::abs(sum(points.volume) / volume - 1);
    const double growth = residentMemory() - memory;
    return judged(
        outcome,
        massDrift == 0 && volumeDrift < 1e-6 && growth < 1 && kineticEnergy(simulation) <= 1.05 * early,
        text("%ld steps, of the last nine tenths: mass changed by %.1g, volume by %.1e, memory by %.2f MB; "
             "kinetic energy %.2e to %.2e J/rad, fastest %.1e to %.1e m/s",
             steps, massDrift, volumeDrift, growth, early, kineticEnergy(simulation), before,
             largestSpeed(points)));
}

/// A free block falls through a hundred cells, each smaller than the one above.
Outcome freeFall(bool triangles, double ofStable, double share)
{
    const int cells = std::max(20, static_cast<int>(100 * share));
    std::vector<double> lines(1, 0.0);
    for (int i = 0; i < cells; ++i) {
        lines.push_back(lines.back() + 0.05 * std::pow(1.02, i));
    }
    Soil soil;
    Simulation simulation;
    simulation.state.mesh =
        testing::structuredMesh(testing::evenLines(0, 0.4, 4), lines, Geometry::axisymmetric, triangles);
    const int material = simulation.addMaterial("soil", soil.dictionary());
    if (triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
    simulation.scene.gravity = {0, -9.81};
    simulation.setConditions("right { type zeroGradient; } bottom { type slip; } top { type zeroGradient; }");
    const double lower = lines[cells - 4], upper = lines[cells - 1];
    simulation.fill(material, triangles ? 3 : 2, 2,
                    [&](double r, double z) { return z > lower && z < upper && r < 0.3; });
    simulation.start();
    const double weighing =
        simulation.scene.materials[0].weighingDensity() / simulation.scene.materials[0].inertialDensity();
    const double duration = std::sqrt(2 * 0.85 * lower / (9.81 * weighing));
    const double step = ofStable * simulation.step->stableStep(simulation.state).step;
    Outcome outcome;
    const MaterialPoints& points = simulation.state.points;
    // The step changes from cell to cell: what has been fallen through follows from the time.
    while (outcome.verdict == Verdict::holds && simulation.state.time < duration) {
        outcome = drive(simulation, soil, std::lround(0.05 * duration / step), ofStable);
    }
    const double exact = -0.5 * 9.81 * weighing * simulation.state.time * simulation.state.time;
    double error = 0, stress = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        error = std::max(error, std::abs(points.z[p] - points.initialZ[p] - exact));
        stress = std::max(stress, std::abs(points.stress[1][p]));
    }
    return judged(outcome, error < 1e-9 && stress < 1e-3,
                  text("fell %.3g m in %ld steps: largest error of place %.1e m, of stress %.1e Pa", -exact,
                       simulation.state.step, error, stress));
}

Outcome revolutions(bool triangles, int cells, double share)
{
    const Soil soil;
    const Kernel kernel{1, triangles, Geometry::planeStrain};
    const double speed = 0.01 * std::sqrt(72e6 / 2072.5);
    Simulation simulation = turningDisk(kernel, soil, speed, cells);
    simulation.start();
    const MaterialPoints& points = simulation.state.points;
    const auto angular = [&] {
        double result = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            result +=
                points.mass[p] * ((points.r[p] - 0.6) * points.vz[p] - (points.z[p] - 0.6) * points.vr[p]);
        }
        return result;
    };
    const double momentum = angular(), energy = kineticEnergy(simulation);
    const double step = courant * simulation.step->stableStep(simulation.state).step;
    const Outcome outcome =
        drive(simulation, soil, std::lround(share * 10 * 2 * M_PI * 0.4 / speed / step), courant);
    double spread = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        spread = std::max(spread, std::abs(std::hypot(points.r[p] - 0.6, points.z[p] - 0.6) -
                                           std::hypot(points.initialR[p] - 0.6, points.initialZ[p] - 0.6)));
    }
    return judged(
        outcome, std::abs(angular() / momentum) < 1.05,
        text("%.3g revolutions, %ld steps: angular momentum %.4f, kinetic energy %.4f of those at the "
             "start, points off their circles by %.1e m at most",
             10 * share, simulation.state.step, angular() / momentum, kineticEnergy(simulation) / energy,
             spread));
}

Outcome cycles(int phases, bool plastic, double share)
{
    constexpr double period = 0.1, load = 1e4;
    const int count = std::max(5, static_cast<int>(1000 * share));
    std::string table;
    for (int i = 0; i <= 2 * count + 2; ++i) {
        table += text("(%g (0 0 %g)) ", 0.5 * i * period, i % 2 == 0 ? 0.0 : -load);
    }
    Column column{.kernel = {phases, false, Geometry::axisymmetric}};
    column.soil.plastic = plastic;
    column.soil.permeability = 1e-10;
    column.emptyCells = 0;
    column.top = "type traction; uniformValue table (" + table + ");";
    column.topWater = "type fixedValue; value uniform 0;";
    Simulation simulation = make(column);
    simulation.setStress([](double, double) { return std::array<double, 4>{-1e2, -1e2, -1e2, 0}; });
    simulation.scene.controls.linearBulkViscosity = 0.06;
    simulation.start();
    const auto driveTo =
        [&](double time) { // not a number of steps per cycle: the load would get out of phase
            const double step = courant * simulation.step->stableStep(simulation.state).step;
            return drive(simulation, column.soil, std::lround((time - simulation.state.time) / step),
                         courant);
        };
    const MaterialPoints& points = simulation.state.points;
    const auto top = [&] {
        double result = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            result = std::min(result, points.z[p] - points.initialZ[p]);
        }
        return result;
    };
    Outcome outcome;
    double tenth = 0, deepest = 0;
    for (int i = 0; i < count && outcome.verdict == Verdict::holds; ++i) {
        outcome = driveTo((i + 0.5) * period);
        deepest = std::min(deepest, top());
        if (outcome.verdict == Verdict::holds) {
            outcome = driveTo((i + 1) * period);
        }
        tenth = i + 1 == std::max(1, count / 10) ? top() : tenth;
    }
    return judged(
        outcome, std::abs(deepest) < 10 * load / 72e6,
        text("%d cycles, %ld steps: settlement under load %.2e m; after the first tenth %.2e m, at the "
             "end %.2e m are left",
             count, simulation.state.step, -deepest, -tenth, -top()));
}

/// Soil that is thrown at the axis again and again, at a hundredth of the speed of waves.
Outcome thrownAtTheAxis(int phases, bool triangles, double share)
{
    Block block{.kernel = {phases, triangles, Geometry::axisymmetric}};
    block.soil.plastic = true;
    block.emptyRows = 20;
    Simulation simulation = make(block);
    simulation.start();
    MaterialPoints& points = simulation.state.points;
    const double speed = 0.01 * std::sqrt(72e6 / 2072.5);
    Outcome outcome;
    const int throws = std::max(2, static_cast<int>(20 * share));
    double least = 1;
    for (int i = 0; i < throws && outcome.verdict == Verdict::holds; ++i) {
        for (std::size_t p = 0; p < points.size(); ++p) {
            points.vr[p] = points.r[p] < 0.2 ? -speed : 0;
            points.vz[p] = 0;
            if (phases == 2) {
                points.wr[p] = points.vr[p];
                points.wz[p] = 0;
            }
        }
        outcome = drive(simulation, block.soil, 500, courant);
        least = std::min(least, *std::ranges::min_element(points.r));
    }
    return judged(outcome, least >= 0,
                  text("%d throws, %ld steps: least radius of a point %.1e m, fastest at the end %.2g m/s",
                       throws, simulation.state.step, least, largestSpeed(points)));
}

/// Soil at rest under its weight, with one point in each cell.
Outcome singlePoints(int phases, double share)
{
    Block block{.kernel = {phases, false, Geometry::axisymmetric}};
    block.columns = 4;
    block.soil.plastic = true;
    block.pointsPerSide = 1;
    block.noise = 1e-6;
    Simulation simulation = make(block);
    const double before = largestSpeed(simulation.state.points);
    const long steps = std::lround(share * 1e5);
    const Outcome outcome = drive(simulation, block.soil, steps, courant);
    const MaterialPoints& points = simulation.state.points;
    double moved = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        moved =
            std::max(moved, std::hypot(points.r[p] - points.initialR[p], points.z[p] - points.initialZ[p]));
    }
    return judged(outcome, moved < 0.1,
                  text("%ld steps: fastest %.1e to %.1e m/s, moved by %.1e m at most", steps, before,
                       largestSpeed(points), moved));
}

/// A block that goes up and down through the cells: they empty and fill.
Outcome emptyAndFill(int phases, bool triangles, double share)
{
    const Kernel kernel{phases, triangles, Geometry::axisymmetric};
    Block block{.kernel = kernel};
    block.columns = 4;
    block.rows = 4;
    block.emptyRows = 8;
    block.gravity = 0;
    block.noise = 0;
    Simulation simulation = make(block);
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.z[p] += 0.3;
    }
    findCells(simulation);
    simulation.start();
    const int passes = std::max(2, static_cast<int>(40 * share));
    double direction = 1;
    Outcome outcome;
    double stress = 0;
    for (int i = 0; i < passes && outcome.verdict == Verdict::holds; ++i) {
        const double speed = 1.0 * direction;
        simulation.setVelocity([&](double, double) { return std::array<double, 2>{0, speed}; });
        if (phases == 2) {
            points.wr = points.vr;
            points.wz = points.vz;
        }
        const double step = courant * simulation.step->stableStep(simulation.state).step;
        outcome = drive(simulation, block.soil, std::lround((i == 0 ? 0.2 : 0.35) / step), courant);
        direction = -direction;
        for (std::size_t p = 0; p < points.size(); ++p) {
            stress = std::max({stress, std::abs(points.stress[0][p]), std::abs(points.stress[1][p])});
        }
    }
    return judged(outcome, stress < 1,
                  text("%d passes over three and a half cells, %ld steps: largest stress %.1e Pa", passes,
                       simulation.state.step, stress));
}

} // namespace

std::vector<LongRun> longRuns()
{
    std::vector<LongRun> all;
    const auto shape = [](bool triangles) {
        return std::string(triangles ? ", triangles" : ", quadrilaterals");
    };
    const auto phase = [](int phases) { return std::string(phases == 1 ? ", one phase" : ", two phases"); };
    for (const bool triangles : {false, true}) {
        all.push_back({"a million steps, two phases" + shape(triangles),
                       [=](double share) { return millionSteps(triangles, share); }});
        for (const double ofStable : {0.8, 0.65, 0.5}) {
            all.push_back({text("free fall through 100 graded cells at %g of the stable step", ofStable) +
                               shape(triangles),
                           [=](double share) { return freeFall(triangles, ofStable, share); }});
        }
        for (const int cells : {4, 8}) {
            all.push_back({text("ten revolutions of a disk of %d cells", 2 * cells) + shape(triangles),
                           [=](double share) { return revolutions(triangles, cells, share); }});
        }
        for (const int phases : {1, 2}) {
            all.push_back({"thrown at the axis" + phase(phases) + shape(triangles),
                           [=](double share) { return thrownAtTheAxis(phases, triangles, share); }});
            all.push_back({"cells that empty and fill" + phase(phases) + shape(triangles),
                           [=](double share) { return emptyAndFill(phases, triangles, share); }});
        }
    }
    for (const int phases : {1, 2}) {
        for (const bool plastic : {false, true}) {
            all.push_back(
                {std::string("a thousand load cycles, ") + (plastic ? "sand" : "elastic") + phase(phases),
                 [=](double share) { return cycles(phases, plastic, share); }});
        }
        all.push_back({"one point per cell" + phase(phases),
                       [=](double share) { return singlePoints(phases, share); }});
    }
    return all;
}

} // namespace caisson::stability
