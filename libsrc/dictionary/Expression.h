#pragma once

#include <string_view>

namespace caisson {

/// Value of an arithmetic expression as #eval takes it: + - * / % ^ with the usual precedence, comparisons,
/// && || !, ?:, parentheses, numbers, pi() e() degToRad() radToDeg() sin() ... pow() min() max() and the
/// like.
/// @throws std::invalid_argument with what is wrong, and where in the text
double evaluateExpression(std::string_view text);

} // namespace caisson
