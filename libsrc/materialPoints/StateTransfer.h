#pragma once

#include "constitutive/Material.h"
#include "materialPoints/MaterialPoints.h"
#include "mesh/BackgroundMesh.h"

namespace caisson {

/// Points as an earlier run left them, with the materials that it had.
struct EarlierPoints
{
    MaterialPoints points;
    std::vector<Material> materials;
};

/// Gives points the stress and the state variables of the nearest point that an earlier run left in the same
/// material: materials match by their names, variables by theirs within a material. Variables that the
/// earlier law did not have keep their values.
/// Points without an earlier one of their material in their cell or one that shares a node with it become a
/// problem.
/// @param points  with cells of `mesh`; the earlier ones may lie outside the mesh
/// @param where   of the initial state in its dictionary, for the problem
void takeEarlierState(MaterialPoints& points, const std::vector<Material>& materials,
                      const BackgroundMesh& mesh, const EarlierPoints& earlier, const SourceLocation& where,
                      InputProblems& problems);

} // namespace caisson
