#include "timeStepping/Threads.h"

#include <utility>

namespace caisson {

namespace {

/// Waits while `value` is `old`.
void waitWhile(const std::atomic<int>& value, int old)
{
    constexpr int looks = 10000; // some hundred microseconds
    for (int i = 0; i < looks; ++i) {
        if (value.load(std::memory_order_acquire) != old) {
            return;
        }
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#endif
    }
    value.wait(old, std::memory_order_acquire);
}

} // namespace

Threads::Threads(int count) : cursors_(count), bounds_(count + 1)
{
    failures_.resize(count);
    for (int part = 1; part < count; ++part) {
        workers_.emplace_back([this, part] { serve(part); });
    }
}

Threads::~Threads()
{
    ends_ = true;
    ++round_;
    round_.notify_all();
    for (std::thread& worker : workers_) {
        worker.join();
    }
}

void Threads::start(Call call, const void* job)
{
    call_ = call;
    job_ = job;
    busy_.store(static_cast<int>(workers_.size()), std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
}

void Threads::finish()
{
    runPart(0);
    for (int busy = busy_.load(std::memory_order_acquire); busy != 0;
         busy = busy_.load(std::memory_order_acquire)) {
        waitWhile(busy_, busy);
    }
    for (std::exception_ptr& failure : failures_) {
        if (failure) {
            std::rethrow_exception(std::exchange(failure, nullptr));
        }
    }
}

void Threads::lap(bool counts)
{
    if (workers_.empty()) {
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (counts && ++laps_ > settlingLaps) {
        window_ += std::chrono::duration<double>(now - lapped_).count();
    }
    lapped_ = now;
    if (laps_ < settlingLaps + wanted_) {
        return;
    }
    const double time = window_ / wanted_;
    window_ = 0;
    laps_ = 0;
    if (!probes_) { // look at the other way for a moment
        kept_ = time;
        alone_ = !alone_;
        probes_ = true;
        wanted_ = probedLaps;
        return;
    }
    probes_ = false;
    if (time > 0.9 * kept_) {
        alone_ = !alone_;
        trusted_ = std::min(2 * trusted_, mostTrusted);
    } else {
        trusted_ = leastTrusted;
    }
    wanted_ = trusted_;
}

void Threads::serve(int part)
{
    for (int round = 0;; ++round) {
        waitWhile(round_, round);
        if (ends_) {
            return;
        }
        runPart(part);
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
            busy_.notify_one();
        }
    }
}

void Threads::runPart(int part)
{
    try {
        call_(job_, part);
    } catch (...) {
        failures_[part] = std::current_exception();
    }
}

int threadsFor(int wanted, std::size_t points)
{
    constexpr std::size_t leastPerThread = 5000; // below, waiting for each other costs what is gained
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int useful = std::max(1, static_cast<int>(points / leastPerThread));
    return wanted > 0 ? wanted : std::min(processors, useful);
}

} // namespace caisson
