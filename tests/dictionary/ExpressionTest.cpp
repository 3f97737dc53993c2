#include "dictionary/Expression.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace caisson {

TEST(Expression, precedenceIsTheUsualOne)
{
    EXPECT_EQ(evaluateExpression("1 + 2*3"), 7);
    EXPECT_EQ(evaluateExpression("(1 + 2)*3"), 9);
    EXPECT_EQ(evaluateExpression("2 - 3 - 4"), -5);
    EXPECT_EQ(evaluateExpression("2 * 3 % 4"), 2);
    EXPECT_EQ(evaluateExpression("7.5 % 2"), 1.5);
    EXPECT_EQ(evaluateExpression("-(-3)"), 3);
    EXPECT_EQ(evaluateExpression("2*-1"), -2);
    EXPECT_EQ(evaluateExpression("1/4"), 0.25); // no integer division
    EXPECT_EQ(evaluateExpression("1.5e-3"), 0.0015);
    EXPECT_EQ(evaluateExpression("1 < 2 && 2 < 3 ? 4 : 5"), 4);
    EXPECT_EQ(evaluateExpression("!(1 < 2) || false"), 0);
    EXPECT_EQ(evaluateExpression("5 // a comment"), 5);
}

/// Values of OpenFOAM v1912's #eval; at zero pos() is 0 and pos0(), neg0() are 1.
TEST(Expression, functionsHaveOpenFOAMsMeaning)
{
    const double pi = std::numbers::pi;
    const std::pair<const char*, double> expected[] = {
        {"pi()", pi},
        {"degToRad(180)", pi},
        {"degToRad()", pi / 180},
        {"radToDeg(pi())", 180},
        {"radToDeg()", 180 / pi},
        {"sin(1)", std::sin(1)},
        {"cos(1)", std::cos(1)},
        {"tan(1)", std::tan(1)},
        {"asin(0.5)", std::asin(0.5)},
        {"acos(0.5)", std::acos(0.5)},
        {"atan(0.5)", std::atan(0.5)},
        {"atan2(1, 2)", std::atan2(1, 2)},
        {"sinh(1)", std::sinh(1)},
        {"cosh(1)", std::cosh(1)},
        {"tanh(1)", std::tanh(1)},
        {"exp(1)", std::numbers::e},
        {"log(10)", std::numbers::ln10},
        {"log10(100)", 2},
        {"sqrt(16)", 4},
        {"cbrt(27)", 3},
        {"sqr(3)", 9},
        {"pow(2, 3)", 8},
        {"hypot(3, 4)", 5},
        {"mag(-3)", 3},
        {"magSqr(-3)", 9},
        {"min(1, 2)", 1},
        {"max(1, 2)", 2},
        {"floor(-0.5)", -1},
        {"ceil(1.5)", 2},
        {"round(-2.5)", -3},
        {"sign(0)", 1},
        {"sign(-2)", -1},
        {"pos(0)", 0},
        {"pos0(0)", 1},
        {"neg(0)", 0},
        {"neg0(0)", 1},
        {"bool(2)", 1},
    };
    for (const auto& [text, value] : expected) {
        EXPECT_NEAR(evaluateExpression(text), value, 1e-15 * std::max(1.0, std::abs(value))) << text;
    }
}

TEST(Expression, whatIsWrongIsSaid)
{
    const auto refusal = [](const char* text) -> std::string {
        try {
            return std::to_string(evaluateExpression(text));
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
    };
    EXPECT_EQ(refusal("(1+2"), "expected ')' at character 5 of '(1+2'");
    EXPECT_EQ(refusal("2^3"), "unexpected '^' (powers are pow(a, b)) at character 2 of '2^3'");
    EXPECT_EQ(refusal("1/0"), "the result is not finite at character 4 of '1/0'");
    EXPECT_EQ(refusal("sqrt(-1)"), "the result is not finite at character 9 of 'sqrt(-1)'");
    EXPECT_EQ(refusal(""), "unexpected end at character 1 of ''");
    EXPECT_EQ(refusal("pi"), "unknown name 'pi' at character 3 of 'pi'");
    EXPECT_EQ(refusal("sinn(1)").substr(0, 60),
              "no function 'sinn' of 1 arguments (did you mean 'sin'?  vali");
}

TEST(Expressions, ofVariablesAreThoseOfTheirNumbers)
{
    const char* texts[] = {"x + 2*t - x/3",
                           "x > 1 ? -x : t % 0.3",
                           "!(x < t) || x == 2",
                           "min(x, t)*pow(2, x)",
                           "hypot(x, t) - atan2(t, x)",
                           "3",
                           "x",
                           "t"};
    for (const char* text : texts) {
        Expressions expressions({{"x", false}, {"t", true}});
        expressions.addResult(text);
        const double x[] = {0.5, 1, 2};
        const double t = 1;
        const double* const variables[] = {x, &t};
        double got[3];
        double* const results[] = {got};
        std::vector<double> workspace;
        expressions.evaluate(variables, 3, results, workspace);
        for (int i = 0; i < 3; ++i) {
            std::string numbers;
            for (const char c : std::string(text)) { // no function has an x or a t alone
                numbers += c;
            }
            const auto put = [&](char name, double value) {
                for (std::size_t at = numbers.find(name); at != std::string::npos;
                     at = numbers.find(name, at)) {
                    const bool alone = (at == 0 || std::isalpha(numbers[at - 1]) == 0) &&
                                       (at + 1 == numbers.size() || (std::isalnum(numbers[at + 1]) == 0));
                    const std::string with = alone ? "(" + std::to_string(value) + ")" : std::string(1, name);
                    numbers.replace(at, 1, with);
                    at += with.size();
                }
            };
            put('x', x[i]);
            put('t', t);
            EXPECT_DOUBLE_EQ(got[i], evaluateExpression(numbers)) << text << " at " << x[i];
        }
    }
}

TEST(Expressions, namesAreOfWhatWasDefinedBefore)
{
    Expressions expressions({{"x", false}});
    expressions.define("a", "2*x");
    expressions.define("b", "a + 1");
    expressions.addResult("a*b");
    EXPECT_THROW(expressions.define("x", "1"), std::invalid_argument);
    EXPECT_THROW(expressions.define("2a", "1"), std::invalid_argument);
    EXPECT_THROW(expressions.addResult("c"), std::invalid_argument);
    const double x = 3;
    const double* const variables[] = {&x};
    double got = 0;
    double* const results[] = {&got};
    std::vector<double> workspace;
    expressions.evaluate(variables, 1, results, workspace);
    EXPECT_EQ(got, 42);
}

} // namespace caisson
