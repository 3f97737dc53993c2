#pragma once

#include "function1/Function1.h"

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace caisson {

using SharedFunction1 = std::shared_ptr<const Function1>;

class Constant final : public Function1
{
public:
    explicit Constant(double value) : value_(value) {}
    [[nodiscard]] double value(double) const override { return value_; }

private:
    double value_;
};

/// Piecewise linear; beyond the ends as outOfBounds says.
class Table final : public Function1
{
public:
    enum class OutOfBounds { error, warn, clamp, repeat };

    /// @param rows  (x, y), x rising
    /// @param where, name  what messages about leaving the table call it
    Table(std::vector<std::array<double, 2>> rows, OutOfBounds outOfBounds, SourceLocation where = {},
          std::string name = {})
        : rows_(std::move(rows)), outOfBounds_(outOfBounds), where_(std::move(where)), name_(std::move(name))
    {
    }
    [[nodiscard]] double value(double x) const override;
    [[nodiscard]] double end() const override;

private:
    void leave(double x) const;

    std::vector<std::array<double, 2>> rows_;
    OutOfBounds outOfBounds_;
    SourceLocation where_;
    std::string name_;
    mutable std::atomic<bool> warned_ = false;
};

/// sum of c x^e
class Polynomial final : public Function1
{
public:
    explicit Polynomial(std::vector<std::array<double, 2>> terms) : terms_(std::move(terms)) {}
    [[nodiscard]] double value(double x) const override;

private:
    std::vector<std::array<double, 2>> terms_; ///< (c, e)
};

/// `shape((x - start)/duration)`, the argument limited to 0 ... 1.
class Ramp final : public Function1
{
public:
    using Shape = double (*)(double);

    Ramp(double start, double duration, Shape shape) : start_(start), duration_(duration), shape_(shape) {}
    [[nodiscard]] double value(double x) const override;

    static double linear(double s) { return s; }
    static double quadratic(double s) { return s * s; }
    static double halfCosine(double s);
    static double quarterSine(double s);
    static double quarterCosine(double s);

private:
    double start_, duration_;
    Shape shape_;
};

/// 1 from start to start + duration, both included; else 0.
class Step final : public Function1
{
public:
    Step(double start, double duration) : start_(start), duration_(duration) {}
    [[nodiscard]] double value(double x) const override
    {
        return x < start_ || x > start_ + duration_ ? 0 : 1;
    }

private:
    double start_, duration_;
};

/// scale amplitude wave(cycles) + level; cycles = frequency (x - t0) or (x - t0)/period.
struct Wave final : public Function1
{
    enum class Kind { sine, cosine, square };

    Kind kind = Kind::sine;
    SharedFunction1 amplitude, frequency, period, scale, level; ///< either frequency or period
    double t0 = 0;
    double markFraction = 0.5; ///< share of a period in which the square wave is +1

    [[nodiscard]] double value(double x) const override;
    [[nodiscard]] double end() const override;
};

/// scale(x) value(x)
class Scale final : public Function1
{
public:
    Scale(SharedFunction1 scale, SharedFunction1 value) : scale_(std::move(scale)), value_(std::move(value))
    {
    }
    [[nodiscard]] double value(double x) const override { return scale_->value(x) * value_->value(x); }
    [[nodiscard]] double end() const override;

private:
    SharedFunction1 scale_, value_;
};

/// value(mapping(x))
class InputValueMapper final : public Function1
{
public:
    InputValueMapper(SharedFunction1 mapping, SharedFunction1 value)
        : mapping_(std::move(mapping)), value_(std::move(value))
    {
    }
    [[nodiscard]] double value(double x) const override { return value_->value(mapping_->value(x)); }
    [[nodiscard]] double end() const override { return mapping_->end(); }

private:
    SharedFunction1 mapping_, value_;
};

/// value(x limited to min ... max)
class LimitRange final : public Function1
{
public:
    LimitRange(double min, double max, SharedFunction1 value) : min_(min), max_(max), value_(std::move(value))
    {
    }
    [[nodiscard]] double value(double x) const override
    {
        return value_->value(x < min_ ? min_ : x > max_ ? max_ : x);
    }
    [[nodiscard]] double end() const override
    {
        return value_->end() < max_ ? value_->end() : Function1::end();
    }

private:
    double min_, max_;
    SharedFunction1 value_;
};

} // namespace caisson
