#include "case/RunTime.h"

#include "case/FileIO.h"
#include "case/FoamScanner.h"
#include "case/Log.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>

namespace caisson {

namespace fs = std::filesystem;

namespace {

// Hidden names next to a time directory T: ".T.writing" is not complete yet, ".T.removing" is on its way out,
// ".T.replaced" is the old one while the new one takes its place.
constexpr const char* writing = ".writing";
constexpr const char* removing = ".removing";
constexpr const char* replaced = ".replaced";

fs::path hidden(const fs::path& directory, const std::string& name, const char* suffix)
{
    return directory / ("." + name + suffix);
}

/// The number that the whole text is; nothing where it is none.
bool isNumber(std::string_view text, double& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

std::string seventeenDigits(double value)
{
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.17g", value);
    return text.data();
}

void removeFolder(const fs::path& folder)
{
    std::error_code error;
    fs::remove_all(folder, error);
    if (error) {
        throw WriteError(folder, error.value());
    }
}

/// Puts `made` in the place of `target` (which may exist) in one step where the file system can.
void publish(const fs::path& made, const fs::path& target)
{
    if (!fs::exists(target)) {
        renameOrThrow(made, target);
        return;
    }
    if (renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) {
        removeFolder(made);
        return;
    }
    const fs::path old = hidden(target.parent_path(), target.filename().string(), replaced);
    renameOrThrow(target, old);
    renameOrThrow(made, target);
    removeFolder(old);
}

} // namespace

std::vector<TimeDirectory> timeDirectories(const fs::path& caseDirectory)
{
    std::vector<TimeDirectory> times;
    for (const auto& item : fs::directory_iterator(caseDirectory)) {
        TimeDirectory time{0, item.path().filename().string()};
        if (item.is_directory() && isNumber(time.name, time.value)) {
            times.push_back(std::move(time));
        }
    }
    std::sort(times.begin(), times.end(), [](const auto& a, const auto& b) {
        return a.value != b.value ? a.value < b.value : a.name < b.name;
    });
    return times;
}

std::string timeName(double value, double deltaT, TimeFormat format, int precision)
{
    const auto print = [&](int digits) {
        const char* const how = format == TimeFormat::fixed        ? "%.*f"
                                : format == TimeFormat::scientific ? "%.*e"
                                                                   : "%.*g";
        std::array<char, 400> text;
        std::snprintf(text.data(), text.size(), how, digits, value);
        return std::string(text.data());
    };
    // So no two steps share a name, and rounding noise stays out of it.
    constexpr int exact = 17;
    while (precision < exact &&
           std::abs(std::strtod(print(precision).c_str(), nullptr) - value) > 0.1 * deltaT) {
        ++precision;
    }
    return print(precision);
}

RunTime::RunTime(fs::path caseDirectory, ControlDict control, Log& log)
    : caseDirectory_(std::move(caseDirectory)), control_(std::move(control)), log_(log)
{
    for (const std::string& remark : control_.remarks) {
        log_.warning(remark);
    }
    removeLeftovers();
    findStart();
    if (fileExists(startDirectory() / "uniform/time")) {
        readUniformTime();
    }
    startValue_ = value_;
    if (restarted_ && startName_ != "0") {
        writtenNames_.push_back(startName_);
    }
    if (fs::remove(caseDirectory_ / "stop")) {
        log_.warning("an old file 'stop' was in the case: removed, the run starts");
    }
    std::error_code ignored;
    controlDictTime_ = fs::last_write_time(caseDirectory_ / "system/controlDict", ignored);

    if (atEnd()) {
        stopReason_ = "endTime was reached before";
    } else if (control_.stopAt != StopAt::endTime) {
        stopBy(control_.stopAt, "stopAt in controlDict");
    }
}

void RunTime::removeLeftovers()
{
    std::vector<fs::path> folders;
    for (const auto& item : fs::directory_iterator(caseDirectory_)) {
        folders.push_back(item.path());
    }
    for (const fs::path& folder : folders) {
        const std::string name = folder.filename().string();
        for (const std::string suffix : {writing, removing, replaced}) {
            double value = 0;
            if (!name.starts_with('.') || !name.ends_with(suffix) || !fs::is_directory(folder) ||
                name.size() <= suffix.size() + 1) {
                continue;
            }
            const std::string time = name.substr(1, name.size() - 1 - suffix.size());
            if (!isNumber(time, value)) {
                continue;
            }
            if (suffix == replaced && !fs::exists(caseDirectory_ / time)) {
                log_.warning("time directory " + time +
                             " taken back: a run was killed while it was replaced");
                renameOrThrow(folder, caseDirectory_ / time);
            } else {
                log_.warning(name + " removed: left behind by a run that was killed");
                removeFolder(folder);
            }
        }
    }
}

void RunTime::findStart()
{
    const std::vector<TimeDirectory> times = timeDirectories(caseDirectory_);
    const std::string subject = "case " + caseDirectory_.string();
    if (times.empty()) {
        throw InputError(subject, {{{"0", 0},
                                    "there is no time directory to start from",
                                    fs::is_directory(caseDirectory_ / "0.orig")
                                        ? "copy 0.orig to 0 (restore0Dir in Allrun)"
                                        : "the initial and boundary conditions go into the folder 0"}});
    }
    auto start = times.begin();
    if (control_.startFrom == StartFrom::latestTime) {
        start = times.end() - 1;
    } else if (control_.startFrom == StartFrom::startTime) {
        const double wanted = control_.startTime;
        const auto distance = [&](const TimeDirectory& time) { return std::abs(time.value - wanted); };
        start = std::min_element(times.begin(), times.end(),
                                 [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
        // Names carry 6 digits by default.
        if (distance(*start) > 1e-6 * std::max(std::abs(wanted), 1e-3)) {
            std::string names;
            for (const TimeDirectory& time : times) {
                names += " " + time.name;
            }
            throw InputError(subject, {{{"system/controlDict", 0},
                                        "there is no time directory for startTime " + seventeenDigits(wanted),
                                        "time directories:" + names}});
        }
    }
    startName_ = start->name;
    value_ = start->value;
    if (start + 1 != times.end()) {
        log_.warning("there are time directories after the start (" + (start + 1)->name + " ... " +
                     times.back().name +
                     "): this run writes over those that it reaches, and leaves the others");
    }
}

void RunTime::readUniformTime()
{
    FoamScanner in(startDirectory() / "uniform/time", startName_ + "/uniform/time");
    std::string name;
    double value = value_;
    while (in.peek() != '\0') {
        const std::string key = in.word();
        if (key == "value") {
            value = in.scalar();
        } else if (key == "name") {
            name = in.word();
        } else if (key == "index") {
            index_ = static_cast<long>(in.scalar());
        } else if (key == "deltaT") {
            deltaT_ = in.scalar();
        } else if (key == "deltaT0") {
            deltaT0_ = in.scalar();
        } else if (key == "solver") {
            in.expect('{');
            while (!in.accept('}')) {
                const std::string what = in.word();
                kept[what] = in.scalarList(1);
                in.expect(';');
            }
            continue;
        }
        in.skipEntry();
    }
    restarted_ = true;
    if (name == startName_) {
        value_ = value;
    } else {
        log_.warning(startName_ + "/uniform/time was written for time " + name + ": the run goes on from " +
                     startName_);
        index_ = 0;
    }
}

std::string RunTime::timeName() const
{
    return advanced_ ? caisson::timeName(value_, deltaT_, control_.timeFormat, control_.timePrecision)
                     : startName_;
}

double RunTime::wantedDeltaT(double stable) const
{
    return control_.adjustTimeStep ? std::min(control_.maxCo * stable, control_.maxDeltaT) : control_.deltaT;
}

double RunTime::writesUpTo(double value, double deltaT) const
{
    // A time that misses its multiple of the interval by rounding counts as having reached it.
    const double tolerance = std::max(1e-3 * deltaT / control_.writeInterval, 1e-9);
    return std::floor(value / control_.writeInterval + tolerance);
}

bool RunTime::atEnd() const { return value_ >= control_.endTime - 0.5 * deltaT_; }

bool RunTime::scheduledWrite(double writesBefore)
{
    switch (control_.writeControl) {
    case WriteControl::none:
        return false;
    case WriteControl::timeStep:
        return index_ % std::max(1L, std::lround(control_.writeInterval)) == 0;
    case WriteControl::runTime:
    case WriteControl::adjustableRunTime:
        return writesUpTo(value_, deltaT_) > writesBefore;
    case WriteControl::clockTime:
    case WriteControl::cpuTime: {
        const double seconds =
            control_.writeControl == WriteControl::clockTime ? log_.clockSeconds() : Log::processorSeconds();
        const double writes = std::floor(seconds / control_.writeInterval);
        const bool due = writes > clockWrites_;
        clockWrites_ = std::max(writes, clockWrites_);
        return due;
    }
    }
    return false;
}

double RunTime::advance(double wanted)
{
    if (!(wanted > 0) || !std::isfinite(wanted)) {
        throw std::runtime_error("time step " + seventeenDigits(wanted) + " s at time " + timeName() +
                                 " is not a positive number");
    }
    lookAtSignals();
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (now - lastLook_ > 50ms) {
        lastLook_ = now;
        lookAtStopFile();
        lookAtControlDict();
    }

    const double writesBefore = writesUpTo(value_, deltaT_);
    double step = wanted;
    double next = value_ + wanted;
    if (control_.writeControl == WriteControl::adjustableRunTime) {
        const double nextWrite = (writesBefore + 1) * control_.writeInterval;
        const double steps = std::max(1.0, std::ceil((nextWrite - value_) / wanted * (1 - 1e-9)));
        step = (nextWrite - value_) / steps;
        next = steps == 1 ? nextWrite : value_ + step;
    }
    if (next <= value_) {
        throw std::runtime_error("time step " + seventeenDigits(wanted) + " s does not move time " +
                                 seventeenDigits(value_) + " s on");
    }
    deltaT0_ = deltaT_;
    deltaT_ = step;
    value_ = next;
    ++index_;
    advanced_ = true;

    writeTime_ = scheduledWrite(writesBefore);
    if (writeTime_ && stopAtNextWrite_ && stopReason_.empty()) {
        stopReason_ = "stopped at the next write";
    }
    if (atEnd() && stopReason_.empty()) {
        stopReason_ = "endTime reached";
        writeTime_ = writeTime_ || control_.writeControl != WriteControl::none;
    }
    writeTime_ = writeTime_ || writeRequested_;
    writeRequested_ = false;
    return step;
}

void RunTime::stop(std::string reason, bool andWrite)
{
    stopReason_ = std::move(reason);
    writeTime_ = writeTime_ || andWrite;
}

void RunTime::stopBy(StopAt action, const std::string& reason)
{
    switch (action) {
    case StopAt::endTime:
        stopAtNextWrite_ = false;
        break;
    case StopAt::nextWrite:
        stopAtNextWrite_ = true;
        break;
    case StopAt::writeNow:
        writeRequested_ = true;
        stopReason_ = reason + ": written and stopped";
        break;
    case StopAt::noWriteNow:
        stopReason_ = reason + ": stopped without writing";
        break;
    }
}

void RunTime::lookAtSignals()
{
    constexpr std::array<std::pair<int, const char*>, 3> stopping{
        {{SIGUSR1, "signal USR1"}, {SIGTERM, "signal TERM"}, {SIGINT, "signal INT"}}};
    for (const auto& [signal, name] : stopping) {
        if (SignalWatch::came(signal)) {
            log_.line(std::string(name) + ": writing and stopping at the end of this step" +
                      (signal == SIGUSR1 ? "" : " (once more to end at once)"));
            stopBy(StopAt::writeNow, name);
        }
    }
    if (SignalWatch::came(SIGUSR2)) {
        log_.line("signal USR2: writing at the end of this step");
        writeRequested_ = true;
    }
}

void RunTime::lookAtStopFile()
{
    const fs::path file = caseDirectory_ / "stop";
    if (!fs::exists(file)) {
        return;
    }
    std::string content = fs::is_regular_file(file) ? readFile(file, "stop") : std::string();
    std::erase_if(content, [](unsigned char c) { return std::isspace(c) != 0 || c == ';'; });
    fs::remove(file);

    std::string action = content.starts_with("action=") ? content.substr(7) : content;
    action = action.empty() ? "writeNow" : action;
    const std::map<std::string, StopAt> actions{{"endTime", StopAt::endTime},
                                                {"nextWrite", StopAt::nextWrite},
                                                {"noWriteNow", StopAt::noWriteNow},
                                                {"writeNow", StopAt::writeNow}};
    const auto found = actions.find(action);
    if (found == actions.end()) {
        log_.warning("file 'stop': unknown action '" + action.substr(0, 40) +
                     "', the run goes on; valid: endTime nextWrite noWriteNow writeNow");
        return;
    }
    log_.line("file 'stop': " + action);
    stopBy(found->second, "file 'stop'");
}

void RunTime::lookAtControlDict()
{
    std::error_code missing;
    const auto changed = fs::last_write_time(caseDirectory_ / "system/controlDict", missing);
    if (!control_.runTimeModifiable || missing || changed == controlDictTime_) {
        return;
    }
    controlDictTime_ = changed;
    // The file may be half saved, or wrong: a run of days does not end for that.
    try {
        InputProblems problems;
        ControlDict control = readControlDict(caseDirectory_, problems);
        problems.throwIfAny("system/controlDict");
        const bool newStop = control.stopAt != control_.stopAt;
        control_ = std::move(control);
        log_.line("controlDict has changed and was read again");
        if (newStop) {
            stopBy(control_.stopAt, "stopAt in controlDict");
        }
    } catch (const InputError& error) {
        log_.warning(std::string("controlDict has changed, but is wrong; the run goes on as before.\n") +
                     error.what());
    }
}

void RunTime::write(const std::function<void(const fs::path& timeDirectory)>& fill)
{
    const std::string name = timeName();
    const fs::path folder = hidden(caseDirectory_, name, writing);
    try {
        removeFolder(folder);
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) {
            throw WriteError(folder, error.value());
        }
        fill(folder);
        writeUniformTime(folder);
        publish(folder, caseDirectory_ / name);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        throw;
    }
    purge(name);
}

void RunTime::writeUniformTime(const fs::path& timeDirectory) const
{
    std::string body = "value           " + seventeenDigits(value_) + ";\n\nname            \"" + timeName() +
                       "\";\n\nindex           " + std::to_string(index_) + ";\n\ndeltaT          " +
                       seventeenDigits(deltaT_) + ";\n\ndeltaT0         " + seventeenDigits(deltaT0_) + ";";
    if (!kept.empty()) {
        body += "\n\n// What the solver's next steps depend on.\nsolver\n{\n";
        for (const auto& [what, values] : kept) {
            body += "    " + what + " " + std::to_string(values.size()) + "(";
            for (std::size_t i = 0; i < values.size(); ++i) {
                body += (i == 0 ? "" : " ") + seventeenDigits(values[i]);
            }
            body += ");\n";
        }
        body += "}";
    }
    writeDictionaryFile(timeDirectory, "uniform", "time", body);
}

void RunTime::purge(const std::string& written)
{
    std::erase(writtenNames_, written);
    writtenNames_.push_back(written);
    while (control_.purgeWrite > 0 && writtenNames_.size() > static_cast<std::size_t>(control_.purgeWrite)) {
        const std::string name = writtenNames_.front();
        writtenNames_.erase(writtenNames_.begin());
        if (fs::exists(caseDirectory_ / name)) {
            const fs::path out = hidden(caseDirectory_, name, removing);
            renameOrThrow(caseDirectory_ / name, out);
            removeFolder(out);
        }
    }
}

} // namespace caisson
