#include "installation/InstallationInput.h"

#include "installation/PrescribedSuction.h"
#include "installation/SoilInput.h"

#include <algorithm>
#include <sstream>

namespace caisson {
namespace {

constexpr std::array mainKeywords{
    Keyword{"method", "word", "", "houlsbyByrneSand houlsbyByrneClay sendersRandolph feld dnv table",
            "Design method."},
    Keyword{
        "loading", "word", "suction", "suction jacked",
        "What drives the caisson: suction after its weight, or an outside force (jacking) without suction."},
    Keyword{"caisson", "dictionary", "", "", "Geometry and weight."},
    Keyword{"soil", "dictionary", "", "", "Soil and the method's factors."},
    Keyword{"water", "dictionary", "-", "", "The sea, for cavitation and flow."},
    Keyword{"plug", "dictionary", "-", "", "Shares for the estimate of the plug's heave."},
    Keyword{"penetration", "dictionary", "-", "", "Range of the table, and rate."},
    Keyword{"tableFile", "string", "constant/suctionTable", "",
            "File for the table of suction (jacked: of force) against penetration, in the case."},
};

constexpr std::array caissonKeywords{
    Keyword{"outerDiameter", "m", "", "(0, inf)", "Outer diameter."},
    Keyword{"wallThickness", "m", "", "(0, inf)", "Wall thickness."},
    Keyword{"skirtLength", "m", "", "(0, inf)", "Length from the tip to the lid."},
    Keyword{"submergedWeight", "N", "-", "[0, inf)",
            "Effective vertical load: weight under water and ballast. Or give jackedPenetration."},
    Keyword{"jackedPenetration", "m", "-", "[0, inf)",
            "The load is the one that brings the caisson to this penetration without suction."},
    Keyword{"lidHeight", "m", "-", "(0, inf)", "Lid's underside above the tip; skirtLength where not given."},
};

constexpr std::array waterKeywords{
    Keyword{"depth", "m", "0", "[0, inf)", "Water above the lid or the pump."},
    Keyword{"unitWeight", "N/m3", "9810", "(0, inf)", "Unit weight of water."},
    Keyword{"viscosity", "Pa s", "1e-3", "(0, inf)", "Dynamic viscosity."},
    Keyword{"atmosphericPressure", "Pa", "101325", "(0, inf)", "Absolute."},
    Keyword{"vapourPressure", "Pa", "2000", "[0, inf)", "Absolute."},
};

constexpr std::array plugKeywords{
    Keyword{"inwardShareJacked", "-", "0.5", "[0, 1]",
            "Share of the wall's volume that moves into the plug without suction."},
    Keyword{"inwardShareSuction", "-", "1", "[0, 1]", "The same under suction."},
    Keyword{"expansion", "-", "0", "[0, 1)", "Swelling of the plug per length penetrated under suction."},
};

constexpr std::array penetrationKeywords{
    Keyword{"start", "m", "0", "[0, inf)", "First penetration of the table."},
    Keyword{"end", "m", "-", "(0, inf)", "Last penetration; skirtLength where not given."},
    Keyword{"increment", "m", "0.05", "(0, inf)", "Step of the table."},
    Keyword{"rate", "Function1", "-", "", "Rate of penetration [m/s] against penetration [m], for the pump."},
};

/// A sub-dictionary, or an empty one where it is left out.
const Dictionary& part(const KeywordReader& reader, const std::string_view key)
{
    static const Dictionary none;
    const Dictionary* found = reader.has(key) ? reader.dictionary(key) : nullptr;
    return found != nullptr ? *found : none;
}

void readWater(const KeywordReader& main, InstallationSite& site)
{
    const KeywordReader reader(part(main, "water"), waterKeywords, "'water'", main.problems());
    site.waterDepth = reader.number("depth");
    site.waterUnitWeight = reader.number("unitWeight");
    site.waterViscosity = reader.number("viscosity");
    site.atmosphericPressure = reader.number("atmosphericPressure");
    site.vapourPressure = reader.number("vapourPressure");
}

void readPlug(const KeywordReader& main, InstallationSite& site)
{
    const KeywordReader reader(part(main, "plug"), plugKeywords, "'plug'", main.problems());
    site.plug.inwardByWeight = reader.number("inwardShareJacked");
    site.plug.inwardBySuction = reader.number("inwardShareSuction");
    site.plug.expansion = reader.number("expansion");
}

struct CaissonInput
{
    Caisson caisson;
    double jackedPenetration = -1; // negative where the weight is given
};

CaissonInput readCaisson(const KeywordReader& main, const bool needsWeight, InstallationSite& site)
{
    CaissonInput result;
    const Dictionary* dictionary = main.dictionary("caisson");
    if (dictionary == nullptr)
        return result;
    const KeywordReader reader(*dictionary, caissonKeywords, "'caisson'", main.problems());
    result.caisson.outerDiameter = reader.number("outerDiameter");
    result.caisson.wallThickness = reader.number("wallThickness");
    result.caisson.skirtLength = reader.number("skirtLength");
    if (result.caisson.outerDiameter > 0 && result.caisson.innerDiameter() <= 0)
        reader.problem("wallThickness",
                       "the wall leaves no room inside: wallThickness is half of outerDiameter "
                       "or more");
    if (reader.has("submergedWeight"))
        result.caisson.submergedWeight = reader.number("submergedWeight");
    if (reader.has("jackedPenetration"))
        result.jackedPenetration = reader.number("jackedPenetration");
    if (reader.has("submergedWeight") && reader.has("jackedPenetration"))
        reader.problem("jackedPenetration", "the load is given twice",
                       "give submergedWeight or jackedPenetration");
    else if (needsWeight && !reader.has("submergedWeight") && !reader.has("jackedPenetration"))
        reader.problem("submergedWeight", "the load is missing", "give submergedWeight or jackedPenetration");
    if (result.jackedPenetration > result.caisson.skirtLength)
        reader.problem("jackedPenetration", "jackedPenetration exceeds skirtLength");
    site.lidHeight = reader.has("lidHeight") ? reader.number("lidHeight") : result.caisson.skirtLength;
    return result;
}

void readPenetration(const KeywordReader& main, const double skirtLength, InstallationInput& input)
{
    const Dictionary& dictionary = part(main, "penetration");
    const KeywordReader reader(dictionary, penetrationKeywords, "'penetration'", main.problems());
    input.start = reader.number("start");
    input.end = reader.has("end") ? reader.number("end") : skirtLength;
    input.increment = reader.number("increment");
    if (reader.has("rate"))
        input.rate = readFunction1(dictionary, "rate", main.problems());
    if (skirtLength <= 0)
        return; // reported with the caisson
    if (input.end <= input.start)
        reader.problem("end", "the table would be empty: end is not beyond start");
    else if (input.end > skirtLength * (1 + 1e-12))
        reader.problem("end", "end is beyond skirtLength");
    else if (input.increment > 0 && (input.end - input.start) / input.increment > 1e5)
        reader.problem("increment", "so small an increment would make a table of more than 100000 rows");
}

} // namespace

std::vector<InstallationKeywords> installationKeywords()
{
    std::vector<InstallationKeywords> tables{{"suctionPressureDict", mainKeywords},
                                             {"caisson", caissonKeywords},
                                             {"water", waterKeywords},
                                             {"plug", plugKeywords},
                                             {"penetration", penetrationKeywords}};
    const std::vector<InstallationKeywords> soil = soilKeywords();
    tables.insert(tables.end(), soil.begin(), soil.end());
    return tables;
}

InstallationInput readInstallation(const Dictionary& dictionary, const std::filesystem::path& caseDirectory)
{
    const std::string& subject = dictionary.name();
    InputProblems problems;
    InstallationInput input;
    const KeywordReader reader(dictionary, mainKeywords, subject, problems);
    input.methodName = reader.word("method");
    input.jacked = reader.word("loading") == "jacked";
    input.tableFile = reader.word("tableFile");
    const bool prescribed = input.methodName == "table";
    if (prescribed && input.jacked)
        reader.problem("loading", "method table has no resistance to jack against",
                       "choose another method for loading jacked");
    const CaissonInput caisson = readCaisson(reader, !prescribed && !input.jacked, input.site);
    readWater(reader, input.site);
    readPlug(reader, input.site);
    readPenetration(reader, caisson.caisson.skirtLength, input);

    MethodMaker make;
    const Dictionary* soil = reader.dictionary("soil");
    if (soil != nullptr && std::ranges::count(installationMethods(), input.methodName) > 0)
        make = readSoil(input.methodName, *soil, caseDirectory, problems, input);
    problems.throwIfAny(subject);

    try {
        input.method = make(caisson.caisson);
        if (caisson.jackedPenetration >= 0 && !prescribed) {
            Caisson loaded = caisson.caisson;
            loaded.submergedWeight = input.method->resistance(caisson.jackedPenetration, 0).total();
            input.method = make(loaded);
        }
    } catch (const std::invalid_argument& error) {
        problems.add(soil->where(), error.what());
    }
    problems.throwIfAny(subject);

    if (const auto* table = dynamic_cast<const PrescribedSuction*>(input.method.get())) {
        if (table->end() < input.end * (1 - 1e-12)) {
            std::ostringstream message;
            message << "the suction table ends at z/L " << table->end() / caisson.caisson.skirtLength
                    << ", before the last penetration z/L " << input.end / caisson.caisson.skirtLength;
            problems.add(soil->find("values")->where, message.str(),
                         "add points to 'values' or lower 'end' in 'penetration'");
        }
        input.byWeight = std::max(0.0, caisson.jackedPenetration);
    } else
        input.byWeight = input.method->selfWeightPenetration();
    problems.throwIfAny(subject);
    return input;
}

} // namespace caisson
