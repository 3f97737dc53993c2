// Finite elements among the cells of material points: cells whose points rest from sort to sort.

#include "Verification.h"

namespace caisson::testing {
namespace {

struct Variant
{
    const char* name;
    Geometry geometry;
    bool triangles;
};

class EveryFemCell : public ::testing::TestWithParam<Variant>
{
};
INSTANTIATE_TEST_SUITE_P(, EveryFemCell,
                         ::testing::Values(Variant{"axisymmetricQuadrilaterals", Geometry::axisymmetric,
                                                   false},
                                           Variant{"planeQuadrilaterals", Geometry::planeStrain, false},
                                           Variant{"axisymmetricTriangles", Geometry::axisymmetric, true},
                                           Variant{"planeTriangles", Geometry::planeStrain, true}),
                         [](const auto& variant) { return variant.param.name; });

constexpr double E = 1e8, nu = 0.3, density = 2000;
constexpr const char* walls =
    "left { type slip; } right { type slip; } bottom { type slip; } top { type slip; }";

void letPointsRest(Simulation& simulation, int sortInterval, int distance = 1)
{
    simulation.scene.controls.femCells = SolutionControls::FemCells::automatic;
    simulation.scene.controls.femDistance = distance;
    simulation.scene.controls.sortInterval = sortInterval;
}

/// A block between walls, all of it filled.
Simulation block(const Variant& variant, const std::string& material, const std::vector<double>& r,
                 const std::vector<double>& z)
{
    Simulation simulation;
    simulation.state.mesh = structuredMesh(r, z, variant.geometry, variant.triangles);
    if (variant.triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
    const int soil = simulation.addMaterial("soil", material);
    simulation.setConditions(variant.geometry == Geometry::axisymmetric
                                 ? "right { type slip; } bottom { type slip; } top { type slip; }"
                                 : walls);
    simulation.fill(soil, variant.triangles ? 3 : 2, 2);
    return simulation;
}

double largestSpeed(const MaterialPoints& points)
{
    double speed = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        speed = std::max(speed, std::hypot(points.vr[p], points.vz[p]));
    }
    return speed;
}

/// By what random velocities grow in 2000 steps of this share of the stable one, or 1e3.
double growthOfVibrations(Simulation& simulation, double share)
{
    letPointsRest(simulation, 40);
    unsigned number = 1;
    const auto random = [&number] {
        number = 1664525 * number + 1013904223;
        return 1e-9 * (static_cast<double>(number) / 4294967296.0 - 0.5);
    };
    simulation.setVelocity([&](double, double) { return std::array<double, 2>{random(), random()}; });
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, simulation.state.mesh.cells());
    const double before = largestSpeed(simulation.state.points);
    const double dt = share * simulation.step->stableStep(simulation.state).step;
    for (int i = 0; i < 2000; ++i) {
        simulation.step->advance(simulation.state, dt);
        if (largestSpeed(simulation.state.points) > 1e3 * before) {
            return 1e3;
        }
    }
    return largestSpeed(simulation.state.points) / before;
}

TEST_P(EveryFemCell, isStableAtTheStableStepAndNotFarBeyond)
{
    for (const double aspect : {1.0, 5.0}) {
        const auto growth = [&](double share) {
            Simulation simulation = block(GetParam(), elasticSolid(E, nu, density), evenLines(0, 8, 8),
                                          evenLines(0, 8 / aspect, 8));
            return growthOfVibrations(simulation, share);
        };
        EXPECT_LT(growth(0.98), 3) << "aspect ratio " << aspect;
        EXPECT_GT(growth(2), 100) << "aspect ratio " << aspect;
    }
}

// The viscosity is no more than the step leaves.
TEST_P(EveryFemCell, isStableAtTheStableStepWhereItsSoilYields)
{
    const auto growth = [&](int phases, double viscosity, double share) {
        Simulation simulation = block(
            GetParam(),
            "law mohrCoulomb; porosity 0.35; solidDensity 2650; youngsModulus 60e6; poissonsRatio 0.25; "
            "frictionAngle 30; dilatancyAngle 30; cohesion 0; liquidDensity 1000; "
            "intrinsicPermeability 1e-9; liquidBulkModulus 2e7; liquidViscosity 1e-3; weight " +
                std::string(phases == 2 ? "submerged;" : "dry;"),
            evenLines(0, 8, 8), evenLines(0, 8, 8));
        simulation.scene.controls.phases = phases;
        simulation.scene.controls.femViscosity = viscosity;
        if (phases == 2) {
            simulation.setPressures(GetParam().geometry == Geometry::axisymmetric
                                        ? "right { type impermeable; } bottom { type impermeable; } top { "
                                          "type impermeable; }"
                                        : "left { type impermeable; } right { type impermeable; } bottom { "
                                          "type impermeable; } top { type impermeable; }");
            simulation.state.points.addLiquid();
        }
        simulation.setStress([](double, double) { // at the limit, for 30 degrees
            return std::array<double, 4>{-100e3, -300e3, -100e3, 0};
        });
        return growthOfVibrations(simulation, share);
    };
    for (const int phases : {1, 2}) {
        for (const double viscosity : {0.1, 1.0}) {
            for (const double share : {0.98, 0.8, 0.5}) {
                EXPECT_LT(growth(phases, viscosity, share), 3)
                    << phases << " phase(s), viscosity " << viscosity << ", share " << share;
            }
            EXPECT_GT(growth(phases, viscosity, 2), 100) << phases << " phase(s), viscosity " << viscosity;
        }
    }
}

// What the nodes gain is what the points gain when they wake.
TEST_P(EveryFemCell, givesItsPointsTheMomentumOfItsNodes)
{
    Simulation simulation =
        block(GetParam(), elasticSolid(E, nu, density), evenLines(0, 2, 10), evenLines(0, 4, 20));
    simulation.setConditions(GetParam().geometry == Geometry::axisymmetric
                                 ? "right { type slip; } bottom { type zeroGradient; } top { type "
                                   "zeroGradient; }"
                                 : "left { type slip; } right { type slip; } bottom { type zeroGradient; } "
                                   "top { type zeroGradient; }");
    letPointsRest(simulation, 1000);
    simulation.scene.gravity = {0, -0.1};
    simulation.setVelocity([](double, double z) { return std::array<double, 2>{0, 1e-3 * std::sin(z)}; });
    simulation.start();
    ASSERT_GT(simulation.step->cellCounts(simulation.state).fem, 0);
    const Energies before = sumEnergies(simulation.state);
    simulation.run(0.01, 0.5);
    simulation.step->rebuild(simulation.state);
    const Energies after = sumEnergies(simulation.state);
    expectNear("gain of momentum over that by gravity",
               (after.momentum[1] - before.momentum[1]) / (-0.1 * 0.01 * before.mass), 1, 1e-6);
    EXPECT_EQ(after.mass, before.mass);
}

/// Suddenly applied gravity on an elastic column: rms error of the mean settlement (see VerificationTest).
double columnError(int n, bool femCells)
{
    const double length = 10, g = 0.0981, h = length / n;
    Simulation simulation;
    std::vector<double> lines = evenLines(0, length, n);
    lines.push_back(length + h);
    simulation.state.mesh = structuredMesh(evenLines(0, 2 * h, 2), lines, Geometry::planeStrain);
    const int solid = simulation.addMaterial("solid", elasticSolid(E, nu, density));
    simulation.scene.gravity = {0, -g};
    simulation.setConditions("left { type slip; } right { type slip; } top { type zeroGradient; } "
                             "bottom { type fixedValue; value uniform (0 0 0); }");
    simulation.fill(solid, 2, 2, [&](double, double z) { return z < length; });
    constexpr int interval = 20;
    if (femCells) {
        letPointsRest(simulation, interval, 2);
    }
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem > 0, femCells);
    const double modulus = pWaveModulus(E, nu), c = std::sqrt(modulus / density);
    const double duration = 8 * length / c;
    const long steps = interval * std::lround(duration / (0.25 * h / c) / interval);
    double sum = 0, largest = 0;
    for (long i = 1; i <= steps; ++i) {
        simulation.step->advance(simulation.state, duration / static_cast<double>(steps));
        if (i % interval != 0) {
            continue; // the points rest
        }
        double exact = -density * g * length * length / (3 * modulus);
        for (int k = 0; k < 100; ++k) {
            const double wave = (2 * k + 1) * pi / (2 * length);
            exact += 2 * density * g / (modulus * std::pow(wave, 4) * length * length) *
                     std::cos(wave * c * simulation.state.time);
        }
        const MaterialPoints& points = simulation.state.points;
        const double got = massMean(points, [&](std::size_t p) { return points.z[p] - points.initialZ[p]; });
        sum += std::pow(got - exact, 2);
        largest = std::max(largest, std::abs(exact));
    }
    return std::sqrt(sum * interval / static_cast<double>(steps)) / largest;
}

TEST(FemCells, swingAsTheExactColumnDoes)
{
    expectNear("column of points: error, n = 40", columnError(40, false), 0, 1.2e-3);
    expectNear("column of FEM cells: error, n = 40", columnError(40, true), 0, 1.2e-3);
}

/// Sand at rest under its weight and, of two phases, water; the mesh moves through it by 20 cells.
void sandStaysAtRest(int phases)
{
    Simulation simulation;
    simulation.scene.controls.phases = phases;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 1, 8), evenLines(-6, 0.4, 64), Geometry::axisymmetric);
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; liquidDensity 1000; weight submerged; "
                "youngsModulus 60e6; poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 0; cohesion 0; "
                "intrinsicPermeability 1e-10; liquidBulkModulus 2e7; liquidViscosity 1e-3;");
    simulation.scene.gravity = {0, -9.81};
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    if (phases == 2) {
        simulation.setPressures(
            "right { type impermeable; } bottom { type impermeable; } top { type impermeable; }");
    }
    simulation.fill(sand, 2, 4, [](double, double z) { return z < 0; });
    MaterialPoints& points = simulation.state.points;
    if (phases == 2) {
        points.addLiquid();
        for (std::size_t p = 0; p < points.size(); ++p) {
            points.porePressure[p] = -9810 * points.z[p];
        }
    }
    RigidBody body; // above the soil: the mesh follows it, and it touches nothing
    body.name = "wand";
    body.profile = profileFromPolygon({{0.5, 0}, {0.75, 0}, {0.75, 1}, {0.5, 1}});
    body.tipLevel = body.initialTipLevel = 0.2;
    body.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(-1.0));
    simulation.state.bodies.push_back(body);
    simulation.scene.motion = MeshMotion({-5.9, -5.5, -5.3, 0.0}, "wand");
    simulation.scene.movingBody = 0;
    const double weight = 0.65 * 1650 * 9.81;
    simulation.setStress([&](double, double z) {
        return std::array<double, 4>{0.384 * weight * z, weight * z, 0.384 * weight * z, 0};
    });
    letPointsRest(simulation, 10, 2);
    simulation.start();
    ASSERT_GT(simulation.step->cellCounts(simulation.state).fem, 100);
    simulation.run(2, 0.5);
    simulation.step->rebuild(simulation.state);
    EXPECT_NEAR(simulation.state.bodies[0].tipLevel, 2.2, 1e-9);
    double moved = 0, stress = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        moved =
            std::max(moved, std::hypot(points.r[p] - points.initialR[p], points.z[p] - points.initialZ[p]));
        stress = std::max(stress, std::abs(points.stress[1][p] - weight * points.initialZ[p]));
    }
    expectNear("largest displacement over the depth", moved / 6, 0, 1e-5);
    // Points alone have 1.5 and 0.8 per cent: rows of points that cross mesh lines make small waves.
    expectNear("largest change of stress over that at depth", stress / (6 * weight), 0, 5e-2);
}

TEST(FemCells, stayAtRestWhileTheMeshMovesByTwentyCells) { sandStaysAtRest(1); }
TEST(FemCells, ofTwoPhasesStayAtRestWhileTheMeshMovesByTwentyCells) { sandStaysAtRest(2); }

/// Kinetic energy at the end, in a ring of sand that its inner wall presses outwards, one cell high, between
/// rollers: what is left of it beside the flow are vibrations.
double energyOfPressedRing(bool femCells, double viscosity)
{
    Simulation simulation;
    simulation.state.mesh = structuredMesh(evenLines(1, 5, 40), evenLines(0, 0.1, 1), Geometry::axisymmetric);
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; weight dry; youngsModulus 60e6; "
                "poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 0; cohesion 0;");
    constexpr double speed = 0.05, stress = -50e3;
    simulation.setConditions("left { type fixedValue; value uniform (0.05 0 0); } right { type slip; } "
                             "bottom { type slip; } top { type slip; }");
    simulation.fill(sand, 2, 2);
    simulation.setVelocity([](double r, double) {
        return std::array<double, 2>{speed * (1 / r - r / 25) / (1 - 1.0 / 25), 0};
    });
    simulation.setStress([](double, double) { return std::array<double, 4>{stress, stress, stress, 0}; });
    if (femCells) {
        letPointsRest(simulation, 5);
        simulation.scene.controls.femViscosity = viscosity;
    }
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem > 0, femCells);
    simulation.run(0.8, 0.8);
    return sumEnergies(simulation.state).kinetic;
}

// Sand that dilates less than it rubs feeds vibrations as it yields.
TEST(FemCells, letNoVibrationsGrowInSoilThatYields)
{
    const double points = energyOfPressedRing(false, 0);
    const double viscosity = SolutionControls{}.femViscosity;
    expectNear("kinetic energy over that of points alone", energyOfPressedRing(true, viscosity) / points, 1,
               0.1);
    EXPECT_GT(energyOfPressedRing(true, 0) / points, 2) << "no viscosity, and no vibrations to take away";
}

// Points that would leave their cell do not rest.
TEST(FemCells, areNoneWhereTheSoilMovesFast)
{
    Simulation simulation = block({"", Geometry::planeStrain, false}, elasticSolid(E, nu, density),
                                  evenLines(0, 8, 8), evenLines(0, 8, 8));
    simulation.setConditions("left { type zeroGradient; } right { type zeroGradient; } bottom { type "
                             "zeroGradient; } top { type zeroGradient; }");
    letPointsRest(simulation, 50);
    simulation.setVelocity([](double, double) { return std::array<double, 2>{0, 0.1}; });
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, 64);
    simulation.setVelocity([](double, double) { return std::array<double, 2>{0, 10}; });
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, 0);
}

TEST(FemCells, keepToTheirZone)
{
    Simulation simulation = block({"", Geometry::planeStrain, false}, elasticSolid(E, nu, density),
                                  evenLines(0, 8, 8), evenLines(0, 8, 8));
    letPointsRest(simulation, 50);
    simulation.state.mesh.cellZones["far"] = {0, 1, 2, 8, 9, 10};
    simulation.scene.controls.femZone = "far";
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, 6);
}

TEST(FemCells, keepTheirDistanceFromLoads)
{
    Simulation simulation = block({"", Geometry::planeStrain, false}, elasticSolid(E, nu, density),
                                  evenLines(0, 8, 8), evenLines(0, 8, 8));
    letPointsRest(simulation, 50, 3);
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, 64); // there is no surface
    MaterialPoints& points = simulation.state.points;
    InputProblems problems;
    simulation.scene.pointLoads =
        readPointLoads(parseDictionary("press { type force; uniformValue (1 0 0); }", "pointLoads"),
                       Geometry::planeStrain, problems);
    problems.throwIfAny("test loads");
    points.load.assign(points.size(), -1);
    points.loadArea.assign(points.size(), 1);
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.load[p] = points.r[p] < 1 ? 0 : -1;
    }
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem, 32) << "three columns between them";
}

// A fall that begins while the points rest is no worse for it: they wake in time.
TEST(FemCells, wakeBeforeTheirPointsHaveLeftThem)
{
    Simulation simulation = block({"", Geometry::planeStrain, false}, elasticSolid(E, nu, density),
                                  evenLines(0, 4, 4), evenLines(-40, 4, 44));
    simulation.setConditions(
        "left { type slip; } right { type slip; } bottom { type zeroGradient; } top { type zeroGradient; }");
    simulation.state.points = {};
    simulation.fill(0, 2, 2, [](double, double z) { return z > -4; });
    letPointsRest(simulation, 100000);
    simulation.scene.gravity = {0, -9.81};
    simulation.start();
    ASSERT_GT(simulation.step->cellCounts(simulation.state).fem, 0);
    simulation.run(2, 0.5);
    simulation.step->rebuild(simulation.state);
    const MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        EXPECT_NEAR(points.z[p] - points.initialZ[p], -0.5 * 9.81 * 4, 1e-3) << "point " << points.id[p];
    }
}

TEST(FemCells, needATreatmentOfLockingAndOtherCellsThanPoints)
{
    SolutionControls controls;
    controls.femCells = SolutionControls::FemCells::automatic;
    EXPECT_TRUE(controls.mayHaveFemCells());
    controls.locking = SolutionControls::Locking::none;
    EXPECT_FALSE(controls.mayHaveFemCells());
    controls = {};
    EXPECT_FALSE(controls.mayHaveFemCells());
}

} // namespace
} // namespace caisson::testing
