// Two-phase soil against exact answers: consolidation, waves, flow, contact.

#include "support/Simulation.h"
#include "support/StructuredMesh.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

namespace caisson::testing {
namespace {

using std::numbers::pi;

constexpr double porosity = 0.35, solidDensity = 2650, liquidDensity = 1000, viscosity = 1e-3, g = 9.81;

/// Saturated elastic soil; permeability intrinsic [m2].
std::string saturatedSoil(double youngsModulus, double poissonsRatio, double permeability, double bulkModulus,
                          const std::string& more = "")
{
    char text[512];
    std::snprintf(text, sizeof text,
                  "law linearElastic; porosity %g; solidDensity %g; liquidDensity %g; youngsModulus %.17g; "
                  "poissonsRatio %g; intrinsicPermeability %.17g; liquidBulkModulus %g; "
                  "liquidViscosity %g; %s",
                  porosity, solidDensity, liquidDensity, youngsModulus, poissonsRatio, permeability,
                  bulkModulus, viscosity, more.c_str());
    return text;
}

double oedometricModulus(double youngsModulus, double poissonsRatio)
{
    return youngsModulus * (1 - poissonsRatio) / ((1 + poissonsRatio) * (1 - 2 * poissonsRatio));
}

void report(const char* what, double got, double tolerance)
{
    std::printf("%-60s %.3e  (tolerance %.1e)\n", what, got, tolerance);
}

using Coupling = SolutionControls::PressureCoupling;

/// What the columns of a test are computed with.
Coupling coupling = Coupling::explicitStep;

/// Tests of what holds with the explicit step and with the projection.
class ByCoupling : public ::testing::TestWithParam<Coupling>
{
protected:
    void SetUp() override { coupling = GetParam(); }
    void TearDown() override { coupling = Coupling::explicitStep; }
};
const auto bothCouplings = ::testing::Values(Coupling::explicitStep, Coupling::projection);
const auto nameOfCoupling = [](const auto& info) {
    return info.param == Coupling::projection ? "projection" : "explicitStep";
};

class Consolidation : public ByCoupling
{
};
INSTANTIATE_TEST_SUITE_P(, Consolidation, bothCouplings, nameOfCoupling);
class Flow : public ByCoupling
{
};
INSTANTIATE_TEST_SUITE_P(, Flow, bothCouplings, nameOfCoupling);
class Rod : public ByCoupling
{
};
INSTANTIATE_TEST_SUITE_P(, Rod, bothCouplings, nameOfCoupling);
class FreeSurfaces : public ByCoupling
{
};
INSTANTIATE_TEST_SUITE_P(, FreeSurfaces, bothCouplings, nameOfCoupling);

/// A column of n cells of height 1 m, one cell wide, between rollers.
Simulation column(int n, bool triangles, Geometry geometry, const std::string& soil, const std::string& top,
                  const std::string& topWater)
{
    Simulation simulation;
    const double h = 1.0 / n;
    simulation.state.mesh = structuredMesh(evenLines(0, h, 1), evenLines(0, 1, n), geometry, triangles);
    const int material = simulation.addMaterial("soil", soil);
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.pressureCoupling = coupling;
    if (triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
    const std::string left = geometry == Geometry::axisymmetric ? "" : "left { type slip; } ";
    simulation.setConditions(left + "right { type slip; } bottom { type slip; } top { " + top + " }");
    simulation.setPressures((left.empty() ? "" : "left { type impermeable; } ") +
                            std::string("right { type impermeable; } bottom { type impermeable; } top { ") +
                            topWater + " }");
    if (triangles) {
        simulation.fill(material, 3, 1);
    } else {
        simulation.fill(material, 2, 2);
    }
    simulation.state.points.addLiquid();
    return simulation;
}

// ---------------------------------------------------------------------------------------------------------

struct Terzaghi
{
    double error; ///< root mean square of p over the points, over the load
    long steps;
};

/// One-dimensional consolidation at the time factor T; the load q is carried undrained at the start.
Terzaghi consolidate(int n, bool triangles, Geometry geometry, double T, double damping = 0)
{
    const double E = 60e6, nu = 0.25, k = 1e-4, bulk = 2.2e9, q = 1e4;
    const double M = oedometricModulus(E, nu);
    Simulation simulation = column(
        n, triangles, geometry, saturatedSoil(E, nu, k * viscosity / (liquidDensity * g), bulk),
        "type traction; uniformValue (0 0 " + std::to_string(-q) + ");", "type fixedValue; value uniform 0;");
    simulation.scene.controls.localDamping = damping;
    MaterialPoints& points = simulation.state.points;
    const double share = bulk / porosity / (M + bulk / porosity);
    const double lateral = nu / (1 - nu);
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.porePressure[p] = share * q;
        points.stress[1][p] = -(1 - share) * q;
        points.stress[0][p] = points.stress[2][p] = -lateral * (1 - share) * q;
    }
    simulation.start();
    const double cv = k / (liquidDensity * g * (1 / M + porosity / bulk));
    simulation.run(T / cv, 0.8);
    double error = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double Z = 1 - points.initialZ[p];
        double exact = 0;
        for (int i = 0; i < 200; ++i) {
            const double a = (2 * i + 1) * pi / 2;
            exact += 2 / a * std::sin(a * Z) * std::exp(-a * a * T);
        }
        error += std::pow(points.porePressure[p] / q - share * exact, 2);
    }
    return {std::sqrt(error / static_cast<double>(points.size())), simulation.state.step};
}

TEST_P(Consolidation, terzaghiOnQuadrilaterals)
{
    const Terzaghi result = consolidate(50, false, Geometry::planeStrain, 0.1);
    report("Terzaghi, 50 quadrilaterals, T = 0.1: rms of p/q", result.error, 2e-3);
    EXPECT_LT(result.error, 2e-3);
}

TEST_P(Consolidation, terzaghiOnTriangles)
{
    const Terzaghi result = consolidate(50, true, Geometry::planeStrain, 0.1);
    report("Terzaghi, 50 x 2 triangles, T = 0.1: rms of p/q", result.error, 2e-3);
    EXPECT_LT(result.error, 2e-3);
}

TEST_P(Consolidation, terzaghiInAxisymmetry)
{
    const Terzaghi result = consolidate(50, false, Geometry::axisymmetric, 0.1);
    report("Terzaghi, 50 axisymmetric quadrilaterals, T = 0.1", result.error, 2e-3);
    EXPECT_LT(result.error, 2e-3);
}

// Neither the stiffness of water nor drag limit the step of the projection.
TEST(Projection, reachesTerzaghiInATenthOfTheSteps)
{
    const Terzaghi explicitly = consolidate(50, false, Geometry::planeStrain, 0.5);
    coupling = Coupling::projection;
    const Terzaghi projected = consolidate(50, false, Geometry::planeStrain, 0.5);
    std::vector<double> steps;
    for (const double bulk : {2e7, 2.2e9}) {
        for (const double permeability : {1e-14, 1e-9}) {
            Simulation simulation =
                column(20, false, Geometry::planeStrain, saturatedSoil(6e7, 0.25, permeability, bulk),
                       "type zeroGradient;", "type fixedValue; value uniform 0;");
            simulation.start();
            steps.push_back(simulation.step->stableStep(simulation.state).step);
        }
    }
    coupling = Coupling::explicitStep;
    report("Terzaghi, 50 quadrilaterals, T = 0.5: rms of p/q, explicit", explicitly.error, 2e-4);
    report("Terzaghi, 50 quadrilaterals, T = 0.5: rms of p/q, projected", projected.error, 2e-4);
    std::printf("%ld steps, and %ld\n", explicitly.steps, projected.steps);
    EXPECT_LT(projected.error, 2e-4);
    EXPECT_LT(9 * projected.steps, explicitly.steps);
    EXPECT_EQ(steps, std::vector<double>(4, steps[0]));
}

/// The ramp of the peers' benchmark: 1 m of soil, a load of 10 kPa that rises over 0.1 s; rms of p over the
/// points at the end of the ramp, over the load.
double rampError(int n, bool triangles)
{
    const double E = 1e7, k = 1e-3, bulk = 2e8, n0 = 0.4, q = 1e4, ramp = 0.1;
    char text[400];
    std::snprintf(text, sizeof text,
                  "law linearElastic; porosity %g; solidDensity 2650; youngsModulus %g; poissonsRatio 0; "
                  "intrinsicPermeability %.17g; liquidBulkModulus %g; liquidViscosity 1e-3;",
                  n0, E, k * viscosity / (liquidDensity * g), bulk);
    Simulation simulation = column(n, triangles, Geometry::axisymmetric, text,
                                   "type traction; uniformValue table ((0 (0 0 0)) (0.1 (0 0 -1e4)));",
                                   "type fixedValue; value uniform 0;");
    simulation.start();
    simulation.run(ramp, 0.8);
    const double cv = k / (liquidDensity * g * (1 / E + n0 / bulk));
    const double rate = bulk / n0 / (E + bulk / n0) * q / ramp;
    const MaterialPoints& points = simulation.state.points;
    double error = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double Z = 1 - points.initialZ[p];
        double exact = 0;
        for (int i = 0; i < 200; ++i) {
            const double a = (2 * i + 1) * pi / 2;
            exact += 2 / (a * a * a * cv) * std::sin(a * Z) * (1 - std::exp(-a * a * cv * ramp));
        }
        error += std::pow((points.porePressure[p] - rate * exact) / q, 2);
    }
    return std::sqrt(error / static_cast<double>(points.size()));
}

TEST_P(Consolidation, terzaghiUnderARamp)
{
    const double quadrilaterals = rampError(35, false);
    const double triangles = rampError(35, true);
    report("Terzaghi ramp, 35 quadrilaterals: rms of p/q", quadrilaterals, 6e-3);
    report("Terzaghi ramp, 35 x 2 triangles: rms of p/q", triangles, 6e-3);
    EXPECT_LT(quadrilaterals, 6e-3);
    EXPECT_LT(triangles, 6e-3);
}

/// A loaded column whose top is drained, after the waves have died down: undrained at the base where the
/// permeability is small, drained where it is large, at one and the same step.
TEST_P(Consolidation, theUndrainedAndTheDrainedLimitAreMetAtTheSameStep)
{
    const double E = 60e6, nu = 0.25, bulk = 2e7, q = 1e4, M = oedometricModulus(E, nu);
    double step = 0;
    for (const double permeability : {1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
        Simulation simulation =
            column(20, false, Geometry::planeStrain, saturatedSoil(E, nu, permeability, bulk),
                   "type traction; uniformValue (0 0 -1e4);", "type fixedValue; value uniform 0;");
        simulation.scene.controls.localDamping = 0.5;
        simulation.start();
        const double dt = 0.9 * simulation.step->stableStep(simulation.state).step;
        EXPECT_TRUE(step == 0 || std::abs(dt / step - 1) < 1e-12) << "permeability " << permeability;
        step = dt;
        for (int i = 0; i < 8000; ++i) {
            simulation.step->advance(simulation.state, dt);
        }
        const MaterialPoints& points = simulation.state.points;
        double base = 0, settlement = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            base = points.initialZ[p] < 0.05 ? points.porePressure[p] : base;
            settlement = std::min(settlement, points.z[p] - points.initialZ[p]);
            ASSERT_TRUE(std::isfinite(points.porePressure[p])) << "permeability " << permeability;
            EXPECT_LT(std::abs(points.porePressure[p]), 2 * q) << "permeability " << permeability;
        }
        if (permeability < 1e-12) {
            const double exact = bulk / porosity / (M + bulk / porosity) * q;
            report("undrained limit: p at the base/exact - 1", base / exact - 1, 2e-2);
            EXPECT_NEAR(base / exact, 1, 2e-2) << "permeability " << permeability;
        } else if (permeability > 1e-9) {
            const double exact = -q / M * (1 - 0.5 / 40); // of the uppermost points
            report("drained limit: settlement/exact - 1", settlement / exact - 1, 2e-2);
            EXPECT_NEAR(settlement / exact, 1, 2e-2) << "permeability " << permeability;
        }
    }
}

// ---------------------------------------------------------------------------------------------------------

/// Steady upward flow through a column under a head: discharge over that of Darcy's law, minus one.
double steadyFlowError(double damping, SolutionControls::Drag drag)
{
    const double permeability = 1e-10, pressure = 1e3, bulk = 2e7;
    Simulation simulation =
        column(10, false, Geometry::planeStrain, saturatedSoil(6e7, 0.25, permeability, bulk),
               "type zeroGradient;", "type fixedValue; value uniform 0;");
    simulation.setPressures("left { type impermeable; } right { type impermeable; } "
                            "bottom { type fixedValue; value uniform 1000; } "
                            "top { type fixedValue; value uniform 0; }");
    simulation.scene.controls.localDamping = damping;
    simulation.scene.controls.drag = drag;
    simulation.start();
    const double M = oedometricModulus(6e7, 0.25);
    const double cv = permeability / viscosity / (1 / M + porosity / bulk);
    simulation.run(3 / cv, 0.9);
    const MaterialPoints& points = simulation.state.points;
    double discharge = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        discharge += porosity * (points.wz[p] - points.vz[p]) / static_cast<double>(points.size());
    }
    return discharge / (permeability / viscosity * pressure) - 1;
}

TEST_P(Flow, dampingDoesNotActOnTheDragOfASteadyFlow)
{
    for (const double damping : {0.0, 0.5, 0.75}) {
        const double error = steadyFlowError(damping, SolutionControls::Drag::implicit);
        report("steady flow: discharge/Darcy - 1", error, 1e-3);
        EXPECT_NEAR(error, 0, 1e-3) << "damping " << damping;
    }
}

TEST(Drag, ofTheStepBeforeHasTheSameSteadyFlow)
{
    const double error = steadyFlowError(0, SolutionControls::Drag::lagged);
    report("steady flow, lagged drag: discharge/Darcy - 1", error, 1e-3);
    EXPECT_NEAR(error, 0, 1e-3);
}

/// Largest velocity of a column with lagged drag after 3000 steps of `share` of the stable step, over that at
/// the start.
double laggedGrowth(double permeability, double share)
{
    Simulation simulation =
        column(20, false, Geometry::planeStrain, saturatedSoil(6e7, 0.25, permeability, 2e7),
               "type zeroGradient;", "type fixedValue; value uniform 0;");
    simulation.scene.controls.drag = SolutionControls::Drag::lagged;
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.vz[p] = 1e-6 * std::sin(40 * points.z[p]);
        points.wz[p] = -1e-6 * std::cos(50 * points.z[p]);
    }
    simulation.start();
    const double dt = share * simulation.step->stableStep(simulation.state).step;
    double largest = 0;
    for (int i = 0; i < 3000 && largest < 1; ++i) {
        simulation.step->advance(simulation.state, dt);
        for (std::size_t p = 0; p < points.size(); ++p) {
            largest = std::max(largest, std::abs(points.wz[p]));
        }
    }
    return largest / 1e-6;
}

TEST(Drag, theStepOfLaggedDragIsSafeAndNotMuchTooSmall)
{
    for (const double permeability : {1e-11, 1e-12, 1e-13}) {
        const double within = laggedGrowth(permeability, 0.98);
        const double beyond = laggedGrowth(permeability, 1.5);
        std::printf("lagged drag, permeability %.0e: largest velocity grows by %.2g within the limit, %.2g "
                    "at 1.5 of it\n",
                    permeability, within, beyond);
        EXPECT_LT(within, 3) << "permeability " << permeability;
        EXPECT_GT(beyond, 1e3) << "permeability " << permeability;
    }
}

/// Water pressed into a closed column: what flows in is compressed, or widens the pores.
TEST_P(Flow, whatFlowsInIsStored)
{
    const double bulk = 2e7, discharge = 1e-4, duration = 1;
    Simulation simulation = column(10, false, Geometry::axisymmetric, saturatedSoil(6e7, 0.25, 1e-10, bulk),
                                   "type zeroGradient;", "type impermeable;");
    simulation.setPressures("right { type impermeable; } top { type impermeable; } "
                            "bottom { type prescribedFlux; uniformValue 1e-4; }");
    simulation.start();
    const auto stored = [&] {
        const MaterialPoints& points = simulation.state.points;
        double sum = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            // Pores are what the grains, which keep their volume, leave.
            const double grains =
                points.mass[p] / (porosity * liquidDensity + (1 - porosity) * solidDensity) * (1 - porosity);
            sum += (points.volume[p] - grains) * (1 + points.porePressure[p] / bulk);
        }
        return sum;
    };
    const double before = stored();
    simulation.run(duration, 0.8);
    const double radius = 0.1;
    const double inflow = discharge * duration * radius * radius / 2; // per radian
    report("closed column: stored/inflow - 1", (stored() - before) / inflow - 1, 1e-3);
    EXPECT_NEAR((stored() - before) / inflow, 1, 1e-3);
    EXPECT_GT(simulation.state.points.porePressure[0], 100);
}

/// V23: an upward gradient of gamma'/gamma_w takes the whole weight of the soil.
TEST_P(Flow, theCriticalGradientTakesTheWeightOfTheSoil)
{
    const double critical = (1 - porosity) * (solidDensity - liquidDensity) * g; // [Pa] over 1 m
    Simulation simulation = column(10, false, Geometry::planeStrain, saturatedSoil(6e7, 0.25, 1e-10, 2e7),
                                   "type zeroGradient;", "type fixedValue; value uniform 0;");
    simulation.setPressures("left { type impermeable; } right { type impermeable; } "
                            "bottom { type fixedValue; value uniform " +
                            std::to_string(critical + liquidDensity * g) +
                            "; } top { type fixedValue; value uniform 0; }");
    simulation.scene.gravity = {0, -g};
    simulation.scene.controls.localDamping = 0.5;
    MaterialPoints& points = simulation.state.points;
    const double lateral = 0.25 / 0.75;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double depth = 1 - points.z[p];
        points.porePressure[p] = liquidDensity * g * depth;
        points.stress[1][p] = -critical * depth;
        points.stress[0][p] = points.stress[2][p] = -lateral * critical * depth;
    }
    // The pressures of 0/p are as they are, hydrostatic part included: zero at z = 1 here.
    simulation.start();
    const double M = oedometricModulus(6e7, 0.25);
    simulation.run(3 * (1 / M + porosity / 2e7) * viscosity / 1e-10, 0.9);
    std::vector<double> stress(10, 0); // means of the cells, which are in equilibrium
    for (std::size_t p = 0; p < points.size(); ++p) {
        stress[points.cell[p]] += points.stress[1][p] / 4;
    }
    double largest = 0;
    for (const double mean : stress) {
        largest = std::max(largest, std::abs(mean));
    }
    report("critical gradient: largest vertical effective stress/weight", largest / critical, 5e-3);
    EXPECT_LT(largest / critical, 5e-3);
}

/// Largest speed of soil and liquid [m/s].
double fastestOfBothPhases(const MaterialPoints& points)
{
    double fastest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        fastest = std::max(
            {fastest, std::hypot(points.vr[p], points.vz[p]), std::hypot(points.wr[p], points.wz[p])});
    }
    return fastest;
}

/// A column under water with its free surface inside cells, with the stress of its weight.
Simulation columnUnderWater(double level)
{
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 0.2, 2), evenLines(0, 1.2, 12), Geometry::axisymmetric);
    const int soil = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; liquidDensity 1000; youngsModulus 60e6; "
                "poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 1; cohesion 0; "
                "intrinsicPermeability 1e-11; liquidBulkModulus 2e7; liquidViscosity 1e-3;");
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.pressureCoupling = coupling;
    simulation.scene.gravity = {0, -g};
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    simulation.setPressures("right { type impermeable; } bottom { type impermeable; } "
                            "top { type impermeable; }");
    FreeSurface surface;
    surface.name = "seabed";
    surface.level = level;
    simulation.scene.freeSurfaces.push_back(std::move(surface));
    simulation.fill(soil, 2, 2, [](double, double z) { return z < 1; });
    simulation.state.points.addLiquid();
    const double weight = (1 - porosity) * (solidDensity - liquidDensity) * g;
    simulation.setStress([&](double, double z) {
        const double vertical = -weight * (1 - z);
        return std::array<double, 4>{0.384 * vertical, vertical, 0.384 * vertical, 0};
    });
    for (std::size_t p = 0; p < simulation.state.points.size(); ++p) {
        simulation.state.points.porePressure[p] = liquidDensity * g * (level - simulation.state.points.z[p]);
    }
    return simulation;
}

TEST_P(FreeSurfaces, aColumnUnderWaterStaysAtRest)
{
    for (const double level : {1.0, 30.0}) { // the constant part of the pressure drops out
        Simulation simulation = columnUnderWater(level);
        simulation.start();
        const double dt = 0.8 * simulation.step->stableStep(simulation.state).step;
        for (int i = 0; i < 10000; ++i) {
            simulation.step->advance(simulation.state, dt);
        }
        const double fastest = fastestOfBothPhases(simulation.state.points);
        report("column under water after 1e4 steps: largest velocity [m/s]", fastest, 1e-8);
        EXPECT_LT(fastest, 1e-8) << "level " << level;
    }
}

/// Suction on the surface of a column with an impermeable base: the pore pressure falls by as much, and no
/// effective stress is left of it.
TEST_P(FreeSurfaces, aSuctionReachesTheWholeColumn)
{
    Simulation simulation = columnUnderWater(1);
    simulation.scene.freeSurfaces[0].pressure = constantFunction1(-2e4);
    simulation.scene.controls.localDamping = 0.3;
    simulation.start();
    simulation.run(10, 0.8);
    const MaterialPoints& points = simulation.state.points;
    double largest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double exact = liquidDensity * g * (1 - points.initialZ[p]) - 2e4;
        largest = std::max(largest, std::abs(points.porePressure[p] - exact));
    }
    report("suction on the surface: largest difference of pressure [Pa]", largest, 20);
    EXPECT_LT(largest, 20);
}

/// Where soil has come to the top of a wall, two waters meet over it. Each soil feels its own.
TEST_P(FreeSurfaces, doNotPushSoilAtTheTopOfAWallBetweenThem)
{
    constexpr double inside = -5e4;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 0.5, 5), evenLines(0, 1.3, 13), Geometry::axisymmetric);
    const int soil = simulation.addMaterial("soil", saturatedSoil(6e7, 0.25, 1e-12, 2e7));
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.pressureCoupling = coupling;
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    simulation.setPressures("right { type impermeable; } bottom { type impermeable; } "
                            "top { type impermeable; }");
    RigidBody tube;
    tube.name = "tube";
    tube.profile = caissonProfile(0.3, 0.1, 1, 0, 0);
    simulation.state.bodies.push_back(tube);
    for (const auto region : {FreeSurface::Region::inside, FreeSurface::Region::outside}) {
        FreeSurface surface;
        surface.name = region == FreeSurface::Region::inside ? "plug" : "seabed";
        surface.region = region;
        surface.body = tube.name;
        surface.pressure = constantFunction1(region == FreeSurface::Region::inside ? inside : 0);
        simulation.scene.freeSurfaces.push_back(std::move(surface));
    }
    simulation.fill(soil, 2, 2, [](double r, double z) { return r < 0.2 ? z < 1.05 : r > 0.3 && z < 0.95; });
    MaterialPoints& points = simulation.state.points;
    points.addLiquid();
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.porePressure[p] = points.r[p] < 0.2 ? inside : 0;
    }
    simulation.start();
    const double dt = 0.5 * simulation.step->stableStep(simulation.state).step;
    double fastest = 0;
    for (int i = 0; i < 100; ++i) {
        simulation.step->advance(simulation.state, dt);
        fastest = std::max(fastest, fastestOfBothPhases(points));
    }
    report("two waters over a wall: largest velocity of the soil [m/s]", fastest, 1e-10);
    EXPECT_LT(fastest, 1e-10);
}

/// Below an impermeable surface the pressure of the base comes to stand in the whole column; what is fed in
/// through the surface is stored.
TEST(FreeSurface, aCoverLetsThroughTheFlowThatIsGiven)
{
    for (const double flow : {0.0, -1e-6}) { // [m3/s] out of the soil, whole column of revolution
        Simulation simulation = columnUnderWater(1);
        FreeSurface& surface = simulation.scene.freeSurfaces[0];
        surface.seepageFlow = constantFunction1(flow);
        surface.compliance = 1e-12;
        if (flow == 0) {
            simulation.setPressures("right { type impermeable; } top { type impermeable; } "
                                    "bottom { type hydrostatic; level 1; pressure 1e3; }");
        }
        simulation.scene.controls.localDamping = 0.3;
        const MaterialPoints& points = simulation.state.points;
        const std::vector<double> volumes = points.volume;
        const std::vector<double> pressures = points.porePressure;
        simulation.start();
        simulation.run(flow == 0 ? 10 : 2, 0.8);
        if (flow == 0) {
            double largest = 0;
            for (std::size_t p = 0; p < points.size(); ++p) {
                const double exact = liquidDensity * g * (1 - points.initialZ[p]) + 1e3;
                largest = std::max(largest, std::abs(points.porePressure[p] - exact));
            }
            report("impermeable surface: largest difference of pressure [Pa]", largest, 10);
            EXPECT_LT(largest, 10);
            EXPECT_NEAR(simulation.state.pumped[0], 1e3, 10);
            continue;
        }
        double stored = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            stored += points.volume[p] - volumes[p] +
                      porosity * volumes[p] * (points.porePressure[p] - pressures[p]) / 2e7;
        }
        report("covered surface: stored/inflow - 1", 2 * M_PI * stored / (-flow * 2) - 1, 2e-3);
        EXPECT_NEAR(2 * M_PI * stored / (-flow * 2), 1, 2e-3);
    }
}

/// Undrained soil with a free surface, thrown about: what its points grow by is what the water in them
/// expands by, also where the strains are those of velocities that are mapped again.
TEST(Projection, theWaterKnowsOfAllTheVolumeThatTheSoilIsStrainedBy)
{
    constexpr double stiffness = 2.2e9;
    for (const auto remap : {SolutionControls::Remap::loose, SolutionControls::Remap::all}) {
        Simulation simulation;
        simulation.state.mesh =
            structuredMesh(evenLines(0, 1, 8), evenLines(0, 1.25, 10), Geometry::planeStrain);
        const int soil = simulation.addMaterial("soil", saturatedSoil(6e7, 0.25, 1e-18, stiffness));
        SolutionControls& controls = simulation.scene.controls;
        controls.phases = 2;
        controls.pressureCoupling = Coupling::projection;
        controls.checkerboardFilter = 0; // it moves water between the cells
        controls.remap = remap;
        controls.femCells = SolutionControls::FemCells::none; // whose points wait
        simulation.setConditions("left { type slip; } right { type slip; } bottom { type slip; } "
                                 "top { type zeroGradient; }");
        simulation.setPressures("left { type impermeable; } right { type impermeable; } "
                                "bottom { type impermeable; } top { type impermeable; }");
        FreeSurface surface;
        surface.name = "surface";
        surface.level = 1;
        simulation.scene.freeSurfaces.push_back(std::move(surface));
        simulation.fill(soil, 2, 2, [](double, double z) { return z < 1; });
        MaterialPoints& points = simulation.state.points;
        points.addLiquid();
        constexpr double speed = 1e-3, size = 0.125;
        for (std::size_t p = 0; p < points.size(); ++p) { // alternating from point to point
            points.vr[p] = points.wr[p] = p % 3 == 0 ? speed : -speed;
            points.vz[p] = points.wz[p] = p % 2 == 0 ? speed : -speed;
        }
        simulation.start();
        const double dt = 0.5 * simulation.step->stableStep(simulation.state).step;
        simulation.step->advance(simulation.state, dt); // the first one strains by half a step more
        double largest = 0;
        for (int step = 0; step < 20; ++step) {
            const auto volume = points.volume;
            const auto pressure = points.porePressure;
            simulation.step->advance(simulation.state, dt);
            std::vector<double> unbalanced(simulation.state.mesh.cells(), 0);
            for (std::size_t p = 0; p < points.size(); ++p) {
                unbalanced[points.cell[p]] +=
                    points.volume[p] - volume[p] +
                    porosity * volume[p] * (points.porePressure[p] - pressure[p]) / stiffness;
            }
            for (const double of : unbalanced) {
                largest = std::max(largest, std::abs(of) / (size * size) / (speed * dt / size));
            }
        }
        report("projection: strain of the soil that the water knows nothing of", largest, 1e-3);
        EXPECT_LT(largest, 1e-3);
    }
}

/// Pressures after some steps from `pressure(column, row)` in the cells of a mesh with graded lines.
template <class Pressure>
MaterialPoints filteredPoints(const Pressure& pressure, double filter, int steps, bool triangles = false)
{
    Simulation simulation;
    const std::vector<double> r{0, 0.1, 0.22, 0.35, 0.5, 0.6, 0.68},
        z{0, 0.1, 0.21, 0.35, 0.5, 0.64, 0.74, 0.8};
    simulation.state.mesh = structuredMesh(r, z, Geometry::axisymmetric, triangles);
    const int soil = simulation.addMaterial("soil", saturatedSoil(6e7, 0.25, 1e-14, 2e7));
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.pressureCoupling = coupling;
    simulation.scene.controls.checkerboardFilter = filter;
    simulation.scene.controls.femCells = SolutionControls::FemCells::none;
    simulation.setConditions(
        "left { type slip; } right { type slip; } bottom { type slip; } top { type slip; }");
    simulation.setPressures("left { type impermeable; } right { type impermeable; } "
                            "bottom { type impermeable; } top { type impermeable; }");
    if (triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
    simulation.fill(soil, triangles ? 3 : 2, 2);
    MaterialPoints& points = simulation.state.points;
    points.addLiquid();
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto column = std::ranges::upper_bound(r, points.r[p]) - r.begin();
        const auto row = std::ranges::upper_bound(z, points.z[p]) - z.begin();
        points.porePressure[p] = pressure(column, row);
    }
    simulation.start();
    const double dt = 0.5 * simulation.step->stableStep(simulation.state).step;
    for (int i = 0; i < steps; ++i) {
        simulation.step->advance(simulation.state, dt);
    }
    return points;
}

// Those of consolidation and of waves, that is; whatever they are like from row to row.
TEST(Pressure, theFilterLeavesFieldsOfOneDimensionAlone)
{
    const std::array<double, 8> ofRow{0, 700, -300, 900, 150, -820, 410, 20};
    const auto layers = [&](auto, auto row) { return ofRow[row]; };
    const MaterialPoints with = filteredPoints(layers, 1, 50), without = filteredPoints(layers, 0, 50);
    double largest = 0;
    for (std::size_t p = 0; p < with.size(); ++p) {
        largest = std::max(largest, std::abs(with.porePressure[p] - without.porePressure[p]));
    }
    report("what the filter changes in a field of one dimension, of 900 Pa", largest, 1e-6);
    EXPECT_LT(largest, 1e-6);
}

TEST(Pressure, theFilterKeepsTheTotalAndMakesNothingGrow)
{
    const auto rough = [](auto column, auto row) {
        return static_cast<double>((7919 * column * column + 104729 * row * column + 31 * row) % 2001 - 1000);
    };
    for (const bool triangles : {false, true}) {
        const MaterialPoints with = filteredPoints(rough, 1, 1, triangles);
        const MaterialPoints without = filteredPoints(rough, 0, 1, triangles);
        double total = 0, changed = 0, squareWith = 0, squareWithout = 0;
        for (std::size_t p = 0; p < with.size(); ++p) {
            const double change = with.porePressure[p] - without.porePressure[p];
            total += with.volume[p] * change;
            changed += with.volume[p] * std::abs(change);
            squareWith += with.volume[p] * with.porePressure[p] * with.porePressure[p];
            squareWithout += without.volume[p] * without.porePressure[p] * without.porePressure[p];
        }
        report("what the filter adds to the total, of what it moves", std::abs(total) / changed, 1e-6);
        EXPECT_GT(changed, 0) << "no filter at all";
        EXPECT_LT(std::abs(total), 1e-6 * changed); // the strains of the step are 1e-7
        EXPECT_LT(squareWith, squareWithout);
    }
}

TEST(Pressure, aCheckerboardIsRemoved)
{
    for (const bool triangles : {false, true}) {
        Simulation simulation;
        simulation.state.mesh =
            structuredMesh(evenLines(0, 1, 10), evenLines(0, 1, 10), Geometry::planeStrain, triangles);
        const int soil = simulation.addMaterial("soil", saturatedSoil(6e7, 0.25, 1e-14, 2e7));
        simulation.scene.controls.phases = 2;
        simulation.scene.controls.pressureCoupling = coupling;
        if (triangles) {
            simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
        }
        simulation.setConditions(
            "left { type fixedValue; value uniform (0 0 0); } right { type fixedValue; "
            "value uniform (0 0 0); } bottom { type fixedValue; value uniform (0 0 0); } "
            "top { type fixedValue; value uniform (0 0 0); }");
        simulation.setPressures("left { type impermeable; } right { type impermeable; } "
                                "bottom { type impermeable; } top { type impermeable; }");
        simulation.fill(soil, triangles ? 3 : 2, 2);
        MaterialPoints& points = simulation.state.points;
        points.addLiquid();
        for (std::size_t p = 0; p < points.size(); ++p) {
            const int column = static_cast<int>(10 * points.r[p]), row = static_cast<int>(10 * points.z[p]);
            points.porePressure[p] = (column + row) % 2 == 0 ? 1e3 : -1e3;
        }
        simulation.start();
        const double dt = 0.5 * simulation.step->stableStep(simulation.state).step;
        const double before = simulation.step->checkerboardIndex(simulation.state);
        for (int i = 0; i < 400; ++i) {
            simulation.step->advance(simulation.state, dt);
        }
        double largest = 0; // alternating sum around a node, over four; what is left on triangles
        for (int i = 1; i < 10; ++i) {
            for (int j = 1; j < 10; ++j) {
                double sum = 0;
                for (std::size_t p = 0; p < points.size(); ++p) {
                    const int column = static_cast<int>(10 * points.r[p]) - i,
                              row = static_cast<int>(10 * points.z[p]) - j;
                    if ((column == -1 || column == 0) && (row == -1 || row == 0)) {
                        sum += (column == row ? 1 : -1) * points.porePressure[p] / (triangles ? 6 : 4);
                    }
                }
                largest = std::max(largest, std::abs(sum) / 4);
            }
        }
        if (triangles) {
            for (std::size_t p = 0; p < points.size(); ++p) {
                EXPECT_LT(std::abs(points.porePressure[p]), 200) << "point " << p;
            }
        }
        std::printf("checkerboard: index %.3f, largest of 1000 Pa after 400 steps %.3g\n", before, largest);
        EXPECT_GT(before, 0.8);
        EXPECT_LT(largest, 100);
    }
}

// ---------------------------------------------------------------------------------------------------------

/// V10: the first mode of a column fixed at its base, free and drained at the top: rms over two periods of
/// the solid's velocity amplitude against the two coupled equations of the mode, over its start.
double waveError(double hydraulicConductivity, double bulk, int n)
{
    const double M = 72e6, E = 60e6, nu = 0.25;
    const double permeability = hydraulicConductivity * viscosity / (liquidDensity * g);
    Simulation simulation = column(n, false, Geometry::planeStrain, saturatedSoil(E, nu, permeability, bulk),
                                   "type zeroGradient;", "type fixedValue; value uniform 0;");
    const double K = pi / 2;
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.vz[p] = points.wz[p] = 1e-3 * std::sin(K * points.z[p]);
    }
    simulation.start();
    const double mw = porosity * liquidDensity, ms = (1 - porosity) * solidDensity;
    const double drag = porosity * porosity * viscosity / permeability;
    const double storage = bulk / porosity, nw = porosity, ns = 1 - porosity;
    const double c = std::sqrt((M + storage) / (mw + ms));
    const double duration = 2 * 4 / c;
    const long steps = std::lround(duration / (0.5 * simulation.step->stableStep(simulation.state).step));
    const double dt = duration / static_cast<double>(steps);
    // The mode's own equations, by the implicit midpoint rule with small steps.
    double uw = 0, us = 0, w = 1e-3, v = 1e-3;
    constexpr int fine = 20;
    double error = 0;
    for (long i = 0; i < steps; ++i) {
        simulation.step->advance(simulation.state, dt);
        const double h = dt / fine;
        for (int j = 0; j < fine; ++j) {
            uw += 0.5 * h * w;
            us += 0.5 * h * v;
            const double p = storage * (nw * uw + ns * us);
            const double aw = w - h * K * K * nw * p / mw;
            const double as = v - h * K * K * (ns * p + M * us) / ms;
            const double relative = (aw - as) / (1 + h * drag * (1 / mw + 1 / ms));
            v = (mw * aw + ms * as - mw * relative) / (mw + ms);
            w = v + relative;
            uw += 0.5 * h * w;
            us += 0.5 * h * v;
        }
        double amplitude = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            amplitude +=
                2 * points.vz[p] * std::sin(K * points.initialZ[p]) / static_cast<double>(points.size());
        }
        error += std::pow(amplitude - v, 2) / static_cast<double>(steps);
    }
    return std::sqrt(error) / 1e-3;
}

TEST(Waves, theFirstModeOfAColumnHasTheCoupledFrequency)
{
    for (const double k : {1e-6, 1e-4, 1e-2}) {
        const double error = waveError(k, 2.2e9, 40);
        report("two-phase wave: rms of the amplitude", error, 1e-2);
        EXPECT_LT(error, 1e-2) << "k " << k;
    }
}

// ---------------------------------------------------------------------------------------------------------

/// The friction on a rod in an annulus that presses on it with an effective stress and ten times as much pore
/// pressure: from the effective stress alone.
TEST_P(Rod, frictionFollowsFromTheEffectiveStressAlone)
{
    const int n = 8;
    const double a = 0.5, b = 1, height = 8, pressed = 1e3, pore = 1e4, young = 1e7, mu = 0.3;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, b, 2 * n), evenLines(0, height, 8 * n), Geometry::axisymmetric);
    const int soil = simulation.addMaterial("soil", saturatedSoil(young, 0.25, 1e-9, 2e7));
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.pressureCoupling = coupling;
    simulation.setConditions("right { type fixedValue; value uniform (0 0 0); } "
                             "bottom { type slip; } top { type slip; }");
    simulation.setPressures("right { type fixedValue; value uniform 10000; } bottom { type impermeable; } "
                            "top { type impermeable; }");
    const double M = oedometricModulus(young, 0.25), G = young / 2.5;
    const double c = std::sqrt(M / 2072.5);
    const double slipAt = mu * pressed * a * std::log(b / a) / G, duration = 30 * height / c;
    RigidBody rod;
    rod.name = "rod";
    rod.profile = profileFromPolygon({{0, 0}, {a, 0}, {a, height + 2}, {0, height + 2}});
    rod.tipLevel = rod.initialTipLevel = -1;
    rod.friction = mu;
    rod.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(-2 * slipAt / duration));
    rod.ramp = 0.5 * duration;
    simulation.state.bodies.push_back(rod);
    simulation.fill(soil, 2, 2, [&](double r, double) { return r > a; });
    simulation.state.points.addLiquid();
    std::ranges::fill(simulation.state.points.porePressure, pore);
    simulation.setStress([&](double, double) {
        return std::array<double, 4>{-pressed, -pressed, -pressed, 0};
    });
    simulation.start();
    simulation.run(0.9 * duration, 0.8);
    simulation.state.reactions[0].restartCollection();
    simulation.run(duration, 0.8);
    const BodyReaction& reaction = simulation.state.reactions[0];
    const double shear = -reaction.verticalImpulse[static_cast<int>(SurfacePart::outer)] / reaction.duration /
                         (mu * pressed * a * height * (1 - 1.0 / (8 * n)));
    report("pull-out under pore pressure: tau/(mu sigma') - 1", shear - 1, 1e-2);
    EXPECT_NEAR(shear, 1, 1e-2);
}

/// Solid that moves into a corner while the liquid moves out of it: neither face lets it pass, whatever the
/// drag along the other one. The four nodes of the cell follow from its four points.
TEST(Contact, aCornerHoldsTheSolidAtBothFaces)
{
    Simulation simulation;
    const std::vector<double> lines{0, 1, 1.5};
    simulation.state.mesh = structuredMesh(lines, lines, Geometry::planeStrain);
    const int soil = simulation.addMaterial("soil", saturatedSoil(6e7, 0.25, 1e-18, 2e7));
    simulation.scene.controls.phases = 2;
    simulation.scene.controls.femCells = SolutionControls::FemCells::none;
    simulation.setConditions("left { type zeroGradient; } right { type slip; } bottom { type zeroGradient; } "
                             "top { type slip; }");
    RigidBody lid;
    lid.name = "lid";
    lid.profile = caissonProfile(1.5, 0.5, 1.5, 1, 0.5);
    simulation.state.bodies.push_back(lid);
    simulation.fill(soil, 2, 2, [](double r, double z) { return r < 1 && z < 1; });
    MaterialPoints& points = simulation.state.points;
    ASSERT_EQ(points.size(), 4);
    points.addLiquid();
    for (const double liquid : {-2.0, 0.0, 3.0}) {
        std::ranges::fill(points.vr, 1.0);
        std::ranges::fill(points.vz, 1.0);
        std::ranges::fill(points.wr, liquid);
        std::ranges::fill(points.wz, liquid);
        simulation.start();
        const std::vector<double> r = points.r, z = points.z;
        simulation.step->advance(simulation.state, 1e-9); // no time for stress, enough for drag
        Eigen::Matrix4d N;
        Eigen::Matrix<double, 4, 2> v;
        for (int p = 0; p < 4; ++p) {
            N.row(p) << (1 - r[p]) * (1 - z[p]), r[p] * (1 - z[p]), r[p] * z[p], (1 - r[p]) * z[p];
            v.row(p) << points.vr[p] - 1, points.vz[p] - 1;
        }
        const Eigen::Matrix<double, 4, 2> change = N.fullPivLu().solve(v);
        const double slip = std::max(std::abs(1 + change(2, 0)), std::abs(1 + change(2, 1)));
        report("solid in a corner: velocity of its node [m/s]", slip, 1e-6);
        EXPECT_LT(slip, 1e-6) << "liquid " << liquid;
    }
}

} // namespace
} // namespace caisson::testing
