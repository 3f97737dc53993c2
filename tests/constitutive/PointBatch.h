#pragma once

#include "constitutive/ConstitutiveLaw.h"

namespace caisson::testing {

/// Storage of a batch of points for a law under test, all zero strain and zero stress at first.
class PointBatch
{
public:
    explicit PointBatch(const ConstitutiveLaw& law, const int size = 1) : law_(law), spin(size, 0.0)
    {
        for (auto& component : strain)
            component.assign(size, 0.0);
        for (auto& component : stress)
            component.assign(size, 0.0);
        for (const double value : law.initialState())
            state.emplace_back(size, value);
    }

    /// @returns what the law says: whether some of them yield
    bool update()
    {
        std::vector<double*> pointers;
        for (auto& variable : state)
            pointers.push_back(variable.data());
        StressBatch batch;
        batch.size = static_cast<int>(spin.size());
        for (int k = 0; k < 4; ++k) {
            batch.strain[k] = strain[k].data();
            batch.stress[k] = stress[k].data();
        }
        batch.spin = spin.data();
        batch.state = &pointers;
        return law_.update(batch);
    }

private:
    const ConstitutiveLaw& law_;

public:
    std::array<std::vector<double>, 4> strain, stress; ///< rr, zz, tt, rz
    std::vector<double> spin;
    std::vector<std::vector<double>> state; ///< [variable][point]
};

} // namespace caisson::testing
