#include "dictionary/DictionaryParser.h"

#include "dictionary/Expression.h"
#include "dictionary/TextFile.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <regex.h>
#include <utility>

namespace caisson {

namespace {

constexpr int deepestNesting = 200;
constexpr int deepestInclude = 40;
constexpr std::size_t mostExpandedTokens = 20'000'000;

bool is(const Token& token, std::string_view punctuation)
{
    return token.kind == Token::Kind::punctuation && token.text == punctuation;
}

bool isVariable(const Token& token) { return token.kind == Token::Kind::word && token.text.starts_with('$'); }
bool isDirective(const Token& token)
{
    return token.kind == Token::Kind::word && token.text.size() > 1 && token.text[0] == '#';
}

bool isTrue(const std::string& text)
{
    return text == "true" || text == "yes" || text == "on" || text == "y" || text == "t";
}

/// Bytes of one item of a binary List<type>, 0 where it is no such list.
std::size_t binaryItemSize(const std::string& listType)
{
    constexpr std::pair<std::string_view, std::size_t> sizes[] = {
        {"List<scalar>", 8},  {"List<vector>", 24}, {"List<symmTensor>", 48},
        {"List<tensor>", 72}, {"List<label>", 4},   {"List<sphericalTensor>", 8}};
    for (const auto& [name, size] : sizes) {
        if (listType == name) {
            return size;
        }
    }
    return 0;
}

} // namespace

void DictionaryParser::fail(const SourceLocation& where, std::string message, std::string hint)
{
    throw InputError(where.file, {{where, std::move(message), std::move(hint)}});
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
    : caseDirectory_(std::move(caseDirectory)), includesAllowed_(includesAllowed),
      macros_(std::make_shared<std::set<std::string, std::less<>>>())
{
}

Dictionary DictionaryParser::parse(std::string_view text, const std::string& file,
                                   const std::filesystem::path& directory)
{
    Dictionary result;
    result.name_ = file;
    result.where_ = {file, 0};
    result.macros_ = macros_;
    parseFile(text, file, directory, result);
    return result;
}

void DictionaryParser::parseFile(std::string_view text, const std::string& file,
                                 const std::filesystem::path& directory, Dictionary& into)
{
    Source source{Lexer(text, file), {}, directory, 0};
    parseEntries(source, into, false);
    if (source.conditions > 0) {
        fail(source.lexer.here(), "#if without #endif");
    }
}

void DictionaryParser::parseEntries(Source& source, Dictionary& into, bool braced)
{
    if (++depth_ > deepestNesting) {
        fail(source.lexer.here(), "dictionaries are nested too deeply");
    }
    const SourceLocation start = source.lexer.here();
    Token token;
    bool closed = false;
    while (source.next(token)) {
        if (is(token, ";")) {
            continue; // a stray one
        }
        if (is(token, "}")) {
            if (braced) {
                closed = true;
                break;
            }
            continue; // tolerated, as OpenFOAM does
        }
        if (isDirective(token) && entryDirective(source, into, token)) {
            continue;
        }
        if (isVariable(token)) {
            mergeVariable(source, into, token);
            continue;
        }
        parseEntry(source, into, std::move(token));
    }
    if (braced && !closed) {
        fail(start, "'{' without '}'", "the dictionary that opens here is not closed");
    }
    --depth_;
}

void DictionaryParser::parseEntry(Source& source, Dictionary& into, Token keyword)
{
    if (keyword.kind == Token::Kind::verbatim || keyword.kind == Token::Kind::punctuation) {
        fail({source.lexer.file(), keyword.line},
             "'" + keyword.text.substr(0, 40) + "' where a keyword should stand",
             "an entry is   keyword value;   or   keyword { ... }");
    }
    Entry entry;
    entry.keyword = keyword.text;
    entry.isPattern = keyword.kind == Token::Kind::string;
    entry.where = {source.lexer.file(), keyword.line};
    Token next;
    if (!source.next(next)) {
        fail(entry.where, "'" + entry.keyword + "' has no value", "the file ends here: is a ';' missing?");
    }
    if (is(next, "{")) {
        entry.dictionary = std::make_shared<Dictionary>();
        entry.dictionary->name_ = into.name_ + "." + entry.keyword;
        entry.dictionary->where_ = entry.where;
        entry.dictionary->macros_ = macros_;
        entry.dictionary->parent_ = &into;
        const InputMode mode = std::exchange(mode_, mode_);
        parseEntries(source, *entry.dictionary, true);
        mode_ = mode;
        if (entry.keyword == "FoamFile") {
            const Entry* format = entry.dictionary->find("format");
            binary_ = format && !format->tokens.empty() && format->tokens[0].text == "binary";
            if (includeDepth_ > 0) {
                return; // the header of an included file is not the including one's
            }
        }
        add(into, std::move(entry));
        return;
    }
    if (isVariable(next)) { // `key $dictionary;` is a copy of it
        bool isDictionary = false;
        const Dictionary* dictionary = nullptr;
        lookup(next.text.substr(1), into, isDictionary, dictionary);
        Token after;
        const bool more = source.next(after);
        if (isDictionary && (!more || is(after, ";") || is(after, "}"))) {
            macros_->insert(next.text.substr(1));
            entry.dictionary = copy(*dictionary, &into);
            entry.dictionary->name_ = into.name_ + "." + entry.keyword;
            entry.dictionary->where_ = entry.where;
            add(into, std::move(entry));
            if (more && is(after, "}")) {
                source.waiting.push_front(after);
            }
            return;
        }
        if (more) {
            source.waiting.push_front(std::move(after));
        }
    }
    source.waiting.push_front(std::move(next));
    parseValue(source, into, std::move(entry));
}

void DictionaryParser::parseValue(Source& source, Dictionary& into, Entry entry)
{
    std::string open; // brackets to be closed
    Token token;
    bool ended = false;
    while (source.next(token)) {
        if (is(token, ";") && open.empty()) {
            ended = true;
            break;
        }
        if (is(token, "}") && open.empty()) {
            source.waiting.push_front(token); // the dictionary's own: a ';' is missing, tolerated by OpenFOAM
            ended = true;
            break;
        }
        if (token.kind == Token::Kind::punctuation) {
            const char c = token.text[0];
            if (c == '(' || c == '{' || c == '[') {
                if (open.size() > deepestNesting) {
                    fail({source.lexer.file(), token.line}, "lists are nested too deeply");
                }
                if (c == '(' && binary_ && entry.tokens.size() >= 2 && open.empty()) {
                    const Token& count = entry.tokens.back();
                    const std::size_t size = binaryItemSize(entry.tokens[entry.tokens.size() - 2].text);
                    if (size > 0 && count.isInteger && count.number >= 0 && count.number < 1e12) {
                        Token raw;
                        raw.kind = Token::Kind::binary;
                        raw.line = token.line;
                        raw.text = source.lexer.raw(size * static_cast<std::size_t>(count.number));
                        entry.tokens.push_back(token);
                        entry.tokens.push_back(std::move(raw));
                        open += c;
                        continue;
                    }
                }
                open += c;
            } else if (c == ')' || c == '}' || c == ']') {
                const char expected = c == ')' ? '(' : c == '}' ? '{' : '[';
                if (open.empty() || open.back() != expected) {
                    fail({source.lexer.file(), token.line},
                         "'" + token.text + "' closes nothing in the value of '" + entry.keyword + "'",
                         "the entry begins on line " + std::to_string(entry.where.line));
                }
                open.pop_back();
            }
        }
        if (isVariable(token)) {
            const bool braces = !open.empty() && open.back() == '{';
            std::vector<Token> value = expand({source.lexer.file(), token.line}, token.text, into);
            if (braces) { // `{ $dictionary; }` inside a list: its entries; the ';' after it is superfluous
                Token after;
                if (!value.empty() && is(value.back(), "}") && source.next(after)) {
                    if (!is(after, ";")) {
                        source.waiting.push_front(after);
                    }
                }
            }
            entry.tokens.insert(entry.tokens.end(), value.begin(), value.end());
        } else if (isDirective(token)) {
            valueDirective(source, into, token, entry.tokens);
        } else {
            entry.tokens.push_back(std::move(token));
        }
    }
    if (!ended) {
        fail(entry.where, "'" + entry.keyword + "' has no end",
             open.empty() ? "is a ';' missing?" : "a '" + std::string(1, open.back()) + "' is not closed");
    }
    add(into, std::move(entry));
}

// ---------------------------------------------------------------------------------------------------------

bool DictionaryParser::entryDirective(Source& source, Dictionary& into, const Token& token)
{
    const SourceLocation where{source.lexer.file(), token.line};
    const std::string& word = token.text;
    if (word == "#include" || word == "#sinclude" || word == "#includeIfPresent") {
        include(source, into, word == "#include", false);
    } else if (word == "#includeEtc" || word == "#sincludeEtc") {
        include(source, into, word == "#includeEtc", true);
    } else if (word == "#includeFunc") {
        includeFunction(source, into);
    } else if (word == "#inputMode") {
        Token mode;
        source.next(mode);
        if (mode.text == "merge" || mode.text == "default") {
            mode_ = InputMode::merge;
        } else if (mode.text == "overwrite") {
            mode_ = InputMode::overwrite;
        } else if (mode.text == "protect") {
            mode_ = InputMode::protect;
        } else if (mode.text == "warn") {
            mode_ = InputMode::warn;
        } else if (mode.text == "error") {
            mode_ = InputMode::error;
        } else {
            fail(where, "unknown input mode '" + mode.text + "'",
                 suggestion(mode.text, {"merge", "overwrite", "protect", "warn", "error", "default"},
                            "modes"));
        }
    } else if (word == "#default" || word == "#merge" || word == "#overwrite" || word == "#warn" ||
               word == "#error") {
        const InputMode mode = mode_;
        mode_ = word == "#default"     ? InputMode::protect
                : word == "#merge"     ? InputMode::merge
                : word == "#overwrite" ? InputMode::overwrite
                : word == "#warn"      ? InputMode::warn
                                       : InputMode::error;
        Token keyword;
        if (source.next(keyword)) {
            parseEntry(source, into, std::move(keyword));
        }
        mode_ = mode;
    } else if (word == "#remove") {
        remove(source, into);
    } else if (word == "#message") {
        source.lexer.restOfLine();
    } else if (word == "#if" || word == "#ifeq") {
        ++source.conditions;
        if (!condition(source, into, source.lexer.restOfLine(), word == "#ifeq")) {
            skipToElseOrEnd(source, true);
        }
    } else if (word == "#else" || word == "#endif") {
        if (source.conditions == 0) {
            fail(where, word + " without #if");
        }
        if (word == "#else") {
            skipToElseOrEnd(source, false);
        } else {
            --source.conditions;
        }
    } else if (word == "#calc" || word == "#codeStream" || word == "#eval" || word == "#word") {
        fail(where, "'" + word + "' where a keyword should stand",
             "it gives a value: keyword " + word + " ...;");
    } else {
        fail(where, "unknown directive '" + word + "'",
             suggestion(word,
                        {"#include", "#sinclude", "#includeIfPresent", "#includeEtc", "#sincludeEtc",
                         "#includeFunc", "#inputMode", "#default", "#merge", "#overwrite", "#warn", "#error",
                         "#remove", "#if", "#ifeq", "#else", "#endif", "#eval", "#message"},
                        "directives"));
    }
    return true;
}

void DictionaryParser::valueDirective(Source& source, const Dictionary& scope, const Token& token,
                                      std::vector<Token>& value)
{
    const SourceLocation where{source.lexer.file(), token.line};
    if (token.text == "#include" || token.text == "#includeIfPresent" || token.text == "#sinclude") {
        Token name;
        source.next(name);
        if (!includesAllowed_) {
            fail(where, "#include is not allowed here");
        }
        const std::filesystem::path path = expandPath(source, name.text, scope);
        const std::optional<std::string> text = readTextFile(path);
        if (!text) {
            if (token.text == "#include") {
                fail(where, "cannot open the included file '" + path.string() + "'");
            }
            return;
        }
        if (++includeDepth_ > deepestInclude) {
            fail(where, "files include each other without end");
        }
        Lexer lexer(*text, path.string());
        Token inner;
        while (lexer.next(inner)) {
            if (isVariable(inner)) {
                const auto expansion = expand(where, inner.text, scope);
                value.insert(value.end(), expansion.begin(), expansion.end());
            } else {
                value.push_back(std::move(inner));
            }
        }
        --includeDepth_;
        return;
    }
    if (token.text == "#eval" || token.text.starts_with("#eval{") || token.text == "#calc" ||
        token.text == "#word") {
        std::string expression;
        Token body;
        if (source.waiting.empty()) {
            expression = source.lexer.bracedText();
        }
        if (expression.empty()) {
            if (!source.next(body) ||
                (body.kind != Token::Kind::string && body.kind != Token::Kind::verbatim)) {
                fail(where, token.text + " has no expression",
                     "write " + token.text + " { ... } or " + token.text + " \"...\"");
            }
            expression = body.text;
        }
        const std::string expanded = expandText(where, expression, scope);
        Token result;
        result.line = token.line;
        if (token.text == "#word") {
            result.text = expanded;
            std::erase_if(result.text, [](char c) { return c == ' ' || c == '\n'; });
            value.push_back(std::move(result));
            return;
        }
        try {
            result.number = evaluateExpression(expanded);
        } catch (const std::invalid_argument& error) {
            if (token.text == "#calc") {
                fail(where, "#calc compiles C++ at run time, which caissonFoam does not do",
                     "for arithmetic, write #eval { ... } (" + std::string(error.what()) + ")");
            }
            fail(where, token.text + ": " + error.what());
        }
        result.kind = Token::Kind::number;
        result.isInteger = false;
        char text[40];
        std::snprintf(text, sizeof text, "%.17g", result.number);
        for (int digits = 6; digits < 17; ++digits) { // the shortest that says the same number
            char shorter[40];
            std::snprintf(shorter, sizeof shorter, "%.*g", digits, result.number);
            if (std::strtod(shorter, nullptr) == result.number) {
                std::copy(std::begin(shorter), std::end(shorter), text);
                break;
            }
        }
        result.text = text;
        value.push_back(std::move(result));
        return;
    }
    if (token.text == "#codeStream") {
        fail(where, "#codeStream compiles C++ at run time, which caissonFoam does not do",
             "write the value, or #eval { ... } for arithmetic");
    }
    fail(where, "unknown directive '" + token.text + "' in a value",
         suggestion(token.text, {"#eval", "#include", "#includeIfPresent", "#calc"}, "directives"));
}

void DictionaryParser::mergeVariable(Source& source, Dictionary& into, const Token& token)
{
    const SourceLocation where{source.lexer.file(), token.line};
    bool isDictionary = false;
    const Dictionary* dictionary = nullptr;
    const Entry* entry = lookup(token.text.substr(1), into, isDictionary, dictionary);
    macros_->insert(token.text.substr(1));
    Token after;
    const bool more = source.next(after);
    if (isDictionary && (!more || is(after, ";") || is(after, "}"))) {
        if (more && is(after, "}")) {
            source.waiting.push_front(after);
        }
        const std::shared_ptr<Dictionary> copied = copy(*dictionary, &into); // it may be a parent of this one
        mergeDictionary(into, *copied, *this);
        return;
    }
    if (more) {
        source.waiting.push_front(std::move(after));
    }
    if (!entry || isDictionary || entry->tokens.empty()) { // `$var value;`: its value is the keyword
        std::vector<Token> tokens = expand(where, token.text, into);
        if (tokens.empty()) {
            return;
        }
        for (std::size_t i = tokens.size(); i-- > 0;) {
            source.waiting.push_front(std::move(tokens[i]));
        }
        return;
    }
    for (std::size_t i = entry->tokens.size(); i-- > 0;) {
        Token inserted = entry->tokens[i];
        inserted.line = token.line;
        source.waiting.push_front(std::move(inserted));
    }
    if (++expanded_ > mostExpandedTokens) {
        fail(where, "macros expand without end");
    }
}

void DictionaryParser::include(Source& source, Dictionary& into, bool required, bool fromEtc)
{
    Token name;
    if (!source.next(name)) {
        fail(source.lexer.here(), "#include without a file name");
    }
    const SourceLocation where{source.lexer.file(), name.line};
    if (!includesAllowed_) {
        fail(where, "#include is not allowed here");
    }
    std::filesystem::path path;
    if (fromEtc) {
        const std::filesystem::path relative = expandText(where, name.text, into);
        const char* project = std::getenv("WM_PROJECT_DIR");
        const std::filesystem::path roots[] = {project ? project : "", "/usr/share/openfoam"};
        for (const auto& root : roots) {
            if (!root.empty() && path.empty() && std::filesystem::exists(root / "etc" / relative)) {
                path = root / "etc" / relative;
            }
        }
        if (path.empty()) {
            path = relative;
        }
    } else {
        path = expandPath(source, name.text, into);
    }
    const std::optional<std::string> text = readTextFile(path);
    if (!text) {
        if (required) {
            fail(where, "cannot open the included file '" + path.string() + "'");
        }
        return;
    }
    if (++includeDepth_ > deepestInclude) {
        fail(where, "files include each other without end", "'" + path.string() + "' is included again");
    }
    parseFile(*text, path.string(), path.parent_path(), into);
    --includeDepth_;
}

void DictionaryParser::includeFunction(Source& source, Dictionary& into)
{
    Token name;
    if (!source.next(name)) {
        fail(source.lexer.here(), "#includeFunc without a name");
    }
    const SourceLocation where{source.lexer.file(), name.line};
    if (!includesAllowed_) {
        fail(where, "#includeFunc is not allowed here");
    }
    const std::string word = name.text.substr(0, name.text.find('('));
    std::filesystem::path found = caseDirectory_ / "system" / word;
    if (!std::filesystem::exists(found)) {
        const char* project = std::getenv("WM_PROJECT_DIR");
        const std::filesystem::path root =
            std::filesystem::path(project ? project : "/usr/share/openfoam") / "etc/caseDicts/postProcessing";
        found.clear();
        if (std::filesystem::exists(root)) {
            for (const auto& file : std::filesystem::recursive_directory_iterator(root)) {
                if (file.is_regular_file() && file.path().filename() == word) {
                    found = file.path();
                    break;
                }
            }
        }
    }
    const std::optional<std::string> text = found.empty() ? std::nullopt : readTextFile(found);
    if (!text) {
        fail(where, "no function object '" + word + "' in system/ or OpenFOAM's caseDicts");
    }
    Entry entry;
    entry.keyword = word;
    entry.where = where;
    entry.dictionary = std::make_shared<Dictionary>();
    entry.dictionary->name_ = into.name_ + "." + word;
    entry.dictionary->where_ = where;
    entry.dictionary->macros_ = macros_;
    entry.dictionary->parent_ = &into;
    if (++includeDepth_ > deepestInclude) {
        fail(where, "files include each other without end");
    }
    parseFile(*text, found.string(), found.parent_path(), *entry.dictionary);
    --includeDepth_;
    add(into, std::move(entry));
}

void DictionaryParser::skipToElseOrEnd(Source& source, bool elseCounts)
{
    const SourceLocation start = source.lexer.here();
    int nested = 0;
    Token token;
    while (source.next(token)) {
        if (token.kind != Token::Kind::word) {
            continue;
        }
        if (token.text == "#if" || token.text == "#ifeq") {
            ++nested;
        } else if (token.text == "#endif") {
            if (nested-- == 0) {
                --source.conditions;
                return;
            }
        } else if (token.text == "#else" && nested == 0 && elseCounts) {
            return;
        }
    }
    fail(start, "#if without #endif");
}

bool DictionaryParser::condition(const Source& source, const Dictionary& scope, std::vector<Token> tokens,
                                 bool equality)
{
    const SourceLocation where = source.lexer.here();
    std::vector<Token> expanded;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (isVariable(tokens[i])) {
            const auto value = expand(where, tokens[i].text, scope);
            expanded.insert(expanded.end(), value.begin(), value.end());
        } else if (tokens[i].text == "#eval" && i + 1 < tokens.size()) {
            std::string expression;
            for (++i; i < tokens.size(); ++i) {
                if (!is(tokens[i], "{") && !is(tokens[i], "}")) {
                    expression += tokens[i].text + " ";
                }
            }
            Token result;
            result.kind = Token::Kind::number;
            try {
                result.number = evaluateExpression(expandText(where, expression, scope));
            } catch (const std::invalid_argument& error) {
                fail(where, std::string("#eval: ") + error.what());
            }
            result.text = std::to_string(result.number);
            expanded.push_back(result);
        } else {
            expanded.push_back(tokens[i]);
        }
    }
    if (equality) {
        if (expanded.size() != 2) {
            fail(where, "#ifeq needs two values", "got " + std::to_string(expanded.size()));
        }
        if (expanded[0].kind == Token::Kind::number && expanded[1].kind == Token::Kind::number) {
            return expanded[0].number == expanded[1].number;
        }
        return expanded[0].text == expanded[1].text;
    }
    if (expanded.size() != 1) {
        fail(where, "#if needs one value", "got " + std::to_string(expanded.size()));
    }
    return expanded[0].kind == Token::Kind::number ? expanded[0].number != 0 : isTrue(expanded[0].text);
}

void DictionaryParser::remove(Source& source, Dictionary& into)
{
    Token token;
    source.next(token);
    std::vector<Token> names;
    if (is(token, "(")) {
        while (source.next(token) && !is(token, ")")) {
            names.push_back(token);
        }
    } else {
        names.push_back(token);
    }
    for (const Token& name : names) {
        if (name.kind == Token::Kind::string) {
            regex_t pattern;
            if (regcomp(&pattern, ("^(" + name.text + ")$").c_str(), REG_EXTENDED | REG_NOSUB) == 0) {
                std::erase_if(into.entries_, [&pattern](const Entry& entry) {
                    return regexec(&pattern, entry.keyword.c_str(), 0, nullptr, 0) == 0;
                });
                regfree(&pattern);
            }
        } else {
            std::erase_if(into.entries_, [&name](const Entry& entry) { return entry.keyword == name.text; });
        }
    }
}

// ---------------------------------------------------------------------------------------------------------

void DictionaryParser::add(Dictionary& into, Entry entry)
{
    const auto existing = std::ranges::find_if(into.entries_, [&entry](const Entry& other) {
        return other.keyword == entry.keyword && other.isPattern == entry.isPattern;
    });
    if (existing == into.entries_.end()) {
        into.entries_.push_back(std::move(entry));
        return;
    }
    switch (mode_) {
    case InputMode::merge:
        if (existing->dictionary && entry.dictionary) {
            mergeDictionary(*existing->dictionary, *entry.dictionary, *this);
        } else {
            *existing = std::move(entry);
        }
        break;
    case InputMode::overwrite:
        *existing = std::move(entry);
        break;
    case InputMode::protect:
        break;
    case InputMode::warn:
        std::cerr << "--> CAISSONFOAM Warning : " << entry.where.file << ":" << entry.where.line << ": '"
                  << entry.keyword << "' is given twice, the first stands\n";
        break;
    case InputMode::error:
        fail(entry.where, "'" + entry.keyword + "' is given twice");
    }
}

void DictionaryParser::mergeDictionary(Dictionary& into, const Dictionary& from, DictionaryParser& parser)
{
    for (const Entry& entry : from.entries_) {
        Entry copied = entry;
        if (entry.dictionary) {
            copied.dictionary = copy(*entry.dictionary, &into);
        }
        const InputMode mode = std::exchange(parser.mode_, InputMode::merge);
        parser.add(into, std::move(copied));
        parser.mode_ = mode;
    }
}

std::shared_ptr<Dictionary> DictionaryParser::copy(const Dictionary& from, Dictionary* parent)
{
    auto result = std::make_shared<Dictionary>(from);
    result->parent_ = parent;
    for (Entry& entry : result->entries_) {
        if (entry.dictionary) {
            entry.dictionary = copy(*entry.dictionary, result.get());
        }
    }
    return result;
}

const Entry* DictionaryParser::lookup(std::string name, const Dictionary& scope, bool& isDictionary,
                                      const Dictionary*& dictionary) const
{
    isDictionary = false;
    dictionary = nullptr;
    if (name.size() > 1 && name.front() == '{' && name.back() == '}') {
        name = name.substr(1, name.size() - 2);
        if (const std::size_t fallback = name.find(":-"); fallback != std::string::npos) {
            name.resize(fallback);
        }
    }
    if (name.empty() || name.find('{') != std::string::npos) {
        return nullptr;
    }
    const Dictionary* start = &scope;
    bool outwards = true;
    const auto top = [&scope] {
        const Dictionary* highest = &scope;
        while (highest->parent_) {
            highest = highest->parent_;
        }
        return highest;
    };
    if (name.front() == ':' || name.front() == '^') {
        start = top();
        name.erase(0, 1);
        outwards = false;
    } else if (name.find('/') != std::string::npos) { // slash scoping
        if (name.front() == '/') {
            start = top();
            name.erase(0, 1);
        }
        while (name.starts_with("../")) {
            start = start->parent_ ? start->parent_ : start;
            name.erase(0, 3);
        }
        std::ranges::replace(name, '/', '.');
        outwards = false;
    } else if (name.front() == '.') { // .x here, ..x one up, and so on
        name.erase(0, 1);
        while (!name.empty() && name.front() == '.') {
            start = start->parent_ ? start->parent_ : start;
            name.erase(0, 1);
        }
        outwards = false;
        if (name.empty()) {
            isDictionary = true;
            dictionary = start;
            return nullptr;
        }
    }
    for (const Dictionary* place = start; place; place = outwards ? place->parent_ : nullptr) {
        const Entry* found = place->find(name);
        if (!found && name.find('.') != std::string::npos) {
            found = place->findScoped(name);
        }
        if (found) {
            isDictionary = found->dictionary != nullptr;
            dictionary = found->dictionary.get();
            return found;
        }
    }
    return nullptr;
}

std::vector<Token> DictionaryParser::expand(const SourceLocation& where, std::string_view variable,
                                            const Dictionary& scope)
{
    std::string name(variable.substr(1));
    std::optional<std::string> fallback;
    if (name.starts_with('{') && name.ends_with('}')) {
        name = name.substr(1, name.size() - 2);
        if (const std::size_t at = name.find(":-"); at != std::string::npos) {
            fallback = name.substr(at + 2);
            name.resize(at);
        }
        if (name.find("${") != std::string::npos || name.find('$') != std::string::npos) {
            name = expandText(where, name, scope);
        }
    }
    macros_->insert(name.substr(0, name.find_first_of("./")));
    macros_->insert(name);
    bool isDictionary = false;
    const Dictionary* dictionary = nullptr;
    const Entry* entry = lookup(name, scope, isDictionary, dictionary);
    std::vector<Token> tokens;
    const auto flatten = [&tokens](const Dictionary& from, auto&& self, bool braces) -> void {
        const auto punctuation = [&tokens, &from](const char* text) {
            Token token;
            token.kind = Token::Kind::punctuation;
            token.text = text;
            token.line = from.where().line;
            tokens.push_back(std::move(token));
        };
        if (braces) {
            punctuation("{");
        }
        for (const Entry& item : from.entries()) {
            Token keyword;
            keyword.kind = item.isPattern ? Token::Kind::string : Token::Kind::word;
            keyword.text = item.keyword;
            keyword.line = item.where.line;
            tokens.push_back(std::move(keyword));
            if (item.dictionary) {
                self(*item.dictionary, self, true);
            } else {
                tokens.insert(tokens.end(), item.tokens.begin(), item.tokens.end());
                punctuation(";");
            }
        }
        if (braces) {
            punctuation("}");
        }
    };
    if (isDictionary) {
        flatten(*dictionary, flatten, false);
    } else if (entry) {
        tokens = entry->tokens;
    } else if (const char* environment = std::getenv(name.c_str()); environment || fallback) {
        const std::string value = environment && (*environment || !fallback) ? environment : *fallback;
        Lexer lexer(value, where.file);
        Token token;
        while (lexer.next(token)) {
            if (isVariable(token)) {
                const auto inner = expand(where, token.text, scope);
                tokens.insert(tokens.end(), inner.begin(), inner.end());
            } else {
                tokens.push_back(token);
            }
        }
    } else if (name == "FOAM_CASE" && !caseDirectory_.empty()) {
        Token token;
        token.text = caseDirectory_.string();
        tokens.push_back(token);
    } else {
        std::vector<std::string> known;
        for (const Dictionary* place = &scope; place; place = place->parent_) {
            for (const Entry& other : place->entries()) {
                known.push_back(other.keyword);
            }
        }
        const std::string near = nearestWord(name, known);
        fail(where, "nothing is called '" + name + "' for the macro '$" + name + "'",
             near.empty() ? "neither an entry above nor an environment variable"
                          : "did you mean '$" + near + "'?");
    }
    for (Token& token : tokens) {
        token.line = where.line;
    }
    expanded_ += tokens.size() + 1;
    if (expanded_ > mostExpandedTokens) {
        fail(where, "macros expand without end");
    }
    return tokens;
}

std::string DictionaryParser::expandText(const SourceLocation& where, std::string_view text,
                                         const Dictionary& scope)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '$' || i + 1 >= text.size()) {
            result += text[i++];
            continue;
        }
        std::size_t end = i + 1;
        if (text[end] == '{' || text[end] == '[') {
            const char open = text[end];
            const char close = open == '{' ? '}' : ']';
            int depth = 0;
            do {
                depth += text[end] == open ? 1 : text[end] == close ? -1 : 0;
                ++end;
            } while (end < text.size() && depth > 0);
        } else {
            while (end < text.size() &&
                   (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_' ||
                    text[end] == '.' || text[end] == ':' || text[end] == '^')) {
                ++end;
            }
        }
        std::string variable(text.substr(i, end - i));
        if (variable.size() > 2 && variable[1] == '[') { // $[name]: the same
            variable = "${" + variable.substr(2, variable.size() - 3) + "}";
        }
        if (variable.size() < 2 || ++depth_ > deepestNesting) {
            fail(where, "'" + std::string(text.substr(0, 60)) + "' cannot be expanded");
        }
        std::string value;
        for (const Token& token : expand(where, variable, scope)) {
            value += (value.empty() ? "" : " ") + token.text;
        }
        --depth_;
        result += value;
        i = end;
    }
    return result;
}

std::filesystem::path DictionaryParser::expandPath(const Source& source, std::string name,
                                                   const Dictionary& scope)
{
    const auto replace = [&name](std::string_view tag, const std::filesystem::path& by) {
        if (name.starts_with(tag)) {
            name = (by / name.substr(std::min(name.size(), tag.size() + 1))).string();
        }
    };
    const char* project = std::getenv("WM_PROJECT_DIR");
    const std::filesystem::path etc =
        std::filesystem::path(project ? project : "/usr/share/openfoam") / "etc";
    replace("<case>", caseDirectory_);
    replace("<constant>", caseDirectory_ / "constant");
    replace("<system>", caseDirectory_ / "system");
    replace("<etc>", etc);
    replace("~OpenFOAM", etc);
    name = expandText(source.lexer.here(), name, scope);
    const std::filesystem::path path(name);
    return path.is_absolute() ? path : source.directory / path;
}

std::vector<Dictionary> DictionaryParser::parseList(const Entry& entry, InputProblems& problems)
{
    std::vector<Dictionary> result;
    std::size_t i = 0;
    const std::vector<Token>& tokens = entry.tokens;
    if (i < tokens.size() && tokens[i].kind == Token::Kind::number) {
        ++i;
    }
    const auto complain = [&](const std::string& what) {
        problems.add(entry.where, "'" + entry.keyword + "': " + what, "write ( { ... } { ... } )");
        return std::vector<Dictionary>{};
    };
    if (entry.dictionary || i >= tokens.size() || !is(tokens[i], "(")) {
        return complain("not a list of dictionaries");
    }
    std::string name;
    for (++i; i < tokens.size() && !is(tokens[i], ")"); ++i) {
        if (tokens[i].kind == Token::Kind::word && name.empty()) {
            name = tokens[i].text;
            continue;
        }
        if (!is(tokens[i], "{")) {
            return complain("'" + tokens[i].text + "' is not a dictionary");
        }
        DictionaryParser parser({}, false);
        Source source{Lexer("", entry.where.file), {}, {}, 0};
        int depth = 0;
        const int line = tokens[i].line;
        do {
            depth += is(tokens[i], "{") ? 1 : is(tokens[i], "}") ? -1 : 0;
            source.waiting.push_back(tokens[i]);
            ++i;
        } while (i < tokens.size() && depth > 0);
        --i;
        source.waiting.pop_front();
        Dictionary dictionary;
        dictionary.name_ = name.empty() ? entry.keyword : name;
        dictionary.where_ = {entry.where.file, line};
        dictionary.macros_ = parser.macros_;
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
    return result;
}

} // namespace caisson
