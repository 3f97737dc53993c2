#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <span>
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

    /// Runs work(thread, begin, end) for pieces of `items`, that of the first part from bounds[0] to before
    /// bounds[1] and so on. A thread takes the pieces of its own part, which lie in its cache from the loop
    /// before, and then of what others have not come to. Threads come from opposite ends of their parts, and
    /// from the end that is the farthest from the owner to those of others: of two threads, one goes up and
    /// one down, and only what lies where they meet passes from cache to cache. Pieces begin at multiples of
    /// `piece` in their part.
    template <class Work>
    void share(std::span<const int> bounds, int piece, const Work& work)
    {
        if (workers_.empty() || alone_) {
            for (int part = 0; part < count(); ++part) {
                if (bounds[part] < bounds[part + 1]) {
                    work(0, bounds[part], bounds[part + 1]);
                }
            }
            return;
        }
        for (Cursor& cursor : cursors_) {
            cursor.taken.store(0, std::memory_order_relaxed);
        }
        run([&](int thread) {
            for (int turn = 0; turn < count(); ++turn) {
                const int part = (thread + turn) % count();
                const int first = bounds[part];
                const int end = bounds[part + 1];
                const int pieces = (end - first + piece - 1) / piece;
                const bool ownerGoesUp = part % 2 == 0;
                const bool fromTheFront = ownerGoesUp == (turn == 0);
                for (int i = cursors_[part].take(pieces, fromTheFront); i < pieces;
                     i = cursors_[part].take(pieces, fromTheFront)) {
                    work(thread, first + i * piece, std::min(first + (i + 1) * piece, end));
                }
            }
        });
    }

    /// The same with parts of about equal size, which begin at multiples of `piece`, too: loops that the
    /// compiler makes work on vectors round what is left over in another way, and pieces of a multiple of any
    /// vector's length give the bits of the whole.
    template <class Work>
    void share(int items, int piece, const Work& work)
    {
        const int pieces = (items + piece - 1) / piece;
        for (int part = 0; part <= count(); ++part) {
            const long long first = static_cast<long long>(pieces) * part / count();
            bounds_[part] = static_cast<int>(std::min<long long>(items, piece * first));
        }
        share(bounds_, piece, work);
    }

    /// Ends a round of loops that is like the one before, or (not `counts`) one that is not. From the time
    /// that they take all threads work, or the first alone, whichever is the faster: looked at every some
    /// hundred or thousand rounds.
    void lap(bool counts);

private:
    /// What has been taken of the pieces of a part; on a line of the cache of its own.
    struct alignas(64) Cursor
    {
        std::atomic<long long> taken = 0; ///< those from the front, and 2^32 times those from the back

        /// The next piece from the front or the back, or `pieces` where none is left.
        int take(int pieces, bool fromTheFront)
        {
            constexpr long long ofBack = 1LL << 32;
            const long long before = taken.fetch_add(fromTheFront ? 1 : ofBack, std::memory_order_relaxed);
            const int front = static_cast<int>(before % ofBack);
            const int back = static_cast<int>(before / ofBack);
            if (front + back >= pieces) {
                return pieces;
            }
            return fromTheFront ? front : pieces - 1 - back;
        }
    };

    using Call = void (*)(const void* job, int part);
    static constexpr int settlingLaps = 30; ///< in which threads that have slept find their processors
    static constexpr int probedLaps = 20;
    static constexpr int leastTrusted = 400; ///< doubled whenever the other way is the slower one again
    static constexpr int mostTrusted = 3200;

    void start(Call call, const void* job);
    void finish();
    void serve(int part);
    void runPart(int part);

    bool alone_ = false;  ///< the first thread does it all
    bool probes_ = false; ///< the other way than what was the faster one
    int laps_ = 0;
    int wanted_ = probedLaps; ///< of them, before the other way is looked at
    int trusted_ = leastTrusted;
    double window_ = 0; ///< their time [s]
    double kept_ = 0;   ///< per lap, of what was the faster way [s]
    std::chrono::steady_clock::time_point lapped_ = std::chrono::steady_clock::now();
    Call call_ = nullptr;
    const void* job_ = nullptr;
    std::vector<std::exception_ptr> failures_;
    std::vector<Cursor> cursors_; ///< per part
    std::vector<int> bounds_;     ///< of parts of equal size
    std::atomic<int> round_ = 0;  ///< rises with every loop
    std::atomic<int> busy_ = 0;   ///< workers that have not finished it
    std::atomic<bool> ends_ = false;
    std::vector<std::thread> workers_;
};

/// Threads for a scene: as many as asked for, or (0) the processors where that many points are worth it.
int threadsFor(int wanted, std::size_t points);

} // namespace caisson
