#pragma once

#include "timeStepping/TimeStep.h"

#include <functional>
#include <memory>

namespace caisson::testing {

/// A scene, its state and its step, put together without files.
struct Simulation
{
    Scene scene;
    State state;
    std::unique_ptr<TimeStep> step;

    /// Adds a material from the text of its dictionary, e.g. "law linearElastic; youngsModulus 1e6; ...".
    int addMaterial(const std::string& name, const std::string& dictionary);
    /// Conditions per patch from the text of a boundaryField, e.g. "left { type slip; }".
    void setConditions(const std::string& boundaryField);
    /// Conditions on the pore liquid per patch, likewise.
    void setPressures(const std::string& boundaryField);
    /// Fills every cell for which `wanted(r, z)` of its centre holds with n x m points (quadrilaterals) or n
    /// points (triangles: 1 or 3), volumes exact.
    void fill(int material, int n, int m, const std::function<bool(double, double)>& wanted = {});
    /// stress(r, z) -> rr zz tt rz
    void setStress(const std::function<std::array<double, 4>(double, double)>& stress);
    void setVelocity(const std::function<std::array<double, 2>(double, double)>& velocity);
    void start(); ///< chooses the kernel
    /// Steps of at most `courant` of the stable step up to `time`, all equal.
    void run(double time, double courant);
};

} // namespace caisson::testing
