#pragma once

#include "dictionary/Dictionary.h"

#include <array>
#include <optional>
#include <span>

namespace caisson {

/// What a user may write under one key. One table of these per dictionary serves reading, checking,
/// messages and the user guide.
struct Keyword
{
    std::string_view name;
    /// "m", "Pa", "kg/m3", "m/s2", "-", "deg" ... ; or what else is expected: "word", "flag", "integer",
    /// "vector", "list", "dictionary", "Function1", "string"
    std::string_view unit;
    /// as it would stand in the dictionary; "" means required, "-" means optional without a default
    std::string_view defaultValue;
    /// "(0, 1)", "[0, inf)", "(-inf, inf)", or words: "linearElastic mohrCoulomb"; "" is unrestricted
    std::string_view range;
    std::string_view meaning; ///< one sentence for the user guide
};

/// Reads one dictionary against its table: missing and unknown keys, types, ranges and units are
/// collected as problems with file and line; a value with a problem comes back as its default or zero, so
/// that reading goes on to the next problem.
class KeywordReader
{
public:
    /// Unknown keys of `dictionary` are reported at once (keys used as macros and "FoamFile" excepted).
    /// @param what  how messages call the dictionary, e.g. "'sand'" or "controlDict"
    KeywordReader(const Dictionary& dictionary, std::span<const Keyword> table, std::string_view what,
                  InputProblems& problems);

    [[nodiscard]] bool has(std::string_view key) const; ///< written by the user
    [[nodiscard]] double number(std::string_view key) const;
    [[nodiscard]] long integer(std::string_view key) const;
    [[nodiscard]] bool flag(std::string_view key) const;        ///< yes/no, on/off, true/false
    [[nodiscard]] std::string word(std::string_view key) const; ///< word or string; checked against range
    [[nodiscard]] std::vector<std::string> words(std::string_view key) const;
    [[nodiscard]] std::array<double, 3> vector(std::string_view key) const;
    [[nodiscard]] std::vector<double> numbers(std::string_view key) const;           ///< (a b c)
    [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view key) const; ///< ((a b) (c d))
    [[nodiscard]] const Dictionary* dictionary(std::string_view key) const;          ///< nullptr where absent
    [[nodiscard]] std::vector<Dictionary> dictionaries(std::string_view key) const;  ///< ( { ... } { ... } )
    [[nodiscard]] const Entry* entry(std::string_view key) const;                    ///< nullptr where absent
    [[nodiscard]] SourceLocation where(std::string_view key) const; ///< of the key, or of the dictionary

    /// For checks that span several keys.
    void problem(std::string_view key, std::string message, std::string hint = {}) const;
    [[nodiscard]] InputProblems& problems() const { return problems_; }
    [[nodiscard]] const Dictionary& source() const { return dictionary_; }

private:
    [[nodiscard]] bool areCoefficients(const Entry& entry) const;
    const Dictionary& dictionary_;
    std::span<const Keyword> table_;
    std::string what_;
    InputProblems& problems_;
};

/// The table as Markdown: key, unit, default, range, meaning.
std::string keywordTableMarkdown(std::string_view title, std::span<const Keyword> table);

} // namespace caisson
