#include "dictionary/KeywordReader.h"

#include "DictionaryTestSupport.h"
#include "dictionary/Units.h"

namespace caisson {

namespace {

constexpr Keyword table[] = {
    {"porosity", "-", "0.4", "(0, 1)", "volume of voids over total volume"},
    {"density", "kg/m3", "", "(0, inf)", "density of the solid grains"},
    {"law", "word", "linearElastic", "linearElastic mohrCoulomb", "constitutive law"},
    {"friction", "deg", "-", "[0, 90]", "friction angle"},
    {"steps", "integer", "10", "[1, inf)", "number of steps"},
    {"order", "integer", "1", "1 2", "order of the basis"},
    {"active", "flag", "yes", "", "whether it acts"},
    {"gravity", "m/s2", "(0 0 -9.81)", "", "acceleration"},
    {"names", "list", "-", "sand clay", "layers"},
    {"corners", "list", "-", "", "corners of the polygon"},
    {"soil", "dictionary", "-", "", "a part"},
};

/// What is wrong with `text`, "line: message | hint" for each problem.
struct Reading
{
    explicit Reading(const std::string& text) : dictionary(parseDictionary(text, "file")) {}
    const KeywordReader& reader()
    {
        if (!keys) {
            keys = std::make_unique<KeywordReader>(dictionary, table, "'sand'", problems);
        }
        return *keys;
    }
    [[nodiscard]] std::string report() const
    {
        std::string text;
        for (const InputProblem& problem : problems.all()) {
            text += std::to_string(problem.where.line) + ": " + problem.message + " | " + problem.hint + "\n";
        }
        return text;
    }
    Dictionary dictionary;
    InputProblems problems;
    std::unique_ptr<KeywordReader> keys;
};

} // namespace

TEST(KeywordReader, valuesAndDefaultsAreRead)
{
    Reading reading(
        "density 2650; law mohrCoulomb; steps 20; active off; gravity (0 0 -1); names (sand clay);"
        "corners ((0 0) (1 0) (1 1));");
    const KeywordReader& reader = reading.reader();
    EXPECT_EQ(reader.number("porosity"), 0.4);
    EXPECT_EQ(reader.number("density"), 2650);
    EXPECT_EQ(reader.word("law"), "mohrCoulomb");
    EXPECT_EQ(reader.integer("steps"), 20);
    EXPECT_EQ(reader.integer("order"), 1);
    EXPECT_FALSE(reader.flag("active"));
    EXPECT_EQ(reader.vector("gravity"), (std::array<double, 3>{0, 0, -1}));
    EXPECT_EQ(reader.words("names"), (std::vector<std::string>{"sand", "clay"}));
    EXPECT_EQ(reader.rows("corners"), (std::vector<std::vector<double>>{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(reader.has("friction"));
    EXPECT_EQ(reader.dictionary("soil"), nullptr);
    EXPECT_EQ(reading.report(), "");
    Reading defaults("density 1;");
    EXPECT_EQ(defaults.reader().vector("gravity"), (std::array<double, 3>{0, 0, -9.81}));
}

TEST(KeywordReader, everyProblemIsReportedAtOnce)
{
    Reading reading("porosity 1.35;\nlaw mohrCoulom;\nfrictoin 30;\nsteps 2.5;\nactive maybe;\n");
    const KeywordReader& reader = reading.reader();
    static_cast<void>(reader.number("porosity"));
    static_cast<void>(reader.number("density"));
    static_cast<void>(reader.word("law"));
    static_cast<void>(reader.integer("steps"));
    static_cast<void>(reader.flag("active"));
    EXPECT_EQ(reading.report(),
              "3: unknown key 'frictoin' in 'sand' | did you mean 'friction'?  valid keys: active corners "
              "density friction gravity law names order porosity soil steps\n"
              "1: porosity 1.35 is outside (0, 1) | volume of voids over total volume [-]\n"
              "0: missing key 'density' in 'sand' | density of the solid grains [kg/m3]\n"
              "2: unknown word 'mohrCoulom' for law | did you mean 'mohrCoulomb'?  valid: linearElastic "
              "mohrCoulomb\n"
              "4: 'steps' is '2.5', not a whole number | \n"
              "5: 'active' is 'maybe', not a flag | valid: yes no on off true false\n");
    try {
        reading.problems.throwIfAny("case wrong");
        FAIL() << "not thrown";
    } catch (const InputError& error) {
        const std::string report = error.what();
        EXPECT_EQ(report.substr(0, report.find('\n')),
                  "--> CAISSONFOAM FATAL ERROR : 6 problems in case wrong");
        EXPECT_LT(report.find("file:1:"), report.find("file:2:")) << "in the order of the lines";
    }
}

TEST(KeywordReader, boundsAreOpenOrClosedAsWritten)
{
    const auto problems = [](const std::string& text, const char* key) {
        Reading reading("density 1; " + text);
        static_cast<void>(reading.reader().number(key));
        return reading.problems.all().size();
    };
    EXPECT_EQ(problems("porosity 0;", "porosity"), 1U);
    EXPECT_EQ(problems("porosity 1;", "porosity"), 1U);
    EXPECT_EQ(problems("porosity 0.999;", "porosity"), 0U);
    EXPECT_EQ(problems("friction 0;", "friction"), 0U);
    EXPECT_EQ(problems("friction 90;", "friction"), 0U);
    EXPECT_EQ(problems("friction 90.001;", "friction"), 1U);
    EXPECT_EQ(problems("friction 1e999;", "friction"), 1U);
}

TEST(KeywordReader, dimensionSetsAreHeldAgainstTheUnit)
{
    const auto problem = [](const std::string& value) {
        Reading reading("density " + value + ";");
        const double number = reading.reader().number("density");
        return reading.problems.empty() ? std::to_string(static_cast<int>(number))
                                        : reading.problems.all()[0].message;
    };
    EXPECT_EQ(problem("[1 -3 0 0 0 0 0] 2650"), "2650");
    EXPECT_EQ(problem("[1 -3 0 0 0] 2650"), "2650");
    EXPECT_EQ(problem("density [1 -3 0 0 0 0 0] 2650"), "2650"); // the old spelling
    EXPECT_EQ(problem("[kg m^-3] 2650"), "2650");
    EXPECT_EQ(problem("[kg/m^3] 2650"), "2650");
    EXPECT_EQ(problem("[1 -1 -2 0 0 0 0] 5"), "'density' has the dimensions [1 -1 -2 0 0 0 0]");
    EXPECT_EQ(problem("[Pa] 5"), "'density' has the dimensions [1 -1 -2 0 0 0 0]");
    EXPECT_EQ(problem("[kPa] 5"), "'density': '[kPa ]' is no dimension set"); // SI units only
    EXPECT_EQ(problem("[1 2] 5"), "'density': '[1 2 ]' is no dimension set");
    Reading count("density 1; steps [kg] 10;");
    EXPECT_EQ(count.reader().integer("steps"), 10);
    EXPECT_EQ(count.report(), "1: 'steps' takes no dimension set | leave it out (integer)\n");
}

TEST(KeywordReader, unitsHaveTheirDimensions)
{
    const auto dimensions = [](const char* unit) {
        const auto found = dimensionsOf(unit);
        return found ? printDimensions(*found) : "none";
    };
    EXPECT_EQ(dimensions("kg/m3"), "[1 -3 0 0 0 0 0]");
    EXPECT_EQ(dimensions("m/s2"), "[0 1 -2 0 0 0 0]");
    EXPECT_EQ(dimensions("Pa"), "[1 -1 -2 0 0 0 0]");
    EXPECT_EQ(dimensions("N"), "[1 1 -2 0 0 0 0]");
    EXPECT_EQ(dimensions("m2"), "[0 2 0 0 0 0 0]");
    EXPECT_EQ(dimensions("Pa s"), "[1 -1 -1 0 0 0 0]");
    EXPECT_EQ(dimensions("1/m"), "[0 -1 0 0 0 0 0]");
    EXPECT_EQ(dimensions("J/kg/K"), "[0 2 -2 -1 0 0 0]");
    EXPECT_EQ(dimensions("m^0.5"), "[0 0.5 0 0 0 0 0]");
    EXPECT_EQ(dimensions("-"), "[0 0 0 0 0 0 0]");
    EXPECT_EQ(dimensions("deg"), "[0 0 0 0 0 0 0]");
    EXPECT_EQ(dimensions("word"), "none");
}

TEST(KeywordReader, listsInAllSpellingsAreRead)
{
    const auto rows = [](const std::string& value) {
        Reading reading("density 1; corners " + value + ";");
        std::string text;
        for (const auto& row : reading.reader().rows("corners")) {
            text += "(";
            for (const double number : row) {
                text += " " + std::to_string(static_cast<int>(number));
            }
            text += " )";
        }
        return text + (reading.problems.empty() ? "" : "refused");
    };
    EXPECT_EQ(rows("(1 2 3)"), "( 1 2 3 )");
    EXPECT_EQ(rows("3(1 2 3)"), "( 1 2 3 )");
    EXPECT_EQ(rows("3{7}"), "( 7 7 7 )");
    EXPECT_EQ(rows("uniform (1 2 3)"), "( 1 2 3 )");
    EXPECT_EQ(rows("nonuniform List<scalar> 2(1 2)"), "( 1 2 )");
    EXPECT_EQ(rows("((1 2) (3 4))"), "( 1 2 )( 3 4 )");
    EXPECT_EQ(rows("2(2(1 2) (3 4))"), "( 1 2 )( 3 4 )");
    for (const char* wrong : {"(1 2", "4", "()", "(1 (2 3))", "((1 2) 3)", "2(1 2 3)", "(1 a)", "(1 2) 3",
                              "word", "1000000000{0}", "-1{0}"}) {
        EXPECT_EQ(wrong == std::string("(1 2") ? "refused" : rows(wrong), "refused") << wrong;
    }
    Reading nested("density 1; corners ((1 2) (3 4));");
    static_cast<void>(nested.reader().numbers("corners"));
    EXPECT_EQ(nested.report(), "1: 'corners' is a list of lists, not one list | write (a b c)\n");
}

TEST(KeywordReader, wordListsTakeWordsOnly)
{
    const auto report = [](const std::string& value) {
        Reading reading("density 1; names " + value + (value.ends_with('}') ? "" : ";"));
        static_cast<void>(reading.reader().words("names"));
        return reading.report();
    };
    EXPECT_EQ(report("2(sand clay)"), "");
    EXPECT_EQ(report("(sand 3)"), "1: 'names': '3' is not a word | \n");
    EXPECT_EQ(report("sand"), "");
    EXPECT_EQ(report("()"), "");
    EXPECT_EQ(report("3(sand clay)"), "1: 'names' has 2 words, not 3 | \n");
    EXPECT_EQ(report("(sand) (clay)"),
              "1: 'names': ')' is not a word | \n1: 'names': '(' is not a word | \n");
    EXPECT_EQ(report(""), "1: 'names' is '', not a list of words | write (a b c)\n");
    EXPECT_EQ(report("{ sand 1; }"), "1: 'names' is '{...}', not a list of words | write (a b c)\n");
    EXPECT_EQ(report("(sand cly)"),
              "1: unknown word 'cly' for names | did you mean 'clay'?  valid: clay sand\n");
}

TEST(KeywordReader, aMissingSemicolonIsSuspected)
{
    Reading reading("density 2650\nporosity 0.3;\n");
    static_cast<void>(reading.reader().number("density"));
    EXPECT_EQ(reading.report(), "1: 'density' is '2650 porosity 0.3', not a number | "
                                "is the ';' missing at the end of the line?\n");
}

TEST(KeywordReader, patternsHaveToMatchAKey)
{
    Reading good("\"(density|porosity)\" 0.5;");
    EXPECT_EQ(good.reader().number("density"), 0.5);
    EXPECT_EQ(good.report(), "");
    Reading bad("density 1; \"frction.*\" 30;");
    bad.reader();
    EXPECT_EQ(bad.report().substr(0, 41), "1: \"frction.*\" matches no key of 'sand' |");
}

TEST(KeywordReader, macrosTheHeaderAndCoefficientsAreNoUnknownKeys)
{
    Reading reading(
        "FoamFile { class dictionary; } grains 2650; density $grains; law mohrCoulomb; lawCoeffs { }");
    EXPECT_EQ(reading.reader().number("density"), 2650);
    EXPECT_EQ(reading.report(), "");
    Reading unused("density 2650;\ndensityCoeffs { value 3; }"); // would be ignored
    unused.reader();
    EXPECT_EQ(unused.report().substr(0, 41), "2: unknown key 'densityCoeffs' in 'sand' ");
}

TEST(KeywordReader, theTablePrintsAsMarkdown)
{
    constexpr Keyword two[] = {{"density", "kg/m3", "", "(0, inf)", "of the grains"},
                               {"friction", "deg", "-", "", "angle"}};
    EXPECT_EQ(keywordTableMarkdown("sand", two),
              "### sand\n\n| key | unit or kind | default | range | meaning |\n|---|---|---|---|---|\n"
              "| `density` | kg/m3 | required | (0, inf) | of the grains |\n"
              "| `friction` | deg | none |  | angle |\n");
}

TEST(InputProblems, theReportHasTheShapeOfTheUserGuide)
{
    InputProblems problems;
    problems.add({"system/controlDict", 8}, "unknown word 'latesTime' for startFrom",
                 suggestion("latesTime", {"startTime", "latestTime", "firstTime"}, ""));
    problems.add({"constant/materialProperties", 19}, "porosity 1.35 is outside (0, 1)");
    try {
        problems.throwIfAny("case tutorials/x");
        FAIL() << "not thrown";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--> CAISSONFOAM FATAL ERROR : 2 problems in case tutorials/x\n\n"
                                   "constant/materialProperties:19: porosity 1.35 is outside (0, 1)\n\n"
                                   "system/controlDict:8: unknown word 'latesTime' for startFrom\n"
                                   "    did you mean 'latestTime'?  valid: firstTime latestTime startTime\n");
    }
}

TEST(InputProblems, theNearestWordIsFoundAndFarOnesAreNot)
{
    const std::vector<std::string> valid{"frictionAngle", "cohesion", "dilatancyAngle"};
    EXPECT_EQ(nearestWord("frictionAngel", valid), "frictionAngle");
    EXPECT_EQ(nearestWord("COHESION", valid), "cohesion");
    EXPECT_EQ(nearestWord("chesion", valid), "cohesion");
    EXPECT_EQ(nearestWord("permeability", valid), "");
    EXPECT_EQ(nearestWord("x", valid), "");
}

} // namespace caisson
