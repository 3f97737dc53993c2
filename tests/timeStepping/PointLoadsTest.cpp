// Loads on material points: their forces, the settlement that they cause, and that a restart keeps them.

#include "Verification.h"
#include "materialPoints/CloudConversion.h"

namespace caisson::testing {
namespace {

std::vector<PointLoad> loadsOf(const std::string& dictionary, Geometry geometry)
{
    InputProblems problems;
    auto loads = readPointLoads(parseDictionary(dictionary, "pointLoads"), geometry, problems);
    problems.throwIfAny("test loads");
    return loads;
}

/// Loads the points of the surface of all soil that looks to the face.
void loadFace(Simulation& simulation, LoadedSurface::Face face)
{
    LoadedSurface surface;
    surface.region.type = "all";
    surface.face = face;
    InputProblems problems;
    loadPoints(simulation.state.points, simulation.state.mesh, {surface}, problems);
    problems.throwIfAny("test surface");
}

/// A block in the middle of its mesh, free on all sides.
void makeFreeBlock(Simulation& simulation, Geometry geometry, bool triangles)
{
    simulation.state.mesh = structuredMesh({0, 0.5, 1, 1.6, 2, 3}, {-1, 0, 0.5, 1, 2}, geometry, triangles);
    const int solid = simulation.addMaterial("solid", elasticSolid(1e6, 0.3, 2000));
    simulation.setConditions(
        std::string(geometry == Geometry::planeStrain ? "left { type zeroGradient; } " : "") +
        "right { type zeroGradient; } bottom { type zeroGradient; } top { type zeroGradient; }");
    simulation.fill(solid, triangles ? 3 : 2, 2,
                    [](double r, double z) { return r > 0.5 && r < 2 && z > 0 && z < 1; });
}

TEST(PointLoads, giveTheSoilTheMomentumOfTheirTotalForce)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        for (const bool triangles : {false, true}) {
            Simulation simulation;
            makeFreeBlock(simulation, geometry, triangles);
            simulation.scene.pointLoads = loadsOf("pull { type force; uniformValue (3 0 -1000); }", geometry);
            loadFace(simulation, LoadedSurface::Face::top);
            simulation.start();
            const double dt = 1e-4;
            simulation.step->advance(simulation.state, dt);
            const double round = geometry == Geometry::axisymmetric ? 2 * pi : 1;
            const auto momentum = sumEnergies(simulation.state).momentum;
            const std::string name =
                std::string(geometry == Geometry::axisymmetric ? "axisymmetric" : "plane") +
                (triangles ? " triangles" : " quadrilaterals");
            expectNear((name + ": force along r [N]").c_str(), round * momentum[0] / dt, 3, 1e-9);
            expectNear((name + ": force along z [N]").c_str(), round * momentum[1] / dt, -1000, 1e-9);
        }
    }
}

/// An annulus inside which a pressure of 50 Pa has expanded a cylindrical cavity from 1 to 2 m of radius, in
/// one step from rest; its soil has `volumeRatio` times the volume that it had.
void pressOnAnExpandedCavity(Simulation& simulation, bool follows, int cells, double volumeRatio,
                             bool triangles)
{
    const double first = 1, now = 2;
    std::vector<double> lines = evenLines(now, now + 1, cells);
    lines.insert(lines.begin(), {0, first});
    lines.push_back(now + 2);
    simulation.state.mesh = structuredMesh(lines, {0, 0.5}, Geometry::axisymmetric, triangles);
    const int solid = simulation.addMaterial("solid", elasticSolid(1e6, 0.3, 2000));
    simulation.setConditions(
        "right { type zeroGradient; } bottom { type slip; } top { type slip; } left { type zeroGradient; }");
    simulation.fill(solid, triangles ? 3 : 2, 2, [&](double r, double) { return r > now && r < now + 1; });
    simulation.scene.pointLoads =
        loadsOf(std::string("push { type pressure; direction (1 0 0); uniformValue 50; areaFollows ") +
                    (follows ? "yes; }" : "no; }"),
                Geometry::axisymmetric);
    loadFace(simulation, LoadedSurface::Face::inner);
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        points.initialR[p] = std::sqrt(first * first + (points.r[p] * points.r[p] - now * now) / volumeRatio);
        points.mass[p] /= volumeRatio;
        points.loadArea[p] *= first / now;
        points.loadReachR[p] = points.load[p] >= 0 ? first - points.initialR[p] : 0;
    }
    simulation.start();
    simulation.step->advance(simulation.state, 1e-4);
}

TEST(PointLoads, pressOnTheWholeWallOfACavityWhereTheAreaFollows)
{
    for (const bool follows : {false, true}) {
        for (const bool triangles : {false, true}) {
            for (const double volumeRatio : {1.0, 1.2}) {
                for (const int cells : {1, 2, 8}) {
                    Simulation simulation;
                    pressOnAnExpandedCavity(simulation, follows, cells, volumeRatio, triangles);
                    const std::string name = std::string(follows ? "following" : "not following") +
                                             (triangles ? ", triangles" : "") + ", volume ratio " +
                                             std::to_string(volumeRatio) + ", " + std::to_string(cells) +
                                             " cells: force [N/rad]";
                    expectNear(name.c_str(), sumEnergies(simulation.state).momentum[0] / 1e-4,
                               50 * 0.5 * (follows ? 2 : 1), 1e-9);
                }
            }
        }
    }
}

TEST(PointLoads, actOnTheWallOfACavityThatHasExpanded)
{
    for (const double volumeRatio : {1.0, 1.2}) {
        Simulation simulation;
        pressOnAnExpandedCavity(simulation, true, 1, volumeRatio, false);
        const MaterialPoints& points = simulation.state.points;
        for (std::size_t p = 0; p < points.size(); ++p) {
            // The nodes on the wall alone are pushed, and the shape functions carry that to the points.
            EXPECT_NEAR(points.vr[p] / points.vr[0], (3 - points.r[p]) / (3 - points.r[0]), 1e-9);
        }
    }
}

/// Mean settlement [m] of a column that is loaded on its patch or on its topmost points, at rest.
double settlement(bool byPoints, std::vector<double>& verticalStress)
{
    const double length = 2, load = 100, young = 1e8, nu = 0.3;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 0.5, 2), evenLines(0, length, 16), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("solid", elasticSolid(young, nu, 2000));
    simulation.scene.controls.localDamping = 0.7;
    simulation.setConditions(
        std::string("right { type slip; } bottom { type slip; } top { ") +
        (byPoints ? "type zeroGradient; }" : "type traction; uniformValue (0 0 -100); }"));
    simulation.fill(solid, 2, 2);
    if (byPoints) {
        simulation.scene.pointLoads =
            loadsOf("load { type traction; uniformValue (0 0 -100); }", Geometry::axisymmetric);
        loadFace(simulation, LoadedSurface::Face::top);
    }
    simulation.start();
    const double modulus = pWaveModulus(young, nu), c = std::sqrt(modulus / 2000);
    simulation.run(150 * length / c, 0.8);
    const MaterialPoints& points = simulation.state.points;
    verticalStress.clear();
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points.initialZ[p] < length - length / 16) {
            verticalStress.push_back(points.stress[1][p] / load);
        }
    }
    return massMean(points, [&](std::size_t p) { return points.initialZ[p] - points.z[p]; });
}

TEST(PointLoads, settleAColumnAsTheTractionOfThePatchDoes)
{
    std::vector<double> stress;
    const double patch = settlement(false, stress);
    const double points = settlement(true, stress);
    // The force acts at the surface, a quarter of a cell above the topmost points.
    expectNear("settlement: points over patch", points / patch, 1, 1e-5);
    for (const double s : stress) {
        EXPECT_NEAR(s, -1, 1e-5);
    }
}

TEST(PointLoads, areKeptByARestart)
{
    const auto start = [](Simulation& simulation) {
        makeFreeBlock(simulation, Geometry::axisymmetric, false);
        simulation.scene.pointLoads = loadsOf(
            "push { type pressure; direction (1 0 0); uniformValue table ((0 0) (1 1e4)); areaFollows yes; }",
            Geometry::axisymmetric);
    };
    Simulation whole;
    start(whole);
    loadFace(whole, LoadedSurface::Face::inner);
    whole.start();
    const auto steps = [](Simulation& simulation) {
        for (int i = 0; i < 70; ++i) {
            simulation.step->advance(simulation.state, 1e-3);
        }
    };
    steps(whole);
    whole.step->rebuild(whole.state);
    Simulation restarted;
    start(restarted);
    const std::vector<std::string> names(whole.state.points.state.size());
    restarted.state.points = materialPoints(cloud(whole.state.points, names), names);
    restarted.state.filled = whole.state.filled;
    restarted.state.time = whole.state.time;
    restarted.state.step = whole.state.step;
    restarted.start();
    steps(whole);
    steps(restarted);
    EXPECT_GT(whole.state.points.vr[0], 0);
    EXPECT_EQ(restarted.state.points.r, whole.state.points.r);
    EXPECT_EQ(restarted.state.points.stress, whole.state.points.stress);
}

} // namespace
} // namespace caisson::testing
