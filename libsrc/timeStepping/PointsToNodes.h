#pragma once

#include "timeStepping/ExplicitStepKernels.h"

// From the points to the nodes: masses, momenta and forces.
namespace caisson {

namespace kernels {

/// Second moments of the points of a cell about their centre, in local coordinates, and the slopes over the
/// cell of a quantity with the first moments cx, cy. The ridge keeps slopes from being extrapolated out of a
/// cluster of points.
template <class Real>
struct Spread
{
    Spread(const Real& inXi, const Real& inEta, const Real& mixed)
        : xx(inXi), yy(inEta), xy(mixed), inverse(1 / ((xx + ridge) * (yy + ridge) - xy * xy))
    {
    }

    [[nodiscard]] Real slopeXi(const Real& cx, const Real& cy) const
    {
        return cx * ((yy + ridge) * inverse) - cy * (xy * inverse);
    }
    [[nodiscard]] Real slopeEta(const Real& cx, const Real& cy) const
    {
        return cy * ((xx + ridge) * inverse) - cx * (xy * inverse);
    }
    /// Shares of the slopes of a stress that the points show.
    [[nodiscard]] Real shareXi() const { return xx / (xx + ridge); }
    [[nodiscard]] Real shareEta() const { return yy / (yy + ridge); }

    Real xx, yy, xy, inverse; ///< moments; 1 over their determinant

private:
    static constexpr double ridge = 0.02;
};

/// The stress of a filled cell, or of several: mean and slopes, from the sums over its points.
template <int corners, class Real>
struct FilledStress
{
    Real inverse;           ///< 1 over the volume of the points
    Real xi, eta;           ///< centre of the points
    Real shareXi, shareEta; ///< see Spread
    shapes::StressField<corners, Real> field;
};

/// What varies over a cell at rest is known from its weight, wherever the points are: only the rest is taken
/// from them. `rise` is that of the height with xi and eta, `fullWeight` per volume. With a shared dilatation
/// the mean stress works on the mean dilatation alone.
template <int corners, class Real>
[[gnu::always_inline]] inline FilledStress<corners, Real>
filledStress(const StressSums<Real>& sums, const std::array<Real, 2>& rise, const Real& fullWeight,
             const Real& viscous, bool shared, const std::array<Real, 2>* centre)
{
    using std::max, std::min;
    FilledStress<corners, Real> result;
    result.inverse = 1 / sums.w;
    Real mean[4];
    for (int j = 0; j < 4; ++j) {
        mean[j] = sums.s[j] * result.inverse;
        result.field[0][j] = mean[j];
    }
    if constexpr (corners == 4) {
        const Real zero = shapes::zero<Real>();
        const Real one = zero + 1;
        const Real halfRise = max(max(rise[0], -rise[0]), max(rise[1], -rise[1]));
        // Soil that carries less than half a cell of itself is not at rest.
        const Real push = max(-(mean[1] + viscous), zero + std::numeric_limits<double>::min());
        const Real weight = min(push / halfRise, max(fullWeight, zero));
        const Real ratio = max(zero, min(one, -(mean[0] + viscous) / push));
        const Real known[4] = {ratio * weight, weight, ratio * weight, zero};
        const Real x = sums.wx * result.inverse;
        const Real y = sums.wy * result.inverse;
        const Spread<Real> spread(sums.wxx * result.inverse - x * x, sums.wyy * result.inverse - y * y,
                                  sums.wxy * result.inverse - x * y);
        for (int j = 0; j < 4; ++j) {
            const Real knownXi = known[j] * rise[0];
            const Real knownEta = known[j] * rise[1];
            const Real cx =
                sums.sx[j] * result.inverse - x * mean[j] - knownXi * spread.xx - knownEta * spread.xy;
            const Real cy =
                sums.sy[j] * result.inverse - y * mean[j] - knownXi * spread.xy - knownEta * spread.yy;
            result.field[0][j] -= knownXi * x + knownEta * y;
            result.field[1][j] = spread.slopeXi(cx, cy) + knownXi;
            result.field[2][j] = spread.slopeEta(cx, cy) + knownEta;
            if (centre) { // from that of the points to that of the cell
                result.field[0][j] -= (result.field[1][j] - knownXi) * (x - (*centre)[0]) +
                                      (result.field[2][j] - knownEta) * (y - (*centre)[1]);
            }
        }
        for (int i = 1; shared && i < 3; ++i) {
            const Real third = (result.field[i][0] + result.field[i][1] + result.field[i][2]) * (1.0 / 3);
            for (int j = 0; j < 3; ++j) {
                result.field[i][j] -= third;
            }
        }
        result.xi = x;
        result.eta = y;
        result.shareXi = spread.shareXi();
        result.shareEta = spread.shareEta();
    }
    return result;
}

inline Four stressOf(const MaterialPoints& points, int p)
{
    return four(points.stress[0][p], points.stress[1][p], points.stress[2][p], points.stress[3][p]);
}

} // namespace kernels

/// The points of a filled cell as the samples of a quadrature that is exact for linear functions: the centre
/// of their volumes is moved to that of the cell's. No weight changes by more than nine tenths.
template <class Shape, int phases>
kernels::Fit ExplicitStep<Shape, phases>::fitWeights(const State& state, int c) const
{
    constexpr double largestChange = 0.9;
    kernels::Fit fit;
    if constexpr (corners == 4) {
        const MaterialPoints& points = state.points;
        double w = 0, wx = 0, wy = 0, wxx = 0, wyy = 0, wxy = 0;
        double left = 1, right = -1, low = 1, high = -1;
        for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
            const auto [x, y] = Shape::local(cells_[c], points.r[*i], points.z[*i]);
            const double v = points.volume[*i];
            w += v;
            wx += v * x;
            wy += v * y;
            wxx += v * x * x;
            wyy += v * y * y;
            wxy += v * x * y;
            left = std::min(left, x);
            right = std::max(right, x);
            low = std::min(low, y);
            high = std::max(high, y);
        }
        fit.xi = wx / w;
        fit.eta = wy / w;
        const kernels::Spread spread(wxx / w - fit.xi * fit.xi, wyy / w - fit.eta * fit.eta,
                                     wxy / w - fit.xi * fit.eta);
        const double cx = Shape::moments(cells_[c]).xiCentre - fit.xi;
        const double cy = -fit.eta;
        fit.slopeXi = spread.slopeXi(cx, cy);
        fit.slopeEta = spread.slopeEta(cx, cy);
        const double change = std::abs(fit.slopeXi) * std::max(right - fit.xi, fit.xi - left) +
                              std::abs(fit.slopeEta) * std::max(high - fit.eta, fit.eta - low);
        if (change > largestChange) {
            fit.slopeXi *= largestChange / change;
            fit.slopeEta *= largestChange / change;
        }
    }
    return fit;
}

/// What the velocity of a point becomes at a corner of its cell, less what it is at the point [m/s].
template <class Shape, int phases>
std::array<double, 2> ExplicitStep<Shape, phases>::affineVelocity(const State& state, int p, int corner) const
{
    const MaterialPoints& points = state.points;
    const double r = state.mesh.r[cellNodes_[corner]] - points.r[p];
    const double z = state.mesh.z[cellNodes_[corner]] - points.z[p];
    return {points.gradient[0][p] * r + points.gradient[1][p] * z,
            points.gradient[2][p] * r + points.gradient[3][p] * z};
}

/// Bulk viscosity [von Neumann & Richtmyer 1950], with Landshoff's linear term; the quadratic one in
/// compression only [Pa].
template <class Shape, int phases>
double ExplicitStep<Shape, phases>::viscousStress(const State& state, int c, int material) const
{
    const SolutionControls& controls = scene_.controls;
    if (!controls.isViscous()) {
        return 0;
    }
    const double rate = state.cellDivergence[c];
    const double size = Shape::size(cells_[c]);
    double stress = density_[material] * size * controls.linearBulkViscosity * waveSpeed_[material] * rate;
    if (rate < 0) {
        const double quadratic = controls.quadraticBulkViscosity * size * rate;
        stress -= density_[material] * quadratic * quadratic;
    }
    return stress;
}

/// What the points of a cell put on its corners, but for the stress of a filled cell: of that `sums`
/// (addStress).
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::sumPoints(const State& state, int c, kernels::StressSums<double>& sums)
{
    const MaterialPoints& points = state.points;
    const typename Shape::Cell& cell = cells_[c];
    const bool meanDilatation = scene_.controls.locking == SolutionControls::Locking::meanDilatation;
    const int* const first = pointCells_.begin(c);
    const int* const last = pointCells_.end(c);

    std::array<Four, corners> inertia; // mass, momenta, weight over gravity
    inertia.fill(0);
    Values values;
    const bool affine = points.affine();
    const bool fitted = fits(c) && state.filled[c] != 0;
    const kernels::Fit fit = fitted ? fitWeights(state, c) : kernels::Fit{};
    if (!fit_.empty()) {
        fit_[c] = fit;
    }
    const auto addInertiaAndWeight = [&](int p, double x, double y) {
        const double pointMass = fitted ? fit.at(x, y) * points.mass[p] : points.mass[p];
        const double m = twoPhase ? pointMass * solidShare_[points.material[p]] : pointMass;
        const Four ofPoint =
            four(m, m * points.vr[p], m * points.vz[p], pointMass * gravityShare_[points.material[p]]);
        for (int k = 0; k < corners; ++k) {
            inertia[k] += values.N[k] * ofPoint;
        }
        for (int k = 0; affine && k < corners; ++k) {
            const auto [r, z] = affineVelocity(state, p, c * corners + k);
            inertia[k] += values.N[k] * m * four(0, r, z, 0);
        }
    };

    double forceR[corners] = {}; // of the stress
    double forceZ[corners] = {};
    if (state.filled[c]) {
        sums = {};
        Four stressSum = 0, ofXi = 0, ofEta = 0;
        for (const int* i = first; i != last; ++i) {
            const int p = *i;
            const auto [x, y] = Shape::evaluate(cell, points.r[p], points.z[p], values);
            addInertiaAndWeight(p, x, y);
            const double v = points.volume[p];
            const Four ofPoint = v * kernels::stressOf(points, p);
            sums.w += v;
            stressSum += ofPoint;
            if constexpr (corners == 4) {
                const double vx = v * x;
                const double vy = v * y;
                sums.wx += vx;
                sums.wy += vy;
                sums.wxx += vx * x;
                sums.wyy += vy * y;
                sums.wxy += vx * y;
                ofXi += x * ofPoint;
                ofEta += y * ofPoint;
            }
        }
        setFour(sums.s[0], stressSum);
        setFour(sums.sx[0], ofXi);
        setFour(sums.sy[0], ofEta);
        fullness_[c] = dilatation_[c].volume / sums.w;
    } else {
        fullness_[c] = 1;
        double br[corners] = {};
        double bz[corners] = {};
        double volume = 0;
        double pressureVolume = 0;
        const double viscousStress = this->viscousStress(state, c, points.material[*first]);
        for (const int* i = first; i != last; ++i) {
            const int p = *i;
            Shape::evaluate(cell, points.r[p], points.z[p], values);
            addInertiaAndWeight(p, 0, 0);
            const double v = points.volume[p];
            double stress[4];
            for (int j = 0; j < 4; ++j) {
                stress[j] = points.stress[j][p] + (j < 3 ? viscousStress : 0);
            }
            const double inverseR = axisymmetric ? 1 / std::max(points.r[p], kernels::smallestRadius) : 0;
            if (meanDilatation) {
                const double mean = (stress[0] + stress[1] + stress[2]) / 3;
                stress[0] -= mean;
                stress[1] -= mean;
                stress[2] -= mean;
                pressureVolume += v * mean;
                volume += v;
                for (int k = 0; k < corners; ++k) {
                    br[k] += v * (values.dr[k] + values.N[k] * inverseR);
                    bz[k] += v * values.dz[k];
                }
            }
            for (int k = 0; k < corners; ++k) {
                forceR[k] -= v * (stress[0] * values.dr[k] + stress[3] * values.dz[k] +
                                  stress[2] * values.N[k] * inverseR);
                forceZ[k] -= v * (stress[1] * values.dz[k] + stress[3] * values.dr[k]);
            }
        }
        if (meanDilatation) {
            const double meanStress = pressureVolume / volume;
            for (int k = 0; k < corners; ++k) {
                forceR[k] -= meanStress * br[k];
                forceZ[k] -= meanStress * bz[k];
            }
        }
    }

    const std::array<double, corners> share = Shape::cornerShares(cell);
    const double scale = inertiaScale_[c] * fullness_[c];
    const double gravityR = scene_.gravity[0] * fullness_[c];
    const double gravityZ = scene_.gravity[1] * fullness_[c];
    const double fullMass = inertiaScale_[c] * density_[points.material[*first]] *
                            (twoPhase ? solidShare_[points.material[*first]] : 1.0) * dilatation_[c].volume;
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        const double weight = inertia[k][3];
        setFour(out[k].mass, scale * inertia[k]);
        out[k].fullMass = fullMass * share[k];
        setFour(out[k].forceR, four(forceR[k] + gravityR * weight, forceZ[k] + gravityZ * weight, 0, 0));
    }
}

/// What the shape needs of `count` cells; of the last one again where they are fewer than the lanes.
template <class Shape, int phases>
template <class Real>
auto ExplicitStep<Shape, phases>::cellLanes(const int* cells, int count) const
{
    if constexpr (std::is_same_v<Real, double>) {
        return cells_[*cells];
    } else {
        std::array<Four, 4> corner, sides; // r0, z0, dr, dz; dr, dz and 1 over them
        for (int l = 0; l < 4; ++l) {
            const typename Shape::Cell& cell = cells_[cells[std::min(l, count - 1)]];
            corner[l] = Four(&cell.r0, std::experimental::element_aligned);
            sides[l] = Four(&cell.dr, std::experimental::element_aligned);
        }
        transpose(corner);
        transpose(sides);
        return typename Shape::template Sides<Real>{corner[0], corner[1], sides[0],
                                                    sides[1],  sides[2],  sides[3]};
    }
}

/// Puts the stress of `count` filled cells on their corners.
template <class Shape, int phases>
template <class Real>
void ExplicitStep<Shape, phases>::addStress(const State& state, const int* cells, int count,
                                            const kernels::StressSums<double>* sums)
{
    const SolutionControls& controls = scene_.controls;
    const MaterialPoints& points = state.points;
    const auto material = [&](int l) { return points.material[*pointCells_.begin(cells[l])]; };
    Real fullWeight = shapes::zero<Real>();
    Real viscous = shapes::zero<Real>();
    for (int l = 0; l < count; ++l) {
        shapes::setLane(fullWeight, l,
                        -scene_.gravity[1] * gravityShare_[material(l)] * density_[material(l)]);
        if (controls.isViscous()) {
            shapes::setLane(viscous, l, viscousStress(state, cells[l], material(l)));
        }
    }
    const auto cell = cellLanes<Real>(cells, count);
    std::array<Real, 2> centre{};
    bool atCentre = false;
    if constexpr (corners == 4 && std::is_same_v<Real, double>) {
        atCentre = fits(*cells);
        centre[0] = atCentre ? Shape::moments(cell).xiCentre : 0;
    }
    std::array<Real, 2> rise{};
    if constexpr (corners == 4) {
        rise = Shape::heightSlopes(cell);
    }
    auto stress = kernels::filledStress<corners, Real>(
        kernels::StressSums<Real>::of(sums, count), rise, fullWeight, viscous,
        controls.locking == SolutionControls::Locking::meanDilatation, atCentre ? &centre : nullptr);
    for (int l = 0; l < count; ++l) {
        const int c = cells[l];
        if constexpr (corners == 4) {
            pointCentre_[c] = {shapes::lane(stress.xi, l), shapes::lane(stress.eta, l)};
        }
        for (int i = 0; resting(c) && i < momentCount; ++i) {
            auto& to = i == 0 ? fem_.stress : i == 1 ? fem_.slopeXi : fem_.slopeEta;
            for (int j = 0; j < 4; ++j) {
                to[j][femOf_[c]] = shapes::lane(stress.field[i][j], l);
            }
            fem_.shareXi[femOf_[c]] = shapes::lane(stress.shareXi, l);
            fem_.shareEta[femOf_[c]] = shapes::lane(stress.shareEta, l);
        }
    }
    for (int j = 0; j < 3; ++j) {
        stress.field[0][j] += viscous;
    }
    Real forceR[corners], forceZ[corners];
    std::fill_n(forceR, corners, shapes::zero<Real>());
    std::fill_n(forceZ, corners, shapes::zero<Real>());
    Shape::addForces(cell, stress.field, forceR, forceZ);
    for (int k = 0; k < corners; ++k) {
        if constexpr (std::is_same_v<Real, Four>) {
            std::array<Four, 4> rows{forceR[k], forceZ[k], 0, 0};
            transpose(rows);
            for (int l = 0; l < count; ++l) {
                Corner& corner = cornerSums_[cells[l] * corners + k];
                setFour(corner.forceR, fourFrom(corner.forceR) + rows[l]);
            }
        } else {
            cornerSums_[*cells * corners + k].forceR += forceR[k];
            cornerSums_[*cells * corners + k].forceZ += forceZ[k];
        }
    }
}

/// Where the loaded surface of a point is now. The soil between the two keeps its mass, and the strip of
/// surface that it lies under its width in the plane: a length h over it at the mean radius m has come from
/// one H at M, with the volume ratio J of the point,
///
///     h m = J H M;  plane strain: h = J H.
///
/// With m = r + h_r/2, where h_r/H_r = h/H, that is r_surface^2 = r^2 + J H_r (2 R + H_r). So the wall of a
/// cylinder is where it is however far from it the point; where the strip widens, as on a sphere, the way
/// comes out too long.
template <class Shape, int phases>
typename ExplicitStep<Shape, phases>::PointSurface
ExplicitStep<Shape, phases>::surfaceOf(const MaterialPoints& points, int p) const
{
    const double volumeRatio = points.volume[p] * density_[points.material[p]] / points.mass[p];
    if constexpr (axisymmetric) {
        const double r = points.r[p];
        const double twiceM = 2 * points.initialR[p] + points.loadReachR[p];
        const double surface = std::sqrt(std::max(0.0, r * r + volumeRatio * points.loadReachR[p] * twiceM));
        return {volumeRatio * twiceM / (r + surface), surface};
    }
    return {volumeRatio, points.r[p] + volumeRatio * points.loadReachR[p]};
}

/// Force of the traction on a point now [N/rad or N/m].
template <class Shape, int phases>
std::array<double, 2> ExplicitStep<Shape, phases>::pointLoad(const MaterialPoints& points, int p) const
{
    const int load = points.load[p];
    double area = points.loadArea[p];
    if (scene_.pointLoads[load].areaFollows) {
        area *= surfaceOf(points, p).r / (points.initialR[p] + points.loadReachR[p]);
    }
    if (scene_.pointLoads[load].expression.given()) {
        return {area * expressionR_[p], area * expressionZ_[p]};
    }
    return {area * pointTraction_[load][0], area * pointTraction_[load][1]};
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addPointLoads(const State& state, int c)
{
    const MaterialPoints& points = state.points;
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        if (points.load[p] < 0) {
            continue;
        }
        const std::array<double, 2> force = pointLoad(points, p);
        // At the surface, whose way to the point changes as the soil between them strains. Shape functions of
        // the point's own cell, beyond its side where need be, have the moments of the force.
        const double stretch = surfaceOf(points, p).stretch;
        Shape::evaluate(cells_[c], points.r[p] + stretch * points.loadReachR[p],
                        points.z[p] + stretch * points.loadReachZ[p], values);
        for (int k = 0; k < corners; ++k) {
            cornerSums_[c * corners + k].forceR += values.N[k] * force[0];
            cornerSums_[c * corners + k].forceZ += values.N[k] * force[1];
        }
    }
}

/// What the expressions are at the points. What takes the velocities over a step are the forces in its
/// middle.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::evaluateExpressions(const State& state, double dt)
{
    const MaterialPoints& points = state.points;
    const double time = state.time + 0.5 * dt;
    const double lead = 0.5 * dt;
    threads_.share(static_cast<int>(points.size()), pointsPerPiece, [&](int thread, int begin, int end) {
        if (scene_.bodyForce.given()) {
            scene_.bodyForce.evaluate(points, begin, end, time, lead, bodyForceR_.data() + begin,
                                      bodyForceZ_.data() + begin, bodyForceRoom_[thread]);
        }
        for (int p = begin; p < end && !expressionR_.empty(); ++p) {
            const int load = points.load[p];
            if (load >= 0 && scene_.pointLoads[load].expression.given()) {
                scene_.pointLoads[load].expression.evaluate(points, p, p + 1, time, lead, &expressionR_[p],
                                                            &expressionZ_[p], expressionRoom_[thread][load]);
            }
        }
    });
}

/// As weight: on the true mass, not on scaled inertia; in filled cells on that of the whole cell.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addBodyForce(const State& state, int c)
{
    const MaterialPoints& points = state.points;
    Values values;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        const auto [x, y] = Shape::evaluate(cells_[c], points.r[p], points.z[p], values);
        const double mass = fullness_[c] * points.mass[p] * (fit_.empty() ? 1.0 : fit_[c].at(x, y));
        for (int k = 0; k < corners; ++k) {
            cornerSums_[c * corners + k].forceR += values.N[k] * mass * bodyForceR_[p];
            cornerSums_[c * corners + k].forceZ += values.N[k] * mass * bodyForceZ_[p];
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapToNodes(State& state)
{
    if constexpr (twoPhase) {
        wallTouches_.clear();
        prepareLiquid(state);
        for (const int c : voidCells_) {
            mapVoidToNodes(c);
        }
    }
    const bool loaded = state.points.loaded();
    for (std::size_t l = 0; loaded && l < pointTraction_.size(); ++l) {
        if (!scene_.pointLoads[l].expression.given()) {
            pointTraction_[l] = scene_.pointLoads[l].traction(state.time, loadedArea_[l]);
        }
    }
    if constexpr (hasBoxes) {
        if (!boxCell_.empty()) {
            makeBoxes(state);
        }
    }
    const bool asElements = femSteps_ > 0;
    if (asElements) {
        mapFemCellsToNodes();
    }
    const auto finish = [&](int c) {
        if (resting(c)) {
            sampleFemCell(c);
        }
        if (loaded) {
            addPointLoads(state, c);
        }
        if (scene_.bodyForce.given()) {
            addBodyForce(state, c);
        }
    };
    const auto mapCell = [&](int c) {
        if (asElements && resting(c)) {
            return;
        }
        if constexpr (hasBoxes) {
            if (inBoxes(c)) {
                mapBoxCellToNodes(state, c);
                return;
            }
        }
        kernels::StressSums<double> sums;
        sumPoints(state, c, sums);
        if (state.filled[c]) {
            addStress<double>(state, &c, 1, &sums);
        }
        if constexpr (twoPhase) {
            mapLiquidToNodes(state, c);
        }
        finish(c);
    };
    const WorkList& list = asElements ? awake_ : active_;
    if constexpr (hasFours) {
        const auto mayJoin = [&](int c) { return state.filled[c] != 0 && !(asElements && resting(c)); };
        forPieces(list, mayJoin, mapCell, [&](std::span<const int> cells) {
            std::array<kernels::StressSums<double>, cellsPerPiece> sums;
            sumByFours(state, cells, sums.data());
            for (std::size_t j = 0; j < cells.size(); j += 4) {
                addStress<Four>(state, &cells[j],
                                static_cast<int>(std::min<std::size_t>(4, cells.size() - j)), &sums[j]);
            }
            std::ranges::for_each(cells, finish);
        });
    } else {
        forItemsOf(list, mapCell);
    }
    if (scene_.conditions.hasTractions()) {
        std::ranges::fill(traction_, std::array<double, 2>{});
        scene_.conditions.addTractions(state.mesh, state.time, traction_);
    }
}

} // namespace caisson
