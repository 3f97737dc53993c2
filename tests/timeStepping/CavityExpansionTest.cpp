// Large expansion of a cylindrical cavity in Mohr-Coulomb soil, driven by a pressure on the innermost points.

#include "Verification.h"

namespace caisson::testing {
namespace {

/// Cylindrical cavity expanded from a0 to a in an infinite medium at rest under p0 [Yu & Houlsby 1991].
struct Cavity
{
    double young, nu, phi, psi, p0; ///< Pa, -, rad, rad, Pa; no cohesion

    /// a/a0 under the pressure p [Pa] > yield.
    [[nodiscard]] double expansion(double p) const
    {
        const double m = 1; // a sphere: 2
        const double alpha = (1 + std::sin(phi)) / (1 - std::sin(phi));
        const double beta = (1 + std::sin(psi)) / (1 - std::sin(psi));
        const double G = shearModulus(young, nu);
        const double gamma = alpha * (beta + m) / (m * (alpha - 1) * beta);
        const double delta = (alpha - 1) * p0 / (2 * (m + alpha) * G);
        const double R = (m + alpha) * p / (alpha * (1 + m) * p0);
        const double eta = std::exp((beta + m) * (1 - 2 * nu) * (1 + (2 - m) * nu) * p0 / (young * beta));
        const double xi =
            (1 - nu * nu * (2 - m)) * (1 + m) * delta / ((1 + nu) * (alpha - 1) * beta) *
            (alpha * beta + m * (1 - 2 * nu) + 2 * nu - m * nu * (alpha + beta) / (1 - nu * (2 - m)));
        double series = 0, factor = 1;
        for (int n = 0; n < 30; ++n) {
            series += factor * (std::pow(R, n - gamma) - 1) / (n - gamma);
            factor *= xi / (n + 1);
        }
        const double bracket = std::pow(1 - delta, (beta + m) / beta) - gamma / eta * series;
        return std::pow(std::pow(R, -gamma) / bracket, beta / (beta + m));
    }

    /// Pressure [Pa] at 1.01 <= a/a0 <= 3, by bisection.
    [[nodiscard]] double pressure(double ratio) const
    {
        double low = p0 * (1 + std::sin(phi)); // yield
        double high = 17.5 * p0;               // a/a0 of sandCavity is 3.03
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (expansion(middle) < ratio ? low : high) = middle;
        }
        return low;
    }
};

constexpr Cavity sandCavity{60e6, 0.25, 38 * pi / 180, pi / 180, 50e3};

TEST(Cavity, exactSolutionAgreesWithItsOwnIntegration)
{
    // p/p0 from an integration of the equations in logarithmic strain
    for (const auto& [ratio, pressure] : {std::pair{1.05, 7.3924}, {1.2, 11.5762}, {2.0, 16.3417}}) {
        expectNear("cavity: p/p0 of the exact solution", sandCavity.pressure(ratio) / sandCavity.p0, pressure,
                   1e-4);
    }
}

TEST(Cavity, expandsUnderThePressureOfTheExactSolution)
{
    const double fine = 2.5, outer = 45, ring = 2, h = 0.1; // radii [m] in those of the cavity, 1 m
    std::vector<double> lines = evenLines(1, fine, 15);
    for (double step = h; lines.back() < outer;) {
        step *= 1.08;
        lines.push_back(lines.back() + step);
    }
    lines.back() = outer;
    lines.push_back(outer + ring);
    Simulation simulation;
    simulation.state.mesh = structuredMesh(lines, {0, h}, Geometry::axisymmetric);
    const int sand = simulation.addMaterial(
        "sand", "law mohrCoulomb; porosity 0.35; solidDensity 2650; weight dry; youngsModulus 60e6; "
                "poissonsRatio 0.25; frictionAngle 38; dilatancyAngle 1; cohesion 0;");
    // A soft ring, held at its rim, stands for the elastic soil outside, which answers with 2 G u/r.
    const double stiffness = 2 * shearModulus(sandCavity.young, sandCavity.nu) * ring / outer;
    const int far = simulation.addMaterial("far", elasticSolid(stiffness, 0, 1000));
    simulation.setConditions("left { type zeroGradient; } right { type slip; } bottom { type slip; } "
                             "top { type slip; }");
    simulation.fill(sand, 2, 2, [&](double r, double) { return r < outer; });
    simulation.fill(far, 2, 2, [&](double r, double) { return r > outer; });
    const double p0 = sandCavity.p0;
    simulation.setStress([&](double, double) { return std::array<double, 4>{-p0, -p0, -p0, 0}; });

    const double duration = 20; // for each doubling
    std::string table;
    for (const double ratio : {1.0, 1.01, 1.025, 1.05, 1.1, 1.2, 1.3, 1.5, 1.75, 2.0}) {
        table += " (" + std::to_string(duration * (ratio - 1)) + " " +
                 std::to_string(ratio > 1 ? sandCavity.pressure(ratio) : p0) + ")";
    }
    InputProblems problems;
    simulation.scene.pointLoads = readPointLoads(
        parseDictionary("cavity { type pressure; direction (1 0 0); areaFollows yes; uniformValue table (" +
                        table + "); }"),
        Geometry::axisymmetric, problems);
    LoadedSurface surface;
    surface.region.type = "all";
    surface.face = LoadedSurface::Face::inner;
    loadPoints(simulation.state.points, simulation.state.mesh, {surface}, problems);
    problems.throwIfAny("the cavity's load");
    simulation.start();

    const MaterialPoints& points = simulation.state.points;
    for (const double ratio : {1.05, 1.1, 1.2, 1.5, 1.75, 2.0}) {
        simulation.run(duration * (ratio - 1), 0.8);
        double r = 0, initial = 0, count = 0;
        for (std::size_t p = 0; p < points.size(); ++p) {
            if (points.load[p] >= 0) {
                r += points.r[p];
                initial += points.initialR[p];
                ++count;
            }
        }
        r /= count;
        initial /= count;
        const double p = simulation.scene.pointLoads[0].value.component[0]->value(simulation.state.time);
        // The soil between the face and the loaded points, a quarter of a cell, keeps its volume.
        const double face = std::sqrt(r * r - initial * initial + 1);
        const std::string at = "cavity, a/a0 = " + std::to_string(face);
        expectNear((at + ": p/p0").c_str(), p / p0, sandCavity.pressure(face) / p0,
                   0.015 * sandCavity.pressure(face) / p0);
    }
}

} // namespace
} // namespace caisson::testing
