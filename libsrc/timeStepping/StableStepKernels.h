#pragma once

#include "timeStepping/LiquidKernels.h"

// The stable step of triangles. What the least altitude says of it is off by a tenth to the unsafe side where
// single points lie in corners of their cells, and by a half to the safe side where pressures of water are
// averaged over nodes. So the stiffest vibration of all cells is looked for whenever the points are sorted,
// which rebuild() does, too, so that a restarted run finds the same; in between the step goes with the
// least altitude over the wave speed, for the mesh moves and the inertia is scaled.
namespace caisson {

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findStiffestMode(const State& state)
    requires isConstantStrain
{
    double byAltitude = std::numeric_limits<double>::max();
    for (const int c : active_.items) {
        byAltitude = std::min(byAltitude, waveStep(state, c) * std::sqrt(inertiaScale_[c]));
    }
    if (active_.items.empty()) {
        return;
    }
    modeNumber_.assign(state.mesh.nodes(), -1);
    for (int i = 0; i < static_cast<int>(activeNodes_.size()); ++i) {
        modeNumber_[activeNodes_[i]] = i;
    }
    mode_.averaged = scene_.controls.locking == SolutionControls::Locking::nodalAverage;
    mode_.cells.resize(active_.items.size());
    threads_.share(static_cast<int>(active_.items.size()), cellsPerPiece, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            mode_.cells[i] = modeCell(state, active_.items[i]);
        }
    });
    setModeNodes();
    mode_.prepare(threads_);
    const auto over = [byAltitude](double step) {
        // Where next to nothing is free to move the altitude says enough; a run that has become unstable says
        // so elsewhere.
        constexpr double largest = 4;
        return std::isnan(step) ? 1.0 : std::min(step / byAltitude, largest);
    };
    stepShare_ = over(mode_.step(threads_));
    if (twoPhase && scene_.controls.drag == SolutionControls::Drag::lagged) {
        nodalShare_ = over(mode_.stepOfNodes(threads_));
    }
}

/// What the vibrations of a cell depend on (mapCellToNodes, mapLiquidToNodes).
template <class Shape, int phases>
typename StiffestMode<phases>::Cell ExplicitStep<Shape, phases>::modeCell(const State& state, int c) const
    requires isConstantStrain
{
    const MaterialPoints& points = state.points;
    typename StiffestMode<phases>::Cell cell;
    const shapes::Moments<corners> moments = Shape::moments(cells_[c]);
    std::array<double, corners> hoop{}; // of the points
    double volume = 0, pores = 0;
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        const double v = points.volume[p];
        const int material = points.material[p];
        Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        std::array<double, phases> mass{inertiaScale_[c] * points.mass[p] * solidShare_[material]};
        if constexpr (twoPhase) {
            const double ofPoint = v - points.mass[p] * liquid_[material].grainVolume;
            pores += ofPoint;
            mass[1] = inertiaScale_[c] * ofPoint * liquid_[material].density;
            cell.storage += v * liquid_[material].bulkModulus;
        }
        for (int k = 0; k < corners; ++k) {
            for (int f = 0; f < phases; ++f) {
                cell.mass[f][k] += mass[f] * values.N[k] * values.N[k];
                cell.mass[f][3 + k] += mass[f] * values.N[k] * values.N[(k + 1) % corners];
            }
            hoop[k] += axisymmetric ? v * values.N[k] / std::max(points.r[p], kernels::smallestRadius) : 0;
        }
        volume += v;
        const double shear = scene_.materials[material].law->shearModulus();
        cell.shear += v * shear;
        cell.bulk += v * (scene_.materials[material].law->pWaveModulus() - 4.0 / 3 * shear);
    }
    const bool filled = state.filled[c] != 0;
    const int first = points.material[*pointCells_.begin(c)];
    const std::array<double, corners> share = Shape::cornerShares(cells_[c]);
    for (int k = 0; k < corners; ++k) {
        cell.fullMass[k] =
            inertiaScale_[c] * density_[first] * solidShare_[first] * dilatation_[c].volume * share[k];
        cell.node[k] = modeNumber_[cellNodes_[c * corners + k]];
        cell.gr[k] = moments.gr[0][k];
        cell.gz[k] = moments.gz[0][k];
        cell.h[k] = filled ? moments.h[0][k] : hoop[k] / volume;
    }
    const double whole = dilatation_[c].volume;
    cell.volume = whole;
    cell.stressed = filled ? whole : volume;
    cell.shear /= volume;
    cell.bulk /= volume;
    if constexpr (twoPhase) {
        const bool full =
            scene_.controls.integration == SolutionControls::Integration::mixed && !bySurface_[c];
        cell.wet = full ? whole : volume;
        // Projection: the pressures follow.
        cell.storage = projects() ? 0 : cell.storage / pores;
        cell.porosity = pores / volume;
    }
    for (int f = 0; filled && f < phases; ++f) {
        for (double& mass : cell.mass[f]) {
            mass *= whole / volume; // fullness_
        }
    }
    return cell;
}

/// Which nodes are remapped, and what is held.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::setModeNodes()
    requires isConstantStrain
{
    using Remap = SolutionControls::Remap;
    const Remap remap = scene_.controls.remap;
    mode_.looseShare = remap == Remap::loose ? kernels::looseShare : 0;
    mode_.nodes.assign(activeNodes_.size(), {});
    for (std::size_t i = 0; i < activeNodes_.size(); ++i) {
        mode_.nodes[i].loose =
            remap == Remap::all || (remap == Remap::loose && surfaceNode_[activeNodes_[i]] != 0);
    }
    for (const VelocityConditions::Node& condition : scene_.conditions.nodes()) {
        const int i = modeNumber_[condition.node];
        if (i < 0) {
            continue;
        }
        if (condition.fixed) {
            mode_.nodes[i].hold(0, {1, 0});
            mode_.nodes[i].hold(0, {0, 1});
        } else {
            mode_.nodes[i].hold(0, condition.normal);
        }
    }
    if constexpr (twoPhase) {
        const auto& conditions = scene_.liquidBoundary.nodes();
        for (std::size_t c = 0; c < conditions.size(); ++c) {
            const int i = modeNumber_[conditions[c].node];
            for (int d = 0; i >= 0 && d < conditions[c].directions; ++d) {
                // Where the solid is free it moves with the liquid, which is less than free.
                if (solidHeld_[c][d]) {
                    mode_.nodes[i].hold(1, conditions[c].normal[d]);
                }
            }
        }
    }
}

} // namespace caisson
