#include "case/Monitor.h"

#include "case/FileIO.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <limits>
#include <stdexcept>
#include <unistd.h>
#include <utility>

namespace caisson {

namespace fs = std::filesystem;

namespace {

void appendNumber(std::string& line, double value)
{
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.10g", value);
    line += text.data();
}

} // namespace

Monitor::Monitor(const fs::path& caseDirectory, std::string_view name, std::string_view startTime,
                 std::string_view file, const std::vector<MonitorColumn>& columns, double interval)
    : path_(caseDirectory / "postProcessing" / name / startTime / (std::string(file) + ".dat")),
      columns_(columns.size()), interval_(interval), next_(-std::numeric_limits<double>::infinity())
{
    std::string header = "# Time [s]";
    std::string names = "# Time";
    for (const MonitorColumn& column : columns) {
        header += ", " + column.name + " [" + column.unit + "]";
        names += "\t" + column.name;
    }
    writeFileAtomically(path_, header + "\n" + names + "\n");
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0) {
        throw WriteError(path_, errno);
    }
}

Monitor::~Monitor()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

Monitor::Monitor(Monitor&& other) noexcept
    : path_(std::move(other.path_)), columns_(other.columns_), interval_(other.interval_), next_(other.next_),
      descriptor_(std::exchange(other.descriptor_, -1))
{
}

bool Monitor::due(double time) const { return time >= next_; }

void Monitor::record(double time, std::span<const double> values)
{
    if (values.size() != columns_) {
        throw std::logic_error("monitor " + path_.string() + ": " + std::to_string(values.size()) +
                               " values for " + std::to_string(columns_) + " columns");
    }
    if (!due(time)) {
        return;
    }
    if (interval_ > 0) {
        next_ = (std::floor(time / interval_ + 1e-9) + 1 - 1e-9) * interval_;
    }
    std::string line;
    appendNumber(line, time);
    for (const double value : values) {
        line += '\t';
        appendNumber(line, value);
    }
    line += '\n';
    // One call per line: whoever reads meanwhile, or after a kill, meets whole lines.
    const ssize_t written = ::write(descriptor_, line.data(), line.size());
    if (written != static_cast<ssize_t>(line.size())) {
        throw WriteError(path_, written < 0 ? errno : ENOSPC);
    }
}

} // namespace caisson
