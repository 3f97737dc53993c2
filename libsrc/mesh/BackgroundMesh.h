#pragma once

#include "case/PolyMesh.h"
#include "dictionary/InputProblems.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace caisson {

enum class Geometry { axisymmetric, planeStrain };

/// Compressed rows: the members of row i are item[start[i]] .. item[start[i + 1] - 1].
struct CompressedRows
{
    std::vector<int> start;
    std::vector<int> item;
};

/// A boundary edge of the 2-D mesh, part of a patch. Seen from inside the cell, node[0] to node[1] runs
/// counter-clockwise, so the outward normal is (dz, -dr)/length.
struct BoundaryEdge
{
    std::array<int, 2> node;
    int cell;
    int side; ///< side of the cell: between its corners `side` and `side + 1`
};

struct BoundaryPatch
{
    std::string name;
    std::string type;                ///< as in polyMesh/boundary: patch, wall, symmetry ...
    std::vector<BoundaryEdge> edges; ///< empty for the axis and for the wedge/empty patches
};

/// The 2-D background mesh in the (r, z) half-plane: one layer of cells of constant/polyMesh, seen through
/// its wedge (axisymmetric) or empty (plane strain) patch. In plane strain r stands for x.
///
/// Cells are all quadrilaterals or all triangles, corners counter-clockwise; side 0 is the one that runs
/// along r most closely, so corner 0 of an axis-parallel rectangle is the lower left one. Cell i is cell i of
/// the polyMesh, so that volFields map one to one; nodes are those of the front plane, compacted.
struct BackgroundMesh
{
    Geometry geometry = Geometry::axisymmetric;
    int corners = 4; ///< nodes per cell: 4 or 3

    std::vector<double> r, z;   ///< node coordinates now [m]
    std::vector<int> cellNodes; ///< corners * cells
    std::vector<int> neighbour; ///< corners * cells: cell across side k (corners k, k+1), or -1 at a boundary
    std::vector<BoundaryPatch> patches;
    std::map<std::string, std::vector<int>> cellZones;
    CompressedRows nodeCells; ///< around each node: cell * corners + corner, ascending

    /// polyMesh points that belong to each node: the front one and the back one (equal on the axis).
    std::vector<std::array<int, 2>> nodePoints;
    double wedgeHalfAngle = 0; ///< [rad], axisymmetric
    double halfThickness = 0;  ///< [m], plane strain: half the distance of the empty planes
    double middleY = 0;        ///< [m], plane strain: y half-way between the empty planes
    int polyMeshPoints = 0;

    [[nodiscard]] int nodes() const { return static_cast<int>(r.size()); }
    [[nodiscard]] int cells() const { return static_cast<int>(cellNodes.size()) / corners; }
    [[nodiscard]] int node(int cell, int corner) const { return cellNodes[cell * corners + corner]; }
};

/// Builds the 2-D mesh. The orientation rule: z up, axis along z, wedge planes symmetric about y = 0 (empty
/// planes normal to y). Anything else (other orientation, several layers, mixed or polygonal cells) is
/// reported as a problem that says what to do (transformPoints, ...).
BackgroundMesh buildBackgroundMesh(const PolyMesh& polyMesh, InputProblems& problems);

/// Area of a cell in the (r, z) plane [m2].
double cellArea(const BackgroundMesh& mesh, int cell);
/// Volume of a cell: per radian [m3/rad] axisymmetric (exact integral of r dr dz), per metre [m2] plane.
double cellVolume(const BackgroundMesh& mesh, int cell);
/// Smallest height that counts for the time step [m]: quadrilaterals 1/sqrt(1/h1^2 + 1/h2^2) with h the
/// extents across opposite sides, triangles the smallest altitude.
double cellSize(const BackgroundMesh& mesh, int cell);

/// The polyMesh points (interleaved x y z) that belong to the nodes' present places.
std::vector<std::array<double, 3>> polyMeshPoints(const BackgroundMesh& mesh);

} // namespace caisson
