#pragma once

#include <experimental/simd>

namespace caisson {

/// Four numbers that are summed or interpolated together: one register of AVX2, two of SSE2.
using Four = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4>>;

inline Four four(double a, double b, double c, double d)
{
    return Four([&](auto i) { return i == 0 ? a : i == 1 ? b : i == 2 ? c : d; });
}

/// Four members of a structure from `first` on, which lies at a multiple of 32 bytes.
inline Four fourFrom(const double& first) { return Four(&first, std::experimental::vector_aligned); }
inline void setFour(double& first, const Four& values)
{
    values.copy_to(&first, std::experimental::vector_aligned);
}

} // namespace caisson
