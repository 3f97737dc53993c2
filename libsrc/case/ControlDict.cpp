#include "case/ControlDict.h"

#include <array>
#include <cmath>

namespace caisson {

namespace {

constexpr std::array keywords{
    Keyword{"application", "word", "axiMpmFoam", "", "solver that Allrun starts (getApplication)"},
    Keyword{"startFrom", "word", "latestTime", "firstTime startTime latestTime",
            "time directory that the run starts from"},
    Keyword{"startTime", "s", "0", "[0, inf)", "time to start from, with startFrom startTime"},
    Keyword{"stopAt", "word", "endTime", "endTime noWriteNow writeNow nextWrite", "what ends the run"},
    Keyword{"endTime", "s", "-", "(0, inf)", "end of the run; required with stopAt endTime"},
    Keyword{"deltaT", "s", "-", "(0, inf)", "time step; may be left out with adjustTimeStep"},
    Keyword{"adjustTimeStep", "flag", "no", "", "take the time step from the stable step and maxCo"},
    Keyword{"maxCo", "-", "0.8", "(0, 1]", "fraction of the stable time step that is used"},
    Keyword{"maxDeltaT", "s", "-", "(0, inf)", "largest time step"},
    Keyword{"writeControl", "word", "timeStep",
            "none timeStep runTime adjustable adjustableRunTime clockTime cpuTime",
            "what writeInterval counts; adjustableRunTime makes the steps fall on the write times"},
    Keyword{"writeInterval", "s or steps", "-", "(0, inf)",
            "steps (timeStep), simulated seconds (runTime, adjustableRunTime), or seconds of the clock "
            "(clockTime) or "
            "the processor (cpuTime) between writes"},
    Keyword{"writeFrequency", "s or steps", "-", "(0, inf)", "old name of writeInterval"},
    Keyword{"purgeWrite", "integer", "0", "[0, inf)", "number of time directories to keep; 0 keeps all"},
    Keyword{"writeFormat", "word", "binary", "ascii binary", "format of fields and material points"},
    Keyword{"writePrecision", "integer", "17", "[1, inf)",
            "digits of ascii numbers; 17 make a restart exact"},
    Keyword{"writeCompression", "word", "off", "off on no yes false true uncompressed compressed",
            "gzip the ascii files"},
    Keyword{"timeFormat", "word", "general", "general fixed scientific",
            "form of the names of time directories"},
    Keyword{"timePrecision", "integer", "6", "[1, 17]",
            "digits of these names; grows where two times would share one"},
    Keyword{"runTimeModifiable", "flag", "no", "", "read controlDict again when it changes during the run"},
    Keyword{"logInterval", "integer", "1", "[1, inf)", "time steps between two blocks of the log"},
    Keyword{"functions", "dictionary", "-", "",
            "function objects of OpenFOAM's tools; not run by caissonFoam"},
    Keyword{"libs", "list", "-", "", "libraries of OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"graphFormat", "word", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"DebugSwitches", "dictionary", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"InfoSwitches", "dictionary", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"OptimisationSwitches", "dictionary", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"DimensionedConstants", "dictionary", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
    Keyword{"DimensionSets", "dictionary", "-", "", "for OpenFOAM's tools; not used by caissonFoam"},
};

/// The value that `word` names; the table of keywords has checked the word, `other` answers a wrong one.
template <class Enum, std::size_t n>
Enum named(const std::string& word, const std::array<std::pair<std::string_view, Enum>, n>& names, Enum other)
{
    for (const auto& [name, value] : names) {
        if (name == word) {
            return value;
        }
    }
    return other;
}

constexpr std::array<std::pair<std::string_view, StartFrom>, 3> startFromNames{
    {{"firstTime", StartFrom::firstTime},
     {"startTime", StartFrom::startTime},
     {"latestTime", StartFrom::latestTime}}};
constexpr std::array<std::pair<std::string_view, StopAt>, 4> stopAtNames{{{"endTime", StopAt::endTime},
                                                                          {"noWriteNow", StopAt::noWriteNow},
                                                                          {"writeNow", StopAt::writeNow},
                                                                          {"nextWrite", StopAt::nextWrite}}};
constexpr std::array<std::pair<std::string_view, WriteControl>, 7> writeControlNames{
    {{"none", WriteControl::none},
     {"timeStep", WriteControl::timeStep},
     {"runTime", WriteControl::runTime},
     {"adjustable", WriteControl::adjustableRunTime},
     {"adjustableRunTime", WriteControl::adjustableRunTime},
     {"clockTime", WriteControl::clockTime},
     {"cpuTime", WriteControl::cpuTime}}};
constexpr std::array<std::pair<std::string_view, TimeFormat>, 3> timeFormatNames{
    {{"general", TimeFormat::general}, {"fixed", TimeFormat::fixed}, {"scientific", TimeFormat::scientific}}};
constexpr std::array<std::pair<std::string_view, bool>, 8> compressionNames{{{"off", false},
                                                                             {"no", false},
                                                                             {"false", false},
                                                                             {"uncompressed", false},
                                                                             {"on", true},
                                                                             {"yes", true},
                                                                             {"true", true},
                                                                             {"compressed", true}}};

void readWriting(const KeywordReader& reader, ControlDict& control)
{
    control.writeControl = named(reader.word("writeControl"), writeControlNames, WriteControl::timeStep);
    const char* const interval = reader.has("writeInterval") ? "writeInterval" : "writeFrequency";
    if (reader.has(interval)) {
        control.writeInterval = reader.number(interval);
        if (control.writeControl == WriteControl::timeStep &&
            control.writeInterval != std::floor(control.writeInterval)) {
            reader.problem(interval,
                           std::string(interval) +
                               " must be a whole number of steps with writeControl timeStep",
                           "for an interval in seconds: writeControl adjustableRunTime;");
        }
    } else if (control.writeControl != WriteControl::none) {
        reader.problem("writeInterval", "writeInterval is missing", "or: writeControl none;");
    }
    control.purgeWrite = static_cast<int>(reader.integer("purgeWrite"));

    control.writeStyle.binary = reader.word("writeFormat") != "ascii";
    control.writeStyle.precision = static_cast<int>(std::min(reader.integer("writePrecision"), 17L));
    control.writeStyle.compressed = named(reader.word("writeCompression"), compressionNames, false);
    if (control.writeStyle.binary && control.writeStyle.compressed) {
        control.writeStyle.compressed = false; // as OpenFOAM does
        control.remarks.emplace_back("writeCompression is off: binary files are not compressed");
    }
    if (!control.writeStyle.binary && control.writeStyle.precision < 17) {
        control.remarks.emplace_back("writePrecision " + std::to_string(control.writeStyle.precision) +
                                     " rounds what is written: a restart will differ in the last digits "
                                     "(writePrecision 17 or writeFormat binary make it exact)");
    }
    control.timeFormat = named(reader.word("timeFormat"), timeFormatNames, TimeFormat::general);
    control.timePrecision = static_cast<int>(reader.integer("timePrecision"));
}

} // namespace

std::span<const Keyword> controlDictKeywords() { return keywords; }

ControlDict readControlDict(const std::filesystem::path& caseDirectory, InputProblems& problems)
{
    const Dictionary dictionary =
        readDictionary(caseDirectory / "system/controlDict", caseDirectory, "system/controlDict");
    const KeywordReader reader(dictionary, keywords, "controlDict", problems);

    ControlDict control;
    control.application = reader.word("application");
    control.startFrom = named(reader.word("startFrom"), startFromNames, StartFrom::latestTime);
    control.startTime = reader.number("startTime");
    control.stopAt = named(reader.word("stopAt"), stopAtNames, StopAt::endTime);
    if (reader.has("endTime")) {
        control.endTime = reader.number("endTime");
    } else if (control.stopAt == StopAt::endTime) {
        reader.problem("endTime", "endTime is missing");
    }
    if (control.startFrom == StartFrom::startTime && control.endTime < control.startTime) {
        reader.problem("endTime", "endTime is before startTime");
    }

    control.adjustTimeStep = reader.flag("adjustTimeStep");
    control.maxCo = reader.number("maxCo");
    if (reader.has("maxDeltaT")) {
        control.maxDeltaT = reader.number("maxDeltaT");
    }
    if (reader.has("deltaT")) {
        control.deltaT = reader.number("deltaT");
    } else if (!control.adjustTimeStep) {
        reader.problem("deltaT", "deltaT is missing", "or: adjustTimeStep yes;");
    }

    readWriting(reader, control);
    control.runTimeModifiable = reader.flag("runTimeModifiable");
    control.logInterval = static_cast<int>(reader.integer("logInterval"));
    if (const Dictionary* functions = reader.dictionary("functions");
        functions != nullptr && !functions->entries().empty()) {
        control.remarks.emplace_back(
            "functions of controlDict are for OpenFOAM's tools: caissonFoam does not run them");
    }
    return control;
}

} // namespace caisson
