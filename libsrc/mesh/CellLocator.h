#pragma once

#include "mesh/BackgroundMesh.h"

namespace caisson {

/// Finds the cell of a place by walking from a start cell across the side that the place lies beyond:
/// O(1) for a point that moves less than a cell at a time, on any mesh, moving or not.
class CellLocator
{
public:
    explicit CellLocator(const BackgroundMesh& mesh); ///< keeps a reference; builds bins for `find`

    /// @returns the cell that holds (r, z), or -1 outside the mesh. Places on a shared side belong to one
    /// of its cells, always the same for the same start.
    [[nodiscard]] int walk(double r, double z, int startCell) const;
    /// Without a start: through bins of the mesh as it was at construction, then a walk.
    [[nodiscard]] int find(double r, double z) const;

private:
    const BackgroundMesh& mesh_;
    double originR_ = 0, originZ_ = 0, binSize_ = 1;
    int binsR_ = 0, binsZ_ = 0;
    std::vector<int> binCell_;
};

} // namespace caisson
