#include "function1/Function1.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <unistd.h>

namespace caisson {

namespace {

std::unique_ptr<Function1> read(const std::string& text, InputProblems& problems)
{
    const Dictionary dictionary = parseDictionary(text, "file");
    return readFunction1(dictionary, "f", problems);
}

/// Value of `f` at x; fails where reading finds a problem.
double valueAt(const std::string& text, double x)
{
    InputProblems problems;
    const auto function = read(text, problems);
    for (const InputProblem& problem : problems.all()) {
        ADD_FAILURE() << text << ": " << problem.message << " | " << problem.hint;
    }
    return function->value(x);
}

/// "message | hint" of the first problem, "accepted" where there is none.
std::string refusal(const std::string& text)
{
    InputProblems problems;
    static_cast<void>(read(text, problems));
    return problems.empty() ? "accepted" : problems.all()[0].message + " | " + problems.all()[0].hint;
}

constexpr double roundOff = 1e-15;

} // namespace

TEST(Function1, constantsInAllSpellings)
{
    for (const char* text : {"f 3;", "f constant 3;", "f uniform 3;", "f { type constant; value 3; }",
                             "f constant; fCoeffs { value 3; }", "f { type uniform; value 3; }"}) {
        EXPECT_EQ(valueAt(text, 7), 3) << text;
    }
    EXPECT_EQ(valueAt("f zero;", 7), 0);
    EXPECT_EQ(valueAt("f one;", 7), 1);
    EXPECT_EQ(valueAt("f { type one; }", 7), 1);
}

TEST(Function1, tablesInAllSpellingsAreLinear)
{
    const std::string rows = "((0 1) (2 5) (4 3))";
    for (const std::string& text :
         {"f table " + rows + ";", "f table 3" + rows + ";", "f { type table; values " + rows + "; }",
          "f table; fCoeffs { values " + rows + "; }",
          "f table " + rows + "; fCoeffs { outOfBounds clamp; }"}) {
        EXPECT_EQ(valueAt(text, 0), 1) << text;
        EXPECT_EQ(valueAt(text, 0.5), 2) << text;
        EXPECT_EQ(valueAt(text, 2), 5) << text;
        EXPECT_EQ(valueAt(text, 3), 4) << text;
        EXPECT_EQ(valueAt(text, -1), 1) << text;
        EXPECT_EQ(valueAt(text, 9), 3) << text;
    }
}

TEST(Function1, tablesBeyondTheirEndsDoAsTheyAreTold)
{
    const auto table = [](const std::string& bounds) {
        return "f { type table; values ((0 0) (2 2)); outOfBounds " + bounds + "; }";
    };
    EXPECT_EQ(valueAt(table("clamp"), 3), 2);
    EXPECT_EQ(valueAt(table("repeat"), 2.5), 0.5);
    EXPECT_EQ(valueAt(table("repeat"), -0.5), 1.5);
    EXPECT_EQ(valueAt(table("repeat"), 2), 2);
    testing::internal::CaptureStderr();
    EXPECT_EQ(valueAt(table("warn"), 3), 2);
    EXPECT_EQ(
        testing::internal::GetCapturedStderr(),
        "--> CAISSONFOAM Warning : file:1: the table of 'f' goes from 0 to 2, but 3 is asked for; its end "
        "value is used\n");
    InputProblems problems;
    const auto strict = read(table("error"), problems);
    EXPECT_EQ(strict->end(), 2);
    EXPECT_EQ(strict->value(2), 2);
    try {
        static_cast<void>(strict->value(2.5));
        FAIL() << "no error beyond the end";
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems().at(0).message, "the table of 'f' goes from 0 to 2, but 2.5 is asked for");
    }
}

TEST(Function1, rampsHaveTheirShapes)
{
    const auto ramp = [](const std::string& type) { return "f { type " + type + "; start 1; duration 4; }"; };
    const double pi = std::numbers::pi;
    const std::pair<const char*, double> atOneQuarter[] = {{"linearRamp", 0.25},
                                                           {"quadraticRamp", 0.0625},
                                                           {"halfCosineRamp", 0.5 * (1 - std::cos(pi / 4))},
                                                           {"quarterSineRamp", std::sin(pi / 8)},
                                                           {"quarterCosineRamp", 1 - std::cos(pi / 8)}};
    for (const auto& [type, value] : atOneQuarter) {
        EXPECT_EQ(valueAt(ramp(type), 0.5), 0) << type;
        EXPECT_EQ(valueAt(ramp(type), 1), 0) << type;
        EXPECT_NEAR(valueAt(ramp(type), 2), value, roundOff) << type;
        EXPECT_NEAR(valueAt(ramp(type), 5), 1, roundOff) << type;
        EXPECT_NEAR(valueAt(ramp(type), 50), 1, roundOff) << type;
    }
    EXPECT_EQ(valueAt("f linearRamp; fCoeffs { duration 2; }", 1), 0.5);
}

TEST(Function1, aStepIsOneForItsDuration)
{
    const std::string step = "f { type step; start 1; duration 2; }";
    EXPECT_EQ(valueAt(step, 0.999), 0);
    EXPECT_EQ(valueAt(step, 1), 1);
    EXPECT_EQ(valueAt(step, 3), 1);
    EXPECT_EQ(valueAt(step, 3.001), 0);
}

TEST(Function1, wavesHaveAmplitudeFrequencyScaleAndLevel)
{
    const std::string keys = "frequency 0.25; amplitude 3; scale 2; level 10; t0 1; }";
    EXPECT_NEAR(valueAt("f { type sine; " + keys, 2), 16, 1e-14);  // a quarter of the period of 4 after t0
    EXPECT_NEAR(valueAt("f { type cosine; " + keys, 3), 4, 1e-14); // half of it
    EXPECT_EQ(valueAt("f { type square; " + keys, 2), 16);
    EXPECT_EQ(valueAt("f { type square; " + keys, 3.5), 4);
    EXPECT_NEAR(valueAt("f { type sine; period 4; }", 1), 1, roundOff);
    EXPECT_NEAR(valueAt("f { type sine; frequency table ((0 0.25) (2 0.75)); }", 1), 0, 1e-15); // sin(pi)
    // +1 for a quarter of the period, in both spellings
    for (const char* mark : {"mark 1; space 3;", "markSpace 0.3333333333333333;"}) {
        const std::string square = "f { type square; period 4; " + std::string(mark) + " }";
        EXPECT_EQ(valueAt(square, 0.99), 1) << mark;
        EXPECT_EQ(valueAt(square, 1.01), -1) << mark;
        EXPECT_EQ(valueAt(square, -0.5), -1) << mark;
        EXPECT_EQ(valueAt(square, -3.5), 1) << mark;
    }
}

TEST(Function1, polynomialsSumTheirTerms)
{
    for (const char* text :
         {"f polynomial ((1 0) (2 1) (3 2));", "f { type polynomial; coeffs ((1 0) (2 1) (3 2)); }"}) {
        EXPECT_EQ(valueAt(text, 2), 17) << text;
    }
}

TEST(Function1, functionsAreMadeOfFunctions)
{
    EXPECT_EQ(
        valueAt("f { type scale; scale { type linearRamp; duration 4; } value table ((0 0) (4 8)); }", 1),
        0.5);
    EXPECT_EQ(valueAt("f { type inputValueMapper; mode none; value table ((0 0) (4 8)); }", 1), 2);
    EXPECT_EQ(valueAt("f { type inputValueMapper; mode function; function table ((0 0) (1 3)); "
                      "value table ((0 0) (4 8)); }",
                      1),
              6);
    const std::string limits = "min 1; max 2; value table ((0 0) (4 8)); }";
    for (const std::string& text :
         {"f { type inputValueMapper; mode minMax; " + limits, "f { type limitRange; " + limits}) {
        EXPECT_EQ(valueAt(text, 0), 2);
        EXPECT_EQ(valueAt(text, 1.5), 3);
        EXPECT_EQ(valueAt(text, 9), 4);
    }
}

TEST(Function1, filesCountFromTheCase)
{
    std::string name = (std::filesystem::temp_directory_path() / "caissonFunction1XXXXXX").string();
    const std::filesystem::path directory = mkdtemp(name.data());
    std::filesystem::create_directories(directory / "constant");
    std::ofstream(directory / "constant/rows") << "// time velocity\n2\n(\n(0 1)\n(2 5)\n) // no end of line";
    std::ofstream(directory / "constant/rows.csv") << "t;x;v\n 0 ;9; 1 \r\n\n2;9;+5e0\r\n";
    std::ofstream(directory / "constant/merged.csv") << "0  9  1\n2 9   5\n";
    std::ofstream(directory / "constant/bad.csv") << "0,1\n1,two\n";
    std::ofstream(directory / "constant/bodies")
        << "a { type table; file \"constant/rows\"; }\n"
           "b { type tableFile; file \"<constant>/rows\"; }\n"
           "c tableFile; cCoeffs { file \"$FOAM_CASE/constant/rows\"; }\n"
           "d { type csvFile; file \"constant/rows.csv\"; nHeaderLine 1; refColumn 0; componentColumns (2); "
           "separator \";\"; mergeSeparators no; }\n"
           "e { type csvFile; file \"constant/merged.csv\"; componentColumns 1(2); separator \" \"; "
           "mergeSeparators yes; }\n"
           "bad { type csvFile; file \"constant/bad.csv\"; componentColumns (1); }\n"
           "far { type csvFile; file \"constant/bad.csv\"; componentColumns (7); }\n"
           "missing { type table; file \"constant/none\"; }\n"
           "unknown { type csvFile; file \"$nowhere/none\"; componentColumns (1); }\n"
           "list ( { f { type table; file \"constant/rows\"; } } );\n";
    const Dictionary dictionary = readDictionary(directory / "constant/bodies", directory, "constant/bodies");
    for (const char* key : {"a", "b", "c", "d", "e"}) {
        InputProblems problems;
        const auto function = readFunction1(dictionary, key, problems);
        for (const InputProblem& problem : problems.all()) {
            ADD_FAILURE() << key << ": " << problem.message;
        }
        EXPECT_EQ(function->value(0.5), 2) << key;
    }
    InputProblems problems;
    const std::vector<Dictionary> list = dictionariesIn(*dictionary.find("list"), problems);
    EXPECT_EQ(readFunction1(list.at(0), "f", problems)->value(0.5), 2);
    EXPECT_TRUE(problems.empty());
    for (const char* key : {"bad", "far", "missing", "unknown"}) {
        static_cast<void>(readFunction1(dictionary, key, problems));
    }
    ASSERT_EQ(problems.all().size(), 4U);
    EXPECT_EQ(problems.all()[0].where.line, 2);
    EXPECT_EQ(problems.all()[0].message, "'two' is not a number");
    EXPECT_EQ(problems.all()[1].message, "has no column 7");
    EXPECT_EQ(problems.all()[2].message,
              "'missing': cannot read the file '" + (directory / "constant/none").string() + "'");
    EXPECT_EQ(problems.all()[3].message, "nothing is called 'nowhere' for the macro '$nowhere'");
    EXPECT_EQ(problems.all()[3].where.line, 9);
    std::filesystem::remove_all(directory);
}

TEST(Function1, vectorsShareTheVariable)
{
    const auto valueOf = [](const std::string& text, double x) {
        InputProblems problems;
        const VectorFunction1 function = readVectorFunction1(parseDictionary(text), "f", problems);
        for (const InputProblem& problem : problems.all()) {
            ADD_FAILURE() << text << ": " << problem.message;
        }
        return function.value(x);
    };
    using Vector = std::array<double, 3>;
    EXPECT_EQ(valueOf("f (1 2 3);", 5), (Vector{1, 2, 3}));
    EXPECT_EQ(valueOf("f constant (1 2 3);", 5), (Vector{1, 2, 3}));
    EXPECT_EQ(valueOf("f uniform (1 2 3);", 5), (Vector{1, 2, 3}));
    EXPECT_EQ(valueOf("f { type constant; value (1 2 3); }", 5), (Vector{1, 2, 3}));
    EXPECT_EQ(valueOf("f table ((0 (0 0 0)) (2 (2 4 -6)));", 1), (Vector{1, 2, -3}));
    EXPECT_EQ(valueOf("f polynomial (((1 2 3) (0 1 2)));", 2), (Vector{1, 4, 12}));
    EXPECT_EQ(valueOf("f { type scale; scale { type linearRamp; duration 2; } value (2 4 6); }", 1),
              (Vector{1, 2, 3}));
    const Vector wave = valueOf("f { type sine; period 4; scale (1 2 3); level (10 20 30); }", 1);
    EXPECT_EQ(wave, (Vector{11, 22, 33}));
}

TEST(Function1, aVectorsProblemIsReportedOnce)
{
    InputProblems problems;
    static_cast<void>(
        readVectorFunction1(parseDictionary("f { type linearRamp; duration 1; }"), "f", problems));
    ASSERT_EQ(problems.all().size(), 1U);
    EXPECT_EQ(problems.all()[0].message, "'f' is a vector, but the type linearRamp gives a number");
    InputProblems others;
    static_cast<void>(readVectorFunction1(parseDictionary("f (0 1);"), "f", others));
    ASSERT_EQ(others.all().size(), 1U);
    InputProblems last; // only the third component is wrong
    static_cast<void>(readVectorFunction1(parseDictionary("f (0 1 x);"), "f", last));
    ASSERT_EQ(last.all().size(), 1U);
}

TEST(Function1, whatIsWrongIsSaidWithWhatWouldBeRight)
{
    EXPECT_EQ(refusal("f tabel ((0 1));").substr(0, 77),
              "unknown Function1 type 'tabel' for 'f' | did you mean 'table'?  valid Functio");
    EXPECT_EQ(refusal("g 1;"), "missing key 'f' | a Function1");
    EXPECT_EQ(
        refusal("f { type coded; code #{ return 1; #}; }"),
        "'f': Function1 type coded needs OpenFOAM at run time | write the series as a table or csvFile");
    EXPECT_EQ(refusal("f none;"),
              "'f' has the type none, which has no value | leave 'f' out where it is optional");
    EXPECT_EQ(refusal("f table ((0 1) (0 2));"),
              "the table of 'f' does not rise: 0 is followed by 0 | the first "
              "column must increase from row to row");
    EXPECT_EQ(refusal("f table ((0 1) (2));"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f table ((0 1) (2 3)) 4;"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f table ();"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f table ((0 1e999));"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f linearRamp;"),
              "'f': type linearRamp needs more than its name | f { type linearRamp; ... } "
              "or a dictionary fCoeffs");
    EXPECT_EQ(refusal("f { type linearRamp; }"),
              "missing key 'duration' in 'f' | length of the ramp (s or m)");
    EXPECT_EQ(refusal("f { type linearRamp; duration 0; }"),
              "duration 0 is outside (0, inf) | length of the ramp "
              "[s or m]");
    EXPECT_EQ(refusal("f { type table; values ((0 1)); outOfBound clamp; }").substr(0, 65),
              "unknown key 'outOfBound' in 'f' | did you mean 'outOfBounds'?  va");
    EXPECT_EQ(refusal("f { type table; values ((0 1)); outOfBounds extrapolate; }").substr(0, 47),
              "unknown word 'extrapolate' for outOfBounds | va");
    EXPECT_EQ(refusal("f { type table; values ((0 1)); interpolationScheme spline; }"),
              "unknown word 'spline' for interpolationScheme | valid: linear");
    EXPECT_EQ(refusal("f { type sine; }"), "'f' needs either frequency or period | ");
    EXPECT_EQ(refusal("f { type sine; period 0; }"), "'f': the period is zero | ");
    EXPECT_EQ(refusal("f zero 3;"), "'f': nothing may follow the type word zero | f { type zero; ... }");
    EXPECT_EQ(refusal("f [0 1 -1 0 0 0 0] 3;"),
              "'f' has a dimension set, which a Function1 does not take | leave it "
              "out: values are in SI units");
    EXPECT_EQ(refusal("f (1 2 3);"),
              "'f' is no number and no Function1 | write a value, or f { type table; values "
              "((x y) ...); }");
    EXPECT_EQ(refusal("f { type scale; value 1; }"), "'f' needs 'scale' | a Function1");
    EXPECT_EQ(refusal("f table 3((0 1) (2 3));"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f table 2.5((0 1) (2 3));"), "'f': the table's rows are not ((x y) (x y) ...) | ");
    EXPECT_EQ(refusal("f { type limitRange; min 3; max 1; value 2; }"), "'f': min is above max | ");
    const std::string csv = "f { type csvFile; file \"x\"; componentColumns ";
    EXPECT_EQ(refusal(csv + "(1.5); }"), "'f': componentColumns are whole numbers, from 0 | ");
    EXPECT_EQ(refusal(csv + "(-1); }"), "'f': componentColumns are whole numbers, from 0 | ");
    EXPECT_EQ(refusal(csv + "(1); separator \"\\t\"; }"), "'f': the separator '\\t' is not one character | "
                                                          "a tabulator stands in the quotes as it is");
}

TEST(Function1, aLimitedVariableDoesNotLeaveATable)
{
    const auto end = [](const std::string& max) {
        InputProblems problems;
        const auto function = read("f { type limitRange; min 0; max " + max +
                                       "; value { type table; values ((0 0) (2 4)); outOfBounds error; } }",
                                   problems);
        EXPECT_TRUE(problems.empty());
        return function->end();
    };
    EXPECT_EQ(end("2"), std::numeric_limits<double>::infinity());
    EXPECT_EQ(end("3"), 2);
}

} // namespace caisson
