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
constexpr Binary binaryFunctions[] = {
    {"pow", std::pow}, {"atan2", std::atan2}, {"hypot", std::hypot}, {"min", smaller}, {"max", larger},
};

/// Recursive descent over the text.
class Evaluator
{
public:
    explicit Evaluator(std::string_view text) : text_(text) {}

    double all()
    {
        const double value = ternary();
        skip();
        if (at_ < text_.size() && text_[at_] == ';') { // tolerated at the end
            ++at_;
            skip();
        }
        if (at_ < text_.size()) {
            fail("unexpected '" + std::string(1, text_[at_]) + "'" +
                 (text_[at_] == '^' ? " (powers are pow(a, b))" : ""));
        }
        if (!std::isfinite(value)) {
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
    double ternary()
    {
        const Depth depth(*this);
        const double condition = disjunction();
        if (!take("?")) {
            return condition;
        }
        const double yes = ternary();
        if (!take(":")) {
            fail("expected ':'");
        }
        const double no = ternary();
        return condition != 0 ? yes : no;
    }
    double disjunction()
    {
        double value = conjunction();
        while (take("||")) {
            const double right = conjunction();
            value = value != 0 || right != 0;
        }
        return value;
    }
    double conjunction()
    {
        double value = comparison();
        while (take("&&")) {
            const double right = comparison();
            value = value != 0 && right != 0;
        }
        return value;
    }
    double comparison()
    {
        double value = sum();
        for (;;) {
            if (take("==")) {
                value = value == sum();
            } else if (take("!=")) {
                value = value != sum();
            } else if (take("<=")) {
                value = value <= sum();
            } else if (take(">=")) {
                value = value >= sum();
            } else if (take("<")) {
                value = value < sum();
            } else if (take(">")) {
                value = value > sum();
            } else {
                return value;
            }
        }
    }
    double sum()
    {
        double value = product();
        for (;;) {
            if (take("+")) {
                value += product();
            } else if (take("-")) {
                value -= product();
            } else {
                return value;
            }
        }
    }
    double product()
    {
        double value = unary();
        for (;;) {
            if (take("*")) {
                value *= unary();
            } else if (take("/")) {
                value /= unary();
            } else if (take("%")) {
                value = std::fmod(value, unary());
            } else {
                return value;
            }
        }
    }
    double unary()
    {
        const Depth depth(*this);
        if (take("-")) {
            return -unary();
        }
        if (take("+")) {
            return unary();
        }
        skip();
        if (text_.substr(at_, 1) == "!" && text_.substr(at_, 2) != "!=") {
            ++at_;
            return unary() == 0;
        }
        return primary();
    }
    double primary()
    {
        skip();
        if (take("(")) {
            const double value = ternary();
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
            return value;
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
            return name == "true";
        }
        return call(name);
    }
    double call(const std::string& name)
    {
        if (!take("(")) {
            fail("unknown name '" + name + "'");
        }
        std::vector<double> arguments;
        if (!take(")")) {
            do {
                arguments.push_back(ternary());
            } while (take(","));
            if (!take(")")) {
                fail("expected ')'");
            }
        }
        if (arguments.empty() && name == "pi") {
            return std::numbers::pi;
        }
        if (arguments.empty() && (name == "degToRad" || name == "radToDeg")) {
            arguments.push_back(1); // the factor itself
        }
        std::vector<std::string> valid{"pi"};
        for (const Unary& candidate : unaryFunctions) {
            if (candidate.name == name && arguments.size() == 1) {
                return candidate.function(arguments[0]);
            }
            valid.emplace_back(candidate.name);
        }
        for (const Binary& candidate : binaryFunctions) {
            if (candidate.name == name && arguments.size() == 2) {
                return candidate.function(arguments[0], arguments[1]);
            }
            valid.emplace_back(candidate.name);
        }
        fail("no function '" + name + "' of " + std::to_string(arguments.size()) + " arguments (" +
             suggestion(name, valid, "functions") + ")");
    }

    /// Guards the stack against hostile nesting.
    struct Depth
    {
        explicit Depth(Evaluator& evaluator) : evaluator_(evaluator)
        {
            if (++evaluator_.depth_ > 400) {
                evaluator_.fail("nested too deeply");
            }
        }
        ~Depth() { --evaluator_.depth_; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        Evaluator& evaluator_;
    };

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

} // namespace

double evaluateExpression(std::string_view text) { return Evaluator(text).all(); }

} // namespace caisson
