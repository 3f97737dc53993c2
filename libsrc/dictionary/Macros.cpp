// The macros of DictionaryParser: $name in all its scopes, in values, in text and in file names.

#include "dictionary/DictionaryParser.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace caisson {

namespace {

constexpr int deepestMacro = 50;
constexpr std::size_t longestText = 1'000'000; // characters that text may expand to

bool isBraced(std::string_view name) { return name.size() > 1 && name.front() == '{' && name.back() == '}'; }

bool isNameCharacter(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == ':' || c == '^';
}

void appendPunctuation(std::vector<Token>& tokens, char c)
{
    Token token;
    token.kind = Token::Kind::punctuation;
    token.text = c;
    tokens.push_back(std::move(token));
}

} // namespace

bool DictionaryParser::isWholeValue(const std::vector<Token>& tokens)
{
    std::string open;
    for (const Token& token : tokens) {
        if (is(token, '(') || is(token, '{') || is(token, '[')) {
            open += token.text;
        } else if (is(token, ')') || is(token, '}') || is(token, ']')) {
            if (open.empty() || open.back() != (is(token, ')') ? '(' : is(token, '}') ? '{' : '[')) {
                return false;
            }
            open.pop_back();
        } else if (is(token, ';') && open.empty()) {
            return false;
        }
    }
    return open.empty();
}

namespace {

/// The entries of a dictionary as the tokens that they were read from.
void appendEntries(std::vector<Token>& tokens, const Dictionary& dictionary)
{
    for (const Entry& entry : dictionary.entries()) {
        Token keyword;
        keyword.kind = entry.isPattern ? Token::Kind::string : Token::Kind::word;
        keyword.text = entry.keyword;
        tokens.push_back(std::move(keyword));
        if (entry.dictionary) {
            appendPunctuation(tokens, '{');
            appendEntries(tokens, *entry.dictionary);
            appendPunctuation(tokens, '}');
        } else {
            tokens.insert(tokens.end(), entry.tokens.begin(), entry.tokens.end());
            appendPunctuation(tokens, ';');
        }
    }
}

} // namespace

/// `$dictionary;` where an entry may stand merges it here; `$word value;` and `$word { ... }` take the
/// variable's value as the keyword.
void DictionaryParser::mergeVariable(Source& source, Dictionary& into, const Token& token)
{
    const SourceLocation where = source.at(token);
    std::string name = token.text.substr(1);
    bool computed = false; // ${_${x}}: may stand for nothing, as in OpenFOAM
    if (isBraced(name) && name.find('$') != std::string::npos) {
        name = expandText(where, name.substr(1, name.size() - 2), into);
        computed = true;
    }
    rememberMacro(name);
    Token after;
    const bool more = source.next(after);
    if (more) {
        source.waiting.push_front(after);
    }
    const bool alone = !more || is(after, ';') || is(after, '}');
    const Found found = lookup(where, name, into, Match::patterns);
    if (found.dictionary && !is(after, '{')) {
        // A copy, for it may hold this very place. Modes that keep the first of two equal keys keep it here,
        // too.
        merge(into, *copy(*found.dictionary, into, where), where,
              mode_ == InputMode::overwrite ? InputMode::merge : mode_);
    } else if (alone && found.entry) {
        fail(where, "'" + token.text + ";' merges a dictionary, but '" + name + "' is a value",
             "it is defined on line " + std::to_string(found.entry->where.line));
    } else if (!(alone && computed && !found.entry)) {
        std::vector<Token> tokens = expand(where, "$" + name, into);
        source.waiting.insert(source.waiting.begin(), tokens.begin(), tokens.end());
    }
}

/// `name` as written after the '$'; of `$:a.b` both `a.b` and `a` are known then.
void DictionaryParser::rememberMacro(std::string_view name)
{
    name.remove_prefix(std::min(name.find_first_not_of("{:^./"), name.size()));
    const std::string bare(name.substr(0, std::min({name.find('}'), name.find(":-"), name.find(":+")})));
    origin_->macros.insert(bare.substr(0, bare.find_first_of("./")));
    origin_->macros.insert(bare);
}

DictionaryParser::Found DictionaryParser::lookup(const SourceLocation& where, std::string name,
                                                 const Dictionary& scope, Match match) const
{
    if (isBraced(name)) {
        name = name.substr(1, name.size() - 2);
        name.resize(std::min({name.size(), name.find(":-"), name.find(":+")}));
    }
    if (name.empty() || name.find('{') != std::string::npos) {
        return {};
    }
    const Dictionary* top = &scope;
    while (top->parent_) {
        top = top->parent_;
    }
    const Dictionary* start = &scope;
    bool outwards = false;
    const auto up = [&, written = name] {
        if (!start->parent_) {
            fail(where, "'$" + written + "' goes above the top of the file");
        }
        start = start->parent_;
    };
    if (name.front() == ':' || name.front() == '^') {
        start = top;
        name.erase(0, 1);
    } else if (name.find('/') != std::string::npos) { // slash scoping
        if (name.front() == '/') {
            start = top;
            name.erase(0, 1);
        }
        while (name.starts_with("./") || name.starts_with("../")) {
            if (name[1] == '.') {
                up();
            }
            name.erase(0, name.find('/') + 1);
        }
        std::ranges::replace(name, '/', '.');
    } else if (name.front() == '.') { // .x here, ..x one up, and so on
        name.erase(0, 1);
        while (name.starts_with('.')) {
            up();
            name.erase(0, 1);
        }
        if (name.empty()) {
            return {nullptr, start};
        }
    } else {
        outwards = true;
    }
    for (const Dictionary* place = start; place; place = outwards ? place->parent_ : nullptr) {
        if (const Entry* found = place->findScoped(name, match == Match::patterns)) {
            return {found, found->dictionary.get()};
        }
    }
    return {};
}

std::optional<std::string> DictionaryParser::environment(const std::string& name) const
{
    if (name == "FOAM_CASE" && !origin_->caseDirectory.empty()) { // not the one of the shell
        return std::filesystem::absolute(origin_->caseDirectory).string();
    }
    const char* value = std::getenv(name.c_str());
    return value ? std::optional<std::string>(value) : std::nullopt;
}

/// What `name:-default` or `name:+alternative` stands for; nothing where that is the variable itself. `name`
/// becomes the variable's.
std::optional<std::string> DictionaryParser::otherwise(const SourceLocation& where, std::string& name,
                                                       const Dictionary& scope)
{
    const std::size_t plus = name.find(":+");
    const std::size_t at = std::min(name.find(":-"), plus);
    const std::string other = at == std::string::npos ? "" : name.substr(at + 2);
    name = expandText(where, name.substr(0, at), scope);
    if (at == std::string::npos) {
        return std::nullopt;
    }
    const bool defined =
        lookup(where, name, scope, Match::exact).entry || !environment(name).value_or("").empty();
    if (defined == (at == plus)) {
        return expandText(where, other, scope);
    }
    return defined ? std::nullopt : std::optional<std::string>("");
}

std::vector<Token> DictionaryParser::tokensOf(const SourceLocation& where, const std::string& name,
                                              std::string_view text)
{
    std::vector<Token> tokens;
    Lexer lexer(text, where.file);
    for (Token token; lexer.next(token);) {
        tokens.push_back(std::move(token));
    }
    if (!isWholeValue(tokens)) {
        fail(where,
             "'" + std::string(text.substr(0, 60)) + "', which '$" + name + "' stands for, is no value",
             "a ';' or a bracket without its other half is in it");
    }
    return tokens;
}

void DictionaryParser::failUnknown(const SourceLocation& where, const std::string& name,
                                   const Dictionary& scope)
{
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

std::vector<Token> DictionaryParser::expand(const SourceLocation& where, std::string_view variable,
                                            const Dictionary& scope)
{
    const Level level(macroDepth_, deepestMacro, where, "macros are nested too deeply");
    std::string name(variable.substr(1));
    std::optional<std::string> text;
    if (isBraced(name)) {
        name = name.substr(1, name.size() - 2);
        text = otherwise(where, name, scope);
    }
    rememberMacro(name);

    const Found found = text ? Found{} : lookup(where, name, scope, Match::exact);
    std::vector<Token> tokens;
    if (found.dictionary) {
        appendEntries(tokens, *found.dictionary);
    } else if (found.entry) {
        tokens = found.entry->tokens;
    } else {
        if (!text) {
            text = environment(name);
        }
        if (!text) {
            failUnknown(where, name, scope);
        }
        tokens = tokensOf(where, name, *text);
    }
    for (Token& token : tokens) {
        token.line = where.line;
    }
    spend(where, tokens.size() + 1);
    return tokens;
}

std::string DictionaryParser::variableText(const SourceLocation& where, const std::string& variable,
                                           const Dictionary& scope)
{
    const std::string name = variable.substr(1);
    if (!lookup(where, name, scope, Match::exact).entry) {
        if (auto value = environment(isBraced(name) ? name.substr(1, name.size() - 2) : name)) {
            return *std::move(value); // as it stands: a path is not to be cut into tokens
        }
    }
    std::string text;
    for (const Token& token : expand(where, variable, scope)) {
        text += (text.empty() ? "" : " ") + token.text;
    }
    return text;
}

std::string DictionaryParser::expandText(const SourceLocation& where, std::string_view text,
                                         const Dictionary& scope)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '$') {
            result += text[i++];
            continue;
        }
        std::size_t end = i + 1;
        if (end < text.size() && (text[end] == '{' || text[end] == '[')) {
            const char open = text[end];
            const char close = open == '{' ? '}' : ']';
            int depth = 0;
            do {
                depth += text[end] == open ? 1 : text[end] == close ? -1 : 0;
                ++end;
            } while (end < text.size() && depth > 0);
        } else {
            while (end < text.size() && isNameCharacter(text[end])) {
                ++end;
            }
        }
        std::string variable(text.substr(i, end - i));
        if (variable.size() > 2 && variable[1] == '[') { // $[name]: the same
            variable = "${" + variable.substr(2, variable.size() - 3) + "}";
        }
        if (variable.size() < 2) {
            fail(where, "'$' without a name in '" + std::string(text.substr(0, 60)) + "'");
        }
        result += variableText(where, variable, scope);
        if (result.size() > longestText) {
            fail(where, "macros expand to more than a million characters", "do they double themselves?");
        }
        i = end;
    }
    return result;
}

std::filesystem::path DictionaryParser::filePath(const std::string& name,
                                                 const std::filesystem::path& caseDirectory,
                                                 const SourceLocation& where)
{
    return DictionaryParser(caseDirectory, false).expandPath(where, caseDirectory, name, Dictionary());
}

std::filesystem::path DictionaryParser::expandPath(const SourceLocation& where,
                                                   const std::filesystem::path& directory, std::string name,
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
    const std::filesystem::path here = origin_->caseDirectory.empty()
                                           ? std::filesystem::current_path()
                                           : std::filesystem::absolute(origin_->caseDirectory);
    replace("<case>", here);
    replace("<constant>", here / "constant");
    replace("<system>", here / "system");
    replace("<etc>", etc);
    replace("~OpenFOAM", etc);
    name = expandText(where, name, scope);
    const std::filesystem::path path(name);
    return path.is_absolute() ? path : directory / path;
}

} // namespace caisson
