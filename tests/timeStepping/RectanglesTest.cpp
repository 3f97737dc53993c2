// Filled rectangles, which are computed four at a time, against the kernel of general quadrilaterals, which
// takes them one by one.

#include "support/Simulation.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace caisson::testing {
namespace {

/// A block of elastic soil that is sheared through its cells. `skew`: of one node, which makes the mesh one
/// of general quadrilaterals [m]. `femCells`: whose points rest for ten steps at most. `thin`: one cell in
/// its middle holds a fifth of its soil, too little to be filled.
Simulation shearedBlock(int phases, double skew, bool thin, bool femCells)
{
    Simulation simulation;
    BackgroundMesh& mesh = simulation.state.mesh;
    mesh = structuredMesh(evenLines(0, 1, 9), evenLines(0, 1, 9), Geometry::axisymmetric);
    for (int i = 0; i < mesh.nodes(); ++i) {
        if (std::abs(mesh.r[i] - 8.0 / 9) < 1e-9 && std::abs(mesh.z[i] - 8.0 / 9) < 1e-9) {
            mesh.r[i] += skew;
        }
    }
    const int soil = simulation.addMaterial(
        "soil", "law linearElastic; porosity 0.35; solidDensity 2650; youngsModulus 6e3; poissonsRatio 0.25; "
                "intrinsicPermeability 1e-11; liquidBulkModulus 2e3;");
    simulation.scene.controls.phases = phases;
    simulation.setConditions("right { type slip; } bottom { type slip; } top { type slip; }");
    if (phases == 2) {
        simulation.setPressures(
            "right { type impermeable; } bottom { type impermeable; } top { type impermeable; }");
    }
    simulation.fill(soil, 3, 2);
    if (phases == 2) {
        simulation.state.points.addLiquid();
    }
    MaterialPoints& points = simulation.state.points;
    for (std::size_t p = 0; thin && p < points.size(); ++p) {
        if (std::abs(points.r[p] - 0.5) < 0.5 / 9 && std::abs(points.z[p] - 0.5) < 0.5 / 9) {
            points.volume[p] *= 0.2;
            points.mass[p] *= 0.2;
        }
    }
    simulation.setStress([](double, double) { return std::array<double, 4>{-30, -80, -30, 0}; });
    simulation.setVelocity([](double r, double z) {
        return std::array<double, 2>{3 * r * (1 - r) * (0.5 - z), 6 * z * (1 - z) * (r - 0.6)};
    });
    if (femCells) {
        simulation.scene.controls.femCells = SolutionControls::FemCells::automatic;
        simulation.scene.controls.femDistance = 1;
        simulation.scene.controls.sortInterval = 10;
        simulation.scene.controls.femStrain = 1;
        simulation.scene.controls.femMotion = 1;
    }
    simulation.start();
    EXPECT_EQ(simulation.step->cellCounts(simulation.state).fem > 0, femCells);
    return simulation;
}

TEST(Rectangles, areComputedFourAtATimeAsGeneralQuadrilateralsOneByOne)
{
    for (const auto& [phases, thin, femCells] :
         {std::tuple(1, false, false), std::tuple(2, false, false), std::tuple(1, true, false),
          std::tuple(2, true, false), std::tuple(1, false, true), std::tuple(2, false, true)}) {
        Simulation one = shearedBlock(phases, 1e-8, thin, femCells);
        Simulation four = shearedBlock(phases, 0, thin, femCells);
        const double step = 0.5 * four.step->stableStep(four.state).step;
        double moved = 0;
        for (int i = 0; i < 200; ++i) {
            one.step->advance(one.state, step);
            four.step->advance(four.state, step);
        }
        one.step->rebuild(one.state); // no point rests
        four.step->rebuild(four.state);
        const MaterialPoints& expected = one.state.points;
        const MaterialPoints& got = four.state.points;
        std::vector<std::size_t> place(got.size());
        for (std::size_t p = 0; p < got.size(); ++p) {
            place[got.id[p]] = p;
        }
        double difference = 0, largest = 0, speed = 0, ofSpeed = 0;
        for (std::size_t p = 0; p < expected.size(); ++p) {
            const std::size_t q = place[expected.id[p]];
            for (int j = 0; j < 4; ++j) {
                difference = std::max(difference, std::abs(got.stress[j][q] - expected.stress[j][p]));
                largest = std::max(largest, std::abs(expected.stress[j][p]));
            }
            if (phases == 2) {
                difference = std::max(difference, std::abs(got.porePressure[q] - expected.porePressure[p]));
                ofSpeed = std::max(ofSpeed, std::abs(got.wr[q] - expected.wr[p]));
            }
            ofSpeed = std::max(ofSpeed, std::abs(got.vz[q] - expected.vz[p]));
            speed = std::max(speed, std::abs(expected.vz[p]));
            moved = std::max(moved, std::hypot(got.r[q] - got.initialR[q], got.z[q] - got.initialZ[q]));
        }
        std::printf(
            "%d phase(s)%s%s: stress within %.1e of the largest, velocity %.1e (tolerance 1e-5); points "
            "moved by %.2f "
            "cells\n",
            phases, thin ? ", a thin cell" : "", femCells ? ", FEM cells" : "", difference / largest,
            ofSpeed / speed, 9 * moved);
        EXPECT_LT(difference / largest, 1e-5);
        EXPECT_LT(ofSpeed / speed, 1e-5);
        EXPECT_GT(9 * moved, 0.1); // some have come to other cells
    }
}

} // namespace
} // namespace caisson::testing
