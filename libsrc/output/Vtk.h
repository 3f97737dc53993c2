#pragma once

#include "case/FoamFile.h"

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

/// Numbers of VTK files: `single` halves the files, and is enough to look at.
enum class VtkPrecision { single, twofold };

/// The 2-D mesh as VTK draws it.
struct VtkGrid
{
    std::vector<std::array<double, 3>> points; ///< [m]
    int corners = 4;                           ///< points per cell: 3 or 4
    std::vector<int> cellPoints;               ///< corners * cells
    std::vector<NamedField> pointFields;
    std::vector<NamedField> cellFields;
};

/// Material points as vertices with their fields (and `cell`), appended raw. symmTensor fields come in VTK's
/// order xx yy zz xy yz xz. @param time  kept in the file as TimeValue [s]. @throws WriteError
void writeVtp(const std::filesystem::path& file, const Cloud& cloud, double time,
              VtkPrecision precision = VtkPrecision::single);

/// The mesh with its fields, likewise.
void writeVtu(const std::filesystem::path& file, const VtkGrid& grid, double time,
              VtkPrecision precision = VtkPrecision::single);

/// `<folder>/<name>_<timeName>.<extension>`, the file of one time of a series.
std::filesystem::path vtkSeriesFile(const std::filesystem::path& folder, std::string_view name,
                                    std::string_view timeName, std::string_view extension);

/// Writes `<name>.<extension>.series` and `<name>.pvd`, which list the files of the series that are in the
/// folder, up to `time` [s] (later ones are of an earlier run). Made from the folder each time, so a restart
/// goes on with the same series. @throws WriteError
void writeVtkSeries(const std::filesystem::path& folder, std::string_view name, std::string_view extension,
                    double time);

/// `<case>/case.foam`, the empty file that ParaView opens a case by.
void touchCaseFile(const std::filesystem::path& caseDirectory);

} // namespace caisson
