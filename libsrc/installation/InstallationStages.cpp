#include "installation/InstallationStages.h"

#include "installation/Seepage.h"

#include <cmath>
#include <sstream>

namespace caisson {

namespace {

/// What stops an installation that the method itself has an answer for.
void checkPossible(const InstallationStage& stage, const double limit, const char* what)
{
    if (stage.suction <= limit)
        return;
    std::ostringstream message;
    message << "at penetration " << stage.penetration << " m the suction of " << stage.suction
            << " Pa exceeds " << limit << " Pa, at which " << what;
    throw SuctionLimitReached(message.str(), stage.penetration, limit);
}

} // namespace

double InstallationSite::cavitationSuction() const
{
    return atmosphericPressure + waterUnitWeight * waterDepth - vapourPressure;
}

InstallationStage installationStage(const InstallationMethod& method, const InstallationSite& site,
                                    const double h, const bool jacked, const double byWeight,
                                    const std::function<double(double)>& rate)
{
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const Caisson& caisson = method.caisson();
    InstallationStage stage;
    stage.penetration = h;
    stage.suction = jacked ? 0 : method.suction(h);
    stage.jacking = method.resistance(h, 0);
    stage.underSuction = stage.suction > 0 ? method.resistance(h, stage.suction) : stage.jacking;
    stage.limits = method.limits(h);
    checkPossible(stage, stage.limits.liquefaction, "the plug liquefies (no effective stress is left in it)");
    checkPossible(stage, site.cavitationSuction(), "the water cavitates");
    stage.plugHeave = plugHeave(caisson, site.plug, h, jacked ? h : byWeight);

    stage.seepageFlow = stage.suction > 0 ? unknown : 0;
    if (stage.suction > 0 && site.intrinsicPermeability > 0) {
        // k D s/gamma_w with k = kappa gamma_w/eta
        const double conductance =
            site.intrinsicPermeability / site.waterViscosity * caisson.meanDiameter() * stage.suction;
        stage.seepageFlow =
            conductance * seepageFlowFactor(h / caisson.meanDiameter(), site.permeabilityRatio);
    }
    stage.pumpFlow = unknown;
    if (rate) {
        const double rise = plugHeave(caisson, site.plug, 1, stage.suction > 0 ? 0 : 1); // per metre
        stage.pumpFlow = stage.seepageFlow + rate(h) * caisson.plugArea() * (1 - rise);
    }
    return stage;
}

double greatestPenetration(const InstallationMethod& method, const InstallationSite& site,
                           const double deepest)
{
    const auto possible = [&](const double h) {
        try {
            (void)installationStage(method, site, h, false, 0);
            return true;
        } catch (const SuctionLimitReached&) {
            return false;
        }
    };
    constexpr int steps = 500; // the method may fail at a shallow depth and again have an answer below
    double reached = 0;
    double failed = deepest;
    for (int step = 1; step <= steps; ++step) {
        const double h = deepest * step / steps;
        if (!possible(h)) {
            failed = h;
            break;
        }
        reached = h;
    }
    while (failed - reached > 1e-6 * deepest) {
        const double middle = 0.5 * (reached + failed);
        (possible(middle) ? reached : failed) = middle;
    }
    return reached;
}

} // namespace caisson
