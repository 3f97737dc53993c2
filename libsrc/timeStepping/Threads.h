#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace caisson {

/// Threads that share the loops of a step. They wait for work by looking for some microseconds, for the next
/// loop comes soon, and asleep after that, so that a busy machine is not made busier. Where others compute,
/// too, a thread that must wait for its processor holds up all others: then the first one does the parts of
/// all.
class Threads
{
public:
    explicit Threads(int count);
    ~Threads();
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

    [[nodiscard]] int count() const { return static_cast<int>(workers_.size()) + 1; }

    /// Runs work(part) for part = 0 .. count() - 1, each on a thread of its own, and waits for all. What the
    /// first part that failed has thrown is thrown on. Parts must not write what another one reads.
    template <class Work>
    void run(const Work& work)
    {
        if (workers_.empty() || alone_) {
            for (int part = 0; part < count(); ++part) {
                work(part);
            }
            return;
        }
        start([](const void* job, int part) { (*static_cast<const Work*>(job))(part); }, &work);
        finish();
    }

    /// Ends a round of loops that is like the one before, or (not `counts`) one that is not. From the time
    /// that they take all threads work, or the first alone, whichever is the faster: looked at every some
    /// hundred rounds.
    void lap(bool counts);

    /// First of `items` that belongs to a part; those of part p end where those of p + 1 begin.
    [[nodiscard]] int first(int items, int part) const
    {
        return static_cast<int>(static_cast<long long>(items) * part / count());
    }

private:
    using Call = void (*)(const void* job, int part);
    static constexpr int trustedLaps = 400;
    static constexpr int probedLaps = 25;

    void start(Call call, const void* job);
    void finish();
    void serve(int part);
    void runPart(int part);

    bool alone_ = false;  ///< the first thread does it all
    bool probes_ = false; ///< the other way than what was the faster one
    int laps_ = 0;
    int wanted_ = probedLaps; ///< of them, before the other way is looked at
    double window_ = 0;       ///< their time [s]
    double kept_ = 0;         ///< per lap, of what was the faster way [s]
    std::chrono::steady_clock::time_point lapped_ = std::chrono::steady_clock::now();
    Call call_ = nullptr;
    const void* job_ = nullptr;
    std::vector<std::exception_ptr> failures_;
    std::atomic<int> round_ = 0; ///< rises with every loop
    std::atomic<int> busy_ = 0;  ///< workers that have not finished it
    std::atomic<bool> ends_ = false;
    std::vector<std::thread> workers_;
};

/// Threads for a scene: as many as asked for, or (0) the processors where that many points are worth it.
int threadsFor(int wanted, std::size_t points);

} // namespace caisson
