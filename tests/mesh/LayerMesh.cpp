#include "LayerMesh.h"

#include "mesh/PolyMeshLayer.h"

#include <algorithm>
#include <map>

namespace caisson::testing {

PolyMesh layerMesh(BackgroundMesh flat, const std::vector<std::string>& patches,
                   const PatchOfSide& patchOfSide)
{
    std::map<std::pair<int, int>, int> cellsAt;
    const auto side = [&](int k) {
        return std::pair{flat.cellNodes[k], flat.node(k / flat.corners, (k + 1) % flat.corners)};
    };
    const auto sides = static_cast<int>(flat.cellNodes.size());
    for (int k = 0; k < sides; ++k) {
        const auto [a, b] = side(k);
        ++cellsAt[std::minmax(a, b)];
    }
    flat.patches.clear();
    for (const std::string& name : patches) {
        flat.patches.push_back({name, "patch", {}});
    }
    for (int k = 0; k < sides; ++k) {
        const auto [a, b] = side(k);
        const bool onAxis = flat.geometry == Geometry::axisymmetric && flat.r[a] == 0 && flat.r[b] == 0;
        if (cellsAt[std::minmax(a, b)] == 1 && !onAxis) {
            const std::string name = patchOfSide((flat.r[a] + flat.r[b]) / 2, (flat.z[a] + flat.z[b]) / 2);
            const auto patch = std::ranges::find(flat.patches, name, &BoundaryPatch::name);
            patch->edges.push_back({{a, b}, k / flat.corners, k % flat.corners});
        }
    }
    const char* type = flat.geometry == Geometry::axisymmetric ? "wedge" : "empty";
    flat.patches.push_back({"front", type, {}});
    flat.patches.push_back({"back", type, {}});
    const auto planes = static_cast<int>(patches.size());
    return polyMeshLayer(flat, planes, planes + 1);
}

PatchOfSide rectanglePatches(double lowR, double highR, double lowZ, double highZ)
{
    return [=](double r, double z) {
        return z == lowZ ? "bottom" : z == highZ ? "top" : r == highR ? "right" : r == lowR ? "left" : "?";
    };
}

} // namespace caisson::testing
