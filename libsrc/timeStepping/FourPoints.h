#pragma once

#include "timeStepping/Four.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace caisson {

/// Where the points are stored: pointers of our own, for what a kernel stores might change the vectors, for
/// all that the compiler knows. Number: double or const double.
template <class Number>
struct PointArrays
{
    template <class Points>
    [[gnu::always_inline]] PointArrays(Points& points, std::size_t materials)
        : r(points.r.data()), z(points.z.data()), vr(points.vr.data()), vz(points.vz.data()),
          wr(points.wr.data()), wz(points.wz.data()), mass(points.mass.data()), volume(points.volume.data()),
          porePressure(points.porePressure.data()), stress{points.stress[0].data(), points.stress[1].data(),
                                                           points.stress[2].data(), points.stress[3].data()},
          material(points.material.data()), ofOneMaterial(materials == 1)
    {
    }

    Number *r, *z, *vr, *vz, *wr, *wz, *mass, *volume, *porePressure;
    std::array<Number*, 4> stress;
    const int* material;
    bool ofOneMaterial;
};

/// One to four points that lie one behind the other in the storage. What lies behind them is read, too, even
/// while another thread gives it new values, and not used.
template <int count>
struct AdjacentPoints
{
    std::size_t first;

    [[gnu::always_inline]] [[nodiscard]] Four of(const double* values) const
    {
        return Four(values + first, std::experimental::element_aligned);
    }
    [[gnu::always_inline]] [[nodiscard]] Four of(const std::vector<double>& values) const
    {
        return of(values.data());
    }
    [[gnu::always_inline]] void set(double* values, const Four& result) const
    {
        double* const to = values + first;
        if constexpr (count == 4) {
            result.copy_to(to, std::experimental::element_aligned);
        } else {
            to[0] = result[0];
            if constexpr (count > 1) {
                to[1] = result[1];
            }
            if constexpr (count > 2) {
                to[2] = result[2];
            }
        }
    }
    /// `of` one of the values, that of its material, for each.
    template <class Points, class Value, class Of = std::identity>
    [[gnu::always_inline]] [[nodiscard]] Four ofMaterial(const std::vector<Value>& values,
                                                         const Points& points, const Of& of = {}) const
    {
        const auto at = [&](std::size_t p) { return std::invoke(of, values[points.material[p]]); };
        return points.ofOneMaterial ? Four(std::invoke(of, values[0]))
                                    : four(at(first), at(first + 1), at(first + 2), at(first + 3));
    }
    /// Zero for those behind the points.
    [[gnu::always_inline]] [[nodiscard]] static Four only(const Four& values)
    {
        if constexpr (count == 4) {
            return values;
        } else {
            Four result = values;
            where(four(0, 1, 2, 3) >= count, result) = 0;
            return result;
        }
    }
};

/// Four points anywhere, or less: then the last one stands for those that are missing.
struct ScatteredPoints
{
    std::array<int, 4> at;
    int count;

    [[gnu::always_inline]] [[nodiscard]] Four of(const double* values) const
    {
        return four(values[at[0]], values[at[1]], values[at[2]], values[at[3]]);
    }
    [[gnu::always_inline]] [[nodiscard]] Four of(const std::vector<double>& values) const
    {
        return of(values.data());
    }
    [[gnu::always_inline]] void set(double* values, const Four& result) const
    {
        alignas(4 * sizeof(double)) std::array<double, 4> results;
        setFour(results[0], result);
        for (int l = 0; l < count; ++l) {
            values[at[l]] = results[l];
        }
    }
    template <class Points, class Value, class Of = std::identity>
    [[gnu::always_inline]] [[nodiscard]] Four ofMaterial(const std::vector<Value>& values,
                                                         const Points& points, const Of& of = {}) const
    {
        const auto value = [&](int p) { return std::invoke(of, values[points.material[p]]); };
        return points.ofOneMaterial ? Four(std::invoke(of, values[0]))
                                    : four(value(at[0]), value(at[1]), value(at[2]), value(at[3]));
    }
    [[gnu::always_inline]] [[nodiscard]] Four only(const Four& values) const
    {
        Four result = values;
        where(four(0, 1, 2, 3) >= count, result) = 0;
        return result;
    }
};

/// work(points) for the points of an ascending list, four at a time. `size`: of the arrays that they are in.
template <class Work>
[[gnu::always_inline]] inline void forFours(const int* first, const int* last, std::size_t size,
                                            const Work& work)
{
    const std::ptrdiff_t count = last - first;
    auto at = static_cast<std::size_t>(first[0]);
    const auto end = static_cast<std::size_t>(last[-1]) + 1;
    if (last[-1] - first[0] == count - 1 && end + 3 <= size) {
        for (; at + 4 <= end; at += 4) {
            work(AdjacentPoints<4>{at});
        }
        if (at + 3 == end) {
            work(AdjacentPoints<3>{at});
        } else if (at + 2 == end) {
            work(AdjacentPoints<2>{at});
        } else if (at + 1 == end) {
            work(AdjacentPoints<1>{at});
        }
        return;
    }
    for (; first < last; first += 4) {
        const int some = static_cast<int>(std::min<std::ptrdiff_t>(last - first, 4));
        work(ScatteredPoints{
            {first[0], first[std::min(1, some - 1)], first[std::min(2, some - 1)], first[some - 1]}, some});
    }
}

/// Rows become columns. Real: Four (a template, so that its other branch is none of the processors without
/// AVX2).
template <class Real>
[[gnu::always_inline]] inline void transpose(std::array<Real, 4>& rows)
{
    if constexpr (std::is_trivially_copyable_v<Real>) { // it is one register
        using Vector [[gnu::vector_size(4 * sizeof(double))]] = double;
        static_assert(sizeof(Vector) == sizeof(Real));
        const auto a = std::bit_cast<Vector>(rows[0]);
        const auto b = std::bit_cast<Vector>(rows[1]);
        const auto c = std::bit_cast<Vector>(rows[2]);
        const auto d = std::bit_cast<Vector>(rows[3]);
        const Vector abEven = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        const Vector abOdd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
        const Vector cdEven = __builtin_shufflevector(c, d, 0, 4, 2, 6);
        const Vector cdOdd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
        rows[0] = std::bit_cast<Real>(__builtin_shufflevector(abEven, cdEven, 0, 1, 4, 5));
        rows[1] = std::bit_cast<Real>(__builtin_shufflevector(abOdd, cdOdd, 0, 1, 4, 5));
        rows[2] = std::bit_cast<Real>(__builtin_shufflevector(abEven, cdEven, 2, 3, 6, 7));
        rows[3] = std::bit_cast<Real>(__builtin_shufflevector(abOdd, cdOdd, 2, 3, 6, 7));
    } else {
        const std::array<Real, 4> old = rows;
        for (int i = 0; i < 4; ++i) {
            rows[i] = four(old[0][i], old[1][i], old[2][i], old[3][i]);
        }
    }
}

/// Four numbers of each of four elements of an array, from the first number of the first element on: the
/// first ones, the second ones and so on. `stride`: doubles per element.
[[gnu::always_inline]] inline std::array<Four, 4> columns(const double* first, std::size_t stride)
{
    std::array<Four, 4> rows;
    for (std::size_t l = 0; l < 4; ++l) {
        rows[l] = Four(first + l * stride, std::experimental::element_aligned);
    }
    transpose(rows);
    return rows;
}

[[gnu::always_inline]] inline void setColumns(double* first, std::size_t stride, std::array<Four, 4> of)
{
    transpose(of);
    for (std::size_t l = 0; l < 4; ++l) {
        of[l].copy_to(first + l * stride, std::experimental::element_aligned);
    }
}

} // namespace caisson
