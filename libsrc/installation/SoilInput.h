#pragma once

#include "installation/InstallationInput.h"

#include <functional>

namespace caisson {

/// Makes a method once the caisson, with its weight, is known. @throws std::invalid_argument as the methods
/// do
using MethodMaker = std::function<std::unique_ptr<InstallationMethod>(const Caisson&)>;

/// Reads the dictionary `soil` of a method: permeabilities and the unit weight at the sea bed go to `input`.
/// @param method  one of installationMethods()
/// @returns what makes the method; to be called only where no problem was found
MethodMaker readSoil(const std::string& method, const Dictionary& soil,
                     const std::filesystem::path& caseDirectory, InputProblems& problems,
                     InstallationInput& input);

/// Tables of keywords of `soil` and of the dictionaries in it.
std::vector<InstallationKeywords> soilKeywords();

} // namespace caisson
