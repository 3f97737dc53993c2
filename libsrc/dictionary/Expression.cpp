#include "dictionary/Expression.h"

#include "dictionary/InputProblems.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace caisson {

namespace {

// The functions of OpenFOAM v1912's scalar expressions, with its meaning at zero.
double sign(double x) { return x >= 0 ? 1 : -1; }
double pos(double x) { return x > 0 ? 1 : 0; }
double pos0(double x) { return x >= 0 ? 1 : 0; }
double neg(double x) { return x < 0 ? 1 : 0; }
double neg0(double x) { return x <= 0 ? 1 : 0; }
double sqr(double x) { return x * x; }
double truth(double x) { return x != 0 ? 1 : 0; }
double minus(double x) { return -x; }
double isNot(double x) { return x == 0 ? 1 : 0; }
double degToRad(double x) { return x * std::numbers::pi / 180; }
double radToDeg(double x) { return x * 180 / std::numbers::pi; }

struct Unary
{
    std::string_view name;
    double (*function)(double);
};
constexpr Unary unaryFunctions[] = {
    {"sin", std::sin},      {"cos", std::cos},      {"tan", std::tan},   {"asin", std::asin},
    {"acos", std::acos},    {"atan", std::atan},    {"sinh", std::sinh}, {"cosh", std::cosh},
    {"tanh", std::tanh},    {"exp", std::exp},      {"log", std::log},   {"log10", std::log10},
    {"sqrt", std::sqrt},    {"cbrt", std::cbrt},    {"mag", std::fabs},  {"magSqr", sqr},
    {"sqr", sqr},           {"floor", std::floor},  {"ceil", std::ceil}, {"round", std::round},
    {"degToRad", degToRad}, {"radToDeg", radToDeg}, {"sign", sign},      {"pos", pos},
    {"pos0", pos0},         {"neg", neg},           {"neg0", neg0},      {"bool", truth},
};

struct Binary
{
    std::string_view name;
    double (*function)(double, double);
};
double smaller(double a, double b) { return a < b ? a : b; }
double larger(double a, double b) { return a > b ? a : b; }
double remainder(double a, double b) { return std::fmod(a, b); }
double either(double a, double b) { return a != 0 || b != 0 ? 1 : 0; }
double both(double a, double b) { return a != 0 && b != 0 ? 1 : 0; }
double equal(double a, double b) { return a == b ? 1 : 0; }
double different(double a, double b) { return a != b ? 1 : 0; }
double atMost(double a, double b) { return a <= b ? 1 : 0; }
double atLeast(double a, double b) { return a >= b ? 1 : 0; }
double less(double a, double b) { return a < b ? 1 : 0; }
double greater(double a, double b) { return a > b ? 1 : 0; }
constexpr Binary binaryFunctions[] = {
    {"pow", std::pow}, {"atan2", std::atan2}, {"hypot", std::hypot}, {"min", smaller}, {"max", larger},
};

} // namespace

/// Recursive descent over the text, which becomes operations on registers. What is known already becomes a
/// number at once.
class Expressions::Parser
{
public:
    Parser(Expressions& into, std::string_view text) : into_(into), text_(text) {}

    Operand all()
    {
        const Operand value = ternary();
        skip();
        if (at_ < text_.size() && text_[at_] == ';') { // tolerated at the end
            ++at_;
            skip();
        }
        if (at_ < text_.size()) {
            fail("unexpected '" + std::string(1, text_[at_]) + "'" +
                 (text_[at_] == '^' ? " (powers are pow(a, b))" : ""));
        }
        if (value.reg < 0 && !std::isfinite(value.number)) {
            fail("the result is not finite");
        }
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::invalid_argument(what + " at character " + std::to_string(at_ + 1) + " of '" +
                                    std::string(text_.substr(0, 200)) + "'");
    }
    void skip()
    {
        while (at_ < text_.size()) {
            if (text_.substr(at_, 2) == "//") {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
                ++at_;
            } else {
                return;
            }
        }
    }
    bool take(std::string_view symbol)
    {
        skip();
        if (text_.substr(at_, symbol.size()) == symbol) {
            at_ += symbol.size();
            return true;
        }
        return false;
    }
    Operand apply(double (*function)(double), Operand a)
    {
        if (a.reg < 0) {
            return {-1, function(a.number)};
        }
        return into_.add({.code = Code::unary, .one = function, .a = a, .b = {}, .c = {}});
    }
    Operand apply(double (*function)(double, double), Operand a, Operand b)
    {
        if (a.reg < 0 && b.reg < 0) {
            return {-1, function(a.number, b.number)};
        }
        return into_.add({.code = Code::binary, .two = function, .a = a, .b = b, .c = {}});
    }
    Operand apply(Code code, Operand a, Operand b)
    {
        if (a.reg < 0 && b.reg < 0) {
            const double x = a.number;
            const double y = b.number;
            return {-1, code == Code::add        ? x + y
                        : code == Code::subtract ? x - y
                        : code == Code::multiply ? x * y
                                                 : x / y};
        }
        return into_.add({.code = code, .a = a, .b = b, .c = {}});
    }
    Operand ternary()
    {
        const Depth depth(*this);
        const Operand condition = disjunction();
        if (!take("?")) {
            return condition;
        }
        const Operand yes = ternary();
        if (!take(":")) {
            fail("expected ':'");
        }
        const Operand no = ternary();
        if (condition.reg < 0) {
            return condition.number != 0 ? yes : no;
        }
        return into_.add({.code = Code::choose, .a = condition, .b = yes, .c = no});
    }
    Operand disjunction()
    {
        Operand value = conjunction();
        while (take("||")) {
            value = apply(either, value, conjunction());
        }
        return value;
    }
    Operand conjunction()
    {
        Operand value = comparison();
        while (take("&&")) {
            value = apply(both, value, comparison());
        }
        return value;
    }
    Operand comparison()
    {
        Operand value = sum();
        for (;;) {
            if (take("==")) {
                value = apply(equal, value, sum());
            } else if (take("!=")) {
                value = apply(different, value, sum());
            } else if (take("<=")) {
                value = apply(atMost, value, sum());
            } else if (take(">=")) {
                value = apply(atLeast, value, sum());
            } else if (take("<")) {
                value = apply(less, value, sum());
            } else if (take(">")) {
                value = apply(greater, value, sum());
            } else {
                return value;
            }
        }
    }
    Operand sum()
    {
        Operand value = product();
        for (;;) {
            if (take("+")) {
                value = apply(Code::add, value, product());
            } else if (take("-")) {
                value = apply(Code::subtract, value, product());
            } else {
                return value;
            }
        }
    }
    Operand product()
    {
        Operand value = unary();
        for (;;) {
            if (take("*")) {
                value = apply(Code::multiply, value, unary());
            } else if (take("/")) {
                value = apply(Code::divide, value, unary());
            } else if (take("%")) {
                value = apply(remainder, value, unary());
            } else {
                return value;
            }
        }
    }
    Operand unary()
    {
        const Depth depth(*this);
        if (take("-")) {
            return apply(minus, unary());
        }
        if (take("+")) {
            return unary();
        }
        skip();
        if (text_.substr(at_, 1) == "!" && text_.substr(at_, 2) != "!=") {
            ++at_;
            return apply(isNot, unary());
        }
        return primary();
    }
    Operand primary()
    {
        skip();
        if (take("(")) {
            const Operand value = ternary();
            if (!take(")")) {
                fail("expected ')'");
            }
            return value;
        }
        double value = 0;
        const auto parsed = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (parsed.ec == std::errc() && at_ < text_.size() &&
            !std::isalpha(static_cast<unsigned char>(text_[at_]))) {
            at_ = parsed.ptr - text_.data();
            return {-1, value};
        }
        std::string name;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) {
            name += text_[at_++];
        }
        if (name.empty()) {
            fail(at_ < text_.size() ? "unexpected '" + std::string(1, text_[at_]) + "'" : "unexpected end");
        }
        if (name == "true" || name == "false") {
            return {-1, name == "true" ? 1.0 : 0.0};
        }
        return call(name);
    }
    Operand call(const std::string& name)
    {
        if (!take("(")) {
            for (const auto& [known, operand] : into_.names_) {
                if (known == name) {
                    return operand;
                }
            }
            std::vector<std::string> known;
            known.reserve(into_.names_.size());
            for (const auto& item : into_.names_) {
                known.push_back(item.first);
            }
            fail("unknown name '" + name + "'" +
                 (known.empty() ? "" : " (" + suggestion(name, known, "names") + ")"));
        }
        std::vector<Operand> arguments;
        if (!take(")")) {
            do {
                arguments.push_back(ternary());
            } while (take(","));
            if (!take(")")) {
                fail("expected ')'");
            }
        }
        if (arguments.empty() && name == "pi") {
            return {-1, std::numbers::pi};
        }
        if (arguments.empty() && (name == "degToRad" || name == "radToDeg")) {
            arguments.push_back({-1, 1}); // the factor itself
        }
        std::vector<std::string> valid{"pi"};
        for (const Unary& candidate : unaryFunctions) {
            if (candidate.name == name && arguments.size() == 1) {
                return apply(candidate.function, arguments[0]);
            }
            valid.emplace_back(candidate.name);
        }
        for (const Binary& candidate : binaryFunctions) {
            if (candidate.name == name && arguments.size() == 2) {
                return apply(candidate.function, arguments[0], arguments[1]);
            }
            valid.emplace_back(candidate.name);
        }
        fail("no function '" + name + "' of " + std::to_string(arguments.size()) + " arguments (" +
             suggestion(name, valid, "functions") + ")");
    }

    /// Guards the stack against hostile nesting.
    struct Depth
    {
        explicit Depth(Parser& parser) : parser_(parser)
        {
            if (++parser_.depth_ > 400) {
                parser_.fail("nested too deeply");
            }
        }
        ~Depth() { --parser_.depth_; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        Parser& parser_;
    };

    Expressions& into_;
    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

Expressions::Expressions(const std::vector<Variable>& variables)
    : variables_(static_cast<int>(variables.size()))
{
    for (int i = 0; i < variables_; ++i) {
        names_.emplace_back(variables[i].name, Operand{i, 0});
        uniform_.push_back(variables[i].uniform ? 1 : 0);
    }
}

void Expressions::define(const std::string& name, std::string_view text)
{
    const bool word = std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    if (!word || name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) {
        throw std::invalid_argument("'" + name + "' is no name: letters, digits and _ only, a letter first");
    }
    if (std::ranges::any_of(names_, [&](const auto& known) { return known.first == name; })) {
        throw std::invalid_argument("'" + name + "' has a meaning already");
    }
    const Operand value = Parser(*this, text).all();
    names_.emplace_back(name, value);
}

void Expressions::addResult(std::string_view text) { results_.push_back(Parser(*this, text).all()); }

Expressions::Operand Expressions::add(Operation operation)
{
    const auto uniform = [&](const Operand& operand) {
        return operand.reg < 0 || uniform_[operand.reg] != 0;
    };
    uniform_.push_back(uniform(operation.a) && uniform(operation.b) && uniform(operation.c) ? 1 : 0);
    operations_.push_back(operation);
    return {static_cast<int>(uniform_.size()) - 1, 0};
}

void Expressions::evaluate(std::span<const double* const> variables, int count,
                           std::span<double* const> results, std::vector<double>& workspace) const
{
    workspace.resize(workspaceSize());
    // A register is a row of values, of the workspace or a variable's; one that is uniform has its first
    // alone.
    const auto row = [&](int reg) -> const double* {
        return reg < variables_ ? variables[reg]
                                : workspace.data() + static_cast<std::size_t>(reg - variables_) * block;
    };
    int next = variables_;
    for (const Operation& operation : operations_) {
        double* const out = workspace.data() + static_cast<std::size_t>(next - variables_) * block;
        const int items = uniform_[next] != 0 ? 1 : count;
        ++next;
        // Numbers and uniform operands have the stride 0.
        const auto read = [&](const Operand& operand, const double*& from) -> std::ptrdiff_t {
            from = operand.reg < 0 ? &operand.number : row(operand.reg);
            return operand.reg < 0 || uniform_[operand.reg] != 0 ? 0 : 1;
        };
        const double* a = nullptr;
        const double* b = nullptr;
        const double* c = nullptr;
        const std::ptrdiff_t da = read(operation.a, a);
        const std::ptrdiff_t db = read(operation.b, b);
        const std::ptrdiff_t dc = read(operation.c, c);
        switch (operation.code) {
        case Code::add:
            for (int i = 0; i < items; ++i) {
                out[i] = a[i * da] + b[i * db];
            }
            break;
        case Code::subtract:
            for (int i = 0; i < items; ++i) {
                out[i] = a[i * da] - b[i * db];
            }
            break;
        case Code::multiply:
            for (int i = 0; i < items; ++i) {
                out[i] = a[i * da] * b[i * db];
            }
            break;
        case Code::divide:
            for (int i = 0; i < items; ++i) {
                out[i] = a[i * da] / b[i * db];
            }
            break;
        case Code::unary:
            for (int i = 0; i < items; ++i) {
                out[i] = operation.one(a[i * da]);
            }
            break;
        case Code::binary:
            for (int i = 0; i < items; ++i) {
                out[i] = operation.two(a[i * da], b[i * db]);
            }
            break;
        case Code::choose:
            for (int i = 0; i < items; ++i) {
                out[i] = a[i * da] != 0 ? b[i * db] : c[i * dc];
            }
            break;
        }
    }
    for (std::size_t k = 0; k < results_.size(); ++k) {
        const Operand& result = results_[k];
        const double* const from = result.reg < 0 ? &result.number : row(result.reg);
        const std::ptrdiff_t step = result.reg < 0 || uniform_[result.reg] != 0 ? 0 : 1;
        for (int i = 0; i < count; ++i) {
            results[k][i] = from[i * step];
        }
    }
}

double evaluateExpression(std::string_view text)
{
    Expressions expression({});
    expression.addResult(text);
    return expression.constantResult();
}

} // namespace caisson
