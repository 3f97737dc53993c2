#pragma once

#include <array>
#include <exception>

namespace caisson {

inline constexpr int mostThreads = 64;

/// Runs work(part) for part = 0 .. parts-1, each part on a thread of its own, and waits for all. What the
/// first part that failed has thrown is thrown on. Parts must not write what another one reads.
template <class Work>
void runParts(int parts, const Work& work)
{
    if (parts == 1) {
        work(0);
        return;
    }
    std::array<std::exception_ptr, mostThreads> failures;
#pragma omp parallel for num_threads(parts) schedule(static, 1)
    for (int part = 0; part < parts; ++part) {
        try {
            work(part);
        } catch (...) {
            failures[part] = std::current_exception();
        }
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) {
            std::rethrow_exception(failure);
        }
    }
}

/// First of `count` items that belongs to a part; those of part p end where those of p + 1 begin.
inline int firstOfPart(int count, int part, int parts)
{
    return static_cast<int>(static_cast<long long>(count) * part / parts);
}

/// Threads for a scene: as many as asked for, or (0) the processors where that many points are worth it.
int threadsFor(int wanted, std::size_t points);

} // namespace caisson
