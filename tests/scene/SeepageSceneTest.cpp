// Seepage of a scene: round a caisson, and what the two-phase step settles to.

#include "scene/SeepageScene.h"

#include "scene/QuasiSteadySeepage.h"
#include "support/Simulation.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace caisson::testing {
namespace {

/// A caisson of 2.4 m in elastic soil of high permeability, with a suction on its plug.
Simulation caissonUnderSuction(double suction, int phases = 2, double skirtLength = 2)
{
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 3.2, 32), evenLines(-3, 0.6, 36), Geometry::axisymmetric);
    const int soil = simulation.addMaterial(
        "soil",
        "law linearElastic; porosity 0.35; solidDensity 2650; youngsModulus 60e6; poissonsRatio 0.25; "
        "intrinsicPermeability 1e-8; liquidBulkModulus 2e7;");
    simulation.scene.controls.phases = phases;
    simulation.scene.gravity = {0, -9.81};
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    simulation.setPressures(
        "right { type hydrostatic; } bottom { type impermeable; } top { type impermeable; }");
    RigidBody caisson;
    caisson.name = "caisson";
    caisson.profile = caissonProfile(1.2, 0.2, skirtLength, 0, 0);
    caisson.tipLevel = caisson.initialTipLevel = -1;
    simulation.state.bodies.push_back(caisson);
    FreeSurface plug;
    plug.region = FreeSurface::Region::inside;
    plug.body = "caisson";
    plug.pressure = constantFunction1(-suction);
    simulation.scene.freeSurfaces.push_back(std::move(plug));
    simulation.fill(soil, 2, 2, [](double r, double z) { return z < 0 && !(r > 1 && r < 1.2 && z > -1); });
    const double weight = 0.65 * 1650 * 9.81;
    simulation.setStress([&](double, double z) {
        return std::array<double, 4>{weight * z / 3, weight * z, weight * z / 3, 0};
    });
    MaterialPoints& points = simulation.state.points;
    if (phases == 2) {
        points.addLiquid();
    }
    for (std::size_t p = 0; p < points.porePressure.size(); ++p) {
        points.porePressure[p] = -9810 * points.z[p];
    }
    return simulation;
}

class TwoPhaseStep : public ::testing::TestWithParam<SolutionControls::PressureCoupling>
{
};
INSTANTIATE_TEST_SUITE_P(, TwoPhaseStep,
                         ::testing::Values(SolutionControls::PressureCoupling::explicitStep,
                                           SolutionControls::PressureCoupling::projection));

TEST_P(TwoPhaseStep, settlesToTheSteadySeepage)
{
    const double suction = 1e3;
    Simulation simulation = caissonUnderSuction(suction);
    simulation.scene.controls.pressureCoupling = GetParam();
    simulation.scene.controls.localDamping = 0.3;
    simulation.start();
    const std::vector<double> steady = steadyPorePressure(simulation.scene, simulation.state);
    const MaterialPoints& points = simulation.state.points;
    std::vector<double> exact(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        exact[points.id[p]] = steady[p] + 9810 * points.z[p];
    }
    simulation.run(0.3, 0.8);
    double error = 0, largest = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double excess = points.porePressure[p] + 9810 * points.z[p];
        error += std::pow(excess - exact[points.id[p]], 2) / static_cast<double>(points.size());
        largest = std::max(largest, -exact[points.id[p]]);
    }
    std::printf(
        "settled pore pressure: rms difference to steady seepage %.2e of the suction (largest %.3f of it)\n",
        std::sqrt(error) / suction, largest / suction);
    EXPECT_LT(std::sqrt(error) / suction, 1e-2);
    EXPECT_GT(largest / suction, 0.9); // there is a flow at all
}

// Drained soil loaded by steady seepage comes to rest with the effective stress, and the force of the water
// on the caisson, that two phases come to rest with.
TEST(QuasiSteadySeepage, leavesTheEffectiveStressThatTwoPhasesSettleTo)
{
    const double suction = 5e3;
    Simulation two = caissonUnderSuction(suction);
    two.scene.controls.localDamping = 0.3;
    two.start();
    two.run(0.6, 0.8);
    two.state.reactions[0].restartCollection();
    two.run(0.65, 0.8);

    Simulation one = caissonUnderSuction(suction, 1);
    one.scene.controls.localDamping = 0.3;
    one.scene.controls.pressureCoupling = SolutionControls::PressureCoupling::quasiSteady;
    one.start();
    QuasiSteadySeepage seepage(one.scene);
    EXPECT_TRUE(seepage.update(one.state, *one.step, true));
    EXPECT_FALSE(seepage.update(one.state, *one.step, false)) << "nothing has moved on";
    while (one.state.time < 0.65) {
        one.run(one.state.time + 0.002, 0.8);
        seepage.update(one.state, *one.step, false);
    }
    EXPECT_NEAR(one.state.reactions[0].suction, suction, 1e-9);
    one.state.reactions[0].restartCollection();
    one.run(0.7, 0.8);

    const auto byId = [](const MaterialPoints& points) {
        std::vector<double> stress(points.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
            stress[points.id[p]] = points.stress[1][p];
        }
        return stress;
    };
    const std::vector<double> expected = byId(two.state.points);
    const std::vector<double> got = byId(one.state.points);
    double difference = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
        difference += std::pow(got[i] - expected[i], 2) / static_cast<double>(got.size());
    }
    const BodyReaction& ofTwo = two.state.reactions[0];
    const BodyReaction& ofOne = one.state.reactions[0];
    const double water = ofTwo.waterImpulse / ofTwo.duration;
    std::printf("vertical effective stress: rms difference %.2e of the suction, tolerance 1e-2\n"
                "force of the water on the caisson: %.4g N/rad, expected %.4g, tolerance 2 %%\n",
                std::sqrt(difference) / suction, ofOne.waterImpulse / ofOne.duration, water);
    EXPECT_LT(std::sqrt(difference) / suction, 1e-2);
    EXPECT_NEAR(ofOne.waterImpulse / ofOne.duration / water, 1, 2e-2);
    EXPECT_LT(seepage.leftOut(), 0.01) << "nothing moves any more";
}

/// A pump that takes out what steady seepage brings at a suction arrives at that suction.
TEST(SeepageScene, aPumpSettlesAtTheSuctionWhoseSeepageItDelivers)
{
    const double suction = 1e3;
    Simulation simulation = caissonUnderSuction(suction);
    const SeepageScene setup = seepageScene(simulation.scene, simulation.state, false);
    const Seepage seepage(simulation.state.mesh, setup.soil, setup.conductivity);
    const std::vector<double> inflow = seepage.nodalInflow(seepage.steady(setup.given, setup.inflow));
    double flow = 0;
    for (const int i : seepage.nodes()) {
        flow -= setup.insideSurface[i] ? 2 * M_PI * inflow[i] : 0;
    }
    FreeSurface& plug = simulation.scene.freeSurfaces[0];
    plug.pressure = nullptr;
    plug.pumpFlow = constantFunction1(flow);
    plug.compliance = 1e-7;
    simulation.scene.controls.localDamping = 0.3;
    simulation.start();
    simulation.run(0.5, 0.8);
    std::printf("pump of %.4g m3/s: suction %.1f Pa (%.1f)\n", flow, -simulation.state.pumped[0], suction);
    EXPECT_NEAR(-simulation.state.pumped[0] / suction, 1, 2e-2);
}

double flowIntoThePlug(const Simulation& simulation)
{
    const SeepageScene setup = seepageScene(simulation.scene, simulation.state, false);
    const Seepage seepage(simulation.state.mesh, setup.soil, setup.conductivity);
    const std::vector<double> inflow = seepage.nodalInflow(seepage.steady(setup.given, setup.inflow));
    double flow = 0;
    for (const int i : seepage.nodes()) {
        flow -= setup.insideSurface[i] ? inflow[i] : 0;
    }
    return flow;
}

/// The water over the top of the wall belongs to neither side.
TEST(SeepageScene, aSkirtThatEndsLevelWithTheSoilLetsNoWaterOverItsTop)
{
    const double expected = flowIntoThePlug(caissonUnderSuction(1e3));
    const double got = flowIntoThePlug(caissonUnderSuction(1e3, 2, 1));
    std::printf("flow into the plug: %.6g m3/s/rad, expected %.6g (tolerance 1e-9 of it)\n", got, expected);
    EXPECT_NEAR(got / expected, 1, 1e-9);
}

TEST(SeepageScene, flowsBalance)
{
    const Simulation simulation = caissonUnderSuction(1e3);
    const SeepageScene setup = seepageScene(simulation.scene, simulation.state, false);
    const Seepage seepage(simulation.state.mesh, setup.soil, setup.conductivity);
    const std::vector<double> inflow = seepage.nodalInflow(seepage.steady(setup.given, setup.inflow));
    double sum = 0, largest = 0;
    for (const double flow : inflow) {
        sum += flow;
        largest = std::max(largest, std::abs(flow));
    }
    EXPECT_LT(std::abs(sum) / largest, 1e-10);
}

} // namespace
} // namespace caisson::testing
