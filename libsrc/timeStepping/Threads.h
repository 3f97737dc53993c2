#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace caisson {

/// Threads that share the loops of a step. They wait for work by looking for some microseconds, for the next
/// loop comes soon, and asleep after that, so that a busy machine is not made busier.
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
        if (workers_.empty()) {
            work(0);
            return;
        }
        start([](const void* job, int part) { (*static_cast<const Work*>(job))(part); }, &work);
        finish();
    }

    /// First of `items` that belongs to a part; those of part p end where those of p + 1 begin.
    [[nodiscard]] int first(int items, int part) const
    {
        return static_cast<int>(static_cast<long long>(items) * part / count());
    }

private:
    using Call = void (*)(const void* job, int part);

    void start(Call call, const void* job);
    void finish();
    void serve(int part);
    void runPart(int part);

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
