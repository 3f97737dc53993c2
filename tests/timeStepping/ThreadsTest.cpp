#include "timeStepping/Threads.h"

#include "Verification.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

namespace caisson::testing {
namespace {

struct Variant
{
    const char* name;
    bool triangles;
    int phases;
    bool femCells;
    SolutionControls::PressureCoupling coupling = SolutionControls::PressureCoupling::explicitStep;
    int passedPointsPerCell = 0;
};

/// A skirt on its way into sand, with the mesh that follows it: every loop of a step has work to do.
State skirtAfterSomeSteps(const Variant& variant, int threads)
{
    Simulation simulation;
    simulation.scene.controls.threads = threads;
    simulation.scene.controls.phases = variant.phases;
    simulation.scene.controls.sortInterval = 7;
    simulation.scene.controls.femCells =
        variant.femCells ? SolutionControls::FemCells::automatic : SolutionControls::FemCells::none;
    simulation.scene.controls.femDistance = 2;
    simulation.scene.controls.passedPointsPerCell = variant.passedPointsPerCell;
    simulation.scene.controls.pressureCoupling = variant.coupling;
    if (variant.triangles) {
        simulation.scene.controls.locking = SolutionControls::Locking::nodalAverage;
    }
    simulation.state.mesh = structuredMesh(evenLines(0, 3, 30), evenLines(-3, 0.4, 34),
                                           Geometry::axisymmetric, variant.triangles);
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; liquidDensity 1000; weight submerged; "
                "youngsModulus 60e6; poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 0; cohesion 0; "
                "intrinsicPermeability 1e-10; liquidBulkModulus 2e7; liquidViscosity 1e-3;");
    simulation.scene.gravity = {0, -9.81};
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    if (variant.phases == 2) {
        simulation.setPressures("right { type hydrostatic; level 0; } bottom { type impermeable; } "
                                "top { type impermeable; }");
    }
    RigidBody skirt;
    skirt.name = "skirt";
    skirt.profile = caissonProfile(1.2, 0.2, 5, 0, 0);
    skirt.tipLevel = skirt.initialTipLevel = -0.5;
    skirt.friction = 0.15;
    skirt.adhesion = 100;
    skirt.ramp = 0.05;
    skirt.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(0.5));
    simulation.state.bodies.push_back(skirt);
    simulation.scene.motion = MeshMotion({-2.5, -0.8, -0.3, 0}, "skirt");
    simulation.scene.movingBody = 0;
    const auto isSoil = [&](double r, double z) { return z < 0 && !skirt.contains(r, z); };
    if (variant.triangles) {
        simulation.fill(sand, 3, 1, isSoil);
    } else {
        simulation.fill(sand, 2, 4, isSoil);
    }
    if (variant.phases == 2) {
        simulation.state.points.addLiquid();
        for (std::size_t p = 0; p < simulation.state.points.size(); ++p) {
            simulation.state.points.porePressure[p] = -9810 * simulation.state.points.z[p];
        }
    }
    const double weight = 0.65 * 1650 * 9.81;
    simulation.setStress([&](double, double z) {
        return std::array<double, 4>{0.384 * weight * z, weight * z, 0.384 * weight * z, 0};
    });
    simulation.start();
    simulation.run(0.05, 0.7);
    return simulation.state;
}

class EveryStep : public ::testing::TestWithParam<Variant>
{
};
INSTANTIATE_TEST_SUITE_P(, EveryStep,
                         ::testing::Values(Variant{"onePhaseQuadrilaterals", false, 1, false},
                                           Variant{"onePhaseQuadrilateralsBesideFemCells", false, 1, true},
                                           Variant{"onePhaseTriangles", true, 1, false},
                                           Variant{"onePhaseTrianglesBesideFemCells", true, 1, true},
                                           Variant{"twoPhaseQuadrilaterals", false, 2, false},
                                           Variant{"twoPhaseQuadrilateralsBesideFemCells", false, 2, true},
                                           Variant{"twoPhaseTriangles", true, 2, false},
                                           Variant{"twoPhaseTrianglesBesideFemCells", true, 2, true},
                                           Variant{"twoPhaseProjectionBesideFemCells", false, 2, true,
                                                   SolutionControls::PressureCoupling::projection},
                                           Variant{"twoPhaseQuadrilateralsWithMergedPoints", false, 2, true,
                                                   SolutionControls::PressureCoupling::explicitStep, 4}),
                         [](const auto& variant) { return variant.param.name; });

TEST_P(EveryStep, hasTheSameBitsForAnyNumberOfThreads)
{
    const State one = skirtAfterSomeSteps(GetParam(), 1);
    ASSERT_GT(one.step, 50);
    ASSERT_NE(one.reactions[0].totalVerticalImpulse(), 0);
    for (const int threads : {2, 3}) {
        const State several = skirtAfterSomeSteps(GetParam(), threads);
        EXPECT_EQ(one.points.id, several.points.id);
        EXPECT_EQ(one.points.cell, several.points.cell);
        EXPECT_EQ(one.points.r, several.points.r);
        EXPECT_EQ(one.points.vz, several.points.vz);
        EXPECT_EQ(one.points.volume, several.points.volume);
        EXPECT_EQ(one.points.stress, several.points.stress);
        EXPECT_EQ(one.points.porePressure, several.points.porePressure);
        EXPECT_EQ(one.filled, several.filled);
        EXPECT_EQ(one.reactions[0].verticalImpulse, several.reactions[0].verticalImpulse);
    }
}

TEST(Threads, shareEveryItemOnce)
{
    Threads threads(3);
    for (const int items : {0, 1, 7, 1000}) {
        std::vector<int> done(items, 0);
        threads.share(items, 3, [&](int, int begin, int end) {
            for (int i = begin; i < end; ++i) {
                ++done[i];
            }
        });
        EXPECT_EQ(std::ranges::count(done, 1), items);
    }
}

TEST(Threads, shareWhatOneOfThemDoesNotComeTo)
{
    Threads threads(3);
    const std::vector<int> bounds{0, 0, 100, 100}; // all of it the second thread's
    std::vector<int> done(100, 0);
    std::vector<int> begins(100, 0);
    threads.share(bounds, 8, [&](int, int begin, int end) {
        ++begins[begin];
        for (int i = begin; i < end; ++i) {
            ++done[i];
        }
    });
    EXPECT_EQ(std::ranges::count(done, 1), 100);
    for (int i = 0; i < 100; ++i) {
        EXPECT_TRUE(begins[i] == 0 || i % 8 == 0) << "a piece begins at " << i;
    }
}

// Wherever they meet: what one thread computes lies together, so that little passes from cache to cache.
TEST(Threads, meetAtOnePlaceComingFromBothEnds)
{
    Threads threads(2);
    for (const int border : {0, 200, 500, 990, 1000}) {
        const std::vector<int> bounds{0, border, 1000};
        std::vector<int> by(1000, -1);
        threads.share(bounds, 7, [&](int thread, int begin, int end) {
            std::fill(by.begin() + begin, by.begin() + end, thread);
        });
        const auto met = std::ranges::find(by, 1);
        EXPECT_EQ(std::count(by.begin(), met, 0) + std::count(met, by.end(), 1), 1000)
            << "items in more than one stretch per thread; border at " << border;
    }
}

// Which of the two ways is the faster is the machine's business: here both are taken.
TEST(Threads, shareEveryItemOnceWhicheverWayIsFaster)
{
    Threads threads(3);
    constexpr int rounds = 3000;
    std::array<int, 3> done{};
    for (int round = 0; round < rounds; ++round) {
        threads.run([&](int part) { ++done[part]; });
        threads.lap(true);
    }
    EXPECT_EQ(done, (std::array{rounds, rounds, rounds}));
}

TEST(Threads, throwWhatOneOfThemHasThrownAndGoOn)
{
    Threads threads(3);
    const auto failing = [](int part) {
        if (part == 2) {
            throw std::runtime_error("part 2");
        }
    };
    EXPECT_THROW(threads.run(failing), std::runtime_error);
    EXPECT_THROW(threads.run(failing), std::runtime_error);
    std::vector<int> done(3, 0);
    threads.run([&](int part) { done[part] = 1; });
    EXPECT_EQ(done, std::vector<int>(3, 1));
}

TEST(Threads, wakeUpAfterALongWait)
{
    Threads threads(2);
    for (int i = 0; i < 3; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::vector<int> done(2, 0);
        threads.run([&](int part) { done[part] = 1; });
        EXPECT_EQ(done, std::vector<int>(2, 1));
    }
}

TEST(Threads, areOnePerFiveThousandPointsUnlessAskedFor)
{
    EXPECT_EQ(threadsFor(0, 100), 1);
    EXPECT_LE(threadsFor(0, 10'000), 2);
    EXPECT_EQ(threadsFor(3, 100), 3);
}

// Merging where the tip has passed: fewer points, and no soil lost.
TEST(PassedPoints, areMergedAndTheirMassStays)
{
    Variant variant{"", false, 2, true, SolutionControls::PressureCoupling::explicitStep, 4};
    const State merged = skirtAfterSomeSteps(variant, 1);
    variant.passedPointsPerCell = 0;
    const State all = skirtAfterSomeSteps(variant, 1);
    EXPECT_LT(merged.points.size(), all.points.size());
    const auto sum = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    EXPECT_NEAR(sum(merged.points.mass), sum(all.points.mass), 1e-12 * sum(all.points.mass));
    const double force = all.reactions[0].force;
    EXPECT_NEAR(merged.reactions[0].force, force, 0.05 * std::abs(force));
    // Ahead of the tip nothing is merged.
    const double tip = merged.bodies[0].tipLevel - 0.3;
    const auto below = [tip](const State& state) {
        return std::ranges::count_if(state.points.z, [tip](double z) { return z < tip; });
    };
    EXPECT_EQ(below(merged), below(all));
}

} // namespace
} // namespace caisson::testing
