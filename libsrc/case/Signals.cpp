#include "case/Signals.h"

#include <array>
#include <atomic>
#include <csignal>

namespace caisson {

namespace {

struct Watched
{
    int signal;
    bool once; ///< the second one is not for us
    std::atomic<bool> came = false;
    struct sigaction previous = {};
};
// A signal handler takes no argument but the number, so this is global.
std::array<Watched, 4> watched{{{SIGUSR1, false}, {SIGUSR2, false}, {SIGTERM, true}, {SIGINT, true}}};
static_assert(std::atomic<bool>::is_always_lock_free, "needed in a signal handler");

void remember(int signal)
{
    for (Watched& one : watched) {
        if (one.signal == signal && one.came.exchange(true) && one.once) {
            std::signal(signal, SIG_DFL);
            std::raise(signal);
        }
    }
}

} // namespace

SignalWatch::SignalWatch()
{
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (Watched& one : watched) {
        one.came = false;
        sigaction(one.signal, &action, &one.previous);
        if (one.signal == SIGINT && one.previous.sa_handler == SIG_IGN) {
            sigaction(one.signal, &one.previous, nullptr);
        }
    }
}

SignalWatch::~SignalWatch()
{
    for (const Watched& one : watched) {
        sigaction(one.signal, &one.previous, nullptr);
    }
}

bool SignalWatch::came(int signal)
{
    for (Watched& one : watched) {
        if (one.signal == signal) {
            return one.once ? one.came.load() : one.came.exchange(false);
        }
    }
    return false;
}

} // namespace caisson
