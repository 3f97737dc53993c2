#include "constitutive/LinearElastic.h"

#include "constitutive/IndependentIterations.h"

#include <sstream>

namespace caisson {

LinearElastic::LinearElastic(const IsotropicElasticity& elasticity) : elasticity_(elasticity) {}

bool LinearElastic::update(const StressBatch& batch) const
{
    const double lambda = elasticity_.lambda();
    const double twoShear = 2 * elasticity_.shearModulus();
    const double* strainRr = batch.strain[0];
    const double* strainZz = batch.strain[1];
    const double* strainTt = batch.strain[2];
    const double* strainRz = batch.strain[3];
    const double* spin = batch.spin;
    double* rr = batch.stress[0];
    double* zz = batch.stress[1];
    double* tt = batch.stress[2];
    double* rz = batch.stress[3];
    const int size = batch.size;
    CAISSON_INDEPENDENT_ITERATIONS
    for (int i = 0; i < size; ++i) {
        const RotationChange turn = changeByRotation(0.5 * (rr[i] - zz[i]), rz[i], spin[i]);
        const double volumetric = lambda * (strainRr[i] + strainZz[i] + strainTt[i]);
        rr[i] += turn.halfDifference + volumetric + twoShear * strainRr[i];
        zz[i] += -turn.halfDifference + volumetric + twoShear * strainZz[i];
        tt[i] += volumetric + twoShear * strainTt[i];
        rz[i] += turn.shear + 0.5 * twoShear * strainRz[i];
    }
    return false;
}

const std::vector<std::string>& LinearElastic::stateNames() const
{
    static const std::vector<std::string> none;
    return none;
}

std::string LinearElastic::description() const
{
    std::ostringstream line;
    line << "linearElastic, E " << elasticity_.youngsModulus << " Pa, nu " << elasticity_.poissonsRatio;
    return line.str();
}

} // namespace caisson
