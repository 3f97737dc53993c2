#include "mesh/CellLocator.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

/// A place may lie this far beyond a boundary side, relative to the side's length, by rounding.
constexpr double boundaryTolerance = 1e-10;

struct Walked
{
    int cell;
    bool inside;
};

/// Side of `cell` that (r, z) lies beyond and across which the walk may go on: the first with a neighbour,
/// else a boundary side; -1 inside the cell.
int sideBeyond(const BackgroundMesh& mesh, double r, double z, int cell)
{
    const int first = cell * mesh.corners;
    int beyond = -1;
    int a = mesh.cellNodes[first + mesh.corners - 1];
    for (int k = 0; k < mesh.corners; ++k) {
        const int b = mesh.cellNodes[first + k];
        const double dr = mesh.r[b] - mesh.r[a];
        const double dz = mesh.z[b] - mesh.z[a];
        const double cross = dr * (z - mesh.z[a]) - dz * (r - mesh.r[a]);
        if (!(cross >= 0)) { // so that nan lies outside
            const int side = k == 0 ? mesh.corners - 1 : k - 1;
            if (mesh.neighbour[first + side] >= 0) {
                return side;
            }
            if (!(cross >= -boundaryTolerance * (dr * dr + dz * dz))) {
                beyond = side;
            }
        }
        a = b;
    }
    return beyond;
}

/// From `cell` towards (r, z), until inside, at the boundary, or after `limit` cells.
Walked walkTowards(const BackgroundMesh& mesh, double r, double z, int cell, int limit)
{
    for (int i = 0; i < limit; ++i) {
        const int side = sideBeyond(mesh, r, z, cell);
        if (side < 0) {
            return {cell, true};
        }
        const int next = mesh.neighbour[cell * mesh.corners + side];
        if (next < 0) {
            break;
        }
        cell = next;
    }
    return {cell, false};
}

} // namespace

CellLocator::CellLocator(const BackgroundMesh& mesh) : mesh_(mesh)
{
    const auto [minR, maxR] = std::minmax_element(mesh.r.begin(), mesh.r.end());
    const auto [minZ, maxZ] = std::minmax_element(mesh.z.begin(), mesh.z.end());
    originR_ = *minR;
    originZ_ = *minZ;
    binSize_ = std::sqrt((*maxR - *minR) * (*maxZ - *minZ) / mesh.cells());
    binsR_ = 1 + static_cast<int>((*maxR - *minR) / binSize_);
    binsZ_ = 1 + static_cast<int>((*maxZ - *minZ) / binSize_);
    binCell_.resize(static_cast<std::size_t>(binsR_) * binsZ_);
    // Row by row, back and forth, each bin's walk starting where the one before ended.
    int cell = 0;
    for (int j = 0; j < binsZ_; ++j) {
        for (int k = 0; k < binsR_; ++k) {
            const int i = j % 2 == 0 ? k : binsR_ - 1 - k;
            const double r = originR_ + (i + 0.5) * binSize_;
            const double z = originZ_ + (j + 0.5) * binSize_;
            cell = walkTowards(mesh, r, z, cell, mesh.cells()).cell;
            binCell_[j * binsR_ + i] = cell;
        }
    }
}

int CellLocator::walk(double r, double z, int startCell) const
{
    const Walked walked = walkTowards(mesh_, r, z, startCell, mesh_.cells());
    if (walked.inside) {
        return walked.cell;
    }
    // A walk ends early at a re-entrant boundary and may go round in circles on odd meshes: look everywhere.
    for (int cell = 0; cell < mesh_.cells(); ++cell) {
        if (sideBeyond(mesh_, r, z, cell) < 0) {
            return cell;
        }
    }
    return -1;
}

int CellLocator::find(double r, double z) const
{
    if (!std::isfinite(r) || !std::isfinite(z)) {
        return -1;
    }
    const double i = std::clamp(std::floor((r - originR_) / binSize_), 0.0, binsR_ - 1.0);
    const double j = std::clamp(std::floor((z - originZ_) / binSize_), 0.0, binsZ_ - 1.0);
    return walk(r, z, binCell_[static_cast<int>(j) * binsR_ + static_cast<int>(i)]);
}

} // namespace caisson
