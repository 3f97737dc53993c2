#include "mesh/TriangulateMesh.h"

#include "mesh/PolyMeshLayer.h"

#include <queue>

namespace caisson {

namespace {

/// Corner that the diagonal of each cell starts at, 0 or 1: another one than that of the cells beside it,
/// where they can be told apart like the squares of a chessboard.
std::vector<int> diagonals(const BackgroundMesh& mesh)
{
    std::vector<int> first(mesh.cells(), -1);
    for (int start = 0; start < mesh.cells(); ++start) {
        if (first[start] >= 0) {
            continue;
        }
        first[start] = 0;
        std::queue<int> found;
        for (found.push(start); !found.empty(); found.pop()) {
            const int cell = found.front();
            for (int side = 0; side < mesh.corners; ++side) {
                const int next = mesh.neighbour[cell * mesh.corners + side];
                if (next >= 0 && first[next] < 0) {
                    first[next] = 1 - first[cell];
                    found.push(next);
                }
            }
        }
    }
    return first;
}

} // namespace

PolyMesh triangulated(const PolyMesh& polyMesh, InputProblems& problems)
{
    const BackgroundMesh mesh = buildBackgroundMesh(polyMesh, problems);
    if (mesh.nodeCells.start.empty()) {
        return {};
    }
    if (mesh.corners != 4) {
        problems.add({polyMesh.directory, 0}, "the cells of the mesh are triangles already",
                     "triangulateMesh starts from quadrilaterals; run blockMesh again to start anew");
        return {};
    }
    BackgroundMesh flat = mesh;
    flat.corners = 3;
    flat.cellNodes.clear();
    const std::vector<int> first = diagonals(mesh);
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        const auto corner = [&](int k) { return mesh.node(cell, (first[cell] + k) % 4); };
        flat.cellNodes.insert(flat.cellNodes.end(),
                              {corner(0), corner(1), corner(2), corner(0), corner(2), corner(3)});
    }
    for (BoundaryPatch& patch : flat.patches) {
        for (BoundaryEdge& edge : patch.edges) {
            const int side = (edge.side + 4 - first[edge.cell]) % 4; // counted from the diagonal
            const bool second = side >= 2;
            edge = {edge.node, 2 * edge.cell + (second ? 1 : 0), second ? side - 1 : side};
        }
    }
    for (auto& [name, cells] : flat.cellZones) {
        std::vector<int> triangles;
        for (const int cell : cells) {
            triangles.insert(triangles.end(), {2 * cell, 2 * cell + 1});
        }
        cells = triangles;
    }
    const auto [front, back] = planePatches(polyMesh, mesh);
    return polyMeshLayer(flat, front, back);
}

} // namespace caisson
