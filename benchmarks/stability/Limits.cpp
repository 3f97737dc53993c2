#include "Limits.h"

#include "dictionary/Text.h"

#include <cmath>

namespace caisson::stability {

namespace {

constexpr long steps = 3000;

} // namespace

std::vector<Limit> limitScenes()
{
    std::vector<Limit> all;
    struct Flow
    {
        int phases;
        SolutionControls::Drag drag;
        double permeability, bulkModulus;
        const char* name;
    };
    using Drag = SolutionControls::Drag;
    for (const Flow& flow : {Flow{1, Drag::implicit, 1e-11, 2e7, "-"},
                             Flow{2, Drag::implicit, 1e-12, 2e7, "implicit, k 1e-12 m2"},
                             Flow{2, Drag::implicit, 1e-8, 2e7, "implicit, k 1e-8 m2"},
                             Flow{2, Drag::implicit, 1e-12, 2.2e9, "implicit, k 1e-12 m2, Kw 2.2 GPa"},
                             Flow{2, Drag::implicit, 1e-8, 2.2e9, "implicit, k 1e-8 m2, Kw 2.2 GPa"},
                             Flow{2, Drag::lagged, 1e-10, 2e7, "lagged, k 1e-10 m2"},
                             Flow{2, Drag::lagged, 1e-11, 2e7, "lagged, k 1e-11 m2"},
                             Flow{2, Drag::lagged, 1e-12, 2e7, "lagged, k 1e-12 m2"}}) {
        for (const bool triangles : {false, true}) {
            for (const Geometry geometry : {Geometry::planeStrain, Geometry::axisymmetric}) {
                for (const double aspect : {1.0, 2.0, 5.0, 20.0}) {
                    for (const bool surface : {false, true}) {
                        if ((aspect == 2 || aspect == 5) && (surface || geometry == Geometry::axisymmetric)) {
                            continue;
                        }
                        Limit limit;
                        Block& block = limit.block;
                        block.kernel = {flow.phases, triangles, geometry};
                        block.columns = block.rows = 8;
                        block.cellHeight = 0.1 * aspect;
                        block.emptyRows = surface ? 1 : 0;
                        block.gravity = 0;
                        block.noise = 1e-7;
                        block.drag = flow.drag;
                        block.soil.permeability = flow.permeability;
                        block.soil.liquidBulkModulus = flow.bulkModulus;
                        limit.kernel =
                            block.kernel.name() + (geometry == Geometry::planeStrain ? ", plane" : "");
                        limit.cells = text("%g : 1", aspect);
                        limit.drag = flow.name;
                        limit.surface = surface ? "free surface" : "cells all filled";
                        all.push_back(limit);
                    }
                }
            }
        }
    }
    // Points per cell, whose share of the shortest wave differs.
    for (const int phases : {1, 2}) {
        for (const bool triangles : {false, true}) {
            for (const int side : {1, 2, 3, 4}) {
                if (triangles && side > 2) {
                    continue;
                }
                for (const bool random : {false, true}) {
                    Limit limit;
                    Block& block = limit.block;
                    block.kernel = {phases, triangles, Geometry::planeStrain};
                    block.columns = block.rows = 8;
                    block.emptyRows = 0;
                    block.gravity = 0;
                    block.noise = 1e-7;
                    block.pointsPerSide = side;
                    block.randomPlaces = random;
                    const int count = triangles ? (side == 1 ? 1 : 3) : side * side;
                    limit.kernel = block.kernel.name() + ", plane";
                    limit.cells =
                        text("1 : 1, %d point%s%s", count, count == 1 ? "" : "s", random ? " at random" : "");
                    limit.drag = phases == 1 ? "-" : "implicit, k 1e-11 m2";
                    limit.surface = "cells all filled";
                    all.push_back(limit);
                }
            }
        }
    }
    return all;
}

bool grows(const Block& block, double share, long count)
{
    Simulation simulation = make(block);
    simulation.start();
    const double dt = share * simulation.step->stableStep(simulation.state).step;
    const double before = kineticEnergy(simulation);
    for (long i = 0; i < count; ++i) {
        try {
            simulation.step->advance(simulation.state, dt);
        } catch (const InputError&) { // points that have left the mesh
            return true;
        }
        if (i % 50 == 49 && !(kineticEnergy(simulation) < 10 * before)) {
            return true;
        }
    }
    return false;
}

void findLimit(Limit& limit)
{
    Simulation simulation = make(limit.block);
    simulation.start();
    limit.estimate = simulation.step->stableStep(simulation.state).step;
    double stable = 0.5, unstable = 4;
    while (stable > 0.05 && grows(limit.block, stable, steps)) {
        unstable = stable;
        stable /= 2;
    }
    while (unstable / stable > 1.005) {
        const double middle = std::sqrt(stable * unstable);
        (grows(limit.block, middle, steps) ? unstable : stable) = middle;
    }
    limit.truth = stable * limit.estimate;
}

} // namespace caisson::stability
