#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace caisson {

/// Material points, one array per quantity. Stress is effective stress, tension positive [Pa], components
/// rr, zz, tt (hoop, or out of plane), rz. Volume and mass are per radian (axisymmetric: area times r) or
/// per metre of thickness (plane strain).
struct MaterialPoints
{
    std::vector<double> r, z;                  ///< place [m]
    std::vector<double> vr, vz;                ///< velocity of the solid [m/s]
    std::vector<double> mass;                  ///< [kg/rad] or [kg/m]
    std::vector<double> volume;                ///< [m3/rad] or [m2]
    std::array<std::vector<double>, 4> stress; ///< rr zz tt rz [Pa]
    std::vector<std::vector<double>> state;    ///< variables of the constitutive laws, [variable][point]
    std::vector<int> cell;                     ///< background cell
    std::vector<int> material;                 ///< index into the scene's materials
    std::vector<int> id;                       ///< stays with the point for its life
    std::vector<double> initialR, initialZ;    ///< place at the start of the simulation [m]
    /// Two-phase soil only, otherwise empty: velocity of the pore liquid [m/s], and its pressure, compression
    /// positive [Pa].
    std::vector<double> wr, wz, porePressure;
    /// With affine transfer only, otherwise empty: the gradient of its velocity that a point brings to the
    /// nodes, rr rz zr zz with the component first [1/s].
    std::array<std::vector<double>, 4> gradient;
    /// With point loads only, otherwise empty: index of the point's load or -1, the area that it acts on
    /// at the start [m2/rad] or [m], and how far from the point the loaded surface was then [m].
    std::vector<int> load;
    std::vector<double> loadArea, loadReachR, loadReachZ;

    [[nodiscard]] std::size_t size() const { return r.size(); }
    [[nodiscard]] bool twoPhase() const { return !porePressure.empty(); }
    [[nodiscard]] bool affine() const { return !gradient[0].empty(); }
    [[nodiscard]] bool loaded() const { return !load.empty(); }
    void resize(std::size_t points, std::size_t stateVariables);
    /// Adds the liquid, moving with the solid, at zero pressure.
    void addLiquid();
    /// Physically reorders every array: new item i is old item order[i].
    void reorder(const std::vector<int>& order);
    /// Calls change(array) for every array that these points have.
    template <class Change>
    void forEachArray(const Change& change)
    {
        for (std::vector<double>* array : {&r, &z, &vr, &vz, &mass, &volume, &initialR, &initialZ}) {
            change(*array);
        }
        if (twoPhase()) {
            for (std::vector<double>* array : {&wr, &wz, &porePressure}) {
                change(*array);
            }
        }
        if (affine()) {
            for (std::vector<double>& component : gradient) {
                change(component);
            }
        }
        for (std::vector<double>& component : stress) {
            change(component);
        }
        for (std::vector<double>& variable : state) {
            change(variable);
        }
        for (std::vector<int>* array : {&cell, &material, &id}) {
            change(*array);
        }
        if (loaded()) {
            change(load);
            for (std::vector<double>* array : {&loadArea, &loadReachR, &loadReachZ}) {
                change(*array);
            }
        }
    }
};

} // namespace caisson
