// The solver against exact answers: waves, elastic and plastic equilibrium, friction, large deformation.

#include "Verification.h"

namespace caisson::testing {
namespace {

/// Lines from 0 to `extent` in n parts, and two more behind.
std::vector<double> linesWithRoom(double extent, int n)
{
    std::vector<double> lines = evenLines(0, extent, n);
    lines.push_back(extent * (n + 1) / n);
    lines.push_back(extent * (n + 2) / n);
    return lines;
}

// ---------------------------------------------------------------------------------------------------------

constexpr double E = 1e8, nu = 0.3, density = 2000;

/// Suddenly applied gravity on an elastic column: rms error of the mean settlement over two periods, over the
/// largest settlement. Exact: the bar's modes, c^2 = M/rho.
double columnError(int n)
{
    const double length = 10, g = 0.0981, h = length / n;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 2 * h, 2), linesWithRoom(length, n), Geometry::planeStrain);
    const int solid = simulation.addMaterial("solid", elasticSolid(E, nu, density));
    simulation.scene.gravity = {0, -g};
    simulation.setConditions("left { type slip; } right { type slip; } top { type zeroGradient; } "
                             "bottom { type fixedValue; value uniform (0 0 0); }");
    simulation.fill(solid, 2, 2, [&](double, double z) { return z < length; });
    simulation.start();

    const double modulus = pWaveModulus(E, nu), c = std::sqrt(modulus / density);
    const double duration = 8 * length / c;
    const long steps = std::lround(duration / (0.25 * h / c));
    const MaterialPoints& points = simulation.state.points;
    double sum = 0, largest = 0;
    for (long i = 1; i <= steps; ++i) {
        simulation.step->advance(simulation.state, duration / static_cast<double>(steps));
        double exact = -density * g * length * length / (3 * modulus);
        for (int k = 0; k < 100; ++k) {
            const double wave = (2 * k + 1) * pi / (2 * length);
            exact += 2 * density * g / (modulus * std::pow(wave, 4) * length * length) *
                     std::cos(wave * c * simulation.state.time);
        }
        const double got = massMean(points, [&](std::size_t p) { return points.z[p] - points.initialZ[p]; });
        sum += std::pow(got - exact, 2);
        largest = std::max(largest, std::abs(exact));
    }
    return std::sqrt(sum / static_cast<double>(steps)) / largest;
}

TEST(Column, swingsUnderSuddenGravityAsTheExactBarDoes)
{
    const double coarse = columnError(20), fine = columnError(40);
    expectNear("column: mean settlement: error, n = 20", coarse, 0, 5e-3);
    expectNear("column: mean settlement: error, n = 40", fine, 0, 1.2e-3);
    expectOrder("column: mean settlement: order", coarse, fine, 1.7);
}

/// Roots of M x J0(x) = 2 mu J1(x), M and mu per unit of M: radial modes of a free disk in plane strain.
std::vector<double> diskModes(double shearShare, int count)
{
    const auto condition = [&](double x) {
        return x * std::cyl_bessel_j(0, x) - 2 * shearShare * std::cyl_bessel_j(1, x);
    };
    std::vector<double> roots;
    for (double x = 0.5; static_cast<int>(roots.size()) < count; x += 0.1) {
        if (condition(x) * condition(x + 0.1) > 0) {
            continue;
        }
        double low = x, high = x + 0.1;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (condition(low) * condition(middle) <= 0 ? high : low) = middle;
        }
        roots.push_back(0.5 * (low + high));
    }
    return roots;
}

/// Disk set off with v_r = V0 r/R: rms error of KE(t)/KE(0) over two periods of the first mode.
double diskError(int n)
{
    const double radius = 10, h = radius / n, v0 = 1e-3;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(linesWithRoom(radius, n), evenLines(0, 2 * h, 2), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("solid", elasticSolid(E, nu, density));
    simulation.setConditions("right { type zeroGradient; } bottom { type slip; } top { type slip; }");
    simulation.fill(solid, 2, 2, [&](double r, double) { return r < radius; });
    simulation.setVelocity([&](double r, double) { return std::array<double, 2>{v0 * r / radius, 0}; });
    simulation.start();

    const double modulus = pWaveModulus(E, nu), c = std::sqrt(modulus / density);
    const std::vector<double> modes = diskModes(shearModulus(E, nu) / modulus, 60);
    std::vector<double> share; // of KE(0) in each mode, from the integrals of x^2 J1(a x) and x J1(a x)^2
    for (const double a : modes) {
        const double j0 = std::cyl_bessel_j(0, a), j1 = std::cyl_bessel_j(1, a), j2 = 2 * j1 / a - j0;
        share.push_back(4 * std::pow(j2 / a, 2) / (0.5 * (j1 * j1 - j0 * j2)));
    }
    const double duration = 4 * pi * radius / (modes[0] * c);
    const long steps = std::lround(duration / (0.25 * h / c));
    const double start = sumEnergies(simulation.state).kinetic;
    double sum = 0;
    for (long i = 1; i <= steps; ++i) {
        simulation.step->advance(simulation.state, duration / static_cast<double>(steps));
        double exact = 0;
        for (std::size_t k = 0; k < modes.size(); ++k) {
            exact += share[k] * std::pow(std::cos(modes[k] * c * simulation.state.time / radius), 2);
        }
        sum += std::pow(sumEnergies(simulation.state).kinetic / start - exact, 2);
    }
    return std::sqrt(sum / static_cast<double>(steps));
}

TEST(Disk, swingsRadiallyAsTheExactModesDo)
{
    const double coarse = diskError(20), fine = diskError(40);
    expectNear("disk: KE(t)/KE(0): error, n = 20", coarse, 0, 5e-3);
    expectNear("disk: KE(t)/KE(0): error, n = 40", fine, 0, 1.5e-3);
    expectOrder("disk: KE(t)/KE(0): order", coarse, fine, 1.7);
}

// ---------------------------------------------------------------------------------------------------------

/// Thick cylinder a = 1, b = 2 under internal pressure, plane strain, brought to rest by local damping.
/// Exact [Lame 1852]: u = A r + B/r.
double cylinderError(int n)
{
    const double a = 1, b = 2, p = 1, young = 1e6, h = (b - a) / n; // strains of 1e-6
    Simulation simulation;
    simulation.state.mesh = structuredMesh(evenLines(a, b, n), evenLines(0, h, 1), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("solid", elasticSolid(young, nu, density));
    simulation.scene.controls.localDamping = 0.7;
    simulation.setConditions("left { type pressure; uniformValue 1; } right { type zeroGradient; } "
                             "bottom { type slip; } top { type slip; }");
    simulation.fill(solid, 2, 2);
    simulation.start();
    const double c = std::sqrt(pWaveModulus(young, nu) / density);
    simulation.run(60 * b / c, 0.8);

    const double pressure = p * a * a / (b * b - a * a);
    const MaterialPoints& points = simulation.state.points;
    return relativeError(
        points, [&](std::size_t i) { return points.r[i] - points.initialR[i]; },
        [&](std::size_t i) {
            const double r = points.initialR[i];
            return (1 + nu) / young * pressure * ((1 - 2 * nu) * r + b * b / r);
        });
}

TEST(ThickCylinder, expandsUnderPressureAsLameSays)
{
    const double coarse = cylinderError(8), fine = cylinderError(16);
    expectNear("thick cylinder: displacement: error, n = 8", coarse, 0, 4e-3);
    expectNear("thick cylinder: displacement: error, n = 16", fine, 0, 1e-3);
    expectOrder("thick cylinder: displacement: order", coarse, fine, 1.7);
}

/// A column that a traction compresses: uniform stress, linear displacement, both exact on any mesh.
TEST(Traction, compressesAColumnExactly)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        const double length = 2, load = 100, young = 1e8;
        Simulation simulation;
        simulation.state.mesh = structuredMesh(evenLines(0, 0.5, 2), evenLines(0, length, 8), geometry);
        const int solid = simulation.addMaterial("solid", elasticSolid(young, nu, density));
        simulation.scene.controls.localDamping = 0.7;
        simulation.setConditions("left { type slip; } right { type slip; } bottom { type slip; } "
                                 "top { type traction; uniformValue (0 0 -100); }");
        simulation.fill(solid, 2, 2);
        simulation.start();
        const double modulus = pWaveModulus(young, nu), c = std::sqrt(modulus / density);
        simulation.run(100 * length / c, 0.8);
        const MaterialPoints& points = simulation.state.points;
        for (std::size_t p = 0; p < points.size(); ++p) {
            EXPECT_NEAR(points.stress[1][p] / load, -1, 1e-5);
            EXPECT_NEAR(points.stress[0][p] / load, -nu / (1 - nu), 1e-5);
            const double exact = -load / modulus * points.initialZ[p];
            EXPECT_NEAR((points.z[p] - points.initialZ[p]) / exact, 1, 1e-5);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------

/// V18: bar in its first mode, v = v0 sin(b1 z) cos(w1 t); error of the velocity of the centre of mass over
/// two periods, and drift of the energy over ten.
void swingBar(double v0, int rows, double tolerance, double energyTolerance)
{
    const double length = 25, young = 100, rho = 1;
    Simulation simulation;
    simulation.state.mesh = structuredMesh(evenLines(0, 1, 1), evenLines(0, 28, 28), Geometry::planeStrain);
    const int solid = simulation.addMaterial("bar", elasticSolid(young, 0, rho));
    simulation.setConditions(
        "left { type slip; } right { type slip; } bottom { type slip; } top { type zeroGradient; }");
    simulation.fill(solid, 2, rows, [&](double, double z) { return z < length; });
    const double wave = pi / (2 * length), frequency = wave * std::sqrt(young / rho);
    simulation.setVelocity([&](double, double z) {
        return std::array<double, 2>{0, v0 * std::sin(wave * z)};
    });
    simulation.start();
    const MaterialPoints& points = simulation.state.points;
    const double period = 2 * pi / frequency;
    double error = 0, norm = 0, first = 0, last = 0; // energies: means over the first and the last period
    for (int i = 1; i <= 1000; ++i) {
        simulation.run(0.01 * i * period, 0.5);
        if (i <= 200) {
            const double got = massMean(points, [&](std::size_t p) { return points.vz[p]; });
            const double exact = v0 / (wave * length) * std::cos(frequency * simulation.state.time);
            error += std::pow(got - exact, 2);
            norm += exact * exact;
        }
        double energy = sumEnergies(simulation.state).kinetic;
        for (std::size_t p = 0; p < points.size(); ++p) { // work of sigma = E ln(stretch)
            const double e = points.stress[1][p] / young;
            energy += points.volume[p] * young * (e - 1 + std::exp(-e));
        }
        first += i <= 100 ? energy / 100 : 0;
        last += i > 900 ? energy / 100 : 0;
    }
    expectNear("bar: error of the velocity of the centre of mass", std::sqrt(error / norm), 0, tolerance);
    expectNear("bar: drift of the energy over ten periods", last / first - 1, 0, energyTolerance);
}

TEST(Bar, swingsWithoutCrossingsAsTheExactOne) { swingBar(0.1, 2, 0.01, 0.01); }

// A filled cell counts whole however many points it holds at the moment, so points that cross lines of the
// mesh change the energy: by 3.2 % in ten periods with two rows in a cell, 1.4 % with four, 0.2 % with six,
// whatever the time step. Wanted is 1 %. (Integrated at the points it falls by 62 %.)
TEST(Bar, swingsThroughCellsAsTheExactOne) { swingBar(0.75, 6, 0.05, 0.01); }
TEST(Bar, swingsThroughCellsOfTwoRowsOfPointsWithinAFewPercent) { swingBar(0.75, 2, 0.05, 0.04); }

// ---------------------------------------------------------------------------------------------------------

/// V15: block on an incline of 30 degrees, in axes along and across it. Rigid ground below a line of the
/// mesh.
void putBlockOnIncline(Simulation& simulation, double friction)
{
    const double slope = pi / 6, g = 9.81, height = 0.5;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 5, 40), evenLines(-0.25, 1, 10), Geometry::planeStrain);
    const int solid = simulation.addMaterial("block", elasticSolid(1e7, 0.3, density));
    simulation.scene.gravity = {g * std::sin(slope), -g * std::cos(slope)};
    simulation.setConditions("left { type zeroGradient; } right { type zeroGradient; } "
                             "bottom { type zeroGradient; } top { type zeroGradient; }");
    RigidBody ground;
    ground.name = "ground";
    ground.profile = profileFromPolygon({{-1, -1}, {6, -1}, {6, 0}, {-1, 0}});
    ground.tipLevel = ground.initialTipLevel = -1;
    ground.friction = friction;
    simulation.state.bodies.push_back(ground);
    simulation.fill(solid, 2, 2, [&](double x, double z) { return x > 1 && x < 3 && z > 0 && z < height; });
    simulation.setStress([&](double, double z) {
        return std::array<double, 4>{0, density * g * std::cos(slope) * (z - height), 0, 0};
    });
    simulation.start();
}

double slideOfBlock(const Simulation& simulation)
{
    const MaterialPoints& points = simulation.state.points;
    return massMean(points, [&](std::size_t p) { return points.r[p] - points.initialR[p]; });
}

TEST(BlockOnIncline, slidesWithTheExactAcceleration)
{
    Simulation simulation;
    putBlockOnIncline(simulation, 0.3);
    const MaterialPoints& points = simulation.state.points;
    const auto velocity = [&] { return massMean(points, [&](std::size_t p) { return points.vr[p]; }); };
    simulation.run(0.4, 0.5); // the sudden load makes the block swing at first
    const double before = velocity();
    simulation.run(1.0, 0.5);
    const double acceleration = (velocity() - before) / 0.6;
    const double exact = 9.81 * (std::sin(pi / 6) - 0.3 * std::cos(pi / 6));
    expectNear("block on incline: acceleration [m/s2]", acceleration, exact, 5e-3 * exact);
}

TEST(BlockOnIncline, sticksWhereFrictionHoldsIt)
{
    Simulation simulation;
    putBlockOnIncline(simulation, 0.7);
    simulation.scene.controls.picTime = 0.01; // the swing would lift and shift the block
    simulation.run(0.4, 0.5);
    const double early = slideOfBlock(simulation);
    simulation.run(0.8, 0.5);
    const double drift = slideOfBlock(simulation) - early;
    expectNear("block on incline: drift while it sticks [m]", drift, 0, 1e-5);
}

// ---------------------------------------------------------------------------------------------------------

/// V16: a rod pulled out of an elastic annulus a < r < b that presses on it with p. Exact far from the ends:
/// u_z = (tau a/G) ln(b/r), tau = mu p where it slips, G U/(a ln(b/a)) where it sticks.
struct PullOut
{
    double shear;        ///< mean of tau along the rod over mu p
    double profileError; ///< of u_z at half height
};

PullOut pullOut(double displacement, int n)
{
    const double a = 0.5, b = 1, height = 8, p = 1e3, young = 1e7, mu = 0.3;
    Simulation simulation;
    simulation.state.mesh =
        structuredMesh(evenLines(0, b, 2 * n), evenLines(0, height, 8 * n), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("soil", elasticSolid(young, 0.25, density));
    simulation.setConditions("right { type fixedValue; value uniform (0 0 0); } "
                             "bottom { type slip; } top { type slip; }");
    const double G = shearModulus(young, 0.25), c = std::sqrt(pWaveModulus(young, 0.25) / density);
    const double slipAt = mu * p * a * std::log(b / a) / G, duration = 30 * height / c;
    RigidBody rod;
    rod.name = "rod";
    rod.profile = profileFromPolygon({{0, 0}, {a, 0}, {a, height + 2}, {0, height + 2}});
    rod.tipLevel = rod.initialTipLevel = -1;
    rod.friction = mu;
    rod.penetrationRate =
        std::shared_ptr<const Function1>(constantFunction1(-displacement * slipAt / duration));
    rod.ramp = 0.5 * duration;
    simulation.state.bodies.push_back(rod);
    // No local damping: it would take its share of the forces that the rod is about to carry.
    simulation.fill(solid, 2, 2, [&](double r, double) { return r > a; });
    simulation.setStress([&](double, double) { return std::array<double, 4>{-p, -p, -p, 0}; });
    simulation.start();
    simulation.run(0.9 * duration, 0.8);
    simulation.state.reactions[0].restartCollection();
    simulation.run(duration, 0.8);

    const BodyReaction& reaction = simulation.state.reactions[0];
    PullOut result{};
    // The rollers at the ends hold the last nodes, which stand for half a cell each.
    result.shear = -reaction.verticalImpulse[static_cast<int>(SurfacePart::outer)] / reaction.duration /
                   (mu * p * a * height * (1 - 1.0 / (8 * n)));
    const double rise = simulation.state.bodies[0].tipLevel + 1;
    const double tau = std::min(mu * p, G * rise / (a * std::log(b / a)));
    const MaterialPoints& points = simulation.state.points;
    double error = 0, norm = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::abs(points.initialZ[i] - 0.5 * height) < height / (8 * n)) {
            const double exact = tau * a / G * std::log(b / points.initialR[i]);
            error += points.volume[i] * std::pow(points.z[i] - points.initialZ[i] - exact, 2);
            norm += points.volume[i] * std::pow(exact, 2);
        }
    }
    result.profileError = std::sqrt(error / norm);
    return result;
}

TEST(PullOut, slipsAtTheFrictionOfTheRadialStress)
{
    const PullOut slip = pullOut(2, 8);
    expectNear("pull-out, slip: tau/(mu p)", slip.shear, 1, 1e-2);
    expectNear("pull-out, slip: error of the displacement", slip.profileError, 0, 1e-2);
}

TEST(PullOut, carriesTheElasticShearBeforeSlip)
{
    const PullOut stick = pullOut(0.5, 8);
    expectNear("pull-out, stick: error of the displacement", stick.profileError, 0, 1e-2);
}

// ---------------------------------------------------------------------------------------------------------

/// V13, V17: a smooth rigid punch of radius or half width 1 m pressed into weightless clay [Tresca].
/// @return mean pressure over undrained shear strength between 2 and 3 % of settlement, n cells below it
double punchCapacity(Geometry geometry, int n)
{
    const double strength = 1e3, width = geometry == Geometry::axisymmetric ? 3 : 4;
    Simulation simulation;
    simulation.state.mesh = structuredMesh(evenLines(0, width, static_cast<int>(width) * n),
                                           evenLines(-2, 0.25, 9 * n / 4), geometry);
    const int clay = simulation.addMaterial(
        "clay", "law tresca; porosity 0.2; solidDensity 2500; weight dry; youngsModulus 1e6; "
                "poissonsRatio 0.45; undrainedShearStrength 1e3;");
    simulation.setConditions(std::string(geometry == Geometry::planeStrain ? "left { type slip; } " : "") +
                             "right { type slip; } bottom { type fixedValue; value uniform (0 0 0); } "
                             "top { type zeroGradient; }");
    RigidBody punch;
    punch.name = "punch";
    punch.profile = profileFromPolygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    punch.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(0.005));
    punch.ramp = 1;
    simulation.state.bodies.push_back(punch);
    simulation.scene.motion = MeshMotion({-2, -1, 0, 0.25}, "punch");
    simulation.scene.movingBody = 0;
    simulation.fill(clay, 2, 2, [](double, double z) { return z < 0; });
    simulation.start();
    const auto runTo = [&](double settlement) {
        simulation.run(0.5 + settlement / 0.005, 0.8); // half of the ramp is lost
    };
    runTo(0.02);
    simulation.state.reactions[0].restartCollection();
    runTo(0.03);
    const BodyReaction& reaction = simulation.state.reactions[0];
    const double area = geometry == Geometry::axisymmetric ? 0.5 : 1; // per radian or per metre
    return reaction.verticalImpulse[static_cast<int>(SurfacePart::tip)] / reaction.duration / area / strength;
}

// At eight cells; tutorials/verification/footing and strip have finer ones, within 4 %.
TEST(Punch, circularReachesTheBearingCapacityOfClay)
{
    expectNear("smooth circular punch: q/s_u", punchCapacity(Geometry::axisymmetric, 8), 5.6893,
               0.1 * 5.6893);
}

TEST(Punch, stripReachesTheBearingCapacityOfClay)
{
    expectNear("smooth strip punch: q/s_u", punchCapacity(Geometry::planeStrain, 8), 2 + pi, 0.04 * (2 + pi));
}

// ---------------------------------------------------------------------------------------------------------

/// V24: drained triaxial compression of one cell between a base and a smooth platen. Exact at failure:
/// sigma_1/sigma_3 = (1 + sin phi)/(1 - sin phi), d eps_v/d eps_1 = -2 sin psi/(1 - sin psi).
TEST(Triaxial, failsAtTheExactStressRatioAndDilates)
{
    const double confinement = 1e5;
    Simulation simulation;
    simulation.state.mesh = structuredMesh({0, 1}, {0, 1, 1.5}, Geometry::axisymmetric);
    // The cell pressure acts on the specimen alone, not on the edge beside the platen.
    BoundaryPatch& side = simulation.state.mesh.patches[1];
    ASSERT_EQ(side.name, "right");
    std::erase_if(side.edges, [&](const BoundaryEdge& edge) {
        return simulation.state.mesh.z[edge.node[0]] + simulation.state.mesh.z[edge.node[1]] > 2;
    });
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; weight dry; youngsModulus 60e6; "
                "poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 1; cohesion 0;");
    simulation.setConditions("left { type slip; } right { type pressure; uniformValue 1e5; } "
                             "bottom { type slip; } top { type zeroGradient; }");
    RigidBody platen;
    platen.name = "platen";
    platen.profile = profileFromPolygon({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
    platen.tipLevel = platen.initialTipLevel = 1;
    platen.tipCorner = TipCorner::full;
    platen.penetrationRate = std::shared_ptr<const Function1>(constantFunction1(0.05));
    platen.ramp = 0.1;
    simulation.state.bodies.push_back(platen);
    simulation.scene.motion = MeshMotion({0, 0.999, 1.2, 1.5}, "platen");
    simulation.scene.movingBody = 0;
    simulation.scene.controls.localDamping = 0.5;
    simulation.fill(sand, 2, 2, [](double, double z) { return z < 1; });
    simulation.setStress([&](double, double) {
        return std::array<double, 4>{-confinement, -confinement, -confinement, 0};
    });
    simulation.start();
    const MaterialPoints& points = simulation.state.points;
    const auto volume = [&] {
        double sum = 0;
        for (const double v : points.volume) {
            sum += v;
        }
        return std::log(sum);
    };
    simulation.run(0.5, 0.5);
    const double before = volume(), heightBefore = std::log(simulation.state.bodies[0].tipLevel);
    simulation.run(1.0, 0.5);
    const double dilatation = volume() - before;
    const double compression = heightBefore - std::log(simulation.state.bodies[0].tipLevel);
    const double sinPhi = std::sin(38 * pi / 180), sinPsi = std::sin(pi / 180);
    const double rate = -dilatation / compression, exactRate = -2 * sinPsi / (1 - sinPsi);
    expectNear("triaxial: d eps_v/d eps_1", rate, exactRate, 0.01 * std::abs(exactRate));
    for (std::size_t p = 0; p < points.size(); ++p) {
        const std::string at = "triaxial, point " + std::to_string(p);
        const double ratio = points.stress[1][p] / points.stress[0][p];
        expectNear((at + ": sigma_1/sigma_3").c_str(), ratio, (1 + sinPhi) / (1 - sinPhi), 1e-6);
        expectNear((at + ": radial stress [Pa]").c_str(), points.stress[0][p], -confinement,
                   1e-3 * confinement);
        expectNear((at + ": hoop over radial stress").c_str(), points.stress[2][p] / points.stress[0][p], 1,
                   1e-6);
    }
}

} // namespace
} // namespace caisson::testing
