#pragma once

#include "dictionary/KeywordReader.h"
#include "function1/Function1.h"
#include "installation/InstallationStages.h"

#include <filesystem>

namespace caisson {

/// What system/suctionPressureDict asks for, checked.
struct InstallationInput
{
    std::string methodName;
    std::unique_ptr<InstallationMethod> method;
    InstallationSite site;
    double effectiveUnitWeight = 0;  ///< at the sea bed, to normalise with [N/m3]
    bool jacked = false;             ///< no suction: the forces of jacking
    double start = 0;                ///< first penetration [m]
    double end = 0;                  ///< last penetration [m]
    double increment = 0;            ///< [m]
    double byWeight = 0;             ///< penetration reached without suction [m]
    std::unique_ptr<Function1> rate; ///< [m/s] against penetration [m]; nullptr where not given
    std::string tableFile;           ///< for the Function1 table, relative to the case
};

/// Valid words for `method`.
std::vector<std::string> installationMethods();

/// One dictionary's table of keywords, for the user guide.
struct InstallationKeywords
{
    std::string title;
    std::span<const Keyword> keywords;
};
std::vector<InstallationKeywords> installationKeywords();

/// Reads the dictionary; files that it names are relative to `caseDirectory`.
/// @throws InputError with every problem found
InstallationInput readInstallation(const Dictionary& dictionary, const std::filesystem::path& caseDirectory);

} // namespace caisson
