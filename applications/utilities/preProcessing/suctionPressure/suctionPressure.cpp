// suctionPressure: resistance and suction of a caisson against its penetration, by closed-form design
// methods.
//
// Usage: suctionPressure [-case <directory>] [-dict <file>]
//
// Reads system/suctionPressureDict; writes postProcessing/suctionPressure/0/suctionPressure.dat (forces,
// suction, limits, flow, plug heave) and the table of suction against penetration that a boundary condition
// reads, by default constant/suctionTable. With `loading jacked` there is no suction and the table is that of
// the force.

#include "case/FileIO.h"
#include "case/Program.h"
#include "installation/InstallationTables.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace {

using namespace caisson;
namespace fs = std::filesystem;

/// Of the dictionary system/<name>Dict: postProcessing/suctionPressure/0/<name>.dat.
std::string datFile(const fs::path& dictionaryFile)
{
    std::string name = dictionaryFile.filename().string();
    if (name.ends_with("Dict"))
        name.resize(name.size() - 4);
    return "postProcessing/suctionPressure/0/" + name + ".dat";
}

/// Penetrations of the table; where suction sets in there is a point, since the curve has a corner there.
std::vector<double> penetrations(const InstallationInput& input)
{
    std::vector<double> result;
    const int steps = static_cast<int>(std::ceil((input.end - input.start) / input.increment - 1e-9));
    for (int i = 0; i <= steps; ++i)
        result.push_back(std::min(input.end, input.start + i * input.increment));
    if (!input.jacked && input.byWeight > input.start && input.byWeight < input.end)
        result.push_back(input.byWeight);
    std::ranges::sort(result);
    const auto repeated = std::ranges::unique(result);
    result.erase(repeated.begin(), repeated.end());
    return result;
}

void printTable(const InstallationInput& input, const std::vector<InstallationStage>& stages)
{
    std::printf("\n%8s %6s %10s %10s %10s %10s %9s %7s %9s %9s %9s %8s\n", "h [m]", "z/L", "out [kN]",
                "in [kN]", "tip [kN]", "jack [kN]", "s [kPa]", "s/g'D", "liq [kPa]", "exit[kPa]", "Qs[m3/s]",
                "heave[m]");
    const std::size_t every = std::max<std::size_t>(1, (stages.size() + 19) / 20);
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const InstallationStage& s = stages[i];
        if (i % every != 0 && i + 1 != stages.size() && s.penetration != input.byWeight)
            continue;
        const Caisson& caisson = input.method->caisson();
        std::printf("%8.3f %6.3f %10.1f %10.1f %10.1f %10.1f %9.3f %7.3f %9.2f %9.2f %9.2e %8.3f\n",
                    s.penetration, s.penetration / caisson.skirtLength, s.underSuction.outside / 1e3,
                    s.underSuction.inside / 1e3, s.underSuction.tip / 1e3, s.jacking.total() / 1e3,
                    s.suction / 1e3, s.suction / (input.effectiveUnitWeight * caisson.outerDiameter),
                    s.limits.liquefaction / 1e3, s.limits.exitGradient / 1e3, s.seepageFlow, s.plugHeave);
    }
}

/// First penetration at which the suction exceeds a limit that does not stop the calculation.
void warnBeyond(const std::vector<InstallationStage>& stages, double SuctionLimits::*limit,
                const char* meaning)
{
    for (const InstallationStage& stage : stages)
        if (stage.suction > stage.limits.*limit) {
            std::cout << "Warning: from penetration " << stage.penetration << " m on the suction exceeds "
                      << stage.limits.*limit << " Pa, " << meaning << '\n';
            return;
        }
}

void printSummary(const InstallationInput& input, const std::vector<InstallationStage>& stages)
{
    const Caisson& caisson = input.method->caisson();
    const InstallationStage& last = stages.back();
    std::cout << "\nMethod " << input.methodName << (input.jacked ? ", jacked without suction" : "") << '\n';
    if (input.jacked)
        std::cout << "Jacking force at penetration " << last.penetration << " m: " << last.jacking.total()
                  << " N\n";
    else if (input.methodName == "table")
        std::cout << "Suction prescribed; " << last.suction << " Pa at penetration " << last.penetration
                  << " m\n";
    else if (input.byWeight >= caisson.skirtLength)
        std::cout << "The weight of " << caisson.submergedWeight
                  << " N brings the caisson in without suction\n";
    else {
        std::cout << "Penetration by the weight of " << caisson.submergedWeight << " N: " << input.byWeight
                  << " m (z/L " << input.byWeight / caisson.skirtLength << ")\n"
                  << "Suction at penetration " << last.penetration << " m: " << last.suction << " Pa";
        const auto share = [&](const double limit, const char* name) {
            if (std::isfinite(limit))
                std::cout << ", " << 100 * last.suction / limit << " % of " << name;
        };
        share(last.limits.liquefaction, "liquefaction");
        share(last.limits.exitGradient, "the critical exit gradient");
        share(last.limits.reverseBearing, "reverse bearing");
        share(input.site.cavitationSuction(), "cavitation");
        std::cout << '\n';
    }
    if (std::isfinite(last.pumpFlow))
        std::cout << "Flow at the end: seepage " << last.seepageFlow << " m3/s, pump " << last.pumpFlow
                  << " m3/s\n";
    warnBeyond(stages, &SuctionLimits::exitGradient, "the critical exit gradient: piping is likely");
    warnBeyond(stages, &SuctionLimits::reverseBearing,
               "at which soil flows in under the tip (reverse bearing failure)");

    const double contact = lidContactPenetration(
        caisson, input.site.plug, input.jacked ? caisson.skirtLength : input.byWeight, input.site.lidHeight);
    std::cout << "Plug heave at the end: " << last.plugHeave << " m; ";
    if (contact < last.penetration)
        std::cout << "the plug meets the lid (" << input.site.lidHeight << " m above the tip) at penetration "
                  << contact << " m (z/L " << contact / caisson.skirtLength << ")\n";
    else
        std::cout << "the plug does not meet the lid, which is " << input.site.lidHeight
                  << " m above the tip\n";
}

/// @returns the exit status
int run(const fs::path& caseDirectory, const fs::path& dictionaryFile)
{
    const fs::path file = dictionaryFile.is_absolute() ? dictionaryFile : caseDirectory / dictionaryFile;
    const InstallationInput input =
        readInstallation(readDictionary(file, caseDirectory, dictionaryFile.string()), caseDirectory);
    std::function<double(double)> rate;
    if (input.rate)
        rate = [&](const double h) { return input.rate->value(h); };

    std::vector<InstallationStage> stages;
    try {
        for (const double h : penetrations(input))
            stages.push_back(
                installationStage(*input.method, input.site, h, input.jacked, input.byWeight, rate));
    } catch (const SuctionLimitReached& limit) {
        printTable(input, stages);
        std::cerr << "\n--> CAISSONFOAM FATAL ERROR : " << limit.what()
                  << "\n    deepest penetration by suction: "
                  << greatestPenetration(*input.method, input.site, input.end)
                  << " m\n    lower 'end' in 'penetration', raise the load, or check the soil; no table is "
                     "written\n";
        return 1;
    }
    printTable(input, stages);
    printSummary(input, stages);
    const std::string dat = datFile(dictionaryFile);
    writeFileAtomically(caseDirectory / dat, stageTable(input, stages));
    writeFileAtomically(caseDirectory / input.tableFile, function1Table(input, stages));
    std::cout << "Written: " << dat << ", " << input.tableFile << "\n\nEnd\n";
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    namespace options = boost::program_options;
    Program program{"suctionPressure", "[-case DIR] [-dict FILE]",
                    "Suction and resistance of a caisson against penetration, by closed-form methods."};
    program.options.add_options()("case", options::value<std::string>()->default_value("."),
                                  "the case directory")(
        "dict", options::value<std::string>()->default_value("system/suctionPressureDict"),
        "dictionary, relative to the case");
    program.run = [](const options::variables_map& given, const std::string&) {
        return run(given["case"].as<std::string>(), given["dict"].as<std::string>());
    };
    return runProgram(std::move(program), argc, argv);
}
