// Seepage by finite elements against exact answers.

#include "fem/Seepage.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace caisson::testing {
namespace {

using std::numbers::pi;

void report(const char* what, double got, double tolerance)
{
    std::printf("%-60s %.3e  (tolerance %.1e)\n", what, got, tolerance);
}

std::vector<double> nothingGiven(const BackgroundMesh& mesh)
{
    return std::vector<double>(mesh.nodes(), Seepage::free);
}

Seepage uniformSoil(const BackgroundMesh& mesh, double conductivity = 1, double storage = 1)
{
    return {mesh, std::vector<unsigned char>(mesh.cells(), 1),
            std::vector<double>(mesh.cells(), conductivity), std::vector<double>(mesh.cells(), storage)};
}

/// Lines from a to b whose first interval is `first` and that widen by `growth`, up to `widest`.
std::vector<double> gradedLines(double a, double b, double first, double growth, double widest = 1e9)
{
    std::vector<double> lines(1, 0.0);
    double step = first;
    const double length = std::abs(b - a);
    while (lines.back() < length) {
        lines.push_back(lines.back() + step);
        step = std::min(step * growth, widest);
    }
    const double scale = length / lines.back();
    for (double& line : lines) {
        line = a + (b > a ? 1 : -1) * scale * line;
    }
    lines.back() = b;
    std::ranges::sort(lines);
    return lines;
}

std::vector<double> joined(std::vector<std::vector<double>> parts)
{
    std::vector<double> all;
    for (const auto& part : parts) {
        for (const double line : part) {
            if (all.empty() || line > all.back() + 1e-9) {
                all.push_back(line);
            }
        }
    }
    return all;
}

TEST(Seepage, aLinearFieldIsExact)
{
    for (const bool triangles : {false, true}) {
        const BackgroundMesh mesh =
            structuredMesh({0, 0.3, 0.5, 1.1}, {0, 0.2, 0.7, 1}, Geometry::planeStrain, triangles);
        std::vector<double> given = nothingGiven(mesh);
        const auto exact = [&](int i) { return 3 + 2 * mesh.r[i] - 5 * mesh.z[i]; };
        for (const BoundaryPatch& patch : mesh.patches) {
            for (const BoundaryEdge& edge : patch.edges) {
                for (const int i : edge.node) {
                    given[i] = exact(i);
                }
            }
        }
        const Seepage seepage = uniformSoil(mesh, 7);
        const std::vector<double> excess = seepage.steady(given);
        double error = 0, unbalanced = 0;
        const std::vector<double> inflow = seepage.nodalInflow(excess);
        for (int i = 0; i < mesh.nodes(); ++i) {
            error = std::max(error, std::abs(excess[i] - exact(i)));
            unbalanced = std::max(unbalanced, std::isnan(given[i]) ? std::abs(inflow[i]) : 0);
        }
        report("seepage: linear field", error, 1e-12);
        EXPECT_LT(error, 1e-12);
        EXPECT_LT(unbalanced, 1e-12);
        EXPECT_NEAR(seepage.gradient(4, excess)[1], -5, 1e-12);
    }
}

/// Confined flow to a well: e = ln(r/a)/ln(b/a), inflow 1/ln(b/a) per radian and height.
double wellError(int n, bool triangles)
{
    const BackgroundMesh mesh =
        structuredMesh(evenLines(1, 3, n), evenLines(0, 1, n / 2), Geometry::axisymmetric, triangles);
    std::vector<double> given = nothingGiven(mesh);
    for (int i = 0; i < mesh.nodes(); ++i) {
        given[i] = mesh.r[i] < 1 + 1e-9 ? 0 : mesh.r[i] > 3 - 1e-9 ? 1 : given[i];
    }
    const std::vector<double> excess = uniformSoil(mesh).steady(given);
    double error = 0;
    for (int i = 0; i < mesh.nodes(); ++i) {
        error = std::max(error, std::abs(excess[i] - std::log(mesh.r[i]) / std::log(3.0)));
    }
    return error;
}

TEST(Seepage, aWellConvergesWithSecondOrder)
{
    for (const bool triangles : {false, true}) {
        const double coarse = wellError(8, triangles), fine = wellError(16, triangles);
        report("seepage: well, largest error, n = 16", fine, 2e-3);
        report("seepage: well, order", std::log2(coarse / fine), 1.8);
        EXPECT_LT(fine, 2e-3);
        EXPECT_GT(std::log2(coarse / fine), 1.8);
    }
}

/// V11: sheet pile of depth s in a layer of thickness 1. By antisymmetry half of it: the head is a half below
/// the pile's tip. Exact: q/(k h) = K(m)/(2 K'(m)), m = cos(pi s/2).
TEST(Seepage, aSheetPileHasTheExactFlow)
{
    const double exact[][2] = {{0.25, 0.734609}, {0.5, 0.5}, {0.75, 0.340317}};
    for (const auto& [s, q] : exact) {
        const double first = 0.002;
        const BackgroundMesh mesh =
            structuredMesh(gradedLines(0, 8, first, 1.15),
                           joined({gradedLines(-s, -1, first, 1.15), gradedLines(-s, 0, first, 1.15)}),
                           Geometry::planeStrain);
        std::vector<double> given = nothingGiven(mesh);
        for (int i = 0; i < mesh.nodes(); ++i) {
            if (mesh.z[i] > -1e-9) {
                given[i] = 0;
            } else if (mesh.r[i] < 1e-9 && mesh.z[i] < -s + 1e-9) {
                given[i] = 0.5;
            }
        }
        const Seepage seepage = uniformSoil(mesh);
        const std::vector<double> inflow = seepage.nodalInflow(seepage.steady(given));
        double flow = 0;
        for (int i = 0; i < mesh.nodes(); ++i) {
            flow += mesh.z[i] < -1e-9 ? inflow[i] : 0;
        }
        report("sheet pile: flow/exact - 1", flow / q - 1, 5e-3);
        EXPECT_NEAR(flow / q, 1, 5e-3) << "s/T " << s;
    }
}

struct CaissonFlow
{
    double flow, tipPressure, gradientAtWall, gradientAtAxis; ///< over s k D, s, and s/L
};

/// V12: suction s on the plug of a caisson of 5 m diameter with a wall of 50 mm, radius and depth of the
/// domain `extent` diameters.
CaissonFlow caissonFlow(double relativeDepth, double extent)
{
    const double D = 5, t = 0.05, Ro = 2.5, Ri = Ro - t, L = relativeDepth * D, h = t / 4;
    const double far = extent * D;
    const BackgroundMesh mesh = structuredMesh(
        joined({gradedLines(Ri, 0, h, 1.12, 0.25), evenLines(Ri, Ro, 4), gradedLines(Ro, far, h, 1.12)}),
        joined({gradedLines(-L, -far, h, 1.12), gradedLines(-L, 0, h, 1.12, 0.12)}), Geometry::axisymmetric);
    std::vector<unsigned char> soil(mesh.cells(), 1);
    for (int c = 0; c < mesh.cells(); ++c) {
        const double r = 0.5 * (mesh.r[mesh.node(c, 0)] + mesh.r[mesh.node(c, 2)]);
        const double z = 0.5 * (mesh.z[mesh.node(c, 0)] + mesh.z[mesh.node(c, 2)]);
        soil[c] = !(r > Ri && r < Ro && z > -L);
    }
    std::vector<double> given = nothingGiven(mesh);
    for (int i = 0; i < mesh.nodes(); ++i) {
        if (mesh.z[i] > -1e-9) {
            given[i] = mesh.r[i] < Ri + 1e-9 ? -1 : mesh.r[i] > Ro - 1e-9 ? 0 : given[i];
        }
    }
    const Seepage seepage(mesh, soil, std::vector<double>(mesh.cells(), 1));
    const std::vector<double> excess = seepage.steady(given);
    const std::vector<double> inflow = seepage.nodalInflow(excess);
    CaissonFlow result{};
    double tip = 0, area = 0;
    for (int i = 0; i < mesh.nodes(); ++i) {
        if (mesh.z[i] > -1e-9 && mesh.r[i] < Ri + 1e-9) {
            result.flow -= 2 * pi * inflow[i] / D;
        }
    }
    for (int c = 0; c < mesh.cells(); ++c) {
        const int a = mesh.node(c, 2), b = mesh.node(c, 3); // upper corners
        if (std::abs(mesh.z[a] + L) < 1e-9 && mesh.r[b] > Ri - 1e-9 && mesh.r[a] < Ro + 1e-9) {
            const double width = mesh.r[a] - mesh.r[b];
            tip += 0.5 * width * (excess[a] + excess[b]);
            area += width;
        }
        if (std::abs(mesh.z[a]) < 1e-9 && mesh.r[b] < 1e-9) {
            result.gradientAtAxis = -seepage.gradient(c, excess)[1] * L;
        }
        if (std::abs(mesh.z[a]) < 1e-9 && std::abs(mesh.r[a] - Ri) < 1e-9) {
            result.gradientAtWall = -seepage.gradient(c, excess)[1] * L;
        }
    }
    result.tipPressure = -tip / area;
    return result;
}

TEST(Seepage, aCaissonHasTheFlowAndTipPressureOfIndependentSolutions)
{
    // L/D, flow and tip factor for a wall of 1 % of the diameter, exit gradients for a thin one
    const double expected[][5] = {{0.2, 1.673, 0.3215, 0.506, 0.359},
                                  {0.4, 1.130, 0.2441, 0.615, 0.572},
                                  {0.6, 0.8612, 0.1967, 0.690, 0.679},
                                  {0.8, 0.6976, 0.1648, 0.742, 0.739},
                                  {1.0, 0.5869, 0.1418, 0.779, 0.779}};
    for (const auto& [depth, flow, tip, wall, axis] : expected) {
        const CaissonFlow got = caissonFlow(depth, 20);
        std::printf("caisson L/D %.1f: F %.4f (%.4f), a %.4f (%.4f), exit gradient at the wall %.3f (%.3f), "
                    "axis %.3f "
                    "(%.3f)\n",
                    depth, got.flow, flow, got.tipPressure, tip, got.gradientAtWall, wall, got.gradientAtAxis,
                    axis);
        EXPECT_NEAR(got.flow / flow, 1, 1e-2) << "L/D " << depth;
        EXPECT_NEAR(got.tipPressure, tip, 2e-2) << "L/D " << depth;
        EXPECT_NEAR(got.gradientAtWall / wall, 1, 3e-2) << "L/D " << depth;
        EXPECT_NEAR(got.gradientAtAxis / axis, 1, 3e-2) << "L/D " << depth;
    }
}

TEST(Seepage, theDomainSizeChangesTheFlowOfACaissonLittleFromEightDiametersOn)
{
    const double wide = caissonFlow(0.6, 20).flow;
    const double eight = caissonFlow(0.6, 8).flow / wide - 1;
    const double three = caissonFlow(0.6, 3).flow / wide - 1;
    std::printf("caisson L/D 0.6: flow in 8 D %+.2f %%, in 3 D %+.2f %% of that in 20 D\n", 100 * eight,
                100 * three);
    EXPECT_NEAR(eight, 0, 5e-3);
    EXPECT_LT(std::abs(three), 0.1);
}

/// Consolidation of a column drained at the top, from a uniform pressure: error at T = 0.1.
double columnError(int steps, double theta)
{
    const int n = 200;
    const BackgroundMesh mesh = structuredMesh({0, 0.01}, evenLines(0, 1, n), Geometry::planeStrain);
    std::vector<double> given = nothingGiven(mesh);
    std::vector<double> excess(mesh.nodes());
    const double start = 0.05;
    const auto exact = [&](double z, double T) {
        double sum = 0;
        for (int i = 0; i < 100; ++i) {
            const double a = (2 * i + 1) * pi / 2;
            sum += 2 / a * std::sin(a * (1 - z)) * std::exp(-a * a * T);
        }
        return sum;
    };
    for (int i = 0; i < mesh.nodes(); ++i) {
        excess[i] = exact(mesh.z[i], start);
        given[i] = mesh.z[i] > 1 - 1e-9 ? 0 : Seepage::free;
    }
    Seepage seepage = uniformSoil(mesh);
    for (int i = 0; i < steps; ++i) {
        excess = seepage.advance(excess, 0.1 / steps, theta, given);
    }
    double error = 0;
    for (int i = 0; i < mesh.nodes(); ++i) {
        error += std::pow(excess[i] - exact(mesh.z[i], start + 0.1), 2) / mesh.nodes();
    }
    return std::sqrt(error);
}

TEST(Seepage, consolidationIsOfFirstAndSecondOrderInTime)
{
    const double euler = std::log2(columnError(10, 1) / columnError(20, 1));
    const double crankNicolson = std::log2(columnError(10, 0.5) / columnError(20, 0.5));
    report("consolidation, Crank-Nicolson, 20 steps: rms of p", columnError(20, 0.5), 2e-3);
    report("consolidation, order of backward Euler", euler, 0.9);
    report("consolidation, order of Crank-Nicolson", crankNicolson, 1.7);
    EXPECT_LT(columnError(20, 0.5), 2e-3);
    EXPECT_GT(euler, 0.9);
    EXPECT_GT(crankNicolson, 1.7);
}

TEST(Seepage, soilWithoutAnyGivenPressureIsRefused)
{
    const BackgroundMesh mesh = structuredMesh({0, 1, 2}, {0, 1, 2}, Geometry::axisymmetric);
    try {
        static_cast<void>(uniformSoil(mesh).steady(nothingGiven(mesh)));
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("no given pressure"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace caisson::testing
