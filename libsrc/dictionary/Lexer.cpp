#include "dictionary/Lexer.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace caisson {

namespace {

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isWordCharacter(char c)
{
    return !isSpace(c) && c != '"' && c != '\'' && c != '/' && c != ';' && c != '{' && c != '}' && c != '\0';
}
bool isNameCharacter(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == ':';
}

} // namespace

char Lexer::advance()
{
    const char c = text_[at_++];
    if (c == '\n') {
        ++line_;
    }
    return c;
}

void Lexer::skipSpaceAndComments()
{
    while (at_ < text_.size()) {
        const char c = text_[at_];
        if (isSpace(c)) {
            advance();
        } else if (text_.substr(at_, 2) == "//") {
            while (at_ < text_.size() && text_[at_] != '\n') {
                ++at_;
            }
        } else if (text_.substr(at_, 2) == "/*") {
            const SourceLocation start = here();
            at_ += 2;
            while (at_ < text_.size() && text_.substr(at_, 2) != "*/") {
                advance();
            }
            if (at_ >= text_.size()) {
                throw InputError(file_, {{start, "comment without an end", "close it with */"}});
            }
            at_ += 2;
        } else if (c == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') {
            advance();
            advance();
        } else {
            return;
        }
    }
}

void Lexer::readString(Token& token)
{
    token.kind = Token::Kind::string;
    const SourceLocation start = here();
    ++at_;
    while (at_ < text_.size() && text_[at_] != '"') {
        if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
            const char escaped = text_[at_ + 1];
            if (escaped == '"' || escaped == '\n') {
                ++at_;
            } else {
                token.text += text_[at_++];
            }
        } else if (text_[at_] == '\n') {
            break;
        }
        token.text += advance();
    }
    if (at_ >= text_.size() || text_[at_] == '\n') {
        throw InputError(
            file_, {{start, "string without an end", "close it with \", or end the line with a backslash"}});
    }
    ++at_;
}

void Lexer::readVerbatim(Token& token)
{
    token.kind = Token::Kind::verbatim;
    const SourceLocation start = here();
    at_ += 2;
    while (at_ < text_.size() && text_.substr(at_, 2) != "#}") {
        token.text += advance();
    }
    if (at_ >= text_.size()) {
        throw InputError(file_, {{start, "verbatim text without an end", "close it with #}"}});
    }
    at_ += 2;
}

bool Lexer::readNumber(Token& token)
{
    std::size_t end = at_;
    bool integer = true;
    while (end < text_.size()) {
        const char c = text_[end];
        const bool sign =
            (c == '+' || c == '-') && (end == at_ || text_[end - 1] == 'e' || text_[end - 1] == 'E');
        if (!isDigit(c) && c != '.' && c != 'e' && c != 'E' && !sign) {
            break;
        }
        integer = integer && (isDigit(c) || end == at_);
        ++end;
    }
    std::string_view digits = text_.substr(at_, end - at_);
    const std::string_view unsignedDigits = digits.starts_with('+') ? digits.substr(1) : digits;
    double value = 0;
    const auto parsed =
        std::from_chars(unsignedDigits.data(), unsignedDigits.data() + unsignedDigits.size(), value);
    if (parsed.ec == std::errc::invalid_argument || parsed.ptr == unsignedDigits.data()) {
        return false;
    }
    digits = text_.substr(at_, parsed.ptr - (text_.data() + at_));
    const char after = at_ + digits.size() < text_.size() ? text_[at_ + digits.size()] : ' ';
    if (std::isalnum(static_cast<unsigned char>(after)) ||
        std::string_view("_.:+-").find(after) != std::string_view::npos) {
        return false; // 2x, 1.2.3, 12-13: a word
    }
    token.kind = Token::Kind::number;
    token.text = digits;
    token.number =
        parsed.ec == std::errc::result_out_of_range ? std::strtod(token.text.c_str(), nullptr) : value;
    token.isInteger = integer && digits.find_first_of(".eE") == std::string_view::npos;
    at_ += digits.size();
    return true;
}

void Lexer::readVariable(Token& token)
{
    token.kind = Token::Kind::word;
    token.text = text_[at_++];
    if (at_ < text_.size() && text_[at_] == '{') {
        int depth = 0;
        const SourceLocation start = here();
        do {
            if (at_ >= text_.size()) {
                throw InputError(file_, {{start, "'${' without '}'", ""}});
            }
            depth += text_[at_] == '{' ? 1 : text_[at_] == '}' ? -1 : 0;
            token.text += advance();
        } while (depth > 0);
        return;
    }
    if (at_ < text_.size() && (text_[at_] == '^' || text_[at_] == ':')) {
        token.text += text_[at_++];
    }
    int depth = 0;
    while (at_ < text_.size() && (isWordCharacter(text_[at_]) || text_[at_] == '/')) {
        const char c = text_[at_];
        const char after = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
        if (c == '/' && (after == '/' || after == '*')) {
            break; // a comment
        }
        if (c == '(') {
            ++depth;
        } else if (c == ')' && --depth < 0) {
            break;
        } else if (c == ',' || c == ']' || (c == '[' && depth == 0)) {
            break;
        }
        token.text += c;
        ++at_;
    }
}

void Lexer::readWord(Token& token)
{
    token.kind = Token::Kind::word;
    int depth = 0;
    while (at_ < text_.size() && isWordCharacter(text_[at_])) {
        const char c = text_[at_];
        if (c == '(') {
            ++depth;
        } else if (c == ')' && --depth < 0) {
            break;
        } else if (c == ']' && depth == 0 && token.text.find('[') == std::string::npos) {
            break;
        }
        token.text += c;
        ++at_;
    }
}

bool Lexer::next(Token& token)
{
    skipSpaceAndComments();
    token = Token{};
    token.line = line_;
    if (at_ >= text_.size()) {
        return false;
    }
    const char c = text_[at_];
    const char after = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
    if (c == '"') {
        readString(token);
    } else if (c == '#' && after == '{') {
        readVerbatim(token);
    } else if (c == '$' && (isNameCharacter(after) || after == '{' || after == '^' || after == '/')) {
        readVariable(token);
    } else if ((isDigit(c) || ((c == '-' || c == '+' || c == '.') && (isDigit(after) || after == '.'))) &&
               readNumber(token)) {
        return true;
    } else if (std::string_view(";{}()[],:=*/").find(c) != std::string_view::npos || c == '\'' || c == '\0') {
        token.kind = Token::Kind::punctuation;
        token.text = advance();
    } else if ((c == '+' || c == '-') && (isSpace(after) || after == ';')) {
        token.kind = Token::Kind::punctuation;
        token.text = advance();
    } else {
        readWord(token);
        if (token.text.empty()) {
            token.kind = Token::Kind::punctuation;
            token.text = advance();
        }
    }
    return true;
}

std::string_view Lexer::restOfLine()
{
    const std::size_t start = at_;
    while (at_ < text_.size() && (text_[at_] != '\n' || (at_ > start && text_[at_ - 1] == '\\'))) {
        advance();
    }
    return text_.substr(start, at_ - start);
}

std::string Lexer::bracedText()
{
    if (!takeCharacter('{')) {
        return {};
    }
    std::string inner;
    int depth = 1;
    const SourceLocation start = here();
    for (;;) {
        if (at_ >= text_.size()) {
            throw InputError(file_, {{start, "'{' without '}'", ""}});
        }
        const char c = advance();
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        if (depth == 0) {
            return inner;
        }
        inner += c;
    }
}

std::string Lexer::raw(std::size_t bytes)
{
    if (bytes > text_.size() - at_) {
        throw InputError(file_, {{here(), "the file ends inside a binary list", "it was cut short"}});
    }
    std::string result(text_.substr(at_, bytes));
    at_ += bytes;
    return result;
}

bool Lexer::takeCharacter(char c)
{
    skipSpaceAndComments();
    if (at_ < text_.size() && text_[at_] == c) {
        advance();
        return true;
    }
    return false;
}

} // namespace caisson
