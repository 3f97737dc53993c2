#pragma once

#include "case/Log.h"
#include "case/RunTime.h"
#include "timeStepping/Scene.h"

namespace caisson {

/// Notices what ends an installation: the soil meets the lid, or a body that moves by its loads has come to
/// rest while the loads do not grow any more (refusal, or self-weight penetration that is over).
class InstallationWatch
{
public:
    InstallationWatch(const State& state, Log& log) : log_(log), watched_(state.bodies.size()) {}
    /// After every step; stops the run with a plain statement.
    void afterStep(const State& state, RunTime& runTime);

private:
    struct Body
    {
        bool atLid = false;
        double since = 0;       ///< time of the mark [s]
        double penetration = 0; ///< then [m]
        bool marked = false;
    };
    Log& log_;
    std::vector<Body> watched_;
};

} // namespace caisson
