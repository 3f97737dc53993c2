// Cost of the stress update per point, in cache-resident batches: ns per point and update, best of several
// runs, for points that stay elastic, that all yield, and a mixture.

#include "constitutive/LinearElastic.h"
#include "constitutive/MohrCoulomb.h"
#include "constitutive/NeoHookean.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>

namespace {

using namespace caisson;

class Points
{
public:
    Points(const ConstitutiveLaw& law, const int size) : size_(size)
    {
        for (auto& component : strain_)
            component.assign(size, 0.0);
        for (auto& component : stress_)
            component.assign(size, 0.0);
        spin_.assign(size, 0.0);
        for (const double value : law.initialState())
            state_.emplace_back(size, value);
        for (auto& variable : state_)
            pointers_.push_back(variable.data());
    }

    /// K0 stress of sand some metres deep; a share of the points is sheared, which makes them yield.
    void fill(const double yieldingShare)
    {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit(-1, 1);
        for (int i = 0; i < size_; ++i) {
            const double vertical = -30e3 * (1.5 + 0.5 * unit(random));
            stress_[0][i] = stress_[2][i] = 0.45 * vertical;
            stress_[1][i] = vertical;
            stress_[3][i] = 1e3 * unit(random);
            const bool yields = 0.5 * (unit(random) + 1) < yieldingShare;
            const double scale = yields ? 2e-3 : 1e-8;
            for (auto& component : strain_)
                component[i] = scale * unit(random);
            strain_[3][i] += yields ? std::copysign(4e-3, unit(random)) : 0;
            spin_[i] = scale * unit(random);
        }
    }

    [[nodiscard]] StressBatch batch()
    {
        StressBatch result;
        result.size = size_;
        for (int k = 0; k < 4; ++k) {
            result.strain[k] = strain_[k].data();
            result.stress[k] = stress_[k].data();
        }
        result.spin = spin_.data();
        result.state = &pointers_;
        return result;
    }

private:
    int size_;
    std::array<std::vector<double>, 4> strain_, stress_;
    std::vector<double> spin_;
    std::vector<std::vector<double>> state_;
    std::vector<double*> pointers_;
};

double nanosecondsPerPoint(const ConstitutiveLaw& law, const double yieldingShare)
{
    constexpr int size = 4096;
    constexpr int updates = 50;
    double best = 1e9;
    for (int run = 0; run < 20; ++run) {
        Points points(law, size);
        points.fill(yieldingShare);
        const StressBatch batch = points.batch();
        const auto start = std::chrono::steady_clock::now();
        for (int k = 0; k < updates; ++k)
            law.update(batch);
        const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
        best = std::min(best, elapsed.count() / (static_cast<double>(size) * updates));
    }
    return best;
}

} // namespace

int main()
{
    const IsotropicElasticity sand{60e6, 0.25};
    constexpr double degree = std::numbers::pi / 180;
    const LinearElastic linear(sand);
    const NeoHookean neoHookean(sand);
    const MohrCoulomb mohrCoulomb(sand, {38 * degree, 1 * degree, 0});
    std::printf("# ns per point and update\n# law yieldingShare ns\n");
    std::printf("linearElastic 0 %.2f\n", nanosecondsPerPoint(linear, 0));
    std::printf("neoHookean 0 %.2f\n", nanosecondsPerPoint(neoHookean, 0));
    for (const double share : {0.0, 0.01, 0.1, 0.5, 1.0})
        std::printf("mohrCoulomb %g %.2f\n", share, nanosecondsPerPoint(mohrCoulomb, share));
    return 0;
}
