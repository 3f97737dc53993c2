#pragma once

#include <string_view>

namespace caisson {

/// Value of an arithmetic expression as OpenFOAM's #eval takes it: + - * / % with the usual precedence,
/// comparisons, && || !, ?:, parentheses, numbers, true and false, pi(), degToRad(), sin() ... pow() min()
/// max() and the like, scalars only.
/// @throws std::invalid_argument with what is wrong, and where in the text; also where the result is not
/// finite
double evaluateExpression(std::string_view text);

} // namespace caisson
