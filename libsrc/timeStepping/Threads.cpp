#include "timeStepping/Threads.h"

#include <algorithm>
#include <thread>

namespace caisson {

int threadsFor(int wanted, std::size_t points)
{
    constexpr std::size_t leastPerThread = 5000; // below, waiting for each other costs what is gained
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int useful = std::max(1, static_cast<int>(points / leastPerThread));
    return std::min(wanted > 0 ? wanted : std::min(processors, useful), mostThreads);
}

} // namespace caisson
