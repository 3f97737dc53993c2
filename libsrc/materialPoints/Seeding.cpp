#include "materialPoints/Seeding.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <limits>

namespace caisson {

namespace {

class Seeding
{
public:
    Seeding(const BackgroundMesh& mesh, const std::vector<SeedRegion>& regions,
            const std::vector<Material>& materials, const std::function<bool(double, double)>& insideBody)
        : mesh_(mesh), regions_(regions), materials_(materials), insideBody_(insideBody)
    {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        result_.regions.resize(regions.size());
        result_.extent.assign(materials.size(), {infinity, -infinity, infinity, -infinity});
        std::size_t variables = 0;
        for (const Material& material : materials) {
            variables = std::max(variables, material.law->initialState().size());
        }
        result_.points.state.resize(variables);
        for (const SeedRegion& region : regions) {
            std::vector<bool>& reaches = reaches_.emplace_back(mesh.cells(), false);
            for (const int cell : region.cells(mesh)) {
                reaches[cell] = true;
            }
        }
    }

    SeededPoints fill()
    {
        for (int cell = 0; cell < mesh_.cells(); ++cell) {
            double r = 0, z = 0;
            for (int k = 0; k < mesh_.corners; ++k) {
                r += mesh_.r[mesh_.node(cell, k)] / mesh_.corners;
                z += mesh_.z[mesh_.node(cell, k)] / mesh_.corners;
            }
            const std::size_t before = result_.points.size();
            std::vector<std::size_t> reaching;
            for (std::size_t i = 0; i < regions_.size() && !insideBody(r, z); ++i) {
                if (reaches_[i][cell] && fillCell(cell, i, r, z)) {
                    reaching.push_back(i);
                }
            }
            for (std::size_t k = 0; result_.points.size() == before && k < reaching.size(); ++k) {
                ++result_.regions[reaching[k]].emptyCells;
            }
        }
        return std::move(result_);
    }

private:
    [[nodiscard]] bool insideBody(double r, double z) const { return insideBody_ && insideBody_(r, z); }

    /// @returns whether the region has a part in the cell, beyond the rounding of lines that should coincide
    bool fillCell(int cell, std::size_t i, double centreR, double centreZ)
    {
        const SeedRegion& region = regions_[i];
        const double within = region.volumeWithin(mesh_, cell);
        if (!(within > 0)) {
            return false;
        }
        result_.regions[i].exactVolume += within;
        CellDivision division = region.division;
        std::array<double, 2> maxSpacing;
        maxSpacing.fill(std::numeric_limits<double>::infinity());
        for (const SeedRefinement& refinement : region.refinements) {
            if (centreR >= refinement.low[0] && centreR <= refinement.high[0] &&
                centreZ >= refinement.low[1] && centreZ <= refinement.high[1]) {
                division = finer(division, refinement.division);
                for (const int direction : {0, 1}) {
                    maxSpacing[direction] = std::min(maxSpacing[direction], refinement.maxSpacing[direction]);
                }
            }
        }
        if (!region.passingHeight.empty()) {
            constexpr double rounding = 1 + 1e-6;
            const int rows = mesh_.corners == 4 ? division.along[1] : 1;
            maxSpacing[1] = std::min(maxSpacing[1], rounding * region.passingHeight[cell] / rows);
        }
        division = refined(mesh_, cell, division, maxSpacing);
        for (const SubCell& subCell : subdivide(mesh_, cell, division)) {
            if (!region.contains(subCell.r, subCell.z) || insideBody(subCell.r, subCell.z)) {
                continue;
            }
            result_.regions[i].coveredVolume += subCell.volume;
            if (!takenLater(cell, i, subCell)) {
                add(cell, i, subCell);
            }
        }
        return within > 1e-6 * cellVolume(mesh_, cell);
    }

    [[nodiscard]] bool takenLater(int cell, std::size_t i, const SubCell& subCell) const
    {
        for (std::size_t later = i + 1; later < regions_.size(); ++later) {
            if (reaches_[later][cell] && regions_[later].contains(subCell.r, subCell.z)) {
                return true;
            }
        }
        return false;
    }

    void add(int cell, std::size_t i, const SubCell& subCell)
    {
        const SeedRegion& region = regions_[i];
        const Material& material = materials_[region.material];
        MaterialPoints& points = result_.points;
        const double mass = material.inertialDensity() * subCell.volume;
        points.id.push_back(static_cast<int>(points.size()));
        points.r.push_back(subCell.r);
        points.z.push_back(subCell.z);
        points.initialR.push_back(subCell.r);
        points.initialZ.push_back(subCell.z);
        points.vr.push_back(region.velocityR ? region.velocityR->value(subCell.r) : 0);
        points.vz.push_back(region.velocityZ ? region.velocityZ->value(subCell.z) : 0);
        points.mass.push_back(mass);
        points.volume.push_back(subCell.volume);
        points.cell.push_back(cell);
        points.material.push_back(region.material);
        for (std::vector<double>& component : points.stress) {
            component.push_back(0);
        }
        const std::vector<double> initial = material.law->initialState();
        for (std::size_t k = 0; k < points.state.size(); ++k) {
            points.state[k].push_back(k < initial.size() ? initial[k] : 0);
        }

        SeededRegion& report = result_.regions[i];
        ++report.points;
        report.volume += subCell.volume;
        report.mass += mass;
        MaterialExtent& extent = result_.extent[region.material];
        extent.lowest = std::min(extent.lowest, subCell.lowest);
        extent.highest = std::max(extent.highest, subCell.highest);
        extent.lowestPoint = std::min(extent.lowestPoint, subCell.z);
        extent.highestPoint = std::max(extent.highestPoint, subCell.z);
    }

    const BackgroundMesh& mesh_;
    const std::vector<SeedRegion>& regions_;
    const std::vector<Material>& materials_;
    const std::function<bool(double, double)>& insideBody_;
    std::vector<std::vector<bool>> reaches_; ///< [region][cell]
    SeededPoints result_;
};

std::string emptinessOf(const SeededRegion& region)
{
    if (region.exactVolume == 0) {
        return "the region meets no cell of the mesh outside the bodies";
    }
    if (region.coveredVolume == 0) {
        return "the region is smaller than the sub-cells of the points, none of which has its centre in it";
    }
    return "all of the region belongs to later regions, which win where regions overlap";
}

} // namespace

SeededPoints seedPoints(const BackgroundMesh& mesh, const std::vector<SeedRegion>& regions,
                        const std::vector<Material>& materials,
                        const std::function<bool(double, double)>& insideBody, InputProblems& problems)
{
    SeededPoints result = Seeding(mesh, regions, materials, insideBody).fill();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (result.regions[i].points == 0) {
            const auto [lowR, highR] = std::ranges::minmax(mesh.r);
            const auto [lowZ, highZ] = std::ranges::minmax(mesh.z);
            problems.add(regions[i].where, emptinessOf(result.regions[i]),
                         text("the mesh reaches from (%g %g) to (%g %g)", lowR, lowZ, highR, highZ));
        }
    }
    return result;
}

} // namespace caisson
