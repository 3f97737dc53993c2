#include "installation/InstallationTables.h"

#include <sstream>

namespace caisson {

std::string stageTable(const InstallationInput& input, const std::vector<InstallationStage>& stages)
{
    const Caisson& caisson = input.method->caisson();
    std::ostringstream text;
    text.precision(9);
    text
        << "# suctionPressure, method " << input.methodName << (input.jacked ? ", jacked" : "")
        << "; SI units (m, N, Pa, m3/s); nan: not known to the method, inf: no such limit\n"
        << "# outerDiameter " << caisson.outerDiameter << " wallThickness " << caisson.wallThickness
        << " skirtLength " << caisson.skirtLength << " submergedWeight " << caisson.submergedWeight
        << " effectiveUnitWeight " << input.effectiveUnitWeight << " penetrationByWeight " << input.byWeight
        << '\n'
        << "# penetration z/L jackingOutside jackingInside jackingTip jackingForce outside inside tip "
           "suction "
           "s/(gamma'D) liquefaction exitGradient reverseBearing cavitation seepageFlow pumpFlow plugHeave\n";
    for (const InstallationStage& s : stages)
        text << s.penetration << ' ' << s.penetration / caisson.skirtLength << ' ' << s.jacking.outside << ' '
             << s.jacking.inside << ' ' << s.jacking.tip << ' ' << s.jacking.total() << ' '
             << s.underSuction.outside << ' ' << s.underSuction.inside << ' ' << s.underSuction.tip << ' '
             << s.suction << ' ' << s.suction / (input.effectiveUnitWeight * caisson.outerDiameter) << ' '
             << s.limits.liquefaction << ' ' << s.limits.exitGradient << ' ' << s.limits.reverseBearing << ' '
             << input.site.cavitationSuction() << ' ' << s.seepageFlow << ' ' << s.pumpFlow << ' '
             << s.plugHeave << '\n';
    return text.str();
}

std::string function1Table(const InstallationInput& input, const std::vector<InstallationStage>& stages)
{
    std::ostringstream text;
    text.precision(12);
    text << "// " << (input.jacked ? "Jacking force [N]" : "Suction [Pa]")
         << " against penetration [m], written by suctionPressure (" << input.methodName << ")\n(\n";
    for (const InstallationStage& stage : stages)
        text << "    (" << stage.penetration << ' ' << (input.jacked ? stage.jacking.total() : stage.suction)
             << ")\n";
    text << ")\n";
    return text.str();
}

} // namespace caisson
