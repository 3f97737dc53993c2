#include "materialPoints/MaterialPoints.h"

#include <type_traits>

namespace caisson {

namespace {

/// Calls `change` with every array.
template <typename Change>
void forEachArray(MaterialPoints& points, const Change& change)
{
    for (std::vector<double>* array : {&points.r, &points.z, &points.vr, &points.vz, &points.mass,
                                       &points.volume, &points.initialR, &points.initialZ}) {
        change(*array);
    }
    if (points.twoPhase()) {
        for (std::vector<double>* array : {&points.wr, &points.wz, &points.porePressure}) {
            change(*array);
        }
    }
    if (points.affine()) {
        for (std::vector<double>& component : points.gradient) {
            change(component);
        }
    }
    for (std::vector<double>& component : points.stress) {
        change(component);
    }
    for (std::vector<double>& variable : points.state) {
        change(variable);
    }
    for (std::vector<int>* array : {&points.cell, &points.material, &points.id}) {
        change(*array);
    }
    if (points.loaded()) {
        change(points.loadArea);
        change(points.loadReachR);
        change(points.loadReachZ);
        change(points.load);
    }
}

} // namespace

void MaterialPoints::resize(std::size_t points, std::size_t stateVariables)
{
    state.resize(stateVariables);
    forEachArray(*this, [points](auto& array) { array.resize(points); });
}

void MaterialPoints::addLiquid()
{
    wr = vr;
    wz = vz;
    porePressure.assign(size(), 0);
}

void MaterialPoints::reorder(const std::vector<int>& order)
{
    std::vector<double> numbers;
    std::vector<int> labels;
    const auto pick = [&order](auto& array, auto& scratch) {
        scratch.resize(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            scratch[i] = array[order[i]];
        }
        array.swap(scratch);
    };
    forEachArray(*this, [&](auto& array) {
        if constexpr (std::is_same_v<decltype(array), std::vector<int>&>) {
            pick(array, labels);
        } else {
            pick(array, numbers);
        }
    });
}

} // namespace caisson
