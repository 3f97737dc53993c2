#include "constitutive/NeoHookean.h"

#include <cmath>
#include <sstream>

namespace caisson {

NeoHookean::NeoHookean(const IsotropicElasticity& elasticity) : elasticity_(elasticity) {}

bool NeoHookean::update(const StressBatch& batch) const
{
    const double lambda = elasticity_.lambda();
    const double mu = elasticity_.shearModulus();
    const auto& state = *batch.state;
    double* frr = state[0];
    double* frz = state[1];
    double* fzr = state[2];
    double* fzz = state[3];
    double* ftt = state[4];
    const int size = batch.size;
    for (int i = 0; i < size; ++i) {
        const double lrr = 1 + batch.strain[0][i];
        const double lrz = 0.5 * batch.strain[3][i] - batch.spin[i];
        const double lzr = 0.5 * batch.strain[3][i] + batch.spin[i];
        const double lzz = 1 + batch.strain[1][i];
        const double rr = lrr * frr[i] + lrz * fzr[i];
        const double rz = lrr * frz[i] + lrz * fzz[i];
        const double zr = lzr * frr[i] + lzz * fzr[i];
        const double zz = lzr * frz[i] + lzz * fzz[i];
        const double tt = (1 + batch.strain[2][i]) * ftt[i];
        frr[i] = rr;
        frz[i] = rz;
        fzr[i] = zr;
        fzz[i] = zz;
        ftt[i] = tt;

        const double volumeRatio = (rr * zz - rz * zr) * tt;
        const double volumetric = lambda * std::log(volumeRatio) - mu;
        const double scale = 1 / volumeRatio;
        batch.stress[0][i] = scale * (volumetric + mu * (rr * rr + rz * rz));
        batch.stress[1][i] = scale * (volumetric + mu * (zr * zr + zz * zz));
        batch.stress[2][i] = scale * (volumetric + mu * tt * tt);
        batch.stress[3][i] = scale * mu * (rr * zr + rz * zz);
    }
    return false;
}

const std::vector<std::string>& NeoHookean::stateNames() const
{
    static const std::vector<std::string> names{"F_rr", "F_rz", "F_zr", "F_zz", "F_tt"};
    return names;
}

std::string NeoHookean::description() const
{
    std::ostringstream line;
    line << "neoHookean, E " << elasticity_.youngsModulus << " Pa, nu " << elasticity_.poissonsRatio;
    return line.str();
}

} // namespace caisson
