#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

class RunTime;

/// Version of the program and the commit it was built from, e.g. "0.1.0 (a6a1ad5)".
std::string_view buildVersion();

/// What a body adds to a block of the log. Forces act on the body, upward positive [N].
struct BodyReport
{
    std::string name;
    double tipForce = 0, innerForce = 0, outerForce = 0, lidForce = 0, totalForce = 0;
    double penetration = 0;           ///< [m]
    double normalisedPenetration = 0; ///< penetration over the reference length [-]
    double velocity = 0;              ///< upward positive [m/s]
    double suction = 0;               ///< [Pa]
    double plugHeave = 0;             ///< rise of the soil surface inside [m]
};

/// What the log says of a step.
struct StepReport
{
    double courantMean = 0, courantMax = 0; ///< fraction of the stable step, over the cells [-]
    double kineticEnergy = 0;               ///< [J]
    double strainWork = 0;                  ///< work of the stresses since the start of the run [J]
    std::vector<BodyReport> bodies;
    std::vector<std::string> lines; ///< anything else, printed as it stands
    double pointSteps = 0;          ///< material points advanced by this step, for the rate
};

/// The log of a solver, in the form that foamLog, foamMonitor and PyFoam read:
///
///     Time = 0.005
///     Courant Number mean: 0.097 max: 0.8
///     deltaT = 1.25e-05
///     Energy: kinetic = 1.2 J, strain work = 340 J, ratio = 0.0035
///     Reaction caisson: tip = 1e3 N, inner = 2e3 N, outer = 2e3 N, lid = 0 N, total = 5e3 N
///     Penetration caisson: depth = 1.4 m, normalised = 0.28, velocity = -0.166 m/s, suction = 0 Pa, plug
///     heave = 0.02 m Progress: 37 %, time left = 00:12:40, 2.1e+06 point steps/s ExecutionTime = 0.01 s
///     ClockTime = 0 s
///
/// The ratio is kinetic energy over strain work: small where the process is quasi-static. etc/foamLog.db
/// names these quantities for foamLog.
class Log
{
public:
    explicit Log(std::ostream& out);

    /// Exec, Date, Host, PID, Case, version.
    void banner(std::string_view commandLine, const std::filesystem::path& caseDirectory);
    void line(std::string_view text); ///< flushed
    void warning(std::string_view text);
    /// The block of a step: at every logInterval-th step, and where the step is written or the last one.
    void step(const RunTime& runTime, const StepReport& report);
    /// Number of steps, times, rate, why the run stopped; and "End".
    void end(const RunTime& runTime);

    [[nodiscard]] double clockSeconds() const; ///< since the log was made
    static double processorSeconds();          ///< of this process, all threads

private:
    void times();
    [[nodiscard]] std::string progress(const RunTime& runTime) const;

    std::ostream& out_;
    std::chrono::steady_clock::time_point start_;
    double loopStart_ = 0;     ///< clock seconds at the end of the first step
    double loopStartTime_ = 0; ///< simulated time then
    double pointSteps_ = 0;
    long steps_ = 0;
};

} // namespace caisson
