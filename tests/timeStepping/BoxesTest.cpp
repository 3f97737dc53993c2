// Steps of points with boxes: GIMP and quadratic B-splines.

#include "Verification.h"

#include <vector>

namespace caisson::testing {
namespace {

struct Variant
{
    const char* name;
    double width;
};

class EveryBox : public ::testing::TestWithParam<Variant>
{
};
INSTANTIATE_TEST_SUITE_P(, EveryBox, ::testing::Values(Variant{"gimp", 0.5}, Variant{"bSplines", 1}),
                         [](const auto& variant) { return variant.param.name; });

constexpr double E = 1e6, nu = 0, rho = 2000;

/// A bar of 20 cells, between walls that let it slide.
Simulation bar(double width, int threads = 1, double left = 2)
{
    Simulation simulation;
    simulation.state.mesh = structuredMesh(evenLines(0, 30, 30), evenLines(0, 2, 2), Geometry::planeStrain);
    simulation.scene.controls.boxWidth = width;
    simulation.scene.controls.threads = threads;
    const int soil = simulation.addMaterial("soil", elasticSolid(E, nu, rho));
    simulation.setConditions("\".*\" { type slip; }");
    simulation.fill(soil, 2, 2, [=](double r, double) { return r > left && r < left + 20; });
    return simulation;
}

TEST_P(EveryBox, keepsMassAndMomentumOfABarThatFlies)
{
    Simulation simulation = bar(GetParam().width);
    simulation.setVelocity([](double r, double) { return std::array<double, 2>{1 + 0.2 * std::sin(r), 0}; });
    simulation.start();
    const Energies before = sumEnergies(simulation.state);
    simulation.run(5, 0.5);
    const Energies after = sumEnergies(simulation.state);
    expectNear("momentum over the first", after.momentum[0] / before.momentum[0], 1, 1e-12);
    expectNear("mass over the first", after.mass / before.mass, 1, 1e-14);
}

// A bar that is squeezed evenly has one stress until the wave from its free end comes by. With linear shape
// functions the force of a point jumps where it crosses a line.
TEST_P(EveryBox, takesTheNoiseOfCrossedLinesFromASqueezedBar)
{
    const auto noise = [](double width) {
        Simulation simulation = bar(width, 1, 0);
        simulation.scene.controls.integration = SolutionControls::Integration::points;
        simulation.setVelocity([](double r, double) { return std::array<double, 2>{-0.1 * r, 0}; });
        simulation.start();
        simulation.run(0.5, 0.5);
        const MaterialPoints& points = simulation.state.points;
        const auto inner = [&](std::size_t p) { return points.r[p] < 8; };
        const double mean = massMean(points, [&](std::size_t p) { return inner(p) * points.stress[0][p]; }) /
                            massMean(points, [&](std::size_t p) { return inner(p) * 1.0; });
        return std::sqrt(massMean(
            points, [&](std::size_t p) { return inner(p) * std::pow(points.stress[0][p] / mean - 1, 2); }));
    };
    const double linear = noise(0);
    const double boxes = noise(GetParam().width);
    std::printf("deviation of the stress from its mean: linear %.4f, %s %.4f\n", linear, GetParam().name,
                boxes);
    EXPECT_LT(boxes, 0.3 * linear);
}

TEST_P(EveryBox, hasTheSameBitsForAnyNumberOfThreads)
{
    std::array<std::vector<double>, 2> places;
    for (const int threads : {1, 2}) {
        Simulation simulation = bar(GetParam().width, threads);
        simulation.setVelocity([](double r, double z) {
            return std::array<double, 2>{std::sin(r), 0.1 * z};
        });
        simulation.start();
        simulation.run(1, 0.5);
        places[threads - 1] = simulation.state.points.r;
    }
    EXPECT_EQ(places[0], places[1]);
}

// A zone of boxes in a mesh of linear shape functions: what flies through both keeps its momentum.
TEST_P(EveryBox, mayFillAZoneAlone)
{
    Simulation simulation = bar(GetParam().width);
    std::vector<int>& zone = simulation.state.mesh.cellZones["smooth"];
    for (int c = 0; c < simulation.state.mesh.cells(); ++c) {
        if (simulation.state.mesh.r[simulation.state.mesh.node(c, 0)] < 12) {
            zone.push_back(c);
        }
    }
    simulation.scene.controls.boxZone = "smooth";
    simulation.setVelocity([](double r, double) { return std::array<double, 2>{1 + 0.2 * std::sin(r), 0}; });
    simulation.start();
    const Energies before = sumEnergies(simulation.state);
    simulation.run(5, 0.5);
    const Energies after = sumEnergies(simulation.state);
    expectNear("momentum over the first", after.momentum[0] / before.momentum[0], 1, 1e-3);
    EXPECT_NE(simulation.step->description().find("boxes of"), std::string::npos);
}

} // namespace
} // namespace caisson::testing
