#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace caisson {

/// Exponents of kg, m, s, K, mol, A, cd: OpenFOAM's order.
using Dimensions = std::array<double, 7>;

/// Dimensions of a unit such as "kg/m3", "m/s2", "Pa", "Pa s", "1/m", "-", "deg"; nothing where it is no SI
/// unit ("word", "list", "kPa" ...).
std::optional<Dimensions> dimensionsOf(std::string_view unit);

/// "[1 -1 -2 0 0 0 0]"
std::string printDimensions(const Dimensions& dimensions);

} // namespace caisson
