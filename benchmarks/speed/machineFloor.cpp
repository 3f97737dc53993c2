// What the machine itself can do, on one thread: bandwidth of memory and of the second-level cache, and the
// rate of double-precision multiply-adds. The floor under every figure of speed.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

double seconds()
{
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// a = b + s c over arrays of n numbers [GB/s], best of several.
double triad(std::size_t n)
{
    std::vector<double> a(n, 0), b(n, 1), c(n, 2);
    const std::size_t rounds = std::max<std::size_t>(1, 20'000'000 / n);
    double best = 0;
    for (int trial = 0; trial < 7; ++trial) {
        const double start = seconds();
        for (std::size_t round = 0; round < rounds; ++round) {
            const double s = 1e-9 * static_cast<double>(round);
            for (std::size_t i = 0; i < n; ++i) {
                a[i] = b[i] + s * c[i];
            }
            asm volatile("" : : "r"(a.data()) : "memory");
        }
        best = std::max(best, 24e-9 * static_cast<double>(n * rounds) / (seconds() - start));
    }
    return best;
}

/// Multiply-adds on 64 independent numbers [GFlop/s].
double multiplyAdds()
{
    double best = 0;
    for (int trial = 0; trial < 7; ++trial) {
        double x[64];
        std::fill_n(x, 64, 1.0);
        constexpr int rounds = 1'000'000;
        const double start = seconds();
        for (int round = 0; round < rounds; ++round) {
            for (double& value : x) {
                value = value * 0.999999 + 1e-6;
            }
        }
        asm volatile("" : : "r"(x) : "memory");
        best = std::max(best, 128e-9 * rounds / (seconds() - start));
    }
    return best;
}

} // namespace

int main()
{
    std::printf("| memory %.1f GB/s | second-level cache %.1f GB/s | multiply-adds %.1f GFlop/s |\n",
                triad(8'000'000), triad(20'000), multiplyAdds());
}
