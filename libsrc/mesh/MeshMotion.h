#pragma once

#include "dictionary/KeywordReader.h"
#include "mesh/BackgroundMesh.h"

#include <span>
#include <string>
#include <vector>

namespace caisson {

/// Levels of the moving mesh, as the mesh of constant/polyMesh has them [m], ascending.
struct MeshMotionHeights
{
    double bottom = 0;       ///< the mesh rests from here downwards
    double movingBottom = 0; ///< from here ...
    double movingTop = 0;    ///< ... to here it moves with the body
    double top = 0;          ///< the mesh rests from here upwards
};

/// Displacements of the moving zone [m], upward positive.
struct DisplacementRange
{
    double lowest = 0;
    double highest = 0;
};

/// Vertical motion of the mesh that follows a body: rigid between movingBottom and movingTop, linear in the
/// stretched zones beside them, none beyond bottom and top.
class MeshMotion
{
public:
    /// Stretched zones keep this part of their height at least.
    static constexpr double leastHeight = 0.02;

    MeshMotion() = default; ///< the mesh rests
    explicit MeshMotion(MeshMotionHeights heights, std::string body = {});

    [[nodiscard]] bool moves() const { return moves_; }
    [[nodiscard]] const std::string& body() const { return body_; } ///< name of the body that is followed
    [[nodiscard]] const MeshMotionHeights& heights() const { return heights_; }

    /// Moves the nodes to where a displacement [m] of the moving zone from `referenceZ` (z of the nodes of
    /// constant/polyMesh) puts them: a function of the displacement alone, so that nothing drifts.
    void place(BackgroundMesh& mesh, const std::vector<double>& referenceZ, double displacement) const;
    /// The same for the nodes from `begin` to before `end`.
    void place(BackgroundMesh& mesh, const std::vector<double>& referenceZ, double displacement, int begin,
               int end) const;

    /// Part of the moving zone's displacement that a node at `referenceZ` takes, 0 to 1.
    [[nodiscard]] double weight(double referenceZ) const;

    /// Displacements for which no stretched zone falls below `leastHeight` of its height in
    /// constant/polyMesh.
    [[nodiscard]] DisplacementRange allowedDisplacements() const;

    /// A displacement [m] that a user names under `key`; a problem where the mesh rests or cannot go there.
    [[nodiscard]] double readDisplacement(const KeywordReader& reader, const char* key) const;

    /// For the place of each cell of the mesh at rest: the least height [m] of the cells that come by while
    /// the moving zone goes from 0 to `displacement`. Rows that are pressed together count as they are at
    /// rest.
    [[nodiscard]] std::vector<double> passingHeights(const BackgroundMesh& mesh, double displacement) const;

private:
    MeshMotionHeights heights_;
    std::string body_;
    bool moves_ = false;
};

/// Keys of constant/dynamicMeshDict.
std::span<const Keyword> meshMotionKeywords();

/// Reads constant/dynamicMeshDict: `type none;` or
/// `type followBody; body caisson; bottom -10; movingBottom -0.8; movingTop -0.35; top 0;`.
MeshMotion readMeshMotion(const Dictionary& dynamicMeshDict, InputProblems& problems);

} // namespace caisson
