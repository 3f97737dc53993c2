// Body forces given by expressions: what they do to a body, when, and on how many threads.

#include "Verification.h"

#include <algorithm>

namespace caisson::testing {
namespace {

PointVector bodyForce(const std::string& text)
{
    InputProblems problems;
    const Dictionary dictionary = parseDictionary(text, "bodyForce");
    const std::vector<Keyword> keywords = pointVectorKeywords();
    const KeywordReader reader(dictionary, keywords, "bodyForce", problems);
    PointVector vector = readPointVector(reader, "bodyForce");
    problems.throwIfAny("test body force");
    return vector;
}

/// A column that stands on rollers, 1 m wide and 2 m high, with room above.
void makeColumn(Simulation& simulation)
{
    simulation.state.mesh = structuredMesh(evenLines(0, 1, 4), evenLines(0, 2.5, 10), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("solid", elasticSolid(1e6, 0.3, 2000));
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    simulation.fill(solid, 2, 2, [](double, double z) { return z < 2; });
}

/// A free block in plane strain with room to move.
void makeBlock(Simulation& simulation, const std::string& force)
{
    simulation.state.mesh = structuredMesh(evenLines(-2, 2, 16), evenLines(-2, 2, 16), Geometry::planeStrain);
    const int solid = simulation.addMaterial("solid", elasticSolid(1e6, 0.3, 2000));
    simulation.setConditions("\".*\" { type zeroGradient; }");
    simulation.fill(solid, 2, 2, [](double x, double z) { return std::abs(x) < 0.5 && std::abs(z) < 0.5; });
    simulation.scene.bodyForce = bodyForce(force);
}

TEST(BodyForce, constantIsGravity)
{
    Simulation gravity, force;
    makeColumn(gravity);
    gravity.scene.gravity = {0, -9.81};
    makeColumn(force);
    force.scene.bodyForce = bodyForce("r 0; z -9.81;");
    double largest = 0;
    for (Simulation* simulation : {&gravity, &force}) {
        simulation->start();
        simulation->run(0.05, 0.4);
    }
    for (std::size_t p = 0; p < gravity.state.points.size(); ++p) {
        largest = std::max(largest, std::abs(gravity.state.points.z[p] - force.state.points.z[p]));
    }
    // Filled cells at rest know the slope of stress that gravity makes (doc/theory/onePhase.md): the two
    // differ by what this changes in a settlement of 6 mm.
    expectNear("column: largest difference of the places [m]", largest, 0, 1e-4);
}

TEST(BodyForce, actsOnTheWholeMassOfTheBody)
{
    Simulation simulation;
    makeBlock(simulation, "r 3; z \"-2\";");
    simulation.start();
    const double dt = 1e-4;
    simulation.step->advance(simulation.state, dt);
    const auto momentum = sumEnergies(simulation.state).momentum;
    expectNear("block of 2000 kg/m: force along x [N/m]", momentum[0] / dt, 6000, 1e-8);
    expectNear("block of 2000 kg/m: force along z [N/m]", momentum[1] / dt, -4000, 1e-8);
}

/// Error of a block's displacement at 0.5 s: the force is a spring that pulls every point alike, and one of
/// time, u'' = -(4 u) + 5 cos 3t: u = sin(2t)/2 - cos 3t + cos 2t.
double swayError(int steps)
{
    Simulation simulation;
    makeBlock(simulation, "r \"-4*(r - R) + 5*cos(3*t)\"; z 0;");
    simulation.setVelocity([](double, double) { return std::array<double, 2>{1, 0}; });
    simulation.start();
    for (int i = 0; i < steps; ++i) {
        simulation.step->advance(simulation.state, 0.5 / steps);
    }
    const double exact = 0.5 * std::sin(1.0) - std::cos(1.5) + std::cos(1.0);
    const MaterialPoints& points = simulation.state.points;
    return std::abs(massMean(points, [&](std::size_t p) { return points.r[p] - points.initialR[p]; }) -
                    exact);
}

TEST(BodyForce, isOfSecondOrderInTime)
{
    expectOrder("block on a spring: order in time", swayError(200), swayError(400), 1.9);
}

TEST(BodyForce, givesTheSameBitsForAnyNumberOfThreads)
{
    std::vector<std::vector<double>> places;
    for (const int threads : {1, 2}) {
        Simulation simulation;
        simulation.scene.controls.threads = threads;
        makeColumn(simulation);
        simulation.scene.bodyForce = bodyForce("r \"sin(7*Z)*R + 0.1*z\"; z \"-3*cos(40*t) - r*R\";");
        simulation.start();
        simulation.run(0.05, 0.4);
        std::vector<double> byId(simulation.state.points.size());
        for (std::size_t p = 0; p < byId.size(); ++p) {
            byId[simulation.state.points.id[p]] = simulation.state.points.z[p];
        }
        places.push_back(byId);
    }
    EXPECT_EQ(places[0], places[1]);
}

TEST(BodyForce, keepsFemCellsOut)
{
    for (const bool forced : {false, true}) {
        Simulation simulation;
        simulation.scene.controls.femCells = SolutionControls::FemCells::automatic;
        simulation.scene.controls.femDistance = 1;
        makeColumn(simulation);
        if (forced) {
            simulation.scene.bodyForce = bodyForce("r 0; z \"-R\";");
        }
        simulation.start();
        const int cells = simulation.step->cellCounts(simulation.state).fem;
        EXPECT_EQ(cells > 0, !forced) << cells << " FEM cells";
    }
}

} // namespace
} // namespace caisson::testing
