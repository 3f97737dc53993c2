#include "installation/InstallationTables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace caisson {
namespace {

namespace fs = std::filesystem;

const std::string sand = R"(
method houlsbyByrneSand;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; jackedPenetration 1.4; }
soil
{
    effectiveUnitWeight 10500; frictionAngle 38; sideFactorInside 0.3; sideFactorOutside 0.3;
    enhancement uniform; annulusRatio 1.5; intrinsicPermeability 1e-11;
}
penetration { rate table ((0 0.2) (5 0.08)); }
)";

const std::string cone = R"(
method dnv;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; submergedWeight 8e5; }
soil
{
    coneResistanceProfile ((0 2e6) (2 10e6) (6 10e6));
    layers { sand { top 0; soilType sand; } clay { top 3; soilType clay; } }
}
)";

InstallationInput read(const std::string& text, const fs::path& caseDirectory = {})
{
    return readInstallation(parseDictionary(text, "system/suctionPressureDict"), caseDirectory);
}

std::string replaced(std::string text, const std::string_view from, const std::string_view to)
{
    const std::size_t at = text.find(from);
    if (at == std::string::npos)
        throw std::logic_error("nothing to replace");
    return text.replace(at, from.size(), to);
}

/// The text is refused, and the report holds every line of `expected`.
void expectRefused(const std::string& text, const std::vector<std::string>& expected,
                   const fs::path& caseDirectory = {})
{
    try {
        (void)read(text, caseDirectory);
        FAIL() << "expected a refusal with: " << expected.front();
    } catch (const InputError& error) {
        const std::string report = formatProblems("case", error.problems());
        for (const std::string& line : expected)
            EXPECT_NE(report.find(line), std::string::npos) << "expected: " << line << "\ngot:\n" << report;
    }
}

TEST(InstallationInput, readsTheReferenceCaissonAndLoadsItByItsJackedPenetration)
{
    const InstallationInput input = read(sand);
    EXPECT_NEAR(input.method->caisson().submergedWeight, 774.392e3, 1);
    EXPECT_NEAR(input.byWeight, 1.4, 1e-9);
    EXPECT_EQ(input.end, 5);
    EXPECT_EQ(input.site.lidHeight, 5);
    ASSERT_TRUE(input.rate);

    const InstallationStage stage =
        installationStage(*input.method, input.site, 5, input.jacked, input.byWeight,
                          [&](const double h) { return input.rate->value(h); });
    EXPECT_NEAR(stage.suction, 51588.0, 0.5);
    // F k D s/gamma_w, k = 1e-11 m2 / 1e-3 Pa s x 9810 N/m3
    EXPECT_NEAR(stage.seepageFlow, 0.61 * 9.81e-5 * 4.95 * 51588 / 9810, 2e-5);
    const double plug = std::numbers::pi / 4 * 4.9 * 4.9;
    EXPECT_NEAR(stage.pumpFlow, stage.seepageFlow + 0.08 * plug * (1 - (25 / 4.9 / 4.9 - 1)), 1e-9);
    EXPECT_NEAR(stage.plugHeave, (0.5 * 1.4 + 3.6) * (25 / 4.9 / 4.9 - 1), 1e-9);
}

TEST(InstallationInput, jackedHasNoSuction)
{
    const InstallationInput input = read(sand + "loading jacked;");
    const InstallationStage stage =
        installationStage(*input.method, input.site, 5, input.jacked, input.byWeight);
    EXPECT_EQ(stage.suction, 0);
    EXPECT_NEAR(stage.jacking.total(), 5212.474e3, 50);
    EXPECT_EQ(stage.seepageFlow, 0);
}

TEST(InstallationInput, readsEveryMethod)
{
    EXPECT_EQ(installationMethods().size(), 6U);
    const InstallationInput layered = read(cone);
    // kp 0.3 in sand, 0.4 in clay; friction 0.001 to 3 m, then 0.03
    EXPECT_NEAR(layered.method->resistance(2.5, 0).tip / layered.method->caisson().tipArea(), 3e6, 1e-3);
    EXPECT_NEAR(layered.method->resistance(3.5, 0).tip / layered.method->caisson().tipArea(), 4e6, 1e-3);
    EXPECT_NEAR(layered.method->resistance(5, 0).outside / (5 * std::numbers::pi),
                0.001 * (12e6 + 10e6) + 0.03 * 20e6, 1e-3);

    for (const std::string method : {"sendersRandolph", "feld"}) {
        const InstallationInput input = read("method " + method + R"(;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; submergedWeight 5e5; }
soil { effectiveUnitWeight 10500; coneResistanceProfile ((0 0) (5 1e7)); tipFactor 0.2;
       frictionCoefficient 0.021; interfaceFrictionAngle 26; })");
        EXPECT_GT(input.method->suction(4), 0) << method;
    }

    const InstallationInput clay = read(R"(method houlsbyByrneClay;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 10; submergedWeight 3e5; }
soil { layers { clay { top 0; effectiveUnitWeight 6000; undrainedShearStrength 0; strengthGradient 1500;
                       adhesionFactorInside 0.6; adhesionFactorOutside 0.6; } } })");
    EXPECT_NEAR(clay.method->suction(10), 63723, 0.6);

    const InstallationInput table = read(R"(method table;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; }
soil { effectiveUnitWeight 10500; values ((0 0) (1 1)); })");
    EXPECT_NEAR(table.method->suction(2.5), 0.5 * 10500 * 5, 1e-9);
}

TEST(InstallationInput, readsTheConeResistanceFromACsvFile)
{
    const fs::path folder = fs::path(::testing::TempDir()) / "installationInput";
    fs::create_directories(folder);
    std::ofstream(folder / "cone.csv") << "no,depth,qc\n1,0,2\n2,2,10\n\n3,6,10\n";
    const std::string fromFile =
        replaced(cone, "coneResistanceProfile ((0 2e6) (2 10e6) (6 10e6));",
                 R"(coneResistanceFile { file "cone.csv"; depthColumn 1; valueColumn 2; valueFactor 1e6; })");
    const InstallationInput a = read(cone);
    const InstallationInput b = read(fromFile, folder);
    for (const double h : {0.5, 2.0, 4.0, 5.0})
        EXPECT_DOUBLE_EQ(a.method->resistance(h, 0).total(), b.method->resistance(h, 0).total()) << h;

    expectRefused(replaced(fromFile, "cone.csv", "cones.csv"), {"cannot read the file 'cones.csv'"}, folder);
    expectRefused(replaced(fromFile, "valueColumn 2", "valueColumn 3"),
                  {"cone.csv:2", "no number in the columns"}, folder);
    std::ofstream(folder / "cone.csv") << "no,depth,qc\n1,0,2\n2,2,-10\n";
    expectRefused(fromFile, {"cone.csv:3", "must not be negative"}, folder);
    std::ofstream(folder / "cone.csv") << "no,depth,qc\n1,0,2\n2,4,10\n";
    expectRefused(fromFile, {"the cone resistance ends at depth 4 m, before skirtLength 5 m"}, folder);
}

TEST(InstallationInput, namesTheReasonWhereLayersAreNotAllowed)
{
    expectRefused(replaced(sand, "frictionAngle 38;", "layers { a { top 0; } }"),
                  {"method houlsbyByrneSand takes no layers", "hold for uniform sand only"});
    expectRefused(replaced(cone, "clay { top 3;", "clay { top 0;"), {"begins above the one before it"});
    expectRefused(replaced(cone, "sand { top 0;", "sand { top 1;"), {"must begin at the sea bed"});
}

TEST(InstallationInput, refusesWhatCannotBe)
{
    expectRefused(replaced(sand, "jackedPenetration 1.4", "submergedWeight -5"),
                  {"submergedWeight -5 is outside [0, inf)"});
    expectRefused(replaced(sand, "intrinsicPermeability 1e-11", "intrinsicPermeability 0"),
                  {"intrinsicPermeability 0 is outside (0, inf)"});
    expectRefused(replaced(sand, "jackedPenetration 1.4;", ""), {"the load is missing"});
    expectRefused(replaced(sand, "jackedPenetration 1.4;", "jackedPenetration 1.4; submergedWeight 1;"),
                  {"the load is given twice"});
    expectRefused(replaced(sand, "wallThickness 0.05", "wallThickness 2.5"), {"leaves no room inside"});
    expectRefused(replaced(sand, "annulusRatio 1.5;", ""), {"enhancement uniform needs"});
    expectRefused(
        replaced(sand, "uniform; annulusRatio 1.5", "loadSpread; loadSpreadInside 0.3; loadSpreadOutside 1"),
        {"load spread has no solution unless K tan(delta) < f"});
    expectRefused(replaced(sand, "houlsbyByrneSand", "houlsbyBirneSand"),
                  {"did you mean 'houlsbyByrneSand'?", "sendersRandolph"});
    expectRefused(replaced(sand, "frictionAngle 38", "frictionAngel 38"), {"did you mean 'frictionAngle'?"});
    expectRefused(replaced(sand, "penetration {", "penetration { end 6;"), {"end is beyond skirtLength"});
    expectRefused(R"(method table;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; }
soil { effectiveUnitWeight 10500; values ((0 0) (0.8 1)); })",
                  {"the suction table ends at z/L 0.8, before the last penetration z/L 1"});
    expectRefused(R"(method table; loading jacked;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; }
soil { effectiveUnitWeight 10500; values ((0 0) (0.8 -1)); })",
                  {"method table has no resistance", "'values' holds a negative number"});
}

TEST(InstallationInput, reportsSeveralProblemsInOneRun)
{
    std::string text = replaced(sand, "frictionAngle 38", "frictionAngle 95");
    text = replaced(text, "wallThickness 0.05", "wallThickness -1");
    text = replaced(text, "rate table", "rte table");
    expectRefused(text, {"3 problems", "frictionAngle 95", "wallThickness -1", "'rte'"});
}

/// All the ways in which a case can use the table, each read back as a Function1.
TEST(InstallationTables, areReadAsFunction1ByTableFileAndByInclude)
{
    const InstallationInput input = read(sand);
    std::vector<InstallationStage> stages;
    for (const double h : {0.0, 1.4, 3.0, 5.0})
        stages.push_back(installationStage(*input.method, input.site, h, false, input.byWeight));
    const fs::path folder = fs::path(::testing::TempDir()) / "installationTables";
    fs::create_directories(folder / "constant");
    std::ofstream(folder / "constant/suctionTable") << function1Table(input, stages);

    const std::string file = (folder / "constant/suctionTable").string();
    for (const std::string& text : {"suction tableFile; suctionCoeffs { file \"" + file + "\"; }",
                                    "suction { type tableFile; file \"" + file + "\"; }",
                                    std::string("suction table\n#include \"<constant>/suctionTable\"\n;")}) {
        InputProblems problems;
        const Dictionary dictionary = parseDictionary(text, "0/p", folder);
        const std::unique_ptr<Function1> suction = readFunction1(dictionary, "suction", problems);
        ASSERT_TRUE(problems.empty()) << text << '\n' << formatProblems("case", problems.all());
        for (const InstallationStage& stage : stages)
            EXPECT_NEAR(suction->value(stage.penetration), stage.suction, 1e-6) << text;
        EXPECT_NEAR(suction->value(4), 0.5 * (stages[2].suction + stages[3].suction), 1e-6) << text;
    }
}

TEST(InstallationTables, nameAsManyColumnsAsTheyHave)
{
    const InstallationInput input = read(sand + "loading jacked;");
    const std::string text =
        stageTable(input, {installationStage(*input.method, input.site, 2, true, input.byWeight)});
    const std::size_t header = text.rfind("# ") + 2;
    const std::size_t row = text.find('\n', header);
    const auto words = [](const std::string& line) {
        std::istringstream stream(line);
        return std::distance(std::istream_iterator<std::string>(stream), {});
    };
    EXPECT_EQ(words(text.substr(header, row - header)), words(text.substr(row)));
    EXPECT_EQ(words(text.substr(row)), 18);
}

TEST(InstallationStages, findTheDeepestPossiblePenetration)
{
    // K tan(delta) = 1.2: the plug liquefies on the way
    std::string text = replaced(sand, "sideFactorInside 0.3; sideFactorOutside 0.3",
                                "sideFactorInside 1.2; sideFactorOutside 1.2");
    text = replaced(text, "jackedPenetration 1.4", "submergedWeight 1e5");
    const InstallationInput input = read(text);
    const double deepest = greatestPenetration(*input.method, input.site, 5);
    EXPECT_GT(deepest, input.byWeight);
    EXPECT_LT(deepest, 5);
    EXPECT_NO_THROW((void)input.method->suction(deepest));
    EXPECT_THROW((void)input.method->suction(deepest + 1e-4), SuctionLimitReached);
}

TEST(InstallationStages, stopAtLiquefactionAndCavitationWithAReason)
{
    const auto message = [](const InstallationInput& input) -> std::string {
        try {
            (void)installationStage(*input.method, input.site, 5, false, 0);
        } catch (const SuctionLimitReached& limit) {
            return limit.what();
        }
        return "no limit";
    };
    const std::string table = R"(method table;
caisson { outerDiameter 5; wallThickness 0.05; skirtLength 5; }
soil { effectiveUnitWeight 10500; values ((0 0) (1 S)); })";
    EXPECT_EQ(message(read(replaced(table, "S", "1.1"))), "no limit");
    EXPECT_NE(message(read(replaced(table, "S", "1.2"))).find("the plug liquefies"), std::string::npos);
    // friction in the clay and the tip need more than an atmosphere of suction
    EXPECT_NE(message(read(cone)).find("the water cavitates"), std::string::npos);
    EXPECT_EQ(message(read(cone + "water { depth 150; }")), "no limit");
}

TEST(InstallationStages, cavitationFollowsTheDepthOfWater)
{
    InstallationSite site;
    site.waterDepth = 10;
    EXPECT_DOUBLE_EQ(site.cavitationSuction(), 101325 + 98100 - 2000);
}

} // namespace
} // namespace caisson
