// The directives of DictionaryParser: #include and its like, #if, #inputMode, #remove, #eval.

#include "dictionary/DictionaryParser.h"
#include "dictionary/Expression.h"
#include "dictionary/Pattern.h"
#include "dictionary/TextFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace caisson {

namespace {

constexpr int deepestInclude = 40;

/// OpenFOAM's etc/ directories, the user's choice first.
std::vector<std::filesystem::path> etcDirectories()
{
    std::vector<std::filesystem::path> directories;
    if (const char* project = std::getenv("WM_PROJECT_DIR")) {
        directories.emplace_back(std::filesystem::path(project) / "etc");
    }
    directories.emplace_back("/usr/share/openfoam/etc");
    return directories;
}

/// Parts of `a, b=c(d,e)`, split at the commas outside parentheses.
std::vector<std::string> splitArguments(std::string_view text)
{
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ',' && depth == 0) {
            parts.emplace_back();
        } else if (c != ' ') {
            parts.back() += c;
        }
    }
    return parts;
}

/// Whether there is a division, and a number without '.' or exponent.
bool dividesWholeNumbers(std::string_view expression)
{
    constexpr std::string_view digits = "0123456789";
    constexpr std::string_view ofNames = "0123456789._abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    if (expression.find_first_of("/%") == std::string_view::npos) {
        return false;
    }
    for (std::size_t at = 0; (at = expression.find_first_of(ofNames, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(expression.find_first_not_of(ofNames, at), expression.size());
        if (expression.substr(at, end - at).find_first_not_of(digits) == std::string_view::npos) {
            return true;
        }
        at = end;
    }
    return false;
}

std::optional<bool> truth(const Token& token)
{
    if (token.kind == Token::Kind::number) { // of 0.5, say, versions of OpenFOAM think differently
        return token.number == std::floor(token.number) ? std::optional(token.number != 0) : std::nullopt;
    }
    for (const std::string_view yes : {"true", "yes", "on", "y", "t"}) {
        if (token.text == yes) {
            return true;
        }
    }
    for (const std::string_view no : {"false", "no", "off", "n", "f", "none"}) {
        if (token.text == no) {
            return false;
        }
    }
    return std::nullopt;
}

} // namespace

void DictionaryParser::entryDirective(Source& source, Dictionary& into, const Token& token)
{
    const SourceLocation where = source.at(token);
    const std::string& word = token.text;
    constexpr std::pair<std::string_view, InputMode> modes[] = {{"#default", InputMode::protect},
                                                                {"#merge", InputMode::merge},
                                                                {"#overwrite", InputMode::overwrite},
                                                                {"#warn", InputMode::warn},
                                                                {"#error", InputMode::error}};
    for (const auto& [name, mode] : modes) { // for one entry only
        if (word == name) {
            const Level level(depth_, deepestNesting, where, "directives are nested too deeply");
            const InputMode before = std::exchange(mode_, mode);
            Token first;
            if (!source.next(first)) {
                fail(where, "no entry follows " + word);
            }
            parseStatement(source, into, first);
            mode_ = before;
            return;
        }
    }
    if (word == "#include" || word == "#sinclude" || word == "#includeIfPresent" || word == "#includeEtc" ||
        word == "#sincludeEtc") {
        include(source, into, token);
    } else if (word == "#includeFunc") {
        includeFunction(source, into, token);
    } else if (word == "#inputMode") {
        setInputMode(source, token);
    } else if (word == "#remove") {
        remove(source, into);
    } else if (word == "#message") {
        source.lexer.restOfLine();
    } else if (word == "#if" || word == "#ifeq") {
        source.conditions.push_back(false);
        if (!condition(source, into, token)) {
            skipToElseOrEnd(source, true);
        }
    } else if (word == "#else" || word == "#endif") {
        if (source.conditions.empty()) {
            fail(where, word + " without #if");
        }
        if (word == "#endif") {
            source.conditions.pop_back();
        } else if (source.conditions.back()) {
            fail(where, "#else twice");
        } else {
            source.conditions.back() = true;
            skipToElseOrEnd(source, false);
        }
    } else if (word == "#calc" || word == "#codeStream" || word == "#eval" || word == "#word") {
        fail(where, "'" + word + "' where a keyword should stand",
             "it gives a value: keyword " + word + " ...;");
    } else {
        fail(where, "unknown directive '" + word + "'",
             suggestion(word,
                        {"#include", "#sinclude", "#includeIfPresent", "#includeEtc", "#sincludeEtc",
                         "#includeFunc", "#inputMode", "#default", "#merge", "#overwrite", "#warn", "#error",
                         "#remove", "#if", "#ifeq", "#else", "#endif", "#message"},
                        "directives"));
    }
}

void DictionaryParser::setInputMode(Source& source, const Token& directive)
{
    constexpr std::pair<std::string_view, InputMode> modes[] = {
        {"default", InputMode::merge},   {"merge", InputMode::merge}, {"overwrite", InputMode::overwrite},
        {"protect", InputMode::protect}, {"warn", InputMode::warn},   {"error", InputMode::error}};
    Token token;
    source.next(token);
    const auto* const found =
        std::ranges::find(modes, token.text, &std::pair<std::string_view, InputMode>::first);
    if (found == std::end(modes)) {
        fail(source.at(directive), "unknown input mode '" + token.text + "'",
             suggestion(token.text, {"merge", "overwrite", "protect", "warn", "error", "default"}, "modes"));
    }
    mode_ = found->second;
}

void DictionaryParser::remove(Source& source, Dictionary& into)
{
    const SourceLocation where = source.lexer.here();
    Token token;
    std::vector<Token> names;
    bool complete = source.next(token);
    if (complete && is(token, '(')) {
        while ((complete = source.next(token)) && !is(token, ')')) {
            names.push_back(token);
        }
    } else {
        names.push_back(token);
    }
    if (!complete) {
        fail(where, "#remove without an end", "write #remove name  or  #remove (name name)");
    }
    for (const Token& name : names) {
        if (name.kind != Token::Kind::string) {
            into.removeIf([&name](const Entry& entry) { return entry.keyword == name.text; });
            continue;
        }
        try {
            const Pattern pattern(name.text);
            into.removeIf([&pattern](const Entry& entry) { return pattern.matches(entry.keyword); });
        } catch (const std::invalid_argument& error) {
            fail(source.at(name),
                 "\"" + name.text.substr(0, 60) + "\" is no regular expression: " + error.what());
        }
    }
}

// ---------------------------------------------------------------------------------------------------------

std::optional<std::string> DictionaryParser::includedText(Source& source, const Dictionary& scope,
                                                          const Token& directive, std::filesystem::path& path)
{
    const SourceLocation where = source.at(directive);
    Token name;
    if (!source.next(name) || (name.kind != Token::Kind::string && name.kind != Token::Kind::word)) {
        fail(where, directive.text + " without a file name", "write " + directive.text + " \"file\"");
    }
    if (!includesAllowed_) {
        fail(where, directive.text + " is not allowed here", "this text comes from no file");
    }
    std::optional<std::string> text;
    if (directive.text.ends_with("Etc")) {
        const std::filesystem::path relative = expandText(where, name.text, scope);
        path = relative;
        for (const auto& etc : etcDirectories()) {
            text = readTextFile(etc / relative);
            if (text) {
                path = etc / relative;
                break;
            }
        }
    } else {
        path = expandPath(where, source.directory, name.text, scope);
        text = readTextFile(path);
    }
    if (!text && (directive.text == "#include" || directive.text == "#includeEtc")) {
        fail(where, "cannot open the included file '" + path.string() + "'");
    }
    return text;
}

void DictionaryParser::include(Source& source, Dictionary& into, const Token& directive)
{
    std::filesystem::path path;
    if (const auto text = includedText(source, into, directive, path)) {
        const Level level(includeDepth_, deepestInclude, source.at(directive),
                          "files include each other without end");
        parseFile(*text, path.string(), path.parent_path(), into);
    }
}

void DictionaryParser::includeInValue(Source& source, const Dictionary& scope, const Token& directive,
                                      std::vector<Token>& value)
{
    std::filesystem::path path;
    const auto text = includedText(source, scope, directive, path);
    if (!text) {
        return;
    }
    const Level level(includeDepth_, deepestInclude, source.at(directive),
                      "files include each other without end");
    Source included{Lexer(*text, path.string()), {}, path.parent_path(), {}};
    std::vector<Token> tokens;
    Token token;
    while (included.next(token)) {
        if (isVariable(token)) {
            std::ranges::move(expand(included.at(token), token.text, scope), std::back_inserter(tokens));
        } else if (isDirective(token)) {
            valueDirective(included, scope, token, tokens);
        } else {
            tokens.push_back(std::move(token));
        }
    }
    if (!isWholeValue(tokens)) {
        fail({path.string(), 1}, "is included in a value, but is none",
             "a ';' or a bracket without its other half is in it");
    }
    std::ranges::move(tokens, std::back_inserter(value));
}

/// The file in system/ of a function object of that name, or else in OpenFOAM's caseDicts.
std::filesystem::path DictionaryParser::functionFile(const std::string& function) const
{
    std::filesystem::path own = origin_->caseDirectory / "system" / function;
    if (readTextFile(own)) {
        return own;
    }
    for (const auto& etc : etcDirectories()) {
        const std::filesystem::path root = etc / "caseDicts/postProcessing";
        if (!std::filesystem::is_directory(root)) {
            continue;
        }
        for (const auto& file : std::filesystem::recursive_directory_iterator(root)) {
            if (file.is_regular_file() && file.path().filename() == function) {
                return file.path();
            }
        }
    }
    return own;
}

/// `#includeFunc name(field, key=value)`: the function object of that name from system/ or from OpenFOAM's
/// caseDicts, with its fields and keys set.
void DictionaryParser::includeFunction(Source& source, Dictionary& into, const Token& directive)
{
    const SourceLocation where = source.at(directive);
    Token name;
    if (!source.next(name)) {
        fail(where, "#includeFunc without a name");
    }
    if (!includesAllowed_) {
        fail(where, "#includeFunc is not allowed here", "this text comes from no file");
    }
    const std::string function = name.text.substr(0, name.text.find('('));
    const std::filesystem::path found = functionFile(function);
    const std::optional<std::string> text = readTextFile(found);
    if (!text) {
        fail(where, "no function object '" + function + "' in system/ or OpenFOAM's caseDicts");
    }
    Entry entry;
    entry.keyword = name.text;
    entry.where = where;
    entry.dictionary = makeDictionary(into, entry);
    {
        const Level level(includeDepth_, deepestInclude, where, "files include each other without end");
        parseFile(*text, found.string(), found.parent_path(), *entry.dictionary);
    }
    if (const Dictionary* inner = entry.dictionary->findDictionary(function)) {
        entry.dictionary = copy(*inner, into, where);
    }

    const InputMode mode = std::exchange(mode_, InputMode::overwrite);
    const auto set = [&](const std::string& keyword, const std::string& value) {
        Source tokens{Lexer(value, where.file, where.line), {}, {}, {}};
        Entry argument;
        argument.keyword = keyword;
        argument.where = where;
        parseValue(tokens, *entry.dictionary, std::move(argument));
    };
    std::string fields;
    std::size_t count = 0;
    if (function.size() < name.text.size()) {
        const std::size_t length = name.text.size() - function.size() - 2;
        for (const std::string& argument : splitArguments(name.text.substr(function.size() + 1, length))) {
            if (const std::size_t equals = argument.find('='); equals != std::string::npos) {
                set(argument.substr(0, equals), argument.substr(equals + 1) + ";");
            } else if (!argument.empty()) {
                fields += " " + argument;
                ++count;
            }
        }
    }
    if (count == 1) {
        set("field", fields + ";");
    }
    if (count > 0) {
        set("fields", std::to_string(count) + "(" + fields + ");");
    }
    mode_ = mode;
    add(into, std::move(entry), mode_);
}

// ---------------------------------------------------------------------------------------------------------

/// The rest of the line after #if or #ifeq.
bool DictionaryParser::condition(Source& source, const Dictionary& scope, const Token& directive)
{
    const SourceLocation where = source.at(directive);
    const bool equality = directive.text == "#ifeq";
    Source line{Lexer(source.lexer.restOfLine(), where.file, where.line), {}, source.directory, {}};
    std::vector<Token> values;
    Token token;
    while (line.next(token)) {
        if (is(token, ';')) {
            continue;
        }
        if (isDirective(token)) {
            valueDirective(line, scope, token, values);
        } else if (isVariable(token) && equality &&
                   !lookup(where, token.text.substr(1), scope, Match::patterns).entry) {
            Token text; // an environment variable; one that is not set is an empty string
            text.kind = Token::Kind::string;
            const std::string name = token.text.substr(1);
            text.text =
                name.starts_with('{') ? expandText(where, token.text, scope) : environment(name).value_or("");
            values.push_back(std::move(text));
        } else if (isVariable(token)) {
            std::ranges::move(expand(where, token.text, scope), std::back_inserter(values));
        } else {
            if (token.kind == Token::Kind::string) {
                token.text = expandText(where, token.text, scope);
            }
            values.push_back(std::move(token));
        }
    }
    const std::size_t wanted = equality ? 2 : 1;
    if (values.size() != wanted) {
        fail(where, directive.text + " needs " + (equality ? "two values" : "one value"),
             "got " + std::to_string(values.size()));
    }
    if (equality) {
        const bool numbers[] = {values[0].kind == Token::Kind::number, values[1].kind == Token::Kind::number};
        if (numbers[0] && numbers[1]) {
            return values[0].number == values[1].number;
        }
        return numbers[0] == numbers[1] && values[0].text == values[1].text;
    }
    const std::optional<bool> result = truth(values[0]);
    if (!result) {
        fail(where, "'" + values[0].text + "' is neither true nor false", "valid: true false yes no on off");
    }
    return *result;
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
                source.conditions.pop_back();
                return;
            }
        } else if (token.text == "#else" && nested == 0) {
            if (!elseCounts) {
                fail(source.at(token), "#else twice");
            }
            source.conditions.back() = true;
            return;
        }
    }
    fail(start, "#if without #endif");
}

void DictionaryParser::valueDirective(Source& source, const Dictionary& scope, const Token& token,
                                      std::vector<Token>& value)
{
    const std::string& word = token.text;
    if (word == "#include" || word == "#sinclude" || word == "#includeIfPresent" || word == "#includeEtc" ||
        word == "#sincludeEtc") {
        includeInValue(source, scope, token, value);
    } else if (word == "#eval" || word == "#calc" || word == "#word") {
        value.push_back(evaluate(source, scope, token));
    } else if (word == "#codeStream") {
        fail(source.at(token), "#codeStream compiles C++ at run time, which caissonFoam does not do",
             "write the value, or #eval { ... } for arithmetic");
    } else {
        fail(source.at(token), "unknown directive '" + word + "' in a value",
             suggestion(word,
                        {"#eval", "#include", "#sinclude", "#includeIfPresent", "#includeEtc", "#sincludeEtc",
                         "#calc", "#word"},
                        "directives"));
    }
}

/// `#eval { 2*$x }`, `#eval "..."` or `#eval #{ ... #}`: a number. #calc alike, where C++ would give the
/// same number. #word: the expanded text as one word.
Token DictionaryParser::evaluate(Source& source, const Dictionary& scope, const Token& directive)
{
    const SourceLocation where = source.at(directive);
    const bool isCalc = directive.text == "#calc";
    std::string expression = source.waiting.empty() ? source.lexer.bracedText() : "";
    if (expression.empty()) {
        Token body;
        if (!source.next(body) || (body.kind != Token::Kind::string && body.kind != Token::Kind::verbatim)) {
            fail(where, directive.text + " has no expression",
                 "write " + directive.text + " { ... } or " + directive.text + " \"...\"");
        }
        expression = body.text;
    }
    expression = expandText(where, expression, scope);
    Token result;
    result.line = directive.line;
    if (directive.text == "#word") {
        result.text = std::move(expression);
        std::erase_if(result.text, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
        return result;
    }
    if (isCalc && dividesWholeNumbers(expression)) {
        fail(where, "#calc divides whole numbers, which C++ would cut off", "write #eval { ... } instead");
    }
    try {
        result.number = evaluateExpression(expression);
    } catch (const std::invalid_argument& error) {
        if (isCalc) {
            fail(where, "#calc compiles C++ at run time, which caissonFoam does not do",
                 "for arithmetic, write #eval { ... } (" + std::string(error.what()) + ")");
        }
        fail(where, directive.text + ": " + error.what());
    }
    result.kind = Token::Kind::number;
    char text[32];
    result.text.assign(text, std::to_chars(text, std::end(text), result.number).ptr);
    return result;
}

} // namespace caisson
