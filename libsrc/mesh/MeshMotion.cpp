#include "mesh/MeshMotion.h"

#include "dictionary/Text.h"

#include <limits>

namespace caisson {

MeshMotion::MeshMotion(MeshMotionHeights heights, std::string body)
    : heights_(heights), body_(std::move(body)), moves_(true)
{
}

double MeshMotion::weight(double referenceZ) const
{
    const auto& [bottom, movingBottom, movingTop, top] = heights_;
    if (!moves_ || referenceZ <= bottom || referenceZ >= top) {
        return 0;
    }
    if (referenceZ < movingBottom) {
        return (referenceZ - bottom) / (movingBottom - bottom);
    }
    if (referenceZ > movingTop) {
        return (top - referenceZ) / (top - movingTop);
    }
    return 1;
}

void MeshMotion::place(BackgroundMesh& mesh, const std::vector<double>& referenceZ, double displacement) const
{
    if (!moves_) {
        return;
    }
    for (std::size_t i = 0; i < referenceZ.size(); ++i) {
        mesh.z[i] = referenceZ[i] + weight(referenceZ[i]) * displacement;
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
