#include "mesh/BackgroundMesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace caisson {

namespace {

const int* nodesOf(const BackgroundMesh& mesh, int cell)
{
    return mesh.cellNodes.data() + static_cast<std::ptrdiff_t>(cell) * mesh.corners;
}

} // namespace

double cellArea(const BackgroundMesh& mesh, int cell)
{
    // Half the cross products of the corners, relative to corner 0: no cancellation far from the origin.
    const int* node = nodesOf(mesh, cell);
    double twice = 0;
    for (int k = 1; k + 1 < mesh.corners; ++k) {
        twice += (mesh.r[node[k]] - mesh.r[node[0]]) * (mesh.z[node[k + 1]] - mesh.z[node[0]]) -
                 (mesh.r[node[k + 1]] - mesh.r[node[0]]) * (mesh.z[node[k]] - mesh.z[node[0]]);
    }
    return twice / 2;
}

double cellVolume(const BackgroundMesh& mesh, int cell)
{
    if (mesh.geometry == Geometry::planeStrain) {
        return cellArea(mesh, cell);
    }
    // A fan of triangles: the integral of r over each is its area times the mean r of its corners.
    const int* node = nodesOf(mesh, cell);
    const double r0 = mesh.r[node[0]];
    const double z0 = mesh.z[node[0]];
    double sum = 0;
    for (int k = 1; k + 1 < mesh.corners; ++k) {
        const double r1 = mesh.r[node[k]];
        const double r2 = mesh.r[node[k + 1]];
        const double twiceArea = (r1 - r0) * (mesh.z[node[k + 1]] - z0) - (r2 - r0) * (mesh.z[node[k]] - z0);
        sum += twiceArea * (r0 + r1 + r2);
    }
    return sum / 6;
}

double cellSize(const BackgroundMesh& mesh, int cell)
{
    const int* node = nodesOf(mesh, cell);
    const double area = cellArea(mesh, cell);
    const auto squaredLength = [](double dr, double dz) { return dr * dr + dz * dz; };
    if (mesh.corners == 3) {
        double longest = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = node[k];
            const int b = node[(k + 1) % 3];
            longest = std::max(longest, squaredLength(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]));
        }
        return 2 * area / std::sqrt(longest);
    }
    // Extent across a pair of opposite sides: h = area / length of the mid-line between the other pair.
    const auto midLine = [&](int k) {
        const int a = node[k], b = node[k + 1], c = node[k + 2], d = node[(k + 3) % 4];
        return squaredLength(mesh.r[c] + mesh.r[d] - mesh.r[a] - mesh.r[b],
                             mesh.z[c] + mesh.z[d] - mesh.z[a] - mesh.z[b]) /
               4;
    };
    return area / std::sqrt(midLine(0) + midLine(1));
}

std::vector<std::array<double, 3>> polyMeshPoints(const BackgroundMesh& mesh)
{
    std::vector<std::array<double, 3>> points(mesh.polyMeshPoints);
    const double cosine = std::cos(mesh.wedgeHalfAngle);
    const double sine = std::sin(mesh.wedgeHalfAngle);
    for (int i = 0; i < mesh.nodes(); ++i) {
        const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
        const double x = axisymmetric ? mesh.r[i] * cosine : mesh.r[i];
        const double y = axisymmetric ? mesh.r[i] * sine : mesh.halfThickness;
        points[mesh.nodePoints[i][0]] = {x, mesh.middleY - y, mesh.z[i]};
        points[mesh.nodePoints[i][1]] = {x, mesh.middleY + y, mesh.z[i]};
    }
    return points;
}

} // namespace caisson
