#pragma once

#include "timeStepping/ExplicitStepKernels.h"

// From the nodes to the points: velocities, places and strains.
namespace caisson {

namespace kernels {

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

} // namespace kernels

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
    if (nodalAverage || keepsRate(c)) {
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
        } else if (nodalAverage || keepsRate(c)) {
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
            out[k].liquid.momentumR = out[k].liquid.momentumZ = 0;
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
                LiquidCorner& corner = cornerSums_[c * corners + k].liquid;
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
    averageToNodes(ofCells);
    result.resize(ofCells.size());
    forCells([&](int c) {
        double sum = 0;
        for (int k = 0; k < corners; ++k) {
            sum += ofNodes_[cellNodes_[c * corners + k]];
        }
        result[c] = sum / corners;
    });
}

/// Means of values of cells over those with soil around each node, weighted with volume: ofNodes_.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::averageToNodes(const std::vector<double>& ofCells) const
{
    ofNodes_.resize(nodes_.size());
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

    const auto averageDilatation = [&] {
        if (femSteps_ > 0) {
            returnInnerMotion();
        }
        averageDilatationAtNodes();
    };
    if (nodalAverage && projects()) { // as keepsRate
        averageDilatation();
    }
    const bool onlyLoose = !remapAll && !nodalAverage && boxCell_.empty(); // cells have to be seen to here
    forAwakeCells([&](int c) {
        if (remapSome) {
            unsigned char loose = 0;
            for (int k = 0; k < corners; ++k) {
                loose |= looseNode_[cellNodes_[c * corners + k]];
            }
            byLoose_[c] = loose;
            if (onlyLoose && loose == 0) {
                return;
            }
        }
        if (keepsRate(c) && !resting(c)) {
            cellRate_[c] = projectedRate(state, c);
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
                    r += cornerSums_[nodeCorners_.item[k]].liquid.momentumR;
                    z += cornerSums_[nodeCorners_.item[k]].liquid.momentumZ;
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
    if (nodalAverage && !projects()) {
        averageDilatation();
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
            std::array<CellMotion, cellsPerPiece> motions;
            for (std::size_t j = 0; j < cells.size(); j += 4) {
                strainByFours(&cells[j], static_cast<int>(std::min<std::size_t>(4, cells.size() - j)), dt,
                              &motions[j]);
            }
            moveByFours<false>(state, dt, cells, motions.data());
        });
    } else {
        forAwakeCells(mapCell);
    }
}

} // namespace caisson
