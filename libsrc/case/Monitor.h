#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

struct MonitorColumn
{
    std::string name; ///< one word
    std::string unit;
};

/// A table over time: `<case>/postProcessing/<name>/<startTime>/<file>.dat`, a new folder for each start of a
/// run, as OpenFOAM does; the file of an earlier run from the same time is replaced. The header says name and
/// unit of each column; its last line has the bare names (foamMonitor, numpy.genfromtxt(names=True)).
///
/// Every record goes to the system at once: a kill loses nothing, or the line it interrupts.
class Monitor
{
public:
    /// @param startTime  name of the time directory that the run starts from
    /// @param interval  least time between two records [s]; 0 records every call
    /// @throws WriteError
    Monitor(const std::filesystem::path& caseDirectory, std::string_view name, std::string_view startTime,
            std::string_view file, const std::vector<MonitorColumn>& columns, double interval = 0);
    ~Monitor();
    Monitor(Monitor&& other) noexcept;
    Monitor(const Monitor&) = delete;
    Monitor& operator=(const Monitor&) = delete;
    Monitor& operator=(Monitor&&) = delete;

    /// Whether a record at this time would be kept (so that costly values are not worked out in vain).
    [[nodiscard]] bool due(double time) const;
    /// Appends a line where due: time, then one value per column. @throws WriteError
    void record(double time, std::span<const double> values);

private:
    std::filesystem::path path_;
    std::size_t columns_ = 0;
    double interval_ = 0;
    double next_ = 0;
    int descriptor_ = -1;
};

} // namespace caisson
