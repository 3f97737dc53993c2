#pragma once

#include <span>
#include <vector>

namespace caisson {

/// A quantity along depth below the sea bed, linear between the given depths and constant beyond them.
class DepthProfile
{
public:
    explicit DepthProfile(double uniform = 0);
    /// @throws std::invalid_argument unless there is at least one point, sizes agree, depths are >= 0 and
    ///   increase (a depth given twice is a step)
    DepthProfile(std::vector<double> depth, std::vector<double> value);

    [[nodiscard]] double value(double z) const;      ///< at a step: the value below it
    [[nodiscard]] double valueAbove(double z) const; ///< at a step: the value above it
    [[nodiscard]] double integral(double z) const;   ///< from 0 to z
    [[nodiscard]] double deepest() const { return depth_.back(); }
    [[nodiscard]] std::span<const double> depths() const { return depth_; }
    [[nodiscard]] std::span<const double> values() const { return value_; }

private:
    [[nodiscard]] double between(std::size_t next, double z) const; // linear up to the point `next`

    std::vector<double> depth_;
    std::vector<double> value_;
    std::vector<double> integral_; // from 0 to each depth
};

} // namespace caisson
