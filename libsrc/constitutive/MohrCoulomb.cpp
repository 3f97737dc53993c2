#include "constitutive/MohrCoulomb.h"

#include "constitutive/IndependentIterations.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace caisson {
namespace {

constexpr int chunkSize = 256;

} // namespace

MohrCoulomb::MohrCoulomb(const IsotropicElasticity& elasticity, const MohrCoulombStrength& strength,
                         std::string name)
    : elasticity_(elasticity), strength_(strength), surface_(elasticity, strength), name_(std::move(name))
{
    if (!surface_.wellPosed())
        throw std::invalid_argument(
            "contractant flow at this Poisson's ratio leaves the return to the yield surface undefined");
}

bool MohrCoulomb::update(const StressBatch& batch) const
{
    bool yields = false;
    for (int begin = 0; begin < batch.size; begin += chunkSize)
        yields = updateChunk(batch, begin, std::min(chunkSize, batch.size - begin)) || yields;
    return yields;
}

bool MohrCoulomb::updateChunk(const StressBatch& batch, const int begin, const int size) const
{
    const MohrCoulombSurface surface = surface_; // a copy cannot alias the arrays
    const double lambda = elasticity_.lambda();
    const double twoShear = 2 * elasticity_.shearModulus();
    const double bulk = elasticity_.bulkModulus();
    const double* strainRr = batch.strain[0] + begin;
    const double* strainZz = batch.strain[1] + begin;
    const double* strainTt = batch.strain[2] + begin;
    const double* strainRz = batch.strain[3] + begin;
    const double* spin = batch.spin + begin;
    double* rr = batch.stress[0] + begin;
    double* zz = batch.stress[1] + begin;
    double* tt = batch.stress[2] + begin;
    double* rz = batch.stress[3] + begin;
    double* plasticShearStrain = (*batch.state)[0] + begin;
    double* opening = (*batch.state)[1] + begin;

    // Elastic trial stress of all points. An opening adds the stress that it took away, so that the apex is
    // left only when it has closed.
    alignas(64) std::array<double, chunkSize> excess;
    alignas(64) std::array<double, chunkSize> radius;
    CAISSON_INDEPENDENT_ITERATIONS
    for (int i = 0; i < size; ++i) {
        const RotationChange turn = changeByRotation(0.5 * (rr[i] - zz[i]), rz[i], spin[i]);
        const double volumetric = lambda * (strainRr[i] + strainZz[i] + strainTt[i]) + bulk * opening[i];
        rr[i] += turn.halfDifference + volumetric + twoShear * strainRr[i];
        zz[i] += -turn.halfDifference + volumetric + twoShear * strainZz[i];
        tt[i] += volumetric + twoShear * strainTt[i];
        rz[i] += turn.shear + 0.5 * twoShear * strainRz[i];
        opening[i] = 0;

        const double mean = 0.5 * (rr[i] + zz[i]);
        const double halfDifference = 0.5 * (rr[i] - zz[i]);
        radius[i] = std::sqrt(halfDifference * halfDifference + rz[i] * rz[i]);
        const double major = mean + radius[i];
        const double minor = mean - radius[i];
        const double largest = major > tt[i] ? major : tt[i];
        const double smallest = minor < tt[i] ? minor : tt[i];
        excess[i] = surface.excess(largest, smallest);
    }

    // 2/3 of the deviator's square is 2/9 of the sum of the squared differences.
    const double compliance = std::sqrt(2.0) / (3 * twoShear);
    const bool gapClosing = strength_.gapClosing;
    const auto returnPoint = [&](int i) __attribute__((always_inline))
    {
        const bool yields = excess[i] > 0;
        const double mean = 0.5 * (rr[i] + zz[i]);
        const double major = mean + radius[i];
        const double minor = mean - radius[i];
        const double hoop = tt[i];
        const bool hoopIsLargest = hoop >= major;
        const bool hoopIsSmallest = hoop <= minor;
        const MohrCoulombSurface::Principal trial{hoopIsLargest ? hoop : major,
                                                  hoopIsLargest    ? major
                                                  : hoopIsSmallest ? minor
                                                                   : hoop,
                                                  hoopIsSmallest ? hoop : minor};
        const MohrCoulombSurface::Return result = surface.returned(trial);

        const std::array<double, 3> taken{trial[0] - result.stress[0], trial[1] - result.stress[1],
                                          trial[2] - result.stress[2]};
        const double taken12 = taken[0] - taken[1];
        const double taken23 = taken[1] - taken[2];
        const double taken13 = taken[0] - taken[2];
        const double sheared =
            compliance * std::sqrt(taken12 * taken12 + taken23 * taken23 + taken13 * taken13);
        const double opened = (taken[0] + taken[1] + taken[2]) / (3 * bulk);
        plasticShearStrain[i] += yields ? sheared : 0;
        opening[i] =
            (yields & gapClosing & (result.region == ReturnRegion::apex) & (opened > 0)) ? opened : 0;

        // The return keeps the order of the stresses and the axes of the in-plane pair.
        const double newMajor = hoopIsLargest ? result.stress[1] : result.stress[0];
        const double newMinor = hoopIsSmallest ? result.stress[1] : result.stress[2];
        const double newHoop = hoopIsLargest    ? result.stress[0]
                               : hoopIsSmallest ? result.stress[2]
                                                : result.stress[1];
        const double newMean = 0.5 * (newMajor + newMinor);
        const double shrink = radius[i] > 0 ? 0.5 * (newMajor - newMinor) / radius[i] : 0;
        const double halfDifference = 0.5 * (rr[i] - zz[i]) * shrink;
        rr[i] = yields ? newMean + halfDifference : rr[i];
        zz[i] = yields ? newMean - halfDifference : zz[i];
        tt[i] = yields ? newHoop : hoop;
        rz[i] = yields ? rz[i] * shrink : rz[i];
    };
    const auto anyYields = [&excess](int from, int to) {
        std::int64_t any = 0;
        for (int i = from; i < to; ++i)
            any |= excess[i] > 0 ? std::int64_t{1} : std::int64_t{0};
        return any != 0;
    };
    bool yields = false;
    constexpr int group = 8; // computed together where one of them yields
    const int whole = size / group * group;
    for (int from = 0; from < whole; from += group) {
        if (anyYields(from, from + group)) {
            yields = true;
            CAISSON_INDEPENDENT_ITERATIONS
            for (int i = from; i < from + group; ++i)
                returnPoint(i);
        }
    }
    for (int i = whole; i < size; ++i) {
        if (excess[i] > 0) {
            yields = true;
            returnPoint(i);
        }
    }
    return yields;
}

const std::vector<std::string>& MohrCoulomb::stateNames() const
{
    static const std::vector<std::string> names{"plasticShearStrain", "tensileVolumetricStrain"};
    return names;
}

std::string MohrCoulomb::description() const
{
    constexpr double degrees = 180 / std::numbers::pi;
    std::ostringstream line;
    line << name_ << ", E " << elasticity_.youngsModulus << " Pa, nu " << elasticity_.poissonsRatio;
    if (strength_.frictionAngle > 0)
        line << ", phi " << strength_.frictionAngle * degrees << " deg, psi "
             << strength_.dilatancyAngle * degrees << " deg";
    line << ", c " << strength_.cohesion << " Pa";
    return line.str();
}

} // namespace caisson
