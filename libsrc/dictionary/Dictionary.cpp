#include "dictionary/Dictionary.h"

#include "dictionary/DictionaryParser.h"
#include "dictionary/Pattern.h"
#include "dictionary/TextFile.h"

#include <algorithm>
#include <ranges>

namespace caisson {

namespace {

void appendQuoted(std::string& text, std::string_view string)
{
    text += '"';
    for (const char c : string) {
        if (c == '"' || c == '\n') {
            text += '\\';
        }
        text += c;
    }
    text += '"';
}

} // namespace

const Entry* Dictionary::findExact(std::string_view keyword) const
{
    const auto found = index_.find(keyword);
    return found == index_.end() ? nullptr : &entries_[found->second];
}

const Entry* Dictionary::find(std::string_view keyword) const
{
    if (const Entry* exact = findExact(keyword); exact || patterns_.empty()) {
        return exact;
    }
    const std::string word(keyword);
    for (const std::string& pattern : patterns_ | std::views::reverse) {
        const Entry* entry = findExact(pattern); // none where it was removed
        if (entry && entry->pattern && entry->pattern->matches(word)) {
            return entry;
        }
    }
    return nullptr;
}

const Entry* Dictionary::findScoped(std::string_view path) const { return findScoped(path, true); }

const Entry* Dictionary::findScoped(std::string_view path, bool patterns) const
{
    constexpr auto mostDots = 16; // the ways to split a path double with each dot
    const bool dotted = std::ranges::count(path, '.') <= mostDots;
    for (std::size_t dot = path.find('.', 1); dotted && dot != std::string_view::npos;
         dot = path.find('.', dot + 1)) {
        const Entry* head = patterns ? find(path.substr(0, dot)) : findExact(path.substr(0, dot));
        if (head && head->dictionary) {
            if (const Entry* tail = head->dictionary->findScoped(path.substr(dot + 1), patterns)) {
                return tail;
            }
        }
    }
    return patterns ? find(path) : findExact(path);
}

void Dictionary::append(Entry entry)
{
    index_.emplace(entry.keyword, entries_.size());
    if (entry.pattern) {
        patterns_.push_back(entry.keyword);
    }
    entries_.push_back(std::move(entry));
}

void Dictionary::removeIf(const std::function<bool(const Entry&)>& condition)
{
    std::vector<Entry> kept;
    std::swap(kept, entries_);
    index_.clear();
    std::vector<std::string> order;
    std::swap(order, patterns_);
    for (Entry& entry : kept) {
        if (!condition(entry)) {
            append(std::move(entry));
        }
    }
    patterns_ = std::move(order);
}

const Dictionary* Dictionary::findDictionary(std::string_view keyword) const
{
    const Entry* entry = find(keyword);
    return entry ? entry->dictionary.get() : nullptr;
}

bool Dictionary::usedAsMacro(std::string_view keyword) const
{
    return origin_ && origin_->macros.contains(keyword);
}

std::filesystem::path Dictionary::filePath(const std::string& name) const
{
    return DictionaryParser::filePath(name, origin_ ? origin_->caseDirectory : std::filesystem::path(),
                                      where_);
}

std::string Dictionary::print() const
{
    std::string text;
    print(text, 0);
    return text;
}

void Dictionary::print(std::string& text, int depth) const
{
    const std::string indent(4 * static_cast<std::size_t>(depth), ' ');
    for (const Entry& entry : entries_) {
        text += indent;
        if (entry.isPattern) {
            appendQuoted(text, entry.keyword);
        } else {
            text += entry.keyword;
        }
        if (entry.dictionary) {
            text += "\n" + indent + "{\n";
            entry.dictionary->print(text, depth + 1);
            text += indent + "}\n";
            continue;
        }
        for (const Token& token : entry.tokens) {
            text += ' ';
            if (token.kind == Token::Kind::string) {
                appendQuoted(text, token.text);
            } else if (token.kind == Token::Kind::verbatim) {
                text += "#{" + token.text + "#}";
            } else {
                text += token.text;
            }
        }
        text += ";\n";
    }
}

Dictionary readDictionary(const std::filesystem::path& file, const std::filesystem::path& caseDirectory,
                          std::string displayName)
{
    if (displayName.empty()) {
        displayName = file.string();
    }
    const std::optional<std::string> text = readTextFile(file);
    if (!text) {
        throw InputError(displayName,
                         {{{displayName, 0}, "cannot be read", "the file is missing or not readable"}});
    }
    return DictionaryParser(caseDirectory, true).parse(*text, displayName, file.parent_path());
}

Dictionary parseDictionary(std::string_view text, const std::string& displayName,
                           const std::filesystem::path& caseDirectory)
{
    return DictionaryParser(caseDirectory, !caseDirectory.empty()).parse(text, displayName, caseDirectory);
}

std::vector<Dictionary> dictionariesIn(const Entry& entry, InputProblems& problems)
{
    return DictionaryParser::parseList(entry, problems);
}

} // namespace caisson
