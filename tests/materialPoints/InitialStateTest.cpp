#include "materialPoints/InitialState.h"

#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace caisson;
using namespace caisson::testing;

namespace {

constexpr std::array<double, 2> gravity = {0, -9.81};

class InitialStates : public ::testing::Test
{
protected:
    InitialStates()
    {
        const Dictionary dictionary = parseDictionary(
            "sand { law linearElastic; porosity 0.35; solidDensity 2650; youngsModulus 6e7; poissonsRatio "
            "0.2; }"
            "clay { law linearElastic; porosity 0.5; solidDensity 2700; youngsModulus 5e6; poissonsRatio "
            "0.4; }"
            "sandAgain { law linearElastic; porosity 0.35; solidDensity 2650; youngsModulus 5e6;"
            "  poissonsRatio 0.4; }");
        materials = readMaterials(dictionary, problems);
    }

    void fill(const std::string& regions)
    {
        const Dictionary dictionary = parseDictionary("regions (" + regions + ");");
        const auto read =
            readSeedRegions(dictionariesIn(*dictionary.find("regions"), problems), mesh, materials, problems);
        seeded = seedPoints(mesh, read, materials, {}, problems);
        ASSERT_TRUE(problems.empty()) << problems.all()[0].message;
    }

    void setStress(const std::string& state, const std::array<double, 2>& g = gravity)
    {
        const Dictionary dictionary = parseDictionary(state, "setMaterialPointsDict");
        setInitialStress(seeded, materials, readInitialState(dictionary, problems), g, problems);
    }

    [[nodiscard]] std::string messages() const
    {
        std::string all;
        for (const InputProblem& problem : problems.all()) {
            all += problem.message + "; ";
        }
        return all;
    }

    BackgroundMesh mesh =
        structuredMesh(evenLines(0, 2, 2), {-9, -7, -4, -2.5, -1, 0}, Geometry::axisymmetric);
    std::vector<Material> materials;
    SeededPoints seeded;
    InputProblems problems;
};

} // namespace

TEST_F(InitialStates, K0CarriesTheSubmergedWeightAndTheOverburden)
{
    fill("{ type all; material sand; }");
    setStress("type K0; K0 0.384; surfaceLevel 0; overburden 500;");
    ASSERT_EQ(messages(), "");
    const double unitWeight = 0.65 * 1650 * 9.81;
    for (std::size_t p = 0; p < seeded.points.size(); ++p) {
        const double vertical = -(500 - unitWeight * seeded.points.z[p]);
        EXPECT_NEAR(seeded.points.stress[1][p], vertical, 1e-10) << "1e5 Pa to rounding";
        EXPECT_NEAR(seeded.points.stress[0][p], 0.384 * vertical, 1e-10);
        EXPECT_NEAR(seeded.points.stress[2][p], 0.384 * vertical, 1e-10);
        EXPECT_EQ(seeded.points.stress[3][p], 0);
    }
}

TEST_F(InitialStates, K0IntegratesTheWeightThroughHorizontalLayers)
{
    // The order of the regions does not matter, and neither does a material of equal weight in between.
    fill("{ type box; min (0 -9); max (2 -7); material sand; pointsPerCell (2 3); }"
         "{ type box; min (0 -7); max (1 -4); material sandAgain; }"
         "{ type box; min (1 -7); max (2 -4); material sand; }"
         "{ type box; min (0 -4); max (2 -1); material clay; }"
         "{ type box; min (0 -1); max (2 0); material sand; pointsPerCell (1 1); }");
    setStress("type K0; K0 0.5; surfaceLevel 0;");
    // Sand above and below clay: the materials are no layers.
    EXPECT_NE(messages().find("horizontal layers"), std::string::npos) << messages();

    problems = {};
    fill("{ type box; min (0 -9); max (2 -4); material sand; pointsPerCell (2 3); }"
         "{ type box; min (0 -7); max (1 -4); material sandAgain; }"
         "{ type box; min (0 -4); max (2 0); material clay; pointsPerCell (1 1); }");
    setStress("type K0; K0 0.5; surfaceLevel 0;");
    ASSERT_EQ(messages(), "");
    const double clay = 0.5 * 1700 * 9.81;
    const double sand = 0.65 * 1650 * 9.81;
    for (std::size_t p = 0; p < seeded.points.size(); ++p) {
        const double z = seeded.points.z[p];
        const double vertical = z > -4 ? clay * z : -clay * 4 + sand * (z + 4);
        EXPECT_NEAR(seeded.points.stress[1][p], vertical, 1e-9) << "z = " << z;
        EXPECT_NEAR(seeded.points.stress[2][p], vertical / 2, 1e-9);
    }
}

TEST_F(InitialStates, K0RefusesMaterialsSideBySide)
{
    fill("{ type all; material sand; } { type box; min (1 -4); max (2 0); material clay; }");
    setStress("type K0; K0 0.5; surfaceLevel 0;");
    EXPECT_NE(messages().find("horizontal layers"), std::string::npos) << messages();
}

TEST_F(InitialStates, K0RefusesPointsAboveTheSurfaceAndSidewaysGravity)
{
    fill("{ type all; material sand; }");
    setStress("type K0; K0 0.5; surfaceLevel -1;");
    EXPECT_NE(messages().find("8 points lie above surfaceLevel -1, up to z = -0.25"), std::string::npos)
        << messages();
    problems = {};
    setStress("type K0; K0 0.5; surfaceLevel 0;", {0.1, -9.81});
    EXPECT_NE(messages().find("gravity along -z"), std::string::npos) << messages();
}

TEST_F(InitialStates, K0RefusesASurfaceAboveTheSoil)
{
    fill("{ type box; min (0 -9); max (2 -1); material sand; }");
    setStress("type K0; K0 0.5; surfaceLevel 0;");
    EXPECT_EQ(messages(), "the soil reaches up to z = -1 only, not to surfaceLevel 0; ");
    EXPECT_EQ(seeded.points.stress[1], std::vector<double>(seeded.points.size(), 0));

    // A surface that cuts cells lies above the uppermost sub-cells: 0.5 m high, their next row has its
    // centres at -0.75, above the surface.
    problems = {};
    fill("{ type box; min (0 -9); max (2 -0.8); material sand; }");
    setStress("type K0; K0 0.5; surfaceLevel -0.8;");
    EXPECT_EQ(messages(), "");
}

TEST_F(InitialStates, uniformAndZeroStress)
{
    fill("{ type all; material sand; }");
    setStress("type uniform; stress (-1e3 -2e3 -1.5e3 100);");
    ASSERT_EQ(messages(), "");
    EXPECT_EQ(seeded.points.stress[0], std::vector<double>(seeded.points.size(), -1e3));
    EXPECT_EQ(seeded.points.stress[1], std::vector<double>(seeded.points.size(), -2e3));
    EXPECT_EQ(seeded.points.stress[2], std::vector<double>(seeded.points.size(), -1.5e3));
    EXPECT_EQ(seeded.points.stress[3], std::vector<double>(seeded.points.size(), 100));
    setStress("type zero;");
    EXPECT_EQ(seeded.points.stress[1], std::vector<double>(seeded.points.size(), 0));
}

TEST_F(InitialStates, everyMistakeIsAProblem)
{
    const auto problemsOf = [this](const std::string& state) {
        problems = {};
        const Dictionary dictionary = parseDictionary(state, "setMaterialPointsDict");
        readInitialState(dictionary, problems);
        return messages();
    };
    EXPECT_EQ(problemsOf("type k0; K0 0.5;"), "unknown word 'k0' for type of initialState; ");
    EXPECT_EQ(problemsOf("K0 0.5;"), "missing key 'type' in initialState; ");
    EXPECT_EQ(problemsOf("type K0; K0 -1; surfaceLevel 0;"), "K0 -1 is outside [0, inf); ");
    EXPECT_EQ(problemsOf("type K0; K0 1;"), "missing key 'surfaceLevel' in initialState; ");
    EXPECT_EQ(problemsOf("type uniform; stress (1 2 3);"), "'stress' has 3 numbers, not four; ");
    EXPECT_EQ(problemsOf("type zero; K0 1;"), "unknown key 'K0' in initialState; ");
}
