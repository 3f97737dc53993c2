#pragma once

#include "dictionary/Text.h"
#include "materialPoints/PointMerging.h"
#include "timeStepping/ExplicitStep.h"
#include "timeStepping/MassScaling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace caisson {

namespace kernels {

/// Shape functions are evaluated a hair inside, so that a point on the axis has a hoop strain.
inline constexpr double smallestRadius = 1e-12;

/// A cell away from any surface is integrated as filled from this share of its volume on. Rows of regularly
/// spaced points cross a mesh line together: with two rows per cell the share of a full cell swings between a
/// half and one and a half, so a threshold near one would switch whole rows of cells at every crossing.
inline constexpr double leastFill = 0.25;
inline constexpr double fillHysteresis = 0.1;

/// A node with less than this share of the mass of evenly filled cells is loose.
inline constexpr double looseShare = 0.6;

/// Soil that yields comes apart beyond this multiple of its first volume (a porosity of 0.57 from 0.35): what
/// a point gains then is void, not soil. A grain that flies would otherwise come back as a light body of
/// great volume, stiffer than the step allows.
inline constexpr double largestExpansion = 1.5;

/// Corner 0 of an axis-parallel rectangle is to be the lower left one.
inline int firstCorner(const BackgroundMesh& mesh, int cell)
{
    int first = 0;
    for (int k = 1; k < mesh.corners; ++k) {
        const int a = mesh.node(cell, k);
        const int b = mesh.node(cell, first);
        if (mesh.r[a] + mesh.z[a] < mesh.r[b] + mesh.z[b]) {
            first = k;
        }
    }
    return first;
}

/// Second moments of the points of a cell about their centre, in local coordinates, and the slopes over the
/// cell of a quantity with the first moments cx, cy. The ridge keeps slopes from being extrapolated out of a
/// cluster of points.
template <class Real>
struct Spread
{
    Spread(const Real& inXi, const Real& inEta, const Real& mixed)
        : xx(inXi), yy(inEta), xy(mixed), inverse(1 / ((xx + ridge) * (yy + ridge) - xy * xy))
    {
    }

    [[nodiscard]] Real slopeXi(const Real& cx, const Real& cy) const
    {
        return cx * ((yy + ridge) * inverse) - cy * (xy * inverse);
    }
    [[nodiscard]] Real slopeEta(const Real& cx, const Real& cy) const
    {
        return cy * ((xx + ridge) * inverse) - cx * (xy * inverse);
    }
    /// Shares of the slopes of a stress that the points show.
    [[nodiscard]] Real shareXi() const { return xx / (xx + ridge); }
    [[nodiscard]] Real shareEta() const { return yy / (yy + ridge); }

    Real xx, yy, xy, inverse; ///< moments; 1 over their determinant

private:
    static constexpr double ridge = 0.02;
};

/// The stress of a filled cell, or of several: mean and slopes, from the sums over its points.
template <int corners, class Real>
struct FilledStress
{
    Real inverse;           ///< 1 over the volume of the points
    Real xi, eta;           ///< centre of the points
    Real shareXi, shareEta; ///< see Spread
    shapes::StressField<corners, Real> field;
};

/// Strain increments rr zz hoop rz and spin of a velocity gradient, with another dilatation rate.
template <class Real>
[[gnu::always_inline]] inline void strainOf(const Real (&gradient)[5], const Real& rate, double dt,
                                            Real (&strain)[4], Real& spin)
{
    const Real shift = (rate - (gradient[0] + gradient[1] + gradient[2])) * (1.0 / 3);
    for (int j = 0; j < 3; ++j) {
        strain[j] = dt * (gradient[j] + shift);
    }
    strain[3] = dt * (gradient[3] + gradient[4]);
    spin = 0.5 * dt * (gradient[4] - gradient[3]);
}

/// What varies over a cell at rest is known from its weight, wherever the points are: only the rest is taken
/// from them. `rise` is that of the height with xi and eta, `fullWeight` per volume. With a shared dilatation
/// the mean stress works on the mean dilatation alone.
template <int corners, class Real>
[[gnu::always_inline]] inline FilledStress<corners, Real>
filledStress(const StressSums<Real>& sums, const std::array<Real, 2>& rise, const Real& fullWeight,
             const Real& viscous, bool shared, const std::array<Real, 2>* centre)
{
    using std::max, std::min;
    FilledStress<corners, Real> result;
    result.inverse = 1 / sums.w;
    Real mean[4];
    for (int j = 0; j < 4; ++j) {
        mean[j] = sums.s[j] * result.inverse;
        result.field[0][j] = mean[j];
    }
    if constexpr (corners == 4) {
        const Real zero = shapes::zero<Real>();
        const Real one = zero + 1;
        const Real halfRise = max(max(rise[0], -rise[0]), max(rise[1], -rise[1]));
        // Soil that carries less than half a cell of itself is not at rest.
        const Real push = max(-(mean[1] + viscous), zero + std::numeric_limits<double>::min());
        const Real weight = min(push / halfRise, max(fullWeight, zero));
        const Real ratio = max(zero, min(one, -(mean[0] + viscous) / push));
        const Real known[4] = {ratio * weight, weight, ratio * weight, zero};
        const Real x = sums.wx * result.inverse;
        const Real y = sums.wy * result.inverse;
        const Spread<Real> spread(sums.wxx * result.inverse - x * x, sums.wyy * result.inverse - y * y,
                                  sums.wxy * result.inverse - x * y);
        for (int j = 0; j < 4; ++j) {
            const Real knownXi = known[j] * rise[0];
            const Real knownEta = known[j] * rise[1];
            const Real cx =
                sums.sx[j] * result.inverse - x * mean[j] - knownXi * spread.xx - knownEta * spread.xy;
            const Real cy =
                sums.sy[j] * result.inverse - y * mean[j] - knownXi * spread.xy - knownEta * spread.yy;
            result.field[0][j] -= knownXi * x + knownEta * y;
            result.field[1][j] = spread.slopeXi(cx, cy) + knownXi;
            result.field[2][j] = spread.slopeEta(cx, cy) + knownEta;
            if (centre) { // from that of the points to that of the cell
                result.field[0][j] -= (result.field[1][j] - knownXi) * (x - (*centre)[0]) +
                                      (result.field[2][j] - knownEta) * (y - (*centre)[1]);
            }
        }
        for (int i = 1; shared && i < 3; ++i) {
            const Real third = (result.field[i][0] + result.field[i][1] + result.field[i][2]) * (1.0 / 3);
            for (int j = 0; j < 3; ++j) {
                result.field[i][j] -= third;
            }
        }
        result.xi = x;
        result.eta = y;
        result.shareXi = spread.shareXi();
        result.shareEta = spread.shareEta();
    }
    return result;
}

inline Four stressOf(const MaterialPoints& points, int p)
{
    return four(points.stress[0][p], points.stress[1][p], points.stress[2][p], points.stress[3][p]);
}

/// Fastest wave of soil and liquid without drag between them [m/s]: sqrt of the largest eigenvalue of the
/// stiffness over the densities of the two phases. Drag slows it down to that of the undrained soil at most.
inline double fastWave(const Material& material)
{
    const double n = material.porosity;
    const double storage = material.liquidBulkModulus / n;
    const double liquid = n * material.liquidDensity;
    const double solid = (1 - n) * material.solidDensity;
    const double a = storage * n * n / liquid;
    const double d = (storage * (1 - n) * (1 - n) + material.law->pWaveModulus()) / solid;
    const double bb = storage * n * (1 - n) * storage * n * (1 - n) / (liquid * solid);
    return std::sqrt(0.5 * (a + d) + std::sqrt(0.25 * (a - d) * (a - d) + bb));
}

} // namespace kernels

template <class Shape, int phases>
ExplicitStep<Shape, phases>::ExplicitStep(const Scene& scene, State& state)
    : scene_(scene), threads_(threadsFor(scene.controls.threads, state.points.size())),
      shortest_(threads_.count()), movers_(threads_.count()), statePointers_(threads_.count()),
      locator_(state.mesh)
{
    const BackgroundMesh& mesh = state.mesh;
    const int cells = mesh.cells();
    cellNodes_.resize(mesh.cellNodes.size());
    for (int c = 0; c < cells; ++c) {
        const int first = corners == 4 ? kernels::firstCorner(mesh, c) : 0;
        for (int k = 0; k < corners; ++k) {
            cellNodes_[c * corners + k] = mesh.node(c, (first + k) % corners);
        }
    }
    nodeCorners_.start.assign(mesh.nodes() + 1, 0);
    for (const int i : cellNodes_) {
        ++nodeCorners_.start[i + 1];
    }
    for (int i = 0; i < mesh.nodes(); ++i) {
        nodeCorners_.start[i + 1] += nodeCorners_.start[i];
    }
    nodeCorners_.item.resize(cellNodes_.size());
    std::vector<int> cursor(nodeCorners_.start.begin(), nodeCorners_.start.end() - 1);
    for (int k = 0; k < static_cast<int>(cellNodes_.size()); ++k) {
        nodeCorners_.item[cursor[cellNodes_[k]]++] = k;
    }

    for (const Material& material : scene.materials) {
        density_.push_back(material.inertialDensity());
        largestVolume_.push_back(material.law->plastic()
                                     ? kernels::largestExpansion / material.inertialDensity()
                                     : std::numeric_limits<double>::max());
        gravityShare_.push_back(material.weighingDensity() / material.inertialDensity());
        shearModulus_.push_back(material.law->shearModulus());
        // Projection: the pressure follows, and the soil may leave its liquid behind.
        const double skeleton =
            projects() ? (1 - material.porosity) * material.solidDensity : material.inertialDensity();
        waveSpeed_.push_back(twoPhase && !projects() ? kernels::fastWave(material)
                                                     : std::sqrt(material.law->pWaveModulus() / skeleton));
        solidShare_.push_back(
            twoPhase ? (1 - material.porosity) * material.solidDensity / material.inertialDensity() : 1);
        if constexpr (twoPhase) {
            liquid_.push_back(
                {solidShare_.back() / material.solidDensity, material.liquidDensity,
                 material.liquidBulkModulus, material.liquidViscosity, material.cavitationPressure,
                 material.liquidViscosity / material.intrinsicPermeability, material.kozenyCarman});
        }
    }
    inside_.assign(cells, 0);
    // Surfaces are found where constant/polyMesh has the bodies: the same in a restarted run.
    InputProblems problems;
    BackgroundMesh reference = mesh;
    reference.z = scene.referenceZ;
    for (RigidBody body : state.bodies) {
        body.tipLevel = body.initialTipLevel;
        surfaces_.push_back(findBodySurface(body, reference, problems));
        for (int c = 0; c < cells; ++c) {
            inside_[c] |= surfaces_.back().voidCell[c];
        }
    }
    problems.throwIfAny("the mesh and its bodies");
    contactNode_.assign(mesh.nodes(), 0);
    for (const BodySurface& surface : surfaces_) {
        for (const SurfaceNode& node : surface.nodes) {
            contactNode_[node.node] = 1;
        }
    }

    cells_.resize(cells);
    dilatation_.resize(cells);
    inertiaScale_.resize(cells);
    fullness_.assign(cells, 1);
    for (auto& component : state.points.gradient) {
        component.resize(scene.controls.affine ? state.points.size() : 0, 0);
    }
    pointCentre_.resize(cells);
    byFours_ = mayTakeFours();
    if (scene.controls.fittedWeights) {
        fit_.resize(cells);
        byPartial_.resize(cells);
        partialNode_.resize(mesh.nodes());
    }
    restless_.resize(threads_.count());
    if (scene.controls.mayHaveFemCells()) {
        innerNode_.resize(mesh.nodes());
        boundaryNode_.resize(mesh.nodes());
        for (int k = 0; k < static_cast<int>(mesh.neighbour.size()); ++k) {
            if (mesh.neighbour[k] < 0) {
                boundaryNode_[mesh.cellNodes[k]] = 1;
                boundaryNode_[mesh.cellNodes[k - k % corners + (k + 1) % corners]] = 1;
            }
        }
    }
    cornerSums_.resize(cells * corners);
    nodes_.resize(mesh.nodes());
    looseNode_.resize(mesh.nodes());
    byLoose_.resize(cells);
    traction_.resize(mesh.nodes());
    unitWeight_ = scene.materials.front().liquidDensity * scene.gravity[1];
    surfacePressure_.resize(scene.freeSurfaces.size());
    if (state.points.loaded()) {
        state.points.loadReachR.resize(state.points.size(), 0);
        state.points.loadReachZ.resize(state.points.size(), 0);
    }
    loadedArea_ = loadedAreas(state.points, scene.pointLoads.size(), mesh.geometry);
    pointTraction_.resize(scene.pointLoads.size());
    if (scene.bodyForce.given()) {
        bodyForceR_.resize(state.points.size());
        bodyForceZ_.resize(state.points.size());
        bodyForceRoom_.assign(threads_.count(), scene.bodyForce.workspace());
    }
    if (state.points.loaded() && std::ranges::any_of(scene.pointLoads, [](const PointLoad& load) {
            return load.expression.given();
        })) {
        expressionR_.resize(state.points.size());
        expressionZ_.resize(state.points.size());
        expressionRoom_.resize(threads_.count());
        for (std::vector<PointVector::Workspace>& ofThread : expressionRoom_) {
            for (const PointLoad& load : scene.pointLoads) {
                ofThread.push_back(load.expression.workspace());
            }
        }
    }
    cellRate_.assign(cells, 0);
    if constexpr (twoPhase) {
        liquidCorners_.resize(cells * corners);
        liquidNodes_.resize(mesh.nodes());
        wallArea_.resize(mesh.nodes());
        givenPressure_.assign(mesh.nodes(), std::numeric_limits<double>::quiet_NaN());
        openNodes_ = scene.liquidBoundary.openNodes(mesh);
        waterLoad_.resize(mesh.nodes());
        cellLiquidRate_.assign(cells, 0);
        if (projects()) {
            mobility_.resize(mesh.nodes());
            flowRow_.resize(cellNodes_.size());
            flow_.resize(mesh.nodes());
            storage_.resize(cells);
            pressureStep_.setZero(cells);
        }
        for (const FreeSurface& surface : scene.freeSurfaces) {
            pumped_ = pumped_ || surface.givesFlow();
        }
        if (pumped_) {
            voidForce_.resize(cellNodes_.size());
        }
        state.pumped.resize(scene.freeSurfaces.size(), 0);
        findFreeSurfaces(state);
    }
    if constexpr (twoPhase) {
        for (const LiquidBoundary::Node& liquid : scene.liquidBoundary.nodes()) {
            std::array<bool, 2> held{};
            for (const VelocityConditions::Node& solid : scene.conditions.nodes()) {
                for (int d = 0; solid.node == liquid.node && d < liquid.directions; ++d) {
                    const double along =
                        solid.normal[0] * liquid.normal[d][0] + solid.normal[1] * liquid.normal[d][1];
                    held[d] = held[d] || solid.fixed || std::abs(along) > 0.99;
                }
            }
            solidHeld_.push_back(held);
        }
    }
    if (scene.controls.massScalingBy == SolutionControls::MassScaling::given) {
        state.massScaling = scene.controls.massScaling;
    }
    state.filled.resize(cells, 0);
    state.cellDivergence.resize(cells, 0);
    state.reactions.resize(state.bodies.size());
    impulseBefore_.resize(state.bodies.size());
    for (auto& component : strain_) {
        component.resize(state.points.size());
    }
    spin_.resize(state.points.size());
    for (auto& pointers : statePointers_) {
        pointers.resize(state.points.state.size());
    }
    emptyCells_.resize(cells); // as yet
    std::iota(emptyCells_.begin(), emptyCells_.end(), 0);
    divideCells();
    updateCells(state);
    findBoxCells(mesh);
    boxes_.resize(boxCell_.empty() ? 0 : state.points.size());
    rebuild(state);
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::rebuild(State& state)
{
    if (femSteps_ > 0) {
        wakeFemCells(state);
        updateCells(state);
        relocate(state, false);
    }
    rests_.clear();
    pressureSolver_.forget();
    pressureStep_.setZero();
    pointCells_.index(state.points, state.mesh.cells());
    pointCells_.sort(state.points, threads_);
    occupancyChanged_ = true;
    classifyCells(state);
    scaleInertia(state);
    sortPoints(state);
}

/// Sorts the points, and lets those rest whose cells allow it, until the next time.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sortPoints(State& state)
{
    stepsToSort_ = scene_.controls.sortInterval;
    mergePassedPoints(state);
    if constexpr (isConstantStrain) {
        findStiffestMode(state);
    }
    chooseFemCells(state);
    pointCells_.sort(state.points, threads_, rests_);
    divideCells();
}

/// Where a mesh follows a tip on its way down, soil that has passed its fine rows comes into larger cells,
/// and has more points there than they need.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mergePassedPoints(State& state)
{
    const int most = scene_.controls.passedPointsPerCell;
    if (most == 0 || scene_.movingBody < 0 || state.bodies[scene_.movingBody].velocity >= 0) {
        return;
    }
    const double tip = state.bodies[scene_.movingBody].tipLevel;
    forCells([&](int c) {
        if (pointCells_.count(c) <= most || !state.filled[c]) {
            return;
        }
        for (int k = 0; k < corners; ++k) {
            if (state.mesh.z[cellNodes_[c * corners + k]] < tip) {
                return;
            }
        }
        mergePointsOf(state, c);
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mergePointsOf(State& state, int c)
{
    MaterialPoints& points = state.points;
    const std::size_t most = scene_.controls.passedPointsPerCell;
    const auto range = [&](const std::vector<double>& ofNodes) {
        double low = ofNodes[cellNodes_[c * corners]];
        double high = low;
        for (int k = 1; k < corners; ++k) {
            low = std::min(low, ofNodes[cellNodes_[c * corners + k]]);
            high = std::max(high, ofNodes[cellNodes_[c * corners + k]]);
        }
        return high - low;
    };
    const double width = range(state.mesh.r);
    const double height = range(state.mesh.z);
    std::vector<int> members(pointCells_.begin(c), pointCells_.end(c));
    const auto isLoaded = [&](int p) { return points.loaded() && points.load[p] >= 0; };
    while (members.size() > most) {
        double least = std::numeric_limits<double>::max();
        std::size_t stays = 0, goes = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                const int one = members[i], other = members[j];
                if (points.material[one] != points.material[other] || isLoaded(one) || isLoaded(other)) {
                    continue;
                }
                const double cost = mergingCost(points, one, other, width, height);
                if (cost < least) {
                    least = cost;
                    stays = i;
                    goes = j;
                }
            }
        }
        if (stays == goes) { // none that may
            return;
        }
        std::array<double, 2> poreVolume{};
        if constexpr (twoPhase) {
            for (const auto& [p, own] : {std::pair{members[stays], 0}, std::pair{members[goes], 1}}) {
                poreVolume[own] = porosity(points, p) * points.volume[p];
            }
        }
        mergePoints(points, members[stays], members[goes], poreVolume);
        pointCells_.remove(members[goes], c);
        members.erase(members.begin() + static_cast<std::ptrdiff_t>(goes));
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateCells(const State& state)
{
    const auto update = [&](int c) {
        if (resting(c)) {
            return;
        }
        double r[corners];
        double z[corners];
        for (int k = 0; k < corners; ++k) {
            r[k] = state.mesh.r[cellNodes_[c * corners + k]];
            z[k] = state.mesh.z[cellNodes_[c * corners + k]];
        }
        if constexpr (requires { Shape::isAt(cells_[c], r, z); }) {
            if (Shape::isAt(cells_[c], r, z)) {
                return;
            }
        }
        cells_[c] = Shape::make(r, z);
        dilatation_[c] = Shape::meanDilatation(cells_[c]);
    };
    forAwakeCells(update);
    threads_.share(static_cast<int>(emptyCells_.size()), pointsPerPiece, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            update(emptyCells_[i]);
        }
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::divideCells()
{
    awake_.items.clear();
    std::ranges::copy_if(active_.items, std::back_inserter(awake_.items),
                         [this](int c) { return !resting(c) || !femCells_[femOf_[c]].inner; });
    divide(active_);
    divide(awake_);
    findOuterNodes();
}

/// Those of the cells that are awake, in the order of the cells; inner nodes only while cells rest.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findOuterNodes()
{
    outerNodes_.items.clear();
    outerNodes_.part.assign(1, 0);
    std::vector<unsigned char> found(nodes_.size(), 0);
    for (int part = 0; part < threads_.count(); ++part) {
        for (int j = awake_.part[part]; j < awake_.part[part + 1]; ++j) {
            for (int k = 0; k < corners; ++k) {
                const int i = cellNodes_[awake_.items[j] * corners + k];
                if (!found[i] && (innerNode_.empty() || innerNode_[i] == 0)) {
                    found[i] = 1;
                    outerNodes_.items.push_back(i);
                }
            }
        }
        outerNodes_.part.push_back(static_cast<int>(outerNodes_.items.size()));
    }
}

/// Parts with about as many points in each.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::divide(WorkList& list) const
{
    const auto cost = [this](int c) { return 1 + (resting(c) ? 0 : pointCells_.count(c)); };
    long long total = 0;
    for (const int c : list.items) {
        total += cost(c);
    }
    const int threads = threads_.count();
    list.part.assign(threads + 1, static_cast<int>(list.items.size()));
    long long sum = 0;
    int part = 0;
    for (int i = 0; i < static_cast<int>(list.items.size()); ++i) {
        for (; part < threads && sum * threads >= total * part; ++part) {
            list.part[part] = i;
        }
        sum += cost(list.items[i]);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::classifyCells(State& state)
{
    const int cells = state.mesh.cells();
    const bool sorted = occupancyChanged_;
    if (occupancyChanged_) {
        occupancyChanged_ = false;
        occupied_.assign(cells, 0);
        active_.items.clear();
        for (int c = 0; c < cells; ++c) {
            if (pointCells_.count(c) > 0) {
                occupied_[c] = 1;
                active_.items.push_back(c);
            }
        }
        surfaceNode_.assign(state.mesh.nodes(), 0);
        for (int c = 0; c < cells; ++c) {
            if (!occupied_[c] && !inside_[c]) {
                for (int k = 0; k < corners; ++k) {
                    surfaceNode_[cellNodes_[c * corners + k]] = 1;
                }
            }
        }
        bySurface_.assign(cells, 0);
        activeNode_.assign(state.mesh.nodes(), 0);
        for (const int c : active_.items) {
            for (int k = 0; k < corners; ++k) {
                const int i = cellNodes_[c * corners + k];
                bySurface_[c] |= surfaceNode_[i];
                activeNode_[i] = 1;
            }
        }
        emptyCells_.clear();
        for (int c = 0; c < cells; ++c) {
            if (!occupied_[c]) {
                emptyCells_.push_back(c);
            }
        }
        activeNodes_.clear();
        for (int i = 0; i < state.mesh.nodes(); ++i) {
            if (activeNode_[i]) {
                activeNodes_.push_back(i);
            }
        }
        if constexpr (twoPhase) {
            voidCells_.clear();
            for (int c = 0; c < cells; ++c) {
                bool beside = false;
                for (int k = 0; k < corners; ++k) {
                    beside = beside || activeNode_[cellNodes_[c * corners + k]];
                }
                if (beside && !occupied_[c] && !inside_[c] && freeSurface_[c] >= 0) {
                    voidCells_.push_back(c);
                }
            }
        }
        // Sums of cells that went empty must not linger.
        for (int c = 0; c < cells; ++c) {
            if (!occupied_[c]) {
                state.filled[c] = 0;
                const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(c) * corners;
                std::fill_n(cornerSums_.begin() + first, corners, Corner{});
                if constexpr (twoPhase) {
                    std::fill_n(liquidCorners_.begin() + first, corners, LiquidCorner{});
                    if (pumped_) {
                        std::fill_n(voidForce_.begin() + first, corners, std::array<double, 2>{});
                    }
                }
            }
        }
    }
    if (sorted) {
        divideCells();
    }
    const bool mixed = scene_.controls.integration == SolutionControls::Integration::mixed;
    forAwakeCells([&](int c) {
        if (resting(c)) {
            return;
        }
        bool filled = mixed && !bySurface_[c] && !inBoxes(c);
        if (filled) {
            double volume = 0;
            for (const int* p = pointCells_.begin(c); p != pointCells_.end(c); ++p) {
                volume += state.points.volume[*p];
            }
            filled = volume >
                     (state.filled[c] ? kernels::leastFill : kernels::leastFill + kernels::fillHysteresis) *
                         dilatation_[c].volume;
        }
        state.filled[c] = filled;
    });
    if (!fit_.empty()) {
        findPartialNodes(state);
    }
}

/// Beside cells that count their points as they are, the others do so too: nodes must not weigh points of one
/// row in two ways.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findPartialNodes(const State& state)
{
    std::ranges::fill(partialNode_, 0);
    for (const int c : active_.items) {
        for (int k = 0; !state.filled[c] && k < corners; ++k) {
            partialNode_[cellNodes_[c * corners + k]] = 1;
        }
    }
    forCells([&](int c) {
        byPartial_[c] = 0;
        for (int k = 0; k < corners; ++k) {
            byPartial_[c] |= partialNode_[cellNodes_[c * corners + k]];
        }
    });
}

/// The points of a filled cell as the samples of a quadrature that is exact for linear functions: the centre
/// of their volumes is moved to that of the cell's. No weight changes by more than nine tenths.
template <class Shape, int phases>
kernels::Fit ExplicitStep<Shape, phases>::fitWeights(const State& state, int c) const
{
    constexpr double largestChange = 0.9;
    kernels::Fit fit;
    if constexpr (corners == 4) {
        const MaterialPoints& points = state.points;
        double w = 0, wx = 0, wy = 0, wxx = 0, wyy = 0, wxy = 0;
        double left = 1, right = -1, low = 1, high = -1;
        for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
            const auto [x, y] = Shape::local(cells_[c], points.r[*i], points.z[*i]);
            const double v = points.volume[*i];
            w += v;
            wx += v * x;
            wy += v * y;
            wxx += v * x * x;
            wyy += v * y * y;
            wxy += v * x * y;
            left = std::min(left, x);
            right = std::max(right, x);
            low = std::min(low, y);
            high = std::max(high, y);
        }
        fit.xi = wx / w;
        fit.eta = wy / w;
        const kernels::Spread spread(wxx / w - fit.xi * fit.xi, wyy / w - fit.eta * fit.eta,
                                     wxy / w - fit.xi * fit.eta);
        const double cx = Shape::moments(cells_[c]).xiCentre - fit.xi;
        const double cy = -fit.eta;
        fit.slopeXi = spread.slopeXi(cx, cy);
        fit.slopeEta = spread.slopeEta(cx, cy);
        const double change = std::abs(fit.slopeXi) * std::max(right - fit.xi, fit.xi - left) +
                              std::abs(fit.slopeEta) * std::max(high - fit.eta, fit.eta - low);
        if (change > largestChange) {
            fit.slopeXi *= largestChange / change;
            fit.slopeEta *= largestChange / change;
        }
    }
    return fit;
}

template <class Shape, int phases>
double ExplicitStep<Shape, phases>::fastestWave(const State& state, int c) const
{
    if (waveSpeed_.size() == 1) {
        return waveSpeed_[0];
    }
    double speed = 0;
    for (const int* p = pointCells_.begin(c); p != pointCells_.end(c); ++p) {
        speed = std::max(speed, waveSpeed_[state.points.material[*p]]);
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

template <class Shape, int phases>
CellCounts ExplicitStep<Shape, phases>::cellCounts(const State& state) const
{
    CellCounts counts;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (inside_[c]) {
            ++counts.inside;
        } else if (!occupied_[c]) {
            ++counts.empty;
        } else if (resting(static_cast<int>(c))) {
            ++counts.fem;
        } else if (state.filled[c]) {
            ++counts.filled;
        } else {
            ++counts.partial;
        }
    }
    return counts;
}

template <class Shape, int phases>
std::string ExplicitStep<Shape, phases>::description() const
{
    const SolutionControls& controls = scene_.controls;
    std::string words = twoPhase ? "two-phase (v-w), " : "one-phase, ";
    words += axisymmetric ? "axisymmetric" : "plane strain";
    words += corners == 3 ? ", triangles" : ", quadrilaterals";
    if (twoPhase) {
        words += controls.drag == SolutionControls::Drag::implicit ? ", implicit drag" : ", lagged drag";
    }
    words +=
        controls.integration == SolutionControls::Integration::mixed ? ", mixed integration" : ", points";
    words += controls.locking == SolutionControls::Locking::none             ? ""
             : controls.locking == SolutionControls::Locking::meanDilatation ? ", mean dilatation"
                                                                             : ", nodal dilatation";
    words += boxCell_.empty() ? "" : ", boxes of " + text("%g", controls.boxWidth) + " cells";
    words += controls.fittedWeights ? ", fitted weights" : "";
    words += controls.mayHaveFemCells() && !scene_.bodyForce.given() ? ", FEM cells" : "";
    words += scene_.bodyForce.given() ? ", body force" : "";
    words += projects() ? ", projection" : "";
#if defined(__AVX512F__)
    words += ", AVX-512";
#elif defined(__AVX2__)
    words += ", AVX2";
#endif
    words += threads_.count() == 1 ? ", 1 thread" : ", " + std::to_string(threads_.count()) + " threads";
    return words;
}

// ---------------------------------------------------------------------------------------------------------

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::advance(State& state, double dt)
{
    updateSurfacePressures(state);
    if (state.step == 0) {
        staggerStrain(state, dt);
    }
    if (scene_.bodyForce.given() || !expressionR_.empty()) {
        evaluateExpressions(state, dt);
    }
    moveBodies(state, dt);
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        impulseBefore_[b] = state.reactions[b].totalVerticalImpulse();
    }
    mapToNodes(state);
    solveNodes(state, dt);
    if (femSteps_ > 0) {
        solveInnerNodes(dt);
    }
    if constexpr (twoPhase) {
        if (projects()) {
            project(state, dt);
        }
        if (pumped_) {
            pump(state, dt);
        }
    }
    for (std::size_t b = 0; b < wallWater_.size(); ++b) {
        state.reactions[b].waterImpulse += dt * wallWater_[b];
        state.reactions[b].work -= dt * wallWater_[b] * state.bodies[b].velocity;
    }
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        state.reactions[b].force = (state.reactions[b].totalVerticalImpulse() - impulseBefore_[b]) / dt;
    }
    if (!femCells_.empty()) {
        accumulateFemNodes(dt);
    }
    mapToPoints(state, dt);
    if constexpr (twoPhase) {
        if (scene_.controls.checkerboardFilter > 0 && state.step % filterInterval == 0) {
            filterPressures(state);
        }
    }
    updateStress(state, false);
    if (!femCells_.empty()) {
        updateFemCells(state, dt);
    }
    const bool sorts =
        --stepsToSort_ == 0 || std::ranges::any_of(restless_, [](unsigned char is) { return is != 0; });
    if (sorts) {
        pressureSolver_.forget(); // its matrix grows old
        wakeFemCells(state);
    }
    moveBodiesAndMesh(state, dt);
    relocate(state, sorts);
    state.time += dt;
    state.timeStep = dt;
    ++state.step;
    if (scene_.controls.massScalingBy == SolutionControls::MassScaling::gates) {
        if (state.step % massScalingInterval == 0) {
            state.massScaling = adaptedMassScaling(scene_, state);
            scaleInertia(state);
        }
    } else if (scene_.controls.scaleSmallCells) {
        scaleInertia(state);
    }
    threads_.lap(!sorts);
}

/// Velocities of the bodies: as prescribed, or by Newton's law with the reaction of the last step.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::moveBodies(State& state, double dt)
{
    const double whole = axisymmetric ? 2 * std::numbers::pi : 1.0;
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        RigidBody& body = state.bodies[b];
        state.reactions[b].duration += dt;
        state.reactions[b].suction = suction(body);
        if (!body.loadControlled) {
            body.velocity = body.prescribedVelocity(state.time + dt);
            continue;
        }
        const double force = whole * state.reactions[b].force - body.drivingLoad(state.time) -
                             state.reactions[b].suction * body.enclosedArea(axisymmetric);
        body.velocity += dt * force / body.mass;
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateSurfacePressures(const State& state)
{
    for (std::size_t s = 0; s < surfacePressure_.size(); ++s) {
        surfacePressure_[s] = excessPressure(scene_.freeSurfaces[s], state.bodies, state.time, unitWeight_) +
                              (twoPhase ? state.pumped[s] : 0.0);
    }
}

/// What the water within a body pulls it down by: the pressure outside less that inside [Pa].
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::suction(const RigidBody& body) const
{
    double inside = 0;
    double outside = 0;
    for (std::size_t s = surfacePressure_.size(); s-- > 0;) { // the first that holds counts
        const FreeSurface& surface = scene_.freeSurfaces[s];
        if (surface.region == FreeSurface::Region::all) {
            inside = outside = surfacePressure_[s];
        } else if (surface.body == body.name) {
            (surface.region == FreeSurface::Region::inside ? inside : outside) = surfacePressure_[s];
        }
    }
    return outside - inside;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateWallAreas(const State& state)
{
    for (BodySurface& surface : surfaces_) {
        updateAreas(surface, state.mesh);
        for (const SurfaceNode& contact : surface.nodes) {
            std::array<double, 2>& area = wallArea_[contact.node];
            area = {};
            for (int f = 0; f < contact.faces; ++f) {
                area[0] += contact.area[f] * contact.normal[f][0];
                area[1] += contact.area[f] * contact.normal[f][1];
            }
        }
    }
}

/// Drained soil in seepage bears the integral of -grad p: that of p B over its cells, with p as mean and
/// slopes from the nodes, less what patches and walls bear. Voids above the soil are filled with water of the
/// pressure that the nodes of its surface have.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::setSeepage(const State& state, const std::vector<double>& excess)
{
    seepage_ = excess;
    waterLoad_.assign(state.mesh.nodes(), {});
    wallArea_.resize(state.mesh.nodes());
    wallWater_.assign(state.bodies.size(), 0);
    for (int c = 0; c < state.mesh.cells(); ++c) {
        if (inside_[c]) {
            continue;
        }
        double p[corners];
        for (int k = 0; k < corners; ++k) {
            p[k] = excess[cellNodes_[c * corners + k]];
        }
        if (!occupied_[c]) {
            double ofSurface = 0;
            for (int k = 0; k < corners; ++k) {
                ofSurface = activeNode_[cellNodes_[c * corners + k]] ? p[k] : ofSurface;
            }
            std::fill_n(p, corners, ofSurface);
        }
        const auto& m = Shape::moments(cells_[c]);
        double part[3] = {}; // mean and slopes
        for (int k = 0; k < corners; ++k) {
            part[0] += m.n[k] * p[k];
        }
        if constexpr (corners == 4) {
            part[1] = 0.25 * (-p[0] + p[1] + p[2] - p[3]);
            part[2] = 0.25 * (-p[0] - p[1] + p[2] + p[3]);
        }
        for (int k = 0; k < corners; ++k) {
            std::array<double, 2>& load = waterLoad_[cellNodes_[c * corners + k]];
            for (int j = 0; j < shapes::Moments<corners>::count; ++j) {
                load[0] += m.volume * part[j] * (m.gr[j][k] + m.h[j][k]);
                load[1] += m.volume * part[j] * m.gz[j][k];
            }
        }
    }
    if (scene_.liquidBoundary.hasPressures()) {
        scene_.liquidBoundary.addPressures(state.mesh, state.time, unitWeight_, waterLoad_);
    }
    updateWallAreas(state);
    for (std::size_t b = 0; b < surfaces_.size(); ++b) {
        for (const SurfaceNode& contact : surfaces_[b].nodes) {
            const int i = contact.node;
            if (activeNode_[i]) {
                waterLoad_[i][0] += excess[i] * wallArea_[i][0];
                waterLoad_[i][1] += excess[i] * wallArea_[i][1];
                wallWater_[b] -= excess[i] * wallArea_[i][1];
            }
        }
    }
}

/// Stresses are half a step ahead of the velocities that they accelerate (leap-frog). At the start both are
/// given at the same time: soil that moves then is strained by half a step first, without which the phase of
/// every vibration is off by half a step and the whole scheme first order in time.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::staggerStrain(State& state, double dt)
{
    mapToNodes(state);
    solveNodes(state, 0);
    bool moving = false;
    for (const int i : activeNodes_) {
        moving = moving || nodes_[i].vr != 0 || nodes_[i].vz != 0;
        nodes_[i].placeVr = nodes_[i].placeVz = 0; // places stay
    }
    for (BodyReaction& reaction : state.reactions) {
        reaction.work = 0;
        reaction.restartCollection();
    }
    if (!moving) {
        return;
    }
    if (scene_.controls.locking == SolutionControls::Locking::nodalAverage) {
        averageDilatationAtNodes();
    }
    forCells([&](int c) {
        if constexpr (hasBoxes) {
            if (inBoxes(c)) {
                strainBoxPoints(state, 0.5 * dt, c);
                return;
            }
        }
        mapCellToPoints<false, true>(state, 0.5 * dt, c);
    });
    updateStress(state, false);
    updateStress(state, true);
}

/// What the velocity of a point becomes at a corner of its cell, less what it is at the point [m/s].
template <class Shape, int phases>
std::array<double, 2> ExplicitStep<Shape, phases>::affineVelocity(const State& state, int p, int corner) const
{
    const MaterialPoints& points = state.points;
    const double r = state.mesh.r[cellNodes_[corner]] - points.r[p];
    const double z = state.mesh.z[cellNodes_[corner]] - points.z[p];
    return {points.gradient[0][p] * r + points.gradient[1][p] * z,
            points.gradient[2][p] * r + points.gradient[3][p] * z};
}

/// Bulk viscosity [von Neumann & Richtmyer 1950], with Landshoff's linear term; the quadratic one in
/// compression only [Pa].
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::viscousStress(const State& state, int c, int material) const
{
    const SolutionControls& controls = scene_.controls;
    if (controls.linearBulkViscosity == 0 && controls.quadraticBulkViscosity == 0) {
        return 0;
    }
    const double rate = state.cellDivergence[c];
    const double size = Shape::size(cells_[c]);
    double stress = density_[material] * size * controls.linearBulkViscosity * waveSpeed_[material] * rate;
    if (rate < 0) {
        const double quadratic = controls.quadraticBulkViscosity * size * rate;
        stress -= density_[material] * quadratic * quadratic;
    }
    return stress;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sumPoints(const State& state, int c, kernels::StressSums<double>& sums)
{
    const MaterialPoints& points = state.points;
    const typename Shape::Cell& cell = cells_[c];
    const bool meanDilatation = scene_.controls.locking == SolutionControls::Locking::meanDilatation;
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);

    std::array<Four, corners> inertia; // mass, momenta, weight over gravity
    inertia.fill(0);
    Values values;
    const bool affine = points.affine();
    const bool fitted = fits(c) && state.filled[c] != 0;
    const kernels::Fit fit = fitted ? fitWeights(state, c) : kernels::Fit{};
    if (!fit_.empty()) {
        fit_[c] = fit;
    }
    const auto addInertiaAndWeight = [&](int p, double x, double y) {
        const double pointMass = fitted ? fit.at(x, y) * points.mass[p] : points.mass[p];
        const double m = twoPhase ? pointMass * solidShare_[points.material[p]] : pointMass;
        const Four ofPoint =
            four(m, m * points.vr[p], m * points.vz[p], pointMass * gravityShare_[points.material[p]]);
        for (int k = 0; k < corners; ++k) {
            inertia[k] += values.N[k] * ofPoint;
        }
        for (int k = 0; affine && k < corners; ++k) {
            const auto [r, z] = affineVelocity(state, p, c * corners + k);
            inertia[k] += values.N[k] * m * four(0, r, z, 0);
        }
    };

    double forceR[corners] = {}; // of the stress
    double forceZ[corners] = {};
    if (state.filled[c]) {
        sums = {};
        Four stressSum = 0, ofXi = 0, ofEta = 0;
        for (const int* i = first; i != last; ++i) {
            const int p = *i;
            const auto [x, y] = Shape::evaluate(cell, points.r[p], points.z[p], values);
            addInertiaAndWeight(p, x, y);
            const double v = points.volume[p];
            const Four ofPoint = v * kernels::stressOf(points, p);
            sums.w += v;
            stressSum += ofPoint;
            if constexpr (corners == 4) {
                const double vx = v * x;
                const double vy = v * y;
                sums.wx += vx;
                sums.wy += vy;
                sums.wxx += vx * x;
                sums.wyy += vy * y;
                sums.wxy += vx * y;
                ofXi += x * ofPoint;
                ofEta += y * ofPoint;
            }
        }
        setFour(sums.s[0], stressSum);
        setFour(sums.sx[0], ofXi);
        setFour(sums.sy[0], ofEta);
        fullness_[c] = dilatation_[c].volume / sums.w;
    } else {
        fullness_[c] = 1;
        double br[corners] = {};
        double bz[corners] = {};
        double volume = 0;
        double pressureVolume = 0;
        const double viscousStress = this->viscousStress(state, c, points.material[*first]);
        for (const int* i = first; i != last; ++i) {
            const int p = *i;
            Shape::evaluate(cell, points.r[p], points.z[p], values);
            addInertiaAndWeight(p, 0, 0);
            const double v = points.volume[p];
            double stress[4];
            for (int j = 0; j < 4; ++j) {
                stress[j] = points.stress[j][p] + (j < 3 ? viscousStress : 0);
            }
            const double inverseR = axisymmetric ? 1 / std::max(points.r[p], kernels::smallestRadius) : 0;
            if (meanDilatation) {
                const double mean = (stress[0] + stress[1] + stress[2]) / 3;
                stress[0] -= mean;
                stress[1] -= mean;
                stress[2] -= mean;
                pressureVolume += v * mean;
                volume += v;
                for (int k = 0; k < corners; ++k) {
                    br[k] += v * (values.dr[k] + values.N[k] * inverseR);
                    bz[k] += v * values.dz[k];
                }
            }
            for (int k = 0; k < corners; ++k) {
                forceR[k] -= v * (stress[0] * values.dr[k] + stress[3] * values.dz[k] +
                                  stress[2] * values.N[k] * inverseR);
                forceZ[k] -= v * (stress[1] * values.dz[k] + stress[3] * values.dr[k]);
            }
        }
        if (meanDilatation) {
            const double meanStress = pressureVolume / volume;
            for (int k = 0; k < corners; ++k) {
                forceR[k] -= meanStress * br[k];
                forceZ[k] -= meanStress * bz[k];
            }
        }
    }

    const std::array<double, corners> share = Shape::cornerShares(cell);
    const double scale = inertiaScale_[c] * fullness_[c];
    const double gravityR = scene_.gravity[0] * fullness_[c];
    const double gravityZ = scene_.gravity[1] * fullness_[c];
    const double fullMass = inertiaScale_[c] * density_[points.material[*first]] *
                            (twoPhase ? solidShare_[points.material[*first]] : 1.0) * dilatation_[c].volume;
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        const double weight = inertia[k][3];
        setFour(out[k].mass, scale * inertia[k]);
        out[k].fullMass = fullMass * share[k];
        out[k].forceR = forceR[k] + gravityR * weight;
        out[k].forceZ = forceZ[k] + gravityZ * weight;
    }
}

/// What the shape needs of `count` cells; of the last one again where they are fewer than the lanes.
template <class Shape, int phases>
template <class Real>
auto ExplicitStep<Shape, phases>::cellLanes(const int* cells, int count) const
{
    if constexpr (std::is_same_v<Real, double>) {
        return cells_[*cells];
    } else {
        std::array<Four, 4> corner, sides; // r0, z0, dr, dz; dr, dz and 1 over them
        for (int l = 0; l < 4; ++l) {
            const typename Shape::Cell& cell = cells_[cells[std::min(l, count - 1)]];
            corner[l] = Four(&cell.r0, std::experimental::element_aligned);
            sides[l] = Four(&cell.dr, std::experimental::element_aligned);
        }
        transpose(corner);
        transpose(sides);
        return typename Shape::template Sides<Real>{corner[0], corner[1], sides[0],
                                                    sides[1],  sides[2],  sides[3]};
    }
}

/// Puts the stress of `count` filled cells on their corners.
template <class Shape, int phases>
template <class Real>
void ExplicitStep<Shape, phases>::addStress(const State& state, const int* cells, int count,
                                            const kernels::StressSums<double>* sums)
{
    const SolutionControls& controls = scene_.controls;
    const MaterialPoints& points = state.points;
    const auto material = [&](int l) { return points.material[*pointCells_.begin(cells[l])]; };
    Real fullWeight = shapes::zero<Real>();
    Real viscous = shapes::zero<Real>();
    for (int l = 0; l < count; ++l) {
        shapes::setLane(fullWeight, l,
                        -scene_.gravity[1] * gravityShare_[material(l)] * density_[material(l)]);
        if (controls.linearBulkViscosity != 0 || controls.quadraticBulkViscosity != 0) {
            shapes::setLane(viscous, l, viscousStress(state, cells[l], material(l)));
        }
    }
    const auto cell = cellLanes<Real>(cells, count);
    std::array<Real, 2> centre{};
    bool atCentre = false;
    if constexpr (corners == 4 && std::is_same_v<Real, double>) {
        atCentre = fits(*cells);
        centre[0] = atCentre ? Shape::moments(cell).xiCentre : 0;
    }
    std::array<Real, 2> rise{};
    if constexpr (corners == 4) {
        rise = Shape::heightSlopes(cell);
    }
    auto stress = kernels::filledStress<corners, Real>(
        kernels::StressSums<Real>::of(sums, count), rise, fullWeight, viscous,
        controls.locking == SolutionControls::Locking::meanDilatation, atCentre ? &centre : nullptr);
    for (int l = 0; l < count; ++l) {
        const int c = cells[l];
        if constexpr (corners == 4) {
            pointCentre_[c] = {shapes::lane(stress.xi, l), shapes::lane(stress.eta, l)};
        }
        for (int i = 0; resting(c) && i < momentCount; ++i) {
            auto& to = i == 0 ? fem_.stress : i == 1 ? fem_.slopeXi : fem_.slopeEta;
            for (int j = 0; j < 4; ++j) {
                to[j][femOf_[c]] = shapes::lane(stress.field[i][j], l);
            }
            fem_.shareXi[femOf_[c]] = shapes::lane(stress.shareXi, l);
            fem_.shareEta[femOf_[c]] = shapes::lane(stress.shareEta, l);
        }
    }
    for (int j = 0; j < 3; ++j) {
        stress.field[0][j] += viscous;
    }
    Real forceR[corners], forceZ[corners];
    std::fill_n(forceR, corners, shapes::zero<Real>());
    std::fill_n(forceZ, corners, shapes::zero<Real>());
    Shape::addForces(cell, stress.field, forceR, forceZ);
    for (int k = 0; k < corners; ++k) {
        if constexpr (std::is_same_v<Real, Four>) {
            std::array<Four, 4> rows{forceR[k], forceZ[k], 0, 0};
            transpose(rows);
            for (int l = 0; l < count; ++l) {
                Corner& corner = cornerSums_[cells[l] * corners + k];
                setFour(corner.forceR, fourFrom(corner.forceR) + rows[l]);
            }
        } else {
            cornerSums_[*cells * corners + k].forceR += forceR[k];
            cornerSums_[*cells * corners + k].forceZ += forceZ[k];
        }
    }
}

/// Force of the traction on a point now [N/rad or N/m].
template <class Shape, int phases>
std::array<double, 2> ExplicitStep<Shape, phases>::pointLoad(const MaterialPoints& points, int p) const
{
    const int load = points.load[p];
    const double growth = scene_.pointLoads[load].areaFollows ? points.r[p] / points.initialR[p] : 1.0;
    const double area = growth * points.loadArea[p];
    if (scene_.pointLoads[load].expression.given()) {
        return {area * expressionR_[p], area * expressionZ_[p]};
    }
    return {area * pointTraction_[load][0], area * pointTraction_[load][1]};
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addPointLoads(const State& state, int c)
{
    const MaterialPoints& points = state.points;
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        if (points.load[p] < 0) {
            continue;
        }
        const std::array<double, 2> force = pointLoad(points, p);
        // At the surface, which moves away from the point as the point grows. Shape functions of the point's
        // own cell, beyond its side where need be, have the moments of the force.
        const double first =
            points.mass[p] / density_[points.material[p]] / (axisymmetric ? points.initialR[p] : 1.0);
        const double stretch = std::sqrt(points.volume[p] / (axisymmetric ? points.r[p] : 1.0) / first);
        Shape::evaluate(cells_[c], points.r[p] + stretch * points.loadReachR[p],
                        points.z[p] + stretch * points.loadReachZ[p], values);
        for (int k = 0; k < corners; ++k) {
            cornerSums_[c * corners + k].forceR += values.N[k] * force[0];
            cornerSums_[c * corners + k].forceZ += values.N[k] * force[1];
        }
    }
}

/// What the expressions are at the points. What takes the velocities over a step are the forces in its
/// middle.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::evaluateExpressions(const State& state, double dt)
{
    const MaterialPoints& points = state.points;
    const double time = state.time + 0.5 * dt;
    const double lead = 0.5 * dt;
    threads_.share(static_cast<int>(points.size()), pointsPerPiece, [&](int thread, int begin, int end) {
        if (scene_.bodyForce.given()) {
            scene_.bodyForce.evaluate(points, begin, end, time, lead, bodyForceR_.data() + begin,
                                      bodyForceZ_.data() + begin, bodyForceRoom_[thread]);
        }
        for (int p = begin; p < end && !expressionR_.empty(); ++p) {
            const int load = points.load[p];
            if (load >= 0 && scene_.pointLoads[load].expression.given()) {
                scene_.pointLoads[load].expression.evaluate(points, p, p + 1, time, lead, &expressionR_[p],
                                                            &expressionZ_[p], expressionRoom_[thread][load]);
            }
        }
    });
}

/// As weight: on the true mass, not on scaled inertia; in filled cells on that of the whole cell.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addBodyForce(const State& state, int c)
{
    const MaterialPoints& points = state.points;
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        const auto [x, y] = Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        const double mass = fullness_[c] * points.mass[p] * (fit_.empty() ? 1.0 : fit_[c].at(x, y));
        for (int k = 0; k < corners; ++k) {
            cornerSums_[c * corners + k].forceR += values.N[k] * mass * bodyForceR_[p];
            cornerSums_[c * corners + k].forceZ += values.N[k] * mass * bodyForceZ_[p];
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapToNodes(State& state)
{
    if constexpr (twoPhase) {
        wallTouches_.clear();
        prepareLiquid(state);
        for (const int c : voidCells_) {
            mapVoidToNodes(c);
        }
    }
    const bool loaded = state.points.loaded();
    for (std::size_t l = 0; loaded && l < pointTraction_.size(); ++l) {
        if (!scene_.pointLoads[l].expression.given()) {
            pointTraction_[l] = scene_.pointLoads[l].traction(state.time, loadedArea_[l]);
        }
    }
    if constexpr (hasBoxes) {
        if (!boxCell_.empty()) {
            makeBoxes(state);
        }
    }
    const bool asElements = femSteps_ > 0;
    if (asElements) {
        mapFemCellsToNodes(state);
    }
    const auto finish = [&](int c) {
        if constexpr (twoPhase) {
            mapLiquidToNodes(state, c);
        }
        if (resting(c)) {
            sampleFemCell(c);
        }
        if (loaded) {
            addPointLoads(state, c);
        }
        if (scene_.bodyForce.given()) {
            addBodyForce(state, c);
        }
    };
    const auto mapCell = [&](int c) {
        if (asElements && resting(c)) {
            return;
        }
        if constexpr (hasBoxes) {
            if (inBoxes(c)) {
                mapBoxCellToNodes(state, c);
                return;
            }
        }
        kernels::StressSums<double> sums;
        sumPoints(state, c, sums);
        if (state.filled[c]) {
            addStress<double>(state, &c, 1, &sums);
        }
        finish(c);
    };
    const WorkList& list = asElements ? awake_ : active_;
    if constexpr (hasFours) {
        const auto mayJoin = [&](int c) { return state.filled[c] != 0 && !(asElements && resting(c)); };
        forPieces(list, mayJoin, mapCell, [&](std::span<const int> cells) {
            std::array<kernels::StressSums<double>, cellsPerPiece> sums;
            for (std::size_t j = 0; j < cells.size(); ++j) {
                sumPoints(state, cells[j], sums[j]);
            }
            for (std::size_t j = 0; j < cells.size(); j += 4) {
                addStress<Four>(state, &cells[j],
                                static_cast<int>(std::min<std::size_t>(4, cells.size() - j)), &sums[j]);
            }
            std::ranges::for_each(cells, finish);
        });
    } else {
        forItemsOf(list, mapCell);
    }
    if (scene_.conditions.hasTractions()) {
        std::ranges::fill(traction_, std::array<double, 2>{});
        scene_.conditions.addTractions(state.mesh, state.time, traction_);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::solveNodes(State& state, double dt)
{
    const double damping = scene_.controls.localDamping;
    const bool tractions = scene_.conditions.hasTractions();
    const bool seepage = !twoPhase && !seepage_.empty();
    const auto solve = [&](int i) {
        Corner sum = gather(cornerSums_, i);
        Node& node = nodes_[i];
        node.mass = sum.mass;
        looseNode_[i] = surfaceNode_[i] != 0 || sum.mass < kernels::looseShare * sum.fullMass;
        if (sum.mass <= 0) {
            node = Node{};
            if constexpr (twoPhase) {
                liquidNodes_[i] = LiquidNode{};
            }
            return;
        }
        if (tractions) {
            sum.forceR += traction_[i][0];
            sum.forceZ += traction_[i][1];
        }
        if (seepage) {
            sum.forceR += waterLoad_[i][0];
            sum.forceZ += waterLoad_[i][1];
        }
        if constexpr (twoPhase) {
            solveTwoPhaseNode(i, sum, gather(liquidCorners_, i), dt);
            return;
        }
        const double inverse = 1 / sum.mass;
        const double oldR = sum.momentumR * inverse;
        const double oldZ = sum.momentumZ * inverse;
        if (damping > 0 &&
            !contactNode_[i]) { // Cundall 1987: opposes the motion with a share of the out-of-balance force
            sum.forceR -= std::copysign(damping * std::abs(sum.forceR), oldR);
            sum.forceZ -= std::copysign(damping * std::abs(sum.forceZ), oldZ);
        }
        node.dvr = dt * sum.forceR * inverse;
        node.dvz = dt * sum.forceZ * inverse;
        node.vr = oldR + node.dvr;
        node.vz = oldZ + node.dvz;
        node.placeVr = oldR + 0.5 * node.dvr;
        node.placeVz = oldZ + 0.5 * node.dvz;
    };
    if (femSteps_ > 0 || femCells_.empty()) {
        forItemsOf(outerNodes_, solve);
    } else { // the inner ones begin as the others
        forNodes(solve);
    }
    if constexpr (twoPhase) { // a held direction wins over a body's, in velocity and drag
        applyContact(state, dt, false);
        applyConditions(state.time + dt, false);
    } else {
        applyConditions(state.time + dt, false);
        applyContact(state, dt, false);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::applyConditions(double time, bool remapped)
{
    for (const VelocityConditions::Node& condition : scene_.conditions.nodes()) {
        Node& node = nodes_[condition.node];
        if (node.mass <= 0) {
            continue;
        }
        double changeR;
        double changeZ;
        if (condition.fixed) {
            std::array<double, 3> value{};
            if (condition.value) {
                value = condition.value->value(time);
            }
            changeR = value[0] - node.vr;
            changeZ = value[2] - node.vz;
        } else {
            const auto& n = condition.normal;
            const double along = node.vr * n[0] + node.vz * n[1];
            changeR = -along * n[0];
            changeZ = -along * n[1];
        }
        node.vr += changeR;
        node.vz += changeZ;
        if (!remapped) {
            if constexpr (twoPhase) {
                if (condition.fixed) {
                    solveLiquidAgain(condition.node, {1, 0});
                    solveLiquidAgain(condition.node, {0, 1});
                } else {
                    solveLiquidAgain(condition.node, condition.normal);
                }
            }
            node.dvr += changeR;
            node.dvz += changeZ;
            if (condition.fixed) {
                node.placeVr = node.vr;
                node.placeVz = node.vz;
            } else { // what is held moves with the new velocity, which is zero along the normal
                const auto& n = condition.normal;
                const double along = node.placeVr * n[0] + node.placeVz * n[1];
                node.placeVr -= along * n[0];
                node.placeVz -= along * n[1];
            }
        }
    }
    if constexpr (twoPhase) {
        applyLiquidConditions(time, remapped);
    }
}

/// touch(normal, part, vertical velocity of the wall, area) for the faces of a body that a node has. At the
/// tip's corner as the body's TipCorner says.
template <class Shape, int phases>
template <class Touch>
void ExplicitStep<Shape, phases>::touchFaces(const RigidBody& body, const SurfaceNode& contact,
                                             const Touch& touch) const
{
    const bool tipCorner = contact.faces == 2 && contact.part[0] == SurfacePart::tip;
    if (!tipCorner || body.tipCorner == TipCorner::full) {
        for (int f = 0; f < contact.faces; ++f) {
            touch(contact.normal[f], contact.part[f], body.velocity, contact.area[f]);
        }
    } else if (body.tipCorner == TipCorner::rounded) {
        touch(contact.roundedNormal, contact.part[0], body.velocity, contact.area[0]);
    } else {
        const double w = contact.tipShare;
        const double besideVz = contact.beside >= 0 && nodes_[contact.beside].mass > 0
                                    ? nodes_[contact.beside].vz
                                    : body.velocity;
        touch(contact.normal[0], contact.part[0], w * body.velocity + (1 - w) * besideVz, contact.area[0]);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::applyContact(State& state, double dt, bool remapped)
{
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        const RigidBody& body = state.bodies[b];
        BodyReaction& reaction = state.reactions[b];
        if (body.adhesion > 0 && !twoPhase) { // of two phases they are up to date already
            updateAreas(surfaces_[b], state.mesh);
        }
        for (const SurfaceNode& contact : surfaces_[b].nodes) {
            Node& node = nodes_[contact.node];
            if (node.mass <= 0) {
                continue;
            }
            if constexpr (twoPhase) {
                touchTwoPhase(body, reaction, contact, dt, remapped);
                continue;
            }
            const auto touch = [&](const std::array<double, 2>& n, SurfacePart part, double bodyVz,
                                   double area) {
                const double slipR = node.vr;
                const double slipZ = node.vz - bodyVz;
                const double approach = slipR * n[0] + slipZ * n[1];
                if (approach >= 0) {
                    return;
                }
                // Normal part to zero; friction takes from the slip what mu times the normal impulse can.
                const double slipTr = slipR - approach * n[0];
                const double slipTz = slipZ - approach * n[1];
                const double slip = std::hypot(slipTr, slipTz);
                const double limit = body.friction * -approach + body.adhesion * area * dt / node.mass;
                const double share = slip > limit ? limit / slip : 1.0;
                const double changeR = -approach * n[0] - share * slipTr;
                const double changeZ = -approach * n[1] - share * slipTz;
                node.vr += changeR;
                node.vz += changeZ;
                if (remapped) {
                    return;
                }
                node.dvr += changeR;
                node.dvz += changeZ;
                // Along the normal the points move with the body; the other direction keeps the mean.
                const double place = (node.placeVr - node.vr) * n[0] + (node.placeVz - node.vz) * n[1];
                node.placeVr += 0.5 * (changeR + approach * n[0]) - place * n[0];
                node.placeVz += 0.5 * (changeZ + approach * n[1]) - place * n[1];
                reaction.radialImpulse[static_cast<int>(part)] -= node.mass * changeR;
                reaction.verticalImpulse[static_cast<int>(part)] -= node.mass * changeZ;
                reaction.work += node.mass * changeZ * body.velocity;
            };
            touchFaces(body, contact, touch);
        }
    }
}

// ---------------------------------------------------------------------------------------------------------

template <class Shape, int phases>
auto ExplicitStep<Shape, phases>::cornerMotion(int c) const -> CornerMotion
{
    CornerMotion result;
    for (int k = 0; k < corners; ++k) {
        const Node& node = nodes_[cellNodes_[c * corners + k]];
        result.vr[k] = node.vr;
        result.vz[k] = node.vz;
        result.motion[k] = node.motion();
        if constexpr (twoPhase) {
            const LiquidNode& liquid = liquidNodes_[cellNodes_[c * corners + k]];
            result.wr[k] = node.vr + liquid.relativeVr;
            result.wz[k] = node.vz + liquid.relativeVz;
            result.liquidMotion[k] = liquid.motion();
        }
    }
    return result;
}

template <class Shape, int phases>
auto ExplicitStep<Shape, phases>::strainOfFilled(int c, const CornerMotion& motion, double dt) const
    -> FilledStrain
{
    const bool nodalAverage = scene_.controls.locking == SolutionControls::Locking::nodalAverage;
    const bool sharedRate =
        nodalAverage || scene_.controls.locking == SolutionControls::Locking::meanDilatation;
    FilledStrain result{};
    Shape::velocityGradient(cells_[c], motion.vr, motion.vz, result.gradient);
    if constexpr (twoPhase) {
        shapes::VelocityGradient<corners> ofLiquid;
        Shape::velocityGradient(cells_[c], motion.wr, motion.wz, ofLiquid);
        for (int i = 0; i < momentCount; ++i) {
            result.liquidGradient[i] = ofLiquid[i][0] + ofLiquid[i][1] + ofLiquid[i][2];
        }
    }
    if (nodalAverage) {
        result.rate = cellRate_[c];
        result.liquidRate = twoPhase ? cellLiquidRate_[c] : 0;
    } else {
        result.rate = result.gradient[0][0] + result.gradient[0][1] + result.gradient[0][2];
        result.liquidRate = result.liquidGradient[0];
    }
    if constexpr (corners == 4) {
        result.centreXi = fits(c) ? Shape::moments(cells_[c]).xiCentre : pointCentre_[c][0];
        result.centreEta = fits(c) ? 0 : pointCentre_[c][1];
    }
    for (int i = 0; i < momentCount; ++i) {
        const double(&g)[5] = result.gradient[i];
        const double own = g[0] + g[1] + g[2];
        const double taken = !sharedRate ? own : i == 0 ? result.rate : 0.0;
        kernels::strainOf(g, taken, dt, result.strain[i], result.spin[i]);
        result.dilatation[i] = dt * taken;
    }
    return result;
}

template <class Shape, int phases>
template <bool velocities, bool strains>
void ExplicitStep<Shape, phases>::mapCellToPoints(State& state, double dt, int c)
{
    MaterialPoints& points = state.points;
    const typename Shape::Cell& cell = cells_[c];
    const bool meanDilatation = scene_.controls.locking == SolutionControls::Locking::meanDilatation;
    const bool nodalAverage = scene_.controls.locking == SolutionControls::Locking::nodalAverage;
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    const double flip = scene_.controls.flipOf(dt);

    const CornerMotion ofCorners = cornerMotion(c);
    const auto& [vr, vz, wr, wz, motion, liquidMotion] = ofCorners;
    const bool filled = state.filled[c] != 0;
    const bool sharedRate = meanDilatation || nodalAverage;
    FilledStrain ofFilled{};
    auto& [strain, spin, dilatation, rate, liquidRate, liquidGradient, centreXi, centreEta, gradient] =
        ofFilled;
    if constexpr (strains) {
        if (filled) {
            ofFilled = strainOfFilled(c, ofCorners, dt);
        } else if (nodalAverage) {
            rate = cellRate_[c];
            liquidRate = twoPhase ? cellLiquidRate_[c] : 0;
        } else if (meanDilatation) { // the same mean over the points as in the forces
            double volume = 0;
            Values values;
            for (const int* i = first; i != last; ++i) {
                const int p = *i;
                Shape::evaluate(cell, points.r[p], points.z[p], values);
                const double inverseR = axisymmetric ? 1 / std::max(points.r[p], kernels::smallestRadius) : 0;
                double own = 0;
                for (int k = 0; k < corners; ++k) {
                    own += (values.dr[k] + values.N[k] * inverseR) * vr[k] + values.dz[k] * vz[k];
                }
                rate += points.volume[p] * own;
                volume += points.volume[p];
                if constexpr (twoPhase) {
                    double liquid = 0;
                    for (int k = 0; k < corners; ++k) {
                        liquid += (values.dr[k] + values.N[k] * inverseR) * wr[k] + values.dz[k] * wz[k];
                    }
                    liquidRate += points.volume[p] * liquid;
                }
            }
            rate /= volume;
            liquidRate /= volume;
        }
    }
    const bool affine = points.affine();

    double dilatationSum = 0;
    double differenceSum = 0, volumeSum = 0;
    Values values;
    for (const int* i = first; i != last; ++i) {
        const int p = *i;
        const double r = points.r[p];
        const auto [xi, eta] = Shape::evaluate(cell, r, points.z[p], values);
        [[maybe_unused]] Four ofLiquid; // motion of the liquid at the point
        if constexpr (twoPhase) {
            ofLiquid = values.N[0] * liquidMotion[0];
            for (int k = 1; k < corners; ++k) {
                ofLiquid += values.N[k] * liquidMotion[k];
            }
        }
        if constexpr (strains) {
            double e = 0; // dilatation
            [[maybe_unused]] double ownLiquid = 0;
            if (filled) {
                Four increments = fourFrom(strain[0][0]);
                double turned = spin[0];
                e = dilatation[0];
                ownLiquid = sharedRate ? liquidRate : liquidGradient[0];
                if constexpr (corners == 4) {
                    const double x = xi - centreXi;
                    const double y = eta - centreEta;
                    increments += x * fourFrom(strain[1][0]) + y * fourFrom(strain[2][0]);
                    turned += x * spin[1] + y * spin[2];
                    if (!sharedRate) {
                        e += x * dilatation[1] + y * dilatation[2];
                        ownLiquid += x * liquidGradient[1] + y * liquidGradient[2];
                    }
                }
                for (int j = 0; j < 4; ++j) {
                    strain_[j][p] = increments[j];
                }
                spin_[p] = turned;
                for (int j = 0; affine && j < 4; ++j) {
                    constexpr int component[4] = {0, 3, 4, 1}; // rr, rz, zr, zz
                    const int g = component[j];
                    points.gradient[j][p] = gradient[0][g];
                    if constexpr (corners == 4) {
                        points.gradient[j][p] +=
                            (xi - centreXi) * gradient[1][g] + (eta - centreEta) * gradient[2][g];
                    }
                }
            } else {
                double rr = 0, zz = 0, rz = 0, zr = 0, hoop = 0;
                for (int k = 0; k < corners; ++k) {
                    rr += values.dr[k] * vr[k];
                    rz += values.dz[k] * vr[k];
                    zr += values.dr[k] * vz[k];
                    zz += values.dz[k] * vz[k];
                    hoop += values.N[k] * vr[k];
                }
                hoop = axisymmetric ? hoop / std::max(r, kernels::smallestRadius) : 0.0;
                if constexpr (twoPhase) {
                    const double inverseR = axisymmetric ? 1 / std::max(r, kernels::smallestRadius) : 0.0;
                    for (int k = 0; k < corners; ++k) {
                        ownLiquid += (values.dr[k] + values.N[k] * inverseR) * wr[k] + values.dz[k] * wz[k];
                    }
                    ownLiquid = sharedRate ? liquidRate : ownLiquid;
                }
                if (affine) {
                    points.gradient[0][p] = rr;
                    points.gradient[1][p] = rz;
                    points.gradient[2][p] = zr;
                    points.gradient[3][p] = zz;
                }
                const double own = rr + zz + hoop;
                const double trace = sharedRate ? rate : own;
                const double shift = (trace - own) / 3;
                strain_[0][p] = dt * (rr + shift);
                strain_[1][p] = dt * (zz + shift);
                strain_[2][p] = dt * (hoop + shift);
                strain_[3][p] = dt * (rz + zr);
                spin_[p] = 0.5 * dt * (zr - rz);
                e = dt * trace;
            }
            dilatationSum += e;
            const double volume = points.volume[p];
            if constexpr (twoPhase) {
                // Storage [Jassim, Stolle & Vermeer 2013]: p' = -(Kw/n)((1-n) div v + n div w).
                const LiquidProperties& properties = liquid_[points.material[p]];
                double pressure = points.porePressure[p];
                if (projects()) {
                    pressure += pressureStep_[c];
                } else {
                    const double inverseN = volume / (volume - points.mass[p] * properties.grainVolume);
                    pressure -= properties.bulkModulus * ((inverseN - 1) * e + dt * ownLiquid);
                }
                if (sharedRate) {
                    const double shown = ofLiquid[3] + unitWeight_ * points.z[p];
                    differenceSum += volume * (pressure - shown);
                    volumeSum += volume;
                    pressure = shown; // but for its mean
                }
                points.porePressure[p] = pressure;
            }
            points.volume[p] = std::min(volume * (1 + e * (1 + 0.5 * e)), // exp(e)
                                        points.mass[p] * largestVolume_[points.material[p]]);
        }
        Four moved = values.N[0] * motion[0];
        for (int k = 1; k < corners; ++k) {
            moved += values.N[k] * motion[k];
        }
        if constexpr (velocities) {
            double differenceR = 0, differenceZ = 0;
            if constexpr (twoPhase) {
                // Relative velocities that the nodes do not see are dragged down as theirs are.
                differenceR = ofLiquid[0] + ofLiquid[2] * (points.wr[p] - points.vr[p]);
                differenceZ = ofLiquid[1] + ofLiquid[2] * (points.wz[p] - points.vz[p]);
            }
            double newR = 0, newZ = 0;
            for (int k = 0; flip < 1 && k < corners; ++k) {
                newR += values.N[k] * vr[k];
                newZ += values.N[k] * vz[k];
            }
            points.vr[p] = flip * (points.vr[p] + moved[0]) + (1 - flip) * newR;
            points.vz[p] = flip * (points.vz[p] + moved[1]) + (1 - flip) * newZ;
            if constexpr (twoPhase) {
                points.wr[p] = points.vr[p] + differenceR;
                points.wz[p] = points.vz[p] + differenceZ;
            }
        }
        if constexpr (strains) {
            points.r[p] = r + dt * moved[2];
            points.z[p] += dt * moved[3];
        }
    }
    if constexpr (strains && twoPhase) {
        // Where the forces know the mean pressure of a cell alone, its points take their differences from the
        // nodes: left alone they would keep those of their first cells for ever.
        const double shift = sharedRate ? differenceSum / volumeSum : 0;
        for (const int* i = first; i != last; ++i) {
            const int p = *i;
            points.porePressure[p] =
                std::max(points.porePressure[p] + shift, liquid_[points.material[p]].leastPressure);
        }
    }
    if constexpr (strains) {
        state.cellDivergence[c] = dilatationSum / (dt * static_cast<double>(last - first));
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addRemappedMomentum(const State& state, int c)
{
    const MaterialPoints& points = state.points;
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        out[k].momentumR = out[k].momentumZ = 0;
        if constexpr (twoPhase) {
            liquidCorners_[c * corners + k].momentumR = liquidCorners_[c * corners + k].momentumZ = 0;
        }
    }
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        const auto [x, y] = Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        const double m = inertiaScale_[c] * fullness_[c] * points.mass[p] *
                         (fit_.empty() ? 1.0 : fit_[c].at(x, y)) *
                         (twoPhase ? solidShare_[points.material[p]] : 1.0);
        for (int k = 0; k < corners; ++k) {
            out[k].momentumR += values.N[k] * m * points.vr[p];
            out[k].momentumZ += values.N[k] * m * points.vz[p];
        }
        for (int k = 0; points.affine() && k < corners; ++k) {
            const auto [r, z] = affineVelocity(state, p, c * corners + k);
            out[k].momentumR += values.N[k] * m * r;
            out[k].momentumZ += values.N[k] * m * z;
        }
        if constexpr (twoPhase) {
            const double liquid = inertiaScale_[c] * fullness_[c] * porosity(points, p) *
                                  liquid_[points.material[p]].density * points.volume[p];
            for (int k = 0; k < corners; ++k) {
                LiquidCorner& corner = liquidCorners_[c * corners + k];
                corner.momentumR += values.N[k] * liquid * (points.wr[p] - points.vr[p]);
                corner.momentumZ += values.N[k] * liquid * (points.wz[p] - points.vz[p]);
            }
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::remapMomentum(const State& state, int c)
{
    if constexpr (hasBoxes) {
        if (inBoxes(c)) {
            addRemappedBoxMomentum(state, c);
            return;
        }
    }
    if (resting(c)) {
        keepFemMomentum(c);
    } else {
        addRemappedMomentum(state, c);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::averageDilatationAtNodes()
{
    averageAtNodes(cellRate_, [this](int i) { return std::array{nodes_[i].vr, nodes_[i].vz}; });
    if constexpr (twoPhase) {
        averageAtNodes(cellLiquidRate_, [this](int i) {
            return std::array{nodes_[i].vr + liquidNodes_[i].relativeVr,
                              nodes_[i].vz + liquidNodes_[i].relativeVz};
        });
    }
}

/// Detournay & Dzik 2006: cell rates of dilatation, averaged over the nodes.
template <class Shape, int phases>
template <class Velocity>
void ExplicitStep<Shape, phases>::averageAtNodes(std::vector<double>& cellRate, const Velocity& velocity)
{
    forCells([&](int c) {
        double rate = 0;
        for (int k = 0; k < corners; ++k) {
            const auto [r, z] = velocity(cellNodes_[c * corners + k]);
            rate += dilatation_[c].br[k] * r + dilatation_[c].bz[k] * z;
        }
        cellRate[c] = rate;
    });
    averageOverNodes(cellRate, cellRate);
}

/// From cells to their nodes, weighted with volume, and back as the mean of a cell's nodes. A checkerboard
/// becomes zero; the sum over the volume stays. The result may be what it is taken of.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::averageOverNodes(const std::vector<double>& ofCells,
                                                   std::vector<double>& result) const
{
    ofNodes_.resize(nodes_.size());
    result.resize(ofCells.size());
    forNodes([&](int i) {
        double sum = 0;
        double volume = 0;
        for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
            const int c = nodeCorners_.item[k] / corners;
            if (occupied_[c]) {
                sum += ofCells[c] * dilatation_[c].volume;
                volume += dilatation_[c].volume;
            }
        }
        ofNodes_[i] = sum / volume;
    });
    forCells([&](int c) {
        double sum = 0;
        for (int k = 0; k < corners; ++k) {
            sum += ofNodes_[cellNodes_[c * corners + k]];
        }
        result[c] = sum / corners;
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapToPoints(State& state, double dt)
{
    const SolutionControls& controls = scene_.controls;
    const bool remapAll = controls.remap == SolutionControls::Remap::all;
    const bool remapSome = controls.remap == SolutionControls::Remap::loose;
    const bool nodalAverage = controls.locking == SolutionControls::Locking::nodalAverage;
    const auto later = [&](int c) {
        return !resting(c) && (remapAll || nodalAverage || (remapSome && byLoose_[c]));
    };
    const auto remaps = [&](int c) { return remapAll || (remapSome && byLoose_[c]); };

    forAwakeCells([&](int c) {
        if (remapSome) {
            byLoose_[c] = 0;
            for (int k = 0; k < corners; ++k) {
                byLoose_[c] |= looseNode_[cellNodes_[c * corners + k]];
            }
        }
        if (inBoxes(c)) {
            if constexpr (hasBoxes) {
                moveBoxVelocities(state, dt, c);
            }
        } else if (later(c)) {
            mapCellToPoints<true, false>(state, dt, c);
        }
        if (remaps(c) && boxCell_.empty()) {
            remapMomentum(state, c);
        }
    });
    if (!boxCell_.empty()) { // of points in other cells as well
        forCells([&](int c) {
            if (remaps(c)) {
                remapMomentum(state, c);
            }
        });
    }
    if (remapAll || remapSome) {
        forNodes([&](int i) {
            if (!(remapAll || looseNode_[i]) || nodes_[i].mass <= 0) {
                return;
            }
            double r = 0;
            double z = 0;
            for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
                r += cornerSums_[nodeCorners_.item[k]].momentumR;
                z += cornerSums_[nodeCorners_.item[k]].momentumZ;
            }
            nodes_[i].vr = r / nodes_[i].mass;
            nodes_[i].vz = z / nodes_[i].mass;
            if constexpr (twoPhase) {
                LiquidNode& liquid = liquidNodes_[i];
                r = z = 0;
                for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
                    r += liquidCorners_[nodeCorners_.item[k]].momentumR;
                    z += liquidCorners_[nodeCorners_.item[k]].momentumZ;
                }
                liquid.relativeVr = r / liquid.mass;
                liquid.relativeVz = z / liquid.mass;
            }
        });
        if constexpr (twoPhase) {
            applyContact(state, dt, true);
            applyConditions(state.time + dt, true);
        } else {
            applyConditions(state.time + dt, true);
            applyContact(state, dt, true);
        }
    }
    if (nodalAverage) {
        if (femSteps_ > 0) {
            returnInnerMotion();
        }
        averageDilatationAtNodes();
    }
    const auto mapCell = [&](int c) {
        if (resting(c)) {
            return;
        }
        if constexpr (hasBoxes) {
            if (inBoxes(c)) {
                strainBoxPoints(state, dt, c);
                return;
            }
        }
        if (later(c)) {
            mapCellToPoints<false, true>(state, dt, c);
        } else {
            mapCellToPoints<true, true>(state, dt, c);
        }
    };
    if constexpr (hasFours) {
        const auto mayJoin = [&](int c) { return state.filled[c] != 0 && !resting(c) && !later(c); };
        forPieces(awake_, mayJoin, mapCell, [&](std::span<const int> cells) {
            std::array<FilledStrain, cellsPerPiece> strains;
            for (std::size_t j = 0; j < cells.size(); j += 4) {
                strainByFours(&cells[j], static_cast<int>(std::min<std::size_t>(4, cells.size() - j)), dt,
                              &strains[j]);
            }
            for (std::size_t j = 0; j < cells.size(); ++j) {
                moveByFours(state, dt, cells[j], strains[j]);
            }
        });
    } else {
        forAwakeCells(mapCell);
    }
}

/// work(thread, material, begin, end) for blocks of runs, on all threads.
template <class Shape, int phases>
template <class Work>
void ExplicitStep<Shape, phases>::inBlocks(std::span<const PointCells::Run> runs, const Work& work) const
{
    const auto blocksOf = [](const PointCells::Run& run) {
        return (run.end - run.begin + pointsPerPiece - 1) / pointsPerPiece;
    };
    int blocks = 0;
    for (const PointCells::Run& run : runs) {
        blocks += blocksOf(run);
    }
    threads_.share(blocks, 1, [&](int thread, int first, int last) {
        for (const PointCells::Run& run : runs) {
            const int own = blocksOf(run);
            const int begin = run.begin + pointsPerPiece * std::max(first, 0);
            const int end = std::min(run.end, run.begin + pointsPerPiece * std::min(last, own));
            if (begin < end) {
                work(thread, run.material, begin, end);
            }
            first -= own;
            last -= own;
        }
    });
}

/// The law on the elements from `begin` to before `end` of arrays of points or cells.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateBatch(int material, int thread, int begin, int end,
                                              const std::array<std::vector<double>, 4>& strain,
                                              const std::vector<double>& spin,
                                              std::array<std::vector<double>, 4>& stress,
                                              std::vector<std::vector<double>>& variables)
{
    StressBatch batch;
    batch.size = end - begin;
    for (int j = 0; j < 4; ++j) {
        batch.strain[j] = strain[j].data() + begin;
        batch.stress[j] = stress[j].data() + begin;
    }
    batch.spin = spin.data() + begin;
    std::vector<double*>& pointers = statePointers_[thread];
    for (std::size_t k = 0; k < variables.size(); ++k) {
        pointers[k] = variables[k].data() + begin;
    }
    batch.state = &pointers;
    scene_.materials[material].law->update(batch);
}

/// Of the points in cells that rest, or of those in all others.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateStress(State& state, bool resting)
{
    MaterialPoints& points = state.points;
    inBlocks(pointCells_.runs(resting), [&](int thread, int material, int begin, int end) {
        updateBatch(material, thread, begin, end, strain_, spin_, points.stress, points.state);
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::moveBodiesAndMesh(State& state, double dt)
{
    for (RigidBody& body : state.bodies) {
        body.tipLevel += dt * body.velocity;
    }
    if (scene_.movingBody >= 0 && state.bodies[scene_.movingBody].velocity != 0) {
        const RigidBody& body = state.bodies[scene_.movingBody];
        scene_.motion.place(state.mesh, scene_.referenceZ, body.tipLevel - body.initialTipLevel);
        updateCells(state);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::relocate(State& state, bool sorts)
{
    MaterialPoints& points = state.points;
    for (std::vector<PointCells::Mover>& movers : movers_) {
        movers.clear();
    }
    threads_.share(awake_.part, cellsPerPiece, [&](int thread, int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const int c = awake_.items[j];
            if (resting(c)) {
                continue;
            }
            for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
                if (Shape::contains(cells_[c], points.r[*i], points.z[*i])) {
                    continue;
                }
                const int found = cellOfMoved(state, *i, c);
                if (found != c && !resting(found)) { // a cell at rest takes nobody in
                    points.cell[*i] = found;
                    movers_[thread].push_back({*i, c});
                }
            }
        }
    });
    // All at once: an index that is built anew knows every new cell.
    std::vector<PointCells::Mover>& movers = movers_.front();
    for (std::size_t part = 1; part < movers_.size(); ++part) {
        movers.insert(movers.end(), movers_[part].begin(), movers_[part].end());
    }
    pointCells_.move(points, movers);
    for (const auto& [point, from] : movers) {
        occupancyChanged_ =
            occupancyChanged_ || pointCells_.count(from) == 0 || !occupied_[points.cell[point]];
    }
    classifyCells(state);
    if (sorts) {
        sortPoints(state);
    }
}

/// Cell that now holds a point of cell c; pushes it out of a body's wall.
template <class Shape, int phases>
int ExplicitStep<Shape, phases>::cellOfMoved(State& state, int p, int c) const
{
    MaterialPoints& points = state.points;
    int found = locator_.walk(points.r[p], points.z[p], c);
    if (found >= 0 && inside_[found]) {
        for (const RigidBody& body : state.bodies) {
            if (body.contains(points.r[p], points.z[p])) {
                const double clearance = 1e-6 * Shape::size(cells_[c]);
                const auto [r, z] = pushOut(body, points.r[p], points.z[p], clearance);
                points.r[p] = r;
                points.z[p] = z;
                found = locator_.walk(r, z, c);
            }
        }
        if (found >= 0 && inside_[found]) {
            return c; // rounding at a face: stays with its cell
        }
    }
    if (found < 0) {
        throw InputError("the run",
                         {InputProblem{{},
                                       text("material point %d left the mesh at r = %.6g m, z = %.6g m (t = "
                                            "%.6g s)",
                                            points.id[p], points.r[p], points.z[p], state.time),
                                       "extend the mesh there, or hold the soil with a boundary condition"}});
    }
    return found;
}

template <class Shape, int phases>
std::vector<std::array<double, 2>> ExplicitStep<Shape, phases>::nodalVelocities(const State& state) const
{
    const MaterialPoints& points = state.points;
    std::vector<std::array<double, 2>> momentum(state.mesh.nodes());
    std::vector<double> mass(state.mesh.nodes(), 0);
    Values values;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const int c = points.cell[p];
        Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            const double m = values.N[k] * points.mass[p];
            mass[i] += m;
            momentum[i][0] += m * points.vr[p];
            momentum[i][1] += m * points.vz[p];
        }
    }
    for (std::size_t i = 0; i < mass.size(); ++i) {
        if (mass[i] > 0) {
            momentum[i][0] /= mass[i];
            momentum[i][1] /= mass[i];
        }
    }
    return momentum;
}

template <class Shape, int phases>
std::vector<double> ExplicitStep<Shape, phases>::nodalPressures(const State& state) const
{
    const MaterialPoints& points = state.points;
    std::vector<double> pressure(state.mesh.nodes(), 0);
    for (std::size_t i = 0; i < seepage_.size(); ++i) {
        pressure[i] = activeNode_[i] ? seepage_[i] + unitWeight_ * state.mesh.z[i] : 0;
    }
    if (!points.twoPhase()) {
        return pressure;
    }
    std::vector<double> volume(state.mesh.nodes(), 0);
    Values values;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const int c = points.cell[p];
        Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            volume[i] += values.N[k] * points.volume[p];
            pressure[i] +=
                values.N[k] * points.volume[p] * (points.porePressure[p] - unitWeight_ * points.z[p]);
        }
    }
    for (std::size_t i = 0; i < volume.size(); ++i) {
        if (volume[i] > 0) {
            pressure[i] = pressure[i] / volume[i] + unitWeight_ * state.mesh.z[i];
        }
    }
    return pressure;
}

} // namespace caisson
