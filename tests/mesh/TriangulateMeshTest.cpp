#include "mesh/TriangulateMesh.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace caisson;
using namespace caisson::testing;

namespace {

/// The triangulated mesh as the solver reads it.
BackgroundMesh triangles(const PolyMesh& quadrilaterals)
{
    InputProblems problems;
    BackgroundMesh mesh = buildBackgroundMesh(triangulated(quadrilaterals, problems), problems);
    problems.throwIfAny("the mesh");
    return mesh;
}

/// Volume per radian or per metre.
double volume(const BackgroundMesh& mesh)
{
    double sum = 0;
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        sum += cellVolume(mesh, cell);
    }
    return sum;
}

} // namespace

TEST(TriangulateMesh, volumeNodesAndPatchesStay)
{
    for (const Geometry geometry : {Geometry::axisymmetric, Geometry::planeStrain}) {
        const BackgroundMesh before = structuredMesh(evenLines(0, 2, 5), evenLines(-1, 0.5, 4), geometry);
        const BackgroundMesh after = triangles(layerOf(before));
        EXPECT_EQ(after.corners, 3);
        EXPECT_EQ(after.cells(), 2 * before.cells());
        EXPECT_EQ(after.nodes(), before.nodes());
        EXPECT_NEAR(volume(after) / volume(before), 1, 1e-14) << "rounding";
        for (const BoundaryPatch& patch : before.patches) {
            const auto same = std::ranges::find(after.patches, patch.name, &BoundaryPatch::name);
            ASSERT_NE(same, after.patches.end()) << patch.name;
            EXPECT_EQ(same->edges.size(), patch.edges.size()) << patch.name;
        }
    }
}

TEST(TriangulateMesh, diagonalsAlternate)
{
    const BackgroundMesh mesh =
        triangles(layerOf(structuredMesh(evenLines(0, 4, 4), evenLines(0, 4, 4), Geometry::planeStrain)));
    for (int node = 0; node < mesh.nodes(); ++node) {
        const double r = mesh.r[node], z = mesh.z[node];
        if (r > 0.5 && r < 3.5 && z > 0.5 && z < 3.5) {
            const int around = mesh.nodeCells.start[node + 1] - mesh.nodeCells.start[node];
            EXPECT_TRUE(around == 4 || around == 8)
                << around << " triangles at (" << r << " " << z << "), expected 4 or 8";
        }
    }
}

TEST(TriangulateMesh, trianglesAreRefused)
{
    const PolyMesh mesh =
        layerOf(structuredMesh(evenLines(0, 2, 2), evenLines(0, 2, 2), Geometry::planeStrain, true));
    InputProblems problems;
    triangulated(mesh, problems);
    ASSERT_EQ(problems.all().size(), 1U);
    EXPECT_EQ(problems.all()[0].message, "the cells of the mesh are triangles already");
    EXPECT_EQ(problems.all()[0].hint,
              "triangulateMesh starts from quadrilaterals; run blockMesh again to start anew");
}
