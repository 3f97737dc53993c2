#pragma once

#include "timeStepping/ExplicitStepKernels.h"

// Points in the order of their cells, fewer where they are too many, and in the cells that they have come to.
namespace caisson {

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
        const int* const nodes = &cellNodes_[static_cast<std::size_t>(c) * corners];
        double low = ofNodes[nodes[0]];
        double high = low;
        for (int k = 1; k < corners; ++k) {
            low = std::min(low, ofNodes[nodes[k]]);
            high = std::max(high, ofNodes[nodes[k]]);
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
            if constexpr (hasFours) {
                if (holdsItsPoints(points, c)) {
                    continue;
                }
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
    classifyCells(state, sorts || state.step % scene_.controls.checkInterval == 0);
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

} // namespace caisson
