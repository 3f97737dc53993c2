#include "case/Log.h"

#include "case/RunTime.h"
#include "case/Version.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <ostream>
#include <unistd.h>

namespace caisson {

namespace {

/// printf into a string, for one number.
std::string print(const char* format, double value)
{
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

std::string number(double value) { return print("%.6g", value); }

std::string hoursMinutesSeconds(double seconds)
{
    const long all = std::lround(std::min(seconds, 3.6e6 * 99));
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%02ld:%02ld:%02ld", all / 3600, all / 60 % 60, all % 60);
    return text.data();
}

std::string formatted(const std::tm& time, const char* format)
{
    std::array<char, 64> text{};
    std::strftime(text.data(), text.size(), format, &time);
    return text.data();
}

void printBody(std::ostream& out, const BodyReport& body)
{
    out << "Reaction " << body.name << ": tip = " << number(body.tipForce)
        << " N, inner = " << number(body.innerForce) << " N, outer = " << number(body.outerForce)
        << " N, lid = " << number(body.lidForce) << " N, total = " << number(body.totalForce) << " N\n";
    out << "Penetration " << body.name << ": depth = " << number(body.penetration)
        << " m, normalised = " << number(body.normalisedPenetration)
        << ", velocity = " << number(body.velocity) << " m/s, suction = " << number(body.suction)
        << " Pa, plug heave = " << number(body.plugHeave) << " m\n";
}

} // namespace

std::string_view buildVersion() { return CAISSON_VERSION " (" CAISSON_COMMIT ")"; }

Log::Log(std::ostream& out) : out_(out), start_(std::chrono::steady_clock::now()) {}

void Log::banner(std::string_view commandLine, const std::filesystem::path& caseDirectory)
{
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);

    out_ << "/*---------------------------------------------------------------------------*\\\n"
            "| caissonFoam: suction caissons and other foundations going into the seabed   |\n"
            "\\*---------------------------------------------------------------------------*/\n"
         << "Version: " << buildVersion() << "\nExec   : " << commandLine
         << "\nDate   : " << formatted(local, "%b %d %Y") << "\nTime   : " << formatted(local, "%H:%M:%S")
         << "\nHost   : " << host.data() << "\nPID    : " << getpid()
         << "\nCase   : " << std::filesystem::absolute(caseDirectory).lexically_normal().string()
         << "\nnProcs : 1\n"
            "// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //\n\n"
         << std::flush;
}

void Log::line(std::string_view text) { out_ << text << '\n' << std::flush; }

void Log::warning(std::string_view text)
{
    out_ << "--> CAISSONFOAM WARNING : " << text << '\n' << std::flush;
}

double Log::clockSeconds() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double Log::processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void Log::times()
{
    out_ << "ExecutionTime = " << print("%.2f", processorSeconds())
         << " s  ClockTime = " << print("%.0f", std::floor(clockSeconds())) << " s\n\n"
         << std::flush;
}

std::string Log::progress(const RunTime& runTime) const
{
    std::string text;
    const double end = runTime.control().endTime;
    const double elapsed = clockSeconds() - loopStart_;
    const double done = runTime.time() - loopStartTime_;
    if (std::isfinite(end)) {
        const double share = (runTime.time() - runTime.startTime()) / (end - runTime.startTime());
        text += "Progress: " + print("%.0f", std::floor(100 * std::min(share, 1.0) + 1e-6)) + " %";
        if (done > 0) {
            text +=
                ", time left = " + hoursMinutesSeconds(std::max(0.0, end - runTime.time()) * elapsed / done);
        }
    }
    if (pointSteps_ > 0 && elapsed > 0) {
        text +=
            (text.empty() ? "Progress: " : ", ") + print("%.3g", pointSteps_ / elapsed) + " point steps/s";
    }
    return text;
}

void Log::step(const RunTime& runTime, const StepReport& report)
{
    ++steps_;
    if (steps_ == 1) {
        // Rates count from the end of the first step, which also pays for setting up.
        loopStart_ = clockSeconds();
        loopStartTime_ = runTime.time();
    } else {
        pointSteps_ += report.pointSteps;
    }
    if (runTime.index() % runTime.control().logInterval != 0 && !runTime.writeTime() && runTime.running()) {
        return;
    }
    out_ << "Time = " << runTime.timeName() << "\nCourant Number mean: " << number(report.courantMean)
         << " max: " << number(report.courantMax) << "\ndeltaT = " << number(runTime.deltaT()) << '\n';
    out_ << "Energy: kinetic = " << number(report.kineticEnergy)
         << " J, strain work = " << number(report.strainWork) << " J, ratio = "
         << number(report.strainWork != 0 ? report.kineticEnergy / std::abs(report.strainWork) : 0) << '\n';
    for (const BodyReport& body : report.bodies) {
        printBody(out_, body);
    }
    for (const std::string& text : report.lines) {
        out_ << text << '\n';
    }
    if (const std::string text = progress(runTime); !text.empty()) {
        out_ << text << '\n';
    }
    times();
}

void Log::end(const RunTime& runTime)
{
    const double elapsed = steps_ > 0 ? clockSeconds() - loopStart_ : 0;
    out_ << "Stopped: " << runTime.stopReason() << ", at time " << runTime.timeName() << " after " << steps_
         << " steps";
    if (pointSteps_ > 0 && elapsed > 0) {
        out_ << ", " << print("%.3g", pointSteps_ / elapsed) << " point steps/s";
    }
    out_ << ", " << print("%.1f", clockSeconds()) << " s\n\nEnd\n\n" << std::flush;
}

} // namespace caisson
