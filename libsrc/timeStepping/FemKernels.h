#pragma once

#include "timeStepping/LiquidKernels.h"

#include <numeric>

// Finite elements among the cells of material points. Well inside the soil points move by a small part of a
// cell from one sort of the points to the next: there they rest, and their cell stands for them. It has the
// stress that filled cells have anyhow, mean and slopes over the cell, sampled from its points in the first
// step; from there on the constitutive law updates the mean, and the elastic shear modulus the slopes, with
// the same strain operator (Moments) that strains points. Masses stay as sampled, and the nodes keep their
// velocities. Then the points catch up with what has happened to their cell: place, velocity, strain, and
// with it, by the law, their own stress; and whatever cell they are in then samples them anew. So points
// remain the state, nothing has to be converted or carried over to other cells where the mesh moves, and
// where the soil is elastic the points end where they would have ended.
namespace caisson {

/// Steps for which the points of a cell may rest: of one material, without loads, and as long as they move
/// and strain little. 0 where they may not.
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::mayRest(const State& state, int c, double step) const
{
    const MaterialPoints& points = state.points;
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    double meshVz = 0;
    if (scene_.movingBody >= 0) {
        const int corner = c * corners;
        meshVz = state.bodies[scene_.movingBody].velocity *
                 scene_.motion.weight(scene_.referenceZ[cellNodes_[corner]]);
    }
    double lowR = points.vr[*first], highR = lowR;
    double lowZ = points.vz[*first], highZ = lowZ;
    for (const int* i = first; i != last; ++i) {
        const int p = *i;
        if (points.material[p] != points.material[*first] || (points.loaded() && points.load[p] >= 0)) {
            return 0;
        }
        lowR = std::min(lowR, points.vr[p]);
        highR = std::max(highR, points.vr[p]);
        lowZ = std::min(lowZ, points.vz[p]);
        highZ = std::max(highZ, points.vz[p]);
    }
    const double speed = std::max({-lowR, highR, meshVz - lowZ, highZ - meshVz});
    const double difference = std::max(highR - lowR, highZ - lowZ);
    const double size = Shape::size(cells_[c]);
    const SolutionControls& controls = scene_.controls;
    constexpr double least = std::numeric_limits<double>::min(); // of the divisor
    return std::min(controls.femMotion / std::max(step * speed / size, least),
                    controls.femStrain / std::max(step * difference / size, least));
}

/// Steps to the next sort. Longer rests save sorts, and cost the cells that cannot rest as long.
template <class Shape, int phases>
int ExplicitStep<Shape, phases>::chooseRest(const MaterialPoints& points,
                                            const std::vector<double>& mayRest) const
{
    constexpr double costOfSort = 2.5; // over that of a step, per point
    const int longest = scene_.controls.sortInterval;
    int best = longest;
    double least = std::numeric_limits<double>::max();
    for (int steps = longest; steps > 0 && steps >= longest / 8; steps /= 2) {
        double cost = costOfSort * static_cast<double>(points.size()) / steps;
        for (const int c : active_.items) {
            if (rests_[c] && mayRest[c] < steps) {
                cost += pointCells_.count(c);
            }
        }
        if (cost < least) {
            least = cost;
            best = steps;
        }
    }
    return best;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::FemFields::resize(std::size_t size)
{
    for (auto* four : {&stress, &slopeXi, &slopeEta}) {
        for (std::vector<double>& component : *four) {
            component.resize(size);
        }
    }
    for (auto* values : {&shareXi, &shareEta, &pressure, &porosity, &viscousTime}) {
        values->resize(size);
    }
    for (std::vector<double>& component : yielding) {
        component.assign(size, 0);
    }
    yielded.assign(size, 0);
    yields.assign(size, 0);
    for (std::vector<double>& component : meanRate) {
        component.resize(size);
    }
    dilatation.assign(size, 0);
    for (std::vector<double>& variable : state) {
        variable.resize(size);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::chooseFemCells(const State& state)
{
    const SolutionControls& controls = scene_.controls;
    if (!controls.mayHaveFemCells() || scene_.bodyForce.given()) { // which acts on points where they are
        return;
    }
    const MaterialPoints& points = state.points;
    femOf_.assign(cells_.size(), -1);
    femCells_.clear();
    const std::vector<unsigned char> restedBefore = rests_;
    rests_.assign(cells_.size(), 0);
    const double step = stableStep(state).step;
    std::vector<double> steps(cells_.size());
    forCells([&](int c) {
        steps[c] = state.filled[c] != 0 ? mayRest(state, c, step) : 0;
        rests_[c] = steps[c] > 0;
    });
    wakeBesideBodies(points);
    // Nodes of partly filled cells may be loose.
    for (const int c : active_.items) {
        for (int k = 0; !state.filled[c] && k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            for (int j = nodeCorners_.start[i]; j < nodeCorners_.start[i + 1]; ++j) {
                rests_[nodeCorners_.item[j] / corners] = 0;
            }
        }
    }
    if (!controls.femZone.empty()) {
        std::vector<unsigned char> ofZone(cells_.size(), 0);
        for (const int c : state.mesh.cellZones.at(controls.femZone)) {
            ofZone[c] = rests_[c];
        }
        rests_ = ofZone;
    }
    stepsToSort_ = chooseRest(points, steps);
    for (const int c : active_.items) {
        rests_[c] = rests_[c] != 0 && steps[c] >= stepsToSort_;
    }

    std::vector<int> chosen;
    std::ranges::copy_if(active_.items, std::back_inserter(chosen), [&](int c) { return rests_[c] != 0; });
    const auto material = [&](int c) { return points.material[*pointCells_.begin(c)]; };
    if (scene_.materials.size() > 1) {
        std::ranges::stable_sort(chosen, {}, material);
    }
    femCells_.assign(chosen.size(), {});
    femLiquidCells_.assign(twoPhase ? chosen.size() : 0, {});
    femRuns_.clear();
    const auto viscous = [&](int c) { return mayBeViscous(state, c); };
    std::ranges::stable_partition(chosen, viscous);
    for (int f = 0; f < static_cast<int>(chosen.size()); ++f) {
        const int c = chosen[f];
        femCells_[f].cell = c;
        femCells_[f].material = material(c);
        femCells_[f].restedBefore = !restedBefore.empty() && restedBefore[c] != 0;
        femOf_[c] = f;
        if (femRuns_.empty() || femRuns_.back().material != material(c) ||
            femRuns_.back().viscous != viscous(c)) {
            femRuns_.push_back({material(c), viscous(c), f, f});
        }
        femRuns_.back().end = f + 1;
    }
    fem_.state.resize(points.state.size());
    fem_.resize(chosen.size());
    femShapes_.resize(chosen.size());
    threads_.share(static_cast<int>(chosen.size()), pointsPerPiece, [&](int, int begin, int end) {
        for (int f = begin; f < end; ++f) {
            femShapes_.set(f, cells_[chosen[f]]);
            for (int j = 0; j < 4; ++j) {
                fem_.meanRate[j][f] = meanRate_[chosen[f]][j];
            }
            for (std::size_t k = 0; k < fem_.state.size(); ++k) {
                double sum = 0;
                for (const int* p = pointCells_.begin(chosen[f]); p != pointCells_.end(chosen[f]); ++p) {
                    sum += points.state[k][*p];
                }
                fem_.state[k][f] = sum / pointCells_.count(chosen[f]);
            }
        }
    });
    femForces_.resize(chosen.size() * corners);
    numberFemNodes();
    viscousStep_ = 0;
}

/// Whether it has yielded not long ago.
template <class Shape, int phases>
bool ExplicitStep<Shape, phases>::mayBeViscous(const State& state, int c) const
{
    constexpr long longAgo = 500; // steps, some periods of the shortest waves
    return scene_.controls.femViscosity > 0 && state.step - yieldedAt_[c] < longAgo;
}

/// Soil that dilates less than it rubs feeds vibrations as it yields. Cells of points lose what points do not
/// see of a velocity in every step, which takes the shortest waves away; those at rest would keep them. So
/// the soil of cells that have yielded not long ago has a viscosity, its elastic stiffness times a share b
/// of the passage h/c_s of its own wave. Of a wave of length l over cells of size h it is pi b h/l of the
/// critical damping. It acts on what rates of strain are beside their mean of late, for the flow must not
/// feel it, however much the inertia is scaled. No more than the step leaves: with waves of the speed c, and
/// c_d that of the soil without its liquid, the step is stable to
///
///     (c dt/h)^2 + 2 b c_d^2/(c_s c) c dt/h = 1.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::setFemViscosity(const State& state, double dt)
{
    viscousStep_ = viscousReserve * dt;
    const auto set = [&](int f) {
        const int c = femCells_[f].cell;
        const int material = femCells_[f].material;
        fem_.viscousTime[f] = 0;
        if (mayBeViscous(state, c)) {
            const double drained = drainedSpeed_[material];
            const double skeleton = skeletonSpeed_[material];
            const double courant = std::min(1.0, viscousStep_ / cellStep(state, c));
            const double most = (1 - courant * courant) / (2 * courant) * skeleton * waveSpeed_[material] /
                                (drained * drained);
            fem_.viscousTime[f] = std::min(scene_.controls.femViscosity, most) * Shape::size(cells_[c]) *
                                  std::sqrt(inertiaScale_[c]) / skeleton;
        }
    };
    threads_.share(static_cast<int>(femCells_.size()), pointsPerPiece, [&](int, int begin, int end) {
        for (int f = begin; f < end; ++f) {
            set(f);
        }
    });
}

/// No cell rests that is nearer to a body, a free surface or loaded points than femDistance.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::wakeBesideBodies(const MaterialPoints& points)
{
    std::vector<unsigned char> near(nodes_.size(), 0);
    for (std::size_t p = 0; points.loaded() && p < points.size(); ++p) {
        for (int k = 0; points.load[p] >= 0 && k < corners; ++k) {
            near[cellNodes_[points.cell[p] * corners + k]] = 1;
        }
    }
    std::vector<int> front;
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
        near[i] |= contactNode_[i] | surfaceNode_[i];
        if (near[i]) {
            front.push_back(i);
        }
    }
    std::vector<int> next;
    for (int ring = 0; ring < std::max(1, scene_.controls.femDistance); ++ring) {
        next.clear();
        for (const int i : front) {
            for (int j = nodeCorners_.start[i]; j < nodeCorners_.start[i + 1]; ++j) {
                const int c = nodeCorners_.item[j] / corners;
                rests_[c] = 0;
                for (int k = 0; occupied_[c] && k < corners; ++k) {
                    const int node = cellNodes_[c * corners + k];
                    if (!near[node]) {
                        near[node] = 1;
                        next.push_back(node);
                    }
                }
            }
        }
        front.swap(next);
    }
}

/// Lists the nodes of the cells at rest, the inner ones first, and what meets at these.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::numberFemNodes()
{
    // These change the velocities that the forces give a node, or ask it for more.
    const bool mayBeInner = !projects() && scene_.controls.drag == SolutionControls::Drag::implicit;
    std::ranges::fill(innerNode_, 0);
    std::vector<int> numberOf(nodes_.size(), -1);
    std::vector<int> outer;
    femNodes_.clear();
    for (const FemCell& fem : femCells_) {
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[fem.cell * corners + k];
            if (numberOf[i] >= 0) {
                continue;
            }
            numberOf[i] = 0;
            bool inner = mayBeInner && boundaryNode_[i] == 0 && contactNode_[i] == 0;
            for (int j = nodeCorners_.start[i]; inner && j < nodeCorners_.start[i + 1]; ++j) {
                inner = rests_[nodeCorners_.item[j] / corners] != 0;
            }
            innerNode_[i] = inner;
            if (inner) {
                femNodes_.push_back({i});
            } else {
                outer.push_back(i);
            }
        }
    }
    innerNodes_ = static_cast<int>(femNodes_.size());
    for (const int i : outer) {
        femNodes_.push_back({i});
    }
    for (int j = 0; j < static_cast<int>(femNodes_.size()); ++j) {
        numberOf[femNodes_[j].node] = j;
    }
    femMotion_.resize(femNodes_.size());
    femStart_.resize(femNodes_.size());
    femHistory_.assign(femNodes_.size(), {});
    femCorners_.start.assign(innerNodes_ + 1, 0);
    femEdge_.clear();
    fem_.node.resize(femCells_.size());
    for (std::size_t f = 0; f < femCells_.size(); ++f) {
        FemCell& fem = femCells_[f];
        const double mayMove = scene_.controls.femMotion * Shape::size(cells_[fem.cell]);
        fem.inner = true;
        for (int k = 0; k < corners; ++k) {
            const int j = numberOf[cellNodes_[fem.cell * corners + k]];
            fem_.node[f][k] = j;
            fem.inner = fem.inner && j < innerNodes_;
            femHistory_[j].mayMove = std::min(femHistory_[j].mayMove, mayMove);
            if (j < innerNodes_) {
                ++femCorners_.start[j + 1];
            }
        }
        if (!fem.inner) {
            femEdge_.push_back(static_cast<int>(f));
        }
    }
    std::partial_sum(femCorners_.start.begin(), femCorners_.start.end(), femCorners_.start.begin());
    femCorners_.item.resize(femCorners_.start.back());
    std::vector<int> cursor(femCorners_.start.begin(), femCorners_.start.end() - 1);
    for (int f = 0; f < static_cast<int>(femCells_.size()); ++f) {
        for (int k = 0; k < corners; ++k) {
            if (fem_.node[f][k] < innerNodes_) {
                femCorners_.item[cursor[fem_.node[f][k]]++] = f * corners + k;
            }
        }
    }
    femInner_.resize(innerNodes_);
    femInnerOld_ = true;
    femStep_.step = 0;
}

/// Keeps what a cell that has come to rest has put on its corners. Where it rested before, its nodes have
/// their velocities already.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sampleFemCell(int c)
{
    const int f = femOf_[c];
    FemCell& fem = femCells_[f];
    const double inverse = 1 / inertiaScale_[c];
    double volume = 0, poreVolume = 0;
    for (int k = 0; k < corners; ++k) {
        const Node& node = nodes_[cellNodes_[c * corners + k]];
        Corner& corner = cornerSums_[c * corners + k];
        fem.mass[k] = inverse * corner.mass;
        if (fem.restedBefore) {
            corner.momentumR = corner.mass * node.vr;
            corner.momentumZ = corner.mass * node.vz;
        }
        if constexpr (twoPhase) {
            const LiquidNode& liquidNode = liquidNodes_[cellNodes_[c * corners + k]];
            LiquidCorner& liquid = cornerSums_[c * corners + k].liquid;
            FemLiquidCell& kept = femLiquidCells_[f];
            kept.mass[k] = inverse * liquid.mass;
            kept.drag[k] = liquid.drag;
            kept.volume[k] = liquid.volume;
            kept.poreVolume[k] = liquid.poreVolume;
            volume += liquid.volume;
            poreVolume += liquid.poreVolume;
            if (fem.restedBefore) {
                liquid.momentumR = liquid.mass * (node.vr + liquidNode.relativeVr);
                liquid.momentumZ = liquid.mass * (node.vz + liquidNode.relativeVz);
            }
        }
    }
    if constexpr (twoPhase) {
        fem_.porosity[f] = poreVolume / volume;
    }
    if (fem_.viscousTime[f] > 0) {
        addViscousForces(c);
    }
}

/// In the step that samples a cell its viscosity takes the velocities that its nodes have.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addViscousForces(int c)
{
    double vr[corners], vz[corners];
    for (int k = 0; k < corners; ++k) {
        const Node& node = nodes_[cellNodes_[c * corners + k]];
        vr[k] = node.vr;
        vz[k] = node.vz;
    }
    shapes::VelocityGradient<corners> rate;
    Shape::velocityGradient(cells_[c], vr, vz, rate);
    const std::array<double, 4>& mean = meanRate_[c];
    const double beside[4] = {rate[0][0] - mean[0], rate[0][1] - mean[1], rate[0][2] - mean[2],
                              rate[0][3] + rate[0][4] - mean[3]};
    shapes::StressField<corners> stress{};
    addFemViscosity<double>(femCells_[femOf_[c]].material, fem_.viscousTime[femOf_[c]], beside, stress[0]);
    double forceR[corners] = {}, forceZ[corners] = {};
    Shape::addForces(cells_[c], stress, forceR, forceZ);
    for (int k = 0; k < corners; ++k) {
        Corner& corner = cornerSums_[c * corners + k];
        corner.forceR += forceR[k];
        corner.forceZ += forceZ[k];
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sumInnerNodes()
{
    femInnerOld_ = false;
    const auto sum = [this](int j) {
        FemInner inner{};
        double mass = 0, liquidMass = 0, volume = 0, poreVolume = 0;
        for (int n = femCorners_.start[j]; n < femCorners_.start[j + 1]; ++n) {
            const int f = femCorners_.item[n] / corners;
            const int k = femCorners_.item[n] % corners;
            const FemCell& fem = femCells_[f];
            const double weight = fem.mass[k] * weighing(fem.material);
            mass += inertiaScale_[fem.cell] * fem.mass[k];
            inner.weightR += weight * scene_.gravity[0];
            inner.weightZ += weight * scene_.gravity[1];
            if constexpr (twoPhase) {
                const FemLiquidCell& liquid = femLiquidCells_[f];
                liquidMass += inertiaScale_[fem.cell] * liquid.mass[k];
                inner.drag += liquid.drag[k];
                volume += liquid.volume[k];
                poreVolume += liquid.poreVolume[k];
            }
        }
        inner.inverseMass = 1 / mass;
        if constexpr (twoPhase) {
            inner.inverseLiquidMass = 1 / liquidMass;
            inner.porosity = poreVolume / volume;
            inner.liquidShare = liquidMass / (mass + liquidMass);
        }
        femInner_[j] = inner;
    };
    threads_.share(innerNodes_, nodesPerPiece, [&](int, int begin, int end) {
        for (int j = begin; j < end; ++j) {
            sum(j);
        }
    });
}

namespace kernels {

/// An inner node, or four of them.
template <class Real>
struct InnerNodes
{
    Real forceR, forceZ, pressureR, pressureZ; ///< of the stress of the soil, of the excess pore pressure
    Real inverseMass, inverseLiquidMass, drag, porosity, liquidShare; ///< as of FemInner
    Real vr, vz, relativeR, relativeZ;                                ///< FemMotion
    Real strainR, strainZ, keep;                                      ///< FemHistory

    /// What solveNodes and accumulateFemNodes do elsewhere, in one go.
    template <int phases>
    [[gnu::always_inline]] void move(double dt, double damping)
    {
        using std::abs, std::copysign;
        if constexpr (phases == 2) {
            const Real ofLiquidR = porosity * pressureR;
            const Real ofLiquidZ = porosity * pressureZ;
            forceR += pressureR - ofLiquidR;
            forceZ += pressureZ - ofLiquidZ;
            if (damping > 0) { // as in solveTwoPhaseNode
                forceR -= copysign(Real(damping * abs(forceR + ofLiquidR)), vr);
                forceZ -= copysign(Real(damping * abs(forceZ + ofLiquidZ)), vz);
            }
            const Real solidR = dt * forceR * inverseMass;
            const Real solidZ = dt * forceZ * inverseMass;
            const Real freeR = relativeR + dt * ofLiquidR * inverseLiquidMass - solidR;
            const Real freeZ = relativeZ + dt * ofLiquidZ * inverseLiquidMass - solidZ;
            const Real kept = 1 / (1 + dt * drag * (inverseMass + inverseLiquidMass));
            const Real given = liquidShare * (1 - kept); // by drag, to the solid
            vr = vr + solidR + given * freeR;
            vz = vz + solidZ + given * freeZ;
            relativeR = kept * freeR;
            relativeZ = kept * freeZ;
            keep *= kept;
        } else {
            if (damping > 0) {
                forceR -= copysign(Real(damping * abs(forceR)), vr);
                forceZ -= copysign(Real(damping * abs(forceZ)), vz);
            }
            vr += dt * forceR * inverseMass;
            vz += dt * forceZ * inverseMass;
        }
        strainR += dt * vr;
        strainZ += dt * vz;
    }
};

} // namespace kernels

/// What the cells at rest around an inner node put on it.
template <class Shape, int phases>
[[gnu::always_inline]] inline auto ExplicitStep<Shape, phases>::innerForce(int j) const -> FemForce
{
    FemForce force{};
    for (int n = femCorners_.start[j]; n < femCorners_.start[j + 1]; ++n) {
        const FemForce& ofCell = femForces_[femCorners_.item[n]];
        for (std::size_t d = 0; d < force.size(); ++d) {
            force[d] += ofCell[d];
        }
    }
    return force;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::solveInnerNodes(double dt)
{
    const double damping = scene_.controls.localDamping;
    const bool seepage = !twoPhase && !seepage_.empty();
    const auto solve = [&](int j) {
        const FemInner& inner = femInner_[j];
        FemMotion& motion = femMotion_[j];
        FemHistory& history = femHistory_[j];
        const FemForce force = innerForce(j);
        kernels::InnerNodes<double> node{};
        node.forceR = force[0] + inner.weightR;
        node.forceZ = force[1] + inner.weightZ;
        if (seepage) {
            node.forceR += waterLoad_[femNodes_[j].node][0];
            node.forceZ += waterLoad_[femNodes_[j].node][1];
        }
        node.inverseMass = inner.inverseMass;
        node.vr = motion[0];
        node.vz = motion[1];
        if constexpr (twoPhase) {
            node.pressureR = force[2];
            node.pressureZ = force[3];
            node.inverseLiquidMass = inner.inverseLiquidMass;
            node.drag = inner.drag;
            node.porosity = inner.porosity;
            node.liquidShare = inner.liquidShare;
            node.relativeR = motion[2];
            node.relativeZ = motion[3];
        }
        node.strainR = history.strainR;
        node.strainZ = history.strainZ;
        node.keep = history.keep;
        node.template move<phases>(dt, damping);
        if constexpr (twoPhase) {
            motion = {node.vr, node.vz, node.relativeR, node.relativeZ};
        } else {
            motion = {node.vr, node.vz};
        }
        history.strainR = node.strainR;
        history.strainZ = node.strainZ;
        history.keep = node.keep;
        return std::max(std::abs(history.strainR), std::abs(history.strainZ)) > history.mayMove;
    };
    std::ranges::fill(restless_, 0);
    threads_.share(innerNodes_, nodesPerPiece, [&](int thread, int begin, int end) {
        bool restless = false;
        int j = begin;
        if constexpr (hasFours && twoPhase) {
            for (; j + 4 <= end; j += 4) {
                restless = solveFourInnerNodes(j, dt) || restless;
            }
        }
        for (; j < end; ++j) {
            restless = solve(j) || restless;
        }
        restless_[thread] |= restless ? 1 : 0;
    });
}

/// @returns whether the points round one of them have moved too far to rest on
template <class Shape, int phases>
[[gnu::always_inline]] inline bool ExplicitStep<Shape, phases>::solveFourInnerNodes(int j, double dt)
    requires(hasFours && twoPhase)
{
    const auto numbersOf = []<class Element>(const Element&) { return sizeof(Element) / sizeof(double); };
    std::array<FemForce, 4> forces;
    for (int l = 0; l < 4; ++l) {
        forces[l] = innerForce(j + l);
    }
    FemInner& inner = femInner_[j];
    FemMotion& motion = femMotion_[j];
    FemHistory& history = femHistory_[j];
    const auto [forceR, forceZ, pressureR, pressureZ] = columns(forces[0].data(), 4);
    const auto [weightR, weightZ, inverseMass, inverseLiquidMass] = columns(&inner.weightR, numbersOf(inner));
    const auto [drag, porosity, liquidShare, none] = columns(&inner.drag, numbersOf(inner));
    const auto [vr, vz, relativeR, relativeZ] = columns(motion.data(), numbersOf(motion));
    const auto [strainR, strainZ, keep, mayMove] = columns(&history.strainR, numbersOf(history));
    kernels::InnerNodes<Four> nodes{forceR + weightR,
                                    forceZ + weightZ,
                                    pressureR,
                                    pressureZ,
                                    inverseMass,
                                    inverseLiquidMass,
                                    drag,
                                    porosity,
                                    liquidShare,
                                    vr,
                                    vz,
                                    relativeR,
                                    relativeZ,
                                    strainR,
                                    strainZ,
                                    keep};
    nodes.template move<phases>(dt, scene_.controls.localDamping);
    setColumns(motion.data(), numbersOf(motion), {nodes.vr, nodes.vz, nodes.relativeR, nodes.relativeZ});
    setColumns(&history.strainR, numbersOf(history), {nodes.strainR, nodes.strainZ, nodes.keep, mayMove});
    return any_of(max(abs(nodes.strainR), abs(nodes.strainZ)) > mayMove);
}

/// Step that the cells at rest allow.
template <class Shape, int phases>
StableStep ExplicitStep<Shape, phases>::femStep(const State& state) const
{
    if (femStep_.step == 0) {
        femStep_.step = std::numeric_limits<double>::max();
        for (const FemCell& fem : femCells_) {
            const double step = cellStep(state, fem.cell);
            if (step < femStep_.step) {
                femStep_ = {step, fem.cell, 0, 0};
            }
        }
    }
    return femStep_;
}

namespace kernels {

/// one/other within 0 and 1, and 0 where other is zero.
template <class Real>
[[gnu::always_inline]] inline Real shareOf(const Real& one, const Real& other)
{
    if constexpr (std::is_same_v<Real, double>) {
        return other > 0 ? std::clamp(one / other, 0.0, 1.0) : 0.0;
    } else {
        Real share = clamp(one / other, Real(0), Real(1));
        where(!(other > 0), share) = 0;
        return share;
    }
}

/// 1 over a number that is not negative, and 0 where that is next to nothing.
template <class Real>
[[gnu::always_inline]] inline Real inverseOf(const Real& number)
{
    constexpr double least = std::numeric_limits<double>::min();
    if constexpr (std::is_same_v<Real, double>) {
        return number > least ? 1 / number : 0.0;
    } else {
        Real inverse = 1 / number;
        where(!(number > least), inverse) = 0;
        return inverse;
    }
}

/// Of the rate of strain of a step in the mean rate: so this is that of some fifty steps.
inline constexpr double shareOfRate = 0.02;

} // namespace kernels

/// The stress of the viscosity: a time of the elastic one of a rate of strain.
template <class Shape, int phases>
template <class Real>
[[gnu::always_inline]] inline void
ExplicitStep<Shape, phases>::addFemViscosity(int material, const Real& time, const Real (&rate)[4],
                                             Real (&stress)[4]) const
{
    const double shear = shearModulus_[material];
    const Real ofVolume = (pWaveModulus_[material] - 2 * shear) * (rate[0] + rate[1] + rate[2]);
    for (int j = 0; j < 3; ++j) {
        stress[j] += time * (ofVolume + 2 * shear * rate[j]);
    }
    stress[3] += time * (shear * rate[3]);
}

/// What `count` cells at rest from the f-th on put on their corners.
template <class Shape, int phases>
template <class Real, class Count>
[[gnu::always_inline]] inline void ExplicitStep<Shape, phases>::addFemForces(const State& state,
                                                                             const FemBlock& block,
                                                                             int material, int f, Count count)
{
    const auto& cell = femShapes_.at(f, count);
    shapes::StressField<corners, Real> stress;
    for (int j = 0; j < 4; ++j) {
        stress[0][j] = shapes::lanesOf<Real>(fem_.stress[j], f, count);
        if constexpr (corners == 4) {
            stress[1][j] = shapes::lanesOf<Real>(fem_.slopeXi[j], f, count);
            stress[2][j] = shapes::lanesOf<Real>(fem_.slopeEta[j], f, count);
        }
    }
    if (block.viscous) {
        const double perStep = 1 / block.dt;
        Real rate[4];
        for (int j = 0; j < 4; ++j) {
            rate[j] = perStep * shapes::lanesOf<Real>(block.strain[j], f - block.begin, count);
            const Real mean = shapes::lanesOf<Real>(fem_.meanRate[j], f, count);
            rate[j] -= mean;
            shapes::setLanes(fem_.meanRate[j].data(), f, count, Real(mean + kernels::shareOfRate * rate[j]));
        }
        addFemViscosity<Real>(material, shapes::lanesOf<Real>(fem_.viscousTime, f, count), rate, stress[0]);
    }
    if (scene_.controls.isViscous()) {
        Real viscous = shapes::zero<Real>();
        for (int l = 0; l < count; ++l) {
            shapes::setLane(viscous, l, viscousStress(state, femCells_[f + l].cell, material));
        }
        for (int j = 0; j < 3; ++j) {
            stress[0][j] += viscous;
        }
    }
    Real force[twoPhase ? 4 : 2][corners];
    for (auto& ofCorners : force) {
        std::fill_n(ofCorners, corners, shapes::zero<Real>());
    }
    Shape::addForces(cell, stress, force[0], force[1]);
    if constexpr (twoPhase) {
        const Real pressure = shapes::lanesOf<Real>(fem_.pressure, f, count);
        Shape::addPressure(cell, pressure, force[2], force[3]);
    }
    FemForce* const out = &femForces_[static_cast<std::size_t>(f) * corners];
    for (int k = 0; k < corners; ++k) {
        if constexpr (twoPhase && std::is_same_v<Real, Four>) {
            std::array<Four, 4> rows{force[0][k], force[1][k], force[2][k], force[3][k]};
            transpose(rows);
            for (int l = 0; l < count; ++l) {
                rows[l].copy_to(out[l * corners + k].data(), std::experimental::element_aligned);
            }
        } else {
            for (int l = 0; l < count; ++l) {
                for (int j = 0; j < (twoPhase ? 4 : 2); ++j) {
                    out[l * corners + k][j] = shapes::lane(force[j][k], l);
                }
            }
        }
    }
}

/// Their forces are known since they were strained.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapFemCellsToNodes()
{
    if (femInnerOld_) {
        sumInnerNodes();
    }
    threads_.share(static_cast<int>(femEdge_.size()), cellsPerPiece, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            mapFemEdgeToNodes(femEdge_[i]);
        }
    });
}

/// A cell at rest beside others: the nodes between them need its masses and momenta.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapFemEdgeToNodes(int f)
{
    const FemCell& fem = femCells_[f];
    const int c = fem.cell;
    const double inertia = inertiaScale_[c];
    for (int k = 0; k < corners; ++k) {
        const int i = cellNodes_[c * corners + k];
        const Node& node = nodes_[i];
        const FemForce& force = femForces_[static_cast<std::size_t>(f) * corners + k];
        const double mass = inertia * fem.mass[k];
        const double weight = fem.mass[k] * weighing(fem.material);
        Corner& corner = cornerSums_[c * corners + k];
        static_cast<SolidCorner&>(corner) = {mass,
                                             mass * node.vr,
                                             mass * node.vz,
                                             mass,
                                             force[0] + weight * scene_.gravity[0],
                                             force[1] + weight * scene_.gravity[1]};
        if constexpr (twoPhase) {
            const FemLiquidCell& liquid = femLiquidCells_[f];
            const LiquidNode& old = liquidNodes_[i];
            const double liquidMass = inertia * liquid.mass[k];
            corner.pressureR = force[2];
            corner.pressureZ = force[3];
            corner.liquid = {liquidMass,
                             liquidMass * (node.vr + old.relativeVr),
                             liquidMass * (node.vz + old.relativeVz),
                             liquid.drag[k],
                             liquid.volume[k],
                             liquid.poreVolume[k],
                             fem_.pressure[f] * liquid.volume[k]};
        }
    }
}

/// A loose node that cells at rest share takes their part of its momentum as it is.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::keepFemMomentum(int c)
{
    for (int k = 0; k < corners; ++k) {
        const int i = cellNodes_[c * corners + k];
        Corner& corner = cornerSums_[c * corners + k];
        corner.momentumR = corner.mass * nodes_[i].vr;
        corner.momentumZ = corner.mass * nodes_[i].vz;
        if constexpr (twoPhase) {
            LiquidCorner& liquid = corner.liquid;
            liquid.momentumR = liquid.mass * liquidNodes_[i].relativeVr;
            liquid.momentumZ = liquid.mass * liquidNodes_[i].relativeVz;
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::accumulateFemNodes(double dt)
{
    femFlip_ *= scene_.controls.flipOf(dt);
    femTime_ += dt;
    const bool first = femSteps_ == 0; // of inner nodes, too, which go on from here
    if (first) {
        std::ranges::fill(restless_, 0);
    }
    const auto accumulate = [&](int j) {
        FemNode& fem = femNodes_[j];
        FemHistory& history = femHistory_[j];
        const Node& node = nodes_[fem.node];
        fem.placeR += dt * node.placeVr;
        fem.placeZ += dt * node.placeVz;
        fem.dvr += node.dvr;
        fem.dvz += node.dvz;
        history.strainR += dt * node.vr;
        history.strainZ += dt * node.vz;
        if constexpr (twoPhase) {
            const LiquidNode& liquid = liquidNodes_[fem.node];
            fem.relativeR = liquid.keep * (fem.relativeR - liquid.oldRelativeVr) + liquid.relativeVr;
            fem.relativeZ = liquid.keep * (fem.relativeZ - liquid.oldRelativeVz) + liquid.relativeVz;
            history.keep *= liquid.keep;
            if (first) {
                femStart_[j] = {node.vr - node.dvr, node.vz - node.dvz, liquid.oldRelativeVr,
                                liquid.oldRelativeVz};
            }
        } else if (first) {
            femStart_[j] = {node.vr - node.dvr, node.vz - node.dvz};
        }
        return std::max(std::abs(fem.placeR), std::abs(fem.placeZ)) > history.mayMove;
    };
    const int begin = first ? 0 : innerNodes_;
    const int count = static_cast<int>(femNodes_.size()) - begin;
    threads_.share(count, nodesPerPiece, [&](int thread, int from, int to) {
        bool restless = false;
        for (int j = from; j < to; ++j) {
            restless = accumulate(begin + j) || restless;
        }
        restless_[thread] |= restless ? 1 : 0;
    });
}

/// Gives the inner nodes their velocities, as the others have them.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::returnInnerMotion()
{
    threads_.share(innerNodes_, nodesPerPiece, [&](int, int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const FemMotion& motion = femMotion_[j];
            Node& node = nodes_[femNodes_[j].node];
            node.vr = motion[0];
            node.vz = motion[1];
            if constexpr (twoPhase) {
                liquidNodes_[femNodes_[j].node].relativeVr = motion[2];
                liquidNodes_[femNodes_[j].node].relativeVz = motion[3];
            }
        }
    });
}

/// In which direction the mean of a cell has yielded in this step: the deviator of stress that it has lost to
/// the elastic one, of unit length, times the root of the share that it has lost of the elastic one in that
/// direction. The slopes take this from theirs in the next step; in other directions they stay elastic, as
/// stress does along a yield surface. Slopes that stayed elastic in all of them would make the soil round a
/// tip stiffer by several per cent; slopes that lost the same share in all of them had vibrations grow.
template <class Shape, int phases>
template <class Real, class Count>
[[gnu::always_inline]] inline void ExplicitStep<Shape, phases>::setYielding(const FemBlock& block,
                                                                            int material, int f, Count count)
{
    using std::sqrt, std::max;
    Real before[4], change[4], strain[4];
    for (int j = 0; j < 4; ++j) {
        before[j] = shapes::lanesOf<Real>(block.stressBefore[j], f - block.begin, count);
        change[j] = shapes::lanesOf<Real>(fem_.stress[j], f, count) - before[j];
        strain[j] = shapes::lanesOf<Real>(block.strain[j], f - block.begin, count);
    }
    // Less what a rotation changes (Jaumann's rate)
    const Real spin = shapes::lanesOf<Real>(block.spin, f - block.begin, count);
    change[0] += 2 * spin * before[3];
    change[1] -= 2 * spin * before[3];
    change[3] -= spin * (before[0] - before[1]);
    const double shear = shearModulus_[material];
    const Real dilatation = (strain[0] + strain[1] + strain[2]) / 3;
    const Real pressure = (change[0] + change[1] + change[2]) / 3;
    Real lost[4];
    Real length = shapes::zero<Real>(); // squared
    Real along = length;                // of the elastic one, times that length
    for (int j = 0; j < 4; ++j) {
        const Real elastic = j < 3 ? Real(2 * shear * (strain[j] - dilatation)) : Real(shear * strain[3]);
        const double weight = j < 3 ? 1 : 2; // rz and zr
        lost[j] = elastic - (j < 3 ? Real(change[j] - pressure) : change[3]);
        length += weight * lost[j] * lost[j];
        along += weight * lost[j] * elastic;
    }
    const Real share = kernels::shareOf<Real>(length, along);
    const Real factor = sqrt(share * kernels::inverseOf<Real>(length));
    shapes::setLanes(fem_.yielded.data(), f, count,
                     max(share, shapes::lanesOf<Real>(fem_.yielded, f, count)));
    for (int j = 0; j < 4; ++j) {
        shapes::setLanes(fem_.yielding[j].data(), f, count, Real(factor * lost[j]));
    }
}

/// Strains `count` cells at rest of one material, from the f-th on.
template <class Shape, int phases>
template <class Count>
[[gnu::always_inline]] inline void ExplicitStep<Shape, phases>::strainFemCells(State& state, double dt,
                                                                               FemBlock& block, int material,
                                                                               int f, Count count)
{
    using Real = shapes::Lanes<Shape::lanes>;
    const int inBlock = f - block.begin;
    const bool nodalAverage = scene_.controls.locking == SolutionControls::Locking::nodalAverage;
    const auto& cell = femShapes_.at(f, count);
    Real vr[corners], vz[corners];
    [[maybe_unused]] Real relativeR[corners], relativeZ[corners];
    for (int k = 0; k < corners; ++k) {
        const auto motion = [&](int l) -> const FemMotion& {
            return femMotion_[fem_.node[f + std::min<int>(l, count - 1)][k]];
        };
        if constexpr (std::is_same_v<Real, double>) {
            vr[k] = motion(0)[0];
            vz[k] = motion(0)[1];
            if constexpr (twoPhase) {
                relativeR[k] = motion(0)[2];
                relativeZ[k] = motion(0)[3];
            }
        } else if constexpr (twoPhase) {
            std::array<Four, 4> rows;
            for (int l = 0; l < 4; ++l) {
                rows[l] = Four(motion(l).data(), std::experimental::element_aligned);
            }
            transpose(rows);
            vr[k] = rows[0];
            vz[k] = rows[1];
            relativeR[k] = rows[2];
            relativeZ[k] = rows[3];
        } else {
            vr[k] = four(motion(0)[0], motion(1)[0], motion(2)[0], motion(3)[0]);
            vz[k] = four(motion(0)[1], motion(1)[1], motion(2)[1], motion(3)[1]);
        }
    }
    shapes::VelocityGradient<corners, Real> rate;
    Shape::velocityGradient(cell, vr, vz, rate);
    if constexpr (corners == 4) {
        const double shear = shearModulus_[material] * dt;
        const bool yields = fem_.yields[block.begin] != 0;
        Real yielding[4];
        for (int j = 0; yields && j < 4; ++j) {
            yielding[j] = shapes::lanesOf<Real>(fem_.yielding[j], f, count);
        }
        const auto updateSlopes = [&](const Real(&slope)[5], const std::vector<double>& shareAtPoints,
                                      std::array<std::vector<double>, 4>& stress)
            __attribute__((always_inline))
        {
            const Real share = shear * shapes::lanesOf<Real>(shareAtPoints, f, count);
            const Real third = (slope[0] + slope[1] + slope[2]) / 3; // all points share one dilatation
            Real change[4];
            for (int j = 0; j < 3; ++j) {
                change[j] = 2 * share * (slope[j] - third);
            }
            change[3] = share * (slope[3] + slope[4]);
            if (yields) {
                const Real lost = yielding[0] * change[0] + yielding[1] * change[1] +
                                  yielding[2] * change[2] + 2 * yielding[3] * change[3];
                for (int j = 0; j < 4; ++j) {
                    change[j] -= lost * yielding[j];
                }
            }
            for (int j = 0; j < 4; ++j) {
                const Real sum = shapes::lanesOf<Real>(stress[j], f, count) + change[j];
                shapes::setLanes(stress[j].data(), f, count, sum);
            }
        };
        updateSlopes(rate[1], fem_.shareXi, fem_.slopeXi);
        updateSlopes(rate[2], fem_.shareEta, fem_.slopeEta);
    }
    const Real own = rate[0][0] + rate[0][1] + rate[0][2];
    Real trace = own;
    for (int l = 0; nodalAverage && l < count; ++l) {
        shapes::setLane(trace, l, cellRate_[femCells_[f + l].cell]);
    }
    const Real shift = (trace - own) / 3;
    for (int j = 0; j < 3; ++j) {
        const Real strain = dt * (rate[0][j] + shift);
        shapes::setLanes(block.strain[j], inBlock, count, strain);
    }
    const Real shear = dt * (rate[0][3] + rate[0][4]);
    const Real spin = 0.5 * dt * (rate[0][4] - rate[0][3]);
    const Real dilatation = shapes::lanesOf<Real>(fem_.dilatation, f, count) + dt * trace;
    shapes::setLanes(block.strain[3], inBlock, count, shear);
    shapes::setLanes(block.spin, inBlock, count, spin);
    shapes::setLanes(fem_.dilatation.data(), f, count, dilatation);
    for (int j = 0; j < 4; ++j) {
        shapes::setLanes(block.stressBefore[j], inBlock, count,
                         shapes::lanesOf<Real>(fem_.stress[j], f, count));
    }
    for (int l = 0; scene_.controls.isViscous() && l < count; ++l) {
        state.cellDivergence[femCells_[f + l].cell] = shapes::lane(trace, l);
    }
    if constexpr (twoPhase) {
        Real flow = shapes::zero<Real>(); // of the liquid relative to the soil
        if (nodalAverage) {
            for (int l = 0; l < count; ++l) {
                const int c = femCells_[f + l].cell;
                shapes::setLane(flow, l, cellLiquidRate_[c] - cellRate_[c]);
            }
        } else {
            flow = Shape::divergence(cell, relativeR, relativeZ);
        }
        const Real n = shapes::lanesOf<Real>(fem_.porosity, f, count);
        Real pressure = shapes::lanesOf<Real>(fem_.pressure, f, count);
        if (projects()) {
            for (int l = 0; l < count; ++l) {
                shapes::setLane(pressure, l,
                                shapes::lane(pressure, l) + pressureStep_[femCells_[f + l].cell]);
            }
        } else {
            pressure -= dt * liquid_[material].bulkModulus / n * (trace + n * flow);
        }
        shapes::setLanes(fem_.pressure.data(), f, count, pressure);
    }
}

/// Strains and stresses of the cells at rest, from the velocities of their nodes.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateFemCells(State& state, double dt)
{
    const int first = femSteps_ == 0 ? 0 : innerNodes_;
    threads_.share(static_cast<int>(femNodes_.size()) - first, nodesPerPiece, [&](int, int begin, int end) {
        for (int j = first + begin; j < first + end; ++j) {
            const Node& node = nodes_[femNodes_[j].node];
            if constexpr (twoPhase) {
                const LiquidNode& liquid = liquidNodes_[femNodes_[j].node];
                femMotion_[j] = {node.vr, node.vz, liquid.relativeVr, liquid.relativeVz};
            } else {
                femMotion_[j] = {node.vr, node.vz};
            }
        }
    });
    using Real = shapes::Lanes<Shape::lanes>;
    const auto update = [&](int thread, const FemRun& run, int from, int to) {
        const int material = run.material;
        for (int begin = from; begin < to; begin += FemBlock::size) {
            const int end = std::min(begin + FemBlock::size, to);
            FemBlock block;
            block.begin = begin;
            block.dt = dt;
            block.viscous = run.viscous;
            shapes::inLanes<Shape::lanes>(
                begin, end, [&](int f, auto count) { strainFemCells(state, dt, block, material, f, count); });
            const bool yields =
                updateBatch(material, thread, begin, end,
                            {block.strain[0], block.strain[1], block.strain[2], block.strain[3]}, block.spin,
                            fem_.stress, fem_.state);
            fem_.yields[begin] = yields ? 1 : 0;
            shapes::inLanes<Shape::lanes>(begin, end, [&](int f, auto count) {
                if (yields) {
                    setYielding<Real>(block, material, f, count);
                }
                addFemForces<Real>(state, block, material, f, count);
            });
        }
    };
    inBlocks(std::span<const FemRun>(femRuns_), update);
    ++femSteps_;
}

/// What the viscosity of the cells needs in their next rest. The mean rate of those that had none follows
/// from what they have been strained by.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::keepMeanRates(const State& state)
{
    constexpr double least = 0.01; // share of the elastic stiffness lost
    const double passed = std::pow(1 - kernels::shareOfRate, static_cast<double>(femSteps_));
    const auto keep = [&](const FemRun& run, int f) {
        const int c = femCells_[f].cell;
        if (fem_.yielded[f] > least) {
            yieldedAt_[c] = state.step;
        }
        if (run.viscous) {
            for (int j = 0; j < 4; ++j) {
                meanRate_[c][j] = fem_.meanRate[j][f];
            }
            return;
        }
        double strainR[corners], strainZ[corners];
        for (int k = 0; k < corners; ++k) {
            strainR[k] = femHistory_[fem_.node[f][k]].strainR;
            strainZ[k] = femHistory_[fem_.node[f][k]].strainZ;
        }
        shapes::VelocityGradient<corners> sum;
        Shape::velocityGradient(cells_[c], strainR, strainZ, sum);
        const double shift = (fem_.dilatation[f] - sum[0][0] - sum[0][1] - sum[0][2]) / 3;
        const double strain[4] = {sum[0][0] + shift, sum[0][1] + shift, sum[0][2] + shift,
                                  sum[0][3] + sum[0][4]};
        for (int j = 0; j < 4; ++j) {
            meanRate_[c][j] = passed * meanRate_[c][j] + (1 - passed) * strain[j] / femTime_;
        }
    };
    const auto keepThose = [&](int, const FemRun& run, int begin, int end) {
        for (int f = begin; scene_.materials[run.material].law->plastic() && f < end; ++f) {
            keep(run, f);
        }
    };
    inBlocks(std::span<const FemRun>(femRuns_), keepThose);
}

/// The points that rest catch up with their cells, which are cells of points again.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::wakeFemCells(State& state)
{
    if (femCells_.empty()) {
        return;
    }
    if (femSteps_ > 1) {
        returnInnerMotion();
        const double step = femTime_ / static_cast<double>(femSteps_);
        const auto sum = [&](int j) { // what the others have summed
            FemNode& fem = femNodes_[j];
            const FemMotion& start = femStart_[j];
            const FemMotion& motion = femMotion_[j];
            fem.dvr = motion[0] - start[0];
            fem.dvz = motion[1] - start[1];
            fem.placeR = femHistory_[j].strainR - 0.5 * step * fem.dvr;
            fem.placeZ = femHistory_[j].strainZ - 0.5 * step * fem.dvz;
            if constexpr (twoPhase) {
                fem.relativeR = motion[2] - femHistory_[j].keep * start[2];
                fem.relativeZ = motion[3] - femHistory_[j].keep * start[3];
                double volume = 0, pressureVolume = 0;
                for (int n = femCorners_.start[j]; n < femCorners_.start[j + 1]; ++n) {
                    const int f = femCorners_.item[n] / corners;
                    const double ofCorner = femLiquidCells_[f].volume[femCorners_.item[n] % corners];
                    volume += ofCorner;
                    pressureVolume += fem_.pressure[f] * ofCorner;
                }
                liquidNodes_[fem.node].pressure = pressureVolume / volume;
            }
        };
        threads_.share(innerNodes_, nodesPerPiece, [&](int, int begin, int end) {
            for (int j = begin; j < end; ++j) {
                sum(j);
            }
        });
    }
    if (scene_.controls.femViscosity > 0) {
        keepMeanRates(state);
    }
    const auto wake = [&](int c) {
        if (resting(c)) {
            wakeFemCell(state, c);
        }
    };
    if constexpr (hasFours) {
        const auto mayJoin = [this](int c) { return resting(c); };
        forPieces(active_, mayJoin, wake, [&](std::span<const int> cells) {
            std::array<CellMotion, cellsPerPiece> motions;
            std::ranges::transform(cells, motions.begin(), [this](int c) { return motionSinceRest(c); });
            moveByFours<true>(state, 1, cells, motions.data());
        });
    } else {
        forCells(wake);
    }
    updateStress(state, true);
    std::ranges::fill(femOf_, -1);
    femCells_.clear();
    std::ranges::fill(innerNode_, 0);
    divideCells();
    femSteps_ = 0;
    femTime_ = 0;
    femFlip_ = 1;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::wakeFemCell(State& state, int c)
{
    MaterialPoints& points = state.points;
    const int f = femOf_[c];
    const double dilatation = fem_.dilatation[f];
    const typename Shape::Cell& cell = cells_[c];
    double strainR[corners], strainZ[corners];
    for (int k = 0; k < corners; ++k) {
        strainR[k] = femHistory_[fem_.node[f][k]].strainR;
        strainZ[k] = femHistory_[fem_.node[f][k]].strainZ;
    }
    shapes::VelocityGradient<corners> strain;
    Shape::velocityGradient(cell, strainR, strainZ, strain);
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    // As in the sampling, mean strains are those about the points' centre.
    double centreXi = 0, centreEta = 0;
    if constexpr (corners == 4) {
        centreXi = pointCentre_[c][0];
        centreEta = pointCentre_[c][1];
    }
    double shapeSum = 0;
    double volumeSum = 0;
    Values values;
    for (const int* i = first; i != last; ++i) {
        const int p = *i;
        const auto [xi, eta] = Shape::evaluate(cell, points.r[p], points.z[p], values);
        const auto at = [&](int j) {
            double value = strain[0][j];
            if constexpr (corners == 4) {
                value += (xi - centreXi) * strain[1][j] + (eta - centreEta) * strain[2][j];
            }
            return value;
        };
        const double rr = at(0), zz = at(1), hoop = at(2), rz = at(3), zr = at(4);
        const double shift = (dilatation - rr - zz - hoop) / 3;
        strain_[0][p] = rr + shift;
        strain_[1][p] = zz + shift;
        strain_[2][p] = hoop + shift;
        strain_[3][p] = rz + zr;
        spin_[p] = 0.5 * (zr - rz);
        double dvr = 0, dvz = 0, placeR = 0, placeZ = 0, newR = 0, newZ = 0;
        double relativeR = 0, relativeZ = 0, kept = 0, nodalPressure = 0;
        for (int k = 0; k < corners; ++k) {
            const int node = cellNodes_[c * corners + k];
            const FemNode& since = femNodes_[fem_.node[f][k]];
            const double N = values.N[k];
            dvr += N * since.dvr;
            dvz += N * since.dvz;
            placeR += N * since.placeR;
            placeZ += N * since.placeZ;
            newR += N * nodes_[node].vr;
            newZ += N * nodes_[node].vz;
            if constexpr (twoPhase) {
                relativeR += N * since.relativeR;
                relativeZ += N * since.relativeZ;
                kept += N * femHistory_[fem_.node[f][k]].keep;
                nodalPressure += N * liquidNodes_[node].pressure;
            }
        }
        if constexpr (twoPhase) {
            relativeR += kept * (points.wr[p] - points.vr[p]);
            relativeZ += kept * (points.wz[p] - points.vz[p]);
            points.porePressure[p] = nodalPressure + unitWeight_ * points.z[p];
            shapeSum += points.volume[p] * nodalPressure;
            volumeSum += points.volume[p];
        }
        points.vr[p] = femFlip_ * (points.vr[p] + dvr) + (1 - femFlip_) * newR;
        points.vz[p] = femFlip_ * (points.vz[p] + dvz) + (1 - femFlip_) * newZ;
        if constexpr (twoPhase) {
            points.wr[p] = points.vr[p] + relativeR;
            points.wz[p] = points.vz[p] + relativeZ;
        }
        points.r[p] += placeR;
        points.z[p] += placeZ;
        points.volume[p] = std::min(points.volume[p] * std::exp(dilatation),
                                    points.mass[p] * largestVolume_[points.material[p]]);
    }
    if constexpr (twoPhase) { // the mean of the cell, with the differences that the nodes show
        const double shift = fem_.pressure[f] - shapeSum / volumeSum;
        for (const int* i = first; i != last; ++i) {
            points.porePressure[*i] =
                std::max(points.porePressure[*i] + shift, liquid_[points.material[*i]].leastPressure);
        }
    }
}

} // namespace caisson
