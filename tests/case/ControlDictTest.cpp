#include "case/ControlDict.h"

#include "TemporaryCase.h"
#include "dictionary/InputProblems.h"

#include <gtest/gtest.h>

using namespace caisson;

namespace {

const std::string head = "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n";

ControlDict readText(const std::string& text, InputProblems& problems)
{
    const TemporaryCase testCase;
    testCase.write("system/controlDict", head + text);
    return readControlDict(testCase.path(), problems);
}

/// All problems of a controlDict, a line each.
std::string problemsOf(const std::string& text)
{
    InputProblems problems;
    readText(text, problems);
    std::string all;
    for (const InputProblem& problem : problems.all()) {
        all += problem.where.file + ":" + std::to_string(problem.where.line) + ": " + problem.message + "\n";
    }
    return all;
}

} // namespace

TEST(ControlDict, everyKeyIsRead)
{
    InputProblems problems;
    const ControlDict control = readText(R"(
application     axiMpmFoam;
startFrom       startTime;
startTime       0.25;
stopAt          nextWrite;
endTime         2.5;
deltaT          1e-4;
adjustTimeStep  yes;
maxCo           0.5;
maxDeltaT       1e-3;
writeControl    adjustableRunTime;
writeInterval   0.05;
purgeWrite      3;
writeFormat     ascii;
writePrecision  17;
writeCompression on;
timeFormat      fixed;
timePrecision   8;
runTimeModifiable true;
logInterval     50;
functions { probes { type probes; } }
libs (utilityFunctionObjects);
OptimisationSwitches { stopAtWriteNowSignal 10; }
DebugSwitches { x 1; }
)",
                                         problems);
    EXPECT_TRUE(problems.empty()) << formatProblems("controlDict", problems.all());
    EXPECT_EQ(control.application, "axiMpmFoam");
    EXPECT_EQ(control.startFrom, StartFrom::startTime);
    EXPECT_EQ(control.startTime, 0.25);
    EXPECT_EQ(control.stopAt, StopAt::nextWrite);
    EXPECT_EQ(control.endTime, 2.5);
    EXPECT_EQ(control.deltaT, 1e-4);
    EXPECT_TRUE(control.adjustTimeStep);
    EXPECT_EQ(control.maxCo, 0.5);
    EXPECT_EQ(control.maxDeltaT, 1e-3);
    EXPECT_EQ(control.writeControl, WriteControl::adjustableRunTime);
    EXPECT_EQ(control.writeInterval, 0.05);
    EXPECT_EQ(control.purgeWrite, 3);
    EXPECT_FALSE(control.writeStyle.binary);
    EXPECT_EQ(control.writeStyle.precision, 17);
    EXPECT_TRUE(control.writeStyle.compressed);
    EXPECT_EQ(control.timeFormat, TimeFormat::fixed);
    EXPECT_EQ(control.timePrecision, 8);
    EXPECT_TRUE(control.runTimeModifiable);
    EXPECT_EQ(control.logInterval, 50);
    ASSERT_EQ(control.remarks.size(), 1U) << "functions are not run, and that must be said";
    EXPECT_NE(control.remarks[0].find("functions"), std::string::npos);
}

TEST(ControlDict, leastDictionaryGivesTheDefaults)
{
    InputProblems problems;
    const ControlDict control = readText("endTime 1; adjustTimeStep yes; writeFrequency 7;", problems);
    EXPECT_TRUE(problems.empty()) << formatProblems("controlDict", problems.all());
    EXPECT_EQ(control.startFrom, StartFrom::latestTime);
    EXPECT_EQ(control.stopAt, StopAt::endTime);
    EXPECT_EQ(control.deltaT, 0);
    EXPECT_EQ(control.maxCo, 0.8);
    EXPECT_EQ(control.writeControl, WriteControl::timeStep);
    EXPECT_EQ(control.writeInterval, 7) << "writeFrequency is the old name";
    EXPECT_TRUE(control.writeStyle.binary);
    EXPECT_EQ(control.writeStyle.precision, 17);
    EXPECT_EQ(control.timePrecision, 6);
    EXPECT_TRUE(control.remarks.empty());
}

TEST(ControlDict, allProblemsAreReportedAtOnce)
{
    const std::string problems =
        problemsOf("startFrom latesTime;\nmaxCo 1.5;\nwriteControl timeStep;\nwriteInterval 0.5;\n"
                   "writeFormat asci;\nendTim 3;\n");
    for (const char* part :
         {"system/controlDict:2: ", "latesTime", "maxCo", "writeInterval must be a whole number of steps",
          "asci", "endTim", "deltaT is missing", "endTime is missing"}) {
        EXPECT_NE(problems.find(part), std::string::npos) << "expected: " << part << "\ngot:\n" << problems;
    }
}

TEST(ControlDict, missingWriteIntervalAndEarlyEndAreProblems)
{
    const std::string problems = problemsOf("startFrom startTime; startTime 2; endTime 1; deltaT 1;");
    EXPECT_NE(problems.find("writeInterval is missing"), std::string::npos) << problems;
    EXPECT_NE(problems.find("endTime is before startTime"), std::string::npos) << problems;
    EXPECT_EQ(problemsOf("endTime 1; deltaT 1; writeControl none;"), "");
    EXPECT_EQ(problemsOf("stopAt nextWrite; deltaT 1; writeInterval 5;"), "");
}

TEST(ControlDict, whatRoundsARestartIsRemarked)
{
    InputProblems problems;
    const ControlDict control =
        readText("endTime 1; deltaT 1; writeInterval 1; writeFormat ascii; writePrecision 6;", problems);
    ASSERT_EQ(control.remarks.size(), 1U);
    EXPECT_EQ(control.remarks[0].substr(0, 44), "writePrecision 6 rounds what is written: a r");
    const ControlDict packed =
        readText("endTime 1; deltaT 1; writeInterval 1; writeCompression on;", problems);
    EXPECT_FALSE(packed.writeStyle.compressed);
    ASSERT_EQ(packed.remarks.size(), 1U);
}
