#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace caisson {

/// Value of an arithmetic expression as OpenFOAM's #eval takes it: + - * / % with the usual precedence,
/// comparisons, && || !, ?:, parentheses, numbers, true and false, pi(), degToRad(), sin() ... pow() min()
/// max() and the like, scalars only.
/// @throws std::invalid_argument with what is wrong, and where in the text; also where the result is not
/// finite
double evaluateExpression(std::string_view text);

/// The same of variables: read once, evaluated for many items at a time. Both sides of ?: are evaluated.
class Expressions
{
public:
    struct Variable
    {
        std::string name;
        bool uniform = false; ///< one value for all items
    };
    static constexpr int block = 64; ///< items at a time, at most

    explicit Expressions(const std::vector<Variable>& variables);

    /// Gives an expression a name, for those that follow. @throws std::invalid_argument
    void define(const std::string& name, std::string_view text);
    /// Adds an expression whose values are wanted. @throws std::invalid_argument
    void addResult(std::string_view text);

    /// @param variables  values, `count` of each; of a uniform variable the first alone counts
    /// @param count      of items, no more than a block
    /// @param results    one for each addResult(), `count` values
    /// @param workspace  of workspaceSize(), so that nothing is allocated
    void evaluate(std::span<const double* const> variables, int count, std::span<double* const> results,
                  std::vector<double>& workspace) const;
    [[nodiscard]] std::size_t workspaceSize() const { return operations_.size() * block; }

private:
    friend double evaluateExpression(std::string_view text);
    class Parser;
    enum class Code { add, subtract, multiply, divide, unary, binary, choose };
    /// Register, or (-1) a number. Registers are the variables first, then one per operation.
    struct Operand
    {
        int reg = -1;
        double number = 0;
    };
    struct Operation
    {
        Code code;
        double (*one)(double) = nullptr;
        double (*two)(double, double) = nullptr;
        Operand a, b, c;
    };
    Operand add(Operation operation);
    [[nodiscard]] double constantResult() const { return results_.front().number; }

    int variables_;
    std::vector<std::pair<std::string, Operand>> names_;
    std::vector<unsigned char> uniform_; ///< per register
    std::vector<Operation> operations_;
    std::vector<Operand> results_;
};

} // namespace caisson
