#include "InstallationWatch.h"

#include "dictionary/Text.h"

#include <cmath>

namespace caisson {

void InstallationWatch::afterStep(const State& state, RunTime& runTime)
{
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
        const RigidBody& body = state.bodies[b];
        Body& own = watched_[b];
        const double relative = body.penetration() / body.referenceLength;
        if (!own.atLid && state.reactions[b].verticalImpulse[static_cast<int>(SurfacePart::lid)] > 0) {
            own.atLid = true;
            const std::string statement = text("Lid contact of %s at z/L = %.4g (penetration %.4g m)",
                                               body.name.c_str(), relative, body.penetration());
            log_.line(statement);
            if (body.stopAtLid) {
                runTime.stop(statement, true);
            }
        }
        if (!body.loadControlled || body.restTime <= 0 || state.time < body.ramp) {
            continue;
        }
        if (!own.marked || std::abs(body.penetration() - own.penetration) > body.restPenetration) {
            own = {own.atLid, state.time, body.penetration(), true};
        } else if (state.time - own.since >= body.restTime) {
            const std::string statement =
                text("%s is at rest at z/L = %.4g (penetration %.4g m): less than %.3g m in %.3g s",
                     body.name.c_str(), relative, body.penetration(), body.restPenetration, body.restTime);
            log_.line(statement);
            runTime.stop(statement, true);
        }
    }
}

} // namespace caisson
