#pragma once

#include "installation/Caisson.h"
#include "installation/Root.h"

#include <limits>
#include <stdexcept>
#include <string>

namespace caisson {

/// Vertical forces of the soil on the skirt [N], upwards positive.
struct Resistance
{
    double outside = 0; ///< friction
    double inside = 0;  ///< friction
    double tip = 0;
    [[nodiscard]] double total() const { return outside + inside + tip; }
};

/// Suctions [Pa] at which something else happens than penetration; infinite where it does not apply.
struct SuctionLimits
{
    double liquefaction = std::numeric_limits<double>::infinity();   ///< no effective stress left in the plug
    double exitGradient = std::numeric_limits<double>::infinity();   ///< piping at the plug's surface
    double reverseBearing = std::numeric_limits<double>::infinity(); ///< soil flows in under the tip
};

/// No suction brings the caisson to this penetration: the plug fails first.
class SuctionLimitReached : public std::runtime_error
{
public:
    SuctionLimitReached(const std::string& message, double penetration, double limit)
        : std::runtime_error(message), penetration_(penetration), limit_(limit)
    {
    }
    [[nodiscard]] double penetration() const { return penetration_; } ///< [m]
    [[nodiscard]] double limit() const { return limit_; }             ///< suction at which it fails [Pa]

private:
    double penetration_;
    double limit_;
};

/// A closed-form design method: resistance and suction of a caisson at a penetration. Pure arithmetic, so
/// that a boundary condition can ask for the suction at the present penetration.
class InstallationMethod
{
public:
    explicit InstallationMethod(const Caisson& caisson) : caisson_(caisson) {}
    virtual ~InstallationMethod() = default;

    /// Resistance at penetration h [m] under a suction [Pa]; zero suction gives the jacking resistance.
    [[nodiscard]] virtual Resistance resistance(double h, double suction) const = 0;
    [[nodiscard]] virtual SuctionLimits limits(double h) const = 0;
    /// Suction above which the method has no answer at penetration h [Pa], and what it is called.
    [[nodiscard]] virtual double greatestSuction(double h) const;
    [[nodiscard]] virtual std::string greatestSuctionName() const { return "no limit"; }

    /// Suction that holds the penetration h, weight + s * plug area = resistance(h, s) [Pa]; zero while the
    /// weight suffices. @throws SuctionLimitReached
    [[nodiscard]] virtual double suction(double h) const
    {
        return solveSuction(h, [&](const double s) { return resistance(h, s).total(); });
    }
    /// Penetration by weight alone [m]; the skirt length where the weight suffices for all of it.
    [[nodiscard]] double selfWeightPenetration() const;
    [[nodiscard]] const Caisson& caisson() const { return caisson_; }

protected:
    /// The balance of forces, with the total resistance as a function of the suction.
    template <class Total>
    [[nodiscard]] double solveSuction(double h, const Total& totalResistance) const;

private:
    [[noreturn]] void throwLimitReached(double h, double limit) const;

    Caisson caisson_;
};

template <class Total>
double InstallationMethod::solveSuction(const double h, const Total& totalResistance) const
{
    const double missing = totalResistance(0.0) - caisson_.submergedWeight;
    if (missing <= 1e-12 * caisson_.submergedWeight)
        return 0;
    const auto surplus = [&](const double s) {
        return caisson_.submergedWeight + s * caisson_.plugArea() - totalResistance(s);
    };
    const double greatest = greatestSuction(h);
    // Without a limit suction does not add resistance, so the suction that lifts the present one suffices.
    const double upper = std::isinf(greatest) ? missing / caisson_.plugArea() : greatest;
    if (surplus(upper) < -1e-12 * missing)
        throwLimitReached(h, upper);
    return increasingRoot(surplus, 0, upper);
}

} // namespace caisson
