#include "dictionary/KeywordReader.h"

#include "dictionary/Pattern.h"
#include "dictionary/Units.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace caisson {

namespace {

constexpr std::string_view required;
constexpr std::string_view optionalKey = "-";

std::vector<std::string> split(std::string_view text)
{
    std::vector<std::string> words;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == ' ') {
            ++i;
            continue;
        }
        const std::size_t end = std::min(text.find(' ', i), text.size());
        words.emplace_back(text.substr(i, end - i));
        i = end;
    }
    return words;
}

double parseBound(std::string_view text)
{
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    if (text == "inf") {
        return std::numeric_limits<double>::infinity();
    }
    if (text == "-inf") {
        return -std::numeric_limits<double>::infinity();
    }
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

bool isInterval(std::string_view range)
{
    return !range.empty() && (range.front() == '(' || range.front() == '[');
}

bool inside(double value, std::string_view range)
{
    const std::size_t comma = range.find(',');
    const double low = parseBound(range.substr(1, comma - 1));
    const double high = parseBound(range.substr(comma + 1, range.size() - comma - 2));
    const bool aboveLow = range.front() == '[' ? value >= low : value > low;
    const bool belowHigh = range.back() == ']' ? value <= high : value < high;
    return aboveLow && belowHigh;
}

const Keyword* findKeyword(std::span<const Keyword> table, std::string_view key)
{
    const auto found = std::ranges::find(table, key, &Keyword::name);
    return found == table.end() ? nullptr : &*found;
}

const Keyword& keywordOf(std::span<const Keyword> table, std::string_view key)
{
    const Keyword* found = findKeyword(table, key);
    if (!found) {
        throw std::logic_error("keyword '" + std::string(key) + "' is in no table");
    }
    return *found;
}

std::string spell(const Entry& entry)
{
    if (entry.dictionary) {
        return "{...}";
    }
    std::string text;
    for (const Token& token : entry.tokens) {
        text += (text.empty() ? "" : " ") + token.text;
        if (text.size() > 60) {
            return text.substr(0, 57) + "...";
        }
    }
    return text;
}

/// `hint`, or, where the value goes on in the next line, what the reason may be.
std::string semicolonHint(const Entry& entry, std::string hint)
{
    const bool longer = !entry.tokens.empty() && entry.tokens.back().line > entry.where.line;
    return longer ? "is the ';' missing at the end of the line?" : std::move(hint);
}

bool isPunctuation(const Token& token, char c)
{
    return token.kind == Token::Kind::punctuation && token.text[0] == c;
}

/// Lists of numbers: `(a b c)`, `3(a b c)`, `3{a}`, and rows of these.
class ListReader
{
public:
    explicit ListReader(std::span<const Token> tokens) : tokens_(tokens) {}

    /// One row, or a list of rows; no other token, none of them empty. @returns whether it is that
    bool readRows(std::vector<std::vector<double>>& rows)
    {
        skipWord("uniform");
        skipWord("constant");
        skipWord("nonuniform");
        if (at(0) && at(0)->kind == Token::Kind::word && at(0)->text.starts_with("List<")) {
            tokens_ = tokens_.subspan(1);
        }
        const std::optional<double> count = readCount();
        if (at(0) && at(1) && isPunctuation(*at(0), '(') &&
            (isPunctuation(*at(1), '(') || (at(2) && isPunctuation(*at(2), '(')))) {
            tokens_ = tokens_.subspan(1);
            while (at(0) && !isPunctuation(*at(0), ')')) {
                rows.emplace_back();
                if (!readRow(readCount(), rows.back())) {
                    return false;
                }
            }
            return tokens_.size() == 1 && (!count || *count == static_cast<double>(rows.size()));
        }
        rows.emplace_back();
        return readRow(count, rows.back()) && tokens_.empty();
    }

private:
    [[nodiscard]] const Token* at(std::size_t i) const { return i < tokens_.size() ? &tokens_[i] : nullptr; }

    void skipWord(std::string_view word)
    {
        if (at(0) && at(0)->kind == Token::Kind::word && at(0)->text == word) {
            tokens_ = tokens_.subspan(1);
        }
    }
    std::optional<double> readCount()
    {
        if (!at(0) || !at(0)->isInteger) {
            return std::nullopt;
        }
        const double count = at(0)->number;
        tokens_ = tokens_.subspan(1);
        return count;
    }
    bool readRow(std::optional<double> count, std::vector<double>& row)
    {
        constexpr double longest = 1e7; // of N{v}
        if (count && at(2) && isPunctuation(*at(0), '{') && at(1)->kind == Token::Kind::number &&
            isPunctuation(*at(2), '}') && *count > 0 && *count <= longest) {
            row.assign(static_cast<std::size_t>(*count), at(1)->number);
            tokens_ = tokens_.subspan(3);
            return true;
        }
        if (!at(0) || !isPunctuation(*at(0), '(')) {
            return false;
        }
        tokens_ = tokens_.subspan(1);
        while (at(0) && at(0)->kind == Token::Kind::number && std::isfinite(at(0)->number)) {
            row.push_back(at(0)->number);
            tokens_ = tokens_.subspan(1);
        }
        if (!at(0) || !isPunctuation(*at(0), ')')) {
            return false;
        }
        tokens_ = tokens_.subspan(1);
        return !row.empty() && (!count || *count == static_cast<double>(row.size()));
    }

    std::span<const Token> tokens_;
};

/// The value's tokens: without a leading name (legacy `nu nu [..] 1`) and dimension set, which is checked.
std::span<const Token> valueTokens(const Entry& entry, const Keyword& keyword, InputProblems& problems)
{
    std::span<const Token> tokens = entry.tokens;
    if (tokens.size() > 1 && tokens[0].kind == Token::Kind::word && isPunctuation(tokens[1], '[')) {
        tokens = tokens.subspan(1);
    }
    if (tokens.empty() || !isPunctuation(tokens[0], '[')) {
        return tokens;
    }
    std::size_t close = 0;
    while (close < tokens.size() && !isPunctuation(tokens[close], ']')) {
        ++close;
    }
    if (close == tokens.size()) {
        problems.add(entry.where, "'" + entry.keyword + "': dimension set without ']'");
        return {};
    }
    std::optional<Dimensions> given;
    Dimensions exponents{};
    bool allNumbers = true;
    std::string symbols;
    for (std::size_t i = 1; i < close; ++i) {
        allNumbers = allNumbers && tokens[i].kind == Token::Kind::number;
        if (tokens[i].kind == Token::Kind::number && i - 1 < exponents.size()) {
            exponents[i - 1] = tokens[i].number;
        }
        symbols += tokens[i].text + " ";
    }
    if (allNumbers && (close - 1 == 5 || close - 1 == 7)) {
        given = exponents;
    } else if (!allNumbers || close == 1) {
        given = close == 1 ? Dimensions{} : dimensionsOf(symbols);
    }
    const std::optional<Dimensions> expected = dimensionsOf(keyword.unit);
    if (!given) {
        problems.add(entry.where, "'" + entry.keyword + "': '[" + symbols + "]' is no dimension set",
                     "five or seven exponents of kg m s K mol A cd, or units such as [kg m^-3]");
    } else if (!expected && *given != Dimensions{}) {
        problems.add(entry.where, "'" + entry.keyword + "' takes no dimension set",
                     "leave it out (" + std::string(keyword.unit) + ")");
    } else if (expected && *given != *expected) {
        problems.add(entry.where, "'" + entry.keyword + "' has the dimensions " + printDimensions(*given),
                     "expected " + printDimensions(*expected) + ", the unit is " + std::string(keyword.unit));
    }
    return tokens.subspan(close + 1);
}

void checkWord(const Entry& entry, const Keyword& keyword, const std::string& word, InputProblems& problems)
{
    const std::vector<std::string> valid = split(keyword.range);
    if (!valid.empty() && std::ranges::find(valid, word) == valid.end()) {
        problems.add(entry.where, "unknown word '" + word + "' for " + std::string(keyword.name),
                     suggestion(word, valid, ""));
    }
}

} // namespace

KeywordReader::KeywordReader(const Dictionary& dictionary, std::span<const Keyword> table,
                             std::string_view what, InputProblems& problems)
    : dictionary_(dictionary), table_(table), what_(what), problems_(problems)
{
    std::vector<std::string> valid;
    for (const Keyword& keyword : table_) {
        valid.emplace_back(keyword.name);
    }
    for (const Entry& entry : dictionary_.entries()) {
        const bool coefficients = areCoefficients(entry);
        const bool known =
            entry.isPattern
                ? std::ranges::any_of(valid, [&](const auto& name) { return entry.pattern->matches(name); })
                : findKeyword(table_, entry.keyword) || entry.keyword == "FoamFile" || coefficients ||
                      dictionary_.usedAsMacro(entry.keyword);
        if (!known) {
            problems_.add(entry.where,
                          entry.isPattern ? "\"" + entry.keyword + "\" matches no key of " + what_
                                          : "unknown key '" + entry.keyword + "' in " + what_,
                          suggestion(entry.keyword, valid, "keys"));
        }
    }
}

/// Whether `entry` is `keyCoeffs { ... }` beside `key word ...;`, as a Function1 may be written.
bool KeywordReader::areCoefficients(const Entry& entry) const
{
    constexpr std::string_view ending = "Coeffs";
    if (!entry.dictionary || !entry.keyword.ends_with(ending)) {
        return false;
    }
    const std::string_view key =
        std::string_view(entry.keyword).substr(0, entry.keyword.size() - ending.size());
    const Entry* owner = findKeyword(table_, key) ? dictionary_.find(key) : nullptr;
    return owner && !owner->tokens.empty() && owner->tokens[0].kind == Token::Kind::word;
}

bool KeywordReader::has(std::string_view key) const
{
    static_cast<void>(keywordOf(table_, key));
    return dictionary_.find(key) != nullptr;
}

const Entry* KeywordReader::entry(std::string_view key) const
{
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = dictionary_.find(key);
    if (!found && keyword.defaultValue == required) {
        std::string hint = std::string(keyword.meaning);
        const auto dimensions = dimensionsOf(keyword.unit);
        hint += dimensions ? " [" + std::string(keyword.unit) + "]" : " (" + std::string(keyword.unit) + ")";
        problems_.add(dictionary_.where(), "missing key '" + std::string(key) + "' in " + what_, hint);
    }
    return found;
}

SourceLocation KeywordReader::where(std::string_view key) const
{
    const Entry* found = dictionary_.find(key);
    return found ? found->where : dictionary_.where();
}

void KeywordReader::problem(std::string_view key, std::string message, std::string hint) const
{
    problems_.add(where(key), std::move(message), std::move(hint));
}

double KeywordReader::number(std::string_view key) const
{
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = entry(key);
    double value = parseBound(keyword.defaultValue);
    if (!found) {
        return keyword.defaultValue == required || keyword.defaultValue == optionalKey ? 0 : value;
    }
    const auto tokens = valueTokens(*found, keyword, problems_);
    if (found->dictionary || tokens.size() != 1 || tokens[0].kind != Token::Kind::number) {
        problems_.add(found->where, "'" + std::string(key) + "' is '" + spell(*found) + "', not a number",
                      semicolonHint(*found, "unit: " + std::string(keyword.unit)));
        return 0;
    }
    value = tokens[0].number;
    if (!std::isfinite(value) || (isInterval(keyword.range) && !inside(value, keyword.range))) {
        problems_.add(found->where,
                      std::string(key) + " " + tokens[0].text + " is outside " + std::string(keyword.range),
                      std::string(keyword.meaning) + " [" + std::string(keyword.unit) + "]");
    }
    return value;
}

long KeywordReader::integer(std::string_view key) const
{
    const Entry* found = dictionary_.find(key);
    const double value = number(key);
    constexpr double largest = 9e15; // whole numbers that a double holds
    if (found && (value != std::floor(value) || std::abs(value) > largest)) {
        problems_.add(found->where,
                      "'" + std::string(key) + "' is '" + spell(*found) + "', not a whole number");
        return 0;
    }
    const Keyword& keyword = keywordOf(table_, key);
    if (found && !isInterval(keyword.range) && !keyword.range.empty()) {
        const auto valid = split(keyword.range);
        if (std::ranges::find(valid, std::to_string(static_cast<long>(value))) == valid.end()) {
            problems_.add(found->where,
                          std::string(key) + " " + spell(*found) + " is not among the valid ones",
                          "valid: " + std::string(keyword.range));
        }
    }
    return static_cast<long>(value);
}

bool KeywordReader::flag(std::string_view key) const
{
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = entry(key);
    const std::string text = found && found->tokens.size() == 1 ? found->tokens[0].text
                             : found                            ? spell(*found)
                                                                : std::string(keyword.defaultValue);
    for (const std::string_view yes : {"yes", "on", "true", "y", "t"}) {
        if (text == yes) {
            return true;
        }
    }
    for (const std::string_view no : {"no", "off", "false", "n", "f", "none"}) {
        if (text == no) {
            return false;
        }
    }
    if (found) {
        problems_.add(found->where, "'" + std::string(key) + "' is '" + text + "', not a flag",
                      semicolonHint(*found, "valid: yes no on off true false"));
    }
    return false;
}

std::string KeywordReader::word(std::string_view key) const
{
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = entry(key);
    if (!found) {
        return keyword.defaultValue == optionalKey ? std::string() : std::string(keyword.defaultValue);
    }
    if (found->dictionary || found->tokens.size() != 1 ||
        (found->tokens[0].kind != Token::Kind::word && found->tokens[0].kind != Token::Kind::string)) {
        problems_.add(
            found->where, "'" + std::string(key) + "' is '" + spell(*found) + "', not one word",
            semicolonHint(*found, keyword.range.empty() ? "" : "valid: " + std::string(keyword.range)));
        return {};
    }
    std::string text = found->tokens[0].text;
    checkWord(*found, keyword, text, problems_);
    return text;
}

std::vector<std::string> KeywordReader::words(std::string_view key) const
{
    std::vector<std::string> result;
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = entry(key);
    if (!found) {
        return keyword.defaultValue == optionalKey ? result : split(keyword.defaultValue);
    }
    std::span<const Token> tokens = found->tokens;
    std::optional<double> count; // may stand before a list
    if (tokens.size() > 1 && tokens[0].isInteger && isPunctuation(tokens[1], '(')) {
        count = tokens[0].number;
        tokens = tokens.subspan(1);
    }
    if (tokens.empty()) {
        problem(key, "'" + std::string(key) + "' is '" + spell(*found) + "', not a list of words",
                "write (a b c)");
    }
    if (tokens.size() > 1 && isPunctuation(tokens.front(), '(') && isPunctuation(tokens.back(), ')')) {
        tokens = tokens.subspan(1, tokens.size() - 2);
    }
    for (const Token& token : tokens) {
        if (token.kind == Token::Kind::word || token.kind == Token::Kind::string) {
            checkWord(*found, keyword, token.text, problems_);
        } else {
            problem(key, "'" + std::string(key) + "': '" + token.text + "' is not a word");
        }
        result.push_back(token.text);
    }
    if (count && *count != static_cast<double>(result.size())) {
        problem(key, "'" + std::string(key) + "' has " + std::to_string(result.size()) + " words, not " +
                         found->tokens[0].text);
    }
    return result;
}

std::vector<double> KeywordReader::numbers(std::string_view key) const
{
    const auto lists = rows(key);
    if (lists.size() > 1) {
        problem(key, "'" + std::string(key) + "' is a list of lists, not one list", "write (a b c)");
        return {};
    }
    return lists.empty() ? std::vector<double>() : lists[0];
}

std::vector<std::vector<double>> KeywordReader::rows(std::string_view key) const
{
    const Keyword& keyword = keywordOf(table_, key);
    const Entry* found = entry(key);
    if (!found) {
        const std::string_view value = keyword.defaultValue;
        if (!value.starts_with('(')) {
            return {};
        }
        std::vector<double> row;
        for (const std::string& item : split(value.substr(1, value.size() - 2))) {
            row.push_back(parseBound(item));
        }
        return {row};
    }
    std::vector<std::vector<double>> result;
    ListReader list(valueTokens(*found, keyword, problems_));
    if (found->dictionary || !list.readRows(result)) {
        problems_.add(found->where,
                      "'" + std::string(key) + "' is '" + spell(*found) + "', not a list of numbers",
                      "write (a b c) or ((a b) (c d))");
        result.clear();
    }
    return result;
}

std::array<double, 3> KeywordReader::vector(std::string_view key) const
{
    const std::vector<double> values = numbers(key);
    if (values.size() == 3) {
        return {values[0], values[1], values[2]};
    }
    if (!values.empty()) {
        problem(key,
                "'" + std::string(key) + "' has " + std::to_string(values.size()) + " components, not three");
    }
    return {};
}

const Dictionary* KeywordReader::dictionary(std::string_view key) const
{
    const Entry* found = entry(key);
    if (found && !found->dictionary) {
        problems_.add(found->where, "'" + std::string(key) + "' is not a sub-dictionary",
                      "write " + std::string(key) + " { ... }");
        return nullptr;
    }
    return found ? found->dictionary.get() : nullptr;
}

std::vector<Dictionary> KeywordReader::dictionaries(std::string_view key) const
{
    const Entry* found = entry(key);
    return found ? dictionariesIn(*found, problems_) : std::vector<Dictionary>{};
}

std::string keywordTableMarkdown(std::string_view title, std::span<const Keyword> table)
{
    std::string text = "### " + std::string(title) +
                       "\n\n| key | unit or kind | default | range | meaning |\n"
                       "|---|---|---|---|---|\n";
    for (const Keyword& keyword : table) {
        text += "| `" + std::string(keyword.name) + "` | " + std::string(keyword.unit) + " | ";
        text += keyword.defaultValue == required      ? "required"
                : keyword.defaultValue == optionalKey ? "none"
                                                      : "`" + std::string(keyword.defaultValue) + "`";
        std::string range(keyword.range);
        text += " | " + range + " | " + std::string(keyword.meaning) + " |\n";
    }
    return text;
}

} // namespace caisson
