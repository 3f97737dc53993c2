#include "installation/ConeResistanceInput.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace caisson {
namespace {

constexpr std::array fileKeywords{
    Keyword{"file", "string", "", "", "File, relative to the case."},
    Keyword{"nHeaderLine", "integer", "1", "[0, inf)", "Lines before the first record."},
    Keyword{"depthColumn", "integer", "0", "[0, inf)", "Column of the depth, from 0."},
    Keyword{"valueColumn", "integer", "1", "[0, inf)", "Column of the cone resistance, from 0."},
    Keyword{"separator", "string", ",", "", "Between the columns."},
    Keyword{"depthFactor", "-", "1", "(0, inf)", "Turns the depth into m."},
    Keyword{"valueFactor", "-", "1", "(0, inf)", "Turns the cone resistance into Pa (1e6 for MPa)."},
};

/// Columns of a csv file. Problems name the file and the line.
DepthProfile readConeFile(const Dictionary& dictionary, const std::filesystem::path& caseDirectory,
                          InputProblems& problems)
{
    const std::size_t before = problems.all().size();
    const KeywordReader reader(dictionary, fileKeywords, "'coneResistanceFile'", problems);
    const std::string name = reader.word("file");
    const auto headerLines = reader.integer("nHeaderLine");
    const auto depthColumn = static_cast<std::size_t>(reader.integer("depthColumn"));
    const auto valueColumn = static_cast<std::size_t>(reader.integer("valueColumn"));
    const std::string separator = reader.word("separator");
    const double depthFactor = reader.number("depthFactor");
    const double valueFactor = reader.number("valueFactor");
    if (problems.all().size() > before)
        return DepthProfile();
    std::ifstream file(caseDirectory / name);
    if (!file) {
        reader.problem("file", "cannot read the file '" + name + "'");
        return DepthProfile();
    }
    if (separator.size() != 1) {
        reader.problem("separator", "the separator must be one character");
        return DepthProfile();
    }

    std::vector<double> depth;
    std::vector<double> value;
    std::string line;
    for (int lineNumber = 1; std::getline(file, line); ++lineNumber) {
        if (lineNumber <= headerLines || line.find_first_not_of(" \t\r") == std::string::npos)
            continue;
        std::vector<double> columns;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, separator.front());) {
            std::istringstream text(cell);
            double number = 0;
            const bool isNumber = static_cast<bool>(text >> number) && (text >> std::ws).eof();
            columns.push_back(isNumber ? number : std::numeric_limits<double>::quiet_NaN());
        }
        const std::size_t needed = std::max(depthColumn, valueColumn) + 1;
        const bool good = columns.size() >= needed && std::isfinite(columns[depthColumn]) &&
                          std::isfinite(columns[valueColumn]);
        if (!good || columns[depthColumn] < 0 || columns[valueColumn] < 0) {
            problems.add({name, lineNumber},
                         good ? "depth and cone resistance must not be negative"
                              : "no number in the columns of depth and cone resistance",
                         "check nHeaderLine, depthColumn, valueColumn and separator");
            return DepthProfile();
        }
        depth.push_back(columns[depthColumn] * depthFactor);
        value.push_back(columns[valueColumn] * valueFactor);
        if (depth.size() > 1 && depth.back() < depth[depth.size() - 2]) {
            problems.add({name, lineNumber}, "the depth decreases");
            return DepthProfile();
        }
    }
    if (depth.empty()) {
        problems.add({name, 0}, "the file holds no record");
        return DepthProfile();
    }
    return {depth, value};
}

} // namespace

std::span<const Keyword> coneFileKeywords() { return fileKeywords; }

/// Points of a profile written as ((x y) ...).
std::vector<std::vector<double>> readPairs(const KeywordReader& reader, const std::string_view key,
                                           const std::size_t least)
{
    const std::size_t before = reader.problems().all().size();
    std::vector<std::vector<double>> rows = reader.rows(key);
    if (reader.problems().all().size() > before)
        return {};
    const std::string name = "'" + std::string(key) + "'";
    const auto notIncreasing = [](const auto& a, const auto& b) { return a[0] >= b[0]; };
    if (rows.size() < least || std::ranges::any_of(rows, [](const auto& row) { return row.size() != 2; }))
        reader.problem(key, name + " needs " + std::to_string(least) + " or more pairs: ((0 0) (1 1))");
    else if (std::ranges::adjacent_find(rows, notIncreasing) != rows.end())
        reader.problem(key, "the first numbers of " + name + " must increase");
    else if (std::ranges::any_of(rows, [](const auto& row) { return row[0] < 0 || row[1] < 0; }))
        reader.problem(key, name + " holds a negative number");
    else
        return rows;
    return {};
}

DepthProfile readConeResistance(const KeywordReader& reader, const std::filesystem::path& caseDirectory)
{
    const int given = static_cast<int>(reader.has("coneResistance")) +
                      static_cast<int>(reader.has("coneResistanceProfile")) +
                      static_cast<int>(reader.has("coneResistanceFile"));
    if (given != 1)
        reader.problem("coneResistance",
                       given == 0 ? "the cone resistance is missing" : "the cone resistance is given twice",
                       "give one of coneResistance, coneResistanceProfile, coneResistanceFile");
    else if (reader.has("coneResistance"))
        return DepthProfile(reader.number("coneResistance"));
    else if (reader.has("coneResistanceFile")) {
        if (const Dictionary* file = reader.dictionary("coneResistanceFile"))
            return readConeFile(*file, caseDirectory, reader.problems());
    } else {
        std::vector<double> depth;
        std::vector<double> value;
        for (const auto& row : readPairs(reader, "coneResistanceProfile", 1)) {
            depth.push_back(row[0]);
            value.push_back(row[1]);
        }
        if (!depth.empty())
            return {depth, value};
    }
    return DepthProfile();
}

} // namespace caisson
