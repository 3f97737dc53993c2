#include "materialPoints/MaterialPoints.h"

#include <type_traits>

namespace caisson {

void MaterialPoints::resize(std::size_t points, std::size_t stateVariables)
{
    state.resize(stateVariables);
    forEachArray([points](auto& array) { array.resize(points); });
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
    forEachArray([&](auto& array) {
        if constexpr (std::is_same_v<decltype(array), std::vector<int>&>) {
            pick(array, labels);
        } else {
            pick(array, numbers);
        }
    });
}

} // namespace caisson
