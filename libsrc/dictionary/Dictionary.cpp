#include "dictionary/Dictionary.h"

#include "dictionary/DictionaryParser.h"
#include "dictionary/TextFile.h"

#include <regex.h>

namespace caisson {

namespace {

bool matches(const std::string& pattern, std::string_view keyword)
{
    regex_t compiled;
    if (regcomp(&compiled, ("^(" + pattern + ")$").c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
        return false;
    }
    const bool found = regexec(&compiled, std::string(keyword).c_str(), 0, nullptr, 0) == 0;
    regfree(&compiled);
    return found;
}

} // namespace

const Entry* Dictionary::find(std::string_view keyword) const
{
    for (const Entry& entry : entries_) {
        if (!entry.isPattern && entry.keyword == keyword) {
            return &entry;
        }
    }
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
        if (entry->isPattern && (entry->keyword == keyword || matches(entry->keyword, keyword))) {
            return &*entry;
        }
    }
    return nullptr;
}

const Entry* Dictionary::findScoped(std::string_view path) const
{
    if (const Entry* whole = find(path)) {
        return whole;
    }
    for (std::size_t dot = path.rfind('.'); dot != std::string_view::npos && dot > 0;
         dot = path.rfind('.', dot - 1)) {
        const Entry* head = find(path.substr(0, dot));
        if (head && head->dictionary) {
            if (const Entry* tail = head->dictionary->findScoped(path.substr(dot + 1))) {
                return tail;
            }
        }
    }
    return nullptr;
}

const Dictionary* Dictionary::findDictionary(std::string_view keyword) const
{
    const Entry* entry = find(keyword);
    return entry ? entry->dictionary.get() : nullptr;
}

bool Dictionary::usedAsMacro(std::string_view keyword) const { return macros_ && macros_->contains(keyword); }

std::string Dictionary::print() const
{
    std::string text;
    print(text, 0);
    return text;
}

void Dictionary::print(std::string& text, int depth) const
{
    const std::string indent(4 * depth, ' ');
    for (const Entry& entry : entries_) {
        text += indent + (entry.isPattern ? "\"" + entry.keyword + "\"" : entry.keyword);
        if (entry.dictionary) {
            text += "\n" + indent + "{\n";
            entry.dictionary->print(text, depth + 1);
            text += indent + "}\n";
            continue;
        }
        for (const Token& token : entry.tokens) {
            text += ' ';
            if (token.kind == Token::Kind::string) {
                text += '"' + token.text + '"';
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

Dictionary parseDictionary(std::string_view text, std::string displayName,
                           const std::filesystem::path& caseDirectory)
{
    return DictionaryParser(caseDirectory, !caseDirectory.empty()).parse(text, displayName, caseDirectory);
}

std::vector<Dictionary> dictionariesIn(const Entry& entry, InputProblems& problems)
{
    return DictionaryParser::parseList(entry, problems);
}

} // namespace caisson
