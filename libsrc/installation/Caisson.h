#pragma once

#include <numbers>

namespace caisson {

/// A suction caisson: a cylinder closed by a lid, with a flat tip.
struct Caisson
{
    double outerDiameter = 0;   ///< [m]
    double wallThickness = 0;   ///< [m]
    double skirtLength = 0;     ///< [m], from the tip to the lid
    double submergedWeight = 0; ///< effective vertical load: weight under water and ballast [N]

    [[nodiscard]] double innerDiameter() const { return outerDiameter - 2 * wallThickness; }
    [[nodiscard]] double meanDiameter() const { return outerDiameter - wallThickness; }
    [[nodiscard]] double outerPerimeter() const { return std::numbers::pi * outerDiameter; }
    [[nodiscard]] double innerPerimeter() const { return std::numbers::pi * innerDiameter(); }
    [[nodiscard]] double tipArea() const { return std::numbers::pi * meanDiameter() * wallThickness; }
    /// On which the suction acts [m2].
    [[nodiscard]] double plugArea() const { return std::numbers::pi / 4 * innerDiameter() * innerDiameter(); }
};

} // namespace caisson
