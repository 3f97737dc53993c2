#pragma once

namespace caisson {

/// Notices pore pressures that alternate from cell to cell. Smooth ones have a checkerboard index of 0.1 at
/// most, once there are pressures at all: a start from rest, or a moment without any, says nothing.
class CheckerboardWatch
{
public:
    static constexpr int interval = 500; ///< steps between two looks
    static constexpr double rough = 0.8; ///< the index from which on they are not to be trusted
    static constexpr int looks = 5;      ///< one after the other, before it is said

    /// @returns whether this is to be said now: once in a run
    [[nodiscard]] bool warns(double index)
    {
        roughLooks_ = index > rough ? roughLooks_ + 1 : 0;
        const bool now = !warned_ && roughLooks_ == looks;
        warned_ = warned_ || now;
        return now;
    }

private:
    int roughLooks_ = 0; ///< one after the other
    bool warned_ = false;
};

} // namespace caisson
