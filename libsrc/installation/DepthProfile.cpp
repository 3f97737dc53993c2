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

double DepthProfile::value(const double z) const
{
    const auto above = std::upper_bound(depth_.begin(), depth_.end(), z);
    if (above == depth_.begin())
        return value_.front();
    if (above == depth_.end())
        return value_.back();
    const auto i = static_cast<std::size_t>(above - depth_.begin());
    const double share = (z - depth_[i - 1]) / (depth_[i] - depth_[i - 1]);
    return value_[i - 1] + share * (value_[i] - value_[i - 1]);
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
