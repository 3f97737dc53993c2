#pragma once

#include "dictionary/InputProblems.h"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace caisson {

/// A token of an OpenFOAM-format file.
struct Token
{
    enum class Kind { word, string, number, punctuation, verbatim, binary };
    Kind kind = Kind::word;
    std::string text;       ///< as written (strings without quotes; binary: the raw bytes)
    double number = 0;      ///< value, for Kind::number
    bool isInteger = false; ///< Kind::number written without '.', 'e'
    int line = 0;
};

class Dictionary;
class Pattern;
struct DictionaryOrigin;

/// One entry: a keyword with either a stream of tokens or a sub-dictionary.
struct Entry
{
    std::string keyword;
    bool isPattern = false; ///< keyword was quoted: a POSIX extended regular expression
    SourceLocation where;
    std::vector<Token> tokens;
    std::shared_ptr<Dictionary> dictionary;   ///< set where the entry is `keyword { ... }`
    std::shared_ptr<const Pattern> pattern;   ///< the compiled keyword, where isPattern
    std::shared_ptr<DictionaryOrigin> origin; ///< of the file
};

/// A dictionary in OpenFOAM's format, macros and directives already expanded.
///
/// Lookup: exact keyword first, then patterns, the one that was given its value last before the others.
class Dictionary
{
public:
    [[nodiscard]] const Entry* find(std::string_view keyword) const; ///< nullptr where absent
    /// `a.b.c` looked up through sub-dictionaries. Keywords may hold dots: the shortest one that leads to an
    /// entry is taken first, as in OpenFOAM.
    [[nodiscard]] const Entry* findScoped(std::string_view path) const;
    [[nodiscard]] const Dictionary* findDictionary(std::string_view keyword) const;
    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    [[nodiscard]] const std::string& name() const { return name_; } ///< file, then ".sub.dictionary"
    [[nodiscard]] const SourceLocation& where() const { return where_; }
    /// Keywords that some macro of the same file referred to ($radius): they count as known keys.
    [[nodiscard]] bool usedAsMacro(std::string_view keyword) const;
    /// Path of a file that a value names, as OpenFOAM takes it: <case>, <constant>, <system>, <etc> and
    /// $environment are expanded, a relative path counts from the case directory. @throws InputError
    [[nodiscard]] std::filesystem::path filePath(const std::string& name) const;
    /// In the form in which `foamDictionary -expand` prints it.
    [[nodiscard]] std::string print() const;

private:
    friend class DictionaryParser;
    [[nodiscard]] const Entry* findExact(std::string_view keyword) const; ///< no patterns
    [[nodiscard]] const Entry* findScoped(std::string_view path, bool patterns) const;
    void append(Entry entry);
    void removeIf(const std::function<bool(const Entry&)>& condition);
    void print(std::string& text, int depth) const;

    std::vector<Entry> entries_;
    std::map<std::string, std::size_t, std::less<>> index_; ///< place of each keyword in entries_
    std::vector<std::string> patterns_;        ///< keywords, in the order in which they got their values
    std::shared_ptr<DictionaryOrigin> origin_; ///< shared by all of one file
    std::string name_;
    SourceLocation where_;
    Dictionary* parent_ = nullptr; ///< while parsing only
};

/// The dictionaries of a list: `( { ... } name { ... } )`; a name before one becomes its name().
/// What is not a dictionary becomes a problem.
std::vector<Dictionary> dictionariesIn(const Entry& entry, InputProblems& problems);

/// Reads a file (or `file`.gz where `file` is missing) and expands macros and directives.
/// @param displayName  how messages call the file; the path itself where empty
/// @param caseDirectory  what <case>, <system>, $FOAM_CASE stand for
/// @throws InputError with file and line
Dictionary readDictionary(const std::filesystem::path& file, const std::filesystem::path& caseDirectory = {},
                          std::string displayName = {});

/// The same for text in memory.
Dictionary parseDictionary(std::string_view text, const std::string& displayName = "text",
                           const std::filesystem::path& caseDirectory = {});

} // namespace caisson
