#pragma once

#include "case/Log.h"
#include "case/Monitor.h"
#include "case/RunTime.h"
#include "scene/CaseScene.h"
#include "scene/CheckerboardWatch.h"
#include "scene/QuasiSteadySeepage.h"

#include <memory>

namespace caisson {

/// Rise of the soil surface beside a body with a plug inside, from the points that were topmost at the start.
class SurfaceHeave
{
public:
    struct Result
    {
        double centre = 0, wall = 0;    ///< rise at the axis and at the inner face [m]
        double inside = 0, outside = 0; ///< volume risen within and beyond the wall [m3]
        double wallVolume = 0;          ///< volume of the wall that has entered the soil since the start [m3]
    };
    /// @param body  a body with an inner face; none otherwise: `applies` is false then
    SurfaceHeave(const State& state, const RigidBody& body);
    [[nodiscard]] bool applies() const { return innerRadius_ > 0 && !columns_.empty(); }
    [[nodiscard]] Result measure(const State& state, const RigidBody& body) const;

private:
    struct Column
    {
        double from, to;      ///< radii of the strip of surface [m]
        std::vector<int> ids; ///< its topmost points
    };
    std::vector<Column> columns_;
    double innerRadius_ = 0, outerRadius_ = 0;
    double initialPenetration_ = 0;
};

/// Log, monitors and time directories of a run.
class RunOutput
{
public:
    RunOutput(RunTime& runTime, const CaseScene& caseScene, Log& log);
    [[nodiscard]] bool logDue() const;
    /// @param seepage  of a run with quasi-steady seepage, else null
    void afterStep(State& state, const TimeStep& step, double courant, const QuasiSteadySeepage* seepage);
    void write(const State& state, const TimeStep& step);
    /// Speed and memory, at the end.
    void summary(const State& state) const;

private:
    void recordBodies(State& state);
    void writeVtk(const State& state) const;
    void watchGates(const State& state, double kinetic, double work);

    struct BodyOutput
    {
        Monitor monitor;
        std::unique_ptr<Monitor> plugMonitor;
        SurfaceHeave heave;
        BodyReport last;
    };

    RunTime& runTime_;
    const CaseScene& case_;
    Log& log_;
    double whole_ = 1; ///< 2 pi where quantities are per radian
    std::vector<BodyOutput> bodies_;
    bool warnedOfEnergy_ = false, warnedOfInertia_ = false, warnedOfSeepage_ = false;
    CheckerboardWatch checkerboardWatch_;
    double stepSeconds_ = 0, lastMark_ = 0; ///< processor time in steps, output apart
    double pointSteps_ = 0;
};

} // namespace caisson
