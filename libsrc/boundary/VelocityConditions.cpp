#include "boundary/VelocityConditions.h"

#include <algorithm>
#include <cmath>

namespace caisson {

namespace {

struct TypeWord
{
    std::string_view word;
    PatchVelocity::Kind kind;
    std::string_view valueKey; ///< "" where the type has no value
};

constexpr TypeWord types[] = {
    {"fixedValue", PatchVelocity::Kind::fixed, "value"},
    {"uniformFixedValue", PatchVelocity::Kind::fixed, "uniformValue"},
    {"slip", PatchVelocity::Kind::slip, ""},
    {"symmetryPlane", PatchVelocity::Kind::slip, ""},
    {"zeroGradient", PatchVelocity::Kind::free, ""},
    {"traction", PatchVelocity::Kind::traction, "uniformValue"},
    {"pressure", PatchVelocity::Kind::pressure, "uniformValue"},
};

const TypeWord* findType(std::string_view word)
{
    const auto* found = std::ranges::find(types, word, &TypeWord::word);
    return found == std::end(types) ? nullptr : found;
}

} // namespace

std::vector<std::string> patchVelocityTypes()
{
    std::vector<std::string> words;
    for (const TypeWord& type : types) {
        words.emplace_back(type.word);
    }
    return words;
}

std::map<std::string, PatchVelocity> readPatchVelocities(const Dictionary& fieldU, const BackgroundMesh& mesh,
                                                         const std::vector<std::string>& constraintPatches,
                                                         InputProblems& problems)
{
    std::map<std::string, PatchVelocity> result;
    const Dictionary* boundaryField = fieldU.findDictionary("boundaryField");
    if (!boundaryField) {
        problems.add(fieldU.where(), "no boundaryField",
                     "one sub-dictionary per patch of constant/polyMesh/boundary");
        return result;
    }
    std::vector<std::string> patchNames = constraintPatches;
    for (const BoundaryPatch& patch : mesh.patches) {
        patchNames.push_back(patch.name);
    }
    for (const Entry& entry : boundaryField->entries()) {
        if (!entry.isPattern && std::ranges::find(patchNames, entry.keyword) == patchNames.end()) {
            problems.add(entry.where, "unknown patch '" + entry.keyword + "' in boundaryField",
                         suggestion(entry.keyword, patchNames, "patches"));
        }
    }
    for (const BoundaryPatch& patch : mesh.patches) {
        if (std::ranges::find(constraintPatches, patch.name) != constraintPatches.end()) {
            continue;
        }
        const Entry* entry = boundaryField->find(patch.name);
        if (!entry || !entry->dictionary) {
            if (!patch.edges.empty()) {
                problems.add(
                    boundaryField->where(), "no condition for patch '" + patch.name + "'", "types: " + [] {
                        std::string all;
                        for (const TypeWord& type : types) {
                            all += std::string(type.word) + " ";
                        }
                        return all;
                    }());
            }
            continue;
        }
        const Dictionary& dictionary = *entry->dictionary;
        const Entry* typeEntry = dictionary.find("type");
        const std::string word = typeEntry && !typeEntry->tokens.empty() ? typeEntry->tokens[0].text : "";
        const TypeWord* type = findType(word);
        if (patch.edges.empty() && (word == "wedge" || word == "empty" || word == "symmetry")) {
            continue;
        }
        if (!type) {
            problems.add(typeEntry ? typeEntry->where : entry->where,
                         word.empty() ? "no type for patch '" + patch.name + "'"
                                      : "unknown type '" + word + "' for patch '" + patch.name + "'",
                         suggestion(word, patchVelocityTypes(), "types"));
            continue;
        }
        PatchVelocity condition;
        condition.kind = type->kind;
        if (!type->valueKey.empty()) {
            if (!dictionary.find(type->valueKey)) {
                problems.add(entry->where, "patch '" + patch.name + "': type " + word + " needs '" +
                                               std::string(type->valueKey) + "'");
            } else if (type->kind == PatchVelocity::Kind::pressure) {
                condition.value.component[0] = readFunction1(dictionary, type->valueKey, problems);
            } else {
                condition.value = readVectorFunction1(dictionary, type->valueKey, problems);
            }
        }
        for (const Entry& key : dictionary.entries()) {
            const bool known = key.keyword == "type" || key.keyword == "value" ||
                               key.keyword == type->valueKey || key.keyword == "patchType" ||
                               key.keyword.ends_with("Coeffs");
            if (!known && !dictionary.usedAsMacro(key.keyword)) {
                problems.add(key.where, "unknown key '" + key.keyword + "' for patch '" + patch.name + "'",
                             suggestion(key.keyword, {"type", std::string(type->valueKey)}, "keys"));
            }
        }
        result.emplace(patch.name, std::move(condition));
    }
    return result;
}

VelocityConditions::VelocityConditions(const BackgroundMesh& mesh,
                                       std::map<std::string, PatchVelocity>&& patches)
{
    for (auto& [name, condition] : patches) {
        patches_.emplace(name, std::make_shared<const PatchVelocity>(std::move(condition)));
    }
    // First held directions, then given velocities, which win where both meet.
    std::map<int, Node> held;
    const auto hold = [&held](int node, std::array<double, 2> normal) {
        const auto [place, isNew] = held.try_emplace(node, Node{node, false, normal, nullptr});
        if (!isNew && !place->second.fixed) {
            const auto& first = place->second.normal;
            place->second.fixed = std::abs(first[0] * normal[1] - first[1] * normal[0]) > 1e-6;
        }
    };
    if (mesh.geometry == Geometry::axisymmetric) {
        const double extent = *std::ranges::max_element(mesh.r);
        for (int i = 0; i < mesh.nodes(); ++i) {
            if (mesh.r[i] < 1e-9 * extent) {
                hold(i, {1, 0});
            }
        }
    }
    for (int p = 0; p < static_cast<int>(mesh.patches.size()); ++p) {
        const auto found = patches_.find(mesh.patches[p].name);
        if (found == patches_.end()) {
            continue;
        }
        if (found->second->kind == PatchVelocity::Kind::slip) {
            for (const BoundaryEdge& edge : mesh.patches[p].edges) {
                const auto [a, b] = edge.node;
                const double length = std::hypot(mesh.r[b] - mesh.r[a], mesh.z[b] - mesh.z[a]);
                const std::array<double, 2> normal{(mesh.z[b] - mesh.z[a]) / length,
                                                   -(mesh.r[b] - mesh.r[a]) / length};
                hold(a, normal);
                hold(b, normal);
            }
        } else if (found->second->kind == PatchVelocity::Kind::traction ||
                   found->second->kind == PatchVelocity::Kind::pressure) {
            loaded_.emplace_back(p, found->second);
        }
    }
    for (const BoundaryPatch& patch : mesh.patches) {
        const auto found = patches_.find(patch.name);
        if (found != patches_.end() && found->second->kind == PatchVelocity::Kind::fixed) {
            for (const BoundaryEdge& edge : patch.edges) {
                for (const int i : edge.node) {
                    held.insert_or_assign(i, Node{i, true, {}, &found->second->value});
                }
            }
        }
    }
    for (const auto& item : held) {
        nodes_.push_back(item.second);
    }
}

void VelocityConditions::addTractions(const BackgroundMesh& mesh, double time,
                                      std::vector<std::array<double, 2>>& force) const
{
    for (const auto& [p, condition] : loaded_) {
        const bool normalOnly = condition->kind == PatchVelocity::Kind::pressure;
        const double pressure = normalOnly ? condition->value.component[0]->value(time) : 0;
        const std::array<double, 3> traction =
            normalOnly ? std::array<double, 3>{} : condition->value.value(time);
        for (const BoundaryEdge& edge : mesh.patches[p].edges) {
            const auto [a, b] = edge.node;
            const double dr = mesh.r[b] - mesh.r[a];
            const double dz = mesh.z[b] - mesh.z[a];
            // Outward normal times length is (dz, -dr); a pressure pushes inward.
            const double length = std::hypot(dr, dz);
            const std::array<double, 2> load =
                normalOnly ? std::array<double, 2>{-pressure * dz, pressure * dr}
                           : std::array<double, 2>{traction[0] * length, traction[2] * length};
            const bool axisymmetric = mesh.geometry == Geometry::axisymmetric;
            // integral of N r ds over the edge per length: (2 r_self + r_other)/6
            const double weightA = axisymmetric ? (2 * mesh.r[a] + mesh.r[b]) / 6 : 0.5;
            const double weightB = axisymmetric ? (2 * mesh.r[b] + mesh.r[a]) / 6 : 0.5;
            for (int k = 0; k < 2; ++k) {
                force[a][k] += weightA * load[k];
                force[b][k] += weightB * load[k];
            }
        }
    }
}

} // namespace caisson
