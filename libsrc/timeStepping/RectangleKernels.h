#pragma once

#include "timeStepping/NodesToPoints.h"

// The points of filled cells that are rectangles, four at a time. What is done with each point is arithmetic
// of four points in a register; for the sums at the corners these become registers of four quantities of one
// point. What the corners give the points is a0 + a1 xi + a2 eta + a3 xi eta, whose coefficients (modes) are
// found once per cell.
namespace caisson {

namespace kernels {

/// Adds four quantities of each of four points to the corners of their cell, by N of the points. (Indices
/// that are constants before loops are unrolled let the compiler keep the sums in registers.)
[[gnu::always_inline]] inline void addToCorners(std::array<Four, 4> quantities, const std::array<Four, 4>& N,
                                                std::array<Four, 4>& corners)
{
    transpose(quantities);
    const auto [a, b, c, d] = quantities;
    corners[0] = corners[0] + N[0][0] * a + N[0][1] * b + N[0][2] * c + N[0][3] * d;
    corners[1] = corners[1] + N[1][0] * a + N[1][1] * b + N[1][2] * c + N[1][3] * d;
    corners[2] = corners[2] + N[2][0] * a + N[2][1] * b + N[2][2] * c + N[2][3] * d;
    corners[3] = corners[3] + N[3][0] * a + N[3][1] * b + N[3][2] * c + N[3][3] * d;
}

/// Modes of four quantities from what they are at the corners.
template <class Shape>
[[gnu::always_inline]] inline void setModes(double (&modes)[4][4], const std::array<Four, 4>& ofCorners)
{
    const std::array<Four, 4> result = Shape::modes(ofCorners.data());
    for (int m = 0; m < 4; ++m) {
        setFour(modes[m][0], result[m]);
    }
}

/// A quantity at four points, one of four whose modes over their cell are given.
[[gnu::always_inline]] inline Four fieldAt(const double (&modes)[4][4], int quantity, const Four& xi,
                                           const Four& eta, const Four& xiEta)
{
    return (modes[0][quantity] + xi * modes[1][quantity]) +
           (eta * modes[2][quantity] + xiEta * modes[3][quantity]);
}

} // namespace kernels

template <class Shape, int phases>
bool ExplicitStep<Shape, phases>::mayTakeFours() const
{
    const SolutionControls& controls = scene_.controls;
    return hasFours && controls.locking == SolutionControls::Locking::meanDilatation && !controls.affine &&
           !controls.fittedWeights && std::ranges::none_of(scene_.materials, [](const Material& soil) {
               return twoPhase && soil.kozenyCarman;
           });
}

/// alone(cell) for cells of the list, and together(cells) for those of a piece of it that may join.
template <class Shape, int phases>
template <class May, class Alone, class Together>
void ExplicitStep<Shape, phases>::forPieces(const WorkList& list, const May& may, const Alone& alone,
                                            const Together& together) const
{
    threads_.share(list.part, cellsPerPiece, [&](int, int begin, int end) {
        for (int from = begin; from < end; from += cellsPerPiece) {
            std::array<int, cellsPerPiece> joined;
            std::size_t cells = 0;
            for (int i = from; i < std::min(from + cellsPerPiece, end); ++i) {
                const int c = list.items[i];
                if (byFours_ && may(c)) {
                    joined[cells++] = c;
                } else {
                    alone(c);
                }
            }
            together(std::span<const int>(joined.data(), cells));
        }
    });
}

/// Whether no point has left the cell, nor one that lies behind its points in the storage.
template <class Shape, int phases>
bool ExplicitStep<Shape, phases>::holdsItsPoints(const MaterialPoints& points, int c) const
    requires hasFours
{
    const typename Shape::Cell cell = cells_[c];
    bool holds = true;
    forFours(
        pointCells_.begin(c), pointCells_.end(c),
        points.size(), [&](const auto& p) __attribute__((always_inline)) {
            const Four r = p.of(points.r);
            const Four z = p.of(points.z);
            holds = holds &&
                    !any_of(r < cell.r0 || r > cell.r0 + cell.dr || z < cell.z0 || z > cell.z0 + cell.dz);
        });
    return holds;
}

/// sumPoints and, of two phases, mapLiquidToNodes of filled cells: their points are read once.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sumByFours(const State& state, std::span<const int> cells,
                                             kernels::StressSums<double>* sums)
    requires hasFours
{
    const PointArrays<const double> points(state.points, scene_.materials.size());
    for (std::size_t j = 0; j < cells.size(); ++j) {
        const int c = cells[j];
        const typename Shape::Cell cell = cells_[c];
        // At the corners
        std::array<Four, corners> inertia{0, 0, 0, 0}; // mass, momenta, weight over gravity
        std::array<Four, corners> liquid{0, 0, 0, 0};  // mass, momenta, drag
        // Volume, pore volume, volume times excess pressure, times xi^2
        std::array<Four, corners> volumes{0, 0, 0, 0};
        // Of the cell: volume times stress, that times xi and eta, volume times eta^2
        Four stress = 0, stressXi = 0, stressEta = 0, etaSquare = 0;
        forFours(
            pointCells_.begin(c), pointCells_.end(c),
            state.points.size(), [&](const auto& p) __attribute__((always_inline)) {
                const Four z = p.of(points.z);
                const auto [x, y] = Shape::local(cell, p.of(points.r), z);
                const std::array<Four, corners> N = Shape::cornerSums(std::array<Four, 4>{1, x, y, x * y});
                const Four whole = p.of(points.volume);
                const Four v = p.only(whole);
                const Four mass = p.only(p.of(points.mass));
                const Four solid = twoPhase ? mass * p.ofMaterial(solidShare_, points) : mass;
                kernels::addToCorners({solid, solid * p.of(points.vr), solid * p.of(points.vz),
                                       mass * p.ofMaterial(gravityShare_, points)},
                                      N, inertia);
                Four pores = 0, pressure = 0;
                if constexpr (twoPhase) {
                    const auto property = [&](auto of) { return p.ofMaterial(liquid_, points, of); };
                    pores = v - mass * property(&LiquidProperties::grainVolume);
                    pressure = p.of(points.porePressure) - unitWeight_ * z;
                    const Four water = pores * property(&LiquidProperties::density);
                    kernels::addToCorners(
                        {water, water * p.of(points.wr), water * p.of(points.wz),
                         pores * (pores / whole) * property(&LiquidProperties::constantDrag)},
                        N, liquid);
                }
                kernels::addToCorners({v, pores, v * pressure, v * x * x}, N, volumes);
                etaSquare += v * y * y;
                std::array<Four, 4> s{v * p.of(points.stress[0]), v * p.of(points.stress[1]),
                                      v * p.of(points.stress[2]), v * p.of(points.stress[3])};
                transpose(s);
                stress += (s[0] + s[1]) + (s[2] + s[3]);
                stressXi = stressXi + x[0] * s[0] + x[1] * s[1] + x[2] * s[2] + x[3] * s[3];
                stressEta = stressEta + y[0] * s[0] + y[1] * s[1] + y[2] * s[2] + y[3] * s[3];
            });

        const Four ofCell = (volumes[0] + volumes[2]) + (volumes[1] + volumes[3]);
        const double lowerSlope = volumes[1][0] - volumes[0][0];
        const double upperSlope = volumes[2][0] - volumes[3][0];
        sums[j].w = ofCell[0];
        sums[j].wx = upperSlope + lowerSlope;
        sums[j].wy = (volumes[2][0] + volumes[3][0]) - (volumes[0][0] + volumes[1][0]);
        sums[j].wxy = upperSlope - lowerSlope;
        sums[j].wxx = ofCell[3];
        sums[j].wyy = reduce(etaSquare);
        setFour(sums[j].s[0], stress);
        setFour(sums[j].sx[0], stressXi);
        setFour(sums[j].sy[0], stressEta);

        const Dilatation& dilatation = dilatation_[c];
        const int material = points.material[*pointCells_.begin(c)];
        const double inverse = 1 / ofCell[0];
        const double whole = dilatation.volume * inverse;
        fullness_[c] = whole;
        const double scale = inertiaScale_[c] * whole;
        const double fullMass = inertiaScale_[c] * density_[material] *
                                (twoPhase ? solidShare_[material] : 1.0) * dilatation.volume;
        const double mean = ofCell[2] * inverse; // excess pressure
        const double push = dilatation.volume * mean;
        const Four gravity = whole * four(scene_.gravity[0], scene_.gravity[1], 0, 0);
        std::array<Four, 4> pushes{0, 0, push * Four(dilatation.br, std::experimental::element_aligned),
                                   push * Four(dilatation.bz, std::experimental::element_aligned)};
        transpose(pushes);
        const std::array<double, corners> share = Shape::cornerShares(cell);
        const auto put = [&](auto corner) __attribute__((always_inline))
        {
            constexpr int k = decltype(corner)::value;
            Corner& to = cornerSums_[c * corners + k];
            setFour(to.mass, scale * inertia[k]);
            to.fullMass = fullMass * share[k];
            setFour(to.forceR, inertia[k][3] * gravity + pushes[k]);
            if constexpr (twoPhase) {
                LiquidCorner& ofLiquid = to.liquid;
                setFour(ofLiquid.mass, four(scale, scale, scale, whole) * liquid[k]);
                const double volume = whole * volumes[k][0]; // the force takes the whole cell
                setFour(ofLiquid.volume, four(volume, whole * volumes[k][1], mean * volume, 0));
            }
        };
        put(std::integral_constant<int, 0>{});
        put(std::integral_constant<int, 1>{});
        put(std::integral_constant<int, 2>{});
        put(std::integral_constant<int, 3>{});
        if constexpr (twoPhase) {
            if (resting(c)) {
                fem_.pressure[femOf_[c]] = mean;
            }
        }
    }
}

/// strainOfFilled of `count` cells, with one dilatation, and how their points move.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::strainByFours(const int* cells, int count, double dt,
                                                CellMotion* motions) const
    requires hasFours
{
    const auto integrals = Shape::integrals(cellLanes<Four>(cells, count));
    Four vr[4], vz[4], wr[4], wz[4];
    const auto cell = [&](int l) { return cells[std::min(l, count - 1)]; };
    for (int k = 0; k < 4; ++k) {
        std::array<Four, 4> rows;
        for (int l = 0; l < 4; ++l) {
            rows[l] = fourFrom(nodes_[cellNodes_[cell(l) * corners + k]].mass);
        }
        transpose(rows);
        vr[k] = rows[1];
        vz[k] = rows[2];
        if constexpr (twoPhase) {
            for (int l = 0; l < 4; ++l) {
                rows[l] = fourFrom(liquidNodes_[cellNodes_[cell(l) * corners + k]].relativeVr);
            }
            transpose(rows);
            wr[k] = vr[k] + rows[0];
            wz[k] = vz[k] + rows[1];
        }
    }
    shapes::VelocityGradient<4, Four> gradient;
    Shape::velocityGradient(integrals, vr, vz, gradient);
    const Four rate = gradient[0][0] + gradient[0][1] + gradient[0][2];
    Four strain[3][4], spin[3];
    for (int i = 0; i < 3; ++i) {
        kernels::strainOf(gradient[i], i == 0 ? rate : Four(0), dt, strain[i], spin[i]);
    }
    const auto centre = [&](int d) {
        return four(pointCentre_[cell(0)][d], pointCentre_[cell(1)][d], pointCentre_[cell(2)][d],
                    pointCentre_[cell(3)][d]);
    };
    const Four centreXi = centre(0);
    const Four centreEta = centre(1);
    for (int j = 0; j < 4; ++j) {
        strain[0][j] -= centreXi * strain[1][j] + centreEta * strain[2][j];
    }
    spin[0] -= centreXi * spin[1] + centreEta * spin[2];
    const Four liquidRate = twoPhase ? Shape::divergence(integrals, wr, wz) : Four(0);
    std::array<Four, 4> rows[4] = {{strain[0][0], strain[0][1], strain[0][2], strain[0][3]},
                                   {strain[1][0], strain[1][1], strain[1][2], strain[1][3]},
                                   {strain[2][0], strain[2][1], strain[2][2], strain[2][3]},
                                   {spin[0], spin[1], spin[2], rate}};
    for (std::array<Four, 4>& of : rows) {
        transpose(of);
    }
    const bool sharesVelocity = scene_.controls.flipOf(dt) < 1;
    for (int l = 0; l < count; ++l) {
        CellMotion& result = motions[l];
        for (int i = 0; i < 3; ++i) {
            setFour(result.strain[i][0], rows[i][l]);
            result.spin[i] = rows[3][l][i];
        }
        result.rate = rows[3][l][3];
        result.liquidRate = liquidRate[l];
        const int* const nodes = &cellNodes_[static_cast<std::size_t>(cells[l]) * corners];
        const auto setModes = [&](double(&to)[4][4], const auto& of) {
            kernels::setModes<Shape>(to, {of(nodes[0]), of(nodes[1]), of(nodes[2]), of(nodes[3])});
        };
        setModes(result.motion, [&](int i) { return nodes_[i].motion(); });
        if constexpr (twoPhase) {
            setModes(result.liquidMotion, [&](int i) { return liquidNodes_[i].motion(); });
        }
        if (sharesVelocity) {
            setModes(result.velocity, [&](int i) { return fourFrom(nodes_[i].mass); });
        }
    }
}

/// What the points of a cell at rest catch up with (wakeFemCell), as the motion of a step of one second.
template <class Shape, int phases>
auto ExplicitStep<Shape, phases>::motionSinceRest(int c) const -> CellMotion
    requires hasFours
{
    CellMotion result;
    const int f = femOf_[c];
    double strainR[corners], strainZ[corners];
    std::array<Four, corners> motion, liquidMotion, velocity;
    for (int k = 0; k < corners; ++k) {
        const int j = fem_.node[f][k];
        const FemNode& since = femNodes_[j];
        strainR[k] = femHistory_[j].strainR;
        strainZ[k] = femHistory_[j].strainZ;
        motion[k] = four(since.dvr, since.dvz, since.placeR, since.placeZ);
        velocity[k] = fourFrom(nodes_[since.node].mass);
        if constexpr (twoPhase) {
            liquidMotion[k] = four(since.relativeR, since.relativeZ, femHistory_[j].keep,
                                   liquidNodes_[since.node].pressure);
        }
    }
    shapes::VelocityGradient<corners> gradient;
    Shape::velocityGradient(cells_[c], strainR, strainZ, gradient);
    for (int i = 0; i < 3; ++i) {
        kernels::strainOf(gradient[i], i == 0 ? fem_.dilatation[f] : 0.0, 1.0, result.strain[i],
                          result.spin[i]);
    }
    const auto [xi, eta] = pointCentre_[c];
    for (int j = 0; j < 4; ++j) {
        result.strain[0][j] -= xi * result.strain[1][j] + eta * result.strain[2][j];
    }
    result.spin[0] -= xi * result.spin[1] + eta * result.spin[2];
    result.rate = fem_.dilatation[f];
    kernels::setModes<Shape>(result.motion, motion);
    if constexpr (twoPhase) {
        kernels::setModes<Shape>(result.liquidMotion, liquidMotion);
    }
    if (femFlip_ < 1) {
        kernels::setModes<Shape>(result.velocity, velocity);
    }
    return result;
}

/// mapCellToPoints of filled cells or, with a step of one second, wakeFemCell of those at rest.
template <class Shape, int phases>
template <bool wake>
void ExplicitStep<Shape, phases>::moveByFours(State& state, double dt, std::span<const int> cells,
                                              const CellMotion* motions)
    requires hasFours
{
    const PointArrays<double> points(state.points, scene_.materials.size());
    const std::array<double*, 4> strainOf{strain_[0].data(), strain_[1].data(), strain_[2].data(),
                                          strain_[3].data()};
    double* const spinOf = spin_.data();
    const std::size_t size = state.points.size();
    const double flip = wake ? femFlip_ : scene_.controls.flipOf(dt);
    std::array<double, cellsPerPiece> shifts; // of the mean pressure
    for (std::size_t j = 0; j < cells.size(); ++j) {
        const int c = cells[j];
        const CellMotion& motion = motions[j];
        const typename Shape::Cell cell = cells_[c];
        const double e = dt * motion.rate;
        const double growth = wake ? std::exp(e) : 1 + e * (1 + 0.5 * e); // exp(e)
        if (!wake) {
            state.cellDivergence[c] = motion.rate;
        }

        const auto move = [&](const auto& p, const Four& x, const Four& y, const Four& z, const Four& mass,
                              const Four& volume) __attribute__((always_inline))
        {
            const Four xy = x * y;
            for (int i = 0; i < 4; ++i) {
                p.set(strainOf[i], motion.strain[0][i] + x * motion.strain[1][i] + y * motion.strain[2][i]);
            }
            p.set(spinOf, motion.spin[0] + x * motion.spin[1] + y * motion.spin[2]);
            Four newR = p.of(points.vr) + kernels::fieldAt(motion.motion, 0, x, y, xy);
            Four newZ = p.of(points.vz) + kernels::fieldAt(motion.motion, 1, x, y, xy);
            if (flip < 1) {
                newR = flip * newR + (1 - flip) * kernels::fieldAt(motion.velocity, 1, x, y, xy);
                newZ = flip * newZ + (1 - flip) * kernels::fieldAt(motion.velocity, 2, x, y, xy);
            }
            p.set(points.vr, newR);
            p.set(points.vz, newZ);
            p.set(points.volume, min(volume * growth, mass * p.ofMaterial(largestVolume_, points)));
            p.set(points.r, p.of(points.r) + dt * kernels::fieldAt(motion.motion, 2, x, y, xy));
            p.set(points.z, z + dt * kernels::fieldAt(motion.motion, 3, x, y, xy));
            return std::array{newR, newZ};
        };
        const int* const first = pointCells_.begin(c);
        const int* const last = pointCells_.end(c);
        if constexpr (!twoPhase) {
            forFours(
                first, last, size, [&](const auto& p) __attribute__((always_inline)) {
                    const Four z = p.of(points.z);
                    const auto [x, y] = Shape::local(cell, p.of(points.r), z);
                    move(p, x, y, z, p.of(points.mass), p.of(points.volume));
                });
        } else {
            const double increment = !wake && projects() ? pressureStep_[c] : 0;
            const double liquidStrain = wake ? 0 : dt * motion.liquidRate;
            const double excess = wake ? fem_.pressure[femOf_[c]] : 0;
            Four difference = 0, volumeSum = 0;
            forFours(
                first, last, size, [&](const auto& p) __attribute__((always_inline)) {
                    const Four z = p.of(points.z);
                    const auto [x, y] = Shape::local(cell, p.of(points.r), z);
                    const Four xy = x * y;
                    const Four mass = p.of(points.mass);
                    const Four volume = p.of(points.volume);
                    Four pressure =
                        wake ? excess + unitWeight_ * z : Four(p.of(points.porePressure) + increment);
                    if (!wake && !projects()) { // storage, as in mapCellToPoints
                        const Four inverseN =
                            volume /
                            (volume - mass * p.ofMaterial(liquid_, points, &LiquidProperties::grainVolume));
                        pressure -= p.ofMaterial(liquid_, points, &LiquidProperties::bulkModulus) *
                                    ((inverseN - 1) * e + liquidStrain);
                    }
                    const Four shown = kernels::fieldAt(motion.liquidMotion, 3, x, y, xy) + unitWeight_ * z;
                    const Four v = p.only(volume);
                    difference += v * (pressure - shown);
                    volumeSum += v;
                    p.set(points.porePressure, shown);
                    const Four keep = kernels::fieldAt(motion.liquidMotion, 2, x, y, xy);
                    const Four relativeR = kernels::fieldAt(motion.liquidMotion, 0, x, y, xy) +
                                           keep * (p.of(points.wr) - p.of(points.vr));
                    const Four relativeZ = kernels::fieldAt(motion.liquidMotion, 1, x, y, xy) +
                                           keep * (p.of(points.wz) - p.of(points.vz));
                    const auto [newR, newZ] = move(p, x, y, z, mass, volume);
                    p.set(points.wr, newR + relativeR);
                    p.set(points.wz, newZ + relativeZ);
                });
            shifts[j] = reduce(difference) / reduce(volumeSum);
        }
    }
    // The differences of the nodes with the mean of the points
    for (std::size_t j = 0; twoPhase && j < cells.size(); ++j) {
        forFours(
            pointCells_.begin(cells[j]), pointCells_.end(cells[j]),
            size, [&](const auto& p) __attribute__((always_inline)) {
                p.set(points.porePressure,
                      max(p.of(points.porePressure) + shifts[j],
                          p.ofMaterial(liquid_, points, &LiquidProperties::leastPressure)));
            });
    }
}

} // namespace caisson
