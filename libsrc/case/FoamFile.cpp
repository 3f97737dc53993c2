#include "case/FoamFile.h"

#include "case/FileIO.h"
#include "case/FoamScanner.h"
#include "dictionary/Dictionary.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdint>
#include <set>
#include <span>
#include <stdexcept>

namespace caisson {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view divider =
    "// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //\n\n";
constexpr std::string_view ending =
    "\n// ************************************************************************* //\n";

struct KindName
{
    FieldKind kind;
    int components;
    std::string_view type;      ///< as in List<...>
    std::string_view fieldName; ///< as in <...>Field, capital after vol and point
};
constexpr std::array<KindName, 4> kindNames{{{FieldKind::label, 1, "label", "Label"},
                                             {FieldKind::scalar, 1, "scalar", "Scalar"},
                                             {FieldKind::vector, 3, "vector", "Vector"},
                                             {FieldKind::symmTensor, 6, "symmTensor", "SymmTensor"}}};

const KindName& nameOf(FieldKind kind) { return kindNames[static_cast<std::size_t>(kind)]; }

const KindName* kindOfClass(std::string_view className)
{
    for (const KindName& kind : kindNames) {
        const std::string fieldName = std::string(kind.fieldName) + "Field";
        if (className == std::string(kind.type) + "Field" || className == "vol" + fieldName ||
            className == "point" + fieldName) {
            return &kind;
        }
    }
    return nullptr;
}

/// Name under which a time directory will be known: ".0.5.writing" is to become "0.5".
std::string finalName(const fs::path& timeDirectory)
{
    const fs::path bare = timeDirectory.has_filename() ? timeDirectory : timeDirectory.parent_path();
    std::string name = bare.filename().string();
    constexpr std::string_view writing = ".writing";
    if (name.size() > writing.size() + 1 && name.front() == '.' && name.ends_with(writing)) {
        name = name.substr(1, name.size() - 1 - writing.size());
    }
    return name;
}

std::string header(std::string_view className, const std::string& location, std::string_view object,
                   bool binary)
{
    std::string text = "/*--------------------------------*- C++ -*----------------------------------*\\\n"
                       "| caissonFoam: suction caissons and other foundations going into the seabed   |\n"
                       "\\*---------------------------------------------------------------------------*/\n"
                       "FoamFile\n{\n"
                       "    version     2.0;\n";
    const auto entry = [&](std::string key, std::string_view value) {
        key.resize(12, ' ');
        text.append("    ").append(key).append(value).append(";\n");
    };
    entry("format", binary ? "binary" : "ascii");
    entry("class", className);
    if (binary) {
        entry("arch", "\"LSB;label=32;scalar=64\"");
    }
    entry("location", '"' + location + '"');
    entry("object", object);
    return text.append("}\n").append(divider);
}

void appendNumber(std::string& text, double value, int precision)
{
    std::array<char, 64> digits;
    // 17 digits always carry a double; the shortest text that comes back as the same bits does as well.
    char* const last = digits.data() + digits.size();
    const auto [end, error] =
        precision >= 17 ? std::to_chars(digits.data(), last, value)
                        : std::to_chars(digits.data(), last, value, std::chars_format::general, precision);
    assert(error == std::errc{});
    (void)error;
    text.append(digits.data(), end);
}

void appendNumber(std::string& text, int value)
{
    std::array<char, 16> digits;
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

template <class T>
void appendRaw(std::string& text, std::span<const T> values)
{
    text.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void appendItem(std::string& text, std::span<const double> item, int precision)
{
    if (item.size() == 1) {
        appendNumber(text, item[0], precision);
        return;
    }
    text += '(';
    for (std::size_t i = 0; i < item.size(); ++i) {
        text += i == 0 ? "" : " ";
        appendNumber(text, item[i], precision);
    }
    text += ')';
}

/// `N ( ... )`, an item per line in ascii.
void appendList(std::string& text, std::span<const double> values, FieldKind kind, const WriteStyle& style)
{
    const auto width = static_cast<std::size_t>(components(kind));
    text.append(std::to_string(values.size() / width)).append("\n(");
    if (kind == FieldKind::label) {
        std::vector<std::int32_t> labels(values.begin(), values.end());
        if (style.binary) {
            appendRaw<std::int32_t>(text, labels);
        } else {
            for (const std::int32_t value : labels) {
                text += '\n';
                appendNumber(text, value);
            }
        }
    } else if (style.binary) {
        appendRaw(text, values);
    } else {
        for (std::size_t i = 0; i < values.size(); i += width) {
            text += '\n';
            appendItem(text, values.subspan(i, width), style.precision);
        }
    }
    text += style.binary ? ")" : "\n)";
}

std::span<const double> flat(const std::vector<std::array<double, 3>>& points)
{
    return {points.empty() ? nullptr : points.front().data(), 3 * points.size()};
}

} // namespace

void writeFoamFile(const fs::path& timeDirectory, const std::string& subDirectory, std::string_view className,
                   const std::string& object, const std::string& body, const WriteStyle& style)
{
    const std::string location = finalName(timeDirectory) + (subDirectory.empty() ? "" : "/" + subDirectory);
    std::string text = header(className, location, object, style.binary);
    text.append(body).append("\n").append(ending);
    writeFileAtomically(timeDirectory / subDirectory / object, text, style.compressed);
}

int components(FieldKind kind) { return nameOf(kind).components; }

void writeCloud(const fs::path& timeDirectory, const Cloud& cloud, const WriteStyle& style)
{
    const std::size_t size = cloud.positions.size();
    if (cloud.cells.size() != size) {
        throw std::logic_error("cloud " + cloud.name + ": one cell per position is needed");
    }
    const std::string folder = "lagrangian/" + cloud.name;

    // Each particle in brackets of its own: the layout that ParaView's reader and OpenFOAM read back.
    std::string body = std::to_string(size) + "\n(";
    for (std::size_t i = 0; i < size; ++i) {
        body += '\n';
        if (style.binary) {
            const std::int32_t cell = cloud.cells[i];
            body += '(';
            appendRaw<double>(body, cloud.positions[i]);
            appendRaw<std::int32_t>(body, {&cell, 1});
            body += ')';
        } else {
            appendItem(body, cloud.positions[i], style.precision);
            body += ' ';
            appendNumber(body, cloud.cells[i]);
        }
    }
    body += "\n)";
    writeFoamFile(timeDirectory, folder, "Cloud<passiveParticle>", "positions", body, style);

    for (const NamedField& field : cloud.fields) {
        if (field.values.size() != size * static_cast<std::size_t>(components(field.kind))) {
            throw std::logic_error("cloud " + cloud.name + ": field " + field.name + " has the wrong size");
        }
        body.clear();
        appendList(body, field.values, field.kind, style);
        writeFoamFile(timeDirectory, folder, std::string(nameOf(field.kind).type) + "Field", field.name, body,
                      style);
    }

    // Tells OpenFOAM's own tools to read `positions`, not `coordinates`.
    writeDictionaryFile(timeDirectory, "uniform/" + folder, "cloudProperties",
                        "geometry        positions;\n\nprocessor0\n{\n    particleCount   " +
                            std::to_string(size) + ";\n}");
}

Cloud readCloud(const fs::path& timeDirectory, std::string_view name)
{
    Cloud cloud;
    cloud.name = name;
    const fs::path folder = timeDirectory / "lagrangian" / cloud.name;
    const std::string display = finalName(timeDirectory) + "/lagrangian/" + cloud.name + "/";

    FoamScanner in(folder / "positions", display + "positions",
                   fileExists(folder / "coordinates")
                       ? "only 'coordinates' is there: the form with 'positions' is needed"
                       : "fill the mesh with material points first: run setMaterialPoints");
    if (!in.className().starts_with("Cloud")) {
        in.fail("class '" + in.className() + "' is not a cloud", "expected: Cloud<passiveParticle>");
    }
    const int size = in.label();
    in.expect('(');
    std::vector<double> position;
    for (int i = 0; i < size; ++i) {
        in.expect('(');
        position.clear();
        if (in.binary()) {
            in.rawScalars(3, position);
            in.rawLabels(1, cloud.cells);
            in.expect(')');
        } else {
            for (int k = 0; k < 3; ++k) {
                position.push_back(in.scalar());
            }
            in.expect(')');
            cloud.cells.push_back(in.label());
        }
        cloud.positions.push_back({position[0], position[1], position[2]});
    }
    in.expect(')');

    std::set<std::string> names;
    for (const auto& item : fs::directory_iterator(folder)) {
        std::string file = item.path().filename().string();
        file = file.ends_with(".gz") ? file.substr(0, file.size() - 3) : file;
        if (file != "positions" && file.front() != '.' && !file.ends_with('~')) {
            names.insert(file);
        }
    }
    for (const std::string& file : names) {
        FoamScanner values(folder / file, display + file);
        const KindName* kind = kindOfClass(values.className());
        if (kind == nullptr) {
            values.fail("class '" + values.className() + "' is not a field of a cloud",
                        "valid: labelField scalarField vectorField symmTensorField");
        }
        NamedField field{file, kind->kind, {}};
        if (kind->kind == FieldKind::label) {
            const std::vector<int> labels = values.labelList();
            field.values.assign(labels.begin(), labels.end());
        } else {
            field.values = values.scalarList(kind->components);
        }
        const auto items = static_cast<int>(field.values.size()) / kind->components;
        if (items != size) {
            values.fail("field of " + std::to_string(items) + " values for a cloud of " +
                        std::to_string(size) + " material points");
        }
        cloud.fields.push_back(std::move(field));
    }
    return cloud;
}

void writeField(const fs::path& timeDirectory, const NamedField& field, bool atPoints,
                std::string_view dimensions,
                const std::vector<std::pair<std::string, std::string>>& patchEntries, const WriteStyle& style)
{
    if (field.kind == FieldKind::label) {
        throw std::logic_error("field " + field.name + ": OpenFOAM has no point or vol field of labels");
    }
    const KindName& kind = nameOf(field.kind);
    std::string body = "dimensions      " + std::string(dimensions) + ";\n\n";
    body.append("internalField   nonuniform List<").append(kind.type).append("> \n");
    appendList(body, field.values, field.kind, style);
    body += ";\n\nboundaryField\n{\n";
    for (const auto& [patch, entry] : patchEntries) {
        body.append("    ").append(patch).append("\n    {\n        ").append(entry).append("\n    }\n");
    }
    body += "}";
    writeFoamFile(timeDirectory, "", (atPoints ? "point" : "vol") + std::string(kind.fieldName) + "Field",
                  field.name, body, style);
}

namespace {

/// The numbers of `internalField uniform ...` where macros stand in it or before it.
std::vector<double> uniformFromDictionary(const fs::path& file, const std::string& display,
                                          const FoamScanner& in)
{
    const fs::path timeDirectory = file.parent_path();
    const Dictionary dictionary = readDictionary(file, timeDirectory.parent_path(), display);
    const Entry* entry = dictionary.find("internalField");
    if (entry == nullptr) {
        throw InputError(
            display, {{{display, 0}, "internalField is missing", "for example: internalField uniform 0;"}});
    }
    if (entry->tokens.empty() || entry->tokens.front().text != "uniform") {
        throw InputError(
            display,
            {{entry->where, "internalField must be 'uniform ...' or 'nonuniform List<...> ...'", {}}});
    }
    std::vector<double> numbers;
    for (std::size_t i = 1; i < entry->tokens.size(); ++i) {
        const Token& token = entry->tokens[i];
        if (token.kind == Token::Kind::number) {
            numbers.push_back(token.number);
        } else if (token.text != "(" && token.text != ")") {
            in.fail("internalField: expected a number, got '" + token.text + "'");
        }
    }
    return numbers;
}

/// Moves to behind the keyword internalField; false where the file ends before.
bool findInternalField(FoamScanner& in)
{
    while (in.peek() != '\0') {
        if (in.peek() == '#') {
            in.skipLine();
        } else if (in.peek() == '{' || in.peek() == ';' || in.word() != "internalField") {
            in.skipEntry();
        } else {
            return true;
        }
    }
    return false;
}

} // namespace

NamedField readField(const fs::path& file, int size)
{
    const std::string display = finalName(file.parent_path()) + "/" + file.filename().string();
    FoamScanner in(file, display);
    const KindName* kind = kindOfClass(in.className());
    if (kind == nullptr || kind->kind == FieldKind::label) {
        in.fail("class '" + in.className() + "' is not a field",
                "valid: volScalarField volVectorField "
                "volSymmTensorField pointScalarField pointVectorField pointSymmTensorField");
    }
    NamedField field{file.filename().string(), kind->kind, {}};
    const auto width = static_cast<std::size_t>(kind->components);

    if (findInternalField(in) && in.peek() == 'n') {
        if (in.word() != "nonuniform") {
            in.fail("internalField must be 'uniform ...' or 'nonuniform List<...> ...'");
        }
        field.values = in.scalarList(kind->components);
        if (field.values.size() != width * static_cast<std::size_t>(size)) {
            in.fail("internalField has " + std::to_string(field.values.size() / width) +
                    " values, the mesh needs " + std::to_string(size));
        }
        return field;
    }
    const std::vector<double> uniform = uniformFromDictionary(file, display, in);
    if (uniform.size() != width) {
        in.fail("internalField: " + std::to_string(width) + " numbers expected, got " +
                std::to_string(uniform.size()));
    }
    field.values.reserve(width * static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) {
        field.values.insert(field.values.end(), uniform.begin(), uniform.end());
    }
    return field;
}

void writeDictionaryFile(const fs::path& timeDirectory, const std::string& subDirectory,
                         const std::string& object, const std::string& body)
{
    writeFoamFile(timeDirectory, subDirectory, "dictionary", object, body,
                  {.binary = false, .compressed = false});
}

void writePoints(const fs::path& timeDirectory, const std::vector<std::array<double, 3>>& points,
                 const WriteStyle& style)
{
    std::string body;
    appendList(body, flat(points), FieldKind::vector, style);
    writeFoamFile(timeDirectory, "polyMesh", "vectorField", "points", body, style);
}

} // namespace caisson
