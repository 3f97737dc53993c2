#pragma once

#include <memory>
#include <regex.h>
#include <string>

namespace caisson {

/// A quoted keyword: a POSIX extended regular expression that has to match a whole word; after
/// "(?i)" in either case.
///
/// Bounded, because the expression may come from anybody: no more than 1000 characters, no
/// back-references, and counts {n,m} whose product is at most 10000.
class Pattern
{
public:
    /// @throws std::invalid_argument where the text is no expression or beyond these bounds
    explicit Pattern(const std::string& text);
    ~Pattern() { regfree(&compiled_); }
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    [[nodiscard]] bool matches(const std::string& word) const
    {
        return regexec(&compiled_, word.c_str(), 0, nullptr, 0) == 0;
    }

private:
    regex_t compiled_{};
};

} // namespace caisson
