#pragma once

#include "timeStepping/LiquidKernels.h"

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

/// Whether points of one material, without loads, move and strain little in an interval [s].
template <class Shape, int phases>
bool ExplicitStep<Shape, phases>::mayRest(const State& state, int c, double interval) const
{
    const MaterialPoints& points = state.points;
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    double meshVz = 0;
    if (scene_.movingBody >= 0) {
        meshVz = state.bodies[scene_.movingBody].velocity *
                 scene_.motion.weight(scene_.referenceZ[cellNodes_[c * corners]]);
    }
    double lowR = points.vr[*first], highR = lowR;
    double lowZ = points.vz[*first], highZ = lowZ;
    for (const int* i = first; i != last; ++i) {
        const int p = *i;
        if (points.material[p] != points.material[*first] || (points.loaded() && points.load[p] >= 0)) {
            return false;
        }
        lowR = std::min(lowR, points.vr[p]);
        highR = std::max(highR, points.vr[p]);
        lowZ = std::min(lowZ, points.vz[p]);
        highZ = std::max(highZ, points.vz[p]);
    }
    const double speed = std::max({-lowR, highR, meshVz - lowZ, highZ - meshVz});
    const double difference = std::max(highR - lowR, highZ - lowZ);
    const double size = Shape::size(cells_[c]);
    return interval * speed <= scene_.controls.femMotion * size &&
           interval * difference <= scene_.controls.femStrain * size;
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
    const std::vector<unsigned char> restedBefore = rests_;
    rests_.assign(cells_.size(), 0);
    std::vector<unsigned char> near(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        near[i] = contactNode_[i] != 0 || surfaceNode_[i] != 0;
    }
    const double interval = controls.sortInterval * stableStep(state).step;
    for (const int c : activeCells_) {
        rests_[c] = state.filled[c] != 0 && mayRest(state, c, interval);
    }
    for (int ring = 0; ring < std::max(1, controls.femDistance); ++ring) {
        const std::vector<unsigned char> before = near;
        for (const int c : activeCells_) {
            bool touches = false;
            for (int k = 0; k < corners; ++k) {
                touches = touches || before[cellNodes_[c * corners + k]] != 0;
            }
            for (int k = 0; touches && k < corners; ++k) {
                near[cellNodes_[c * corners + k]] = 1;
            }
            rests_[c] = rests_[c] != 0 && !touches;
        }
    }
    // Nodes of partly filled cells may be loose.
    std::ranges::fill(near, 0);
    for (const int c : activeCells_) {
        for (int k = 0; !state.filled[c] && k < corners; ++k) {
            near[cellNodes_[c * corners + k]] = 1;
        }
    }
    for (const int c : activeCells_) {
        for (int k = 0; k < corners; ++k) {
            rests_[c] = rests_[c] != 0 && near[cellNodes_[c * corners + k]] == 0;
        }
    }
    if (!controls.femZone.empty()) {
        std::vector<unsigned char> ofZone(cells_.size(), 0);
        for (const int c : state.mesh.cellZones.at(controls.femZone)) {
            ofZone[c] = rests_[c];
        }
        rests_ = ofZone;
    }

    std::vector<int> chosen;
    std::ranges::copy_if(activeCells_, std::back_inserter(chosen), [&](int c) { return rests_[c] != 0; });
    const auto material = [&](int c) { return points.material[*pointCells_.begin(c)]; };
    std::ranges::stable_sort(chosen, {}, material);
    femCells_.assign(chosen.size(), {});
    femLiquidCells_.assign(twoPhase ? chosen.size() : 0, {});
    femRuns_.clear();
    for (int f = 0; f < static_cast<int>(chosen.size()); ++f) {
        const int c = chosen[f];
        femCells_[f].material = material(c);
        femCells_[f].restedBefore = !restedBefore.empty() && restedBefore[c] != 0;
        femOf_[c] = f;
        if (femRuns_.empty() || femRuns_.back().material != material(c)) {
            femRuns_.push_back({material(c), true, f, f});
        }
        femRuns_.back().end = f + 1;
    }
    for (int j = 0; j < 4; ++j) {
        femStress_[j].resize(chosen.size());
        femStrain_[j].resize(chosen.size());
    }
    femSpin_.resize(chosen.size());
    femState_.resize(points.state.size());
    for (std::size_t k = 0; k < femState_.size(); ++k) {
        femState_[k].resize(chosen.size());
        for (std::size_t f = 0; f < chosen.size(); ++f) {
            double sum = 0;
            for (const int* p = pointCells_.begin(chosen[f]); p != pointCells_.end(chosen[f]); ++p) {
                sum += points.state[k][*p];
            }
            femState_[k][f] = sum / pointCells_.count(chosen[f]);
        }
    }
    femNodes_.assign(nodes_.size(), {});
    nodesOfFem_.clear();
    std::vector<unsigned char>& ofFem = near;
    std::ranges::fill(ofFem, 0);
    for (const int c : chosen) {
        const double mayMove = controls.femMotion * Shape::size(cells_[c]);
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            ofFem[i] = 1;
            femNodes_[i].mayMove = std::min(femNodes_[i].mayMove, mayMove);
        }
    }
    std::ranges::copy_if(activeNodes_, std::back_inserter(nodesOfFem_), [&](int i) { return ofFem[i] != 0; });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapFemCellToNodes(const State& state, int c)
{
    const FemCell& fem = femCells_[femOf_[c]];
    const int material = fem.material;
    const double viscous = viscousStress(state, c, material);
    double forceR[corners], forceZ[corners];
    const double weighing = gravityShare_[material] / (twoPhase ? solidShare_[material] : 1.0);
    for (int k = 0; k < corners; ++k) {
        forceR[k] = fem.mass[k] * weighing * scene_.gravity[0];
        forceZ[k] = fem.mass[k] * weighing * scene_.gravity[1];
    }
    const int f = femOf_[c];
    shapes::StressField<corners> stress;
    for (int j = 0; j < 4; ++j) {
        stress[0][j] = femStress_[j][f] + (j < 3 ? viscous : 0);
    }
    if constexpr (corners == 4) {
        std::copy_n(fem.slopeXi, 4, stress[1]);
        std::copy_n(fem.slopeEta, 4, stress[2]);
    }
    Shape::addForces(cells_[c], stress, forceR, forceZ);

    const double inertia = inertiaScale_[c];
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        const Node& node = nodes_[cellNodes_[c * corners + k]];
        const double mass = inertia * fem.mass[k];
        out[k] = {mass, mass * node.vr, mass * node.vz, forceR[k], forceZ[k], mass};
    }
    if constexpr (twoPhase) {
        const FemLiquidCell& liquid = femLiquidCells_[f];
        const auto& dilatation = dilatation_[c];
        for (int k = 0; k < corners; ++k) {
            const Node& node = nodes_[cellNodes_[c * corners + k]];
            const LiquidNode& old = liquidNodes_[cellNodes_[c * corners + k]];
            const double mass = inertia * liquid.mass[k];
            liquidCorners_[c * corners + k] = {mass,
                                               mass * (node.vr + old.relativeVr),
                                               mass * (node.vz + old.relativeVz),
                                               dilatation.volume * liquid.pressure * dilatation.br[k],
                                               dilatation.volume * liquid.pressure * dilatation.bz[k],
                                               liquid.drag[k],
                                               liquid.volume[k],
                                               liquid.poreVolume[k],
                                               liquid.pressure * liquid.volume[k]};
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
            LiquidCorner& liquid = liquidCorners_[c * corners + k];
            liquid.momentumR = liquid.mass * liquidNodes_[i].relativeVr;
            liquid.momentumZ = liquid.mass * liquidNodes_[i].relativeVz;
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::accumulateFemNodes(double dt)
{
    if (femCells_.empty()) {
        return;
    }
    const SolutionControls& controls = scene_.controls;
    femFlip_ *= std::max(0.0, controls.flipShare - (controls.picTime > 0 ? dt / controls.picTime : 0.0));
    std::ranges::fill(restless_, 0);
    const auto accumulate = [&](int part, int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const int i = nodesOfFem_[j];
            const Node& node = nodes_[i];
            FemNode& fem = femNodes_[i];
            fem.placeR += dt * node.placeVr;
            fem.placeZ += dt * node.placeVz;
            fem.dvr += node.dvr;
            fem.dvz += node.dvz;
            restless_[part] |= std::max(std::abs(fem.placeR), std::abs(fem.placeZ)) > fem.mayMove;
            if constexpr (twoPhase) {
                const LiquidNode& liquid = liquidNodes_[i];
                fem.relativeR = liquid.keep * (fem.relativeR - liquid.oldRelativeVr) + liquid.relativeVr;
                fem.relativeZ = liquid.keep * (fem.relativeZ - liquid.oldRelativeVz) + liquid.relativeVz;
                fem.keep *= liquid.keep;
            }
        }
    };
    const int count = static_cast<int>(nodesOfFem_.size());
    threads_.run([&](int part) {
        inBlocks(0, count, part, [&](int begin, int end) { accumulate(part, begin, end); });
    });
}

/// Share of the elastic stiffness in shear that the mean of a cell showed in the step before: 1 where it is
/// elastic. Slopes that stayed elastic where the mean yields would make the soil round a tip stiffer by
/// several per cent.
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::tangentShare(int f)
{
    double(&before)[4] = femCells_[f].stressBefore;
    double change[4];
    for (int j = 0; j < 4; ++j) {
        change[j] = femStress_[j][f] - before[j];
        before[j] = femStress_[j][f];
    }
    if (!scene_.materials[femCells_[f].material].law->plastic() || femSteps_ == 0) {
        return 1;
    }
    const double shear = shearModulus_[femCells_[f].material];
    const double dilatation = (femStrain_[0][f] + femStrain_[1][f] + femStrain_[2][f]) / 3;
    const double pressure = (change[0] + change[1] + change[2]) / 3;
    double elastic = 2 * shear * femStrain_[3][f] * shear * femStrain_[3][f];
    double actual = 2 * shear * femStrain_[3][f] * change[3];
    for (int j = 0; j < 3; ++j) {
        const double deviator = 2 * shear * (femStrain_[j][f] - dilatation);
        elastic += deviator * deviator;
        actual += deviator * (change[j] - pressure);
    }
    return elastic > 0 ? std::clamp(actual / elastic, 0.0, 1.0) : 1.0;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::strainFemCell(State& state, double dt, int c)
{
    const int f = femOf_[c];
    FemCell& fem = femCells_[f];
    double vr[corners], vz[corners];
    for (int k = 0; k < corners; ++k) {
        vr[k] = nodes_[cellNodes_[c * corners + k]].vr;
        vz[k] = nodes_[cellNodes_[c * corners + k]].vz;
    }
    shapes::VelocityGradient<corners> rate;
    Shape::velocityGradient(cells_[c], vr, vz, rate);
    if constexpr (corners == 4) {
        const double shear = tangentShare(f) * shearModulus_[fem.material] * dt;
        const auto updateSlopes = [&](const double(&slope)[5], double share, double(&stress)[4]) {
            const double third = (slope[0] + slope[1] + slope[2]) / 3; // all points share one dilatation
            for (int j = 0; j < 3; ++j) {
                stress[j] += 2 * share * shear * (slope[j] - third);
            }
            stress[3] += share * shear * (slope[3] + slope[4]);
        };
        updateSlopes(rate[1], fem.shareXi, fem.slopeXi);
        updateSlopes(rate[2], fem.shareEta, fem.slopeEta);
    }
    for (int m = 0; m < momentCount; ++m) {
        for (int j = 0; j < 5; ++j) {
            fem.strain[m][j] += dt * rate[m][j];
        }
    }
    const bool nodalAverage = scene_.controls.locking == SolutionControls::Locking::nodalAverage;
    const double own = rate[0][0] + rate[0][1] + rate[0][2];
    const double trace = nodalAverage ? cellRate_[c] : own;
    const double shift = (trace - own) / 3;
    fem.dilatation += dt * trace;
    state.cellDivergence[c] = trace;
    for (int j = 0; j < 3; ++j) {
        femStrain_[j][f] = dt * (rate[0][j] + shift);
    }
    femStrain_[3][f] = dt * (rate[0][3] + rate[0][4]);
    femSpin_[f] = 0.5 * dt * (rate[0][4] - rate[0][3]);
    if constexpr (twoPhase) {
        double liquidTrace = nodalAverage ? cellLiquidRate_[c] : trace;
        for (int k = 0; !nodalAverage && k < corners; ++k) {
            const LiquidNode& node = liquidNodes_[cellNodes_[c * corners + k]];
            liquidTrace += dilatation_[c].br[k] * node.relativeVr + dilatation_[c].bz[k] * node.relativeVz;
        }
        FemLiquidCell& liquid = femLiquidCells_[f];
        const double n = liquid.porosity;
        liquid.pressure +=
            projects() ? pressureStep_[c]
                       : -dt * liquid_[fem.material].bulkModulus / n * ((1 - n) * trace + n * liquidTrace);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateFemStress()
{
    if (femCells_.empty()) {
        return;
    }
    ++femSteps_;
    threads_.run([&](int part) {
        std::vector<double*>& pointers = statePointers_[part];
        for (const PointCells::Run& run : femRuns_) {
            inBlocks(run.begin, run.end, part, [&](int begin, int end) {
                StressBatch batch;
                batch.size = end - begin;
                for (int j = 0; j < 4; ++j) {
                    batch.strain[j] = femStrain_[j].data() + begin;
                    batch.stress[j] = femStress_[j].data() + begin;
                }
                batch.spin = femSpin_.data() + begin;
                for (std::size_t k = 0; k < femState_.size(); ++k) {
                    pointers[k] = femState_[k].data() + begin;
                }
                batch.state = &pointers;
                scene_.materials[run.material].law->update(batch);
            });
        }
    });
}

/// The points that rest catch up with their cells, which are cells of points again.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::wakeFemCells(State& state)
{
    if (femCells_.empty()) {
        return;
    }
    forCells([&](int c) {
        if (resting(c)) {
            wakeFemCell(state, c);
        }
    });
    updateStress(state, true);
    std::ranges::fill(femOf_, -1);
    femCells_.clear();
    femSteps_ = 0;
    femFlip_ = 1;
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::wakeFemCell(State& state, int c)
{
    MaterialPoints& points = state.points;
    const FemCell& fem = femCells_[femOf_[c]];
    const typename Shape::Cell& cell = cells_[c];
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    // As in the sampling, mean strains are those about the points' centre.
    double volume = 0, centreXi = 0, centreEta = 0;
    if constexpr (corners == 4) {
        for (const int* i = first; i != last; ++i) {
            const auto [x, y] = Shape::local(cell, points.r[*i], points.z[*i]);
            volume += points.volume[*i];
            centreXi += points.volume[*i] * x;
            centreEta += points.volume[*i] * y;
        }
        centreXi /= volume;
        centreEta /= volume;
    }
    double shapeSum = 0;
    double volumeSum = 0;
    Values values;
    for (const int* i = first; i != last; ++i) {
        const int p = *i;
        const auto [xi, eta] = Shape::evaluate(cell, points.r[p], points.z[p], values);
        const auto at = [&](int j) {
            double value = fem.strain[0][j];
            if constexpr (corners == 4) {
                value += (xi - centreXi) * fem.strain[1][j] + (eta - centreEta) * fem.strain[2][j];
            }
            return value;
        };
        const double rr = at(0), zz = at(1), hoop = at(2), rz = at(3), zr = at(4);
        const double shift = (fem.dilatation - rr - zz - hoop) / 3;
        strain_[0][p] = rr + shift;
        strain_[1][p] = zz + shift;
        strain_[2][p] = hoop + shift;
        strain_[3][p] = rz + zr;
        spin_[p] = 0.5 * (zr - rz);
        double dvr = 0, dvz = 0, placeR = 0, placeZ = 0, newR = 0, newZ = 0;
        double relativeR = 0, relativeZ = 0, kept = 0, nodalPressure = 0;
        for (int k = 0; k < corners; ++k) {
            const int node = cellNodes_[c * corners + k];
            const FemNode& since = femNodes_[node];
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
                kept += N * since.keep;
                nodalPressure += N * liquidNodes_[node].pressure;
            }
        }
        if constexpr (twoPhase) {
            relativeR += kept * (points.wr[p] - points.vr[p]);
            relativeZ += kept * (points.wz[p] - points.vz[p]);
            pressureShape_[p] = nodalPressure + unitWeight_ * points.z[p];
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
        points.volume[p] = std::min(points.volume[p] * std::exp(fem.dilatation),
                                    points.mass[p] * largestVolume_[points.material[p]]);
    }
    if constexpr (twoPhase) { // the mean of the cell, with the differences that the nodes show
        const double shift = femLiquidCells_[femOf_[c]].pressure - shapeSum / volumeSum;
        for (const int* i = first; i != last; ++i) {
            points.porePressure[*i] =
                std::max(pressureShape_[*i] + shift, liquid_[points.material[*i]].leastPressure);
        }
    }
}

} // namespace caisson
