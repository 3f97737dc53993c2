#pragma once

#include "dictionary/Lexer.h"

#include <deque>
#include <filesystem>

namespace caisson {

/// Builds a Dictionary from text: entries, macros, directives. One parser per file that the user names;
/// included files are read by the same parser into the dictionary that includes them.
class DictionaryParser
{
public:
    DictionaryParser(std::filesystem::path caseDirectory, bool includesAllowed);

    Dictionary parse(std::string_view text, const std::string& file, const std::filesystem::path& directory);
    /// The dictionaries of a list of tokens.
    static std::vector<Dictionary> parseList(const Entry& entry, InputProblems& problems);

private:
    enum class InputMode { merge, overwrite, protect, warn, error };

    /// Where tokens come from: a file's lexer with a place to put tokens back, or tokens alone.
    struct Source
    {
        Lexer lexer;
        std::deque<Token> waiting;
        std::filesystem::path directory;
        int conditions = 0; ///< open #if blocks
        bool next(Token& token);
    };

    void parseFile(std::string_view text, const std::string& file, const std::filesystem::path& directory,
                   Dictionary& into);
    /// Entries up to the end of the source, or to the closing brace of a sub-dictionary.
    void parseEntries(Source& source, Dictionary& into, bool braced);
    void parseEntry(Source& source, Dictionary& into, Token keyword);
    void parseValue(Source& source, Dictionary& into, Entry entry);
    /// `#directive` where an entry may stand. @returns false where it is not one of those
    bool entryDirective(Source& source, Dictionary& into, const Token& token);
    /// `#directive` inside a value.
    void valueDirective(Source& source, const Dictionary& scope, const Token& token,
                        std::vector<Token>& value);
    void mergeVariable(Source& source, Dictionary& into, const Token& token);
    void include(Source& source, Dictionary& into, bool required, bool fromEtc);
    void includeFunction(Source& source, Dictionary& into);
    void skipToElseOrEnd(Source& source, bool elseCounts);
    bool condition(const Source& source, const Dictionary& scope, std::vector<Token> tokens, bool equality);
    void remove(Source& source, Dictionary& into);

    void add(Dictionary& into, Entry entry);
    static void mergeDictionary(Dictionary& into, const Dictionary& from, DictionaryParser& parser);
    static std::shared_ptr<Dictionary> copy(const Dictionary& from, Dictionary* parent);

    /// The entry that a variable name stands for, from the scope outwards; nullptr where there is none.
    const Entry* lookup(std::string name, const Dictionary& scope, bool& isDictionary,
                        const Dictionary*& dictionary) const;
    std::vector<Token> expand(const SourceLocation& where, std::string_view variable,
                              const Dictionary& scope);
    std::string expandText(const SourceLocation& where, std::string_view text, const Dictionary& scope);
    std::filesystem::path expandPath(const Source& source, std::string name, const Dictionary& scope);
    [[noreturn]] static void fail(const SourceLocation& where, std::string message, std::string hint = {});

    std::filesystem::path caseDirectory_;
    bool includesAllowed_;
    std::shared_ptr<std::set<std::string, std::less<>>> macros_;
    InputMode mode_ = InputMode::merge;
    int depth_ = 0;
    int includeDepth_ = 0;
    std::size_t expanded_ = 0; ///< tokens that macros brought in
    bool binary_ = false;      ///< FoamFile { format binary; } was read
};

} // namespace caisson
