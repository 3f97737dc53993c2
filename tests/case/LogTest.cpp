#include "case/Log.h"

#include "TemporaryCase.h"
#include "case/Monitor.h"
#include "case/RunTime.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

using namespace caisson;

namespace {

/// A log of 20 steps with two bodies; step i has kinetic energy i.
std::string sampleLog(int logInterval)
{
    const TemporaryCase testCase;
    testCase.write("0/U", "");
    ControlDict control;
    control.endTime = 0.2;
    control.deltaT = 0.01;
    control.writeInterval = 15;
    control.logInterval = logInterval;
    std::ostringstream text;
    Log log(text);
    log.banner("axiMpmFoam -case here", testCase.path());
    RunTime runTime(testCase.path(), control, log);
    while (runTime.running()) {
        runTime.advance(control.deltaT);
        StepReport report;
        report.courantMean = 0.125;
        report.courantMax = 0.75;
        report.kineticEnergy = static_cast<double>(runTime.index());
        report.strainWork = -200;
        report.pointSteps = 1000;
        report.bodies.resize(2);
        report.bodies[0] = {"caisson", 1, 2, 3, 4, 10, 1.5, 0.3, -0.2, 5000, 0.0625};
        report.bodies[1].name = "anchor";
        report.bodies[1].totalForce = -1e6;
        report.lines = {"Contact: 12 nodes"};
        log.step(runTime, report);
        if (runTime.writeTime()) {
            runTime.write([](const auto&) {});
        }
    }
    log.end(runTime);
    return text.str();
}

struct Selector
{
    std::string name, line, column;
};

std::vector<Selector> readSelectors()
{
    std::vector<Selector> selectors;
    std::ifstream in(CAISSON_SOURCE_DIR "/etc/foamLog.db");
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line.front() == '#') {
            continue;
        }
        const std::size_t first = line.find('/');
        const std::size_t second = line.find('/', first + 1);
        selectors.push_back(
            {line.substr(0, first), line.substr(first + 1, second - first - 1), line.substr(second + 1)});
    }
    return selectors;
}

/// What foamLog does: for each line that a selector matches, the word behind the column text; a second match
/// within one step goes to name_1.
std::map<std::string, std::vector<std::string>> takeColumns(const std::string& text)
{
    const std::vector<Selector> selectors = readSelectors();
    std::map<std::string, std::vector<std::string>> columns;
    std::map<std::string, int> matches;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        for (const Selector& selector : selectors) {
            const std::string expression = std::regex_replace(selector.line, std::regex(R"(\\t)"), "\t");
            if (!std::regex_search(line, std::regex(expression, std::regex::extended))) {
                continue;
            }
            if (selector.name == "Separator") {
                matches.clear();
                continue;
            }
            const std::size_t at = line.find(selector.column);
            EXPECT_NE(at, std::string::npos) << "'" << selector.column << "' is not in: " << line;
            std::string word = line.substr(at + selector.column.size());
            word = word.substr(0, word.find(' '));
            std::erase_if(word, [](char c) { return c == ',' || c == ':'; });
            columns[selector.name + "_" + std::to_string(matches[selector.name]++)].push_back(word);
        }
    }
    return columns;
}

} // namespace

TEST(Log, everyQuantityOfFoamLogDbIsFoundInTheLog)
{
    const auto columns = takeColumns(sampleLog(1));
    for (const Selector& selector : readSelectors()) {
        if (selector.name == "Separator") {
            continue;
        }
        const auto found = columns.find(selector.name + "_0");
        ASSERT_NE(found, columns.end())
            << selector.name << " is in etc/foamLog.db, but in no line of the log";
        for (const std::string& value : found->second) {
            double number = 0;
            std::istringstream in(value);
            EXPECT_TRUE(in >> number && in.eof()) << selector.name << ": '" << value << "' is not a number";
        }

        EXPECT_EQ(found->second.size(), 20U) << selector.name;
    }
    EXPECT_EQ(columns.at("Time_0").at(4), "0.05");
    EXPECT_EQ(columns.at("CourantMean_0").at(0), "0.125");
    EXPECT_EQ(columns.at("CourantMax_0").at(0), "0.75");
    EXPECT_EQ(columns.at("kineticEnergy_0").at(4), "5");
    EXPECT_EQ(columns.at("energyRatio_0").at(4), "0.025");
    EXPECT_EQ(columns.at("reactionLid_0").at(0), "4");
    EXPECT_EQ(columns.at("reactionTotal_0").at(0), "10");
    EXPECT_EQ(columns.at("reactionTotal_1").at(0), "-1e+06");
    EXPECT_EQ(columns.at("penetration_0").at(0), "1.5");
    EXPECT_EQ(columns.at("suction_0").at(0), "5000");
    EXPECT_EQ(columns.at("plugHeave_0").at(0), "0.0625");
}

TEST(Log, intervalThinsTheLogButWritesAndTheEndAreInIt)
{
    const auto columns = takeColumns(sampleLog(6));
    EXPECT_EQ(columns.at("Time_0"), (std::vector<std::string>{"0.06", "0.12", "0.15", "0.18", "0.2"}));
}

TEST(Log, startsWithTheBannerAndEndsWithEnd)
{
    const std::string text = sampleLog(1);
    for (const char* part : {"Version: ", "Exec   : axiMpmFoam -case here\n", "Date   : ", "Host   : ",
                             "PID    : ", "Case   : /", "Contact: 12 nodes\n", "Progress: 50 %",
                             "time left = 00:00:0", "Stopped: endTime reached, at time 0.2 after 20 steps"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part;
    }
    EXPECT_TRUE(text.ends_with("\nEnd\n\n"));
    EXPECT_NE(buildVersion().find("("), std::string_view::npos);
}

TEST(Monitor, headerNamesColumnsAndUnitsAndLinesFollow)
{
    const TemporaryCase testCase;
    const std::string file = "postProcessing/caisson/0.5/reaction.dat";
    Monitor monitor(testCase.path(), "caisson", "0.5", "reaction", {{"depth", "m"}, {"total", "N"}});
    EXPECT_EQ(testCase.read(file), "# Time [s], depth [m], total [N]\n# Time\tdepth\ttotal\n");
    monitor.record(0.6, std::vector<double>{1.0 / 3.0, -2e6});
    EXPECT_EQ(testCase.read(file),
              "# Time [s], depth [m], total [N]\n# Time\tdepth\ttotal\n0.6\t0.3333333333\t-2000000\n")
        << "a record must be in the file at once";
    EXPECT_THROW(monitor.record(0.7, std::vector<double>{1}), std::logic_error);
}

TEST(Monitor, intervalThinsTheRecords)
{
    const TemporaryCase testCase;
    Monitor monitor(testCase.path(), "energy", "0", "energy", {{"kinetic", "J"}}, 0.1);
    for (int i = 0; i <= 100; ++i) {
        monitor.record(0.01 * i, std::vector<double>{1});
    }
    const std::string text = testCase.read("postProcessing/energy/0/energy.dat");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 11) << text;
}

TEST(Monitor, restartMakesANewFolderAndKeepsTheOldFile)
{
    const TemporaryCase testCase;
    for (const char* start : {"0", "0.5"}) {
        Monitor monitor(testCase.path(), "energy", start, "energy", {{"kinetic", "J"}});
        monitor.record(1, std::vector<double>{2});
    }
    EXPECT_EQ(testCase.read("postProcessing/energy/0/energy.dat"),
              testCase.read("postProcessing/energy/0.5/energy.dat"));
    Monitor again(testCase.path(), "energy", "0", "energy", {{"kinetic", "J"}});
    EXPECT_EQ(testCase.read("postProcessing/energy/0/energy.dat").find("1\t2"), std::string::npos)
        << "a run from the same time replaces the records of the one before";
}
