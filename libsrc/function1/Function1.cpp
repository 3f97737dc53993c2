#include "function1/Function1.h"

#include "dictionary/TextFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace caisson {

double Function1::end() const { return std::numeric_limits<double>::infinity(); }

namespace {

class Constant final : public Function1
{
public:
    explicit Constant(double value) : value_(value) {}
    [[nodiscard]] double value(double) const override { return value_; }

private:
    double value_;
};

/// Piecewise linear; beyond the ends as outOfBounds says.
class Table final : public Function1
{
public:
    enum class OutOfBounds { error, warn, clamp, repeat };

    Table(std::vector<std::array<double, 2>> rows, OutOfBounds outOfBounds)
        : rows_(std::move(rows)), outOfBounds_(outOfBounds)
    {
    }

    [[nodiscard]] double value(double x) const override
    {
        const double first = rows_.front()[0];
        const double last = rows_.back()[0];
        if (outOfBounds_ == OutOfBounds::repeat && last > first && (x < first || x > last)) {
            x = first + std::fmod(x - first, last - first);
            x = x < first ? x + (last - first) : x;
        }
        if (x <= first) {
            return rows_.front()[1];
        }
        if (x >= last) {
            return rows_.back()[1];
        }
        const auto above =
            std::ranges::upper_bound(rows_, x, {}, [](const std::array<double, 2>& row) { return row[0]; });
        const auto& [x1, y1] = *above;
        const auto& [x0, y0] = *(above - 1);
        return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    }
    [[nodiscard]] double end() const override
    {
        return outOfBounds_ == OutOfBounds::error ? rows_.back()[0] : std::numeric_limits<double>::infinity();
    }

private:
    std::vector<std::array<double, 2>> rows_;
    OutOfBounds outOfBounds_;
};

/// sum of c x^e
class Polynomial final : public Function1
{
public:
    explicit Polynomial(std::vector<std::array<double, 2>> terms) : terms_(std::move(terms)) {}
    [[nodiscard]] double value(double x) const override
    {
        double sum = 0;
        for (const auto& [coefficient, exponent] : terms_) {
            sum += coefficient * std::pow(x, exponent);
        }
        return sum;
    }

private:
    std::vector<std::array<double, 2>> terms_;
};

/// 0 before start, 1 after start + duration, `shape(share of the duration)` in between.
class Ramp final : public Function1
{
public:
    Ramp(double start, double duration, double (*shape)(double))
        : start_(start), duration_(duration), shape_(shape)
    {
    }
    [[nodiscard]] double value(double x) const override
    {
        return shape_(std::clamp((x - start_) / duration_, 0.0, 1.0));
    }

private:
    double start_, duration_;
    double (*shape_)(double);
};

double linearRamp(double s) { return s; }
double quadraticRamp(double s) { return s * s; }
double halfCosineRamp(double s) { return 0.5 * (1 - std::cos(std::numbers::pi * s)); }
double quarterSineRamp(double s) { return std::sin(0.5 * std::numbers::pi * s); }
double quarterCosineRamp(double s) { return 1 - std::cos(0.5 * std::numbers::pi * s); }

/// level + scale * amplitude * wave(frequency (x - t0)); wave of a phase in turns.
class Wave final : public Function1
{
public:
    enum class Kind { sine, cosine, square };
    Kind kind = Kind::sine;
    std::shared_ptr<const Function1> amplitude, frequency, scale, level;
    double start = 0;
    double markSpace = 1;

    [[nodiscard]] double value(double x) const override
    {
        const double turns = frequency->value(x) * (x - start);
        double wave = 0;
        if (kind == Kind::square) {
            const double mark = markSpace / (1 + markSpace);
            wave = turns - std::floor(turns) < mark ? 1 : -1;
        } else {
            const double phase = 2 * std::numbers::pi * turns;
            wave = kind == Kind::sine ? std::sin(phase) : std::cos(phase);
        }
        return level->value(x) + scale->value(x) * amplitude->value(x) * wave;
    }
};

class Scale final : public Function1
{
public:
    Scale(std::shared_ptr<const Function1> scale, std::shared_ptr<const Function1> value, double xScale)
        : scale_(std::move(scale)), value_(std::move(value)), xScale_(xScale)
    {
    }
    [[nodiscard]] double value(double x) const override
    {
        return scale_->value(x) * value_->value(xScale_ * x);
    }

private:
    std::shared_ptr<const Function1> scale_, value_;
    double xScale_;
};

/// 0 before start, 1 from then on.
class Step final : public Function1
{
public:
    explicit Step(double start) : start_(start) {}
    [[nodiscard]] double value(double x) const override { return x < start_ ? 0 : 1; }

private:
    double start_;
};

/// value(mapping(x))
class Composed final : public Function1
{
public:
    Composed(std::shared_ptr<const Function1> mapping, std::shared_ptr<const Function1> value)
        : mapping_(std::move(mapping)), value_(std::move(value))
    {
    }
    [[nodiscard]] double value(double x) const override { return value_->value(mapping_->value(x)); }

private:
    std::shared_ptr<const Function1> mapping_, value_;
};

const std::vector<std::string>& types()
{
    static const std::vector<std::string> words = {
        "constant",          "uniform",    "zero",       "one",           "table",          "tableFile",
        "csvFile",           "polynomial", "linearRamp", "quadraticRamp", "halfCosineRamp", "quarterSineRamp",
        "quarterCosineRamp", "sine",       "cosine",     "square",        "step",           "scale",
        "inputValueMapper"};
    return words;
}

bool punctuation(const Token& token, char c)
{
    return token.kind == Token::Kind::punctuation && token.text[0] == c;
}

/// Reads one function from its key; components of a vector are read one at a time.
class Reader
{
public:
    Reader(const Dictionary& dictionary, std::string_view key, int component, int components,
           InputProblems& problems)
        : dictionary_(dictionary), key_(key), component_(component), components_(components),
          problems_(problems)
    {
    }

    std::unique_ptr<Function1> read()
    {
        const Entry* entry = dictionary_.find(key_);
        if (!entry) {
            return complain(dictionary_.where(), "missing key '" + key_ + "'", "a Function1");
        }
        where_ = entry->where;
        if (entry->dictionary) {
            return readFrom(*entry->dictionary, typeOf(*entry->dictionary), {});
        }
        std::span<const Token> tokens = skipDimensions(entry->tokens);
        if (tokens.empty()) {
            return complain(where_, "'" + key_ + "' has no value", "a Function1");
        }
        if (tokens[0].kind == Token::Kind::number || punctuation(tokens[0], '(')) {
            return readConstant(tokens);
        }
        const std::string type = tokens[0].text;
        const Dictionary* coefficients = dictionary_.findDictionary(key_ + "Coeffs");
        static const Dictionary none;
        return readFrom(coefficients ? *coefficients : none, type, tokens.subspan(1));
    }

private:
    std::unique_ptr<Function1> complain(const SourceLocation& where, std::string message,
                                        std::string hint = {})
    {
        if (component_ == 0) { // once, not for every component
            problems_.add(where, std::move(message), std::move(hint));
        }
        return constantFunction1(0);
    }

    static std::span<const Token> skipDimensions(std::span<const Token> tokens)
    {
        if (tokens.empty() || !punctuation(tokens[0], '[')) {
            return tokens;
        }
        const auto close =
            std::ranges::find_if(tokens, [](const Token& token) { return punctuation(token, ']'); });
        return tokens.subspan(std::min<std::size_t>(tokens.size(), close - tokens.begin() + 1));
    }

    std::string typeOf(const Dictionary& from)
    {
        const Entry* type = from.find("type");
        return type && !type->tokens.empty() ? type->tokens[0].text : "";
    }

    /// A number or, for vectors, (x y z): this component.
    bool readValue(std::span<const Token>& tokens, double& value)
    {
        if (components_ == 1) {
            if (tokens.empty() || tokens[0].kind != Token::Kind::number) {
                return false;
            }
            value = tokens[0].number;
            tokens = tokens.subspan(1);
            return true;
        }
        if (tokens.size() < 2 + static_cast<std::size_t>(components_) || !punctuation(tokens[0], '(') ||
            !punctuation(tokens[components_ + 1], ')')) {
            return false;
        }
        if (tokens[1 + component_].kind != Token::Kind::number) {
            return false;
        }
        value = tokens[1 + component_].number;
        tokens = tokens.subspan(components_ + 2);
        return true;
    }

    std::unique_ptr<Function1> readConstant(std::span<const Token> tokens)
    {
        double value = 0;
        if (!readValue(tokens, value) || !tokens.empty()) {
            return complain(where_,
                            "'" + key_ + "' is no " + (components_ == 1 ? "number" : "vector (x y z)"),
                            suggestion("", types(), "Function1 types"));
        }
        return constantFunction1(value);
    }

    bool readRows(std::span<const Token> tokens, std::vector<std::array<double, 2>>& rows)
    {
        if (!tokens.empty() && tokens[0].kind == Token::Kind::number) {
            tokens = tokens.subspan(1);
        }
        if (tokens.size() < 2 || !punctuation(tokens[0], '(')) {
            return false;
        }
        tokens = tokens.subspan(1);
        while (!tokens.empty() && punctuation(tokens[0], '(')) {
            if (tokens.size() < 4 || tokens[1].kind != Token::Kind::number) {
                return false;
            }
            std::array<double, 2> row{tokens[1].number, 0};
            tokens = tokens.subspan(2);
            if (!readValue(tokens, row[1]) || tokens.empty() || !punctuation(tokens[0], ')')) {
                return false;
            }
            tokens = tokens.subspan(1);
            rows.push_back(row);
        }
        return tokens.size() == 1 && punctuation(tokens[0], ')') && !rows.empty();
    }

    std::shared_ptr<const Function1> part(const Dictionary& from, const char* key, double missing)
    {
        if (!from.find(key)) {
            return constantFunction1(missing);
        }
        return Reader(from, key, 0, 1, problems_).read();
    }

    double plain(const Dictionary& from, const char* key, double missing, bool required = false)
    {
        const Entry* entry = from.find(key);
        if (!entry) {
            if (required) {
                complain(where_, "'" + key_ + "' needs '" + key + "'");
            }
            return missing;
        }
        if (entry->tokens.size() != 1 || entry->tokens[0].kind != Token::Kind::number) {
            complain(entry->where, "'" + std::string(key) + "' is not a number");
            return missing;
        }
        return entry->tokens[0].number;
    }

    std::string wordOf(const Dictionary& from, const char* key, const char* missing)
    {
        const Entry* entry = from.find(key);
        return entry && !entry->tokens.empty() ? entry->tokens[0].text : missing;
    }

    std::unique_ptr<Function1> makeTable(const Dictionary& from, std::vector<std::array<double, 2>> rows)
    {
        for (std::size_t i = 1; i < rows.size(); ++i) {
            if (!(rows[i][0] > rows[i - 1][0])) {
                return complain(where_,
                                "the table of '" + key_ +
                                    "' does not rise: " + std::to_string(rows[i - 1][0]) +
                                    " is followed by " + std::to_string(rows[i][0]),
                                "the first column must increase from row to row");
            }
        }
        const std::string scheme = wordOf(from, "interpolationScheme", "linear");
        if (scheme != "linear") {
            return complain(where_, "unknown interpolationScheme '" + scheme + "'",
                            suggestion(scheme, {"linear"}, ""));
        }
        const std::string bounds = wordOf(from, "outOfBounds", "clamp");
        Table::OutOfBounds outOfBounds = Table::OutOfBounds::clamp;
        if (bounds == "error") {
            outOfBounds = Table::OutOfBounds::error;
        } else if (bounds == "warn") {
            outOfBounds = Table::OutOfBounds::warn;
        } else if (bounds == "repeat") {
            outOfBounds = Table::OutOfBounds::repeat;
        } else if (bounds != "clamp") {
            return complain(where_, "unknown outOfBounds '" + bounds + "'",
                            suggestion(bounds, {"error", "warn", "clamp", "repeat"}, ""));
        }
        return std::make_unique<Table>(std::move(rows), outOfBounds);
    }

    std::unique_ptr<Function1> readTable(const Dictionary& from, std::span<const Token> inlineTokens)
    {
        std::vector<std::array<double, 2>> rows;
        std::span<const Token> tokens = inlineTokens;
        if (tokens.empty()) {
            const Entry* values = from.find("values");
            if (!values) {
                return complain(where_, "'" + key_ + "': a table needs its rows",
                                "table ((x y) (x y)) or values ((x y) ...);");
            }
            tokens = values->tokens;
        }
        if (!readRows(tokens, rows)) {
            return complain(where_, "'" + key_ + "': the table's rows are not ((x y) (x y) ...)");
        }
        return makeTable(from, std::move(rows));
    }

    std::filesystem::path fileOf(const Dictionary& from)
    {
        const Entry* file = from.find("file");
        if (!file) {
            file = from.find("fileName");
        }
        if (!file || file->tokens.empty()) {
            complain(where_, "'" + key_ + "' needs 'file'");
            return {};
        }
        std::filesystem::path path(file->tokens[0].text);
        return path.is_absolute() ? path : std::filesystem::path(file->where.file).parent_path() / path;
    }

    std::unique_ptr<Function1> readTableFile(const Dictionary& from)
    {
        const std::filesystem::path path = fileOf(from);
        if (path.empty()) {
            return constantFunction1(0);
        }
        const auto text = readTextFile(path);
        if (!text) {
            return complain(where_, "'" + key_ + "': cannot read the table file '" + path.string() + "'");
        }
        std::vector<std::array<double, 2>> rows;
        try {
            const Dictionary parsed = parseDictionary("rows " + *text + ";", path.string());
            if (!readRows(parsed.find("rows")->tokens, rows)) {
                return complain({path.string(), 1}, "not a table ((x y) (x y) ...)");
            }
        } catch (const InputError& error) {
            return complain(error.problems().front().where, error.problems().front().message);
        }
        return makeTable(from, std::move(rows));
    }

    std::unique_ptr<Function1> readCsv(const Dictionary& from)
    {
        const std::filesystem::path path = fileOf(from);
        if (path.empty()) {
            return constantFunction1(0);
        }
        const auto text = readTextFile(path);
        if (!text) {
            return complain(where_, "'" + key_ + "': cannot read the file '" + path.string() + "'");
        }
        const int header = static_cast<int>(plain(from, "nHeaderLine", 0));
        const int reference = static_cast<int>(plain(from, "refColumn", 0));
        const std::string separatorText = wordOf(from, "separator", ",");
        const char separator = separatorText.empty() ? ',' : separatorText[0];
        const std::string merge = wordOf(from, "mergeSeparators", "no");
        const bool mergeSeparators = merge == "yes" || merge == "true" || merge == "on";
        std::vector<int> columns;
        if (const Entry* entry = from.find("componentColumns")) {
            for (const Token& token : entry->tokens) {
                if (token.kind == Token::Kind::number) {
                    columns.push_back(static_cast<int>(token.number));
                }
            }
            if (columns.size() == static_cast<std::size_t>(components_) + 1) { // N(a b c): the count
                columns.erase(columns.begin());
            }
        }
        if (columns.size() != static_cast<std::size_t>(components_)) {
            return complain(where_, "'" + key_ + "': componentColumns needs " + std::to_string(components_) +
                                        " column(s)");
        }
        std::vector<std::array<double, 2>> rows;
        std::istringstream stream(*text);
        std::string line;
        for (int number = 1; std::getline(stream, line); ++number) {
            if (number <= header || line.find_first_not_of(" \t\r") == std::string::npos) {
                continue;
            }
            std::vector<std::string> cells(1);
            for (const char c : line) {
                if (c == separator) {
                    if (!mergeSeparators || !cells.back().empty()) {
                        cells.emplace_back();
                    }
                } else if (c != '\r') {
                    cells.back() += c;
                }
            }
            std::array<double, 2> row{};
            const int wanted[2] = {reference, columns[component_]};
            for (int k = 0; k < 2; ++k) {
                if (wanted[k] < 0 || wanted[k] >= static_cast<int>(cells.size())) {
                    return complain({path.string(), number}, "has no column " + std::to_string(wanted[k]),
                                    "columns count from 0");
                }
                const std::string& cell = cells[wanted[k]];
                const std::size_t begin = cell.find_first_not_of(" \t");
                const char* first = cell.data() + (begin == std::string::npos ? cell.size() : begin);
                if (std::from_chars(first, cell.data() + cell.size(), row[k]).ec != std::errc()) {
                    return complain({path.string(), number}, "'" + cell + "' is not a number",
                                    "nHeaderLine tells how many lines to skip");
                }
            }
            rows.push_back(row);
        }
        if (rows.empty()) {
            return complain({path.string(), 1}, "has no rows");
        }
        return makeTable(from, std::move(rows));
    }

    std::unique_ptr<Function1> readFrom(const Dictionary& from, const std::string& type,
                                        std::span<const Token> tokens)
    {
        if (type == "constant" || type == "uniform") {
            if (tokens.empty()) {
                const Entry* value = from.find("value");
                if (!value) {
                    return complain(where_, "'" + key_ + "': type constant needs 'value'");
                }
                return readConstant(value->tokens);
            }
            return readConstant(tokens);
        }
        if (type == "zero" || type == "none") {
            if (type == "none") {
                return complain(where_, "'" + key_ + "' has the type none, which has no value",
                                suggestion("", types(), "Function1 types"));
            }
            return constantFunction1(0);
        }
        if (type == "one") {
            return constantFunction1(1);
        }
        if (type == "table" && (!tokens.empty() || from.find("values") || !from.find("file"))) {
            return readTable(from, tokens);
        }
        if (type == "tableFile" || type == "table") {
            return readTableFile(from);
        }
        if (type == "csvFile") {
            return readCsv(from);
        }
        if (type == "polynomial") {
            std::vector<std::array<double, 2>> terms;
            std::span<const Token> rows = tokens;
            if (rows.empty()) {
                const Entry* entry = from.find("coeffs");
                rows = entry ? std::span<const Token>(entry->tokens) : rows;
            }
            // Rows are (coefficient exponent): for vectors (coefficients exponents), by component.
            std::vector<std::array<double, 2>> pairs;
            if (components_ != 1 || !readRows(rows, pairs)) {
                return complain(where_, "'" + key_ + "': polynomial needs ((coefficient exponent) ...)");
            }
            return std::make_unique<Polynomial>(std::move(pairs));
        }
        constexpr std::pair<std::string_view, double (*)(double)> ramps[] = {
            {"linearRamp", linearRamp},
            {"quadraticRamp", quadraticRamp},
            {"halfCosineRamp", halfCosineRamp},
            {"quarterSineRamp", quarterSineRamp},
            {"quarterCosineRamp", quarterCosineRamp}};
        for (const auto& [word, shape] : ramps) {
            if (type == word) {
                const double duration = plain(from, "duration", 1, true);
                if (duration <= 0) {
                    return complain(where_, "'" + key_ + "': duration must be positive");
                }
                return std::make_unique<Ramp>(plain(from, "start", 0), duration, shape);
            }
        }
        if (type == "sine" || type == "cosine" || type == "square") {
            auto wave = std::make_unique<Wave>();
            wave->kind = type == "sine"     ? Wave::Kind::sine
                         : type == "cosine" ? Wave::Kind::cosine
                                            : Wave::Kind::square;
            if (!from.find("frequency") && from.find("period")) {
                wave->frequency = constantFunction1(1 / plain(from, "period", 1));
            } else if (!from.find("frequency")) {
                return complain(where_, "'" + key_ + "': type " + type + " needs 'frequency' [1/s]");
            } else {
                wave->frequency = part(from, "frequency", 1);
            }
            wave->amplitude = part(from, "amplitude", 1);
            wave->scale = part(from, "scale", 1);
            wave->level = part(from, "level", 0);
            wave->start = plain(from, from.find("start") ? "start" : "t0", 0);
            wave->markSpace = plain(from, "markSpace", 1);
            return wave;
        }
        if (type == "step") {
            return std::make_unique<Step>(plain(from, "start", 0));
        }
        if (type == "scale") {
            if (!from.find("value")) {
                return complain(where_, "'" + key_ + "': type scale needs 'value'");
            }
            std::shared_ptr<const Function1> value =
                Reader(from, "value", component_, components_, problems_).read();
            return std::make_unique<Scale>(part(from, "scale", 1), value, plain(from, "xScale", 1));
        }
        if (type == "inputValueMapper") {
            const std::string mode = wordOf(from, "mode", "");
            std::shared_ptr<const Function1> value =
                Reader(from, "value", component_, components_, problems_).read();
            if (mode == "function") {
                return std::make_unique<Composed>(part(from, "function", 0), value);
            }
            if (mode == "minMax") {
                const double low = plain(from, "min", 0, true);
                const double high = plain(from, "max", 1, true);
                auto clampTable = std::make_shared<Table>(
                    std::vector<std::array<double, 2>>{{low, low}, {high, high}}, Table::OutOfBounds::clamp);
                return std::make_unique<Composed>(clampTable, value);
            }
            return complain(where_, "'" + key_ + "': unknown mode '" + mode + "' of inputValueMapper",
                            suggestion(mode, {"function", "minMax"}, "modes"));
        }
        if (type == "coded" || type == "functionObjectValue" || type == "functionObjectTrigger") {
            return complain(where_,
                            "'" + key_ + "': Function1 type " + type +
                                " needs OpenFOAM's run time, which caissonFoam is not",
                            suggestion(type, types(), "Function1 types"));
        }
        return complain(where_, "unknown Function1 type '" + type + "' for '" + key_ + "'",
                        suggestion(type, types(), "Function1 types"));
    }

    const Dictionary& dictionary_;
    std::string key_;
    int component_, components_;
    InputProblems& problems_;
    SourceLocation where_;
};

} // namespace

std::unique_ptr<Function1> constantFunction1(double value) { return std::make_unique<Constant>(value); }

std::unique_ptr<Function1> readFunction1(const Dictionary& dictionary, std::string_view key,
                                         InputProblems& problems)
{
    return Reader(dictionary, key, 0, 1, problems).read();
}

std::array<double, 3> VectorFunction1::value(double x) const
{
    return {component[0]->value(x), component[1]->value(x), component[2]->value(x)};
}

VectorFunction1 readVectorFunction1(const Dictionary& dictionary, std::string_view key,
                                    InputProblems& problems)
{
    VectorFunction1 result;
    for (int k = 0; k < 3; ++k) {
        result.component[k] = Reader(dictionary, key, k, 3, problems).read();
    }
    return result;
}

} // namespace caisson
