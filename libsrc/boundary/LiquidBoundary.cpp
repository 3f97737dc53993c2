#include "boundary/LiquidBoundary.h"

#include <algorithm>
#include <cmath>

namespace caisson {

LiquidBoundary::LiquidBoundary(const BackgroundMesh& mesh, std::map<std::string, PatchPressure>&& patches)
{
    for (auto& [name, condition] : patches) {
        patches_.emplace(name, std::make_shared<const PatchPressure>(std::move(condition)));
    }
    std::map<int, Node> held;
    const auto hold = [&held](int node, const std::array<double, 2>& normal, const PatchPressure* flux) {
        const auto [place, isNew] = held.try_emplace(node, Node{node, 1, {normal}, {flux}});
        Node& own = place->second;
        if (isNew || own.directions == 2) {
            return;
        }
        const auto& first = own.normal[0];
        const double across = normal[1] * first[0] - normal[0] * first[1];
        if (std::abs(across) > 1e-6) { // what is new of the second direction
            own.normal[1] = across > 0 ? std::array{-first[1], first[0]} : std::array{first[1], -first[0]};
            own.flux[1] = flux;
            own.directions = 2;
        }
    };
    if (mesh.geometry == Geometry::axisymmetric) {
        const double extent = *std::ranges::max_element(mesh.r);
        for (int i = 0; i < mesh.nodes(); ++i) {
            if (mesh.r[i] < 1e-9 * extent) {
                hold(i, {1, 0}, nullptr);
            }
        }
    }
    for (int p = 0; p < static_cast<int>(mesh.patches.size()); ++p) {
        const auto found = patches_.find(mesh.patches[p].name);
        if (found == patches_.end()) {
            continue;
        }
        const std::shared_ptr<const PatchPressure>& condition = found->second;
        if (condition->givesPressure()) {
            open_.emplace_back(p, condition);
            continue;
        }
        if (condition->givesFlux()) {
            fed_.emplace_back(p, condition);
        }
        for (const BoundaryEdge& edge : mesh.patches[p].edges) {
            const auto [a, b] = edge.node;
            const double length = std::hypot(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]);
            const std::array<double, 2> normal{-(mesh.z[b] - mesh.z[a]) / length,
                                               (mesh.r[b] - mesh.r[a]) / length};
            const PatchPressure* flux = condition->givesFlux() ? condition.get() : nullptr;
            hold(a, normal, flux);
            hold(b, normal, flux);
        }
    }
    for (const auto& item : held) {
        nodes_.push_back(item.second);
    }
}

std::vector<int> LiquidBoundary::openNodes(const BackgroundMesh& mesh) const
{
    std::vector<int> result;
    for (const auto& open : open_) {
        for (const BoundaryEdge& edge : mesh.patches[open.first].edges) {
            result.insert(result.end(), edge.node.begin(), edge.node.end());
        }
    }
    return result;
}

void LiquidBoundary::addPressures(const BackgroundMesh& mesh, double time, double unitWeight,
                                  std::vector<std::array<double, 2>>& force) const
{
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    const double gauss = 0.5 / std::sqrt(3.0);
    for (const auto& [p, condition] : open_) {
        for (const BoundaryEdge& edge : mesh.patches[p].edges) {
            const auto [a, b] = edge.node;
            const double dr = mesh.r[b] - mesh.r[a];
            const double dz = mesh.z[b] - mesh.z[a];
            for (const double x : {0.5 - gauss, 0.5 + gauss}) {
                const double r = mesh.r[a] + x * dr;
                const double z = mesh.z[a] + x * dz;
                const double pressure = condition->at(time, z) - unitWeight * z;
                const double weight = 0.5 * pressure * (axisymmetric ? r : 1);
                // Outward normal times length is (dz, -dr); a pressure pushes inward.
                force[a][0] -= weight * (1 - x) * dz;
                force[a][1] += weight * (1 - x) * dr;
                force[b][0] -= weight * x * dz;
                force[b][1] += weight * x * dr;
            }
        }
    }
}

void LiquidBoundary::addInflows(const BackgroundMesh& mesh, double time, std::vector<double>& inflow) const
{
    const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
    for (const auto& [p, condition] : fed_) {
        const double discharge = condition->at(time, 0);
        for (const BoundaryEdge& edge : mesh.patches[p].edges) {
            const auto [a, b] = edge.node;
            const double length = std::hypot(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]);
            inflow[a] += discharge * length * (axisymmetric ? (2 * mesh.r[a] + mesh.r[b]) / 6 : 0.5);
            inflow[b] += discharge * length * (axisymmetric ? (2 * mesh.r[b] + mesh.r[a]) / 6 : 0.5);
        }
    }
}

std::vector<int> LiquidBoundary::openPatches(const BackgroundMesh& mesh) const
{
    std::vector<int> patchOf(mesh.nodes(), -1);
    for (const auto* patches : {&open_, &fed_}) {
        for (const auto& item : *patches) {
            for (const BoundaryEdge& edge : mesh.patches[item.first].edges) {
                for (const int i : edge.node) {
                    patchOf[i] = patchOf[i] < 0 ? item.first : patchOf[i];
                }
            }
        }
    }
    return patchOf;
}

void LiquidBoundary::setPressures(const BackgroundMesh& mesh, double time, double unitWeight,
                                  std::vector<double>& excessPressure) const
{
    for (const auto& [p, condition] : open_) {
        for (const BoundaryEdge& edge : mesh.patches[p].edges) {
            for (const int i : edge.node) {
                excessPressure[i] = condition->at(time, mesh.z[i]) - unitWeight * mesh.z[i];
            }
        }
    }
}

} // namespace caisson
