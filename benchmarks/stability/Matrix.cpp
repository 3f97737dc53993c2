#include "Matrix.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <cmath>

namespace caisson::stability {

namespace {

constexpr double courant = 0.8;
constexpr long steps = 1000;

std::vector<Kernel> kernels(int fewestPhases = 1)
{
    std::vector<Kernel> all;
    for (int phases = fewestPhases; phases <= 2; ++phases) {
        for (const bool triangles : {false, true}) {
            all.push_back({phases, triangles, Geometry::axisymmetric});
        }
    }
    return all;
}

/// The sweeps, each a function that adds its squares.
class Matrix
{
public:
    std::vector<Case> all;

    void permeability();
    void bulkModulus();
    void courantNumbers();
    void laggedDrag();
    void pointsPerCell();
    void aspectRatio();
    void interfaceFriction();
    void strength();
    void dilatancyAtTheSkirt();
    void freeSurface();
    void nearTheAxis();
    void tinyPoint();
    void rotation();
    void loadCycles();
    void upwardFlow();
    void restart();
    void velocityJump();
    void massScaling();

private:
    Case& add(const std::string& sweep, const std::string& value, const Kernel& kernel,
              std::function<Outcome()> run)
    {
        all.push_back({sweep, value, kernel.name(), false, false, std::move(run)});
        return all.back();
    }

    Case& addBlock(const std::string& sweep, const std::string& value, const Block& block, long count = steps,
                   double share = courant, const Demands& demands = {})
    {
        return add(sweep, value, block.kernel, [=] {
            Simulation simulation = make(block);
            return drive(simulation, block.soil, count, share, demands);
        });
    }
};

/// Elastic soil without weight has no other energy than that of its noise.
Demands noNewEnergy()
{
    Demands demands;
    demands.energyGrowth = 1.05;
    return demands;
}

Block elasticNoise(const Kernel& kernel)
{
    Block block{.kernel = kernel};
    block.gravity = 0;
    return block;
}

Block sandNoise(const Kernel& kernel)
{
    Block block{.kernel = kernel};
    block.soil.plastic = true;
    block.noise = 1e-4;
    return block;
}

void Matrix::permeability()
{
    for (const Kernel& kernel : kernels(2)) {
        for (int exponent = -14; exponent <= -8; ++exponent) {
            Block block = elasticNoise(kernel);
            block.soil.permeability = std::pow(10, exponent);
            addBlock("permeability [m2]", text("1e%d", exponent), block, steps, courant, noNewEnergy())
                .quick = exponent % 3 == 0 || exponent == -8;
        }
    }
}

void Matrix::bulkModulus()
{
    for (const Kernel& kernel : kernels(2)) {
        for (const double ratio : {0.1, 1.0, 10.0, 100.0, 1e3, 1e4}) {
            Block block = elasticNoise(kernel);
            block.soil.youngsModulus = 1e6;
            block.soil.liquidBulkModulus = 1e6 * ratio;
            addBlock("liquid bulk modulus / Young's modulus", text("%g", ratio), block, steps, courant,
                     noNewEnergy())
                .quick = ratio == 0.1 || ratio == 1e4;
        }
    }
}

void Matrix::courantNumbers()
{
    for (const Kernel& kernel : kernels()) {
        for (const double share : {0.5, 0.8, 0.95, 1.0, 1.02, 1.1, 1.5, 2.0, 4.0}) {
            Case& added = addBlock("step / stable step", text("%g", share), elasticNoise(kernel),
                                   share > 1 ? 30000 : 5000, share, noNewEnergy());
            added.mayStop = share > 1;
            added.quick = share == 1.0 || share >= 1.5;
        }
    }
}

void Matrix::laggedDrag()
{
    for (const Kernel& kernel : kernels(2)) {
        for (const double share : {0.5, 0.8, 0.95, 1.0, 1.05, 1.1, 1.5, 2.0}) {
            Block block = elasticNoise(kernel);
            block.drag = SolutionControls::Drag::lagged;
            block.soil.permeability = 1e-12;
            Case& added = addBlock("lagged drag: step / stable step", text("%g", share), block, 5000, share,
                                   noNewEnergy());
            added.mayStop = share > 1;
            added.quick = share == 1.0 || share == 2.0;
        }
    }
}

void Matrix::pointsPerCell()
{
    for (const Kernel& kernel : kernels()) {
        for (const int side : {1, 2, 3, 4}) {
            if (kernel.triangles && side > 2) {
                continue;
            }
            Block block = sandNoise(kernel);
            block.pointsPerSide = side;
            const int count = kernel.triangles ? (side == 1 ? 1 : 3) : side * side;
            addBlock("points per cell", text("%d", count), block).quick = side <= 2;
        }
        Block block = sandNoise(kernel);
        block.randomPlaces = true;
        addBlock("points per cell", "random", block).quick = true;
        block.randomPlaces = false;
        block.hole = true;
        addBlock("points per cell", "one cell empty", block).quick = true;
    }
}

void Matrix::aspectRatio()
{
    for (const Kernel& kernel : kernels()) {
        for (const double aspect : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
            for (const bool wide : {false, true}) {
                if (aspect == 1 && wide) {
                    continue;
                }
                Block block = sandNoise(kernel);
                (wide ? block.cellWidth : block.cellHeight) *= aspect;
                addBlock("aspect ratio of the cells", text(wide ? "%g wide" : "%g high", aspect), block)
                    .quick = aspect == 50;
            }
        }
    }
}

void Matrix::interfaceFriction()
{
    for (const Kernel& kernel : kernels()) {
        for (const double friction : {0.0, 0.15, 0.577, 1.0, 10.0}) {
            Skirt skirt{.kernel = kernel};
            skirt.friction = friction;
            add("friction of the interface", text("%g", friction), kernel, [skirt] {
                Simulation simulation = make(skirt);
                Demands demands;
                demands.atTheEnd = [](const Simulation& s) {
                    return s.state.reactions[0].work > 0 ? std::string() : std::string("the soil does work");
                };
                return drive(simulation, skirt.soil, 2 * steps, courant, demands);
            }).quick = friction == 10 && !kernel.triangles;
        }
    }
}

void Matrix::strength()
{
    for (const Kernel& kernel : kernels()) {
        for (const double friction : {0.0, 15.0, 30.0, 45.0}) {
            std::vector<double> dilatancies{-5, 0};
            if (friction > 0) {
                dilatancies.push_back(friction);
            }
            for (const double dilatancy : dilatancies) {
                Block block = sandNoise(kernel);
                block.soil.frictionAngle = friction;
                block.soil.dilatancyAngle = dilatancy;
                block.noise = 1e-3;
                addBlock("friction / dilatancy angle [deg]", text("%g/%g", friction, dilatancy), block)
                    .quick = (friction == 45 || friction == 0) && dilatancy == 0;
            }
        }
        Block block = sandNoise(kernel);
        block.soil.frictionAngle = 20;
        block.soil.dilatancyAngle = 30;
        addBlock("friction / dilatancy angle [deg]", "20/30", block).mayStop = true;
    }
}

double fastestNode(const Simulation& simulation)
{
    double fastest = 0;
    for (const auto& [vr, vz] : simulation.step->nodalVelocities(simulation.state)) {
        fastest = std::max(fastest, std::hypot(vr, vz));
    }
    return fastest;
}

/// Soil that dilates where it flows round a tip and up to the surface.
void Matrix::dilatancyAtTheSkirt()
{
    for (const Kernel& kernel : kernels()) {
        for (const double dilatancy : {0.0, 1.0, 2.0, 5.0, 10.0, 20.0}) {
            Skirt skirt{.kernel = kernel};
            skirt.soil.dilatancyAngle = dilatancy;
            add("dilatancy angle of the sand at a skirt [deg]", text("%g", dilatancy), kernel, [skirt] {
                Simulation simulation = make(skirt);
                Demands demands;
                demands.figures = [](const Simulation& s) {
                    return text("work done %.3g J/rad", s.state.reactions[0].work);
                };
                demands.atTheEnd = [](const Simulation& s) {
                    const double fastest = fastestNode(s);
                    return fastest > 2
                               ? text("soil moves at %.2g m/s, ten times the speed of the skirt", fastest)
                               : std::string();
                };
                return drive(simulation, skirt.soil, 3 * steps, courant, demands);
            }).quick = dilatancy == 0 && !kernel.triangles;
        }
    }
}

/// Sand without cohesion at rest, but for a little noise, that must die down.
void Matrix::freeSurface()
{
    for (const Kernel& kernel : kernels()) {
        for (const double noise : {1e-6, 1e-5, 1e-4, 1e-3}) {
            Block block = sandNoise(kernel);
            block.noise = noise;
            Demands demands;
            demands.atTheEnd = [=](const Simulation& simulation) {
                const MaterialPoints& points = simulation.state.points;
                const double amplitude = noise * std::sqrt(72e6 / 2072.5);
                double highest = 0, tension = 0;
                for (std::size_t p = 0; p < points.size(); ++p) {
                    highest = std::max(highest, points.z[p] - points.initialZ[p]);
                    tension =
                        std::max(tension, points.stress[0][p] + points.stress[1][p] + points.stress[2][p]);
                }
                if (tension > 1e-3) {
                    return text("tension of %.2g Pa", tension / 3);
                }
                if (highest > 0.05) {
                    return text("a point rose by %.2g m", highest);
                }
                const double fastest = fastestNode(simulation);
                return fastest > 0.2 * amplitude
                           ? text("%.2g of %.2g m/s are left at the nodes", fastest, amplitude)
                           : std::string();
            };
            demands.figures = [=](const Simulation& simulation) {
                return text("%.2g of %.2g m/s are left at the nodes", fastestNode(simulation),
                            noise * std::sqrt(72e6 / 2072.5));
            };
            addBlock("free surface of sand, 1e4 steps: noise / wave speed", text("%g", noise), block, 10000,
                     courant, demands);
        }
    }
}

void Matrix::nearTheAxis()
{
    for (const Kernel& kernel : kernels()) {
        for (const double share : {1e-2, 1e-6, 1e-12, 0.0}) {
            const Block block = sandNoise(kernel);
            add("radius of points at the axis / cell size", text("%g", share), kernel, [=] {
                Simulation simulation = make(block);
                MaterialPoints& points = simulation.state.points;
                for (std::size_t p = 0; p < points.size(); ++p) {
                    if (points.r[p] < 0.5 * block.cellWidth) {
                        points.r[p] = share * block.cellWidth;
                    }
                }
                findCells(simulation);
                return drive(simulation, block.soil, steps, courant);
            }).quick = share == 1e-12;
        }
        // Thrown at the axis: a tenth of the wave speed, inwards.
        Block block = sandNoise(kernel);
        block.emptyRows = 10;
        add("radius of points at the axis / cell size", "thrown at it", kernel, [=] {
            Simulation simulation = make(block);
            MaterialPoints& points = simulation.state.points;
            simulation.setVelocity([](double r, double) {
                return std::array<double, 2>{r < 0.3 ? -2.0 : 0.0, 0};
            });
            if (points.twoPhase()) {
                points.wr = points.vr;
                points.wz = points.vz;
            }
            return drive(simulation, block.soil, 3 * steps, courant);
        }).quick = true;
    }
}

/// A point with a tiny share of a cell's volume beside a block, and above it.
void Matrix::tinyPoint()
{
    for (const Kernel& kernel : kernels()) {
        for (const double share : {1e-2, 1e-4, 1e-8, 1e-12}) {
            Block block = sandNoise(kernel);
            block.emptyRows = 3;
            add("volume of a point / its cell", text("%g", share), kernel, [=] {
                Simulation simulation = make(block);
                MaterialPoints& points = simulation.state.points;
                const double top = block.rows * block.cellHeight;
                for (std::size_t p = 0; p < points.size(); ++p) {
                    const bool chosen = points.z[p] > top - 0.5 * block.cellHeight && p % 5 == 0;
                    if (chosen) { // into the empty row, just above the surface
                        points.z[p] = top + 1e-3 * block.cellHeight;
                        points.volume[p] *= share;
                        points.mass[p] *= share;
                        for (auto& component : points.stress) {
                            component[p] = 0;
                        }
                    }
                }
                findCells(simulation);
                return drive(simulation, block.soil, 2 * steps, courant);
            }).quick = share == 1e-8;
        }
    }
}

void Matrix::rotation()
{
    for (Kernel kernel : kernels()) {
        kernel.geometry = Geometry::planeStrain;
        for (const double share : {0.01, 0.02, 0.05, 0.1}) {
            add("ten revolutions of a disk of 8 cells: rim speed / wave speed", text("%g", share), kernel,
                [=] {
                    Soil soil;
                    const double speed = share * std::sqrt(72e6 / 2072.5);
                    Simulation simulation = turningDisk(kernel, soil, speed, 4);
                    simulation.start();
                    const double step = courant * simulation.step->stableStep(simulation.state).step;
                    const double before = angularMomentum(simulation);
                    Demands demands;
                    demands.atTheEnd = [=](const Simulation& at) {
                        const double left = angularMomentum(at) / before, off = offCircle(at);
                        return off < 0.04 && left < 1.05
                                   ? std::string()
                                   : text("points %.2g m off their circles, angular momentum %.3g", off,
                                          left);
                    };
                    demands.figures = [=](const Simulation& at) {
                        return text("%.3f of the angular momentum is left, points %.1g m off their circles",
                                    angularMomentum(at) / before, offCircle(at));
                    };
                    const long count = std::lround(10 * 2 * M_PI * diskRadius / speed / step);
                    return drive(simulation, soil, count, courant, demands);
                });
        }
    }
}

/// A column under a pressure that comes and goes, in 1e3 cycles (fewer in the map: the long runs do them
/// all).
void Matrix::loadCycles()
{
    for (const Kernel& kernel : kernels()) {
        for (const bool plastic : {false, true}) {
            for (const int cycles : {10, 100}) {
                add("cycles of load", text(plastic ? "%d, sand" : "%d, elastic", cycles), kernel, [=] {
                    constexpr double period = 0.2;
                    std::string table;
                    for (int i = 0; i <= 2 * cycles; ++i) {
                        table += text("(%g (0 0 %g)) ", 0.5 * i * period, i % 2 == 0 ? 0.0 : -1e4);
                    }
                    Column column{.kernel = kernel};
                    column.soil.plastic = plastic;
                    column.emptyCells = 0;
                    column.gravity = 0;
                    column.top = "type traction; uniformValue table (" + table + ");";
                    column.topWater = "type fixedValue; value uniform 0;";
                    Simulation simulation = make(column);
                    simulation.setStress([](double, double) {
                        return std::array<double, 4>{-1e2, -1e2, -1e2, 0};
                    });
                    simulation.scene.controls.linearBulkViscosity = 0.06;
                    simulation.start();
                    const double step = courant * simulation.step->stableStep(simulation.state).step;
                    return drive(simulation, column.soil, static_cast<long>(cycles * period / step) - 1,
                                 courant);
                }).quick = cycles == 10;
            }
        }
    }
}

void Matrix::upwardFlow()
{
    for (const Kernel& kernel : kernels(2)) {
        for (const double share : {0.5, 0.9, 1.0, 1.1}) {
            add("upward gradient / critical gradient", text("%g", share), kernel, [=] {
                Column column{.kernel = kernel};
                column.soil.plastic = true;
                column.soil.permeability = 1e-10;
                column.emptyCells = 10;
                column.gravity = 9.81;
                const double under = Soil::liquidDensity * 9.81 + share * Soil::buoyantWeight;
                column.bottomWater =
                    text("type uniformFixedValue; uniformValue table ((0 %.17g) (0.2 %.17g));",
                         Soil::liquidDensity * 9.81, under);
                Simulation simulation = make(column);
                Demands demands;
                demands.atTheEnd = [=](const Simulation& s) {
                    double highest = 0;
                    for (std::size_t p = 0; p < s.state.points.size(); ++p) {
                        highest = std::max(highest, s.state.points.z[p] - s.state.points.initialZ[p]);
                    }
                    return share < 1 && highest > 0.01 ? text("the sand rose by %.2g m", highest)
                                                       : std::string();
                };
                return drive(simulation, column.soil, 5000, courant, demands);
            }).quick = share == 1.1;
        }
    }
}

bool sameBits(const State& one, const State& other)
{
    const MaterialPoints& a = one.points;
    const MaterialPoints& b = other.points;
    return a.id == b.id && a.r == b.r && a.z == b.z && a.vr == b.vr && a.vz == b.vz && a.volume == b.volume &&
           a.stress == b.stress && a.state == b.state && a.wr == b.wr && a.porePressure == b.porePressure &&
           a.cell == b.cell;
}

/// Run on, and run on from a copy of the state with a new kernel, as a restart does.
Outcome restarted(Simulation& one, Simulation& other, const Soil& soil, long before)
{
    if (Outcome outcome = drive(one, soil, before, courant); outcome.verdict != Verdict::holds) {
        return outcome;
    }
    one.step->rebuild(one.state);
    other.state = one.state;
    other.scene.referenceZ = one.scene.referenceZ;
    other.step = makeTimeStep(other.scene, other.state);
    for (int i = 0; i < 300; ++i) {
        const double dt = courant * one.step->stableStep(one.state).step;
        one.step->advance(one.state, dt);
        other.step->advance(other.state, dt);
        if (!sameBits(one.state, other.state)) {
            return {Verdict::breaks, text("differs after %d steps", i + 1)};
        }
    }
    return {};
}

void Matrix::restart()
{
    for (const Kernel& kernel : kernels()) {
        for (const long before : {0L, 1L, 137L, 500L}) {
            add("restart: the same bits, after so many steps", text("%ld", before), kernel, [=] {
                const Skirt skirt{.kernel = kernel};
                Simulation one = make(skirt), other = make(skirt);
                return restarted(one, other, skirt.soil, before);
            }).quick = before == 137;
        }
    }
}

void Matrix::velocityJump()
{
    const double crossing = 0.2 / std::sqrt(72e6 / 2072.5); // of a wave through the wall [s]
    for (const Kernel& kernel : kernels()) {
        for (const double passages : {0.0, 1.0, 5.0, 20.0}) {
            add("ramp of the velocity / passage of a wave through the wall", text("%g", passages), kernel,
                [=] {
                    Skirt skirt{.kernel = kernel};
                    skirt.ramp = passages * crossing;
                    Simulation simulation = make(skirt);
                    return drive(simulation, skirt.soil, steps, courant);
                })
                .quick = passages == 0 && !kernel.triangles;
        }
    }
}

void Matrix::massScaling()
{
    for (const Kernel& kernel : kernels()) {
        for (const double scaling : {1.0, 10.0, 100.0, 1e3, 1e4}) {
            Skirt skirt{.kernel = kernel};
            skirt.massScaling = scaling;
            add("mass scaling", text("%g", scaling), kernel, [=] {
                Simulation simulation = make(skirt);
                // As far as the mesh can go with the skirt.
                simulation.start();
                const double step = courant * simulation.step->stableStep(simulation.state).step;
                const long count = std::min(2 * steps, static_cast<long>(1.0 / step));
                return drive(simulation, skirt.soil, count, courant);
            }).quick = scaling == 1e4;
        }
    }
}

} // namespace

std::vector<Case> stabilityMatrix()
{
    Matrix matrix;
    matrix.permeability();
    matrix.bulkModulus();
    matrix.courantNumbers();
    matrix.laggedDrag();
    matrix.pointsPerCell();
    matrix.aspectRatio();
    matrix.interfaceFriction();
    matrix.strength();
    matrix.dilatancyAtTheSkirt();
    matrix.freeSurface();
    matrix.nearTheAxis();
    matrix.tinyPoint();
    matrix.rotation();
    matrix.loadCycles();
    matrix.upwardFlow();
    matrix.restart();
    matrix.velocityJump();
    matrix.massScaling();
    return std::move(matrix.all);
}

} // namespace caisson::stability
