#include "mesh/MeshMotion.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace caisson;
using namespace caisson::testing;

namespace {

const MeshMotionHeights heights = {-10, -0.8, -0.3, 0.5};

BackgroundMesh column()
{
    return structuredMesh(evenLines(0, 1, 2), evenLines(-20, 1, 210), Geometry::axisymmetric);
}

MeshMotion read(const std::string& text, InputProblems& problems)
{
    const Dictionary dictionary = parseDictionary(text, "constant/dynamicMeshDict");
    return readMeshMotion(dictionary, problems);
}

} // namespace

TEST(MeshMotion, zonesRestMoveAndStretchLinearly)
{
    BackgroundMesh mesh = column();
    const std::vector<double> reference = mesh.z;
    const std::vector<double> r = mesh.r;
    const MeshMotion motion(heights, "caisson");
    constexpr double displacement = -1.7;
    motion.place(mesh, reference, displacement);
    EXPECT_EQ(mesh.r, r);
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double z = reference[i];
        const double expected = z <= -10 || z >= 0.5 ? z
                                : z < -0.8           ? z + displacement * (z + 10) / 9.2
                                : z > -0.3           ? z + displacement * (0.5 - z) / 0.8
                                                     : z + displacement;
        EXPECT_NEAR(mesh.z[i], expected, 1e-14) << "node that was at " << z;
    }
}

TEST(MeshMotion, placesAreAFunctionOfTheDisplacementAlone)
{
    BackgroundMesh wandering = column(), direct = column();
    const std::vector<double> reference = direct.z;
    const MeshMotion motion(heights, "caisson");
    for (int i = 0; i < 1000; ++i) {
        motion.place(wandering, reference, 0.7 * std::sin(i));
    }
    motion.place(wandering, reference, -0.25);
    motion.place(direct, reference, -0.25);
    EXPECT_EQ(wandering.z, direct.z);
    motion.place(wandering, reference, 0);
    EXPECT_EQ(wandering.z, reference);
}

TEST(MeshMotion, allowedDisplacementsLeaveTwoPerCentOfAStretchedZone)
{
    const MeshMotion motion(heights, "caisson");
    const DisplacementRange range = motion.allowedDisplacements();
    EXPECT_NEAR(range.lowest, -0.98 * 9.2, 1e-14);
    EXPECT_NEAR(range.highest, 0.98 * 0.8, 1e-15);
    BackgroundMesh mesh = column();
    const std::vector<double> reference = mesh.z;
    for (const double displacement : {range.lowest, range.highest}) {
        motion.place(mesh, reference, displacement);
        for (int c = 0; c < mesh.cells(); ++c) {
            ASSERT_GT(cellArea(mesh, c), 0) << "cell " << c << " at displacement " << displacement;
        }
    }
    EXPECT_EQ(MeshMotion().allowedDisplacements().lowest, -INFINITY);
}

TEST(MeshMotion, aMeshWithoutMotionIsLeftAlone)
{
    BackgroundMesh mesh = column();
    const std::vector<double> reference = mesh.z;
    const MeshMotion motion;
    EXPECT_FALSE(motion.moves());
    EXPECT_EQ(motion.weight(-0.5), 0);
    motion.place(mesh, reference, -1);
    EXPECT_EQ(mesh.z, reference);
}

TEST(MeshMotion, isReadFromDynamicMeshDict)
{
    InputProblems problems;
    const MeshMotion motion = read(
        "type followBody; body caisson; bottom -10; movingBottom -0.8; movingTop -0.3; top 0.5;", problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_TRUE(motion.moves());
    EXPECT_EQ(motion.body(), "caisson");
    EXPECT_EQ(motion.heights().bottom, -10);
    EXPECT_EQ(motion.heights().movingBottom, -0.8);
    EXPECT_EQ(motion.heights().movingTop, -0.3);
    EXPECT_EQ(motion.heights().top, 0.5);
    EXPECT_FALSE(read("type none;", problems).moves());
    EXPECT_TRUE(problems.empty());
}

TEST(MeshMotion, everyMistakeInDynamicMeshDictIsAProblem)
{
    const auto problemsOf = [](const std::string& text) {
        InputProblems problems;
        EXPECT_FALSE(read(text, problems).moves());
        std::string all;
        for (const InputProblem& problem : problems.all()) {
            all += problem.message + "; ";
        }
        return all;
    };
    EXPECT_EQ(problemsOf(""), "missing key 'type' in dynamicMeshDict; ");
    EXPECT_EQ(problemsOf("type followbody;"), "unknown word 'followbody' for type; ");
    EXPECT_EQ(problemsOf("type followBody; body c; bottom -10; movingTop -0.3; top 0.5;"),
              "missing key 'movingBottom' in dynamicMeshDict; ");
    EXPECT_EQ(problemsOf("type followBody; body c; bottom -10; movingBottom -0.2; movingTop -0.3; top 0.5;"),
              "the levels of the moving mesh must ascend; ");
    EXPECT_EQ(problemsOf("type none; movingBotom 3;"), "unknown key 'movingBotom' in dynamicMeshDict; ");
}

TEST(MeshMotion, passingHeightsAreThoseOfTheCellsThatComeBy)
{
    // Rows of 0.5 m but for those of 0.1 m that move; columns of two widths to keep apart.
    std::vector<double> z = evenLines(-4, -1, 6);
    for (const double level : {-0.9, -0.8, -0.7, -0.6, -0.5, 0.0}) {
        z.push_back(level);
    }
    const BackgroundMesh mesh = structuredMesh({0, 1, 1.5}, z, Geometry::axisymmetric);
    const MeshMotion motion({-4, -1, -0.5, 0}, "caisson");
    const std::vector<double> heights = motion.passingHeights(mesh, -1.2);
    for (int cell = 0; cell < mesh.cells(); ++cell) {
        const double low = mesh.z[mesh.node(cell, 0)];
        // The moving rows reach down to -2.2; on top one row of 0.5 m at rest is stretched over what they
        // leave.
        EXPECT_NEAR(heights[cell], low >= -2.5 - 1e-9 && low < -0.51 ? 0.1 : 0.5, 1e-12) << "cell at " << low;
    }
    EXPECT_NEAR(motion.passingHeights(mesh, 0)[0], 0.5, 1e-12) << "without displacement its own";
}
