#include "Scenes.h"

#include "dictionary/Text.h"
#include "mesh/CellLocator.h"
#include "support/StructuredMesh.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace caisson::stability {

using testing::evenLines;
using testing::structuredMesh;

std::string Kernel::name() const
{
    return text("%d phase%s, %s", phases, phases == 1 ? "" : "s", triangles ? "triangles" : "quadrilaterals");
}

std::string Soil::dictionary() const
{
    std::string result =
        text("law %s; porosity %g; solidDensity %g; liquidDensity %g; youngsModulus %.17g; poissonsRatio "
             "%.17g; intrinsicPermeability %.17g; liquidBulkModulus %.17g; liquidViscosity %g;",
             plastic ? "mohrCoulomb" : "linearElastic", porosity, solidDensity, liquidDensity, youngsModulus,
             poissonsRatio, permeability, liquidBulkModulus, viscosity);
    if (plastic) {
        result += text("frictionAngle %.17g; dilatancyAngle %.17g; cohesion %.17g;", frictionAngle,
                       dilatancyAngle, cohesion);
    }
    return result;
}

double Soil::yieldExcess(const MaterialPoints& points) const
{
    if (!plastic) {
        return 0;
    }
    const double sine = std::sin(frictionAngle * M_PI / 180), cosine = std::cos(frictionAngle * M_PI / 180);
    double largest = -1, reference = cohesion;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double rr = points.stress[0][p], zz = points.stress[1][p], tt = points.stress[2][p];
        const double mean = 0.5 * (rr + zz), radius = std::hypot(0.5 * (rr - zz), points.stress[3][p]);
        const double s1 = std::max(mean + radius, tt), s3 = std::min(mean - radius, tt);
        reference = std::max({reference, std::abs(s1), std::abs(s3)});
        largest = std::max(largest, s1 - s3 + (s1 + s3) * sine - 2 * cohesion * cosine);
    }
    return reference > 0 ? largest / reference : 0;
}

namespace {

void setControls(Simulation& simulation, const Kernel& kernel)
{
    simulation.scene.controls.phases = kernel.phases;
    simulation.scene.controls.threads = 1;
    if (kernel.triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
}

/// Stress of the soil's own weight below water, as wide as it is high, and hydrostatic pore pressure.
void setWeight(Simulation& simulation, const Kernel& kernel, double surface, double gravity)
{
    if (kernel.phases == 2) {
        simulation.state.points.addLiquid();
    }
    if (gravity == 0) {
        return;
    }
    simulation.scene.gravity = {0, -gravity};
    simulation.setStress([&](double, double z) {
        const double vertical = -Soil::buoyantWeight * gravity / 9.81 * (surface - z);
        return std::array<double, 4>{vertical, vertical, vertical, 0};
    });
    for (std::size_t p = 0; kernel.phases == 2 && p < simulation.state.points.size(); ++p) {
        simulation.state.points.porePressure[p] =
            Soil::liquidDensity * gravity * (surface - simulation.state.points.z[p]);
    }
}

void addFreeSurface(Simulation& simulation, double level)
{
    FreeSurface surface;
    surface.name = "seabed";
    surface.level = level;
    simulation.scene.freeSurfaces.push_back(std::move(surface));
}

void setBox(Simulation& simulation, const Kernel& kernel, const std::string& top,
            const std::string& bottomWater, const std::string& topWater)
{
    const bool left = kernel.geometry == Geometry::planeStrain;
    simulation.setConditions((left ? "left { type slip; } " : "") +
                             std::string("right { type slip; } bottom { type slip; } top { ") + top + " }");
    if (kernel.phases == 2) {
        simulation.setPressures((left ? "left { type impermeable; } " : "") +
                                std::string("right { type impermeable; } bottom { ") + bottomWater +
                                " } top { " + topWater + " }");
    }
}

void placeRandomly(Simulation& simulation, std::mt19937& random)
{
    std::uniform_real_distribution<double> share(0.001, 0.999);
    const BackgroundMesh& mesh = simulation.state.mesh;
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const int c = points.cell[p];
        double x = share(random), y = share(random);
        if (mesh.corners == 3 && x + y > 1) {
            x = 1 - x;
            y = 1 - y;
        }
        const int a = mesh.node(c, 0), b = mesh.node(c, 1), d = mesh.node(c, mesh.corners - 1);
        points.r[p] = mesh.r[a] + x * (mesh.r[b] - mesh.r[a]) + y * (mesh.r[d] - mesh.r[a]);
        points.z[p] = mesh.z[a] + x * (mesh.z[b] - mesh.z[a]) + y * (mesh.z[d] - mesh.z[a]);
        points.initialR[p] = points.r[p];
        points.initialZ[p] = points.z[p];
    }
}

} // namespace

double waveSpeed(const Simulation& simulation)
{
    return simulation.step->stableStep(simulation.state).waveSpeed;
}

double kineticEnergy(const Simulation& simulation)
{
    const MaterialPoints& points = simulation.state.points;
    double sum = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double solid = points.vr[p] * points.vr[p] + points.vz[p] * points.vz[p];
        if (!points.twoPhase()) {
            sum += 0.5 * points.mass[p] * solid;
            continue;
        }
        const double liquid = points.wr[p] * points.wr[p] + points.wz[p] * points.wz[p];
        constexpr double share =
            Soil::porosity * Soil::liquidDensity /
            (Soil::porosity * Soil::liquidDensity + (1 - Soil::porosity) * Soil::solidDensity);
        sum += 0.5 * points.mass[p] * ((1 - share) * solid + share * liquid);
    }
    return sum;
}

double angularMomentum(const Simulation& simulation)
{
    const MaterialPoints& points = simulation.state.points;
    double sum = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        sum += points.mass[p] *
               ((points.r[p] - diskCentre) * points.vz[p] - (points.z[p] - diskCentre) * points.vr[p]);
    }
    return sum;
}

/// Largest change of a point's distance from the centre of its disk [m].
double offCircle(const Simulation& simulation)
{
    const MaterialPoints& points = simulation.state.points;
    double largest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double now = std::hypot(points.r[p] - diskCentre, points.z[p] - diskCentre);
        const double then = std::hypot(points.initialR[p] - diskCentre, points.initialZ[p] - diskCentre);
        largest = std::max(largest, std::abs(now - then));
    }
    return largest;
}

void findCells(Simulation& simulation)
{
    const CellLocator locator(simulation.state.mesh);
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.cell[p] = locator.find(points.r[p], points.z[p]);
    }
}

Simulation make(const Block& block)
{
    Simulation simulation;
    const Kernel& kernel = block.kernel;
    const double width = block.columns * block.cellWidth, height = block.rows * block.cellHeight;
    simulation.state.mesh = structuredMesh(
        evenLines(0, width, block.columns),
        evenLines(0, height + block.emptyRows * block.cellHeight, block.rows + block.emptyRows),
        kernel.geometry, kernel.triangles);
    const int material = simulation.addMaterial("soil", block.soil.dictionary());
    setControls(simulation, kernel);
    simulation.scene.controls.drag = block.drag;
    simulation.scene.controls.massScaling = block.massScaling;
    setBox(simulation, kernel, "type zeroGradient;", "type impermeable;",
           block.emptyRows > 0 ? "type impermeable;" : "type fixedValue; value uniform 0;");
    if (kernel.phases == 2 && block.emptyRows > 0) {
        addFreeSurface(simulation, height);
    }
    const int holeColumn = block.columns / 2, holeRow = block.rows / 2;
    const double holeR = (holeColumn + 0.5) * block.cellWidth;
    const double holeZ = (holeRow + 0.5) * block.cellHeight;
    simulation.fill(material, kernel.triangles ? (block.pointsPerSide == 1 ? 1 : 3) : block.pointsPerSide,
                    block.pointsPerSide, [&](double r, double z) {
                        const bool inHole = block.hole && std::abs(r - holeR) < 0.5 * block.cellWidth &&
                                            std::abs(z - holeZ) < 0.5 * block.cellHeight;
                        return z < height && !inHole;
                    });
    std::mt19937 random(block.seed);
    if (block.randomPlaces) {
        placeRandomly(simulation, random);
    }
    setWeight(simulation, kernel, height, block.gravity);
    const double modulus = simulation.scene.materials[0].law->pWaveModulus();
    const double amplitude =
        block.noise * std::sqrt(modulus / simulation.scene.materials[0].inertialDensity());
    std::uniform_real_distribution<double> velocity(-amplitude, amplitude);
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.vr[p] = velocity(random);
        points.vz[p] = velocity(random);
        if (kernel.phases == 2) {
            points.wr[p] = velocity(random);
            points.wz[p] = velocity(random);
        }
    }
    return simulation;
}

Simulation make(const Skirt& options)
{
    Simulation simulation;
    const Kernel& kernel = options.kernel;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 2.4, 24), evenLines(-2, 0.4, 24), kernel.geometry, kernel.triangles);
    const int sand = simulation.addMaterial("sand", options.soil.dictionary());
    setControls(simulation, kernel);
    simulation.scene.controls.massScaling = options.massScaling;
    setBox(simulation, kernel, "type zeroGradient;", "type impermeable;", "type impermeable;");
    if (kernel.phases == 2) {
        addFreeSurface(simulation, 0);
    }
    RigidBody skirt;
    skirt.name = "skirt";
    skirt.profile = caissonProfile(1.2, 0.2, 5, 0, 0);
    skirt.tipLevel = skirt.initialTipLevel = -0.5;
    skirt.friction = options.friction;
    skirt.ramp = options.ramp;
    skirt.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(options.rate));
    simulation.fill(sand, kernel.triangles ? 3 : 2, 2,
                    [&](double r, double z) { return z < 0 && !skirt.contains(r, z); });
    simulation.state.bodies.push_back(std::move(skirt));
    simulation.scene.motion = MeshMotion({-1.8, -0.8, -0.3, 0}, "skirt");
    simulation.scene.movingBody = 0;
    setWeight(simulation, kernel, 0, 9.81);
    return simulation;
}

Simulation make(const Column& column)
{
    Simulation simulation;
    const Kernel& kernel = column.kernel;
    const double h = 1.0 / column.cells;
    simulation.state.mesh = structuredMesh(
        evenLines(0, h, 1), evenLines(0, 1 + column.emptyCells * h, column.cells + column.emptyCells),
        kernel.geometry, kernel.triangles);
    const int material = simulation.addMaterial("soil", column.soil.dictionary());
    setControls(simulation, kernel);
    setBox(simulation, kernel, column.top, column.bottomWater, column.topWater);
    if (kernel.phases == 2 && column.emptyCells > 0) {
        addFreeSurface(simulation, 1);
    }
    simulation.fill(material, kernel.triangles ? (column.pointsPerSide == 1 ? 1 : 3) : column.pointsPerSide,
                    column.pointsPerSide, [](double, double z) { return z < 1; });
    setWeight(simulation, kernel, 1, column.gravity);
    return simulation;
}

Simulation turningDisk(const Kernel& kernel, const Soil& soil, double rimSpeed, int cells)
{
    constexpr double radius = diskRadius, centre = diskCentre;
    const std::vector<double> lines = evenLines(0, 2 * centre, 3 * cells);
    Simulation simulation;
    simulation.state.mesh = structuredMesh(lines, lines, Geometry::planeStrain, kernel.triangles);
    const int material = simulation.addMaterial("disk", soil.dictionary());
    setControls(simulation, kernel);
    const std::string free = "{ type zeroGradient; } ";
    simulation.setConditions("left " + free + "right " + free + "bottom " + free + "top " + free);
    if (kernel.phases == 2) {
        const std::string tight = "{ type impermeable; } ";
        simulation.setPressures("left " + tight + "right " + tight + "bottom " + tight + "top " + tight);
        addFreeSurface(simulation, 0);
    }
    simulation.fill(material, kernel.triangles ? 3 : 2, 2,
                    [](double x, double z) { return std::hypot(x - centre, z - centre) < radius; });
    setWeight(simulation, kernel, 0, 0);
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.vr[p] = -rimSpeed * (points.z[p] - centre) / radius;
        points.vz[p] = rimSpeed * (points.r[p] - centre) / radius;
        if (kernel.phases == 2) {
            points.wr[p] = points.vr[p];
            points.wz[p] = points.vz[p];
        }
    }
    return simulation;
}

} // namespace caisson::stability
