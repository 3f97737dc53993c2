#include "mesh/PolyMeshLayer.h"

#include <algorithm>
#include <map>

namespace caisson {

namespace {

class Layer
{
public:
    explicit Layer(const BackgroundMesh& flat) : flat_(flat)
    {
        flat_.nodePoints.clear();
        int points = 0;
        for (const double r : flat_.r) {
            const bool onAxis = flat_.geometry == Geometry::axisymmetric && r == 0;
            flat_.nodePoints.push_back({points, onAxis ? points : points + 1});
            points += onAxis ? 1 : 2;
        }
        flat_.polyMeshPoints = points;
        poly_.directory = "constant/polyMesh";
        poly_.points = polyMeshPoints(flat_);
    }

    PolyMesh make(int frontPatch, int backPatch)
    {
        addInnerFaces();
        for (int patch = 0; patch < static_cast<int>(flat_.patches.size()); ++patch) {
            const BoundaryPatch& edges = flat_.patches[patch];
            const auto start = static_cast<int>(poly_.faces.size());
            for (const BoundaryEdge& edge : edges.edges) {
                addFace(sideFace(edge.node[0], edge.node[1]), edge.cell);
            }
            if (patch == frontPatch) {
                addPlane(0);
            }
            if (patch == backPatch) {
                addPlane(1);
            }
            poly_.patches.push_back(
                {edges.name, edges.type, start, static_cast<int>(poly_.faces.size()) - start});
        }
        for (const auto& [name, cells] : flat_.cellZones) {
            poly_.cellZones.push_back({name, cells});
        }
        return std::move(poly_);
    }

private:
    void addFace(std::vector<int> face, int owner)
    {
        poly_.faces.push_back(std::move(face));
        poly_.owner.push_back(owner);
    }

    /// The face on the side from node a to node b, normal away from the cell on the left of it.
    [[nodiscard]] std::vector<int> sideFace(int a, int b) const
    {
        const auto [aFront, aBack] = flat_.nodePoints[a];
        const auto [bFront, bBack] = flat_.nodePoints[b];
        std::vector<int> face = {aFront, aBack, bBack, bFront};
        face.erase(std::unique(face.begin(), face.end()), face.end());
        return face;
    }

    /// In ascending order of owner, then of neighbour.
    void addInnerFaces()
    {
        std::map<std::array<int, 2>, int> cellOfSide;
        const auto side = [&](int cell, int k) {
            return std::array<int, 2>{flat_.node(cell, k), flat_.node(cell, (k + 1) % flat_.corners)};
        };
        for (int cell = 0; cell < flat_.cells(); ++cell) {
            for (int k = 0; k < flat_.corners; ++k) {
                cellOfSide[side(cell, k)] = cell;
            }
        }
        for (int cell = 0; cell < flat_.cells(); ++cell) {
            std::map<int, std::array<int, 2>> later;
            for (int k = 0; k < flat_.corners; ++k) {
                const auto [a, b] = side(cell, k);
                const auto across = cellOfSide.find({b, a});
                if (across != cellOfSide.end() && across->second > cell) {
                    later[across->second] = {a, b};
                }
            }
            for (const auto& [neighbour, nodes] : later) {
                addFace(sideFace(nodes[0], nodes[1]), cell);
                poly_.neighbour.push_back(neighbour);
            }
        }
    }

    void addPlane(int plane)
    {
        for (int cell = 0; cell < flat_.cells(); ++cell) {
            std::vector<int> face(flat_.corners);
            for (int k = 0; k < flat_.corners; ++k) {
                face[k] = flat_.nodePoints[flat_.node(cell, k)][plane];
            }
            if (plane == 1) {
                std::reverse(face.begin(), face.end());
            }
            addFace(std::move(face), cell);
        }
    }

    BackgroundMesh flat_;
    PolyMesh poly_;
};

} // namespace

PolyMesh polyMeshLayer(const BackgroundMesh& flat, int frontPatch, int backPatch)
{
    return Layer(flat).make(frontPatch, backPatch);
}

std::array<int, 2> planePatches(const PolyMesh& polyMesh, const BackgroundMesh& flat)
{
    std::vector<std::array<bool, 2>> isOn(polyMesh.points.size(), {false, false});
    for (const std::array<int, 2>& points : flat.nodePoints) {
        isOn[points[0]][0] = true;
        isOn[points[1]][1] = true;
    }
    std::array<int, 2> patches = {-1, -1};
    for (std::size_t i = 0; i < polyMesh.patches.size(); ++i) {
        const PolyPatch& patch = polyMesh.patches[i];
        for (int f = patch.startFace; f < patch.startFace + patch.faces; ++f) {
            for (const std::size_t plane : {0, 1}) {
                if (std::ranges::all_of(polyMesh.faces[f], [&](int p) { return isOn[p][plane]; })) {
                    patches[plane] = static_cast<int>(i);
                }
            }
        }
    }
    return patches;
}

} // namespace caisson
