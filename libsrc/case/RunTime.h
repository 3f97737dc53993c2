#pragma once

#include "case/ControlDict.h"
#include "case/Signals.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

class Log;

/// The time directories of a case (folders whose whole name is a number), ascending by value.
struct TimeDirectory
{
    double value = 0;
    std::string name;
};
std::vector<TimeDirectory> timeDirectories(const std::filesystem::path& caseDirectory);

/// Name of a time. The precision grows until the name is true to a tenth of the time step.
std::string timeName(double value, double deltaT, TimeFormat format, int precision);

/// Time of a run: where it starts, how it advances, what is written when, and what ends it.
///
///     while (runTime.running()) {
///         const double deltaT = runTime.advance(wanted);
///         ... one step of deltaT ...
///         if (runTime.writeTime()) { runTime.write([&](const auto& timeDirectory) { ... }); }
///     }
///
/// A run that is split at a write and continued with `startFrom latestTime` takes the same steps, to the bit:
/// every decision follows from the time, the step, and `wanted`; `<time>/uniform/time` keeps these with 17
/// digits, and `kept` for whatever else the solver's steps depend on. endTime is therefore not a write time
/// that steps are shortened for: the run stops at the step nearest to it, and that state is written.
///
/// Signals, always on: USR2 writes; USR1, TERM and INT write and stop (a second TERM or INT ends the process
/// at once). A file `stop` in the case does as its content says: `action=` writeNow (also when empty),
/// noWriteNow, nextWrite or endTime; it is removed when read.
class RunTime
{
public:
    /// Finds the time directory to start from and its uniform/time; removes what a killed run left behind.
    /// @throws InputError where there is no such time directory
    RunTime(std::filesystem::path caseDirectory, ControlDict control, Log& log);
    [[nodiscard]] const std::filesystem::path& caseDirectory() const { return caseDirectory_; }
    [[nodiscard]] const std::string& startName() const { return startName_; }
    [[nodiscard]] std::filesystem::path startDirectory() const { return caseDirectory_ / startName_; }
    /// Whether the start directory was written by a run (has uniform/time), so holds its whole state.
    [[nodiscard]] bool restarted() const { return restarted_; }
    [[nodiscard]] const ControlDict& control() const { return control_; }

    [[nodiscard]] double startTime() const { return startValue_; } ///< [s]
    [[nodiscard]] double time() const { return value_; }           ///< [s]
    [[nodiscard]] long index() const { return index_; }            ///< steps since time 0
    [[nodiscard]] double deltaT() const { return deltaT_; }        ///< the last step [s]; 0 before the first
    [[nodiscard]] double deltaT0() const { return deltaT0_; }      ///< the step before it [s]
    [[nodiscard]] std::string timeName() const;

    /// Numbers of the solver that go into uniform/time and come back at a restart, by name (one word).
    std::map<std::string, std::vector<double>> kept;

    /// Whether another step is to be made.
    [[nodiscard]] bool running() const { return stopReason_.empty(); }
    /// Time step [s] that controlDict asks for: deltaT, or with adjustTimeStep min(maxCo stable, maxDeltaT).
    [[nodiscard]] double wantedDeltaT(double stable) const;
    /// Moves time on by `wanted` [s], or by a little less where writeControl adjustableRunTime needs the
    /// steps to fall on the next write time. Looks at signals, the stop file and controlDict.
    /// @return the step taken
    double advance(double wanted);
    /// Whether the state after the present step is to be written.
    [[nodiscard]] bool writeTime() const { return writeTime_; }
    /// Why the run ends with the present step, in the user's words; empty while it goes on.
    [[nodiscard]] const std::string& stopReason() const { return stopReason_; }

    /// Ends the run after the present step (a solver's own reason); it is written where `writing`.
    void stop(std::string reason, bool writing);

    /// Writes the present time: `fill` writes into a hidden folder, which becomes <case>/<time> when
    /// complete. Then purgeWrite removes old ones. @throws WriteError; the time directory is then not there
    void write(const std::function<void(const std::filesystem::path& timeDirectory)>& fill);

private:
    void findStart();
    void readUniformTime();
    void removeLeftovers();
    void writeUniformTime(const std::filesystem::path& timeDirectory) const;
    void purge(const std::string& written);
    [[nodiscard]] double writesUpTo(double value, double deltaT) const;
    [[nodiscard]] bool atEnd() const;
    [[nodiscard]] bool scheduledWrite(double writesBefore);
    void lookAtSignals();
    void lookAtStopFile();
    void lookAtControlDict();
    void stopBy(StopAt action, const std::string& reason);

    std::filesystem::path caseDirectory_;
    ControlDict control_;
    Log& log_;

    std::string startName_;
    bool restarted_ = false;
    double startValue_ = 0, value_ = 0, deltaT_ = 0, deltaT0_ = 0;
    long index_ = 0;
    bool advanced_ = false; ///< a step has been made

    bool writeTime_ = false;
    bool writeRequested_ = false;
    bool stopAtNextWrite_ = false;
    std::string stopReason_;
    double clockWrites_ = 0;                ///< intervals of clockTime or cpuTime that have been written
    std::vector<std::string> writtenNames_; ///< for purgeWrite, oldest first
    SignalWatch signals_;
    std::filesystem::file_time_type controlDictTime_;
    std::chrono::steady_clock::time_point lastLook_;
};

} // namespace caisson
