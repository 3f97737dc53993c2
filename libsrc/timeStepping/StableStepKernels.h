#pragma once

#include "timeStepping/LiquidKernels.h"

// The stable step: of every cell alone by its extent and the fastest wave in it, and that of triangles. What
// the least altitude says of it is off by a tenth to the unsafe side where single points lie in corners of
// their cells, and by a half to the safe side where pressures of water are averaged over nodes. So the
// stiffest vibration of all cells is looked for whenever the points are sorted, which rebuild() does, too, so
// that a restarted run finds the same; in between the step goes with the least altitude over the wave speed,
// for the mesh moves and the inertia is scaled.
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
    stable_.step = 0;
    stepShare_ = over(mode_.step(threads_));
    if (twoPhase && scene_.controls.drag == SolutionControls::Drag::lagged) {
        nodalShare_ = over(mode_.stepOfNodes(threads_));
    }
}

/// What the vibrations of a cell depend on (sumPoints, addStress, mapLiquidToNodes).
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
        const bool full = isFull(c);
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

/// Of the materials as they were at the start, or of the soil that is compacted most now: the less its pores
/// hold, the stiffer they make it.
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::fastestWave(const State& state, int c) const
{
    const MaterialPoints& points = state.points;
    const bool pores = twoPhase && !projects();
    if (waveSpeed_.size() == 1 && !pores) {
        return waveSpeed_[0];
    }
    double speed = 0;
    double least = 1; // porosity over that at the start
    int densest = 0;
    for (const int* p = pointCells_.begin(c); p != pointCells_.end(c); ++p) {
        const int material = points.material[*p];
        speed = std::max(speed, waveSpeed_[material]);
        if constexpr (twoPhase) {
            const double ratio = porosity(points, *p) / scene_.materials[material].porosity;
            densest = ratio < least ? material : densest;
            least = std::min(least, ratio);
        }
    }
    if (pores && least < 1) {
        constexpr double none = 1e-3; // at which the watch has something to say
        const Material& soil = scene_.materials[densest];
        speed = std::max(speed, kernels::fastWave(soil, std::max(none, least * soil.porosity)));
    }
    return speed;
}

/// Step that waves allow a cell without mass scaling [s].
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::waveStep(const State& state, int c) const
{
    return Shape::size(cells_[c]) / fastestWave(state, c);
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::scaleInertia(const State& state)
{
    femInnerOld_ = true;
    femStep_.step = 0;
    stable_.step = 0;
    viscousStep_ = 0;
    if (!scene_.controls.scaleSmallCells) {
        std::ranges::fill(inertiaScale_, state.massScaling);
        return;
    }
    double smallest = std::numeric_limits<double>::max();
    for (const int c : active_.items) {
        smallest = std::min(smallest, waveStep(state, c));
    }
    const double common = smallest * std::sqrt(state.massScaling);
    forCells([&](int c) {
        const double ratio = common / waveStep(state, c);
        inertiaScale_[c] = std::max(1.0, ratio * ratio);
    });
}

/// Step of nodes with lagged drag whose points keep all that the nodes have, with scaled inertia: a vibration
/// of both phases that changes its sign in every step is left at
///
///     4 = largest eigenvalue of M^-1 (dt^2 K + 2 dt Q),   K = 4/size^2 [(1-n)^2 Kw/n + E, (1-n) Kw; ., n
///     Kw],
///
/// M = diag((1-n) rho_s, n rho_w), E the modulus of the soil, Q the drag. The formula of Mieremet, Stolle,
/// Ceccato & Vuik 2016 adds the eigenvalues of both parts, which is up to 20 % less. Points keep the share
/// phi of a wave; with D the drag times dt the limit is, of one wave,
///
///     dt^2 omega^2 (1 + (1 - D)(1 - phi)) = 4 - 2 D   (D < 1),   dt^2 omega^2 = 2 + 2 phi (1 - D)   (D > 1),
///
/// for any phi not before the lesser of what waves allow without drag at phi = 0, dt^2 omega^2 = 2, and of
/// this one, phi = 1.
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::laggedDragStep(const State& state, int c, double size) const
{
    const Material& soil = scene_.materials[state.points.material[*pointCells_.begin(c)]];
    const double n = soil.porosity;
    const double solid = inertiaScale_[c] * (1 - n) * soil.solidDensity;
    const double liquid = inertiaScale_[c] * n * soil.liquidDensity;
    const double bulk = soil.liquidBulkModulus;
    const double drag = n * n * soil.liquidViscosity / soil.intrinsicPermeability;
    const double shape = 4 / (size * size);
    const double root = std::sqrt(solid * liquid);
    const double stiff[3] = {shape * ((1 - n) * (1 - n) * bulk / n + soil.law->pWaveModulus()) / solid,
                             shape * (1 - n) * bulk / root, shape * n * bulk / liquid};
    const double slow[3] = {drag / solid, -drag / root, drag / liquid};
    // With the vibration that is the stiffest at one step the next step, from above.
    double dt = 2 / std::sqrt(std::max(stiff[0], stiff[2]));
    for (int i = 0; i < 12; ++i) {
        const double ss = dt * stiff[0] + 2 * slow[0];
        const double sl = dt * stiff[1] + 2 * slow[1];
        const double ll = dt * stiff[2] + 2 * slow[2];
        const double angle = 0.5 * std::atan2(2 * sl, ss - ll);
        const double x = std::cos(angle);
        const double y = std::sin(angle);
        const double a = stiff[0] * x * x + 2 * stiff[1] * x * y + stiff[2] * y * y;
        const double d = slow[0] * x * x + 2 * slow[1] * x * y + slow[2] * y * y;
        const double before = dt;
        dt = 4 / (d + std::sqrt(d * d + 4 * a)); // a dt^2 + 2 d dt = 4
        if (std::abs(dt - before) < 1e-6 * dt) {
            break;
        }
    }
    return dt;
}

/// Step that a cell allows with its inertia [s].
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::cellStep(const State& state, int c) const
{
    const double step = stepShare_ * waveStep(state, c) * std::sqrt(inertiaScale_[c]);
    return twoPhase && scene_.controls.drag == SolutionControls::Drag::lagged
               ? std::min(step, laggedDragStep(state, c, nodalShare_ * Shape::size(cells_[c])))
               : step;
}

template <class Shape, int phases>
StableStep ExplicitStep<Shape, phases>::stableStep(const State& state) const
{
    if (stable_.step == 0 || state.step - stableSince_ >= scene_.controls.checkInterval) {
        stable_ = estimatedStep(state);
        stableSince_ = state.step;
    }
    return stable_;
}

template <class Shape, int phases>
StableStep ExplicitStep<Shape, phases>::estimatedStep(const State& state) const
{
    // Linear bulk viscosity b shortens the step by sqrt(1 + b^2) - b.
    const double b = scene_.controls.linearBulkViscosity;
    const double viscous = std::sqrt(1 + b * b) - b;
    const auto less = [](const StableStep& one, const StableStep& other) {
        return one.step < other.step || (one.step == other.step && one.cell < other.cell);
    };
    for (StableStep& least : shortest_) {
        least = {std::numeric_limits<double>::max(), 0, 0, 0};
    }
    threads_.share(awake_.part, pointsPerPiece, [&](int thread, int begin, int end) {
        StableStep& least = shortest_[thread];
        for (int i = begin; i < end; ++i) {
            const int c = awake_.items[i];
            if (resting(c)) {
                continue;
            }
            const double step = cellStep(state, c);
            if (less({step, c, 0, 0}, least)) {
                least = {step, c, 0, 0};
            }
        }
    });
    StableStep result = *std::ranges::min_element(shortest_, less);
    if (!femCells_.empty()) {
        result = std::min(result, femStep(state), less);
    }
    result.step *= viscous;
    result.waveSpeed = fastestWave(state, result.cell);
    result.size = stepShare_ * Shape::size(cells_[result.cell]);
    return result;
}

} // namespace caisson
