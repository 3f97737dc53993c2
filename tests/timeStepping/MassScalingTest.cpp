#include "timeStepping/MassScaling.h"

#include "Verification.h"

namespace caisson::testing {
namespace {

/// A skirt of 0.2 m in 3 m of sand, its tip 0.5 m deep, going down at 0.2 m/s since long.
Simulation skirtOnItsWay()
{
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 3, 30), evenLines(-3, 0.4, 34), Geometry::axisymmetric);
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; liquidDensity 1000; weight submerged; "
                "youngsModulus 60e6; poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 0; cohesion 0;");
    simulation.scene.gravity = {0, -9.81};
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    RigidBody skirt;
    skirt.name = "skirt";
    skirt.profile = caissonProfile(1.2, 0.2, 5, 0, 0);
    skirt.tipLevel = skirt.initialTipLevel = -0.5;
    skirt.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(0.2));
    skirt.velocity = -0.2;
    skirt.ramp = 0.05;
    simulation.state.bodies.push_back(skirt);
    simulation.scene.motion = MeshMotion({-2.5, -0.8, -0.3, 0}, "skirt");
    simulation.scene.movingBody = 0;
    simulation.fill(sand, 2, 4, [&](double r, double z) { return z < 0 && !skirt.contains(r, z); });
    const double weight = 0.65 * 1650 * 9.81;
    simulation.setStress([&](double, double z) {
        return std::array<double, 4>{0.384 * weight * z, weight * z, 0.384 * weight * z, 0};
    });
    simulation.scene.controls.massScaling = 1000;
    simulation.scene.controls.inertiaGate = 0.1;
    simulation.scene.controls.massScalingBy = SolutionControls::MassScaling::gates;
    simulation.start();
    return simulation;
}

TEST(MassScaling, keepsInertiaBelowItsShareOfTheStressAtTheTip)
{
    Simulation simulation = skirtOnItsWay();
    State& state = simulation.state;
    state.time = 10;
    state.timeStep = 1e-4;
    state.massScaling = 500;
    state.reactions[0].work = 1e9;
    const double stress = 0.65 * 1650 * 9.81 * 0.5, inertia = 2072.5 * 0.2 * 0.2;
    expectNear("gate of inertia", adaptedMassScaling(simulation.scene, state), 0.1 * stress / inertia,
               1e-9 * stress);
    simulation.scene.controls.massScaling = 2;
    expectNear("upper limit", adaptedMassScaling(simulation.scene, state), 2, 0);
    state.massScaling = 1.5;
    expectNear("growth", adaptedMassScaling(simulation.scene, state), 1.65, 1e-12);
}

TEST(MassScaling, waitsUntilABodyHasItsSpeed)
{
    Simulation simulation = skirtOnItsWay();
    State& state = simulation.state;
    state.massScaling = 500;
    state.reactions[0].work = 1e9;
    state.timeStep = 1e-4;
    RigidBody& skirt = state.bodies[0];
    skirt.ramp = 1;
    state.time = 0.5;
    skirt.velocity = skirt.prescribedVelocity(state.time);
    const double later = skirt.prescribedVelocity(state.time + state.timeStep);
    const double duration = skirt.velocity / ((later - skirt.velocity) / state.timeStep);
    simulation.scene.controls.inertiaGate = 1e9;
    const double passages = duration * std::sqrt(72e6 / 2072.5) / 0.2;
    EXPECT_GT(passages, 20);
    expectNear("twenty passages of a wave", adaptedMassScaling(simulation.scene, state),
               std::pow(passages / 20, 2), 0.02);
}

TEST(MassScaling, keepsKineticEnergyBelowItsShareOfTheWork)
{
    Simulation simulation = skirtOnItsWay();
    simulation.setVelocity([](double, double) { return std::array<double, 2>{0, 0.01}; });
    State& state = simulation.state;
    state.time = 10;
    state.timeStep = 1e-4;
    state.massScaling = 500;
    simulation.scene.controls.inertiaGate = 1e9;
    const double kinetic = sumEnergies(state).kinetic;
    state.reactions[0].work = 1000 * kinetic;
    expectNear("gate of energy", adaptedMassScaling(simulation.scene, state), 0.05 * 1000, 1e-9);
    state.reactions[0].work = 0;
    expectNear("no work, no scaling", adaptedMassScaling(simulation.scene, state), 1, 0);
}

// The factor is part of the state: the step that it allows is used, and the soil does not notice a change.
TEST(MassScaling, growsAsTheRunGoesAndLengthensTheStep)
{
    Simulation simulation = skirtOnItsWay();
    const double before = simulation.step->stableStep(simulation.state).step;
    simulation.run(0.3, 0.8);
    const State& state = simulation.state;
    EXPECT_GT(state.massScaling, 1.2);
    const double share = simulation.step->stableStep(state).step / before / std::sqrt(state.massScaling);
    expectNear("stable step over that of the mesh, by the root of the factor", share, 1, 0.05);
    for (std::size_t p = 0; p < state.points.size(); ++p) {
        EXPECT_LT(std::hypot(state.points.vr[p], state.points.vz[p]), 2.0);
    }
}

// Only cells that limit the step are scaled.
TEST(MassScaling, ofSmallCellsGivesTheStepOfTheSmallestOneScaled)
{
    for (const bool smallCells : {false, true}) {
        Simulation simulation;
        simulation.state.mesh =
            structuredMesh({0, 0.1, 0.2, 0.4, 0.8, 1.6}, evenLines(0, 1, 4), Geometry::planeStrain);
        const int soil = simulation.addMaterial("soil", elasticSolid(1e7, 0.25, 2000));
        simulation.setConditions("left { type slip; } right { type slip; } bottom { type slip; } "
                                 "top { type zeroGradient; }");
        simulation.fill(soil, 2, 2);
        simulation.start();
        const double alone = simulation.step->stableStep(simulation.state).step;
        simulation.scene.controls.massScaling = 4;
        simulation.scene.controls.scaleSmallCells = smallCells;
        simulation.start();
        expectNear("step with a factor of 4", simulation.step->stableStep(simulation.state).step / alone, 2,
                   1e-12);
        // A free fall of the whole has its scaled inertia against its weight: columns of large cells fall as
        // if they were not scaled.
        simulation.scene.gravity = {0, -1};
        simulation.run(0.01, 0.8);
        const MaterialPoints& points = simulation.state.points;
        double fastest = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            fastest = std::max(fastest, -points.vz[p]);
        }
        EXPECT_EQ(fastest > 0.008, smallCells) << fastest;
    }
}

} // namespace
} // namespace caisson::testing
