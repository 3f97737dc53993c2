#include "support/StructuredMesh.h"

#include "mesh/PolyMeshLayer.h"

#include <map>

namespace caisson::testing {

std::vector<double> evenLines(double a, double b, int n)
{
    std::vector<double> lines(n + 1);
    for (int i = 0; i <= n; ++i) {
        lines[i] = i == n ? b : a + (b - a) * i / n;
    }
    return lines;
}

BackgroundMesh structuredMesh(const std::vector<double>& rLines, const std::vector<double>& zLines,
                              Geometry geometry, bool triangles)
{
    BackgroundMesh mesh;
    mesh.geometry = geometry;
    mesh.corners = triangles ? 3 : 4;
    mesh.wedgeHalfAngle = 0.0436332;
    mesh.halfThickness = 0.5;
    const int nr = static_cast<int>(rLines.size());
    const int nz = static_cast<int>(zLines.size());
    for (const double z : zLines) {
        for (const double r : rLines) {
            mesh.r.push_back(r);
            mesh.z.push_back(z);
        }
    }
    const auto id = [nr](int i, int j) { return j * nr + i; };
    for (int j = 0; j + 1 < nz; ++j) {
        for (int i = 0; i + 1 < nr; ++i) {
            const int a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
            if (!triangles) {
                mesh.cellNodes.insert(mesh.cellNodes.end(), {a, b, c, d});
            } else if ((i + j) % 2 == 0) {
                mesh.cellNodes.insert(mesh.cellNodes.end(), {a, b, c, a, c, d});
            } else {
                mesh.cellNodes.insert(mesh.cellNodes.end(), {a, b, d, b, c, d});
            }
        }
    }
    const int n = mesh.corners;
    std::map<std::pair<int, int>, int> sideOf;
    for (int k = 0; k < static_cast<int>(mesh.cellNodes.size()); ++k) {
        const int c = k / n;
        sideOf[{mesh.node(c, k % n), mesh.node(c, (k + 1) % n)}] = c;
    }
    mesh.neighbour.assign(mesh.cellNodes.size(), -1);
    BoundaryPatch left{"left", "patch", {}}, right{"right", "patch", {}}, bottom{"bottom", "patch", {}},
        top{"top", "patch", {}};
    for (int k = 0; k < static_cast<int>(mesh.cellNodes.size()); ++k) {
        const int c = k / n;
        const int a = mesh.node(c, k % n);
        const int b = mesh.node(c, (k + 1) % n);
        const auto across = sideOf.find({b, a});
        if (across != sideOf.end()) {
            mesh.neighbour[k] = across->second;
            continue;
        }
        const BoundaryEdge edge{{a, b}, c, k % n};
        if (mesh.z[a] == zLines.front() && mesh.z[b] == zLines.front()) {
            bottom.edges.push_back(edge);
        } else if (mesh.z[a] == zLines.back() && mesh.z[b] == zLines.back()) {
            top.edges.push_back(edge);
        } else if (mesh.r[a] == rLines.back()) {
            right.edges.push_back(edge);
        } else if (geometry == Geometry::planeStrain || rLines.front() > 0) {
            left.edges.push_back(edge);
        }
    }
    mesh.patches = {left, right, bottom, top};
    mesh.nodeCells.start.assign(mesh.nodes() + 1, 0);
    for (const int i : mesh.cellNodes) {
        ++mesh.nodeCells.start[i + 1];
    }
    for (int i = 0; i < mesh.nodes(); ++i) {
        mesh.nodeCells.start[i + 1] += mesh.nodeCells.start[i];
    }
    mesh.nodeCells.item.resize(mesh.cellNodes.size());
    std::vector<int> cursor(mesh.nodeCells.start.begin(), mesh.nodeCells.start.end() - 1);
    for (int k = 0; k < static_cast<int>(mesh.cellNodes.size()); ++k) {
        mesh.nodeCells.item[cursor[mesh.cellNodes[k]]++] = k;
    }
    mesh.nodePoints.assign(mesh.nodes(), {0, 0});
    return mesh;
}

PolyMesh layerOf(BackgroundMesh mesh)
{
    const char* type = mesh.geometry == Geometry::axisymmetric ? "wedge" : "empty";
    const auto planes = static_cast<int>(mesh.patches.size());
    mesh.patches.push_back({"front", type, {}});
    mesh.patches.push_back({"back", type, {}});
    return polyMeshLayer(mesh, planes, planes + 1);
}

} // namespace caisson::testing
