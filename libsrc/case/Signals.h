#pragma once

namespace caisson {

/// Catches USR1, USR2, TERM and INT while it lives; a second TERM or INT ends the process at once. An INT
/// that is ignored from the start (a job in the background of a script) stays ignored.
class SignalWatch
{
public:
    SignalWatch();
    ~SignalWatch();
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;

    /// Whether the signal has come; for USR1 and USR2: since the last call.
    static bool came(int signal);
};

} // namespace caisson
