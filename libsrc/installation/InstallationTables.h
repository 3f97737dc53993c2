#pragma once

#include "installation/InstallationInput.h"

namespace caisson {

/// The stages as the text of a .dat file: the last line of the header names the columns; SI units.
std::string stageTable(const InstallationInput& input, const std::vector<InstallationStage>& stages);

/// Suction [Pa] (jacked: force [N]) against penetration [m] as a list ((h s) ...) that the Function1
/// `tableFile` reads, and `table` by #include.
std::string function1Table(const InstallationInput& input, const std::vector<InstallationStage>& stages);

} // namespace caisson
