#pragma once

#include "mesh/BackgroundMesh.h"
#include "timeStepping/Four.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Shapes of background cells as the step kernels see them: shape functions at a place, and the moments of
/// the strain operator over a filled cell. The weight of the volume integral is r (axisymmetric, per radian)
/// or 1 (plane strain).
namespace caisson::shapes {

/// Shape functions of a cell and their gradients at one place.
template <int corners>
struct Values
{
    double N[corners];
    double dr[corners]; ///< dN/dr
    double dz[corners]; ///< dN/dz
};

/// Mean over a cell of the dilatation operator.
template <int corners>
struct MeanDilatation
{
    double volume;      ///< integral of the weight
    double br[corners]; ///< mean of dN/dr + N/r (axisymmetric) or dN/dr
    double bz[corners]; ///< mean of dN/dz
};

/// Volume moments of the strain operator over a filled cell: index 0 the mean, 1 and 2 the means weighted
/// with xi - xiCentre and eta - etaCentre (local coordinates in [-1, 1], less their volume means). A stress
/// field mean + slopeXi (xi - xiCentre) + slopeEta (eta - etaCentre) has the forces
///   f_r = volume sum_m (s_rr gr + s_rz gz + s_tt h),   f_z = volume sum_m (s_zz gz + s_rz gr),
/// and the mean and slopes of the strain follow from the same coefficients (divided by the moments of inertia
/// for the slopes): stress and strain are adjoint, so elastic stiffness is symmetric and no mode can gain
/// energy.
template <int corners>
struct Moments
{
    static constexpr int count = corners == 4 ? 3 : 1;
    double volume;
    double xiCentre = 0;
    double inertiaXi = 1, inertiaEta = 1;
    double n[corners];         ///< mean of N
    double gr[count][corners]; ///< of dN/dr
    double gz[count][corners]; ///< of dN/dz
    double h[count][corners];  ///< of N/r (axisymmetric), 0 in plane strain
};

/// Gradient of a velocity over a filled cell, rr zz hoop rz zr (rz is dv_r/dz): its mean, and its slopes with
/// xi - xiCentre and eta - etaCentre.
template <int corners, class Real = double>
using VelocityGradient = Real[Moments<corners>::count][5];
/// Stress over a filled cell, rr zz tt rz: its mean, and its slopes.
template <int corners, class Real = double>
using StressField = Real[Moments<corners>::count][4];

/// One value for each of so many cells that are computed together.
template <int lanes>
using Lanes = std::conditional_t<lanes == 1, double, Four>;

inline double lane(double value, int) { return value; }
template <class Real>
double lane(const Real& values, int l)
{
    return values[l];
}
inline void setLane(double& to, int, double value) { to = value; }
template <class Real>
void setLane(Real& to, int l, double value)
{
    to[l] = value;
}

/// `count` values from the f-th on; the last one again where they are fewer than the lanes. Count: int, or a
/// constant (EveryLane).
template <class Real, class Count>
[[gnu::always_inline]] inline Real lanesOf(const double* values, int f, Count count)
{
    if constexpr (std::is_same_v<Real, double>) {
        return values[f];
    } else {
        if (count == 4) {
            return Four(values + f, std::experimental::element_aligned);
        }
        const auto at = [&](int l) { return values[f + std::min<int>(l, count - 1)]; };
        return four(at(0), at(1), at(2), at(3));
    }
}
template <class Real, class Count>
[[gnu::always_inline]] inline Real lanesOf(const std::vector<double>& values, int f, Count count)
{
    return lanesOf<Real>(values.data(), f, count);
}

template <class Real, class Count>
[[gnu::always_inline]] inline void setLanes(double* values, int f, Count count, const Real& result)
{
    if constexpr (std::is_same_v<Real, double>) {
        values[f] = result;
    } else if (count == 4) {
        result.copy_to(values + f, std::experimental::element_aligned);
    } else {
        for (int l = 0; l < count; ++l) {
            values[f + l] = result[l];
        }
    }
}

/// As many as there are lanes.
template <int lanes>
using EveryLane = std::integral_constant<int, lanes>;

/// work(first, count) for groups of `lanes`, with a constant as the count of those that are whole.
template <int lanes, class Work>
[[gnu::always_inline]] inline void inLanes(int begin, int end, const Work& work)
{
    int f = begin;
    for (; f + lanes <= end; f += lanes) {
        work(f, EveryLane<lanes>{});
    }
    if (f < end) {
        work(f, end - f);
    }
}

template <class Real>
Real zero()
{
    return 0;
}

template <int corners>
void velocityGradient(const Moments<corners>& m, const double* vr, const double* vz,
                      VelocityGradient<corners>& gradient)
{
    const double inertia[3] = {1, m.inertiaXi, m.inertiaEta};
    for (int i = 0; i < Moments<corners>::count; ++i) {
        double g[5] = {};
        for (int k = 0; k < corners; ++k) {
            g[0] += m.gr[i][k] * vr[k];
            g[1] += m.gz[i][k] * vz[k];
            g[2] += m.h[i][k] * vr[k];
            g[3] += m.gz[i][k] * vr[k];
            g[4] += m.gr[i][k] * vz[k];
        }
        for (int j = 0; j < 5; ++j) {
            gradient[i][j] = g[j] / inertia[i];
        }
    }
}

/// What the stress does to the corners.
template <int corners>
void addForces(const Moments<corners>& m, const StressField<corners>& stress, double* forceR, double* forceZ)
{
    for (int i = 0; i < Moments<corners>::count; ++i) {
        const double* const s = stress[i];
        for (int k = 0; k < corners; ++k) {
            forceR[k] -= m.volume * (s[0] * m.gr[i][k] + s[3] * m.gz[i][k] + s[2] * m.h[i][k]);
            forceZ[k] -= m.volume * (s[1] * m.gz[i][k] + s[3] * m.gr[i][k]);
        }
    }
}

/// Mean of the divergence, and its adjoint.
template <int corners>
double divergence(const MeanDilatation<corners>& m, const double* vr, const double* vz)
{
    double sum = 0;
    for (int k = 0; k < corners; ++k) {
        sum += m.br[k] * vr[k] + m.bz[k] * vz[k];
    }
    return sum;
}
template <int corners>
void addPressure(const MeanDilatation<corners>& m, double pressure, double* forceR, double* forceZ)
{
    for (int k = 0; k < corners; ++k) {
        forceR[k] += m.volume * pressure * m.br[k];
        forceZ[k] += m.volume * pressure * m.bz[k];
    }
}

/// Cells that are computed with as they were, one by one.
template <class Cell>
class FrozenCells
{
public:
    void resize(std::size_t size) { cells_.resize(size); }
    void set(int f, const Cell& cell) { cells_[f] = cell; }
    template <class Count>
    [[nodiscard]] const Cell& at(int f, Count) const
    {
        return cells_[f];
    }

private:
    std::vector<Cell> cells_;
};

/// Stable step of quadrilaterals: this share of the shorter side over the wave speed. The shortest wave of
/// the nodes is partly lost on the way to the points and back; with the share phi that survives, the
/// leap-frog of the rest is stable for omega dt < 2/sqrt(2 - phi), which is 0.707 h/c at worst (phi = 0) and
/// 0.756 for two points per side. By bisection the limit is 0.79 h/c for squares and for cells ten times
/// longer than wide.
inline constexpr double quadrilateralStep = 0.7;

/// Step of nodes whose points keep all of their shortest wave (phi = 1: h/c), over that.
template <class Shape>
inline constexpr double nodalShare = Shape::corners == 4 ? 1 / quadrilateralStep : 1.0;

/// Axis-parallel rectangle, corner 0 lower left, counter-clockwise. All integrals in closed form.
template <bool axisymmetric>
struct Rectangle
{
    static constexpr int corners = 4;
    static constexpr bool isAxisymmetric = axisymmetric;
    static constexpr int lanes = 4; ///< cells whose integrals are computed together

    /// Of one cell, or of several that are computed together.
    template <class Real>
    struct Sides
    {
        Real r0, z0, dr, dz, invDr, invDz;
    };
    using Cell = Sides<double>;

    /// The integrals of the strain operator are made of these.
    template <class Real>
    struct Integrals
    {
        Real twoR, twoZ;         ///< 2 over the sides
        Real quarter;            ///< of the volume
        Real inverseR, xiCentre; ///< 1 over the mean of the weight r, or 0; mean of xi
        Real inertiaXi;
        Real inverseInertia;
    };

    template <class Real>
    [[gnu::always_inline]] static Integrals<Real> integrals(const Sides<Real>& c)
    {
        Real radius = zero<Real>() + 1;
        Real inverseR = zero<Real>();
        if constexpr (axisymmetric) {
            radius = c.r0 + 0.5 * c.dr;
            inverseR = 1 / radius;
        }
        const Real xiCentre = c.dr * inverseR * (1.0 / 6);
        const Real inertiaXi = 1.0 / 3 - xiCentre * xiCentre;
        return {2 * c.invDr, 2 * c.invDz,  0.25 * c.dr * c.dz * radius, inverseR, xiCentre,
                inertiaXi,   1 / inertiaXi};
    }

    /// Cells that are computed with as they were, `lanes` at once.
    class FrozenCells
    {
    public:
        void resize(std::size_t size)
        {
            for (auto& values : values_) {
                values.resize(size);
            }
        }
        void set(int f, const Cell& cell)
        {
            const auto [a, b, c, d, e, g, h] = integrals(cell);
            const std::array<double, 7> all{a, b, c, d, e, g, h};
            for (std::size_t j = 0; j < all.size(); ++j) {
                values_[j][f] = all[j];
            }
        }
        template <class Count>
        [[gnu::always_inline]] [[nodiscard]] Integrals<Lanes<lanes>> at(int f, Count count) const
        {
            using Real = Lanes<lanes>;
            return {lanesOf<Real>(values_[0], f, count), lanesOf<Real>(values_[1], f, count),
                    lanesOf<Real>(values_[2], f, count), lanesOf<Real>(values_[3], f, count),
                    lanesOf<Real>(values_[4], f, count), lanesOf<Real>(values_[5], f, count),
                    lanesOf<Real>(values_[6], f, count)};
        }

    private:
        std::array<std::vector<double>, 7> values_;
    };

    static Cell make(const double* r, const double* z)
    {
        const double dr = r[2] - r[0];
        const double dz = z[2] - z[0];
        return {r[0], z[0], dr, dz, 1 / dr, 1 / dz};
    }

    /// The rectangle that the cell is.
    static const Cell& sides(const Cell& cell) { return cell; }
    static bool isStraight(const Cell&) { return true; }

    static bool contains(const Cell& cell, double r, double z)
    {
        return r >= cell.r0 && r <= cell.r0 + cell.dr && z >= cell.z0 && z <= cell.z0 + cell.dz;
    }

    /// Local coordinates in [-1, 1] of a point, or of four.
    template <class Real>
    [[gnu::always_inline]] static std::array<Real, 2> local(const Cell& cell, const Real& r, const Real& z)
    {
        return {(r - cell.r0) * (2 * cell.invDr) - 1, (z - cell.z0) * (2 * cell.invDz) - 1};
    }

    /// @returns the local coordinates
    [[gnu::always_inline]] static std::array<double, 2> evaluate(const Cell& cell, double r, double z,
                                                                 Values<4>& values)
    {
        const double x = (r - cell.r0) * cell.invDr;
        const double y = (z - cell.z0) * cell.invDz;
        const double x0 = 1 - x;
        const double y0 = 1 - y;
        values.N[0] = x0 * y0;
        values.N[1] = x * y0;
        values.N[2] = x * y;
        values.N[3] = x0 * y;
        const double lower = y0 * cell.invDr;
        const double upper = y * cell.invDr;
        values.dr[0] = -lower;
        values.dr[1] = lower;
        values.dr[2] = upper;
        values.dr[3] = -upper;
        const double left = x0 * cell.invDz;
        const double right = x * cell.invDz;
        values.dz[0] = -left;
        values.dz[1] = -right;
        values.dz[2] = right;
        values.dz[3] = left;
        return {2 * x - 1, 2 * y - 1};
    }

    static MeanDilatation<4> meanDilatation(const Cell& c)
    {
        MeanDilatation<4> m;
        if constexpr (axisymmetric) {
            const double r1 = c.r0 + c.dr;
            const double middle = 0.5 * (c.r0 + r1);
            m.volume = c.dr * c.dz * middle;
            // integral of d(r N)/dr dr dz: the radial hat times r at the two ends
            const double inverse = 1 / m.volume;
            const double left = -0.5 * c.r0 * c.dz * inverse;
            const double right = 0.5 * r1 * c.dz * inverse;
            m.br[0] = m.br[3] = left;
            m.br[1] = m.br[2] = right;
            // integral of the radial hats times r
            const double zLeft = c.dr * (2 * c.r0 + r1) * (inverse / 6);
            const double zRight = c.dr * (c.r0 + 2 * r1) * (inverse / 6);
            m.bz[0] = -zLeft;
            m.bz[1] = -zRight;
            m.bz[2] = zRight;
            m.bz[3] = zLeft;
        } else {
            m.volume = c.dr * c.dz;
            m.br[0] = m.br[3] = -0.5 * c.invDr;
            m.br[1] = m.br[2] = 0.5 * c.invDr;
            m.bz[0] = m.bz[1] = -0.5 * c.invDz;
            m.bz[2] = m.bz[3] = 0.5 * c.invDz;
        }
        return m;
    }

    /// dz/dxi and dz/deta.
    template <class Real>
    static std::array<Real, 2> heightSlopes(const Sides<Real>& c)
    {
        return {zero<Real>(), 0.5 * c.dz};
    }

    /// Mean of N at the corners.
    static std::array<double, 4> cornerShares(const Cell& c)
    {
        const double skew = axisymmetric ? c.dr / (24 * (c.r0 + 0.5 * c.dr)) : 0; // xiCentre / 4
        return {0.25 - skew, 0.25 + skew, 0.25 + skew, 0.25 - skew};
    }

    static Moments<4> moments(const Cell& c)
    {
        Moments<4> m;
        const double rc = axisymmetric ? c.r0 + 0.5 * c.dr : 1.0; // mean weight
        m.volume = c.dr * c.dz * rc;
        // All below are means over xi, eta of (.) times the weight, divided by the mean weight.
        const double inverse = 1 / rc;
        const double xiMean = axisymmetric ? c.dr / 6 * inverse : 0.0;
        m.xiCentre = xiMean;
        m.inertiaXi = 1.0 / 3 - xiMean * xiMean;
        m.inertiaEta = 1.0 / 3;
        const double hat[2] = {axisymmetric ? (3 * c.r0 + c.dr) / 6 * inverse : 0.5,
                               axisymmetric ? (3 * c.r0 + 2 * c.dr) / 6 * inverse : 0.5};
        const double hatXi[2] = {axisymmetric ? -c.r0 / 6 * inverse : -1.0 / 6,
                                 axisymmetric ? (c.r0 + c.dr) / 6 * inverse : 1.0 / 6};
        for (int k = 0; k < 4; ++k) {
            const int right = k == 1 || k == 2;
            const double sr = right ? 1 : -1;
            const double sz = k >= 2 ? 1 : -1;
            m.n[k] = 0.5 * hat[right];
            m.gr[0][k] = 0.5 * sr * c.invDr;
            m.gr[1][k] = 0; // dN/dr does not vary with xi, and xi - xiCentre has no mean
            m.gr[2][k] = sr * sz * c.invDr / 6;
            m.gz[0][k] = sz * c.invDz * hat[right];
            m.gz[1][k] = sz * c.invDz * (hatXi[right] - xiMean * hat[right]);
            m.gz[2][k] = 0;
            if constexpr (axisymmetric) {
                m.h[0][k] = 0.25 * inverse;
                m.h[1][k] = (sr / 12 - 0.25 * xiMean) * inverse;
                m.h[2][k] = sz / 12 * inverse;
            } else {
                m.h[0][k] = m.h[1][k] = m.h[2][k] = 0;
            }
        }
        return m;
    }

    /// A velocity is a0 + a1 xi + a2 eta + a3 xi eta; the moments of that in closed form.
    template <class Real>
    [[gnu::always_inline]] static void velocityGradient(const Integrals<Real>& c, const Real* vr,
                                                        const Real* vz, VelocityGradient<4, Real>& g)
    {
        const auto [a0, a1, a2, a3] = modes(vr);
        const auto [b0, b1, b2, b3] = modes(vz);
        g[0][0] = c.twoR * a1;
        g[0][1] = c.twoZ * (b2 + c.xiCentre * b3);
        g[0][2] = c.inverseR * a0;
        g[0][3] = c.twoZ * (a2 + c.xiCentre * a3);
        g[0][4] = c.twoR * b1;
        g[1][0] = zero<Real>();
        g[1][1] = c.twoZ * b3;
        g[1][2] = c.inverseR * (a1 * (1.0 / 3) - c.xiCentre * a0) * c.inverseInertia;
        g[1][3] = c.twoZ * a3;
        g[1][4] = g[1][0];
        g[2][0] = c.twoR * a3;
        g[2][1] = g[1][0];
        g[2][2] = c.inverseR * a2;
        g[2][3] = g[1][0];
        g[2][4] = c.twoR * b3;
    }
    template <class Real>
    [[gnu::always_inline]] static void velocityGradient(const Sides<Real>& c, const Real* vr, const Real* vz,
                                                        VelocityGradient<4, Real>& g)
    {
        velocityGradient(integrals(c), vr, vz, g);
    }

    /// Mean of the divergence alone.
    template <class Real>
    [[gnu::always_inline]] static Real divergence(const Integrals<Real>& c, const Real* vr, const Real* vz)
    {
        const auto [a0, a1, a2, a3] = modes(vr);
        const auto [b0, b1, b2, b3] = modes(vz);
        return c.twoR * a1 + c.twoZ * (b2 + c.xiCentre * b3) + c.inverseR * a0;
    }

    /// Adjoint of velocityGradient.
    template <class Real>
    [[gnu::always_inline]] static void addForces(const Integrals<Real>& c, const StressField<4, Real>& s,
                                                 Real* forceR, Real* forceZ)
    {
        addModes<Real>(
            c.quarter,
            {c.inverseR * (s[0][2] - c.xiCentre * s[1][2]),
             c.twoR * s[0][0] + c.inverseR * s[1][2] * (1.0 / 3),
             c.twoZ * s[0][3] + c.inverseR * s[2][2] * (1.0 / 3),
             c.twoZ * (c.xiCentre * s[0][3] + c.inertiaXi * s[1][3]) + c.twoR * s[2][0] * (1.0 / 3)},
            forceR);
        addModes<Real>(
            c.quarter,
            {zero<Real>(), c.twoR * s[0][3], c.twoZ * s[0][1],
             c.twoZ * (c.xiCentre * s[0][1] + c.inertiaXi * s[1][1]) + c.twoR * s[2][3] * (1.0 / 3)},
            forceZ);
    }
    template <class Real>
    [[gnu::always_inline]] static void addForces(const Sides<Real>& c, const StressField<4, Real>& s,
                                                 Real* forceR, Real* forceZ)
    {
        addForces(integrals(c), s, forceR, forceZ);
    }

    /// Adjoint of divergence: what a pressure of the cell does to its corners.
    template <class Real>
    [[gnu::always_inline]] static void addPressure(const Integrals<Real>& c, const Real& pressure,
                                                   Real* forceR, Real* forceZ)
    {
        const Real push = -c.quarter * pressure;
        addModes<Real>(push, {c.inverseR, c.twoR, zero<Real>(), zero<Real>()}, forceR);
        addModes<Real>(push, {zero<Real>(), zero<Real>(), c.twoZ, c.twoZ * c.xiCentre}, forceZ);
    }

    /// Whether the corners are those of the cell.
    static bool isAt(const Cell& c, const double* r, const double* z)
    {
        return r[0] == c.r0 && z[0] == c.z0 && r[2] - r[0] == c.dr && z[2] - z[0] == c.dz;
    }

    /// Extent used for the stable step [m]: see quadrilateralStep.
    static double size(const Cell& c) { return quadrilateralStep * std::min(c.dr, c.dz); }

    /// Values at the corners as a0 + a1 xi + a2 eta + a3 xi eta.
    template <class Real>
    [[gnu::always_inline]] static std::array<Real, 4> modes(const Real* v)
    {
        const Real lower = v[0] + v[1];
        const Real upper = v[3] + v[2];
        const Real lowerSlope = v[1] - v[0];
        const Real upperSlope = v[2] - v[3];
        return {0.25 * (upper + lower), 0.25 * (upperSlope + lowerSlope), 0.25 * (upper - lower),
                0.25 * (upperSlope - lowerSlope)};
    }

    /// Sums of N times a quantity at the corners, from those of the quantity times 1, xi, eta and xi eta.
    template <class Real>
    [[gnu::always_inline]] static std::array<Real, 4> cornerSums(const std::array<Real, 4>& sums)
    {
        const Real even = 0.25 * (sums[0] + sums[3]);
        const Real odd = 0.25 * (sums[0] - sums[3]);
        const Real both = 0.25 * (sums[1] + sums[2]);
        const Real difference = 0.25 * (sums[1] - sums[2]);
        return {even - both, odd + difference, even + both, odd - difference};
    }

private:
    template <class Real>
    [[gnu::always_inline]] static void addModes(const Real& factor, const std::array<Real, 4>& a, Real* force)
    {
        force[0] -= factor * (a[0] - a[1] - a[2] + a[3]);
        force[1] -= factor * (a[0] + a[1] - a[2] - a[3]);
        force[2] -= factor * (a[0] + a[1] + a[2] + a[3]);
        force[3] -= factor * (a[0] - a[1] + a[2] - a[3]);
    }
};

/// General convex quadrilateral, corners counter-clockwise, bilinear map. Integrals by 2 x 2 Gauss points,
/// which are exact for all of them but those of N and of the hoop strain times a local coordinate.
template <bool axisymmetric>
struct Quadrilateral
{
    static constexpr int corners = 4;
    static constexpr bool isAxisymmetric = axisymmetric;

    using Straight = Rectangle<axisymmetric>;

    /// A place is centre + a xi + b eta + c xi eta. Most cells of most meshes are rectangles: with the sides
    /// of one it is treated as one.
    struct Cell
    {
        bool isStraight;
        typename Straight::Cell straight;
        double r[4], z[4];
        double centreR, centreZ, ar, az, br, bz, cr, cz;
        double size; ///< for the stable step [m]
        Moments<4> moments;
    };

    static Cell make(const double* r, const double* z)
    {
        Cell cell;
        std::copy_n(r, 4, cell.r);
        std::copy_n(z, 4, cell.z);
        cell.centreR = 0.25 * (r[0] + r[1] + r[2] + r[3]);
        cell.centreZ = 0.25 * (z[0] + z[1] + z[2] + z[3]);
        cell.ar = 0.25 * (r[1] + r[2] - r[0] - r[3]);
        cell.az = 0.25 * (z[1] + z[2] - z[0] - z[3]);
        cell.br = 0.25 * (r[2] + r[3] - r[0] - r[1]);
        cell.bz = 0.25 * (z[2] + z[3] - z[0] - z[1]);
        cell.cr = 0.25 * (r[0] + r[2] - r[1] - r[3]);
        cell.cz = 0.25 * (z[0] + z[2] - z[1] - z[3]);
        cell.size = quadrilateralStep * leastExtent(cell);
        const double tolerance = 1e-12 * (std::abs(cell.ar) + std::abs(cell.bz));
        cell.isStraight = std::max({std::abs(cell.az), std::abs(cell.br), std::abs(cell.cr),
                                    std::abs(cell.cz)}) < tolerance;
        cell.straight = Straight::make(r, z);
        cell.moments = cell.isStraight ? Straight::moments(cell.straight) : integrate(cell);
        return cell;
    }

    static constexpr int lanes = 1;
    using FrozenCells = shapes::FrozenCells<Cell>;

    static double divergence(const Cell& c, const double* vr, const double* vz)
    {
        return shapes::divergence(meanDilatation(c), vr, vz);
    }
    static void addPressure(const Cell& c, double pressure, double* forceR, double* forceZ)
    {
        shapes::addPressure(meanDilatation(c), pressure, forceR, forceZ);
    }

    /// Whether the corners are those of the cell.
    static bool isAt(const Cell& cell, const double* r, const double* z)
    {
        return std::equal(r, r + 4, cell.r) && std::equal(z, z + 4, cell.z);
    }

    /// The rectangle that the cell is where it is one.
    static const typename Straight::Cell& sides(const Cell& cell) { return cell.straight; }
    static bool isStraight(const Cell& cell) { return cell.isStraight; }

    static bool contains(const Cell& cell, double r, double z)
    {
        if (cell.isStraight) {
            return Straight::contains(cell.straight, r, z);
        }
        for (int k = 0; k < 4; ++k) {
            const int n = (k + 1) % 4;
            if ((cell.r[n] - cell.r[k]) * (z - cell.z[k]) - (cell.z[n] - cell.z[k]) * (r - cell.r[k]) < 0) {
                return false;
            }
        }
        return true;
    }

    /// Inverse of the bilinear map: with h the place less the centre, h x (a + c eta) = eta b x (a + c eta)
    /// is a quadratic equation for eta, whose root for a parallelogram (no c) is taken in the form that stays
    /// exact there.
    static std::array<double, 2> local(const Cell& c, double r, double z)
    {
        if (c.isStraight) {
            return Straight::local(c.straight, r, z);
        }
        const double hr = r - c.centreR;
        const double hz = z - c.centreZ;
        const double quadratic = c.br * c.cz - c.bz * c.cr;
        const double linear = c.ar * c.bz - c.az * c.br + hr * c.cz - hz * c.cr;
        const double constant = hr * c.az - hz * c.ar;
        const double root = std::sqrt(std::max(0.0, linear * linear + 4 * quadratic * constant));
        const double eta = -2 * constant / (linear + root);
        const double sideR = c.ar + c.cr * eta;
        const double sideZ = c.az + c.cz * eta;
        const double xi =
            ((hr - c.br * eta) * sideR + (hz - c.bz * eta) * sideZ) / (sideR * sideR + sideZ * sideZ);
        return {xi, eta};
    }

    /// @returns the local coordinates
    [[gnu::always_inline]] static std::array<double, 2> evaluate(const Cell& c, double r, double z,
                                                                 Values<4>& v)
    {
        if (c.isStraight) {
            return Straight::evaluate(c.straight, r, z, v);
        }
        const auto [xi, eta] = local(c, r, z);
        const double rx = c.ar + c.cr * eta;
        const double zx = c.az + c.cz * eta;
        const double re = c.br + c.cr * xi;
        const double ze = c.bz + c.cz * xi;
        const double inverse = 1 / (rx * ze - re * zx);
        for (int k = 0; k < 4; ++k) {
            const double x = 1 + signXi[k] * xi;
            const double y = 1 + signEta[k] * eta;
            const double dx = 0.25 * signXi[k] * y * inverse;
            const double de = 0.25 * signEta[k] * x * inverse;
            v.N[k] = 0.25 * x * y;
            v.dr[k] = dx * ze - de * zx;
            v.dz[k] = de * rx - dx * re;
        }
        return {xi, eta};
    }

    static MeanDilatation<4> meanDilatation(const Cell& cell)
    {
        const Moments<4>& moments = cell.moments;
        MeanDilatation<4> m;
        m.volume = moments.volume;
        for (int k = 0; k < 4; ++k) {
            m.br[k] = moments.gr[0][k] + moments.h[0][k];
            m.bz[k] = moments.gz[0][k];
        }
        return m;
    }

    static std::array<double, 2> heightSlopes(const Cell& c) { return {c.az, c.bz}; }

    static const Moments<4>& moments(const Cell& cell) { return cell.moments; }
    static std::array<double, 4> cornerShares(const Cell& cell) { return std::to_array(cell.moments.n); }

    static void velocityGradient(const Cell& c, const double* vr, const double* vz, VelocityGradient<4>& g)
    {
        if (c.isStraight) {
            Straight::velocityGradient(c.straight, vr, vz, g);
        } else {
            shapes::velocityGradient(c.moments, vr, vz, g);
        }
    }
    static void addForces(const Cell& c, const StressField<4>& s, double* forceR, double* forceZ)
    {
        if (c.isStraight) {
            Straight::addForces(c.straight, s, forceR, forceZ);
        } else {
            shapes::addForces(c.moments, s, forceR, forceZ);
        }
    }

    static double size(const Cell& c) { return c.size; }

private:
    static constexpr double signXi[4] = {-1, 1, 1, -1};
    static constexpr double signEta[4] = {-1, -1, 1, 1};

    /// Area over the longer of the two lines between the middles of opposite sides.
    static double leastExtent(const Cell& c)
    {
        const double longest = std::max(c.ar * c.ar + c.az * c.az, c.br * c.br + c.bz * c.bz);
        return 2 * (c.ar * c.bz - c.az * c.br) / std::sqrt(longest);
    }

    static Moments<4> integrate(const Cell& c)
    {
        Moments<4> m{};
        double weights = 0, xiSum = 0, etaSum = 0, xiSquares = 0, etaSquares = 0;
        constexpr double g = 0.57735026918962576451;
        for (const double eta : {-g, g}) {
            for (const double xi : {-g, g}) {
                const double rx = c.ar + c.cr * eta;
                const double zx = c.az + c.cz * eta;
                const double re = c.br + c.cr * xi;
                const double ze = c.bz + c.cz * xi;
                const double determinant = rx * ze - re * zx;
                const double radius =
                    axisymmetric ? c.centreR + c.ar * xi + c.br * eta + c.cr * xi * eta : 1.0;
                const double weight = determinant * radius;
                weights += weight;
                xiSum += weight * xi;
                etaSum += weight * eta;
                xiSquares += weight * xi * xi;
                etaSquares += weight * eta * eta;
                const double factor[3] = {1, xi, eta};
                for (int k = 0; k < 4; ++k) {
                    const double x = 1 + signXi[k] * xi;
                    const double y = 1 + signEta[k] * eta;
                    const double dx = 0.25 * signXi[k] * y * radius;
                    const double de = 0.25 * signEta[k] * x * radius;
                    const double shape = 0.25 * x * y;
                    m.n[k] += weight * shape;
                    for (int i = 0; i < 3; ++i) {
                        m.gr[i][k] += factor[i] * (dx * ze - de * zx);
                        m.gz[i][k] += factor[i] * (de * rx - dx * re);
                        m.h[i][k] += axisymmetric ? factor[i] * determinant * shape : 0;
                    }
                }
            }
        }
        const double inverse = 1 / weights;
        m.volume = weights;
        m.xiCentre = xiSum * inverse;
        const double etaCentre = etaSum * inverse;
        m.inertiaXi = xiSquares * inverse - m.xiCentre * m.xiCentre;
        m.inertiaEta = etaSquares * inverse - etaCentre * etaCentre;
        for (int k = 0; k < 4; ++k) {
            m.n[k] *= inverse;
            for (auto* moment : {&m.gr, &m.gz, &m.h}) {
                (*moment)[0][k] *= inverse;
                (*moment)[1][k] = (*moment)[1][k] * inverse - m.xiCentre * (*moment)[0][k];
                (*moment)[2][k] = (*moment)[2][k] * inverse - etaCentre * (*moment)[0][k];
            }
        }
        return m;
    }
};

/// Triangle, corners counter-clockwise: constant gradients, constant stress when filled.
template <bool axisymmetric>
struct Triangle
{
    static constexpr int corners = 3;
    static constexpr bool isAxisymmetric = axisymmetric;

    struct Cell
    {
        double r[3], z[3];
        double dr[3], dz[3]; ///< gradients
        double area;
    };

    static Cell make(const double* r, const double* z)
    {
        Cell c;
        std::copy_n(r, 3, c.r);
        std::copy_n(z, 3, c.z);
        c.area = 0.5 * ((r[1] - r[0]) * (z[2] - z[0]) - (r[2] - r[0]) * (z[1] - z[0]));
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3;
            const int b = (k + 2) % 3;
            c.dr[k] = (z[a] - z[b]) / (2 * c.area);
            c.dz[k] = (r[b] - r[a]) / (2 * c.area);
        }
        return c;
    }

    static constexpr int lanes = 1;
    using FrozenCells = shapes::FrozenCells<Cell>;

    static double divergence(const Cell& c, const double* vr, const double* vz)
    {
        return shapes::divergence(meanDilatation(c), vr, vz);
    }
    static void addPressure(const Cell& c, double pressure, double* forceR, double* forceZ)
    {
        shapes::addPressure(meanDilatation(c), pressure, forceR, forceZ);
    }

    static bool contains(const Cell& c, double r, double z)
    {
        for (int k = 0; k < 3; ++k) {
            if (1 + c.dr[k] * (r - c.r[k]) + c.dz[k] * (z - c.z[k]) < 0) {
                return false;
            }
        }
        return true;
    }

    static std::array<double, 2> local(const Cell&, double, double) { return {0, 0}; }

    static std::array<double, 2> evaluate(const Cell& c, double r, double z, Values<3>& v)
    {
        for (int k = 0; k < 3; ++k) {
            v.N[k] = 1 + c.dr[k] * (r - c.r[k]) + c.dz[k] * (z - c.z[k]);
            v.dr[k] = c.dr[k];
            v.dz[k] = c.dz[k];
        }
        return {0, 0};
    }

    static MeanDilatation<3> meanDilatation(const Cell& c)
    {
        MeanDilatation<3> m;
        const double centroid = (c.r[0] + c.r[1] + c.r[2]) / 3;
        m.volume = c.area * (axisymmetric ? centroid : 1);
        for (int k = 0; k < 3; ++k) {
            m.br[k] = c.dr[k] + (axisymmetric ? 1 / (3 * centroid) : 0); // integral of N = A/3
            m.bz[k] = c.dz[k];
        }
        return m;
    }

    static std::array<double, 3> cornerShares(const Cell& c) { return std::to_array(moments(c).n); }

    static Moments<3> moments(const Cell& c)
    {
        Moments<3> m;
        const double centroid = (c.r[0] + c.r[1] + c.r[2]) / 3;
        m.volume = c.area * (axisymmetric ? centroid : 1);
        for (int k = 0; k < 3; ++k) {
            m.n[k] = axisymmetric ? (3 * centroid + c.r[k]) / (12 * centroid) : 1.0 / 3;
            m.gr[0][k] = c.dr[k];
            m.gz[0][k] = c.dz[k];
            m.h[0][k] = axisymmetric ? 1 / (3 * centroid) : 0; // integral of N is A/3
        }
        return m;
    }

    static void velocityGradient(const Cell& c, const double* vr, const double* vz, VelocityGradient<3>& g)
    {
        shapes::velocityGradient(moments(c), vr, vz, g);
    }
    static void addForces(const Cell& c, const StressField<3>& s, double* forceR, double* forceZ)
    {
        shapes::addForces(moments(c), s, forceR, forceZ);
    }

    static double size(const Cell& c)
    {
        double longest = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3;
            longest = std::max(longest, std::hypot(c.r[a] - c.r[k], c.z[a] - c.z[k]));
        }
        return 2 * c.area / longest;
    }
};

} // namespace caisson::shapes
