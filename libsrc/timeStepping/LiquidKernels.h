#pragma once

#include "timeStepping/PointsToNodes.h"

// The liquid of two-phase soil (v-w formulation, one material point for both phases) [Jassim, Stolle &
// Vermeer 2013; van Esch, Stolle & Jassim 2011]. Per volume of mixture, with p the pore pressure less its
// hydrostatic part rho_w g_z z, compression positive, and Q = n^2 viscosity/permeability:
//
//     liquid    n rho_w dw/dt     = -n grad p - Q (w - v)
//     solid     (1-n) rho_s dv/dt = div sigma' - (1-n) grad p + (1-n) (rho_s - rho_w) g + Q (w - v)
//     storage   dp/dt             = -(Kw/n) ((1-n) div v + n div w)
//
// The porosity stands outside the gradient: of a node for the forces.
namespace caisson {

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findFreeSurfaces(const State& state)
{
    freeSurface_.assign(state.mesh.cells(), -1);
    overWall_.assign(state.mesh.cells(), 0);
    for (int c = 0; c < state.mesh.cells(); ++c) {
        double centre = 0;
        for (int k = 0; k < corners; ++k) {
            centre += state.mesh.r[cellNodes_[c * corners + k]] / corners;
        }
        freeSurface_[c] = freeSurfaceAt(scene_.freeSurfaces, state.bodies, centre);
        overWall_[c] = overWall(state.bodies, centre);
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::prepareLiquid(const State& state)
{
    updateWallAreas(state);
    for (const int i : openNodes_) {
        waterLoad_[i] = {};
    }
    scene_.liquidBoundary.addPressures(state.mesh, state.time, unitWeight_, waterLoad_);
    for (const int i : voidNodes_) {
        givenPressure_[i] = std::numeric_limits<double>::quiet_NaN();
    }
    voidNodes_.clear();
    scene_.liquidBoundary.setPressures(state.mesh, state.time, unitWeight_, givenPressure_);
    for (const int c : voidCells_) {
        for (int k = 0; k < corners; ++k) {
            const int i = cellNodes_[c * corners + k];
            nodeSurface_[i] = freeSurface_[c];
            givenPressure_[i] = surfacePressure_[freeSurface_[c]];
            voidNodes_.push_back(i);
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapLiquidToNodes(const State& state, int c)
    requires twoPhase
{
    const MaterialPoints& points = state.points;
    const typename Shape::Cell& cell = cells_[c];
    const bool meanDilatation = scene_.controls.locking == SolutionControls::Locking::meanDilatation;
    const bool full = isFull(c);

    std::array<Four, corners> inertia; // mass, momenta, drag
    std::array<Four, corners> volumes; // volume, pore volume, excess pressure times volume
    inertia.fill(0);
    volumes.fill(0);
    double forceR[corners] = {};
    double forceZ[corners] = {};
    double volume = 0, pressureVolume = 0;
    double br[corners] = {};
    double bz[corners] = {};
    double wx = 0, wy = 0, wxx = 0, wyy = 0, wxy = 0, px = 0, py = 0;
    Values values;
    const bool affine = points.affine();
    // @returns volume and excess pressure of the point
    const auto add = [&](int p) {
        const LiquidProperties& properties = liquid_[points.material[p]];
        const double v = points.volume[p];
        const double pores = v - points.mass[p] * properties.grainVolume;
        const double mass = properties.density * pores;
        const double n = pores / v;
        const double drag = n * pores *
                            (properties.kozenyCarman
                                 ? properties.viscosity / scene_.materials[points.material[p]].permeability(n)
                                 : properties.constantDrag);
        const double pressure = points.porePressure[p] - unitWeight_ * points.z[p];
        const Four inertiaOfPoint = four(mass, mass * points.wr[p], mass * points.wz[p], drag);
        const Four volumesOfPoint = four(v, pores, v * pressure, 0);
        for (int k = 0; k < corners; ++k) {
            inertia[k] += values.N[k] * inertiaOfPoint;
            volumes[k] += values.N[k] * volumesOfPoint;
        }
        for (int k = 0; affine && k < corners; ++k) { // as of the solid
            const auto [r, z] = affineVelocity(state, p, c * corners + k);
            inertia[k] += values.N[k] * mass * four(0, r, z, 0);
        }
        volume += v;
        pressureVolume += v * pressure;
        return std::array{v, pressure};
    };
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    for (const int* i = first; full && i != last; ++i) {
        const auto [x, y] = Shape::evaluate(cell, points.r[*i], points.z[*i], values);
        const auto [v, pressure] = add(*i);
        if (corners == 4 && !meanDilatation) {
            wx += v * x;
            wy += v * y;
            wxx += v * x * x;
            wyy += v * y * y;
            wxy += v * x * y;
            px += v * pressure * x;
            py += v * pressure * y;
        }
    }
    for (const int* i = first; !full && i != last; ++i) {
        Shape::evaluate(cell, points.r[*i], points.z[*i], values);
        const auto [v, pressure] = add(*i);
        const double inverseR = axisymmetric ? 1 / std::max(points.r[*i], kernels::smallestRadius) : 0;
        for (int k = 0; k < corners; ++k) {
            const double r = v * (values.dr[k] + values.N[k] * inverseR);
            const double z = v * values.dz[k];
            br[k] += r;
            bz[k] += z;
            if (!meanDilatation) {
                forceR[k] += pressure * r;
                forceZ[k] += pressure * z;
            }
        }
    }
    const double mean = pressureVolume / volume;
    if (full) {
        const auto& dilatation = dilatation_[c];
        for (int k = 0; k < corners; ++k) {
            forceR[k] = dilatation.volume * mean * dilatation.br[k];
            forceZ[k] = dilatation.volume * mean * dilatation.bz[k];
        }
        if constexpr (corners == 4) {
            if (!meanDilatation) { // slopes as of the stress (kernels::filledStress)
                const auto& m = Shape::moments(cell);
                const double x = wx / volume;
                const double y = wy / volume;
                const kernels::Spread spread(wxx / volume - x * x, wyy / volume - y * y,
                                             wxy / volume - x * y);
                const double cx = px / volume - x * mean;
                const double cy = py / volume - y * mean;
                const double slope[3] = {0, spread.slopeXi(cx, cy), spread.slopeEta(cx, cy)};
                for (int j = 1; j < 3; ++j) {
                    for (int k = 0; k < corners; ++k) {
                        forceR[k] += m.volume * slope[j] * (m.gr[j][k] + m.h[j][k]);
                        forceZ[k] += m.volume * slope[j] * m.gz[j][k];
                    }
                }
            }
        }
        // The force takes the whole cell, so mean pressure and porosity of a node do, too.
        const double whole = dilatation.volume / volume;
        for (Four& ofCorner : volumes) {
            ofCorner *= whole;
            ofCorner[2] = mean * ofCorner[0];
        }
    } else {
        for (int k = 0; projects() && k < corners; ++k) {
            flowRow_[c * corners + k] = {br[k], bz[k]};
        }
        const double beyond = freeSurface_[c] >= 0 && bySurface_[c] ? surfacePressure_[freeSurface_[c]] : 0;
        for (int k = 0; k < corners; ++k) {
            if (meanDilatation) {
                forceR[k] += mean * br[k];
                forceZ[k] += mean * bz[k];
            }
            if (pumped_) {
                const bool open = freeSurface_[c] >= 0 && bySurface_[c];
                voidForce_[c * corners + k] = {
                    open ? dilatation_[c].volume * dilatation_[c].br[k] - br[k] : 0,
                    open ? dilatation_[c].volume * dilatation_[c].bz[k] - bz[k] : 0};
            }
            if (beyond != 0) { // the rest of the cell holds the water of the free surface
                forceR[k] += beyond * (dilatation_[c].volume * dilatation_[c].br[k] - br[k]);
                forceZ[k] += beyond * (dilatation_[c].volume * dilatation_[c].bz[k] - bz[k]);
            }
        }
    }
    if (resting(c)) {
        fem_.pressure[femOf_[c]] = mean;
    }
    const double scaled = inertiaScale_[c] * fullness_[c];
    const Four scale = four(scaled, scaled, scaled, fullness_[c]);
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        setFour(out[k].liquid.mass, scale * inertia[k]);
        setFour(out[k].liquid.volume, volumes[k]);
        out[k].pressureR = forceR[k];
        out[k].pressureZ = forceZ[k];
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapVoidToNodes(int c)
{
    for (int k = 0; k < corners; ++k) {
        const double pressure = surfacePressure_[voidSurface(c, k)];
        Corner& corner = cornerSums_[c * corners + k];
        corner.pressureR = pressure * dilatation_[c].volume * dilatation_[c].br[k];
        corner.pressureZ = pressure * dilatation_[c].volume * dilatation_[c].bz[k];
        if (pumped_) {
            voidForce_[c * corners + k] = {dilatation_[c].volume * dilatation_[c].br[k],
                                           dilatation_[c].volume * dilatation_[c].bz[k]};
        }
    }
}

/// Balance of the water in closed voids and below covers. What soil and water (a cover moves with the soil:
/// the seepage alone) push into it is minus the power of a unit pressure: the same integral as its force.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::pump(State& state, double dt)
{
    const double whole = axisymmetric ? 2 * std::numbers::pi : 1.0;
    for (std::size_t s = 0; s < scene_.freeSurfaces.size(); ++s) {
        const FreeSurface& surface = scene_.freeSurfaces[s];
        if (!surface.givesFlow() || state.time < surface.sealedFrom) {
            continue;
        }
        const Function1& given = surface.pumpFlow ? *surface.pumpFlow : *surface.seepageFlow;
        const double voidMoves = surface.pumpFlow ? 1 : 0;
        double inflow = 0;
        const auto add = [&](int c, bool isVoid) {
            for (int k = 0; k < corners; ++k) {
                if ((isVoid ? voidSurface(c, k) : freeSurface_[c]) != static_cast<int>(s)) {
                    continue;
                }
                const int i = cellNodes_[c * corners + k];
                const double n = liquidNodes_[i].porosity;
                const double r = voidMoves * nodes_[i].vr + n * liquidNodes_[i].relativeVr;
                const double z = voidMoves * nodes_[i].vz + n * liquidNodes_[i].relativeVz;
                const auto& force = voidForce_[c * corners + k];
                inflow -= whole * (force[0] * r + force[1] * z);
            }
        };
        for (const int c : active_.items) {
            if (bySurface_[c]) {
                add(c, false);
            }
        }
        for (const int c : voidCells_) {
            add(c, true);
        }
        for (const RigidBody& body : state.bodies) {
            if (surface.pumpFlow && body.name == surface.body) {
                inflow -= body.velocity * body.enclosedArea(axisymmetric);
            }
        }
        state.pumped[s] += dt * (inflow - given.value(state.time)) / surface.compliance;
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::solveTwoPhaseNode(int i, const Corner& solid, double dt)
    requires twoPhase
{
    const LiquidCorner& sum = solid.liquid;
    Node& node = nodes_[i];
    LiquidNode& liquid = liquidNodes_[i];
    const double n = sum.poreVolume / sum.volume;
    liquid.mass = sum.mass;
    liquid.porosity = n;
    liquid.pressure = std::isnan(givenPressure_[i]) ? sum.pressureVolume / sum.volume : givenPressure_[i];
    // The wall of a body bears the pressure at its face.
    const double pressureR = solid.pressureR + liquid.pressure * wallArea_[i][0] + waterLoad_[i][0];
    const double pressureZ = solid.pressureZ + liquid.pressure * wallArea_[i][1] + waterLoad_[i][1];
    const double oldR = solid.momentumR / solid.mass;
    const double oldZ = solid.momentumZ / solid.mass;
    const double oldLiquidR = sum.momentumR / sum.mass;
    const double oldLiquidZ = sum.momentumZ / sum.mass;
    liquid.oldRelativeVr = oldLiquidR - oldR;
    liquid.oldRelativeVz = oldLiquidZ - oldZ;
    double forceR = solid.forceR + (1 - n) * pressureR;
    double forceZ = solid.forceZ + (1 - n) * pressureZ;
    const double damping = scene_.controls.localDamping;
    if (damping > 0 && !contactNode_[i]) {
        // Cundall 1987, of the mixture: drag is internal to it, so that a steady flow is not damped.
        forceR -= std::copysign(damping * std::abs(forceR + n * pressureR), oldR);
        forceZ -= std::copysign(damping * std::abs(forceZ + n * pressureZ), oldZ);
    }
    double liquidForceR = n * pressureR;
    double liquidForceZ = n * pressureZ;
    liquid.drag = dt * sum.drag;
    if (scene_.controls.drag == SolutionControls::Drag::lagged) {
        forceR += sum.drag * liquid.oldRelativeVr;
        forceZ += sum.drag * liquid.oldRelativeVz;
        liquidForceR -= sum.drag * liquid.oldRelativeVr;
        liquidForceZ -= sum.drag * liquid.oldRelativeVz;
        liquid.drag = 0;
    }
    liquid.solidVr = oldR + dt * forceR / solid.mass;
    liquid.solidVz = oldZ + dt * forceZ / solid.mass;
    liquid.liquidVr = oldLiquidR + dt * liquidForceR / sum.mass;
    liquid.liquidVz = oldLiquidZ + dt * liquidForceZ / sum.mass;
    // Implicit drag: total momentum as without it, relative velocity reduced. Exact in both limits.
    const double explicitKeep = scene_.controls.drag == SolutionControls::Drag::lagged
                                    ? std::max(0.0, 1 - dt * sum.drag * (1 / solid.mass + 1 / sum.mass))
                                    : 1.0;
    const double keep = 1 / (1 + liquid.drag * (1 / solid.mass + 1 / sum.mass));
    liquid.keep = keep * explicitKeep;
    liquid.relativeVr = keep * (liquid.liquidVr - liquid.solidVr);
    liquid.relativeVz = keep * (liquid.liquidVz - liquid.solidVz);
    const double share = sum.mass / (solid.mass + sum.mass);
    node.vr = liquid.solidVr + share * (liquid.liquidVr - liquid.solidVr - liquid.relativeVr);
    node.vz = liquid.solidVz + share * (liquid.liquidVz - liquid.solidVz - liquid.relativeVz);
    node.dvr = node.vr - oldR;
    node.dvz = node.vz - oldZ;
    node.placeVr = oldR + 0.5 * node.dvr;
    node.placeVz = oldZ + 0.5 * node.dvz;
}

/// The liquid where the solid's velocity along a direction was changed: its own balance of momentum holds
/// with the drag of the new velocity.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::solveLiquidAgain(int i, const std::array<double, 2>& direction)
{
    const Node& node = nodes_[i];
    LiquidNode& liquid = liquidNodes_[i];
    const double solid = node.vr * direction[0] + node.vz * direction[1];
    const double free = liquid.liquidVr * direction[0] + liquid.liquidVz * direction[1];
    const double relative = (liquid.mass * free + liquid.drag * solid) / (liquid.mass + liquid.drag) - solid;
    const double change = relative - liquid.relativeVr * direction[0] - liquid.relativeVz * direction[1];
    liquid.relativeVr += change * direction[0];
    liquid.relativeVz += change * direction[1];
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::applyLiquidConditions(double time, bool remapped)
{
    const auto& conditions = scene_.liquidBoundary.nodes();
    for (std::size_t c = 0; c < conditions.size(); ++c) {
        const LiquidBoundary::Node& condition = conditions[c];
        Node& node = nodes_[condition.node];
        if (node.mass <= 0) {
            continue;
        }
        LiquidNode& liquid = liquidNodes_[condition.node];
        for (int d = 0; d < condition.directions; ++d) {
            const auto& n = condition.normal[d];
            // A discharge is the flow relative to the soil per area of mixture.
            const double discharge = condition.flux[d] ? condition.flux[d]->at(time, 0) : 0;
            const double given = discharge / liquid.porosity;
            const double change = given - liquid.relativeVr * n[0] - liquid.relativeVz * n[1];
            liquid.relativeVr += change * n[0];
            liquid.relativeVz += change * n[1];
            if (solidHeld_[c][d] || remapped) {
                continue;
            }
            // A solid that is free there moves with its liquid: their momentum is that of both.
            const double solidV = liquid.solidVr * n[0] + liquid.solidVz * n[1];
            const double liquidV = liquid.liquidVr * n[0] + liquid.liquidVz * n[1];
            const double velocity =
                (node.mass * solidV + liquid.mass * (liquidV - given)) / (node.mass + liquid.mass);
            const double correction = velocity - node.vr * n[0] - node.vz * n[1];
            node.vr += correction * n[0];
            node.vz += correction * n[1];
            node.dvr += correction * n[0];
            node.dvz += correction * n[1];
            node.placeVr += 0.5 * correction * n[0];
            node.placeVz += 0.5 * correction * n[1];
        }
    }
}

/// Contact of two-phase soil. A wall is impermeable, with free slip for the liquid; the soil's skeleton may
/// leave it. What presses the skeleton on it is the effective stress alone, since the wall bears the pore
/// pressure (solveTwoPhaseNode), and friction follows from that.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::touchTwoPhase(const RigidBody& body, BodyReaction& reaction,
                                                const SurfaceNode& contact, double dt, bool remapped)
{
    Node& node = nodes_[contact.node];
    LiquidNode& liquid = liquidNodes_[contact.node];
    const double ms = node.mass;
    const double mw = liquid.mass;
    const double drag = liquid.drag;
    // The liquid in a corner moves with both faces, so what drags the solid there is a wall.
    const bool atTip = contact.faces == 2 && contact.part[0] == SurfacePart::tip;
    const bool corner = contact.faces == 2 && (!atTip || body.tipCorner == TipCorner::full);
    const auto touch = [&](const std::array<double, 2>& n, SurfacePart part, double bodyVz, double area) {
        const std::array<double, 2> t{-n[1], n[0]};
        const double wallN = bodyVz * n[1];
        const double wallT = bodyVz * t[1];
        const double oldN = node.vr * n[0] + node.vz * n[1];
        const double oldT = node.vr * t[0] + node.vz * t[1];
        if (remapped) { // as in one phase; the liquid keeps to the wall
            double newN = oldN;
            double newT = oldT;
            if (oldN < wallN) {
                newN = wallN;
                const double slip = oldT - wallT;
                const double limit = body.friction * (wallN - oldN) + body.adhesion * area * dt / ms;
                newT -= std::abs(slip) > limit ? std::copysign(limit, slip) : slip;
            }
            const double relativeT = liquid.relativeVr * t[0] + liquid.relativeVz * t[1];
            node.vr = newN * n[0] + newT * t[0];
            node.vz = newN * n[1] + newT * t[1];
            liquid.relativeVr = (wallN - newN) * n[0] + relativeT * t[0];
            liquid.relativeVz = (wallN - newN) * n[1] + relativeT * t[1];
            return;
        }
        const double solidN = liquid.solidVr * n[0] + liquid.solidVz * n[1];
        const double solidT = liquid.solidVr * t[0] + liquid.solidVz * t[1];
        const double liquidN = liquid.liquidVr * n[0] + liquid.liquidVz * n[1];
        const double liquidT = corner ? wallT : liquid.liquidVr * t[0] + liquid.liquidVz * t[1];
        // Along the normal the liquid moves with the wall; the solid feels its drag.
        double newN = (ms * solidN + drag * wallN) / (ms + drag);
        const bool pressed = newN < wallN;
        if (projects()) {
            wallTouches_.push_back({contact.node, n, pressed, false});
        }
        const double impulseN = pressed ? (ms + drag) * (wallN - newN) : 0;
        const double limit = pressed ? body.friction * impulseN + body.adhesion * area * dt : 0;
        newN = pressed ? wallN : newN;
        const double waterN = mw * (wallN - liquidN) + drag * (wallN - newN);
        // Along the wall both move; an impulse on the solid drags the liquid along.
        const double dragged = corner ? drag : mw * drag / (mw + drag);
        double newT = (ms * solidT + dragged * liquidT) / (ms + dragged);
        const double stick = (ms + dragged) * (wallT - newT);
        const double impulseT = std::abs(stick) > limit ? std::copysign(limit, stick) : stick;
        if (projects()) {
            wallTouches_.back().sticks = pressed && std::abs(stick) <= limit;
        }
        newT += impulseT / (ms + dragged);
        const double liquidNewT = corner ? wallT : (mw * liquidT + drag * newT) / (mw + drag);

        const double changeN = newN - oldN;
        const double changeT = newT - oldT;
        node.vr = newN * n[0] + newT * t[0];
        node.vz = newN * n[1] + newT * t[1];
        node.dvr += changeN * n[0] + changeT * t[0];
        node.dvz += changeN * n[1] + changeT * t[1];
        // Where soil and wall touch, the points move with the wall along its normal; else with the mean.
        const double placeN = node.placeVr * n[0] + node.placeVz * n[1];
        const double moreN = pressed ? newN - placeN : 0.5 * changeN;
        node.placeVr += moreN * n[0] + 0.5 * changeT * t[0];
        node.placeVz += moreN * n[1] + 0.5 * changeT * t[1];
        liquid.relativeVr = (wallN - newN) * n[0] + (liquidNewT - newT) * t[0];
        liquid.relativeVz = (wallN - newN) * n[1] + (liquidNewT - newT) * t[1];
        const double impulseR = impulseN * n[0] + impulseT * t[0];
        const double impulseZ = impulseN * n[1] + impulseT * t[1];
        liquid.solidVr += impulseR / ms; // for a second face
        liquid.solidVz += impulseZ / ms;
        reaction.radialImpulse[static_cast<int>(part)] -= impulseR;
        reaction.verticalImpulse[static_cast<int>(part)] -= impulseZ;
        reaction.waterImpulse -= waterN * n[1];
        reaction.work += (impulseZ + waterN * n[1]) * body.velocity;
    };
    if (!remapped) {
        const double water = dt * liquid.pressure * wallArea_[contact.node][1];
        reaction.waterImpulse -= water;
        reaction.work += water * body.velocity;
    }
    touchFaces(body, contact, touch);
    if (corner) {
        liquid.relativeVr = -node.vr;
        liquid.relativeVz = body.velocity - node.vz;
    }
}

// ---------------------------------------------------------------------------------------------------------

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::meanPressures(const State& state, std::vector<double>& cellPressure) const
{
    const MaterialPoints& points = state.points;
    cellPressure.resize(cells_.size());
    forCells([&](int c) {
        if (resting(c) && femSteps_ > 0) {
            cellPressure[c] = fem_.pressure[femOf_[c]];
            return;
        }
        double volume = 0;
        double sum = 0;
        for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
            volume += points.volume[*i];
            sum += points.volume[*i] * (points.porePressure[*i] - unitWeight_ * points.z[*i]);
        }
        cellPressure[c] = sum / volume;
    });
}

/// Signs of a checkerboard around the nodes that four cells meet at: + where a cell shares no side with the
/// first one, - where it does; 0 at other nodes.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findCheckerboardSigns()
{
    checkerboardSign_.assign(cellNodes_.size(), 0);
    const auto besides = [this](int corner, int step) { // the node that lies beside this corner in its cell
        return cellNodes_[corner / corners * corners + (corner + step) % corners];
    };
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
        const int first = nodeCorners_.start[i];
        if (corners != 4 || nodeCorners_.start[i + 1] - first != 4) {
            continue;
        }
        const int* const around = &nodeCorners_.item[first];
        const std::array<int, 2> sides{besides(around[0], 1), besides(around[0], 3)};
        std::array<signed char, 4> signs{};
        int sum = 0;
        for (int k = 0; k < 4; ++k) {
            const int one = besides(around[k], 1), other = besides(around[k], 3);
            const bool opposite =
                one != sides[0] && one != sides[1] && other != sides[0] && other != sides[1];
            signs[k] = k == 0 || opposite ? 1 : -1;
            sum += signs[k];
        }
        if (sum != 0) { // the cells do not lie all around the node
            continue;
        }
        FilterNode node{i, {}};
        int positive = 0, negative = 2;
        for (int k = 0; k < 4; ++k) {
            checkerboardSign_[around[k]] = signs[k];
            node.cells[signs[k] > 0 ? positive++ : negative++] = around[k] / corners;
        }
        checkerboardNodes_.push_back(node);
    }
    alternating_.assign(nodes_.size(), 0);
}

/// Nodes at which the filter looks for a checkerboard: not beside a free surface.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findFilterNodes()
{
    for (const FilterNode& node : filterNodes_) {
        alternating_[node.node] = 0;
    }
    filterNodes_.clear();
    std::ranges::copy_if(
        checkerboardNodes_, std::back_inserter(filterNodes_), [this](const FilterNode& node) {
            return std::ranges::all_of(node.cells, [this](int c) { return occupied_[c] && !bySurface_[c]; });
        });
}

/// Cells of one pressure do not feel a checkerboard of it: no flow levels it. Its share, taken twice of a
/// smooth field, is O(h^8) in quadrilaterals and O(h^4) in triangles.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::filterPressures(State& state)
{
    meanPressures(state, cellPressure_);
    takeCheckerboard(cellPressure_);
    takeCheckerboard(cellPressure_);
    forCells([&](int c) {
        const double change = scene_.controls.checkerboardFilter * cellPressure_[c];
        if (resting(c)) {
            fem_.pressure[femOf_[c]] -= change;
            return;
        }
        for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
            state.points.porePressure[*i] -= change;
        }
    });
}

/// What alternates in values of cells, by what nodes see of it: each would move value times volume between
/// the cells around it. In quadrilaterals T^T T, T the alternating sum of the four cells around a node over
/// four: 1 for a checkerboard, sin^2(k h/2) sin^2(l h/2) for waves of the wave numbers k and l along the
/// sides, and 0 for whatever is a sum of functions along one side each. In triangles what differs from the
/// mean around a node, O(h^2), as if there were a mirror where soil ends. Nodes beside a free surface or with
/// a given pressure, where that would not be right, see nothing.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::takeCheckerboard(std::vector<double>& ofCells)
{
    if constexpr (corners == 4) {
        threads_.share(static_cast<int>(filterNodes_.size()), nodesPerPiece, [&](int, int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const auto& [node, c] = filterNodes_[j];
                const double least = std::min(std::min(dilatation_[c[0]].volume, dilatation_[c[1]].volume),
                                              std::min(dilatation_[c[2]].volume, dilatation_[c[3]].volume));
                // None gets more than it can bear.
                alternating_[node] =
                    least / 16 * ((ofCells[c[0]] + ofCells[c[1]]) - (ofCells[c[2]] + ofCells[c[3]]));
            }
        });
        forCells([&](int c) {
            double sum = 0;
            for (int k = c * corners; k < (c + 1) * corners; ++k) {
                sum += checkerboardSign_[k] * alternating_[cellNodes_[k]];
            }
            ofCells[c] = sum / dilatation_[c].volume;
        });
    } else {
        constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
        averageToNodes(ofCells);
        forNodes([&](int i) {
            bool sees = std::isnan(givenPressure_[i]);
            for (int k = nodeCorners_.start[i]; k < nodeCorners_.start[i + 1]; ++k) {
                const int c = nodeCorners_.item[k] / corners;
                sees = sees && (!occupied_[c] || !bySurface_[c]);
            }
            ofNodes_[i] = sees ? ofNodes_[i] : nothing;
        });
        forCells([&](int c) {
            double sum = 0;
            for (int k = 0; k < corners; ++k) {
                const double ofNode = ofNodes_[cellNodes_[c * corners + k]];
                sum += std::isnan(ofNode) ? 0 : (ofCells[c] - ofNode) / corners;
            }
            ofCells[c] = sum;
        });
    }
}

template <class Shape, int phases>
double ExplicitStep<Shape, phases>::checkerboardIndex(const State& state) const
{
    if (!state.points.twoPhase()) {
        return 0;
    }
    meanPressures(state, cellPressure_);
    averageOverNodes(cellPressure_, cellAverage_);
    double volume = 0, mean = 0, square = 0, difference = 0;
    for (const int c : active_.items) {
        const double v = dilatation_[c].volume;
        volume += v;
        mean += v * cellPressure_[c];
        square += v * cellPressure_[c] * cellPressure_[c];
        difference += v * (cellPressure_[c] - cellAverage_[c]) * (cellPressure_[c] - cellAverage_[c]);
    }
    mean /= volume;
    const double deviation = square / volume - mean * mean;
    return deviation > 0 ? std::sqrt(difference / volume / deviation) : 0;
}

} // namespace caisson
