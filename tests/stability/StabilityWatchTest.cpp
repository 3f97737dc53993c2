#include "scene/StabilityWatch.h"

#include "Scenes.h"
#include "dictionary/Text.h"

#include <gtest/gtest.h>

#include <limits>

namespace caisson::stability {
namespace {

/// What the watch says of a sound scene after `spoil` has been at it; empty where it is content.
std::string saidOf(int phases, const std::function<void(State&)>& spoil, bool writing = true)
{
    Simulation simulation = make(Block{.kernel = {phases, false, Geometry::axisymmetric}});
    simulation.start();
    const StableStep stable = simulation.step->stableStep(simulation.state);
    StabilityWatch watch;
    for (int i = 0; i < StabilityWatch::interval; ++i) {
        simulation.step->advance(simulation.state, 0.8 * stable.step);
        watch.afterStep(simulation.scene, simulation.state, stable, false);
    }
    spoil(simulation.state);
    ++simulation.state.step; // a look is not due
    try {
        watch.afterStep(simulation.scene, simulation.state, stable, writing);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

void expectSaid(const std::string& said, const std::vector<std::string>& wanted)
{
    for (const std::string& part : wanted) {
        EXPECT_NE(said.find(part), std::string::npos) << "expected in it: " << part << "\ngot: " << said;
    }
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(StabilityWatch, leavesASoundSceneAlone)
{
    for (const int phases : {1, 2}) {
        EXPECT_EQ(saidOf(phases, [](State&) {}), "") << phases << " phases";
    }
}

TEST(StabilityWatch, namesTheQuantityThePointAndItsCell)
{
    const auto third = [](const State& state) {
        return "material point " + std::to_string(state.points.id[3]) + " in cell " +
               std::to_string(state.points.cell[3]);
    };
    std::string point;
    const auto spoiling = [&](auto&& quantity) {
        return [&, quantity](State& state) {
            point = third(state);
            quantity(state.points);
        };
    };
    expectSaid(saidOf(1, spoiling([](MaterialPoints& p) { p.stress[2][3] = nan; })),
               {"the stress of ", point, "is not a finite number", "of its volume", "step", "maxCo"});
    expectSaid(
        saidOf(1, spoiling([](MaterialPoints& p) { p.vz[3] = -std::numeric_limits<double>::infinity(); })),
        {"the velocity of ", point, "is not a finite number"});
    expectSaid(saidOf(2, spoiling([](MaterialPoints& p) { p.porePressure[3] = nan; })),
               {"the pore pressure of ", point});
    expectSaid(saidOf(2, spoiling([](MaterialPoints& p) { p.wr[3] = nan; })),
               {"the liquid velocity of ", point});
    expectSaid(saidOf(1, spoiling([](MaterialPoints& p) { p.volume[3] = -1e-9; })),
               {point, "has lost its volume"});
    expectSaid(saidOf(2, spoiling([](MaterialPoints& p) { p.volume[3] *= 0.5; })),
               {point, "has the porosity -"});
    expectSaid(saidOf(1, spoiling([](MaterialPoints& p) { p.vr[3] = 1e4; })),
               {point, "moves at 1e+04 m/s, faster than waves of 186.4 m/s",
                text("at step %d the fastest was", StabilityWatch::interval)});
}

TEST(StabilityWatch, looksBeforeEveryWriteAndElseEveryFewSteps)
{
    const auto spoil = [](State& state) { state.points.vr[3] = 1e4; };
    EXPECT_NE(saidOf(1, spoil, true), "");
    EXPECT_EQ(saidOf(1, spoil, false), "");
}

TEST(StabilityWatch, looksAtBodiesInEveryStep)
{
    Simulation simulation = make(Skirt{});
    simulation.start();
    const StableStep stable = simulation.step->stableStep(simulation.state);
    simulation.step->advance(simulation.state, 0.8 * stable.step);
    simulation.state.bodies[0].velocity = nan;
    StabilityWatch watch;
    EXPECT_THROW(watch.afterStep(simulation.scene, simulation.state, stable, false), InputError);
}

/// Waves of soil with scaled inertia are slower, and so is what outruns them.
TEST(StabilityWatch, measuresSpeedsAgainstTheWavesOfTheScaledSoil)
{
    for (const double scaling : {1.0, 1e4}) {
        Block block;
        block.massScaling = scaling;
        block.noise = 0;
        Simulation simulation = make(block);
        simulation.start();
        const StableStep stable = simulation.step->stableStep(simulation.state);
        simulation.state.points.vr[3] = 50; // of 186 m/s, or of 1.9 m/s
        StabilityWatch watch;
        if (scaling > 1) {
            EXPECT_THROW(watch.look(simulation.scene, simulation.state, stable), InputError);
        } else {
            EXPECT_NO_THROW(watch.look(simulation.scene, simulation.state, stable));
        }
    }
}

} // namespace
} // namespace caisson::stability
