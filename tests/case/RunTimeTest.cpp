#include "case/RunTime.h"

#include "TemporaryCase.h"
#include "case/FileIO.h"
#include "case/Log.h"
#include "dictionary/InputProblems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace caisson;
namespace fs = std::filesystem;

namespace {

/// What a step depends on besides time: stands for a solver's state.
double stableStep(double time, double state) { return 0.013 * (1.2 + std::sin(7 * time) + 0.1 * state); }

struct Steps
{
    std::vector<double> deltaT;
    double state = 1;
};

ControlDict adjustable(double endTime)
{
    ControlDict control;
    control.endTime = endTime;
    control.adjustTimeStep = true;
    control.writeControl = WriteControl::adjustableRunTime;
    control.writeInterval = 0.1;
    return control;
}

/// Runs a case; each step changes the state by what the step was. Calls `atStep` after each step.
Steps runCase(const fs::path& caseDirectory, const ControlDict& control,
              const std::function<void(RunTime&)>& atStep = {})
{
    std::ostringstream text;
    Log log(text);
    RunTime runTime(caseDirectory, control, log);
    Steps steps;
    if (runTime.restarted()) {
        steps.state = runTime.kept.at("state").at(0);
    }
    while (runTime.running()) {
        const double wanted = control.adjustTimeStep
                                  ? runTime.wantedDeltaT(stableStep(runTime.time(), steps.state))
                                  : control.deltaT;
        const double deltaT = runTime.advance(wanted);
        steps.deltaT.push_back(deltaT);
        steps.state += deltaT * std::cos(steps.state) + runTime.deltaT0();
        if (runTime.writeTime()) {
            runTime.kept["state"] = {steps.state, 0.1};
            runTime.write([&](const fs::path& folder) { writeFileAtomically(folder / "p", "content"); });
        }
        if (atStep) {
            atStep(runTime);
        }
    }
    return steps;
}

std::vector<std::string> names(const fs::path& caseDirectory)
{
    std::vector<std::string> all;
    for (const TimeDirectory& time : timeDirectories(caseDirectory)) {
        all.push_back(time.name);
    }
    return all;
}

using Names = std::vector<std::string>;

} // namespace

TEST(RunTime, stepsFallOnTheWriteTimes)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    const Steps steps = runCase(testCase.path(), adjustable(0.5));
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.1", "0.2", "0.3", "0.4", "0.5"}));
    EXPECT_NE(testCase.read("0.3/uniform/time").find("value           0.30000000000000004;"),
              std::string::npos)
        << "the time must be the multiple of the interval itself\n"
        << testCase.read("0.3/uniform/time");
    EXPECT_GT(steps.deltaT.size(), 30U);
}

TEST(RunTime, splitRunTakesTheSameStepsToTheBit)
{
    for (const double split : {0.1, 0.3, 0.7}) {
        const TemporaryCase whole;
        const TemporaryCase parts;
        whole.write("0/U", "");
        parts.write("0/U", "");
        const Steps expected = runCase(whole.path(), adjustable(1.0));
        Steps got = runCase(parts.path(), adjustable(split));
        const Steps second = runCase(parts.path(), adjustable(1.0));
        got.deltaT.insert(got.deltaT.end(), second.deltaT.begin(), second.deltaT.end());
        EXPECT_EQ(expected.deltaT, got.deltaT) << "split at " << split;
        EXPECT_EQ(expected.state, second.state);
        EXPECT_EQ(whole.read("1/uniform/time"), parts.read("1/uniform/time"));
        EXPECT_EQ(names(whole.path()), names(parts.path()));
    }
}

TEST(RunTime, splitAtAWriteOfAnyStepTakesTheSameSteps)
{
    // Writes by the number of steps fall on times that no short decimal number names.
    ControlDict control = adjustable(1.0);
    control.writeControl = WriteControl::timeStep;
    control.writeInterval = 7;
    const TemporaryCase whole;
    whole.write("0/U", "");
    const Steps expected = runCase(whole.path(), control);

    const TemporaryCase parts;
    parts.write("0/U", "");
    ControlDict first = control;
    first.stopAt = StopAt::nextWrite;
    std::vector<double> got;
    for (int part = 0; part < 5; ++part) {
        const Steps steps = runCase(parts.path(), first);
        EXPECT_EQ(steps.deltaT.size(), 7U);
        got.insert(got.end(), steps.deltaT.begin(), steps.deltaT.end());
    }
    const Steps rest = runCase(parts.path(), control);
    got.insert(got.end(), rest.deltaT.begin(), rest.deltaT.end());
    EXPECT_EQ(expected.deltaT, got);
    EXPECT_EQ(expected.state, rest.state);
    EXPECT_EQ(names(whole.path()), names(parts.path()));
}

TEST(RunTime, fixedStepsWriteAtTheStepThatReachesTheInterval)
{
    ControlDict control;
    control.endTime = 0.3;
    control.deltaT = 0.001;
    control.writeControl = WriteControl::runTime;
    control.writeInterval = 0.1;
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    const Steps steps = runCase(testCase.path(), control);
    EXPECT_EQ(steps.deltaT, std::vector<double>(300, 0.001)) << "fixed steps are never changed";
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.1", "0.2", "0.3"}));
}

TEST(RunTime, endStateIsWrittenUnlessWritingIsOff)
{
    ControlDict control;
    control.endTime = 0.05;
    control.deltaT = 0.01;
    control.writeInterval = 1000;
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    EXPECT_EQ(runCase(testCase.path(), control).deltaT.size(), 5U);
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.05"}));
    EXPECT_EQ(runCase(testCase.path(), control).deltaT.size(), 0U) << "a finished run has nothing left to do";

    const TemporaryCase silent;
    silent.write("0/U", "");
    control.writeControl = WriteControl::none;
    runCase(silent.path(), control);
    EXPECT_EQ(names(silent.path()), (Names{"0"}));
}

TEST(RunTime, namesGrowWhereTwoStepsWouldShareOne)
{
    EXPECT_EQ(timeName(0.1 + 0.2, 1e-3, TimeFormat::general, 6), "0.3");
    EXPECT_EQ(timeName(12.3456, 1e-3, TimeFormat::general, 3), "12.3456");
    EXPECT_EQ(timeName(12.34567891, 1e-7, TimeFormat::general, 6), "12.34567891");
    EXPECT_EQ(timeName(0.25, 0.25, TimeFormat::fixed, 3), "0.250");
    EXPECT_EQ(timeName(0.25, 0.25, TimeFormat::scientific, 2), "2.50e-01");

    ControlDict control;
    control.endTime = 1.0 + 2e-7;
    control.deltaT = 2e-8;
    control.writeInterval = 1;
    const TemporaryCase testCase;
    testCase.write("1/U", "");
    runCase(testCase.path(), control);
    EXPECT_EQ(names(testCase.path()).size(), 11U) << "a directory for each of 10 steps, and the start";
}

TEST(RunTime, startIsFoundByTheWordOfControlDict)
{
    const TemporaryCase testCase;
    for (const char* name : {"0", "0.5", "1e1", "2", "constant", "2.x", ".3.writing", "0.orig"}) {
        testCase.write(std::string(name) + "/U", "");
    }
    const auto startOf = [&](StartFrom from, double time = 0) {
        ControlDict control = adjustable(20);
        control.startFrom = from;
        control.startTime = time;
        std::ostringstream text;
        Log log(text);
        return RunTime(testCase.path(), control, log).startName();
    };
    EXPECT_EQ(startOf(StartFrom::firstTime), "0");
    EXPECT_EQ(startOf(StartFrom::latestTime), "1e1");
    EXPECT_EQ(startOf(StartFrom::startTime, 0.5), "0.5");
    try {
        startOf(StartFrom::startTime, 0.6);
        FAIL() << "a start time that is not there was accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems().at(0).message.substr(0, 43),
                  "there is no time directory for startTime 0.");
        EXPECT_EQ(error.problems().at(0).hint, "time directories: 0 0.5 2 1e1");
    }
}

TEST(RunTime, missingStartSaysWhatToDo)
{
    const TemporaryCase testCase;
    const auto hint = [&] {
        std::ostringstream text;
        Log log(text);
        try {
            RunTime(testCase.path(), adjustable(1), log);
        } catch (const InputError& error) {
            return error.problems().at(0).message + " | " + error.problems().at(0).hint;
        }
        return std::string("no error");
    };
    EXPECT_EQ(hint(), "there is no time directory to start from | the initial and boundary conditions go "
                      "into the folder 0");
    testCase.write("0.orig/U", "");
    EXPECT_EQ(hint(), "there is no time directory to start from | copy 0.orig to 0 (restore0Dir in Allrun)");
}

TEST(RunTime, killInTheMiddleOfAWriteLeavesNoHalfTimeDirectory)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    const pid_t child = fork();
    if (child == 0) {
        std::ostringstream text;
        Log log(text);
        RunTime runTime(testCase.path(), adjustable(1), log);
        for (int writes = 0; runTime.running();) {
            runTime.advance(0.01);
            if (runTime.writeTime()) {
                runTime.kept["state"] = {1};
                runTime.write([&](const fs::path& folder) {
                    writeFileAtomically(folder / "p", "content");
                    if (++writes == 3) {
                        raise(SIGKILL);
                    }
                });
            }
        }
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.1", "0.2"}));
    EXPECT_TRUE(fs::exists(testCase.path() / ".0.3.writing/p"))
        << "the test must have been killed within the write";

    runCase(testCase.path(), adjustable(0.4));
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.1", "0.2", "0.3", "0.4"}));
    EXPECT_FALSE(fs::exists(testCase.path() / ".0.3.writing"));
    EXPECT_EQ(testCase.read("0.3/p"), "content");
}

TEST(RunTime, whatAKillLeavesBetweenTwoRenamesIsPutRight)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    testCase.write(".0.1.replaced/p", "old");
    testCase.write(".0.1.writing/p", "new");
    testCase.write(".0.05.removing/p", "purged");
    testCase.write("0.2/p", "kept");
    testCase.write(".0.2.replaced/p", "old");
    testCase.write(".git.writing/config", "not ours");
    std::ostringstream text;
    Log log(text);
    const RunTime runTime(testCase.path(), adjustable(1), log);
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.1", "0.2"}));
    EXPECT_EQ(testCase.read("0.1/p"), "old");
    EXPECT_EQ(testCase.read("0.2/p"), "kept");
    EXPECT_FALSE(fs::exists(testCase.path() / ".0.1.writing"));
    EXPECT_FALSE(fs::exists(testCase.path() / ".0.05.removing"));
    EXPECT_TRUE(fs::exists(testCase.path() / ".git.writing"));
    EXPECT_NE(text.str().find(".0.05.removing removed: left behind by a run that was killed"),
              std::string::npos);
}

TEST(RunTime, writeOverAnOldTimeDirectoryReplacesItAsAWhole)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    testCase.write("0.1/staleField", "of an earlier run");
    ControlDict control = adjustable(0.1);
    control.startFrom = StartFrom::firstTime;
    runCase(testCase.path(), control);
    EXPECT_EQ(testCase.read("0.1/p"), "content");
    EXPECT_FALSE(fs::exists(testCase.path() / "0.1/staleField"));
    EXPECT_FALSE(fs::exists(testCase.path() / ".0.1.writing"));
}

TEST(RunTime, failedWriteLeavesTheCaseAsItWas)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    std::ostringstream text;
    Log log(text);
    RunTime runTime(testCase.path(), adjustable(1), log);
    runTime.advance(1);
    ASSERT_TRUE(runTime.writeTime());
    EXPECT_THROW(runTime.write([](const fs::path& folder) { throw WriteError(folder / "p", ENOSPC); }),
                 WriteError);
    EXPECT_EQ(names(testCase.path()), (Names{"0"}));
    EXPECT_EQ(std::distance(fs::directory_iterator(testCase.path()), {}), 1);
}

TEST(RunTime, purgeWriteKeepsTheNewestAlsoAfterARestart)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    ControlDict control = adjustable(0.5);
    control.purgeWrite = 2;
    runCase(testCase.path(), control);
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.4", "0.5"})) << "0 holds the user's input and stays";
    control.endTime = 0.7;
    runCase(testCase.path(), control);
    EXPECT_EQ(names(testCase.path()), (Names{"0", "0.4", "0.6", "0.7"}));
}

TEST(RunTime, copiedTimeDirectoryStartsFromItsName)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    runCase(testCase.path(), adjustable(0.3));
    fs::rename(testCase.path() / "0.3", testCase.path() / "7");
    std::ostringstream text;
    Log log(text);
    const RunTime runTime(testCase.path(), adjustable(8), log);
    EXPECT_EQ(runTime.time(), 7);
    EXPECT_EQ(runTime.index(), 0);
    EXPECT_NE(text.str().find("7/uniform/time was written for time 0.3: the run goes on from 7"),
              std::string::npos)
        << text.str();
}

TEST(RunTime, signalsWriteAndStop)
{
    struct Expected
    {
        int signal;
        std::size_t steps;
        Names names;
    };
    // Raised after step 3; looked at in step 4.
    const std::vector<Expected> all{{SIGUSR2, 10, {"0", "0.04", "0.1"}},
                                    {SIGUSR1, 4, {"0", "0.04"}},
                                    {SIGTERM, 4, {"0", "0.04"}},
                                    {SIGINT, 4, {"0", "0.04"}}};
    for (const Expected& expected : all) {
        const TemporaryCase testCase;
        testCase.write("0/U", "");
        ControlDict control;
        control.endTime = 0.1;
        control.deltaT = 0.01;
        control.writeInterval = 100;
        const Steps steps = runCase(testCase.path(), control, [&](const RunTime& runTime) {
            if (runTime.index() == 3) {
                raise(expected.signal);
            }
        });
        EXPECT_EQ(steps.deltaT.size(), expected.steps) << "signal " << expected.signal;
        EXPECT_EQ(names(testCase.path()), expected.names) << "signal " << expected.signal;
    }
}

TEST(RunTime, secondTermEndsTheProcess)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    const pid_t child = fork();
    if (child == 0) {
        const SignalWatch watch;
        raise(SIGTERM);
        raise(SIGTERM);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
}

TEST(RunTime, stopFileDoesAsItSays)
{
    const auto run = [](const std::string& content) {
        const TemporaryCase testCase;
        testCase.write("0/U", "");
        ControlDict control;
        control.endTime = 0.2;
        control.deltaT = 0.01;
        control.writeInterval = 8;
        runCase(testCase.path(), control, [&](const RunTime& runTime) {
            if (runTime.index() == 2) {
                testCase.write("stop", content);
                std::this_thread::sleep_for(std::chrono::milliseconds(60));
            }
        });
        EXPECT_FALSE(fs::exists(testCase.path() / "stop")) << content;
        return names(testCase.path());
    };
    EXPECT_EQ(run(""), (Names{"0", "0.03"}));
    EXPECT_EQ(run("action=writeNow\n"), (Names{"0", "0.03"}));
    EXPECT_EQ(run("action = noWriteNow;\n"), (Names{"0"}));
    EXPECT_EQ(run("nextWrite"), (Names{"0", "0.08"}));
    EXPECT_EQ(run("action=rubbish"), (Names{"0", "0.08", "0.16", "0.2"}));
}

TEST(RunTime, oldStopFileDoesNotStopANewRun)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    testCase.write("stop", "");
    EXPECT_GT(runCase(testCase.path(), adjustable(0.1)).deltaT.size(), 5U);
    EXPECT_FALSE(fs::exists(testCase.path() / "stop"));
}

TEST(RunTime, controlDictIsReadAgainWhereItChanges)
{
    for (const bool modifiable : {true, false}) {
        const TemporaryCase testCase;
        testCase.write("0/U", "");
        const std::string start = "deltaT 0.01; writeInterval 100; runTimeModifiable " +
                                  std::string(modifiable ? "yes" : "no") + "; endTime ";
        testCase.write("system/controlDict", start + "0.2;");
        InputProblems problems;
        const ControlDict control = readControlDict(testCase.path(), problems);
        problems.throwIfAny("test");
        const auto change = [&](const std::string& text) {
            testCase.write("system/controlDict", text);
            fs::last_write_time(testCase.path() / "system/controlDict",
                                fs::file_time_type::clock::now() + std::chrono::seconds(text.size()));
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
        };
        const Steps steps = runCase(testCase.path(), control, [&](const RunTime& runTime) {
            if (runTime.index() == 2) {
                change("rubbish is here 0.1;"); // must not end the run
            }
            if (runTime.index() == 5) {
                change(start + "0.1;");
            }
        });
        EXPECT_EQ(steps.deltaT.size(), modifiable ? 10U : 20U);
    }
}

TEST(RunTime, uselessStepIsAnError)
{
    const TemporaryCase testCase;
    testCase.write("1/U", "");
    std::ostringstream text;
    Log log(text);
    RunTime runTime(testCase.path(), adjustable(2), log);
    EXPECT_THROW(runTime.advance(0), std::runtime_error);
    EXPECT_THROW(runTime.advance(std::nan("")), std::runtime_error);
    EXPECT_THROW(runTime.advance(1e-18), std::runtime_error);
}
