#pragma once

#include "timeStepping/FemKernels.h"

// Smooth shape functions: a point has a box, over which the shape functions of the mesh are averaged,
//
//     S_i = 1/W int_box N_i r dA,   W = int_box r dA,       (plane strain: without r)
//
// and their gradients likewise. With the box that the point stands for these are the generalised
// interpolation material points (GIMP, uniform: boxes do not deform) [Bardenhagen & Kober 2004; Steffen,
// Kirby & Berzins 2008], without the jumps of force when points cross mesh lines. With a box as wide as a
// cell they are the quadratic B-splines of a uniform mesh: a hat, which is two boxes convolved, with a third
// [de Boor 1978]; on graded meshes they stay as smooth, sum up to one and reproduce linear fields.
//
// N is bilinear in each cell. So its mean over the part of a box that lies in one cell is its value at the
// part's centre of weight, and the mean of N/r that at the middle: at most four values per point, exact. The
// point is the centre of weight of its box, so that sum S_i x_i = x_p. Boxes end at the boundary of the mesh
// and where the next cell is empty: they become as much narrower on the other side.
//
// Cells that such boxes reach into sum over the points around them, each its own: the result does not depend
// on the number of threads. They are integrated at the points, without treatment of locking.
namespace caisson {

/// Cells of smooth points, and those beside them.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::findBoxCells(const BackgroundMesh& mesh)
{
    const SolutionControls& controls = scene_.controls;
    if (!hasBoxes || controls.boxWidth == 0) {
        return;
    }
    const int cells = mesh.cells();
    boxCell_.assign(cells, controls.boxZone.empty() ? BoxCell::smooth : BoxCell::none);
    if (!controls.boxZone.empty()) {
        for (const int c : mesh.cellZones.at(controls.boxZone)) {
            boxCell_[c] = BoxCell::smooth;
        }
    }
    const auto beside = [&](int c, int side) { // bottom, right, top, left
        return c < 0 ? -1 : mesh.neighbour[c * corners + (kernels::firstCorner(mesh, c) + side) % corners];
    };
    const auto either = [](int one, int other) { return one >= 0 ? one : other; };
    around_.resize(cells);
    for (int c = 0; c < cells; ++c) {
        const int below = beside(c, 0), right = beside(c, 1), above = beside(c, 2), left = beside(c, 3);
        around_[c] = {either(beside(below, 3), beside(left, 0)),
                      below,
                      either(beside(below, 1), beside(right, 0)),
                      left,
                      c,
                      right,
                      either(beside(above, 3), beside(left, 2)),
                      above,
                      either(beside(above, 1), beside(right, 2))};
    }
    std::size_t slanted = 0;
    for (int c = 0; c < cells; ++c) {
        for (const int other : around_[c]) {
            if (boxCell_[c] == BoxCell::none && other >= 0 && boxCell_[other] == BoxCell::smooth) {
                boxCell_[c] = BoxCell::beside;
            }
        }
        if constexpr (hasBoxes) {
            slanted += boxCell_[c] != BoxCell::none && !Shape::isStraight(cells_[c]) ? 1 : 0;
        }
    }
    if (slanted > 0) {
        throw InputError(
            "system/mpmSolution",
            {{{},
              text("boxes of points need rectangles: %zu cells of them or beside them are none", slanted),
              "shapeFunctions linear;  or a boxZone of rectangles, among rectangles"}});
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::makeBoxes(const State& state)
    requires hasBoxes
{
    forCells([&](int c) {
        if (boxCell_[c] != BoxCell::smooth) {
            return;
        }
        const auto& around = around_[c];
        const auto there = [&](int j) { return around[j] >= 0 && occupied_[around[j]] != 0; };
        const auto sides = [&](int j) { return Shape::sides(cells_[around[j]]); };
        CellSurroundings beside;
        beside.left = there(3) ? sides(3).dr : 0;
        beside.right = there(5) ? sides(5).dr : 0;
        beside.below = there(1) ? sides(1).dz : 0;
        beside.above = there(7) ? sides(7).dz : 0;
        beside.corner = {there(0), there(2), there(6), there(8)};
        for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
            boxes_[*i] =
                pointBox::around<axisymmetric>(state.points.r[*i], state.points.z[*i],
                                               Shape::sides(cells_[c]), beside, scene_.controls.boxWidth);
        }
    });
}

/// A point without a box.
template <class Shape, int phases>
BoxPart ExplicitStep<Shape, phases>::wholePoint(const State& state, int p, int c) const
    requires hasBoxes
{
    Values values;
    Shape::evaluate(cells_[c], state.points.r[p], state.points.z[p], values);
    BoxPart part;
    const double inverseR = axisymmetric ? 1 / std::max(state.points.r[p], kernels::smallestRadius) : 0;
    for (int k = 0; k < corners; ++k) {
        part.N[k] = values.N[k];
        part.dr[k] = values.dr[k];
        part.dz[k] = values.dz[k];
        part.hoop[k] = inverseR * values.N[k];
    }
    return part;
}

/// work(point, part) for all that reaches into cell c.
template <class Shape, int phases>
template <class Work>
void ExplicitStep<Shape, phases>::forPartsIn(const State& state, int c, const Work& work) const
    requires hasBoxes
{
    BoxPart part;
    for (const int other : around_[c]) {
        if (other < 0) {
            continue;
        }
        const bool smooth = boxCell_[other] == BoxCell::smooth;
        for (const int* i = pointCells_.begin(other); (smooth || other == c) && i != pointCells_.end(other);
             ++i) {
            if (!smooth) {
                work(*i, wholePoint(state, *i, c));
            } else if (pointBox::part<axisymmetric>(boxes_[*i], Shape::sides(cells_[c]), part)) {
                work(*i, part);
            }
        }
    }
}

/// work(cell, part) for all cells that a point of cell c reaches into.
template <class Shape, int phases>
template <class Work>
void ExplicitStep<Shape, phases>::forPartsOf(const State& state, int p, int c, const Work& work) const
    requires hasBoxes
{
    if (boxCell_[c] != BoxCell::smooth) {
        work(c, wholePoint(state, p, c));
        return;
    }
    BoxPart part;
    for (const int other : around_[c]) {
        if (other >= 0 && occupied_[other] != 0 &&
            pointBox::part<axisymmetric>(boxes_[p], Shape::sides(cells_[other]), part)) {
            work(other, part);
        }
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::mapBoxCellToNodes(const State& state, int c)
    requires hasBoxes
{
    const MaterialPoints& points = state.points;
    const bool loaded = points.loaded();
    const bool given = scene_.bodyForce.given();
    Corner sum[corners] = {};
    forPartsIn(state, c, [&](int p, const BoxPart& part) {
        const double m = points.mass[p];
        const double weight = m * gravityShare_[points.material[p]];
        const double v = points.volume[p];
        const double viscous = viscousStress(state, points.cell[p], points.material[p]);
        double stress[4];
        for (int j = 0; j < 4; ++j) {
            stress[j] = v * (points.stress[j][p] + (j < 3 ? viscous : 0));
        }
        double forceR = weight * scene_.gravity[0];
        double forceZ = weight * scene_.gravity[1];
        if (loaded && points.load[p] >= 0) {
            const std::array<double, 2> load = pointLoad(points, p);
            forceR += load[0];
            forceZ += load[1];
        }
        if (given) {
            forceR += m * bodyForceR_[p];
            forceZ += m * bodyForceZ_[p];
        }
        for (int k = 0; k < corners; ++k) {
            sum[k].mass += part.N[k] * m;
            sum[k].momentumR += part.N[k] * m * points.vr[p];
            sum[k].momentumZ += part.N[k] * m * points.vz[p];
            sum[k].forceR += part.N[k] * forceR - stress[0] * part.dr[k] - stress[3] * part.dz[k] -
                             stress[2] * part.hoop[k];
            sum[k].forceZ += part.N[k] * forceZ - stress[1] * part.dz[k] - stress[3] * part.dr[k];
        }
    });
    const double inertia = inertiaScale_[c];
    fullness_[c] = 1;
    for (int k = 0; k < corners; ++k) {
        cornerSums_[c * corners + k] = {inertia * sum[k].mass,
                                        inertia * sum[k].momentumR,
                                        inertia * sum[k].momentumZ,
                                        inertia * sum[k].mass,
                                        sum[k].forceR,
                                        sum[k].forceZ};
    }
}

template <class Shape, int phases>
void ExplicitStep<Shape, phases>::addRemappedBoxMomentum(const State& state, int c)
    requires hasBoxes
{
    const MaterialPoints& points = state.points;
    Corner* const out = &cornerSums_[c * corners];
    for (int k = 0; k < corners; ++k) {
        out[k].momentumR = out[k].momentumZ = 0;
    }
    forPartsIn(state, c, [&](int p, const BoxPart& part) {
        const double m = inertiaScale_[c] * points.mass[p];
        for (int k = 0; k < corners; ++k) {
            out[k].momentumR += part.N[k] * m * points.vr[p];
            out[k].momentumZ += part.N[k] * m * points.vz[p];
        }
    });
}

/// Velocities of the points of a cell, from nodes that all have their new ones.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::moveBoxVelocities(State& state, double dt, int c)
    requires hasBoxes
{
    MaterialPoints& points = state.points;
    const double flip = scene_.controls.flipOf(dt);
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        double changeR = 0, changeZ = 0, newR = 0, newZ = 0;
        forPartsOf(state, p, c, [&](int other, const BoxPart& part) {
            for (int k = 0; k < corners; ++k) {
                const Node& node = nodes_[cellNodes_[other * corners + k]];
                changeR += part.N[k] * node.dvr;
                changeZ += part.N[k] * node.dvz;
                newR += part.N[k] * node.vr;
                newZ += part.N[k] * node.vz;
            }
        });
        points.vr[p] = flip * (points.vr[p] + changeR) + (1 - flip) * newR;
        points.vz[p] = flip * (points.vz[p] + changeZ) + (1 - flip) * newZ;
    }
}

/// Strains and places.
template <class Shape, int phases>
void ExplicitStep<Shape, phases>::strainBoxPoints(State& state, double dt, int c)
    requires hasBoxes
{
    MaterialPoints& points = state.points;
    double rateSum = 0;
    for (const int* i = pointCells_.begin(c); i != pointCells_.end(c); ++i) {
        const int p = *i;
        double rr = 0, zz = 0, rz = 0, zr = 0, hoop = 0, placeR = 0, placeZ = 0;
        forPartsOf(state, p, c, [&](int other, const BoxPart& part) {
            for (int k = 0; k < corners; ++k) {
                const Node& node = nodes_[cellNodes_[other * corners + k]];
                rr += part.dr[k] * node.vr;
                rz += part.dz[k] * node.vr;
                zr += part.dr[k] * node.vz;
                zz += part.dz[k] * node.vz;
                hoop += part.hoop[k] * node.vr;
                placeR += part.N[k] * node.placeVr;
                placeZ += part.N[k] * node.placeVz;
            }
        });
        strain_[0][p] = dt * rr;
        strain_[1][p] = dt * zz;
        strain_[2][p] = dt * hoop;
        strain_[3][p] = dt * (rz + zr);
        spin_[p] = 0.5 * dt * (zr - rz);
        rateSum += rr + zz + hoop;
        points.volume[p] = std::min(points.volume[p] * std::exp(dt * (rr + zz + hoop)),
                                    points.mass[p] * largestVolume_[points.material[p]]);
        points.r[p] += dt * placeR;
        points.z[p] += dt * placeZ;
    }
    state.cellDivergence[c] = rateSum / pointCells_.count(c);
}

} // namespace caisson
