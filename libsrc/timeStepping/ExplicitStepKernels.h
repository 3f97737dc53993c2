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

/// Fastest wave of soil and liquid without drag between them [m/s]: sqrt of the largest eigenvalue of the
/// stiffness over the densities of the two phases, at a porosity. Drag slows it down to that of the undrained
/// soil at most.
inline double fastWave(const Material& material, double n)
{
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
        pWaveModulus_.push_back(material.law->pWaveModulus());
        // Projection: the pressure follows, and the soil may leave its liquid behind.
        const double ofSolid = (1 - material.porosity) * material.solidDensity;
        const double skeleton = projects() ? ofSolid : material.inertialDensity();
        waveSpeed_.push_back(twoPhase && !projects() ? kernels::fastWave(material, material.porosity)
                                                     : std::sqrt(material.law->pWaveModulus() / skeleton));
        skeletonSpeed_.push_back(std::sqrt(pWaveModulus_.back() / skeleton));
        drainedSpeed_.push_back(twoPhase ? std::sqrt(pWaveModulus_.back() / ofSolid) : skeletonSpeed_.back());
        solidShare_.push_back(twoPhase ? ofSolid / material.inertialDensity() : 1);
        if constexpr (twoPhase) {
            liquid_.push_back(
                {solidShare_.back() / material.solidDensity, material.liquidDensity,
                 material.liquidBulkModulus, material.liquidViscosity, material.cavitationPressure,
                 material.liquidViscosity / material.intrinsicPermeability, material.kozenyCarman});
            // Triangles: so often the filter would take too much of consolidation.
            const double passage = waveSpeed_.back() / std::sqrt(material.law->pWaveModulus() / ofSolid);
            constexpr double stiff = 3; // waves of the water, of the speed of those of the skeleton
            if (projects() || (corners == 4 && passage > stiff)) {
                stepsPerPassage_ = passage;
            }
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
        liquidNodes_.resize(mesh.nodes());
        findCheckerboardSigns();
        wallArea_.resize(mesh.nodes());
        givenPressure_.assign(mesh.nodes(), std::numeric_limits<double>::quiet_NaN());
        nodeSurface_.assign(mesh.nodes(), -1);
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
    meanRate_.assign(cells_.size(), {});
    yieldedAt_.assign(cells_.size(), std::numeric_limits<int>::min());
    pressureSolver_.forget();
    pressureStep_.setZero();
    pointCells_.index(state.points, state.mesh.cells());
    pointCells_.sort(state.points, threads_);
    occupancyChanged_ = true;
    classifyCells(state, true);
    scaleInertia(state);
    sortPoints(state);
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
    if (dt > viscousStep_) {
        setFemViscosity(state, dt);
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
        if (pumped_) { // by the velocities that the soil is strained by
            pump(state, dt);
        }
        if (scene_.controls.checkerboardFilter > 0 && state.step % filterInterval(state) == 0) {
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
    } else if (scene_.controls.scaleSmallCells && state.step % scene_.controls.checkInterval == 0) {
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
        const bool isVoid = !occupied_[c];
        const auto& m = Shape::moments(cells_[c]);
        double part[3] = {}; // mean and slopes
        for (int k = 0; k < corners; ++k) {
            part[0] += m.n[k] * p[k];
        }
        if constexpr (corners == 4) {
            if (!isVoid) {
                part[1] = 0.25 * (-p[0] + p[1] + p[2] - p[3]);
                part[2] = 0.25 * (-p[0] - p[1] + p[2] + p[3]);
            }
        }
        for (int k = 0; k < corners; ++k) {
            std::array<double, 2>& load = waterLoad_[cellNodes_[c * corners + k]];
            part[0] = isVoid ? p[k] : part[0];
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
        if (keepsRate(c)) {
            cellRate_[c] = projectedRate(state, c);
        }
        mapCellToPoints<false, true>(state, 0.5 * dt, c);
    });
    updateStress(state, false);
    updateStress(state, true);
}

/// work(thread, run, begin, end) for blocks of runs, on all threads.
template <class Shape, int phases>
template <class Run, class Work>
void ExplicitStep<Shape, phases>::inBlocks(std::span<const Run> runs, const Work& work) const
{
    const auto blocksOf = [](const Run& run) {
        return (run.end - run.begin + pointsPerPiece - 1) / pointsPerPiece;
    };
    int blocks = 0;
    for (const Run& run : runs) {
        blocks += blocksOf(run);
    }
    threads_.share(blocks, 1, [&](int thread, int first, int last) {
        for (const Run& run : runs) {
            const int own = blocksOf(run);
            const int begin = run.begin + pointsPerPiece * std::max(first, 0);
            const int end = std::min(run.end, run.begin + pointsPerPiece * std::min(last, own));
            if (begin < end) {
                work(thread, run, begin, end);
            }
            first -= own;
            last -= own;
        }
    });
}

/// The law on the elements from `begin` to before `end` of arrays of points or cells; strain and spin are
/// those of these.
/// @returns whether some of them yield
template <class Shape, int phases>
bool ExplicitStep<Shape, phases>::updateBatch(int material, int thread, int begin, int end,
                                              const std::array<const double*, 4>& strain, const double* spin,
                                              std::array<std::vector<double>, 4>& stress,
                                              std::vector<std::vector<double>>& variables)
{
    StressBatch batch;
    batch.size = end - begin;
    for (int j = 0; j < 4; ++j) {
        batch.strain[j] = strain[j];
        batch.stress[j] = stress[j].data() + begin;
    }
    batch.spin = spin;
    std::vector<double*>& pointers = statePointers_[thread];
    for (std::size_t k = 0; k < variables.size(); ++k) {
        pointers[k] = variables[k].data() + begin;
    }
    batch.state = &pointers;
    return scene_.materials[material].law->update(batch);
}

/// Of the points in cells that rest, or of those in all others.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateStress(State& state, bool resting)
{
    MaterialPoints& points = state.points;
    const auto update = [&](int thread, const PointCells::Run& run, int begin, int end) {
        updateBatch(run.material, thread, begin, end,
                    {&strain_[0][begin], &strain_[1][begin], &strain_[2][begin], &strain_[3][begin]},
                    &spin_[begin], points.stress, points.state);
    };
    inBlocks(pointCells_.runs(resting), update);
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::moveBodiesAndMesh(State& state, double dt)
{
    for (RigidBody& body : state.bodies) {
        body.tipLevel += dt * body.velocity;
    }
    if (scene_.movingBody >= 0 && state.bodies[scene_.movingBody].velocity != 0) {
        const RigidBody& body = state.bodies[scene_.movingBody];
        const double displacement = body.tipLevel - body.initialTipLevel;
        threads_.share(state.mesh.nodes(), nodesPerPiece, [&](int, int begin, int end) {
            scene_.motion.place(state.mesh, scene_.referenceZ, displacement, begin, end);
        });
        updateCells(state);
    }
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
