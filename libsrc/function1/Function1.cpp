#include "function1/Function1.h"

#include "dictionary/Text.h"
#include "function1/Function1Types.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <numbers>

namespace caisson {

double Function1::end() const { return std::numeric_limits<double>::infinity(); }

double Table::value(double x) const
{
    const double first = rows_.front()[0];
    const double last = rows_.back()[0];
    if (x < first || x > last) {
        if (outOfBounds_ == OutOfBounds::repeat && last > first) {
            x = first + std::fmod(x - first, last - first);
            x = x < first ? x + (last - first) : x;
        } else {
            leave(x);
        }
    }
    if (x <= first) {
        return rows_.front()[1];
    }
    if (x >= last) {
        return rows_.back()[1];
    }
    const auto above =
        std::ranges::upper_bound(rows_, x, {}, [](const std::array<double, 2>& row) { return row[0]; });
    const auto& [x1, y1] = *above;
    const auto& [x0, y0] = *(above - 1);
    return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

void Table::leave(double x) const
{
    constexpr double roundOff = 1e-9;
    const double first = rows_.front()[0];
    const double last = rows_.back()[0];
    const double slack = roundOff * (last - first);
    if (outOfBounds_ == OutOfBounds::clamp || (x >= first - slack && x <= last + slack)) {
        return;
    }
    const std::string what =
        text("the table of '%s' goes from %g to %g, but %g is asked for", name_.c_str(), first, last, x);
    if (outOfBounds_ == OutOfBounds::error) {
        throw InputError(where_.file, {{where_, what, "add rows, or choose outOfBounds clamp or repeat"}});
    }
    if (!warned_.exchange(true)) {
        std::cerr << "--> CAISSONFOAM Warning : " << where_.file << ":" << where_.line << ": " << what
                  << "; its end value is used\n";
    }
}

double Table::end() const { return outOfBounds_ == OutOfBounds::error ? rows_.back()[0] : Function1::end(); }

double Polynomial::value(double x) const
{
    double sum = 0;
    for (const auto& [coefficient, exponent] : terms_) {
        sum += coefficient * std::pow(x, exponent);
    }
    return sum;
}

double Ramp::value(double x) const { return shape_(std::clamp((x - start_) / duration_, 0.0, 1.0)); }

double Ramp::halfCosine(double s) { return 0.5 * (1 - std::cos(std::numbers::pi * s)); }
double Ramp::quarterSine(double s) { return std::sin(0.5 * std::numbers::pi * s); }
double Ramp::quarterCosine(double s) { return 1 - std::cos(0.5 * std::numbers::pi * s); }

double Wave::value(double x) const
{
    const double cycles = frequency ? frequency->value(x) * (x - t0) : (x - t0) / period->value(x);
    const double phase = 2 * std::numbers::pi * cycles;
    const double wave = kind == Kind::sine                           ? std::sin(phase)
                        : kind == Kind::cosine                       ? std::cos(phase)
                        : cycles - std::floor(cycles) < markFraction ? 1.0
                                                                     : -1.0;
    return level->value(x) + scale->value(x) * amplitude->value(x) * wave;
}

double Wave::end() const
{
    const double rate = frequency ? frequency->end() : period->end();
    return std::min({rate, amplitude->end(), scale->end(), level->end()});
}

double Scale::end() const { return std::min(scale_->end(), value_->end()); }

std::unique_ptr<Function1> constantFunction1(double value) { return std::make_unique<Constant>(value); }

std::array<double, 3> VectorFunction1::value(double x) const
{
    return {component[0]->value(x), component[1]->value(x), component[2]->value(x)};
}

} // namespace caisson
