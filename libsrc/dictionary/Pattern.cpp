#include "dictionary/Pattern.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace caisson {

namespace {

constexpr std::size_t longestPattern = 1000;
constexpr double mostStates = 1e4;

/// Place of the ']' that closes the bracket expression which begins at `at`.
std::size_t closingBracket(std::string_view text, std::size_t at)
{
    at += text.substr(at + 1, 1) == "^" ? 2 : 1;
    at += text.substr(at, 1) == "]" ? 1 : 0; // an ordinary character there
    while (at < text.size() && text[at] != ']') {
        const std::string_view next = text.substr(at, 2);
        if (next == "[:" || next == "[." || next == "[=") {
            const char end[] = {next[1], ']'};
            at = std::min(text.find(std::string_view(end, 2), at + 2), text.size() - 2) + 2;
        } else {
            ++at;
        }
    }
    return std::min(at, text.size());
}

/// How often the `{n,m}`, `{n,}` or `{n}` from `open` to `close` repeats what stands before it.
double repetitions(std::string_view text, std::size_t open, std::size_t close)
{
    double most = 1;
    const std::size_t comma = std::min(text.find(',', open), close);
    for (const std::size_t from : {open + 1, comma + 1}) {
        double count = 0;
        if (from < close) {
            std::from_chars(text.data() + from, text.data() + close, count);
        }
        most = std::max(most, count);
    }
    return most;
}

/// States of the compiled expression: the C library expands a+ and a{n,m} by copying.
double states(std::string_view text)
{
    struct Group
    {
        double all = 0, last = 0; ///< of the group, of the last atom in it
        void atom(double size)
        {
            last = size;
            all += size;
        }
        void repeat(double times)
        {
            all += (times - 1) * last;
            last *= times;
        }
    };
    std::vector<Group> groups(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        switch (text[i]) {
        case '(':
            groups.emplace_back();
            break;
        case ')':
            if (groups.size() > 1) {
                const double size = groups.back().all + 1;
                groups.pop_back();
                groups.back().atom(size);
            }
            break;
        case '+':
            groups.back().repeat(2);
            break;
        case '{': {
            const std::size_t close = std::min(text.find('}', i), text.size());
            groups.back().repeat(repetitions(text, i, close));
            i = close;
            break;
        }
        case '*':
        case '?':
            break;
        case '[':
            i = closingBracket(text, i);
            groups.back().atom(1);
            break;
        case '\\':
            ++i;
            [[fallthrough]];
        default:
            groups.back().atom(1);
        }
    }
    double all = 0;
    for (const Group& group : groups) {
        all += group.all;
    }
    return all;
}

/// Back-references take exponential time.
void refuseCostly(std::string_view text)
{
    if (text.size() > longestPattern) {
        throw std::invalid_argument("longer than 1000 characters");
    }
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] == '\\') {
            ++i;
            if (text[i] >= '1' && text[i] <= '9') {
                throw std::invalid_argument("back-references are not part of extended expressions");
            }
        }
    }
    if (states(text) > mostStates) {
        throw std::invalid_argument("repeats too often");
    }
}

} // namespace

Pattern::Pattern(const std::string& text)
{
    constexpr std::string_view anyCase = "(?i)";
    refuseCostly(text);
    const bool ignoreCase = text.starts_with(anyCase);
    const std::string whole = "^(" + (ignoreCase ? text.substr(anyCase.size()) : text) + ")$";
    const int error =
        regcomp(&compiled_, whole.c_str(), REG_EXTENDED | REG_NOSUB | (ignoreCase ? REG_ICASE : 0));
    if (error != 0) {
        char reason[200];
        regerror(error, &compiled_, reason, sizeof reason);
        throw std::invalid_argument(reason);
    }
}

} // namespace caisson
