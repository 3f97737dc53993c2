#pragma once

#include "timeStepping/BoxKernels.h"

// Projection: the pore pressure at the end of the step, instead of that at its start, accelerates soil and
// liquid [Chorin 1968; in increments: van Kan 1986; with finite stiffness of the liquid and drag: after
// Jassim, Stolle & Vermeer 2013, Kularathna, Liang, Zhao, Chandra, Zhao & Soga 2021]. With the velocities
// v, w of the step as solveNodes leaves them (pressures of the start, implicit drag, contact, conditions),
//
//     u = (1 - n) v + n w                                      flow of the mixture at a node
//     V n/(Kw dt) dp + D L D^T dp = -D u                       one pressure increment dp per cell
//     dv, dw = dt M^-1 (1 - n, n) D^T dp                       M: masses and drag of a node
//
// where D is the integral of the dilatation over a cell, whose adjoint is the force of its pressure, and L
// = dt (1-n, n) M^-1 (1-n, n)^T the mobility of a node, by direction: what conditions or contact hold does
// not move. Neither waves of the liquid nor drag limit the step.
namespace caisson {

namespace kernels {

/// Residual of the pressure increments over that of none. What is left is a strain rate of the liquid; the
/// pressures take the increments themselves.
inline constexpr double pressureTolerance = 1e-6;
inline constexpr int pressureIterations = 200;
/// More than this many: the factor is too old.
inline constexpr int manyIterations = 12;

} // namespace kernels

/// Directions and mobilities of a node that nothing holds.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::freeMobility(int i, double dt)
{
    Mobility& m = mobility_[i];
    const LiquidNode& liquid = liquidNodes_[i];
    const double ms = nodes_[i].mass;
    const double mw = liquid.mass;
    const double n = liquid.porosity;
    const double determinant = ms * mw + liquid.drag * (ms + mw);
    m.direction = {1, 0};
    for (int d = 0; d < 2; ++d) {
        m.solidHeld[d] = m.flowHeld[d] = false;
        m.solid[d] = dt * (mw * (1 - n) + liquid.drag) / determinant;
        m.liquid[d] = dt * (ms * n + liquid.drag) / determinant;
    }
}

/// Holds a node along a direction: its solid, its liquid relative to a body or boundary, or both.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::holdMobility(int i, const std::array<double, 2>& direction, bool solid,
                                               bool flow, bool byWall, double dt)
{
    Mobility& m = mobility_[i];
    const double along = std::abs(m.direction[0] * direction[0] + m.direction[1] * direction[1]);
    int d = along > 0.7 ? 0 : 1;
    if (along > 1e-6 && along < 1 - 1e-6) { // neither of the node's directions
        const bool held = m.solidHeld[0] || m.solidHeld[1] || m.flowHeld[0] || m.flowHeld[1];
        if (held) { // a corner: nothing moves there
            for (int k = 0; k < 2; ++k) {
                m.solidHeld[k] = m.flowHeld[k] = true;
                m.solid[k] = m.liquid[k] = 0;
            }
            return;
        }
        m.direction = direction;
        d = 0;
    }
    m.solidHeld[d] = m.solidHeld[d] || solid;
    m.flowHeld[d] = m.flowHeld[d] || flow;
    const LiquidNode& liquid = liquidNodes_[i];
    const double ms = nodes_[i].mass;
    const double mw = liquid.mass;
    const double n = liquid.porosity;
    if (m.solidHeld[d] && m.flowHeld[d]) {
        m.solid[d] = m.liquid[d] = 0;
    } else if (m.solidHeld[d]) {
        m.solid[d] = 0;
        m.liquid[d] = dt * n / (mw + liquid.drag);
    } else if (byWall) { // the liquid moves with the wall, the solid leaves it
        m.solid[d] = dt * (1 - n) / (ms + liquid.drag);
        m.liquid[d] = 0;
    } else { // both move together
        m.solid[d] = m.liquid[d] = dt / (ms + mw);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateMobilities(double dt)
{
    forNodes([&](int i) {
        if (nodes_[i].mass > 0) {
            freeMobility(i, dt);
        } else {
            mobility_[i] = Mobility{};
        }
    });
    for (const WallTouch& touch : wallTouches_) {
        const std::array<double, 2> tangent{-touch.normal[1], touch.normal[0]};
        holdMobility(touch.node, touch.normal, touch.pressed, true, true, dt);
        if (touch.sticks) {
            holdMobility(touch.node, tangent, true, false, false, dt);
        }
    }
    for (const VelocityConditions::Node& condition : scene_.conditions.nodes()) {
        if (nodes_[condition.node].mass <= 0) {
            continue;
        }
        if (condition.fixed) {
            const std::array<double, 2> first = mobility_[condition.node].direction;
            holdMobility(condition.node, first, true, false, false, dt);
            holdMobility(condition.node, {-first[1], first[0]}, true, false, false, dt);
        } else {
            holdMobility(condition.node, condition.normal, true, false, false, dt);
        }
    }
    for (const LiquidBoundary::Node& condition : scene_.liquidBoundary.nodes()) {
        for (int d = 0; d < condition.directions && nodes_[condition.node].mass > 0; ++d) {
            holdMobility(condition.node, condition.normal[d], false, true, false, dt);
        }
    }
    forNodes([&](int i) {
        Mobility& m = mobility_[i];
        const double n = liquidNodes_[i].porosity;
        const double first = (1 - n) * m.solid[0] + n * m.liquid[0];
        const double second = (1 - n) * m.solid[1] + n * m.liquid[1];
        const auto [c, s] = m.direction;
        m.rr = first * c * c + second * s * s;
        m.rz = (first - second) * c * s;
        m.zz = first * s * s + second * c * c;
    });
}

/// Integrals of the dilatation over the cells per velocity of their corners, and what a pressure increment
/// stores.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::updateDilatationRows(const State& state, double dt)
{
    forCells([&](int c) {
        const bool full = isFull(c);
        double volume = 0, stored = 0; // per pressure
        const auto bulkModulus = [&](int p) { return liquid_[state.points.material[p]].bulkModulus; };
        if (resting(c) && femSteps_ > 0) { // of one material
            volume = 1;
            stored = fem_.porosity[femOf_[c]] / bulkModulus(*pointCells_.begin(c));
        } else {
            for (const int* p = pointCells_.begin(c); p != pointCells_.end(c); ++p) {
                volume += state.points.volume[*p];
                stored += porosity(state.points, *p) * state.points.volume[*p] / bulkModulus(*p);
            }
        }
        if (full) {
            const auto& dilatation = dilatation_[c];
            for (int k = 0; k < corners; ++k) {
                flowRow_[c * corners + k] = {dilatation.volume * dilatation.br[k],
                                             dilatation.volume * dilatation.bz[k]};
            }
            stored *= dilatation.volume / volume;
        }
        storage_[c] = stored / dt;
    });
}

/// A product with the matrix of the pressure increments; cells without soil have none.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::multiplyPressures(const Eigen::VectorXd& x, Eigen::VectorXd& product)
{
    product = x;
    forNodes([&](int i) {
        double r = 0, z = 0;
        for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
            const int corner = nodeCorners_.item[k];
            if (occupied_[corner / corners]) {
                r += flowRow_[corner][0] * x[corner / corners];
                z += flowRow_[corner][1] * x[corner / corners];
            }
        }
        const Mobility& m = mobility_[i];
        flow_[i] = {m.rr * r + m.rz * z, m.rz * r + m.zz * z};
    });
    forCells([&](int c) {
        double sum = storage_[c] * x[c];
        for (int k = 0; k < corners; ++k) {
            const auto& flow = flow_[cellNodes_[c * corners + k]];
            sum += flowRow_[c * corners + k][0] * flow[0] + flowRow_[c * corners + k][1] * flow[1];
        }
        product[c] = sum;
    });
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::factorisePressures()
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(17 * cells_.size());
    double typical = 0;
    for (const int i : activeNodes_) {
        const Mobility& m = mobility_[i];
        for (int a = nodeCorners_.start[i]; a < nodeCorners_.start[i + 1]; ++a) {
            const int one = nodeCorners_.item[a];
            if (!occupied_[one / corners]) {
                continue;
            }
            const auto& row = flowRow_[one];
            const double r = m.rr * row[0] + m.rz * row[1];
            const double z = m.rz * row[0] + m.zz * row[1];
            typical = std::max(typical, r * row[0] + z * row[1]);
            for (int b = nodeCorners_.start[i]; b < nodeCorners_.start[i + 1]; ++b) {
                const int other = nodeCorners_.item[b];
                if (occupied_[other / corners]) {
                    entries.emplace_back(one / corners, other / corners,
                                         r * flowRow_[other][0] + z * flowRow_[other][1]);
                }
            }
        }
    }
    for (int c = 0; c < static_cast<int>(cells_.size()); ++c) {
        entries.emplace_back(c, c, occupied_[c] ? storage_[c] : typical); // cells that soil may come into
    }
    pressureSolver_.factorise(static_cast<int>(cells_.size()), entries);
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::project(State& state, double dt)
{
    updateMobilities(dt);
    updateDilatationRows(state, dt);
    const auto cells = static_cast<Eigen::Index>(cells_.size());
    Eigen::VectorXd& b = pressureLoad_;
    b.setZero(cells);
    forCells([&](int c) {
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            const double n = liquidNodes_[i].porosity;
            b[c] -= flowRow_[c * corners + k][0] * (nodes_[i].vr + n * liquidNodes_[i].relativeVr) +
                    flowRow_[c * corners + k][1] * (nodes_[i].vz + n * liquidNodes_[i].relativeVz);
        }
    });
    if (!pressureSolver_.factorised()) {
        factorisePressures();
    }
    const auto multiply = [this](const Eigen::VectorXd& x, Eigen::VectorXd& y) { multiplyPressures(x, y); };
    int iterations = pressureSolver_.solve(multiply, b, pressureStep_, kernels::pressureTolerance,
                                           kernels::manyIterations);
    if (iterations < 0) {
        factorisePressures();
        iterations = pressureSolver_.solve(multiply, b, pressureStep_, kernels::pressureTolerance,
                                           kernels::pressureIterations);
    }
    if (iterations < 0) {
        throw InputError(
            "the run",
            {{{},
              text("the pore pressures of the projection do not converge (t = %.6g s)", state.time),
              "try a smaller maxCo, or pressureCoupling explicit"}});
    }
    forNodes([&](int i) {
        Node& node = nodes_[i];
        if (node.mass <= 0) {
            return;
        }
        double r = 0, z = 0;
        for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
            const int corner = nodeCorners_.item[k];
            if (occupied_[corner / corners]) {
                r += flowRow_[corner][0] * pressureStep_[corner / corners];
                z += flowRow_[corner][1] * pressureStep_[corner / corners];
            }
        }
        const Mobility& m = mobility_[i];
        const auto [c, s] = m.direction;
        const double first = c * r + s * z;
        const double second = -s * r + c * z;
        const double dvr = c * m.solid[0] * first - s * m.solid[1] * second;
        const double dvz = s * m.solid[0] * first + c * m.solid[1] * second;
        node.vr += dvr;
        node.vz += dvz;
        node.dvr += dvr;
        node.dvz += dvz;
        node.placeVr += 0.5 * dvr;
        node.placeVz += 0.5 * dvz;
        LiquidNode& liquid = liquidNodes_[i];
        liquid.relativeVr += c * m.liquid[0] * first - s * m.liquid[1] * second - dvr;
        liquid.relativeVz += s * m.liquid[0] * first + c * m.liquid[1] * second - dvz;
    });
}

/// Rate of dilatation of a cell's soil by the nodes' velocities: the mean over what its row integrates.
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::projectedRate(const State& state, int c) const
{
    const bool full = isFull(c);
    double rate = 0;
    for (int k = 0; k < corners; ++k) {
        const Node& node = nodes_[cellNodes_[c * corners + k]];
        const auto& row = flowRow_[c * corners + k];
        rate += full ? dilatation_[c].br[k] * node.vr + dilatation_[c].bz[k] * node.vz
                     : row[0] * node.vr + row[1] * node.vz;
    }
    double volume = full ? 1 : 0;
    for (const int* p = pointCells_.begin(c); !full && p != pointCells_.end(c); ++p) {
        volume += state.points.volume[*p];
    }
    return rate / volume;
}

} // namespace caisson
