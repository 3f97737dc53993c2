// Manufactured solutions: neo-Hookean solids that move as they are told by the body force that this needs.

#include "Verification.h"
#include "dictionary/Text.h"

namespace caisson::testing {
namespace {

constexpr double young = 100, poisson = 0.25, rho = 2;

/// First Piola-Kirchhoff stress of a motion r(R, Z), z = Z [Pa].
struct PiolaStress
{
    double rR, rZ, zR, zZ, hoop;
};

/// r = R + f(t) R (1 - R^2) S(Z), f = A sin(w t): zero on the axis and at R = 1, where it is held.
/// S = 1: a disk, after Wallstedt & Guilkey 2008; S = sin(pi Z): a bulge with shear, held at top and bottom.
struct Motion
{
    double amplitude;
    bool bulge;
    double lambda = pWaveModulus(young, poisson) - 2 * shearModulus(young, poisson);
    double mu = shearModulus(young, poisson);
    double waveSpeed = std::sqrt(pWaveModulus(young, poisson) / rho);
    double frequency = (bulge ? pi : 2) * waveSpeed;

    [[nodiscard]] double f(double t) const { return amplitude * std::sin(frequency * t); }
    [[nodiscard]] double shape(double R, double Z) const
    {
        return R * (1 - R * R) * (bulge ? std::sin(pi * Z) : 1.0);
    }

    /// P = lambda ln J F^-T + mu (F - F^-T)
    [[nodiscard]] PiolaStress stress(double R, double Z, double factor) const
    {
        const double S = bulge ? std::sin(pi * Z) : 1.0;
        const double slope = bulge ? pi * std::cos(pi * Z) : 0.0;
        const double radial = 1 + factor * (1 - 3 * R * R) * S;
        const double shear = factor * R * (1 - R * R) * slope;
        const double hoop = 1 + factor * (1 - R * R) * S;
        const double scale = lambda * std::log(radial * hoop) - mu;
        return {scale / radial + mu * radial, mu * shear, -scale * shear / radial, scale + mu,
                scale / hoop + mu * hoop};
    }

    /// Body force per mass [m/s2]: acceleration less the divergence of the stress, by differences of 1e-4,
    /// exact to 1e-7.
    [[nodiscard]] std::array<double, 2> bodyForce(double R, double Z, double t) const
    {
        constexpr double d = 1e-4;
        const double factor = f(t);
        const PiolaStress here = stress(R, Z, factor);
        const PiolaStress east = stress(R + d, Z, factor), west = stress(R - d, Z, factor);
        const PiolaStress north = stress(R, Z + d, factor), south = stress(R, Z - d, factor);
        const double divergenceR =
            (east.rR - west.rR + north.rZ - south.rZ) / (2 * d) + (here.rR - here.hoop) / R;
        const double divergenceZ = (east.zR - west.zR + north.zZ - south.zZ) / (2 * d) + here.zR / R;
        return {-frequency * frequency * factor * shape(R, Z) - divergenceR / rho, -divergenceZ / rho};
    }
};

/// Errors of the displacement at a quarter and at three quarters of the period.
std::array<double, 2> manufacturedErrors(const Motion& motion, int n, double boxWidth = 0,
                                         bool fitted = false)
{
    const double h = 1.0 / n;
    Simulation simulation;
    simulation.scene.controls.boxWidth = boxWidth;
    simulation.state.mesh = structuredMesh(
        evenLines(0, 1, n), motion.bulge ? evenLines(0, 1, n) : evenLines(0, h, 1), Geometry::axisymmetric);
    const int solid = simulation.addMaterial("solid", elasticSolid(young, poisson, rho, "neoHookean"));
    simulation.setConditions(motion.bulge ? "\".*\" { type fixedValue; value uniform (0 0 0); }"
                                          : "right { type slip; } bottom { type slip; } top { type slip; }");
    simulation.fill(solid, fitted ? 4 : 2, fitted ? 4 : 2);
    simulation.scene.controls.fittedWeights = fitted;
    simulation.setVelocity([&](double R, double Z) {
        return std::array<double, 2>{motion.f(1e-6) / 1e-6 * motion.shape(R, Z), 0};
    });
    // A load for each point, its mass as the area: the traction is a force per mass.
    MaterialPoints& points = simulation.state.points;
    std::vector<PointLoad>& loads = simulation.scene.pointLoads;
    loads.resize(points.size());
    points.load = points.id;
    points.loadArea = points.mass;
    const auto set = [&](double t) { // the force that takes the velocity over a step is that of its middle
        for (std::size_t p = 0; p < points.size(); ++p) {
            const auto force = motion.bodyForce(points.initialR[p], points.initialZ[p], t);
            auto& component = loads[points.load[p]].value.component;
            component = {constantFunction1(force[0]), constantFunction1(0), constantFunction1(force[1])};
        }
    };
    set(0);
    simulation.start();

    const double quarter = 0.5 * pi / motion.frequency;
    const int steps = static_cast<int>(std::ceil(quarter / (0.2 * h / motion.waveSpeed)));
    std::array<double, 2> errors{};
    for (int i = 0; i < 3 * steps; ++i) {
        set(simulation.state.time + 0.5 * quarter / steps);
        simulation.step->advance(simulation.state, quarter / steps);
        if (i + 1 == steps || i + 1 == 3 * steps) {
            const double f = motion.f(simulation.state.time);
            double error = 0, norm = 0;
            for (std::size_t p = 0; p < points.size(); ++p) {
                const double exact = f * motion.shape(points.initialR[p], points.initialZ[p]);
                error += points.volume[p] * (std::pow(points.r[p] - points.initialR[p] - exact, 2) +
                                             std::pow(points.z[p] - points.initialZ[p], 2));
                norm += points.volume[p] * exact * exact;
            }
            errors[i + 1 == steps ? 0 : 1] = std::sqrt(error / norm);
        }
    }
    return errors;
}

/// Errors at both times, and the order of both from each resolution to the next.
void expectSecondOrder(const char* name, const Motion& motion, std::array<double, 2> finest)
{
    std::array<double, 2> coarse{};
    for (const int n : {16, 32, 64}) {
        const std::array<double, 2> errors = manufacturedErrors(motion, n);
        for (int k = 0; k < 2; ++k) {
            const std::string what =
                std::string(name) + (k == 0 ? ", T/4" : ", 3T/4") + ", n = " + std::to_string(n);
            if (n > 16) {
                expectOrder((what + ": order").c_str(), coarse[k], errors[k], 1.7);
            }
            if (n == 64) {
                expectNear((what + ": error").c_str(), errors[k], 0, finest[k]);
            }
        }
        coarse = errors;
    }
}

TEST(ManufacturedDisk, convergesWithTheSquareOfTheCellSize)
{
    expectSecondOrder("disk, A = 0.0005", {0.0005, false}, {4e-4, 8e-4});
}

TEST(ManufacturedBulge, convergesWithTheSquareOfTheCellSize)
{
    expectSecondOrder("bulge, A = 0.0005", {0.0005, true}, {6e-4, 2.5e-3});
}

// An error of the order of the strain remains that no refinement removes: 1.7e-3 at A = 0.005 and T/4. It
// grows while points move within their cells and starts again when they cross. Points of a filled cell are
// samples of the whole cell: its mean stress is that of their places, and its mass is shared out by their
// places on top of being scaled to a full cell. Stress extrapolated to the middle of the cell takes the error
// of the disk at A = 0.1 and 3T/4 from 1.2e-2 to 2.5e-3, mass shared out evenly that of the bulge at A =
// 0.005 and T/4 from 1.7e-3 to 1.1e-3; neither removes it.
TEST(ManufacturedBulge, convergesToTheErrorOfMovedPointsAtSmallStrain)
{
    std::array<double, 3> total{};
    for (int i = 0; i < 3; ++i) {
        const int n = 8 << i;
        const auto [early, late] = manufacturedErrors({0.005, true}, n);
        total[i] = std::sqrt(0.5 * (early * early + late * late));
        std::printf("bulge, A = 0.005, n = %d: error %.3e at T/4, %.3e at 3T/4\n", n, early, late);
    }
    expectNear("bulge, A = 0.005, n = 32: rms error of both times", total[2], 0, 8e-3);
    expectOrder("bulge, A = 0.005: order over n = 8, 16, 32", std::sqrt(total[0]), std::sqrt(total[2]), 1.7);
}

TEST(ManufacturedBulge, staysWithinTwoPercentAtLargeStrain)
{
    const auto [early, late] = manufacturedErrors({0.1, true}, 32);
    expectNear("bulge, A = 0.1, n = 32, T/4: error", early, 0, 1e-2);
    expectNear("bulge, A = 0.1, n = 32, 3T/4: error", late, 0, 2e-2);
}

// The quadrature of moved points is exact for linear functions with fitted weights: the error
// is that at small strain.
TEST(ManufacturedBulge, convergesAtLargeStrainWithFittedWeights)
{
    std::array<double, 3> total{};
    for (int i = 0; i < 3; ++i) {
        const int n = 8 << i;
        const auto [early, late] = manufacturedErrors({0.1, true}, n, 0, true);
        total[i] = std::sqrt(0.5 * (early * early + late * late));
        std::printf("bulge, A = 0.1, fitted, n = %d: error %.3e at T/4, %.3e at 3T/4\n", n, early, late);
    }
    expectNear("bulge, A = 0.1, fitted, n = 32: rms error of both times", total[2], 0, 8e-3);
    expectOrder("bulge, A = 0.1, fitted: order from n = 16 to 32", total[1], total[2], 1.7);
}

// ---------------------------------------------------------------------------------------------------------

/// Generalised vortex [Kamojjala, Brannon, Sadeghirad & Guilkey 2015]: points turn about the centre by
/// alpha(R, t) = A/2 (1 - cos 4 pi t) h(R), h = 1 - 32 (R-1)^2 + 256 (R-1)^4 for 3/4 < R < 5/4, and rest
/// elsewhere. F = (1 0; a 1) in polar components with a = R dalpha/dR, so that J = 1, sigma_rt = mu a,
/// sigma_tt = mu a^2 and the rest is zero.
struct Vortex
{
    double amplitude;
    double mu = shearModulus(1000, 0.3), density = 1000;

    static constexpr std::array<double, 3> shape(double R) ///< h and its derivatives
    {
        const double x = R - 1;
        if (x < -0.25 || x > 0.25) {
            return {0, 0, 0};
        }
        return {1 - 32 * x * x + 256 * x * x * x * x, -64 * x + 1024 * x * x * x, -64 + 3072 * x * x};
    }
    [[nodiscard]] double turn(double R, double t) const
    {
        return 0.5 * amplitude * (1 - std::cos(4 * pi * t)) * shape(R)[0];
    }
    /// Along r and theta of the place at t [m/s2].
    [[nodiscard]] std::array<double, 2> bodyForce(double R, double t) const
    {
        const auto [h, first, second] = shape(R);
        const double f = 0.5 * amplitude * (1 - std::cos(4 * pi * t));
        const double rate = 0.5 * amplitude * 4 * pi * std::sin(4 * pi * t) * h;
        const double acceleration = 0.5 * amplitude * 16 * pi * pi * std::cos(4 * pi * t) * h;
        const double a = R * f * first;
        return {-R * rate * rate + mu * a * a / (density * R),
                R * acceleration - mu / density * (f * first + R * f * second + 2 * f * first)};
    }
};

/// Error of the displacement at t = 1/4 s, the largest turn, of n cells per metre.
double vortexError(double amplitude, int n, double boxWidth = 0)
{
    const Vortex vortex{amplitude};
    Simulation simulation;
    simulation.scene.controls.boxWidth = boxWidth;
    simulation.state.mesh =
        structuredMesh(evenLines(0, 3, 3 * n), evenLines(0, 3, 3 * n), Geometry::planeStrain);
    const int solid = simulation.addMaterial("solid", elasticSolid(1000, 0.3, 1000, "neoHookean"));
    simulation.setConditions("\".*\" { type fixedValue; value uniform (0 0 0); }");
    simulation.fill(solid, 2, 2);
    MaterialPoints& points = simulation.state.points;
    std::vector<PointLoad>& loads = simulation.scene.pointLoads;
    loads.resize(points.size());
    points.load = points.id;
    points.loadArea = points.mass;
    const auto place = [&](std::size_t p, double t) { // radius and angle
        const double x = points.initialR[p] - 1.5, z = points.initialZ[p] - 1.5;
        const double R = std::hypot(x, z);
        return std::array{R, std::atan2(z, x) + vortex.turn(R, t)};
    };
    const auto set = [&](double t) {
        for (std::size_t p = 0; p < points.size(); ++p) {
            const auto [R, angle] = place(p, t);
            const auto [r, across] = vortex.bodyForce(R, t);
            loads[points.load[p]].value.component = {
                constantFunction1(r * std::cos(angle) - across * std::sin(angle)), constantFunction1(0),
                constantFunction1(r * std::sin(angle) + across * std::cos(angle))};
        }
    };
    set(0);
    simulation.start();
    const double c = std::sqrt(pWaveModulus(1000, 0.3) / 1000);
    const int steps = static_cast<int>(std::ceil(0.25 / (0.2 / n / c)));
    for (int i = 0; i < steps; ++i) {
        set(simulation.state.time + 0.5 * 0.25 / steps);
        simulation.step->advance(simulation.state, 0.25 / steps);
    }
    double error = 0, norm = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto [R, angle] = place(p, 0.25);
        const double r = 1.5 + R * std::cos(angle), z = 1.5 + R * std::sin(angle);
        error += points.volume[p] * (std::pow(points.r[p] - r, 2) + std::pow(points.z[p] - z, 2));
        norm +=
            points.volume[p] * (std::pow(points.initialR[p] - r, 2) + std::pow(points.initialZ[p] - z, 2));
    }
    return std::sqrt(error / norm);
}

TEST(Vortex, convergesWithTheSquareOfTheCellSize)
{
    const double coarse = vortexError(1e-3, 16), fine = vortexError(1e-3, 32);
    expectOrder("vortex, A = 0.001: order", coarse, fine, 1.7);
    expectNear("vortex, A = 0.001, n = 32: error", fine, 0, 2e-2);
}

// Averaged over the boxes of their points, stresses do not depend on where in their cells points are: the
// error that points leave by moving, 8e-3 to 1.3e-2 at these strains for linear shape functions on any mesh,
// goes.
TEST(ManufacturedDisk, convergesAtLargeStrainWithBoxes)
{
    for (const auto& [name, width] : {std::pair{"GIMP", 0.5}, std::pair{"B-splines", 1.0}}) {
        const auto coarse = manufacturedErrors({0.1, false}, 16, width);
        const auto fine = manufacturedErrors({0.1, false}, 32, width);
        for (int k = 0; k < 2; ++k) {
            const std::string what = text("disk, A = 0.1, %s, %s", name, k == 0 ? "T/4" : "3T/4");
            expectNear((what + ", n = 32: error").c_str(), fine[k], 0, 4e-3);
            expectOrder((what + ": order").c_str(), coarse[k], fine[k], 1.5);
        }
    }
}

TEST(ManufacturedBulge, staysWithinOnePercentAtLargeStrainWithBoxes)
{
    const auto [early, late] = manufacturedErrors({0.1, true}, 32, 0.5);
    expectNear("bulge, A = 0.1, GIMP, n = 32, T/4: error", early, 0, 4e-3);
    expectNear("bulge, A = 0.1, GIMP, n = 32, 3T/4: error", late, 0, 1e-2);
}

TEST(Vortex, convergesAtLargeShearWithBoxes)
{
    const double coarse = vortexError(0.1, 16, 0.5), fine = vortexError(0.1, 32, 0.5);
    expectOrder("vortex, A = 0.1, GIMP: order", coarse, fine, 1.9);
    expectNear("vortex, A = 0.1, GIMP, n = 32: error", fine, 0, 1.8e-2);
}

// Shear of 0.6. At A = 1, a shear of 6, points part so far that cells between them empty: the run breaks.
TEST(Vortex, staysWithinTwoPercentAtLargeShear)
{
    expectNear("vortex, A = 0.1, n = 32: error", vortexError(0.1, 32), 0, 2.2e-2);
}

} // namespace
} // namespace caisson::testing
