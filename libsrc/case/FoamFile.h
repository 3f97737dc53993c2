#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace caisson {

/// How files of a case are written (controlDict: writeFormat, writePrecision, writeCompression).
struct WriteStyle
{
    bool binary = true;
    int precision =
        17; ///< digits of ascii numbers; 17 (or the fewest that do the same) carry a double exactly
    bool compressed = false;
};

enum class FieldKind { label, scalar, vector, symmTensor }; ///< 1, 1, 3, 6 components

/// A named field, components interleaved (symmTensor: xx xy xz yy yz zz).
struct NamedField
{
    std::string name;
    FieldKind kind = FieldKind::scalar;
    std::vector<double> values;
};
int components(FieldKind kind);

/// Material points as OpenFOAM keeps a cloud: `lagrangian/<name>/positions` and a file per field.
struct Cloud
{
    std::string name = "materialPoints";
    std::vector<std::array<double, 3>> positions;
    std::vector<int> cells;
    std::vector<NamedField> fields;
};

/// Writes `<timeDirectory>/lagrangian/<cloud>/...` and uniform/lagrangian/<cloud>/cloudProperties (geometry
/// positions), in the form that ParaView's OpenFOAM reader shows.
void writeCloud(const std::filesystem::path& timeDirectory, const Cloud& cloud, const WriteStyle& style);
/// Reads it back, every bit. @throws InputError on a missing, short or foreign file.
Cloud readCloud(const std::filesystem::path& timeDirectory, std::string_view name);

/// Writes a pointScalarField/pointVectorField (atPoints) or volScalarField/... with one boundaryField entry
/// per patch: `patchEntries[i] = {patch name, "type zeroGradient;"}`.
void writeField(const std::filesystem::path& timeDirectory, const NamedField& field, bool atPoints,
                std::string_view dimensions,
                const std::vector<std::pair<std::string, std::string>>& patchEntries,
                const WriteStyle& style);
/// The internalField of a field file; `uniform` is spread over `size` items.
NamedField readField(const std::filesystem::path& file, int size);

/// `<timeDirectory>/<subDirectory>/<object>`: the header of the class, then the body.
void writeFoamFile(const std::filesystem::path& timeDirectory, const std::string& subDirectory,
                   std::string_view className, const std::string& object, const std::string& body,
                   const WriteStyle& style);

/// `<timeDirectory>/<subDirectory>/<object>`, a dictionary with the entries `body`.
void writeDictionaryFile(const std::filesystem::path& timeDirectory, const std::string& subDirectory,
                         const std::string& object, const std::string& body);

/// `<timeDirectory>/polyMesh/points`.
void writePoints(const std::filesystem::path& timeDirectory, const std::vector<std::array<double, 3>>& points,
                 const WriteStyle& style);

} // namespace caisson
