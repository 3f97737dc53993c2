#include "dictionary/DictionaryParser.h"

#include "dictionary/Pattern.h"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <stdexcept>
#include <utility>

namespace caisson {

namespace {

constexpr std::size_t mostSpent = 5'000'000; // tokens that macros bring in
constexpr std::size_t ofEntry = 20;          // what an entry costs, in tokens

/// The number after `name` in the header's arch "LSB;label=32;scalar=64", in bytes.
std::size_t bytesOf(const std::string& arch, std::string_view name, std::size_t missing)
{
    const std::size_t at = arch.find(name);
    std::size_t bits = 8 * missing;
    if (at != std::string::npos) {
        std::from_chars(arch.data() + at + name.size(), arch.data() + arch.size(), bits);
    }
    return bits / 8;
}

std::string textOf(const Dictionary& dictionary, std::string_view keyword)
{
    const Entry* entry = dictionary.find(keyword);
    return entry && !entry->tokens.empty() ? entry->tokens[0].text : "";
}

} // namespace

void DictionaryParser::fail(const SourceLocation& where, std::string message, std::string hint)
{
    throw InputError(where.file, {{where, std::move(message), std::move(hint)}});
}

void DictionaryParser::spend(const SourceLocation& where, std::size_t amount)
{
    spent_ += amount;
    if (spent_ > mostSpent) {
        fail(where, "macros bring in more than five million values", "do they double themselves?");
    }
}

DictionaryParser::Level::Level(int& depth, int deepest, const SourceLocation& where, const char* what)
    : depth_(depth)
{
    if (depth_ >= deepest) {
        fail(where, what, "more than " + std::to_string(deepest) + " levels");
    }
    ++depth_;
}

bool DictionaryParser::Source::next(Token& token)
{
    if (!waiting.empty()) {
        token = std::move(waiting.front());
        waiting.pop_front();
        return true;
    }
    return lexer.next(token);
}

DictionaryParser::DictionaryParser(std::filesystem::path caseDirectory, bool includesAllowed)
    : origin_(std::make_shared<DictionaryOrigin>()), includesAllowed_(includesAllowed)
{
    origin_->caseDirectory = std::move(caseDirectory);
}

Dictionary DictionaryParser::parse(std::string_view text, const std::string& file,
                                   const std::filesystem::path& directory)
{
    Dictionary result;
    result.name_ = file;
    result.where_ = {file, 0};
    result.origin_ = origin_;
    parseFile(text, file, directory, result);
    return result;
}

void DictionaryParser::parseFile(std::string_view text, const std::string& file,
                                 const std::filesystem::path& directory, Dictionary& into)
{
    Source source{Lexer(text, file), {}, directory, {}};
    parseEntries(source, into, false);
    if (!source.conditions.empty()) {
        fail(source.lexer.here(), "#if without #endif");
    }
}

void DictionaryParser::parseEntries(Source& source, Dictionary& into, bool braced)
{
    const SourceLocation start = source.lexer.here();
    const Level level(depth_, deepestNesting, start, "dictionaries are nested too deeply");
    Token token;
    while (source.next(token)) {
        if (is(token, ';')) {
            continue; // a stray one
        }
        if (is(token, '}')) {
            if (!braced) {
                fail(source.at(token), "'}' closes nothing", "is there one too many?");
            }
            return;
        }
        parseStatement(source, into, token);
    }
    if (braced) {
        fail(start, "'{' without '}'", "the dictionary that opens here is not closed");
    }
}

void DictionaryParser::parseStatement(Source& source, Dictionary& into, const Token& first)
{
    if (isDirective(first)) {
        entryDirective(source, into, first);
    } else if (isVariable(first)) {
        mergeVariable(source, into, first);
    } else {
        parseEntry(source, into, first);
    }
}

std::shared_ptr<Dictionary> DictionaryParser::makeDictionary(Dictionary& parent, const Entry& entry) const
{
    auto dictionary = std::make_shared<Dictionary>();
    dictionary->name_ = parent.name_ + "." + entry.keyword;
    dictionary->where_ = entry.where;
    dictionary->origin_ = origin_;
    dictionary->parent_ = &parent;
    return dictionary;
}

void DictionaryParser::parseEntry(Source& source, Dictionary& into, const Token& keyword)
{
    const SourceLocation where = source.at(keyword);
    if ((is(keyword, '(') || keyword.isInteger) && !into.parent_) {
        fail(where, "a list where a keyword should stand", "is this file a list, not a dictionary?");
    }
    if (keyword.kind != Token::Kind::word && keyword.kind != Token::Kind::string) {
        fail(where, "'" + keyword.text.substr(0, 40) + "' where a keyword should stand",
             "an entry is   keyword value;   or   keyword { ... }");
    }
    Entry entry;
    entry.keyword = keyword.text;
    entry.where = where;
    entry.origin = origin_;
    if (keyword.kind == Token::Kind::string) {
        entry.isPattern = true;
        try {
            entry.pattern = std::make_shared<Pattern>(keyword.text);
        } catch (const std::invalid_argument& error) {
            fail(where, "\"" + keyword.text.substr(0, 60) + "\" is no regular expression: " + error.what(),
                 "a keyword in quotes is a pattern");
        }
    }
    Token next;
    if (!source.next(next)) {
        fail(where, "'" + entry.keyword + "' has no value", "the file ends here: is a ';' missing?");
    }
    if (is(next, '{')) {
        const InputMode mode = mode_; // an #inputMode in the braces is for what comes after
        entry.dictionary = makeDictionary(into, entry);
        parseEntries(source, *entry.dictionary, true);
        if (entry.keyword == "FoamFile") {
            if (includeDepth_ > 0) {
                return; // the header of an included file is not the including one's
            }
            const std::string arch = textOf(*entry.dictionary, "arch");
            binary_ = textOf(*entry.dictionary, "format") == "binary";
            labelSize_ = bytesOf(arch, "label=", labelSize_);
            scalarSize_ = bytesOf(arch, "scalar=", scalarSize_);
            if (binary_ && arch.starts_with("MSB")) {
                fail(where, "the file's binary numbers have their most significant byte first",
                     "convert it on a machine of that kind (foamFormatConvert)");
            }
        }
        add(into, std::move(entry), mode);
        return;
    }
    if (isVariable(next)) { // `key $dictionary;` is a copy of it
        const Dictionary* dictionary = lookup(where, next.text.substr(1), into, Match::exact).dictionary;
        Token after;
        const bool more = source.next(after);
        if (more) {
            source.waiting.push_front(after);
        }
        if (dictionary && (!more || is(after, ';') || is(after, '}'))) {
            rememberMacro(next.text.substr(1));
            entry.dictionary = copy(*dictionary, into, where);
            entry.dictionary->name_ = into.name_ + "." + entry.keyword;
            entry.dictionary->where_ = where;
            add(into, std::move(entry), mode_);
            return;
        }
    }
    source.waiting.push_front(std::move(next));
    parseValue(source, into, std::move(entry));
}

void DictionaryParser::parseValue(Source& source, Dictionary& into, Entry entry)
{
    std::string open; // brackets to be closed
    Token token;
    while (source.next(token)) {
        const SourceLocation where = source.at(token);
        if (is(token, ';') && open.empty()) {
            add(into, std::move(entry), mode_);
            return;
        }
        if (is(token, '}') && open.empty()) {
            fail(entry.where, "'" + entry.keyword + "' has no end", "a ';' is missing before the '}'");
        }
        if (is(token, '(') || is(token, '{') || is(token, '[')) {
            if (open.size() >= deepestNesting) {
                fail(where, "lists are nested too deeply");
            }
            open += token.text;
            if (parseBinary(source, token, entry.tokens)) {
                continue;
            }
        } else if (is(token, ')') || is(token, '}') || is(token, ']')) {
            const char expected = is(token, ')') ? '(' : is(token, '}') ? '{' : '[';
            if (open.empty() || open.back() != expected) {
                fail(where, "'" + token.text + "' closes nothing in the value of '" + entry.keyword + "'",
                     "the entry begins on line " + std::to_string(entry.where.line));
            }
            open.pop_back();
        }
        if (isVariable(token)) {
            std::vector<Token> tokens = expand(where, token.text, into);
            if (open.empty() && !isWholeValue(tokens)) {
                fail(where, "'" + token.text + "' is a dictionary, which is no part of a value",
                     "keyword $dictionary;  is a copy of it");
            }
            std::ranges::move(tokens, std::back_inserter(entry.tokens));
        } else if (isDirective(token)) {
            valueDirective(source, into, token, entry.tokens);
        } else {
            entry.tokens.push_back(std::move(token));
        }
    }
    fail(entry.where, "'" + entry.keyword + "' has no end",
         open.empty() ? "is a ';' missing?" : "a '" + std::string(1, open.back()) + "' is not closed");
}

/// The raw bytes of `List<type> count ( ... )` in a binary file. @returns whether this is such a list
bool DictionaryParser::parseBinary(Source& source, const Token& open, std::vector<Token>& value) const
{
    if (!binary_ || !is(open, '(') || value.size() < 2 || !source.waiting.empty()) {
        return false;
    }
    const Token& count = value.back();
    const std::string& type = value[value.size() - 2].text;
    const std::pair<std::string_view, std::size_t> sizes[] = {
        {"List<label>", labelSize_},           {"List<scalar>", scalarSize_},
        {"List<vector>", 3 * scalarSize_},     {"List<sphericalTensor>", scalarSize_},
        {"List<symmTensor>", 6 * scalarSize_}, {"List<tensor>", 9 * scalarSize_}};
    const auto size = std::ranges::find(sizes, type, &std::pair<std::string_view, std::size_t>::first);
    if (size == std::end(sizes) || !count.isInteger || count.number < 0 || count.number > 1e12) {
        return false;
    }
    Token raw;
    raw.kind = Token::Kind::binary;
    raw.line = open.line;
    raw.text = source.lexer.raw(size->second * static_cast<std::size_t>(count.number));
    value.push_back(open);
    value.push_back(std::move(raw));
    return true;
}

void DictionaryParser::add(Dictionary& into, Entry entry, InputMode mode)
{
    const auto place = into.index_.find(entry.keyword);
    if (place == into.index_.end()) {
        into.append(std::move(entry));
        return;
    }
    Entry& existing = into.entries_[place->second];
    switch (mode) {
    case InputMode::merge:
        if (existing.dictionary && entry.dictionary) {
            merge(*existing.dictionary, *entry.dictionary, entry.where, InputMode::merge);
            return;
        }
        break;
    case InputMode::overwrite:
        break;
    case InputMode::protect:
        return;
    case InputMode::warn:
        std::cerr << "--> CAISSONFOAM Warning : " << entry.where.file << ":" << entry.where.line << ": '"
                  << entry.keyword << "' is given twice, the first stands\n";
        return;
    case InputMode::error:
        fail(entry.where, "'" + entry.keyword + "' is given twice",
             "first on line " + std::to_string(existing.where.line));
    }
    entry.isPattern = existing.isPattern; // the first spelling of the keyword stands, as in OpenFOAM
    entry.pattern = existing.pattern;
    if (entry.pattern && !(existing.dictionary && entry.dictionary)) {
        into.patterns_.push_back(entry.keyword);
    }
    existing = std::move(entry);
}

void DictionaryParser::merge(Dictionary& into, const Dictionary& from, const SourceLocation& where,
                             InputMode mode)
{
    for (const Entry& entry : from.entries_) {
        spend(where, ofEntry + entry.tokens.size());
        Entry copied = entry;
        if (entry.dictionary) {
            copied.dictionary = copy(*entry.dictionary, into, where);
        }
        add(into, std::move(copied), mode);
    }
}

std::shared_ptr<Dictionary> DictionaryParser::copy(const Dictionary& from, Dictionary& parent,
                                                   const SourceLocation& where)
{
    int depth = 0;
    for (const Dictionary* outer = &parent; outer; outer = outer->parent_) {
        ++depth;
    }
    if (depth > deepestNesting) {
        fail(where, "dictionaries are nested too deeply", "does a macro copy a dictionary into itself?");
    }
    auto result = std::make_shared<Dictionary>(from);
    result->parent_ = &parent;
    for (Entry& entry : result->entries_) {
        spend(where, ofEntry + entry.tokens.size());
        if (entry.dictionary) {
            entry.dictionary = copy(*entry.dictionary, *result, where);
        }
    }
    return result;
}

std::vector<Dictionary> DictionaryParser::parseList(const Entry& entry, InputProblems& problems)
{
    std::vector<Dictionary> result;
    const std::vector<Token>& tokens = entry.tokens;
    const bool counted = !tokens.empty() && tokens[0].isInteger;
    std::size_t i = counted ? 1 : 0;
    const auto complain = [&](const std::string& what) {
        problems.add(entry.where, "'" + entry.keyword + "': " + what, "write ( { ... } { ... } )");
        return std::vector<Dictionary>{};
    };
    if (entry.dictionary || i >= tokens.size() || !is(tokens[i], '(')) {
        return complain("not a list of dictionaries");
    }
    std::string name;
    for (++i; i < tokens.size() && !is(tokens[i], ')'); ++i) {
        if (tokens[i].kind == Token::Kind::word && name.empty()) {
            name = tokens[i].text;
            continue;
        }
        if (!is(tokens[i], '{')) {
            return complain("'" + tokens[i].text + "' is not a dictionary");
        }
        DictionaryParser parser({}, false);
        if (entry.origin) {
            parser.origin_ = entry.origin;
        }
        const int line = tokens[i].line;
        Source source{Lexer("", entry.where.file, line), {}, {}, {}};
        int depth = 0;
        do {
            depth += is(tokens[i], '{') ? 1 : is(tokens[i], '}') ? -1 : 0;
            source.waiting.push_back(tokens[i]);
            ++i;
        } while (i < tokens.size() && depth > 0);
        --i;
        source.waiting.pop_front();
        Dictionary dictionary;
        dictionary.name_ = name.empty() ? entry.keyword : name;
        dictionary.where_ = {entry.where.file, line};
        dictionary.origin_ = parser.origin_;
        try {
            parser.parseEntries(source, dictionary, true);
        } catch (const InputError& error) {
            for (const InputProblem& problem : error.problems()) {
                problems.add(problem.where, problem.message, problem.hint);
            }
        }
        result.push_back(std::move(dictionary));
        name.clear();
    }
    if (!name.empty() || i + 1 != tokens.size()) {
        return complain("'" + (name.empty() ? tokens[i + 1].text : name) + "' is not a dictionary");
    }
    if (counted && tokens[0].number != static_cast<double>(result.size())) {
        return complain("has " + std::to_string(result.size()) + " dictionaries, not " + tokens[0].text);
    }
    return result;
}

} // namespace caisson
