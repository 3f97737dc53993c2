#include "bodies/BodySurface.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace caisson {

namespace {

void findEdges(BodySurface& surface, const BackgroundMesh& mesh);

/// Distance from a place to an edge of the body at its present level.
double distance(const RigidBody& body, const ProfileEdge& edge, double r, double z)
{
    const double dr = edge.to[0] - edge.from[0];
    const double dz = edge.to[1] - edge.from[1];
    const double pr = r - edge.from[0];
    const double pz = z - body.tipLevel - edge.from[1];
    const double along = std::clamp((pr * dr + pz * dz) / (dr * dr + dz * dz), 0.0, 1.0);
    return std::hypot(pr - along * dr, pz - along * dz);
}

} // namespace

std::array<double, 2> pushOut(const RigidBody& body, double r, double z, double clearance)
{
    const ProfileEdge* nearest = &body.profile.front();
    double shortest = std::numeric_limits<double>::max();
    for (const ProfileEdge& edge : body.profile) {
        const double d = distance(body, edge, r, z);
        if (d < shortest) {
            shortest = d;
            nearest = &edge;
        }
    }
    return {r + nearest->normal[0] * (shortest + clearance), z + nearest->normal[1] * (shortest + clearance)};
}

BodySurface findBodySurface(const RigidBody& body, const BackgroundMesh& mesh, InputProblems& problems)
{
    BodySurface surface;
    surface.voidCell.assign(mesh.cells(), 0);
    for (int c = 0; c < mesh.cells(); ++c) {
        double r = 0;
        double z = 0;
        for (int k = 0; k < mesh.corners; ++k) {
            r += mesh.r[mesh.node(c, k)] / mesh.corners;
            z += mesh.z[mesh.node(c, k)] / mesh.corners;
        }
        surface.voidCell[c] = body.contains(r, z);
    }

    // Surface nodes: void cells on one side, soil cells on the other. Each must lie on an edge of the
    // profile.
    for (int i = 0; i < mesh.nodes(); ++i) {
        bool touchesVoid = false;
        bool touchesSoil = false;
        double size = std::numeric_limits<double>::max();
        for (int k = mesh.nodeCells.start[i]; k < mesh.nodeCells.start[i + 1]; ++k) {
            const int c = mesh.nodeCells.item[k] / mesh.corners;
            (surface.voidCell[c] ? touchesVoid : touchesSoil) = true;
            size = std::min(size, cellSize(mesh, c));
        }
        if (!touchesVoid || !touchesSoil) {
            continue;
        }
        const double tolerance = 1e-4 * size;
        SurfaceNode node{};
        node.node = i;
        node.faces = 0;
        double nearest = std::numeric_limits<double>::max();
        for (const ProfileEdge& edge : body.profile) {
            const double d = distance(body, edge, mesh.r[i], mesh.z[i]);
            nearest = std::min(nearest, d);
            if (d < tolerance && node.faces < 2) {
                // The same plane twice (a face given in two pieces) is one face.
                if (node.faces == 1 &&
                    node.normal[0][0] * edge.normal[0] + node.normal[0][1] * edge.normal[1] > 0.999) {
                    continue;
                }
                node.normal[node.faces] = edge.normal;
                node.part[node.faces] = edge.part;
                ++node.faces;
            }
        }
        if (node.faces == 0) {
            problems.add(
                {},
                text("body '%s': its surface cuts through the cells at r = %.6g m, z = %.6g m (%.3g m from "
                     "the "
                     "nearest face)",
                     body.name.c_str(), mesh.r[i], mesh.z[i], nearest),
                "the mesh must have lines along the faces of the body: check radii, wall thickness and "
                "tipLevel against system/blockMeshDict");
            return surface;
        }
        if (node.faces == 2 && node.part[1] == SurfacePart::tip) {
            std::swap(node.normal[0], node.normal[1]);
            std::swap(node.part[0], node.part[1]);
        }
        surface.nodes.push_back(node);
    }

    findEdges(surface, mesh);
    updateAreas(surface, mesh);

    // The neighbourhood of the tip's corners: the next node along the tip's level, away from the tip.
    for (SurfaceNode& node : surface.nodes) {
        if (node.faces != 2 || node.part[0] != SurfacePart::tip) {
            continue;
        }
        for (int k = 0; k < 2; ++k) {
            node.roundedNormal[k] = node.area[0] * node.normal[0][k] + node.area[1] * node.normal[1][k];
        }
        const double normalLength = std::hypot(node.roundedNormal[0], node.roundedNormal[1]);
        node.roundedNormal[0] /= normalLength;
        node.roundedNormal[1] /= normalLength;
        double straightest = 0.9; // least cosine
        double besideLength = 0;
        for (int k = mesh.nodeCells.start[node.node]; k < mesh.nodeCells.start[node.node + 1]; ++k) {
            const int c = mesh.nodeCells.item[k] / mesh.corners;
            for (int j = 0; j < mesh.corners && !surface.voidCell[c]; ++j) {
                const int other = mesh.node(c, j);
                const double dr = mesh.r[other] - mesh.r[node.node];
                const double dz = mesh.z[other] - mesh.z[node.node];
                const double length = std::hypot(dr, dz);
                const double cosine =
                    length > 0 ? (dr * node.normal[1][0] + dz * node.normal[1][1]) / length : 0;
                // The nearest of those on the line: a cell's far corner is never on it.
                if (cosine > straightest) {
                    straightest = cosine;
                    node.beside = other;
                    besideLength = length;
                }
            }
        }
        if (node.beside >= 0) {
            const double r = mesh.r[node.node];
            const double besideArea = mesh.geometry == Geometry::axisymmetric
                                          ? (2 * r + mesh.r[node.beside]) / 6 * besideLength
                                          : besideLength / 2;
            node.tipShare = node.area[0] / (node.area[0] + besideArea);
        }
    }
    return surface;
}

namespace {

void findEdges(BodySurface& surface, const BackgroundMesh& mesh)
{
    std::vector<int> surfaceIndex(mesh.nodes(), -1);
    for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
        surfaceIndex[surface.nodes[i].node] = static_cast<int>(i);
    }
    for (const SurfaceNode& start : surface.nodes) {
        for (int k = mesh.nodeCells.start[start.node]; k < mesh.nodeCells.start[start.node + 1]; ++k) {
            const int c = mesh.nodeCells.item[k] / mesh.corners;
            const int side = mesh.nodeCells.item[k] % mesh.corners;
            const int across = mesh.neighbour[c * mesh.corners + side];
            if (surface.voidCell[c] || across < 0 || !surface.voidCell[across]) {
                continue; // the side from this corner on is not on the surface
            }
            const int a = start.node;
            const int b = mesh.node(c, (side + 1) % mesh.corners);
            const double length = std::hypot(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]);
            // Normal into the soil: the cell lies to the left of a -> b, so it points to the left.
            const std::array<double, 2> normal{-(mesh.z[b] - mesh.z[a]) / length,
                                               (mesh.r[b] - mesh.r[a]) / length};
            BodySurface::Edge edge{{surfaceIndex[a], surfaceIndex[b]}, {-1, -1}};
            for (int end = 0; end < 2; ++end) {
                const SurfaceNode& node = surface.nodes[edge.node[end]];
                for (int f = 0; f < node.faces; ++f) {
                    if (node.normal[f][0] * normal[0] + node.normal[f][1] * normal[1] > 0.9) {
                        edge.face[end] = f;
                    }
                }
            }
            surface.edges.push_back(edge);
        }
    }
}

} // namespace

void updateAreas(BodySurface& surface, const BackgroundMesh& mesh)
{
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    for (SurfaceNode& node : surface.nodes) {
        node.area = {};
    }
    for (const BodySurface::Edge& edge : surface.edges) {
        const int a = surface.nodes[edge.node[0]].node;
        const int b = surface.nodes[edge.node[1]].node;
        const double length = std::hypot(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]);
        for (int end = 0; end < 2; ++end) {
            const int self = end == 0 ? a : b;
            const int other = end == 0 ? b : a;
            if (edge.face[end] >= 0) {
                const double weight = axisymmetric ? (2 * mesh.r[self] + mesh.r[other]) / 6 : 0.5;
                surface.nodes[edge.node[end]].area[edge.face[end]] += weight * length;
            }
        }
    }
}

} // namespace caisson
