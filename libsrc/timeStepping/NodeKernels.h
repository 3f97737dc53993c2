#pragma once

#include "timeStepping/ExplicitStepKernels.h"

// The nodes: new velocities, held by boundary conditions and by bodies.
namespace caisson {

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::solveNodes(State& state, double dt)
{
    const double damping = scene_.controls.localDamping;
    const bool tractions = scene_.conditions.hasTractions();
    const bool seepage = !twoPhase && !seepage_.empty();
    const auto solve = [&](int i) {
        Corner sum = gather(i);
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
            solveTwoPhaseNode(i, sum, dt);
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
        threads_.share(outerNodes_.part, cellsPerPiece, [&](int, int begin, int end) {
            forGathered(std::span(outerNodes_.items).subspan(begin, end - begin), solve);
        });
    } else { // the inner ones begin as the others
        threads_.share(static_cast<int>(activeNodes_.size()), nodesPerPiece, [&](int, int begin, int end) {
            forGathered(std::span(activeNodes_).subspan(begin, end - begin), solve);
        });
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

} // namespace caisson
