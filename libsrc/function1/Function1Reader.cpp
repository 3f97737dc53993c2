// Reads Function1 in the spellings of OpenFOAM v1912 and v2406.

#include "dictionary/TextFile.h"
#include "function1/Function1Types.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace caisson {

namespace {

using Rows = std::vector<std::array<double, 2>>;

// x is a time [s] or a length [m], as the key that the function belongs to says.
constexpr Keyword typeKey = {"type", "word", "-", "", "type of the function"};
constexpr Keyword outOfBoundsKey = {"outOfBounds", "word", "clamp", "error warn clamp repeat",
                                    "beyond the ends: stop, warn once, keep the end value, or start again"};
constexpr Keyword schemeKey = {"interpolationScheme", "word", "linear", "linear", "between the rows"};
constexpr Keyword fileKey = {"file", "string", "", "", "relative to the case"};
constexpr Keyword oldFileKey = {"fileName", "string", "-", "", "old spelling of file"};
constexpr Keyword valueKey = {"value", "Function1", "", "", "the function"};

constexpr Keyword noKeys[] = {typeKey};
constexpr Keyword constantKeys[] = {typeKey, {"value", "number", "", "", "the value"}};
constexpr Keyword tableKeys[] = {typeKey,
                                 {"values", "list", "-", "", "((x y) (x y) ...), x rising"},
                                 {"file", "string", "-", "", "file with ((x y) (x y) ...)"},
                                 outOfBoundsKey,
                                 schemeKey};
constexpr Keyword tableFileKeys[] = {
    typeKey, {"file", "string", "-", "", "file with ((x y) ...)"}, oldFileKey, outOfBoundsKey, schemeKey};
constexpr Keyword csvKeys[] = {typeKey,
                               fileKey,
                               {"nHeaderLine", "integer", "0", "[0, inf)", "lines to skip"},
                               {"refColumn", "integer", "0", "[0, 10000]", "column of x, from 0"},
                               {"componentColumns", "list", "", "", "columns of the value, from 0"},
                               {"separator", "string", ",", "", "character between the columns"},
                               {"mergeSeparators", "flag", "no", "", "several separators count as one"},
                               outOfBoundsKey,
                               schemeKey};
constexpr Keyword polynomialKeys[] = {typeKey, {"coeffs", "list", "", "", "((coefficient exponent) ...)"}};
constexpr Keyword rampKeys[] = {typeKey,
                                {"start", "s or m", "0", "", "begin of the ramp"},
                                {"duration", "s or m", "", "(0, inf)", "length of the ramp"}};
constexpr Keyword waveKeys[] = {typeKey,
                                {"amplitude", "Function1", "1", "", "factor of the wave"},
                                {"frequency", "Function1", "-", "", "cycles per unit of x"},
                                {"period", "Function1", "-", "", "instead of frequency"},
                                {"scale", "Function1", "1", "", "factor with the value's components"},
                                {"level", "Function1", "0", "", "added to the wave"},
                                {"t0", "s or m", "0", "", "where the first cycle begins"}};
constexpr Keyword squareKeys[] = {waveKeys[0],
                                  waveKeys[1],
                                  waveKeys[2],
                                  waveKeys[3],
                                  waveKeys[4],
                                  waveKeys[5],
                                  waveKeys[6],
                                  {"mark", "-", "1", "(0, inf)", "share of the positive part"},
                                  {"space", "-", "1", "(0, inf)", "share of the negative part"},
                                  {"markSpace", "-", "-", "(0, inf)", "mark/space, as v1912 spells it"}};
constexpr Keyword scaleKeys[] = {typeKey, {"scale", "Function1", "", "", "a number's function"}, valueKey};
constexpr Keyword limitKeys[] = {typeKey,
                                 {"min", "-", "", "", "least x that value sees"},
                                 {"max", "-", "", "", "greatest x that value sees"},
                                 valueKey};
constexpr Keyword mapperKeys[] = {typeKey,
                                  {"mode", "word", "", "none function minMax", "how x is mapped"},
                                  {"function", "Function1", "-", "", "the mapping, for mode function"},
                                  {"min", "-", "-", "", "for mode minMax"},
                                  {"max", "-", "-", "", "for mode minMax"},
                                  valueKey};

bool is(const Token& token, char c) { return token.kind == Token::Kind::punctuation && token.text[0] == c; }

/// Reads one function, or one component of a vector-valued one, from its key.
class Reader
{
public:
    Reader(const Dictionary& dictionary, std::string_view key, int component, int components,
           InputProblems& problems)
        : dictionary_(dictionary), key_(key), component_(component), components_(components),
          problems_(problems)
    {
    }

    std::unique_ptr<Function1> read();

    using Result = std::unique_ptr<Function1>;
    using Tokens = std::span<const Token>;

    /// One type: its keys, and how it is made from them or from what stands behind the type word.
    struct Type
    {
        std::string_view name;
        std::span<const Keyword> keys;
        Result (Reader::*make)(const KeywordReader& keys, Tokens inlineValue);
        bool hasInlineValue;
        bool forNumbersOnly;
    };
    static std::span<const Type> types();

private:
    Result readType(const std::string& word, const Dictionary* coefficients, Tokens inlineValue);
    Result readConstant(const KeywordReader& keys, Tokens inlineValue);
    Result readZero(const KeywordReader&, Tokens) { return constantFunction1(0); }
    Result readOne(const KeywordReader&, Tokens) { return constantFunction1(1); }
    Result readTable(const KeywordReader& keys, Tokens inlineValue);
    Result readCsv(const KeywordReader& keys, Tokens);
    Result readPolynomial(const KeywordReader& keys, Tokens inlineValue);
    template <Ramp::Shape shape>
    Result readRamp(const KeywordReader& keys, Tokens);
    Result readStep(const KeywordReader& keys, Tokens);
    template <Wave::Kind kind>
    Result readWave(const KeywordReader& keys, Tokens);
    Result readScale(const KeywordReader& keys, Tokens);
    Result readLimit(const KeywordReader& keys, Tokens);
    Result readMapper(const KeywordReader& keys, Tokens);

    Result complain(const SourceLocation& where, std::string message, std::string hint = {});
    Result makeConstant(Tokens tokens);
    Result makeTable(const KeywordReader& keys, Rows rows);
    [[nodiscard]] bool readNumber(Tokens& tokens, int components, double& value) const;
    [[nodiscard]] bool readRows(Tokens tokens, int firstComponents, Rows& rows) const;
    std::optional<std::string> readFile(const std::string& name, const SourceLocation& where,
                                        std::filesystem::path& path);
    bool readCells(const std::string& line, char separator, bool merge, const std::array<long, 2>& columns,
                   const SourceLocation& where, std::array<double, 2>& row);
    /// A function that this one is made of, of 1 component or as many as this one has; where it is not
    /// written, `missing`, or a problem.
    Result part(const KeywordReader& keys, std::string_view key, int components,
                std::optional<double> missing = {});

    const Dictionary& dictionary_;
    std::string key_;
    int component_, components_;
    InputProblems& problems_;
    SourceLocation where_;
};

std::span<const Reader::Type> Reader::types()
{
    static constexpr Type table[] = {
        {"constant", constantKeys, &Reader::readConstant, true, false},
        {"uniform", constantKeys, &Reader::readConstant, true, false},
        {"zero", noKeys, &Reader::readZero, false, false},
        {"one", noKeys, &Reader::readOne, false, false},
        {"table", tableKeys, &Reader::readTable, true, false},
        {"tableFile", tableFileKeys, &Reader::readTable, false, false},
        {"csvFile", csvKeys, &Reader::readCsv, false, false},
        {"polynomial", polynomialKeys, &Reader::readPolynomial, true, false},
        {"linearRamp", rampKeys, &Reader::readRamp<Ramp::linear>, false, true},
        {"quadraticRamp", rampKeys, &Reader::readRamp<Ramp::quadratic>, false, true},
        {"halfCosineRamp", rampKeys, &Reader::readRamp<Ramp::halfCosine>, false, true},
        {"quarterSineRamp", rampKeys, &Reader::readRamp<Ramp::quarterSine>, false, true},
        {"quarterCosineRamp", rampKeys, &Reader::readRamp<Ramp::quarterCosine>, false, true},
        {"step", rampKeys, &Reader::readStep, false, true},
        {"sine", waveKeys, &Reader::readWave<Wave::Kind::sine>, false, false},
        {"cosine", waveKeys, &Reader::readWave<Wave::Kind::cosine>, false, false},
        {"square", squareKeys, &Reader::readWave<Wave::Kind::square>, false, false},
        {"scale", scaleKeys, &Reader::readScale, false, false},
        {"limitRange", limitKeys, &Reader::readLimit, false, false},
        {"inputValueMapper", mapperKeys, &Reader::readMapper, false, false},
    };
    return table;
}

Reader::Result Reader::complain(const SourceLocation& where, std::string message, std::string hint)
{
    problems_.add(where, std::move(message), std::move(hint));
    return constantFunction1(0);
}

Reader::Result Reader::read()
{
    const Entry* entry = dictionary_.find(key_);
    if (!entry) {
        return complain(dictionary_.where(), "missing key '" + key_ + "'", "a Function1");
    }
    where_ = entry->where;
    if (entry->dictionary) {
        const Entry* type = entry->dictionary->find("type");
        const std::string word = type && type->tokens.size() == 1 ? type->tokens[0].text : "";
        return readType(word, entry->dictionary.get(), {});
    }
    const Tokens tokens = entry->tokens;
    if (tokens.empty()) {
        return complain(where_, "'" + key_ + "' has no value", "a number or a Function1");
    }
    if (is(tokens[0], '[')) {
        return complain(where_, "'" + key_ + "' has a dimension set, which a Function1 does not take",
                        "leave it out: values are in SI units");
    }
    if (tokens[0].kind != Token::Kind::word) {
        return makeConstant(tokens);
    }
    return readType(tokens[0].text, dictionary_.findDictionary(key_ + "Coeffs"), tokens.subspan(1));
}

Reader::Result Reader::readType(const std::string& word, const Dictionary* coefficients, Tokens inlineValue)
{
    if (word == "none") {
        return complain(where_, "'" + key_ + "' has the type none, which has no value",
                        "leave '" + key_ + "' out where it is optional");
    }
    for (const std::string_view foreign : {"coded", "functionObjectValue", "functionObjectTrigger"}) {
        if (word == foreign) {
            return complain(where_, "'" + key_ + "': Function1 type " + word + " needs OpenFOAM at run time",
                            "write the series as a table or csvFile");
        }
    }
    const auto type = std::ranges::find(types(), word, &Type::name);
    if (type == types().end()) {
        std::vector<std::string> valid;
        for (const Type& known : types()) {
            valid.emplace_back(known.name);
        }
        return complain(where_, "unknown Function1 type '" + word + "' for '" + key_ + "'",
                        suggestion(word, valid, "Function1 types"));
    }
    if (type->forNumbersOnly && components_ > 1) {
        return complain(where_, "'" + key_ + "' is a vector, but the type " + word + " gives a number",
                        "type scale; scale { type " + word + "; ... } value (x y z);");
    }
    if (!type->hasInlineValue && !inlineValue.empty()) {
        return complain(where_, "'" + key_ + "': nothing may follow the type word " + word,
                        key_ + " { type " + word + "; ... }");
    }
    static const Dictionary none;
    const bool needsKeys =
        std::ranges::any_of(type->keys, [](const Keyword& keyword) { return keyword.defaultValue.empty(); });
    if (!coefficients && inlineValue.empty() && (needsKeys || type->hasInlineValue)) {
        return complain(where_, "'" + key_ + "': type " + word + " needs more than its name",
                        key_ + " { type " + word + "; ... } or a dictionary " + key_ + "Coeffs");
    }
    const KeywordReader keys(coefficients ? *coefficients : none, type->keys, "'" + key_ + "'", problems_);
    return (this->*type->make)(keys, inlineValue);
}

/// A number or, for vectors, this component of (x y z).
bool Reader::readNumber(Tokens& tokens, int components, double& value) const
{
    const std::size_t length = components == 1 ? 1 : components + 2;
    if (tokens.size() < length || (components > 1 && !(is(tokens[0], '(') && is(tokens[length - 1], ')')))) {
        return false;
    }
    const Token& token = tokens[components == 1 ? 0 : 1 + component_];
    value = token.number;
    tokens = tokens.subspan(length);
    return token.kind == Token::Kind::number && std::isfinite(value);
}

/// ((x y) (x y) ...) with an optional count before; x has `firstComponents`.
bool Reader::readRows(Tokens tokens, int firstComponents, Rows& rows) const
{
    std::optional<double> count;
    if (!tokens.empty() && tokens[0].isInteger) {
        count = tokens[0].number;
        tokens = tokens.subspan(1);
    }
    if (tokens.size() < 2 || !is(tokens[0], '(')) {
        return false;
    }
    tokens = tokens.subspan(1);
    while (!tokens.empty() && is(tokens[0], '(')) {
        tokens = tokens.subspan(1);
        std::array<double, 2> row{};
        if (!readNumber(tokens, firstComponents, row[0]) || !readNumber(tokens, components_, row[1]) ||
            tokens.empty() || !is(tokens[0], ')')) {
            return false;
        }
        tokens = tokens.subspan(1);
        rows.push_back(row);
    }
    return tokens.size() == 1 && is(tokens[0], ')') && !rows.empty() &&
           count.value_or(static_cast<double>(rows.size())) == static_cast<double>(rows.size());
}

Reader::Result Reader::makeConstant(Tokens tokens)
{
    double value = 0;
    if (!readNumber(tokens, components_, value) || !tokens.empty()) {
        return complain(where_,
                        "'" + key_ + "' is no " + (components_ == 1 ? "number" : "vector (x y z)") +
                            " and no Function1",
                        "write a value, or " + key_ + " { type table; values ((x y) ...); }");
    }
    return constantFunction1(value);
}

Reader::Result Reader::readConstant(const KeywordReader& keys, Tokens inlineValue)
{
    if (!inlineValue.empty()) {
        return makeConstant(inlineValue);
    }
    const Entry* value = keys.entry("value");
    return value ? makeConstant(value->tokens) : constantFunction1(0);
}

Reader::Result Reader::makeTable(const KeywordReader& keys, Rows rows)
{
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (!(rows[i][0] > rows[i - 1][0])) {
            std::ostringstream message;
            message << "the table of '" << key_ << "' does not rise: " << rows[i - 1][0] << " is followed by "
                    << rows[i][0];
            return complain(where_, message.str(), "the first column must increase from row to row");
        }
    }
    static_cast<void>(keys.word("interpolationScheme")); // linear, or a problem
    const std::string word = keys.word("outOfBounds");
    const Table::OutOfBounds outOfBounds = word == "error"    ? Table::OutOfBounds::error
                                           : word == "warn"   ? Table::OutOfBounds::warn
                                           : word == "repeat" ? Table::OutOfBounds::repeat
                                                              : Table::OutOfBounds::clamp;
    return std::make_unique<Table>(std::move(rows), outOfBounds, where_, key_);
}

/// The text of the file that `name` stands for; a problem where there is none.
std::optional<std::string> Reader::readFile(const std::string& name, const SourceLocation& where,
                                            std::filesystem::path& path)
{
    try {
        path = dictionary_.filePath(name);
    } catch (const InputError& error) {
        complain(where, error.problems().front().message, error.problems().front().hint);
        return std::nullopt;
    }
    auto text = readTextFile(path);
    if (!text) {
        complain(where, "'" + key_ + "': cannot read the file '" + path.string() + "'");
    }
    return text;
}

/// Inline rows, `values`, or a file of rows.
Reader::Result Reader::readTable(const KeywordReader& keys, Tokens inlineValue)
{
    const Dictionary& from = keys.source();
    const Entry* values = from.find("values");
    const Entry* file = from.find("file") ? from.find("file") : from.find("fileName");
    Rows rows;
    if (!inlineValue.empty() || (values && !file)) {
        const Tokens tokens = inlineValue.empty() ? Tokens(values->tokens) : inlineValue;
        if (!readRows(tokens, 1, rows)) {
            return complain(where_, "'" + key_ + "': the table's rows are not " +
                                        (components_ == 1 ? "((x y) (x y) ...)" : "((x (a b c)) ...)"));
        }
        return makeTable(keys, std::move(rows));
    }
    if (!file || values || file->tokens.size() != 1) {
        return complain(where_, "'" + key_ + "': a table needs its rows or one file",
                        "values ((x y) (x y) ...);  or  file \"name\";");
    }
    std::filesystem::path path;
    const auto text = readFile(file->tokens[0].text, file->where, path);
    if (!text) {
        return constantFunction1(0);
    }
    try {
        const Dictionary parsed =
            parseDictionary("rows " + *text + "\n;", path.string()) /* a comment may end it */;
        if (parsed.entries().size() != 1 || !readRows(parsed.find("rows")->tokens, 1, rows)) {
            return complain({path.string(), 1}, "not a table ((x y) (x y) ...)");
        }
    } catch (const InputError& error) {
        return complain(error.problems().front().where, error.problems().front().message);
    }
    return makeTable(keys, std::move(rows));
}

bool Reader::readCells(const std::string& line, char separator, bool merge,
                       const std::array<long, 2>& columns, const SourceLocation& where,
                       std::array<double, 2>& row)
{
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == separator) {
            if (!merge || !cells.back().empty()) {
                cells.emplace_back();
            }
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k] < 0 || columns[k] >= static_cast<long>(cells.size())) {
            complain(where, "has no column " + std::to_string(columns[k]), "columns count from 0");
            return false;
        }
        const std::string& cell = cells[columns[k]];
        const char* first = cell.data() + std::min(cell.find_first_not_of(" \t+"), cell.size());
        const char* last = cell.data() + cell.find_last_not_of(" \t") + 1;
        const auto parsed = std::from_chars(first, last, row[k]);
        if (parsed.ec != std::errc() || parsed.ptr != last || !std::isfinite(row[k])) {
            complain(where, "'" + cell + "' is not a number", "nHeaderLine tells how many lines to skip");
            return false;
        }
    }
    return true;
}

Reader::Result Reader::readCsv(const KeywordReader& keys, Tokens)
{
    constexpr double mostColumns = 1e4;
    const std::string name = keys.word("file");
    const std::vector<double> columns = keys.numbers("componentColumns");
    const std::string separator = keys.word("separator");
    if (separator.size() != 1) {
        return complain(keys.where("separator"),
                        "'" + key_ + "': the separator '" + separator + "' is not one character",
                        "a tabulator stands in the quotes as it is");
    }
    for (const double column : columns) {
        if (column != std::floor(column) || column < 0 || column > mostColumns) {
            return complain(keys.where("componentColumns"),
                            "'" + key_ + "': componentColumns are whole numbers, from 0");
        }
    }
    if (name.empty() || columns.empty()) {
        return constantFunction1(0); // reported
    }
    if (columns.size() != static_cast<std::size_t>(components_)) {
        return complain(keys.where("componentColumns"), "'" + key_ + "' has " + std::to_string(components_) +
                                                            " component(s), componentColumns " +
                                                            std::to_string(columns.size()));
    }
    std::filesystem::path path;
    const auto text = readFile(name, keys.where("file"), path);
    if (!text) {
        return constantFunction1(0);
    }
    const std::array<long, 2> wanted{keys.integer("refColumn"), std::lround(columns[component_])};
    const long header = keys.integer("nHeaderLine");
    const bool merge = keys.flag("mergeSeparators");
    Rows rows;
    std::istringstream stream(*text);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        if (number <= header || line.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        std::array<double, 2> row{};
        if (!readCells(line, separator[0], merge, wanted, {path.string(), number}, row)) {
            return constantFunction1(0);
        }
        rows.push_back(row);
    }
    if (rows.empty()) {
        return complain({path.string(), 0}, "has no rows");
    }
    return makeTable(keys, std::move(rows));
}

/// ((coefficient exponent) ...), for vectors (((cx cy cz) (ex ey ez)) ...).
Reader::Result Reader::readPolynomial(const KeywordReader& keys, Tokens inlineValue)
{
    const Entry* entry = inlineValue.empty() ? keys.entry("coeffs") : nullptr;
    Rows terms;
    if (!readRows(entry ? Tokens(entry->tokens) : inlineValue, components_, terms)) {
        return complain(where_, "'" + key_ + "': polynomial needs ((coefficient exponent) ...)");
    }
    return std::make_unique<Polynomial>(std::move(terms));
}

template <Ramp::Shape shape>
Reader::Result Reader::readRamp(const KeywordReader& keys, Tokens)
{
    return std::make_unique<Ramp>(keys.number("start"), keys.number("duration"), shape);
}

Reader::Result Reader::readStep(const KeywordReader& keys, Tokens)
{
    return std::make_unique<Step>(keys.number("start"), keys.number("duration"));
}

Reader::Result Reader::part(const KeywordReader& keys, std::string_view key, int components,
                            std::optional<double> missing)
{
    if (keys.has(key)) {
        return Reader(keys.source(), key, components == 1 ? 0 : component_, components, problems_).read();
    }
    return missing ? constantFunction1(*missing)
                   : complain(where_, "'" + key_ + "' needs '" + std::string(key) + "'", "a Function1");
}

template <Wave::Kind kind>
Reader::Result Reader::readWave(const KeywordReader& keys, Tokens)
{
    auto wave = std::make_unique<Wave>();
    wave->kind = kind;
    if (keys.has("frequency") == keys.has("period")) {
        return complain(where_, "'" + key_ + "' needs either frequency or period");
    }
    (keys.has("frequency") ? wave->frequency : wave->period) =
        part(keys, keys.has("frequency") ? "frequency" : "period", 1);
    wave->amplitude = part(keys, "amplitude", 1, 1);
    wave->scale = part(keys, "scale", components_, 1);
    wave->level = part(keys, "level", components_, 0);
    wave->t0 = keys.number("t0");
    if (wave->period && wave->period->value(wave->t0) == 0) {
        return complain(where_, "'" + key_ + "': the period is zero");
    }
    if constexpr (kind == Wave::Kind::square) {
        double mark = keys.number("mark");
        double space = keys.number("space");
        if (keys.has("markSpace")) {
            mark = keys.number("markSpace");
            space = 1;
            if (keys.has("mark") || keys.has("space")) {
                return complain(where_, "'" + key_ + "' has both markSpace and mark or space");
            }
        }
        wave->markFraction = mark / (mark + space);
    }
    return wave;
}

Reader::Result Reader::readScale(const KeywordReader& keys, Tokens)
{
    SharedFunction1 scale = part(keys, "scale", 1);
    return std::make_unique<Scale>(std::move(scale), part(keys, "value", components_));
}

Reader::Result Reader::readLimit(const KeywordReader& keys, Tokens)
{
    const double min = keys.number("min");
    const double max = keys.number("max");
    if (min > max) {
        return complain(keys.where("min"), "'" + key_ + "': min is above max");
    }
    return std::make_unique<LimitRange>(min, max, part(keys, "value", components_));
}

Reader::Result Reader::readMapper(const KeywordReader& keys, Tokens)
{
    const std::string mode = keys.word("mode");
    if (mode == "none") {
        return part(keys, "value", components_);
    }
    if (mode == "function") {
        SharedFunction1 mapping = part(keys, "function", 1);
        return std::make_unique<InputValueMapper>(std::move(mapping), part(keys, "value", components_));
    }
    if (mode == "minMax" && !(keys.has("min") && keys.has("max"))) {
        return complain(where_, "'" + key_ + "': mode minMax needs 'min' and 'max'");
    }
    return readLimit(keys, {});
}

} // namespace

std::vector<std::string> function1Types()
{
    std::vector<std::string> words;
    for (const Reader::Type& type : Reader::types()) {
        words.emplace_back(type.name);
    }
    return words;
}

std::vector<Keyword> function1Keywords(const std::string& type)
{
    const auto found = std::ranges::find(Reader::types(), type, &Reader::Type::name);
    if (found == Reader::types().end()) {
        throw std::out_of_range("unknown Function1 type '" + type + "'");
    }
    return {found->keys.begin(), found->keys.end()};
}

std::unique_ptr<Function1> readFunction1(const Dictionary& dictionary, std::string_view key,
                                         InputProblems& problems)
{
    return Reader(dictionary, key, 0, 1, problems).read();
}

VectorFunction1 readVectorFunction1(const Dictionary& dictionary, std::string_view key,
                                    InputProblems& problems)
{
    VectorFunction1 result;
    bool reported = false; // what is wrong with all components is said once
    for (int k = 0; k < 3; ++k) {
        InputProblems ofComponent;
        result.component[k] = Reader(dictionary, key, k, 3, ofComponent).read();
        for (const InputProblem& problem : ofComponent.all()) {
            if (!reported) {
                problems.add(problem.where, problem.message, problem.hint);
            }
        }
        reported = reported || !ofComponent.empty();
    }
    return result;
}

} // namespace caisson
