// The quick squares of the stability map: what they are held to is said in Drive.h.

#include "Limits.h"
#include "Matrix.h"
#include "dictionary/Text.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <limits>

namespace caisson::stability {
namespace {

std::vector<Case> quickCases()
{
    std::vector<Case> all = stabilityMatrix();
    std::erase_if(all, [](const Case& square) { return !square.quick; });
    return all;
}

class QuickSquare : public ::testing::TestWithParam<std::string>
{
};

std::vector<std::string> quickSweeps()
{
    std::vector<std::string> names;
    for (const Case& square : quickCases()) {
        if (names.empty() || names.back() != square.sweep) {
            names.push_back(square.sweep);
        }
    }
    return names;
}

TEST_P(QuickSquare, holdsOrIsStopped)
{
    for (const Case& square : quickCases()) {
        if (square.sweep != GetParam()) {
            continue;
        }
        const Outcome outcome = outcomeOf(square.run);
        std::printf("%s = %s, %s: %s %s\n", square.sweep.c_str(), square.value.c_str(), square.kernel.c_str(),
                    name(outcome.verdict).c_str(), outcome.remark.c_str());
        EXPECT_TRUE(square.content(outcome))
            << "expected holds" << (square.mayStop ? " or stopped" : "") << ", got " << name(outcome.verdict);
    }
}

std::string testName(const ::testing::TestParamInfo<std::string>& info)
{
    std::string result;
    bool capital = false;
    for (const char letter : info.param) {
        const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
        if (plain) {
            result += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
        }
        capital = !plain;
    }
    return result;
}

INSTANTIATE_TEST_SUITE_P(Map, QuickSquare, ::testing::ValuesIn(quickSweeps()), testName);

/// A block of six by six cells, all filled, with noise.
Block noisyBlock(int phases, bool triangles)
{
    Block block{.kernel = {phases, triangles, Geometry::planeStrain}};
    block.columns = block.rows = 6;
    block.emptyRows = 0;
    block.gravity = 0;
    block.noise = 1e-7;
    return block;
}

/// Noise is bounded at the estimate of the stable step over 3000 steps, and grows at 1/0.75 of it.
void expectSafeAndThreeQuarters(const Block& block, const std::string& name)
{
    EXPECT_FALSE(grows(block, 1.0, 3000))
        << name << ": expected bounded noise at the estimate, got ten times its energy";
    EXPECT_TRUE(grows(block, 1 / 0.75, 3000))
        << name << ": expected noise that grows at 1.333 of the estimate, got bounded noise";
}

/// The estimate of the stable step is safe, and not much too small, with implicit drag.
TEST(StableStep, isSafeAndThreeQuartersOfTheTrueLimitAtLeast)
{
    for (const int phases : {1, 2}) {
        for (const bool triangles : {false, true}) {
            const Block block = noisyBlock(phases, triangles);
            expectSafeAndThreeQuarters(block, block.kernel.name());
        }
    }
}

/// The masses of nodes among such points differ by a factor of ten.
TEST(StableStep, isSafeForTrianglesWithSinglePointsAtRandom)
{
    for (const int phases : {1, 2}) {
        for (const unsigned seed : {1u, 2u, 3u}) {
            Block block = noisyBlock(phases, true);
            block.pointsPerSide = 1;
            block.randomPlaces = true;
            block.seed = seed;
            expectSafeAndThreeQuarters(block, block.kernel.name() + text(", seed %u", seed));
        }
    }
}

/// Averages over nodes make the waves of the water longer, the more so the stiffer it is.
TEST(StableStep, knowsTheAveragedPressuresOfStiffWaterInTriangles)
{
    for (const double permeability : {1e-12, 1e-8}) {
        for (const int emptyRows : {0, 1}) {
            Block block = noisyBlock(2, true);
            block.soil.permeability = permeability;
            block.soil.liquidBulkModulus = 2.2e9;
            block.emptyRows = emptyRows;
            expectSafeAndThreeQuarters(
                block, text("k = %g m2, %s", permeability, emptyRows > 0 ? "free surface" : "all filled"));
        }
    }
}

/// Drag of the last step limits the step together with the waves.
TEST(StableStep, isSafeWithLaggedDragBesideItsCrossoverWithTheWaves)
{
    for (const bool triangles : {false, true}) {
        for (const double permeability : {5e-11, 1e-10, 2e-10}) {
            Block block = noisyBlock(2, triangles);
            block.drag = SolutionControls::Drag::lagged;
            block.soil.permeability = permeability;
            expectSafeAndThreeQuarters(block, block.kernel.name() + text(", k = %g m2", permeability));
        }
    }
}

/// With the dilatation averaged over nodes such points are thrown up until one leaves the mesh.
TEST(DilatingSand, staysAtASkirtOnTrianglesWithTheirOwnDilatation)
{
    Skirt skirt{.kernel = {1, true, Geometry::axisymmetric}};
    skirt.soil.dilatancyAngle = 20;
    const Outcome outcome = outcomeOf([&] {
        Simulation simulation = make(skirt);
        simulation.scene.controls.locking = SolutionControls::Locking::none;
        return drive(simulation, skirt.soil, 1500, 0.8);
    });
    EXPECT_EQ(outcome.verdict, Verdict::holds)
        << "expected holds over 1500 steps, got " << name(outcome.verdict) << ": " << outcome.remark;
}

/// Soil whose pores have shrunk to a tenth of its volume, with water that makes it the stiffer for it. Its
/// kinetic energy after some hundred steps over that at the start, with steps of that soil or of the soil as
/// it is given.
double energyOfCompactedSoil(bool asGiven)
{
    constexpr double porosity = 0.1;
    Block block{.kernel = {2, false, Geometry::planeStrain}};
    block.soil.liquidBulkModulus = 2.2e9;
    block.gravity = 0;
    Simulation simulation = make(block);
    MaterialPoints& points = simulation.state.points;
    simulation.start();
    const double ofGiven = simulation.step->stableStep(simulation.state).step;
    for (double& volume : points.volume) {
        volume *= (1 - Soil::porosity) / (1 - porosity);
    }
    simulation.step->rebuild(simulation.state);
    const double ofNow = simulation.step->stableStep(simulation.state).step;
    EXPECT_LT(ofNow, 0.65 * ofGiven) << "the water makes it stiffer";
    const double before = sumEnergies(simulation.state).kinetic;
    for (int i = 0; i < 300; ++i) {
        try {
            simulation.step->advance(simulation.state, 0.95 * (asGiven ? ofGiven : ofNow));
        } catch (const InputError&) { // a point has left the mesh
            return std::numeric_limits<double>::infinity();
        }
    }
    return sumEnergies(simulation.state).kinetic / before;
}

TEST(StableStep, followsThePorosityOfCompactedSoil)
{
    const double now = energyOfCompactedSoil(false);
    EXPECT_LT(now, 1);
    const double asGiven = energyOfCompactedSoil(true);
    EXPECT_FALSE(asGiven < 1e3) << "the soil as it was would have allowed that step";
    std::printf("compacted soil: kinetic energy over that at the start %.3g, with the step of the soil as "
                "given %.3g\n",
                now, asGiven);
}

} // namespace
} // namespace caisson::stability
