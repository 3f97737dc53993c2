#pragma once

#include "dictionary/Lexer.h"

#include <deque>
#include <filesystem>
#include <optional>
#include <set>

namespace caisson {

/// What all dictionaries of one file share.
struct DictionaryOrigin
{
    std::set<std::string, std::less<>> macros; ///< keywords that some $macro referred to
    std::filesystem::path caseDirectory;
};

/// Builds a Dictionary from text: entries, macros, directives. One parser per file that the user names;
/// included files are read by the same parser into the dictionary that includes them.
///
/// Whatever the text, it ends: nesting, inclusion and the size of what macros bring in are bounded.
class DictionaryParser
{
public:
    DictionaryParser(std::filesystem::path caseDirectory, bool includesAllowed);

    Dictionary parse(std::string_view text, const std::string& file, const std::filesystem::path& directory);
    /// The dictionaries of a list of tokens.
    static std::vector<Dictionary> parseList(const Entry& entry, InputProblems& problems);
    /// Dictionary::filePath
    static std::filesystem::path filePath(const std::string& name, const std::filesystem::path& caseDirectory,
                                          const SourceLocation& where);

private:
    static constexpr int deepestNesting = 200;

    enum class InputMode { merge, overwrite, protect, warn, error };

    /// Where tokens come from: a file's lexer with a place to put tokens back, or tokens alone.
    struct Source
    {
        Lexer lexer;
        std::deque<Token> waiting;
        std::filesystem::path directory;
        std::vector<bool> conditions; ///< open #if blocks: whether their #else has come
        bool next(Token& token);
        [[nodiscard]] SourceLocation at(const Token& token) const { return {lexer.file(), token.line}; }
    };

    /// What a macro's name stands for: an entry, or a dictionary without one (`$..`); else neither.
    struct Found
    {
        const Entry* entry = nullptr;
        const Dictionary* dictionary = nullptr;
    };
    enum class Match { exact, patterns };

    // Entries and values (DictionaryParser.cpp)
    void parseFile(std::string_view text, const std::string& file, const std::filesystem::path& directory,
                   Dictionary& into);
    /// Entries up to the end of the source, or to the closing brace of a sub-dictionary.
    void parseEntries(Source& source, Dictionary& into, bool braced);
    /// A directive, `$dictionary;`, or an entry.
    void parseStatement(Source& source, Dictionary& into, const Token& first);
    void parseEntry(Source& source, Dictionary& into, const Token& keyword);
    void parseValue(Source& source, Dictionary& into, Entry entry);
    bool parseBinary(Source& source, const Token& open, std::vector<Token>& value) const;
    [[nodiscard]] std::shared_ptr<Dictionary> makeDictionary(Dictionary& parent, const Entry& entry) const;
    void add(Dictionary& into, Entry entry, InputMode mode);
    void merge(Dictionary& into, const Dictionary& from, const SourceLocation& where, InputMode mode);
    std::shared_ptr<Dictionary> copy(const Dictionary& from, Dictionary& parent, const SourceLocation& where);

    // Directives (Directives.cpp)
    void entryDirective(Source& source, Dictionary& into, const Token& token);
    void valueDirective(Source& source, const Dictionary& scope, const Token& token,
                        std::vector<Token>& value);
    void include(Source& source, Dictionary& into, const Token& directive);
    void includeInValue(Source& source, const Dictionary& scope, const Token& directive,
                        std::vector<Token>& value);
    void includeFunction(Source& source, Dictionary& into, const Token& directive);
    [[nodiscard]] std::filesystem::path functionFile(const std::string& function) const;
    /// Text and path of the file that follows an #include; no text where it may be missing.
    std::optional<std::string> includedText(Source& source, const Dictionary& scope, const Token& directive,
                                            std::filesystem::path& path);
    void setInputMode(Source& source, const Token& directive);
    void remove(Source& source, Dictionary& into);
    bool condition(Source& source, const Dictionary& scope, const Token& directive);
    void skipToElseOrEnd(Source& source, bool elseCounts);
    Token evaluate(Source& source, const Dictionary& scope, const Token& directive);

    // Macros (Macros.cpp)
    void mergeVariable(Source& source, Dictionary& into, const Token& token);
    /// Whether these tokens may stand in a value: brackets in pairs, no ';' outside them.
    static bool isWholeValue(const std::vector<Token>& tokens);
    /// The entry that a variable name stands for, from the scope outwards.
    Found lookup(const SourceLocation& where, std::string name, const Dictionary& scope, Match match) const;
    std::optional<std::string> otherwise(const SourceLocation& where, std::string& name,
                                         const Dictionary& scope);
    /// Tokens of text from outside the dictionary, which has to be a whole value.
    static std::vector<Token> tokensOf(const SourceLocation& where, const std::string& name,
                                       std::string_view text);
    [[noreturn]] static void failUnknown(const SourceLocation& where, const std::string& name,
                                         const Dictionary& scope);
    std::vector<Token> expand(const SourceLocation& where, std::string_view variable,
                              const Dictionary& scope);
    /// What one `$variable` in a text stands for.
    std::string variableText(const SourceLocation& where, const std::string& variable,
                             const Dictionary& scope);
    /// `text` with its $variables replaced by what they stand for.
    std::string expandText(const SourceLocation& where, std::string_view text, const Dictionary& scope);
    void rememberMacro(std::string_view name);
    [[nodiscard]] std::optional<std::string> environment(const std::string& name) const;
    /// The path that `name` stands for, relative ones counted from `directory`.
    std::filesystem::path expandPath(const SourceLocation& where, const std::filesystem::path& directory,
                                     std::string name, const Dictionary& scope);

    /// Counts what macros bring in, against input that doubles itself.
    void spend(const SourceLocation& where, std::size_t amount);
    [[noreturn]] static void fail(const SourceLocation& where, std::string message, std::string hint = {});

    /// One level deeper, until the end of the scope.
    class Level
    {
    public:
        Level(int& depth, int deepest, const SourceLocation& where, const char* what);
        ~Level() { --depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

    private:
        int& depth_;
    };

    std::shared_ptr<DictionaryOrigin> origin_;
    bool includesAllowed_;
    InputMode mode_ = InputMode::merge;
    int depth_ = 0;        ///< of dictionaries
    int macroDepth_ = 0;   ///< of macros within macros
    int includeDepth_ = 0; ///< of files
    std::size_t spent_ = 0;
    bool binary_ = false;        ///< FoamFile { format binary; } was read
    std::size_t labelSize_ = 4;  ///< bytes, of binary lists
    std::size_t scalarSize_ = 8; ///< bytes, of binary lists
};

/// Whether a token is this mark; `c` is ; { } ( ) [ ] and the like.
inline bool is(const Token& token, char c)
{
    return token.kind == Token::Kind::punctuation && token.text[0] == c;
}
inline bool isVariable(const Token& token)
{
    return token.kind == Token::Kind::word && token.text.starts_with('$');
}
inline bool isDirective(const Token& token)
{
    return token.kind == Token::Kind::word && token.text.size() > 1 && token.text[0] == '#';
}

} // namespace caisson
