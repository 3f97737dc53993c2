#include "materialPoints/StateTransfer.h"

#include "dictionary/Text.h"
#include "mesh/CellLocator.h"

#include <algorithm>
#include <limits>

namespace caisson {

namespace {

/// Earlier points by the cell of the mesh that holds them, those outside left aside.
std::vector<std::vector<int>> sortIntoCells(const BackgroundMesh& mesh, const MaterialPoints& earlier)
{
    const CellLocator locator(mesh);
    std::vector<std::vector<int>> inCell(mesh.cells());
    for (std::size_t p = 0; p < earlier.size(); ++p) {
        const int cell = locator.find(earlier.r[p], earlier.z[p]);
        if (cell >= 0) {
            inCell[cell].push_back(static_cast<int>(p));
        }
    }
    return inCell;
}

/// Per material now: the earlier one of its name, or -1, and for each variable the earlier one or -1.
struct Match
{
    int material = -1;
    std::vector<int> variables;
};

std::vector<Match> matchMaterials(const std::vector<Material>& materials,
                                  const std::vector<Material>& earlier)
{
    std::vector<Match> matches(materials.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const auto found = std::ranges::find(earlier, materials[m].name, &Material::name);
        if (found == earlier.end()) {
            continue;
        }
        matches[m].material = static_cast<int>(found - earlier.begin());
        const std::vector<std::string>& before = found->law->stateNames();
        for (const std::string& name : materials[m].law->stateNames()) {
            const auto place = std::ranges::find(before, name);
            matches[m].variables.push_back(place == before.end() ? -1
                                                                 : static_cast<int>(place - before.begin()));
        }
    }
    return matches;
}

} // namespace

void takeEarlierState(MaterialPoints& points, const std::vector<Material>& materials,
                      const BackgroundMesh& mesh, const EarlierPoints& earlier, const SourceLocation& where,
                      InputProblems& problems)
{
    const MaterialPoints& from = earlier.points;
    const std::vector<std::vector<int>> inCell = sortIntoCells(mesh, from);
    const std::vector<Match> matches = matchMaterials(materials, earlier.materials);
    std::size_t lost = 0;
    std::size_t example = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Match& match = matches[points.material[p]];
        int nearest = -1;
        double least = std::numeric_limits<double>::max();
        for (int corner = 0; corner < mesh.corners; ++corner) {
            const int node = mesh.node(points.cell[p], corner);
            for (int k = mesh.nodeCells.start[node]; k < mesh.nodeCells.start[node + 1]; ++k) {
                for (const int q : inCell[mesh.nodeCells.item[k] / mesh.corners]) {
                    const double dr = from.r[q] - points.r[p];
                    const double dz = from.z[q] - points.z[p];
                    const double distance = dr * dr + dz * dz;
                    const bool nearer = distance < least ||
                                        (distance == least && nearest >= 0 && from.id[q] < from.id[nearest]);
                    if (from.material[q] == match.material && nearer) {
                        nearest = q;
                        least = distance;
                    }
                }
            }
        }
        if (nearest < 0) {
            example = lost == 0 ? p : example;
            ++lost;
            continue;
        }
        for (std::size_t j = 0; j < points.stress.size(); ++j) {
            points.stress[j][p] = from.stress[j][nearest];
        }
        for (std::size_t k = 0; k < match.variables.size(); ++k) {
            if (match.variables[k] >= 0) {
                points.state[k][p] = from.state[match.variables[k]][nearest];
            }
        }
    }
    if (lost > 0) {
        problems.add(
            where,
            text("%zu of %zu points have no earlier one of their material in their cell or next to it, "
                 "the first at r = %g, z = %g in '%s'",
                 lost, points.size(), points.r[example], points.z[example],
                 materials[points.material[example]].name.c_str()),
            "fill the same places with materials of the same names as the earlier run had there");
    }
}

} // namespace caisson
