#include "dictionary/Pattern.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string_view>

namespace caisson {

namespace {

constexpr std::size_t longestPattern = 1000;
constexpr double mostRepetitions = 1e4;

/// The C library expands {n,m} by copying, and back-references take exponential time.
void refuseCostly(const std::string& text)
{
    if (text.size() > longestPattern) {
        throw std::invalid_argument("longer than 1000 characters");
    }
    double repetitions = 1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char next = i + 1 < text.size() ? text[i + 1] : ' ';
        if (text[i] == '\\' && next >= '1' && next <= '9') {
            throw std::invalid_argument("back-references are not part of extended expressions");
        }
        if (text[i] == '\\') {
            ++i;
        } else if (text[i] == '{') {
            const std::size_t close = std::min(text.find('}', i), text.size());
            const std::size_t comma = text.rfind(',', close);
            double most = 1; // {n,m}: m; {n,} and {n}: n
            for (const std::size_t from :
                 {i + 1, comma != std::string::npos && comma > i ? comma + 1 : close}) {
                double count = 0;
                std::from_chars(text.data() + from, text.data() + close, count);
                most = std::max(most, count);
            }
            repetitions *= most;
        }
    }
    if (repetitions > mostRepetitions) {
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
