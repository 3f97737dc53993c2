#pragma once

// What the comparisons with exact answers share.

#include "support/Simulation.h"
#include "support/StructuredMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace caisson::testing {

using std::numbers::pi;

/// Dry elastic solid of density rho [kg/m3].
inline std::string elasticSolid(double youngsModulus, double poissonsRatio, double density,
                                const std::string& law = "linearElastic")
{
    return "law " + law + "; porosity 0.5; solidDensity " + std::to_string(2 * density) + "; weight dry; " +
           "youngsModulus " + std::to_string(youngsModulus) + "; poissonsRatio " +
           std::to_string(poissonsRatio) + ";";
}

inline double shearModulus(double youngsModulus, double poissonsRatio)
{
    return youngsModulus / (2 * (1 + poissonsRatio));
}

inline double pWaveModulus(double youngsModulus, double poissonsRatio)
{
    return youngsModulus * (1 - poissonsRatio) / ((1 + poissonsRatio) * (1 - 2 * poissonsRatio));
}

/// Mean over the points, weighted with mass.
template <class Value>
double massMean(const MaterialPoints& points, const Value& value)
{
    double sum = 0;
    double mass = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        sum += points.mass[p] * value(p);
        mass += points.mass[p];
    }
    return sum / mass;
}

/// Root of the sum of (value - exact)^2 over that of exact^2, weighted with volume.
template <class Value, class Exact>
double relativeError(const MaterialPoints& points, const Value& value, const Exact& exact)
{
    double error = 0;
    double norm = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        error += points.volume[p] * std::pow(value(p) - exact(p), 2);
        norm += points.volume[p] * std::pow(exact(p), 2);
    }
    return std::sqrt(error / norm);
}

/// Prints and checks a value.
inline void expectNear(const char* what, double got, double expected, double tolerance)
{
    std::printf("%-66s expected %.6g, got %.6g, tolerance %.1e\n", what, expected, got, tolerance);
    EXPECT_NEAR(got, expected, tolerance) << what;
}

/// The same for an order of convergence, from the errors at two resolutions, one twice the other.
inline void expectOrder(const char* what, double coarse, double fine, double least)
{
    const double got = std::log2(coarse / fine);
    std::printf("%-66s expected 2, got %.2f, least %.1f\n", what, got, least);
    EXPECT_GE(got, least) << what;
}

} // namespace caisson::testing
