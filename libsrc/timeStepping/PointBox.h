#pragma once

#include "timeStepping/CellShapes.h"

namespace caisson {

/// The rectangle that a point stands for with smooth shape functions (BoxKernels.h), and 1 over its weight:
/// the integral of r (axisymmetric) or 1 over it.
struct PointBox
{
    double lowR, highR, lowZ, highZ, inverseWeight;
};

/// What the cell of a point has around it: widths of the cells beside, 0 where there is none [m], and whether
/// there are cells at its corners (below left, below right, above left, above right).
struct CellSurroundings
{
    double left = 0, right = 0, below = 0, above = 0;
    std::array<bool, 4> corner{};
};

/// Means of N, of its gradients and of N/r over the part of a box that lies in a cell, times the part's share
/// of the box.
struct BoxPart
{
    std::array<double, 4> N, dr, dz, hoop;
};

namespace pointBox {

/// Half the width of the box along r that ends at `face` and has its centre of weight at r.
template <bool axisymmetric>
double reachTo(double r, double face)
{
    if constexpr (!axisymmetric) {
        return std::abs(r - face);
    }
    // Middle q of the box: q + (q - face)^2/(3 q) = r
    const double b = 2.0 / 3 * face + r;
    const double q = 0.375 * (b + std::sqrt(std::max(0.0, b * b - 16.0 / 9 * face * face)));
    return std::abs(q - face);
}

/// Box of a point at (r, z), its centre of weight, in a cell.
/// @param width  of the box over that of the cell; in between, widths vary linearly from side to side, each
///               side with the mean of its two cells: nothing jumps where a point crosses a line
template <bool axisymmetric>
PointBox around(double r, double z, const typename shapes::Rectangle<axisymmetric>::Cell& cell,
                const CellSurroundings& beside, double width)
{
    const auto half = [&](double x, double own, double before, double after) {
        const double low = before > 0 ? 0.5 * (own + before) : own;
        const double high = after > 0 ? 0.5 * (own + after) : own;
        return 0.5 * width * ((1 - x) * low + x * high);
    };
    double a = half((r - cell.r0) * cell.invDr, cell.dr, beside.left, beside.right);
    double b = half((z - cell.z0) * cell.invDz, cell.dz, beside.below, beside.above);
    a = std::min({a, reachTo<axisymmetric>(r, cell.r0 - beside.left),
                  reachTo<axisymmetric>(r, cell.r0 + cell.dr + beside.right)});
    b = std::min({b, z - cell.z0 + beside.below, cell.z0 + cell.dz + beside.above - z});
    for (const int right : {0, 1}) { // no corner of the box where no cell is
        const bool reaches = right == 0 ? r - 1.5 * a < cell.r0 : r + a > cell.r0 + cell.dr;
        if (reaches && !beside.corner[right]) {
            b = std::min(b, z - cell.z0);
        }
        if (reaches && !beside.corner[2 + right]) {
            b = std::min(b, cell.z0 + cell.dz - z);
        }
    }
    a = std::max(a, 1e-9 * cell.dr); // a point on a boundary
    b = std::max(b, 1e-9 * cell.dz);
    const double middle = axisymmetric ? 0.5 * (r + std::sqrt(std::max(0.0, r * r - 4.0 / 3 * a * a))) : r;
    return {middle - a, middle + a, z - b, z + b, 1 / (4 * a * b * (axisymmetric ? middle : 1.0))};
}

/// @returns whether the box has a part in the cell
template <bool axisymmetric>
bool part(const PointBox& box, const typename shapes::Rectangle<axisymmetric>::Cell& cell, BoxPart& part)
{
    using Shape = shapes::Rectangle<axisymmetric>;
    const double lowR = std::max(box.lowR, cell.r0);
    const double highR = std::min(box.highR, cell.r0 + cell.dr);
    const double lowZ = std::max(box.lowZ, cell.z0);
    const double highZ = std::min(box.highZ, cell.z0 + cell.dz);
    if (!(highR > lowR && highZ > lowZ)) {
        return false;
    }
    const double r = 0.5 * (lowR + highR);
    const double z = 0.5 * (lowZ + highZ);
    const double area = (highR - lowR) * (highZ - lowZ) * box.inverseWeight;
    const double share = axisymmetric ? area * r : area;
    shapes::Values<4> values;
    Shape::evaluate(cell, r, z, values);
    for (int k = 0; k < 4; ++k) {
        part.hoop[k] = axisymmetric ? area * values.N[k] : 0;
    }
    if constexpr (axisymmetric) {
        Shape::evaluate(cell, r + (highR - lowR) * (highR - lowR) / (12 * r), z, values);
    }
    for (int k = 0; k < 4; ++k) {
        part.N[k] = share * values.N[k];
        part.dr[k] = share * values.dr[k];
        part.dz[k] = share * values.dz[k];
    }
    return true;
}

} // namespace pointBox

} // namespace caisson
