#include "constitutive/Material.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace caisson {
namespace {

constexpr std::string_view sand = R"(
sand
{
    law             mohrCoulomb;
    porosity        0.35;
    solidDensity    2650;
    liquidDensity   1000;
    weight          submerged;
    youngsModulus   60e6;
    poissonsRatio   0.25;
    frictionAngle   38;
    dilatancyAngle  1;
    cohesion        0;
}
)";

std::vector<Material> read(const std::string_view text, InputProblems& problems)
{
    return readMaterials(parseDictionary(text, "constant/materialProperties"), problems);
}

std::string report(const std::string_view text)
{
    InputProblems problems;
    (void)read(text, problems);
    return formatProblems("case", problems.all());
}

std::string replaced(std::string text, const std::string_view from, const std::string_view to)
{
    const std::size_t at = text.find(from);
    if (at == std::string::npos)
        throw std::logic_error("nothing to replace");
    return text.replace(at, from.size(), to);
}

/// Every line of `expected` stands in the report of the text.
void expectReported(const std::string& text, const std::vector<std::string>& expected)
{
    const std::string reported = report(text);
    for (const std::string& line : expected)
        EXPECT_NE(reported.find(line), std::string::npos) << "expected: " << line << "\ngot:\n" << reported;
}

TEST(Materials, readTheReferenceSand)
{
    InputProblems problems;
    const std::vector<Material> materials = read(sand, problems);
    ASSERT_TRUE(problems.empty()) << formatProblems("case", problems.all());
    ASSERT_EQ(materials.size(), 1U);
    const Material& material = materials.front();
    EXPECT_EQ(material.name, "sand");
    EXPECT_DOUBLE_EQ(material.inertialDensity(), 2072.5);
    EXPECT_DOUBLE_EQ(material.weighingDensity(), 1072.5);
    EXPECT_DOUBLE_EQ(material.law->pWaveModulus(), 72e6);
    EXPECT_DOUBLE_EQ(material.law->shearModulus(), 24e6);
    EXPECT_TRUE(material.law->plastic());
    EXPECT_EQ(material.law->description(), "mohrCoulomb, E 6e+07 Pa, nu 0.25, phi 38 deg, psi 1 deg, c 0 Pa");
    EXPECT_DOUBLE_EQ(material.liquidBulkModulus, 2.2e9);
    EXPECT_EQ(material.intrinsicPermeability, 0);
}

TEST(Materials, weighBySubmergenceSaturationOrDry)
{
    InputProblems problems;
    const std::vector<Material> saturated =
        read(replaced(std::string(sand), "submerged", "saturated"), problems);
    EXPECT_DOUBLE_EQ(saturated.at(0).weighingDensity(), 2072.5);
    const std::vector<Material> dry = read(replaced(std::string(sand), "submerged", "dry"), problems);
    EXPECT_DOUBLE_EQ(dry.at(0).weighingDensity(), 1722.5);
    EXPECT_DOUBLE_EQ(dry.at(0).inertialDensity(), 1722.5);
    EXPECT_TRUE(problems.empty());
}

TEST(Materials, keepTheOrderOfTheFileAndKnowEveryLaw)
{
    InputProblems problems;
    const std::vector<Material> materials = read(R"(
steel { law linearElastic; weight dry; solidDensity 7850; youngsModulus 210e9; poissonsRatio 0.3; }
rubber { law neoHookean; weight dry; solidDensity 1000; youngsModulus 1e6; poissonsRatio 0.49; }
clay { law tresca; porosity 0.5; solidDensity 2700; youngsModulus 1e7; poissonsRatio 0.49;
       undrainedShearStrength 20e3; })",
                                                 problems);
    ASSERT_TRUE(problems.empty()) << formatProblems("case", problems.all());
    ASSERT_EQ(materials.size(), 3U);
    EXPECT_EQ(materials[0].name, "steel");
    EXPECT_DOUBLE_EQ(materials[0].weighingDensity(), 7850);
    EXPECT_FALSE(materials[0].law->plastic());
    EXPECT_EQ(materials[1].law->stateNames().size(), materials[1].law->initialState().size());
    EXPECT_EQ(materials[2].law->description(), "tresca, E 1e+07 Pa, nu 0.49, c 20000 Pa");
    for (const std::string& type : constitutiveLawTypes())
        EXPECT_GE(materialKeywords(type).size(), constitutiveLawKeywords(type).size());
}

TEST(Materials, reportEveryProblemInOneRunWithTheNearestValidWord)
{
    std::string text = replaced(std::string(sand), "frictionAngle   38", "frictionAngel   38");
    text = replaced(text, "porosity        0.35", "porosity        1.35");
    text = replaced(text, "poissonsRatio   0.25", "poissonsRatio   0.5");
    expectReported(text, {"unknown key 'frictionAngel' in 'sand'", "did you mean 'frictionAngle'?",
                          "porosity 1.35 is outside (0, 1)", "poissonsRatio 0.5 is outside (-1, 0.5)",
                          "constant/materialProperties:5"});
}

TEST(Materials, answerAnUnknownLawWithTheValidOnes)
{
    const std::string text = replaced(std::string(sand), "mohrCoulomb", "morhCoulomb");
    expectReported(text,
                   {"'morhCoulomb'", "did you mean 'mohrCoulomb'?", "linearElastic", "neoHookean", "tresca"});
    EXPECT_EQ(report(text).find("unknown key"), std::string::npos) << "one mistake, one problem";
    expectReported(replaced(std::string(sand), "law             mohrCoulomb;", ""), {"law"});
}

TEST(Materials, refuseWhatTheLawCannotMean)
{
    expectReported(replaced(std::string(sand), "dilatancyAngle  1", "dilatancyAngle  39"),
                   {"dilatancyAngle is larger than frictionAngle"});
    expectReported(replaced(replaced(std::string(sand), "dilatancyAngle  1", "dilatancyAngle  -20"),
                            "poissonsRatio   0.25", "poissonsRatio   0.4999"),
                   {"so negative a dilatancyAngle"});
    expectReported(replaced(std::string(sand), "frictionAngle   38", "frictionAngle   90"),
                   {"frictionAngle 90 is outside [0, 90)"});
    expectReported(replaced(std::string(sand), "solidDensity    2650", "solidDensity    900"),
                   {"'sand' is not heavier than its liquid"});
    expectReported(replaced(std::string(sand), "porosity        0.35;", ""), {"porosity"});
    expectReported("soil mohrCoulomb;", {"'soil' is not a material", "no material is defined"});
}

TEST(ConstitutiveLawTable, throwsForATypeThatItDoesNotHave)
{
    EXPECT_THROW((void)constitutiveLawKeywords("camClay"), std::out_of_range);
}

} // namespace
} // namespace caisson
