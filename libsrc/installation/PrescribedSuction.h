#pragma once

#include "installation/InstallationMethod.h"

#include <vector>

namespace caisson {

/// A suction given as a table, s/(gamma' D) against z/L: no resistance is computed (its forces are NaN); the
/// limits are those of uniform sand.
class PrescribedSuction final : public InstallationMethod
{
public:
    /// @param relativePenetration  z/L, >= 0, increasing
    /// @param relativeSuction  s/(effective unit weight * outer diameter), >= 0
    /// @throws std::invalid_argument for values that cannot be
    PrescribedSuction(const Caisson& caisson, double effectiveUnitWeight,
                      std::vector<double> relativePenetration, std::vector<double> relativeSuction);
    [[nodiscard]] Resistance resistance(double h, double suction) const override;
    [[nodiscard]] SuctionLimits limits(double h) const override;
    /// @throws std::out_of_range beyond the last point of the table
    [[nodiscard]] double suction(double h) const override;
    [[nodiscard]] double end() const; ///< deepest penetration of the table [m]

private:
    double effectiveUnitWeight_;
    std::vector<double> penetration_; // [m]
    std::vector<double> suction_;     // [Pa]
};

} // namespace caisson
