#include "installation/DepthProfile.h"

#include <algorithm>
#include <stdexcept>

namespace caisson {

DepthProfile::DepthProfile(const double uniform) : DepthProfile({0.0}, {uniform}) {}

DepthProfile::DepthProfile(std::vector<double> depth, std::vector<double> value)
    : depth_(std::move(depth)), value_(std::move(value))
{
    if (depth_.empty() || depth_.size() != value_.size())
        throw std::invalid_argument("a depth profile needs one value for each depth");
    if (depth_.front() < 0 || !std::is_sorted(depth_.begin(), depth_.end()))
        throw std::invalid_argument("the depths of a profile must be positive and increase");
    integral_.push_back(depth_.front() * value_.front());
    for (std::size_t i = 1; i < depth_.size(); ++i)
        integral_.push_back(integral_.back() +
                            0.5 * (value_[i] + value_[i - 1]) * (depth_[i] - depth_[i - 1]));
}

double DepthProfile::between(const std::size_t next, const double z) const
{
    if (next == 0)
        return value_.front();
    if (next == depth_.size())
        return value_.back();
    const double share = (z - depth_[next - 1]) / (depth_[next] - depth_[next - 1]);
    return value_[next - 1] + share * (value_[next] - value_[next - 1]);
}

double DepthProfile::value(const double z) const
{
    return between(static_cast<std::size_t>(std::ranges::upper_bound(depth_, z) - depth_.begin()), z);
}

double DepthProfile::valueAbove(const double z) const
{
    return between(static_cast<std::size_t>(std::ranges::lower_bound(depth_, z) - depth_.begin()), z);
}

double DepthProfile::integral(const double z) const
{
    const auto above = std::upper_bound(depth_.begin(), depth_.end(), z);
    if (above == depth_.begin())
        return z * value_.front();
    const auto i = static_cast<std::size_t>(above - depth_.begin()) - 1;
    return integral_[i] + 0.5 * (value_[i] + value(z)) * (z - depth_[i]);
}

} // namespace caisson
