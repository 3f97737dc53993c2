#include "case/FoamScanner.h"

#include "case/FileIO.h"
#include "dictionary/InputProblems.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace caisson {

namespace {

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool endsWord(char c)
{
    return isSpace(c) || c == ';' || c == '{' || c == '}' || c == '(' || c == ')' || c == '"';
}

/// Copies raw numbers of type Stored, widening or checking as needed.
template <class Stored, class Value>
void copyRaw(std::string_view raw, std::vector<Value>& values, const FoamScanner& scanner)
{
    const std::size_t count = raw.size() / sizeof(Stored);
    const std::size_t before = values.size();
    values.resize(before + count);
    if constexpr (std::is_same_v<Stored, Value>) {
        std::memcpy(values.data() + before, raw.data(), raw.size());
    } else {
        for (std::size_t i = 0; i < count; ++i) {
            Stored stored;
            std::memcpy(&stored, raw.data() + i * sizeof(Stored), sizeof(Stored));
            if constexpr (std::is_integral_v<Value>) {
                if (stored > std::numeric_limits<Value>::max() ||
                    stored < std::numeric_limits<Value>::min()) {
                    scanner.fail("label " + std::to_string(stored) + " is too large");
                }
            }
            values[before + i] = static_cast<Value>(stored);
        }
    }
}

} // namespace

FoamScanner::FoamScanner(const std::filesystem::path& file, std::string displayName, const std::string& hint)
    : name_(std::move(displayName)), text_(readFile(file, name_, hint))
{
    readHeader();
}

void FoamScanner::readHeader()
{
    static_assert(std::endian::native == std::endian::little, "binary files are read as they are in memory");
    skipSpace();
    if (std::string_view(text_).substr(at_, 8) != "FoamFile") {
        return;
    }
    at_ += 8;
    expect('{');
    while (!accept('}')) {
        const std::string key = word();
        if (key == "class") {
            className_ = word();
        } else if (key == "format") {
            const std::string format = word();
            if (format != "ascii" && format != "binary") {
                fail("unknown format '" + format + "'", "valid: ascii binary");
            }
            binary_ = format == "binary";
        } else if (key == "arch") {
            const std::string arch = word();
            if (arch.find("MSB") != std::string::npos) {
                fail("binary file of a big-endian machine",
                     "convert it with foamFormatConvert to ascii there");
            }
            labelBytes_ = arch.find("label=64") != std::string::npos ? 8 : 4;
            scalarBytes_ = arch.find("scalar=32") != std::string::npos ? 4 : 8;
        }
        skipEntry();
    }
}

void FoamScanner::skipSpace()
{
    while (at_ < text_.size()) {
        if (isSpace(text_[at_])) {
            ++at_;
        } else if (text_.compare(at_, 2, "//") == 0) {
            skipLine();
        } else if (text_.compare(at_, 2, "/*") == 0) {
            const std::size_t end = text_.find("*/", at_ + 2);
            at_ = end == std::string::npos ? text_.size() : end + 2;
        } else {
            return;
        }
    }
}

void FoamScanner::skipLine() { at_ = std::min(text_.find('\n', at_), text_.size()); }

char FoamScanner::peek()
{
    skipSpace();
    return at_ < text_.size() ? text_[at_] : '\0';
}

bool FoamScanner::accept(char c)
{
    const bool there = peek() == c && c != '\0';
    at_ += there ? 1 : 0;
    return there;
}

void FoamScanner::expect(char c)
{
    if (!accept(c)) {
        fail(std::string("expected '") + c + "', got " + preview());
    }
}

std::string FoamScanner::word()
{
    if (accept('"')) {
        const std::size_t end = text_.find('"', at_);
        if (end == std::string::npos) {
            fail("string without closing quote");
        }
        std::string quoted = text_.substr(at_, end - at_);
        at_ = end + 1;
        return quoted;
    }
    skipSpace();
    const std::size_t start = at_;
    while (at_ < text_.size() && !endsWord(text_[at_])) {
        ++at_;
    }
    if (at_ == start) {
        fail("expected a word, got " + preview());
    }
    return text_.substr(start, at_ - start);
}

bool FoamScanner::atNumber()
{
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

int FoamScanner::label()
{
    skipSpace();
    int value = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc{}) {
        fail("expected an integer, got " + preview());
    }
    at_ += static_cast<std::size_t>(end - begin);
    return value;
}

double FoamScanner::scalar()
{
    skipSpace();
    double value = 0;
    const char* const start = text_.data() + at_;
    const char* const begin = start + (at_ < text_.size() && *start == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    // Denormal and overflowing numbers: from_chars leaves the value alone, strtod rounds to 0 or infinity.
    if (error == std::errc::result_out_of_range) {
        value = std::strtod(std::string(begin, end).c_str(), nullptr);
    } else if (error != std::errc{}) {
        fail("expected a number, got " + preview());
    }
    at_ += static_cast<std::size_t>(end - start);
    return value;
}

void FoamScanner::skipEntry()
{
    for (int depth = 0;;) {
        const char c = peek();
        if (c == '\0') {
            fail("entry is not closed");
        }
        if (c == '"') {
            word();
            continue;
        }
        ++at_;
        depth += (c == '{' || c == '(') ? 1 : 0;
        depth -= (c == '}' || c == ')') ? 1 : 0;
        if (depth < 0) {
            fail(std::string("unexpected '") + c + "'");
        }
        if (depth == 0 && (c == ';' || c == '}')) {
            return;
        }
    }
}

template <class Read, class Raw>
void FoamScanner::list(Read readItem, Raw readRaw)
{
    const char first = peek();
    if (first != '(' && !atNumber()) {
        word(); // List<scalar>
    }
    const bool counted = peek() != '(';
    const int count = counted ? label() : 0;
    if (count < 0) {
        fail("list of negative length " + std::to_string(count));
    }
    if (binary_) {
        if (!counted) {
            fail("binary list without a length");
        }
        // An empty binary list is "0" alone, or "0()".
        if (count == 0) {
            if (accept('(')) {
                expect(')');
            }
            return;
        }
        expect('(');
        readRaw(static_cast<std::size_t>(count));
        if (at_ >= text_.size() || text_[at_] != ')') {
            fail("binary list of " + std::to_string(count) + " items does not end where it should");
        }
        ++at_;
        return;
    }
    if (counted && accept('{')) {
        const std::size_t item = at_;
        for (int i = 0; i < count; ++i) {
            at_ = item;
            readItem();
        }
        if (count == 0 && peek() != '}') {
            fail("list of length 0 with an item");
        }
        expect('}');
        return;
    }
    expect('(');
    int got = 0;
    for (; !accept(')'); ++got) {
        if (peek() == '\0') {
            fail("list ends after " + std::to_string(got) + " items" +
                 (counted ? " of " + std::to_string(count) : ""));
        }
        readItem();
    }
    if (counted && got != count) {
        fail("list of " + std::to_string(got) + " items is announced as " + std::to_string(count));
    }
}

std::vector<int> FoamScanner::labelList()
{
    std::vector<int> values;
    list([&] { values.push_back(label()); }, [&](std::size_t count) { rawLabels(count, values); });
    return values;
}

std::vector<double> FoamScanner::scalarList(int components)
{
    std::vector<double> values;
    const auto item = [&] {
        if (components == 1) {
            values.push_back(scalar());
            return;
        }
        expect('(');
        for (int i = 0; i < components; ++i) {
            values.push_back(scalar());
        }
        expect(')');
    };
    list(item, [&](std::size_t count) { rawScalars(count * static_cast<std::size_t>(components), values); });
    return values;
}

std::string_view FoamScanner::bytes(std::size_t count)
{
    if (text_.size() - at_ < count) {
        fail("binary data end too early: " + std::to_string(count) + " bytes expected, " +
             std::to_string(text_.size() - at_) + " left");
    }
    const std::string_view raw = std::string_view(text_).substr(at_, count);
    at_ += count;
    return raw;
}

void FoamScanner::rawLabels(std::size_t count, std::vector<int>& values)
{
    if (labelBytes_ == 4) {
        copyRaw<std::int32_t>(bytes(4 * count), values, *this);
    } else {
        copyRaw<std::int64_t>(bytes(8 * count), values, *this);
    }
}

void FoamScanner::rawScalars(std::size_t count, std::vector<double>& values)
{
    if (scalarBytes_ == 8) {
        copyRaw<double>(bytes(8 * count), values, *this);
    } else {
        copyRaw<float>(bytes(4 * count), values, *this);
    }
}

std::string FoamScanner::preview() const
{
    if (at_ >= text_.size()) {
        return "the end of the file";
    }
    const std::size_t end = std::min({text_.find_first_of(" \t\r\n", at_), at_ + 20, text_.size()});
    std::string shown = text_.substr(at_, std::max(end, at_ + 1) - at_);
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
    return "'" + shown + "'";
}

void FoamScanner::fail(const std::string& message, const std::string& hint) const
{
    // Lines of a binary file mean nothing to a reader.
    const auto upTo = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    const int line = binary_ ? 0 : 1 + static_cast<int>(std::count(text_.begin(), upTo, '\n'));
    throw InputError(name_, {{{name_, line}, message, hint}});
}

} // namespace caisson
