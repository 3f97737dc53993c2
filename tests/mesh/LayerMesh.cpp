#include "LayerMesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace caisson::testing {

PolyMesh layerMesh(const BackgroundMesh& flat, const std::vector<std::string>& patches,
                   const PatchOfSide& patchOfSide)
{
    PolyMesh poly;
    poly.directory = "constant/polyMesh";
    const bool wedge = flat.geometry == Geometry::axisymmetric;
    std::vector<std::array<int, 2>> pointsOf;
    for (int i = 0; i < flat.nodes(); ++i) {
        const double x = wedge ? flat.r[i] * std::cos(flat.wedgeHalfAngle) : flat.r[i];
        const double y = wedge ? flat.r[i] * std::sin(flat.wedgeHalfAngle) : flat.halfThickness;
        const int front = static_cast<int>(poly.points.size());
        const bool onAxis = wedge && flat.r[i] == 0;
        poly.points.push_back({x, -y, flat.z[i]});
        if (!onAxis) {
            poly.points.push_back({x, y, flat.z[i]});
        }
        pointsOf.push_back({front, onAxis ? front : front + 1});
    }

    struct Side
    {
        int cell, a, b;
    };
    std::map<std::pair<int, int>, std::vector<Side>> sides;
    for (int k = 0; k < static_cast<int>(flat.cellNodes.size()); ++k) {
        const int cell = k / flat.corners;
        const int a = flat.node(cell, k % flat.corners);
        const int b = flat.node(cell, (k + 1) % flat.corners);
        sides[std::minmax(a, b)].push_back({cell, a, b});
    }
    const auto sideFace = [&](const Side& side) {
        std::vector<int> face = {pointsOf[side.a][0], pointsOf[side.a][1], pointsOf[side.b][1],
                                 pointsOf[side.b][0]};
        face.erase(std::unique(face.begin(), face.end()), face.end());
        return face;
    };
    std::map<std::string, std::vector<Side>> boundary;
    for (const auto& [nodes, both] : sides) {
        if (both.size() == 2) {
            poly.faces.push_back(sideFace(both[0]));
            poly.owner.push_back(both[0].cell);
            poly.neighbour.push_back(both[1].cell);
        } else if (sideFace(both[0]).size() > 2) { // the axis has no faces
            const Side& side = both[0];
            boundary[patchOfSide((flat.r[side.a] + flat.r[side.b]) / 2,
                                 (flat.z[side.a] + flat.z[side.b]) / 2)]
                .push_back(side);
        }
    }
    const auto addPatch = [&](const std::string& name, const std::string& type, int faces) {
        poly.patches.push_back({name, type, static_cast<int>(poly.faces.size()), faces});
    };
    for (const std::string& name : patches) {
        addPatch(name, "patch", static_cast<int>(boundary[name].size()));
        for (const Side& side : boundary[name]) {
            poly.faces.push_back(sideFace(side));
            poly.owner.push_back(side.cell);
        }
    }
    for (const int plane : {0, 1}) {
        addPatch(plane == 0 ? "front" : "back", wedge ? "wedge" : "empty", flat.cells());
        for (int cell = 0; cell < flat.cells(); ++cell) {
            std::vector<int> face;
            for (int k = 0; k < flat.corners; ++k) {
                face.push_back(pointsOf[flat.node(cell, k)][plane]);
            }
            if (plane == 1) {
                std::reverse(face.begin(), face.end());
            }
            poly.faces.push_back(face);
            poly.owner.push_back(cell);
        }
    }
    return poly;
}

PatchOfSide rectanglePatches(double lowR, double highR, double lowZ, double highZ)
{
    return [=](double r, double z) {
        return z == lowZ ? "bottom" : z == highZ ? "top" : r == highR ? "right" : r == lowR ? "left" : "?";
    };
}

} // namespace caisson::testing
