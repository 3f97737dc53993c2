#include "mesh/MeshMotion.h"

#include "dictionary/Text.h"

#include <algorithm>
#include <array>
#include <limits>

namespace caisson {

MeshMotion::MeshMotion(MeshMotionHeights heights, std::string body)
    : heights_(heights), body_(std::move(body)), moves_(true)
{
}

namespace {

/// Without branches, for loops over nodes.
double weightOf(const MeshMotionHeights& heights, double z)
{
    const double rise = (z - heights.bottom) / (heights.movingBottom - heights.bottom);
    const double fall = (heights.top - z) / (heights.top - heights.movingTop);
    const double least = rise < fall ? rise : fall;
    const double weight = least < 1 ? least : 1;
    return ((z > heights.bottom) & (z < heights.top)) ? weight : 0;
}

} // namespace

double MeshMotion::weight(double referenceZ) const { return moves_ ? weightOf(heights_, referenceZ) : 0; }

void MeshMotion::place(BackgroundMesh& mesh, const std::vector<double>& referenceZ, double displacement) const
{
    place(mesh, referenceZ, displacement, 0, static_cast<int>(referenceZ.size()));
}

void MeshMotion::place(BackgroundMesh& mesh, const std::vector<double>& referenceZ, double displacement,
                       int begin, int end) const
{
    if (!moves_) {
        return;
    }
    const MeshMotionHeights heights = heights_; // a copy cannot change with the nodes
    for (int i = begin; i < end; ++i) {
        mesh.z[i] = referenceZ[i] + weightOf(heights, referenceZ[i]) * displacement;
    }
}

DisplacementRange MeshMotion::allowedDisplacements() const
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!moves_) {
        return {-infinity, infinity};
    }
    // A zone that has no height has no cells either, and allows no displacement across it.
    return {-(1 - leastHeight) * (heights_.movingBottom - heights_.bottom),
            (1 - leastHeight) * (heights_.top - heights_.movingTop)};
}

double MeshMotion::readDisplacement(const KeywordReader& reader, const char* key) const
{
    const double displacement = reader.number(key);
    const DisplacementRange range = allowedDisplacements();
    if (!moves_) {
        reader.problem(key, "the mesh of this case rests",
                       "leave the key out, or let the mesh follow a body: constant/dynamicMeshDict");
    } else if (displacement < range.lowest || displacement > range.highest) {
        reader.problem(key, "the mesh cannot move as far",
                       text("its displacement may be %.4g to %.4g m, see constant/dynamicMeshDict",
                            range.lowest, range.highest));
        return 0;
    }
    return displacement;
}

namespace {

/// The box around a cell, its mean height, and how its lower and upper side follow the motion.
struct CellExtent
{
    std::array<double, 2> r, z;
    double height;
    std::array<double, 2> weight;
};

std::vector<CellExtent> cellExtents(const BackgroundMesh& mesh, const MeshMotion& motion)
{
    std::vector<CellExtent> extents;
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        CellExtent extent{{infinity, -infinity}, {infinity, -infinity}, 0, {}};
        for (int k = 0; k < mesh.corners; ++k) {
            const int node = mesh.node(cell, k);
            extent.r = {std::min(extent.r[0], mesh.r[node]), std::max(extent.r[1], mesh.r[node])};
            extent.z = {std::min(extent.z[0], mesh.z[node]), std::max(extent.z[1], mesh.z[node])};
        }
        extent.height = cellArea(mesh, cell) / (extent.r[1] - extent.r[0]);
        extent.weight = {motion.weight(extent.z[0]), motion.weight(extent.z[1])};
        extents.push_back(extent);
    }
    return extents;
}

/// Cuts from the interval what does not fulfil constant + slope t > 0.
void keepPositive(double constant, double slope, std::array<double, 2>& interval)
{
    if (slope > 0) {
        interval[0] = std::max(interval[0], -constant / slope);
    } else if (slope < 0) {
        interval[1] = std::min(interval[1], -constant / slope);
    } else if (constant <= 0) {
        interval[1] = -1;
    }
}

} // namespace

std::vector<double> MeshMotion::passingHeights(const BackgroundMesh& mesh, double displacement) const
{
    const std::vector<CellExtent> all = cellExtents(mesh, *this);
    std::vector<CellExtent> moving = all;
    std::erase_if(moving, [](const CellExtent& cell) { return cell.weight[0] == 0 && cell.weight[1] == 0; });
    std::vector<double> heights;
    for (const CellExtent& here : all) {
        double least = here.height;
        const double width = 1e-6 * (here.r[1] - here.r[0]);
        const double edge = 1e-6 * here.height; // cells that only touch do not come by
        for (const CellExtent& other : moving) {
            if (other.height >= least || other.r[0] >= here.r[1] - width || other.r[1] <= here.r[0] + width) {
                continue;
            }
            std::array<double, 2> passing = {0, 1}; // parts of the displacement
            keepPositive(here.z[1] - edge - other.z[0], -other.weight[0] * displacement, passing);
            keepPositive(other.z[1] - here.z[0] - edge, other.weight[1] * displacement, passing);
            if (passing[0] < passing[1]) {
                const double stretch =
                    (other.weight[1] - other.weight[0]) * displacement / (other.z[1] - other.z[0]);
                const double factor = 1 + std::min(stretch * passing[0], stretch * passing[1]);
                least = std::min(least, other.height * std::max(1.0, factor));
            }
        }
        heights.push_back(least);
    }
    return heights;
}

std::span<const Keyword> meshMotionKeywords()
{
    static constexpr Keyword table[] = {
        {"type", "word", "", "none followBody",
         "none: the mesh rests, and no other key is needed; followBody: it follows a body"},
        {"body", "word", "", "", "name of the body in constant/bodies that the mesh follows"},
        {"bottom", "m", "", "", "level below which the mesh rests"},
        {"movingBottom", "m", "", "", "lower end of the zone that moves with the body"},
        {"movingTop", "m", "", "", "upper end of the zone that moves with the body"},
        {"top", "m", "", "", "level above which the mesh rests"},
    };
    return table;
}

MeshMotion readMeshMotion(const Dictionary& dynamicMeshDict, InputProblems& problems)
{
    const KeywordReader reader(dynamicMeshDict, meshMotionKeywords(), "dynamicMeshDict", problems);
    if (reader.word("type") != "followBody") {
        return {};
    }
    const std::string body = reader.word("body");
    const MeshMotionHeights heights = {reader.number("bottom"), reader.number("movingBottom"),
                                       reader.number("movingTop"), reader.number("top")};
    const bool complete = reader.has("body") && reader.has("bottom") && reader.has("movingBottom") &&
                          reader.has("movingTop") && reader.has("top");
    if (!complete) {
        return {};
    }
    if (!(heights.bottom < heights.movingBottom && heights.movingBottom < heights.movingTop &&
          heights.movingTop < heights.top)) {
        reader.problem("movingBottom", "the levels of the moving mesh must ascend",
                       text("bottom %g < movingBottom %g < movingTop %g < top %g does not hold",
                            heights.bottom, heights.movingBottom, heights.movingTop, heights.top));
        return {};
    }
    return MeshMotion(heights, body);
}

} // namespace caisson
