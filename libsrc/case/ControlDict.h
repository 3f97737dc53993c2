#pragma once

#include "case/FoamFile.h"
#include "dictionary/KeywordReader.h"

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace caisson {

enum class StartFrom { firstTime, startTime, latestTime };
enum class StopAt { endTime, noWriteNow, writeNow, nextWrite };
/// `adjustable` is OpenFOAM's other word for adjustableRunTime.
enum class WriteControl { none, timeStep, runTime, adjustableRunTime, clockTime, cpuTime };
enum class TimeFormat { general, fixed, scientific };

/// system/controlDict: OpenFOAM's keys, and logInterval. Times in seconds.
struct ControlDict
{
    std::string application;

    StartFrom startFrom = StartFrom::latestTime;
    double startTime = 0;
    StopAt stopAt = StopAt::endTime;
    double endTime = std::numeric_limits<double>::infinity();

    double deltaT = 0; ///< 0: not given (adjustTimeStep)
    bool adjustTimeStep = false;
    double maxCo = 0.8; ///< fraction of the stable step
    double maxDeltaT = std::numeric_limits<double>::infinity();

    WriteControl writeControl = WriteControl::timeStep;
    double writeInterval = 1; ///< steps for timeStep, else seconds (simulated, clock or processor)
    int purgeWrite = 0;       ///< how many time directories to keep; 0: all
    WriteStyle writeStyle;
    TimeFormat timeFormat = TimeFormat::general;
    int timePrecision = 6;

    bool runTimeModifiable = false;
    int logInterval = 1; ///< steps between blocks of the log

    std::vector<std::string> remarks; ///< what the user should know and the log should say
};

std::span<const Keyword> controlDictKeywords();

/// Reads <case>/system/controlDict. What is wrong goes to `problems`; @throws InputError where the file is
/// missing or not a dictionary.
ControlDict readControlDict(const std::filesystem::path& caseDirectory, InputProblems& problems);

} // namespace caisson
