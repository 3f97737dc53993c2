#pragma once

#include "timeStepping/NodesToPoints.h"

// The points of filled cells that are rectangles, four at a time. The shape functions of a rectangle are
// products of 1 +- xi and 1 +- eta: sums over the points need a quantity times 1, xi, eta and xi eta, and
// come to the corners once per cell; what the corners give the points has four coefficients in the same way.
namespace caisson {

namespace kernels {

/// Sums of a quantity of the points times 1, xi, eta and xi eta, apart for every fourth point.
struct Modes
{
    Four of[4] = {0, 0, 0, 0};

    [[gnu::always_inline]] void add(const Four& value, const Four& xi, const Four& eta, const Four& xiEta)
    {
        of[0] += value;
        of[1] += xi * value;
        of[2] += eta * value;
        of[3] += xiEta * value;
    }
};

/// Of four quantities at the corners: those of all modes.
[[gnu::always_inline]] inline std::array<Four, 4> sumsOf(const Modes& a, const Modes& b, const Modes& c,
                                                         const Modes& d)
{
    return {sums(a.of[0], b.of[0], c.of[0], d.of[0]), sums(a.of[1], b.of[1], c.of[1], d.of[1]),
            sums(a.of[2], b.of[2], c.of[2], d.of[2]), sums(a.of[3], b.of[3], c.of[3], d.of[3])};
}

/// Four quantities with their four modes over a cell, and each of them at four points.
struct Fields
{
    alignas(4 * sizeof(double)) double modes[4][4];

    explicit Fields(const std::array<Four, 4>& ofModes)
    {
        for (int m = 0; m < 4; ++m) {
            setFour(modes[m][0], ofModes[m]);
        }
    }
    [[gnu::always_inline]] [[nodiscard]] Four at(int quantity, const Four& xi, const Four& eta,
                                                 const Four& xiEta) const
    {
        return (modes[0][quantity] + xi * modes[1][quantity]) +
               (eta * modes[2][quantity] + xiEta * modes[3][quantity]);
    }
};

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

/// Mass, momenta and drag of the liquid, volume and pore volume at the corners.
/// @return the sum of volume times excess pressure
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::sumLiquidByFours(const MaterialPoints& points, int c,
                                                     std::array<Four, corners>& inertia,
                                                     std::array<Four, corners>& volumes) const
    requires hasFours
{
    const typename Shape::Cell cell = cells_[c];
    kernels::Modes mass, momentumR, momentumZ, drag, volume, pores;
    Four pressure = 0;
    forFours(
        pointCells_.begin(c), pointCells_.end(c),
        points.size(), [&](const auto& p) __attribute__((always_inline)) {
            const Four z = p.of(points.z);
            const Four x = (p.of(points.r) - cell.r0) * (2 * cell.invDr) - 1;
            const Four y = (z - cell.z0) * (2 * cell.invDz) - 1;
            const Four xy = x * y;
            const Four whole = p.of(points.volume);
            const Four v = p.only(whole);
            const Four w = p.only(whole - p.of(points.mass) * p.ofMaterial(liquid_, points.material,
                                                                           &LiquidProperties::grainVolume));
            const Four m = w * p.ofMaterial(liquid_, points.material, &LiquidProperties::density);
            mass.add(m, x, y, xy);
            momentumR.add(m * p.of(points.wr), x, y, xy);
            momentumZ.add(m * p.of(points.wz), x, y, xy);
            drag.add(w * (w / whole) *
                         p.ofMaterial(liquid_, points.material, &LiquidProperties::constantDrag),
                     x, y, xy);
            volume.add(v, x, y, xy);
            pores.add(w, x, y, xy);
            pressure += v * (p.of(points.porePressure) - unitWeight_ * z);
        });
    inertia = Shape::cornerSums(kernels::sumsOf(mass, momentumR, momentumZ, drag));
    volumes = Shape::cornerSums(kernels::sumsOf(volume, pores, {}, {}));
    return reduce(pressure);
}

/// strainOfFilled of `count` cells, with one dilatation: what moveByFours takes of it, about the middles of
/// the cells.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::strainByFours(const int* cells, int count, double dt,
                                                FilledStrain* strains) const
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
    for (int l = 0; l < count; ++l) {
        FilledStrain& result = strains[l];
        for (int i = 0; i < 3; ++i) {
            setFour(result.strain[i][0], rows[i][l]);
            result.spin[i] = rows[3][l][i];
        }
        result.rate = rows[3][l][3];
        result.liquidRate = liquidRate[l];
    }
}

/// mapCellToPoints of a filled cell.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::moveByFours(State& state, double dt, int c, const FilledStrain& strain)
    requires hasFours
{
    MaterialPoints& points = state.points;
    const typename Shape::Cell cell = cells_[c];
    const double flip = scene_.controls.flipOf(dt);
    const CornerMotion corner = cornerMotion(c);
    const kernels::Fields moves(Shape::modes(corner.motion.data()));
    const auto vr = Shape::modes(corner.vr);
    const auto vz = Shape::modes(corner.vz);
    const double e = dt * strain.rate;
    const double growth = 1 + e * (1 + 0.5 * e); // exp(e)
    state.cellDivergence[c] = strain.rate;

    const auto move = [&](const auto& p, const Four& x, const Four& y, const Four& z, const Four& mass,
                          const Four& volume) __attribute__((always_inline))
    {
        const Four xy = x * y;
        for (int j = 0; j < 4; ++j) {
            p.set(strain_[j], strain.strain[0][j] + x * strain.strain[1][j] + y * strain.strain[2][j]);
        }
        p.set(spin_, strain.spin[0] + x * strain.spin[1] + y * strain.spin[2]);
        const Four oldR = p.of(points.vr);
        const Four oldZ = p.of(points.vz);
        Four newR = oldR + moves.at(0, x, y, xy);
        Four newZ = oldZ + moves.at(1, x, y, xy);
        if (flip < 1) {
            newR = flip * newR + (1 - flip) * (vr[0] + x * vr[1] + y * vr[2] + xy * vr[3]);
            newZ = flip * newZ + (1 - flip) * (vz[0] + x * vz[1] + y * vz[2] + xy * vz[3]);
        }
        p.set(points.vr, newR);
        p.set(points.vz, newZ);
        p.set(points.volume, min(volume * growth, mass * p.ofMaterial(largestVolume_, points.material)));
        p.set(points.r, p.of(points.r) + dt * moves.at(2, x, y, xy));
        p.set(points.z, z + dt * moves.at(3, x, y, xy));
    };
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);
    if constexpr (!twoPhase) {
        forFours(
            first, last, points.size(), [&](const auto& p) __attribute__((always_inline)) {
                const Four x = (p.of(points.r) - cell.r0) * (2 * cell.invDr) - 1;
                const Four z = p.of(points.z);
                const Four y = (z - cell.z0) * (2 * cell.invDz) - 1;
                move(p, x, y, z, p.of(points.mass), p.of(points.volume));
            });
    } else {
        const kernels::Fields flows(Shape::modes(corner.liquidMotion.data()));
        const double increment = projects() ? pressureStep_[c] : 0;
        const double liquidStrain = dt * strain.liquidRate;
        Four difference = 0, volumeSum = 0;
        forFours(
            first, last, points.size(), [&](const auto& p) __attribute__((always_inline)) {
                const Four x = (p.of(points.r) - cell.r0) * (2 * cell.invDr) - 1;
                const Four z = p.of(points.z);
                const Four y = (z - cell.z0) * (2 * cell.invDz) - 1;
                const Four xy = x * y;
                const Four mass = p.of(points.mass);
                const Four volume = p.of(points.volume);
                Four pressure = p.of(points.porePressure) + increment;
                if (!projects()) { // storage, as in mapCellToPoints
                    const Four inverseN =
                        volume / (volume - mass * p.ofMaterial(liquid_, points.material,
                                                               &LiquidProperties::grainVolume));
                    pressure -= p.ofMaterial(liquid_, points.material, &LiquidProperties::bulkModulus) *
                                ((inverseN - 1) * e + liquidStrain);
                }
                const Four shown = flows.at(3, x, y, xy) + unitWeight_ * z;
                const Four v = p.only(volume);
                difference += v * (pressure - shown);
                volumeSum += v;
                p.set(points.porePressure, shown);
                const Four keep = flows.at(2, x, y, xy);
                const Four relativeR = flows.at(0, x, y, xy) + keep * (p.of(points.wr) - p.of(points.vr));
                const Four relativeZ = flows.at(1, x, y, xy) + keep * (p.of(points.wz) - p.of(points.vz));
                move(p, x, y, z, mass, volume);
                p.set(points.wr, p.of(points.vr) + relativeR);
                p.set(points.wz, p.of(points.vz) + relativeZ);
            });
        // The differences of the nodes with the mean of the points
        const double shift = reduce(difference) / reduce(volumeSum);
        forFours(
            first, last, points.size(), [&](const auto& p) __attribute__((always_inline)) {
                p.set(points.porePressure,
                      max(p.of(points.porePressure) + shift,
                          p.ofMaterial(liquid_, points.material, &LiquidProperties::leastPressure)));
            });
    }
}

} // namespace caisson
