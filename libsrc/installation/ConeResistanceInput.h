#pragma once

#include "dictionary/KeywordReader.h"
#include "installation/DepthProfile.h"

#include <filesystem>

namespace caisson {

inline constexpr Keyword coneResistance{"coneResistance", "Pa", "-", "(0, inf)", "Cone resistance, uniform."};
inline constexpr Keyword coneResistanceProfile{"coneResistanceProfile", "list", "-", "",
                                               "Cone resistance as ((depth [m] value [Pa]) ...)."};
inline constexpr Keyword coneResistanceFile{"coneResistanceFile", "dictionary", "-", "",
                                            "Cone resistance from a csv file."};

/// Keywords of the dictionary coneResistanceFile.
std::span<const Keyword> coneFileKeywords();

/// Reads the cone resistance from whichever of the three keys is written; reports none and more than one.
/// @param caseDirectory  what a file's name is relative to
DepthProfile readConeResistance(const KeywordReader& reader, const std::filesystem::path& caseDirectory);

/// Points written as ((x y) ...), x increasing, nothing negative; empty, with a problem reported, where not
/// so.
std::vector<std::vector<double>> readPairs(const KeywordReader& reader, std::string_view key,
                                           std::size_t least);

} // namespace caisson
