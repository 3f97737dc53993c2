#pragma once

#include "mesh/BackgroundMesh.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Shapes of background cells as the step kernels see them: shape functions at a place, the mean-dilatation
/// operator, and the forces of a stress that varies linearly over a filled cell. The weight of the volume
/// integral is r (axisymmetric, per radian) or 1 (plane strain).
namespace caisson::shapes {

/// Shape functions of a cell and their gradients at one place.
template <int corners>
struct Values
{
    double N[corners];
    double dr[corners]; ///< dN/dr
    double dz[corners]; ///< dN/dz
};

/// What the kernels need of every cell, whatever its shape.
template <int corners>
struct MeanDilatation
{
    double volume;      ///< integral of the weight
    double br[corners]; ///< mean of dN/dr + N/r (axisymmetric) or dN/dr
    double bz[corners]; ///< mean of dN/dz
};

/// Stress over a filled cell: sigma(xi, eta) = mean + xi slopeXi + eta slopeEta, xi and eta the cell's local
/// coordinates in [-1, 1]; components rr, zz, tt, rz.
struct LinearStress
{
    double mean[4];
    double slopeXi[4];
    double slopeEta[4];
};

/// Axis-parallel rectangle, corner 0 lower left, counter-clockwise. All integrals in closed form.
template <bool axisymmetric>
struct Rectangle
{
    static constexpr int corners = 4;
    static constexpr bool linearStress = true;

    struct Cell
    {
        double r0, z0, dr, dz, invDr, invDz;
    };

    static Cell make(const double* r, const double* z)
    {
        const double dr = r[2] - r[0];
        const double dz = z[2] - z[0];
        return {r[0], z[0], dr, dz, 1 / dr, 1 / dz};
    }

    static bool contains(const Cell& cell, double r, double z)
    {
        return r >= cell.r0 && r <= cell.r0 + cell.dr && z >= cell.z0 && z <= cell.z0 + cell.dz;
    }

    /// Local coordinates in [-1, 1].
    static std::array<double, 2> local(const Cell& cell, double r, double z)
    {
        return {2 * (r - cell.r0) * cell.invDr - 1, 2 * (z - cell.z0) * cell.invDz - 1};
    }

    static void evaluate(const Cell& cell, double r, double z, Values<4>& values)
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
    }

    static MeanDilatation<4> meanDilatation(const Cell& c)
    {
        MeanDilatation<4> m;
        if constexpr (axisymmetric) {
            const double r1 = c.r0 + c.dr;
            const double middle = 0.5 * (c.r0 + r1);
            m.volume = c.dr * c.dz * middle;
            // integral of d(r N)/dr dr dz: the radial hat times r at the two ends
            const double left = -0.5 * c.r0 * c.dz / m.volume;
            const double right = 0.5 * r1 * c.dz / m.volume;
            m.br[0] = m.br[3] = left;
            m.br[1] = m.br[2] = right;
            // integral of the radial hats times r
            const double zLeft = c.dr * (2 * c.r0 + r1) / 6 / m.volume;
            const double zRight = c.dr * (c.r0 + 2 * r1) / 6 / m.volume;
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

    /// Volume average of (mean, slopes): the weight r shifts it.
    static double average(const Cell& c, double mean, double slopeXi, double /*slopeEta*/)
    {
        if constexpr (axisymmetric) {
            return mean + slopeXi * c.dr / (6 * (c.r0 + 0.5 * c.dr));
        } else {
            return mean;
        }
    }

    /// force[k] = integral of B_k^T sigma over the cell.
    static void force(const Cell& c, const LinearStress& s, double (&fr)[4], double (&fz)[4])
    {
        const double area = c.dr * c.dz;
        const double rc = axisymmetric ? c.r0 + 0.5 * c.dr : 1.0;
        const double spread = axisymmetric ? c.dr / 6 : 0.0; // mean of r xi
        // means over the cell of the weight times the radial hats, and the same times xi
        const double hatLeft = axisymmetric ? (3 * c.r0 + c.dr) / 6 : 0.5;
        const double hatRight = axisymmetric ? (3 * c.r0 + 2 * c.dr) / 6 : 0.5;
        const double hatXiLeft = axisymmetric ? -c.r0 / 6 : -1.0 / 6;
        const double hatXiRight = axisymmetric ? (c.r0 + c.dr) / 6 : 1.0 / 6;
        for (int k = 0; k < 4; ++k) {
            const bool right = k == 1 || k == 2;
            const double sr = right ? 1 : -1;
            const double sz = k >= 2 ? 1 : -1;
            const double hat = right ? hatRight : hatLeft;
            const double hatXi = right ? hatXiRight : hatXiLeft;
            const auto byGradientR = [&](int i) { // mean of sigma_i dN/dr w
                return sr * c.invDr *
                       (0.5 * (s.mean[i] * rc + s.slopeXi[i] * spread) + sz * s.slopeEta[i] * rc / 6);
            };
            const auto byGradientZ = [&](int i) { // mean of sigma_i dN/dz w
                return sz * c.invDz * (s.mean[i] * hat + s.slopeXi[i] * hatXi);
            };
            fr[k] = area * (byGradientR(0) + byGradientZ(3));
            fz[k] = area * (byGradientZ(1) + byGradientR(3));
            if constexpr (axisymmetric) {
                fr[k] += area * (0.25 * s.mean[2] + (sr * s.slopeXi[2] + sz * s.slopeEta[2]) / 12);
            }
        }
    }

    /// Extent used for the stable step [m].
    static double size(const Cell& c) { return 1 / std::sqrt(c.invDr * c.invDr + c.invDz * c.invDz); }
};

/// General convex quadrilateral, corners counter-clockwise, bilinear map. Integrals by 2 x 2 Gauss points.
template <bool axisymmetric>
struct Quadrilateral
{
    static constexpr int corners = 4;
    static constexpr bool linearStress = true;

    struct Cell
    {
        double r[4], z[4];
    };

    static Cell make(const double* r, const double* z)
    {
        Cell cell;
        std::copy_n(r, 4, cell.r);
        std::copy_n(z, 4, cell.z);
        return cell;
    }

    static bool contains(const Cell& cell, double r, double z)
    {
        for (int k = 0; k < 4; ++k) {
            const int n = (k + 1) % 4;
            if ((cell.r[n] - cell.r[k]) * (z - cell.z[k]) - (cell.z[n] - cell.z[k]) * (r - cell.r[k]) < 0) {
                return false;
            }
        }
        return true;
    }

    /// Inverse of the bilinear map by Newton steps; exact after one for parallelograms.
    static std::array<double, 2> local(const Cell& c, double r, double z)
    {
        double xi = 0;
        double eta = 0;
        for (int i = 0; i < 8; ++i) {
            const double rx = (1 - eta) * (c.r[1] - c.r[0]) + (1 + eta) * (c.r[2] - c.r[3]);
            const double zx = (1 - eta) * (c.z[1] - c.z[0]) + (1 + eta) * (c.z[2] - c.z[3]);
            const double re = (1 - xi) * (c.r[3] - c.r[0]) + (1 + xi) * (c.r[2] - c.r[1]);
            const double ze = (1 - xi) * (c.z[3] - c.z[0]) + (1 + xi) * (c.z[2] - c.z[1]);
            const double gapR = 4 * r - ((1 - xi) * ((1 - eta) * c.r[0] + (1 + eta) * c.r[3]) +
                                         (1 + xi) * ((1 - eta) * c.r[1] + (1 + eta) * c.r[2]));
            const double gapZ = 4 * z - ((1 - xi) * ((1 - eta) * c.z[0] + (1 + eta) * c.z[3]) +
                                         (1 + xi) * ((1 - eta) * c.z[1] + (1 + eta) * c.z[2]));
            const double determinant = rx * ze - re * zx;
            const double stepXi = (gapR * ze - re * gapZ) / determinant;
            const double stepEta = (rx * gapZ - gapR * zx) / determinant;
            xi += stepXi;
            eta += stepEta;
            if (std::abs(stepXi) + std::abs(stepEta) < 1e-14) {
                break;
            }
        }
        return {xi, eta};
    }

    static double evaluateLocal(const Cell& c, double xi, double eta, Values<4>& v)
    {
        static constexpr double sx[4] = {-1, 1, 1, -1};
        static constexpr double sy[4] = {-1, -1, 1, 1};
        double rx = 0, zx = 0, re = 0, ze = 0;
        double dx[4], de[4];
        for (int k = 0; k < 4; ++k) {
            v.N[k] = 0.25 * (1 + sx[k] * xi) * (1 + sy[k] * eta);
            dx[k] = 0.25 * sx[k] * (1 + sy[k] * eta);
            de[k] = 0.25 * sy[k] * (1 + sx[k] * xi);
            rx += dx[k] * c.r[k];
            zx += dx[k] * c.z[k];
            re += de[k] * c.r[k];
            ze += de[k] * c.z[k];
        }
        const double determinant = rx * ze - re * zx;
        for (int k = 0; k < 4; ++k) {
            v.dr[k] = (dx[k] * ze - de[k] * zx) / determinant;
            v.dz[k] = (de[k] * rx - dx[k] * re) / determinant;
        }
        return determinant;
    }

    static void evaluate(const Cell& cell, double r, double z, Values<4>& values)
    {
        const auto [xi, eta] = local(cell, r, z);
        evaluateLocal(cell, xi, eta, values);
    }

    /// Calls visit(xi, eta, weight volume, shape values, r) at the 2 x 2 Gauss points.
    template <class Visit>
    static void atGaussPoints(const Cell& c, Visit visit)
    {
        constexpr double g = 0.57735026918962576451;
        for (const double eta : {-g, g}) {
            for (const double xi : {-g, g}) {
                Values<4> v;
                const double determinant = evaluateLocal(c, xi, eta, v);
                double r = 0;
                for (int k = 0; k < 4; ++k) {
                    r += v.N[k] * c.r[k];
                }
                visit(xi, eta, axisymmetric ? determinant * r : determinant, v, r);
            }
        }
    }

    static MeanDilatation<4> meanDilatation(const Cell& c)
    {
        MeanDilatation<4> m{};
        atGaussPoints(c, [&m](double, double, double weight, const Values<4>& v, double r) {
            m.volume += weight;
            for (int k = 0; k < 4; ++k) {
                m.br[k] += weight * (v.dr[k] + (axisymmetric ? v.N[k] / r : 0));
                m.bz[k] += weight * v.dz[k];
            }
        });
        for (int k = 0; k < 4; ++k) {
            m.br[k] /= m.volume;
            m.bz[k] /= m.volume;
        }
        return m;
    }

    static double average(const Cell& c, double mean, double slopeXi, double slopeEta)
    {
        double sum = 0;
        double volume = 0;
        atGaussPoints(c, [&](double xi, double eta, double weight, const Values<4>&, double) {
            sum += weight * (mean + xi * slopeXi + eta * slopeEta);
            volume += weight;
        });
        return sum / volume;
    }

    static void force(const Cell& c, const LinearStress& s, double (&fr)[4], double (&fz)[4])
    {
        std::fill_n(fr, 4, 0.0);
        std::fill_n(fz, 4, 0.0);
        atGaussPoints(c, [&](double xi, double eta, double weight, const Values<4>& v, double r) {
            double sigma[4];
            for (int i = 0; i < 4; ++i) {
                sigma[i] = weight * (s.mean[i] + xi * s.slopeXi[i] + eta * s.slopeEta[i]);
            }
            for (int k = 0; k < 4; ++k) {
                fr[k] += sigma[0] * v.dr[k] + sigma[3] * v.dz[k] + (axisymmetric ? sigma[2] * v.N[k] / r : 0);
                fz[k] += sigma[1] * v.dz[k] + sigma[3] * v.dr[k];
            }
        });
    }

    static double size(const Cell& c)
    {
        const double area = 0.5 * ((c.r[2] - c.r[0]) * (c.z[3] - c.z[1]) - (c.r[3] - c.r[1]) * (c.z[2] - c.z[0]));
        const auto middle = [&](int a, int b, int d, int e) {
            return std::hypot(c.r[a] + c.r[b] - c.r[d] - c.r[e], c.z[a] + c.z[b] - c.z[d] - c.z[e]) / 2;
        };
        const double h1 = area / middle(2, 3, 0, 1);
        const double h2 = area / middle(1, 2, 0, 3);
        return 1 / std::sqrt(1 / (h1 * h1) + 1 / (h2 * h2));
    }
};

/// Triangle, corners counter-clockwise: constant gradients, constant stress when filled.
template <bool axisymmetric>
struct Triangle
{
    static constexpr int corners = 3;
    static constexpr bool linearStress = false;

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

    static void evaluate(const Cell& c, double r, double z, Values<3>& v)
    {
        for (int k = 0; k < 3; ++k) {
            v.N[k] = 1 + c.dr[k] * (r - c.r[k]) + c.dz[k] * (z - c.z[k]);
            v.dr[k] = c.dr[k];
            v.dz[k] = c.dz[k];
        }
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

    static double average(const Cell&, double mean, double, double) { return mean; }

    static void force(const Cell& c, const LinearStress& s, double (&fr)[3], double (&fz)[3])
    {
        const double centroid = (c.r[0] + c.r[1] + c.r[2]) / 3;
        const double volume = c.area * (axisymmetric ? centroid : 1);
        for (int k = 0; k < 3; ++k) {
            fr[k] = volume * (s.mean[0] * c.dr[k] + s.mean[3] * c.dz[k]);
            fz[k] = volume * (s.mean[1] * c.dz[k] + s.mean[3] * c.dr[k]);
            if constexpr (axisymmetric) {
                fr[k] += s.mean[2] * c.area / 3;
            }
        }
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
