#pragma once

#include "dictionary/Dictionary.h"

namespace caisson {

/// Splits the text of an OpenFOAM-format file into tokens.
///
/// Words may hold balanced parentheses (div(phi,U)); `$name` and `#directive` come as words with their first
/// character; `${...}` as one word up to the matching brace; `#{ ... #}` as verbatim text.
class Lexer
{
public:
    Lexer(std::string_view text, std::string file, int line = 1)
        : text_(text), file_(std::move(file)), line_(line)
    {
    }

    /// The next token; false at the end. @throws InputError on an open string, comment or verbatim block
    bool next(Token& token);
    /// The rest of the present line (for #if and its like); a line that ends in '\\' goes on.
    std::string_view restOfLine();
    /// The text between the next `{` and its matching `}` (for #eval); "" where no `{` follows.
    std::string bracedText();
    /// `bytes` raw bytes after the present place.
    std::string raw(std::size_t bytes);
    /// Whether the next character that is not white space is `c`; it is consumed then.
    bool takeCharacter(char c);

    [[nodiscard]] int line() const { return line_; }
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] SourceLocation here() const { return {file_, line_}; }

private:
    void skipSpaceAndComments();
    char advance();
    void readString(Token& token);
    void readVerbatim(Token& token);
    bool readNumber(Token& token);
    void readVariable(Token& token);
    void readWord(Token& token);

    std::string_view text_;
    std::string file_;
    std::size_t at_ = 0;
    int line_;
};

} // namespace caisson
