#include "dictionary/Units.h"

#include <cctype>
#include <charconv>

namespace caisson {

namespace {

struct Unit
{
    std::string_view name;
    Dimensions dimensions;
};

constexpr Unit units[] = {
    {"kg", {1, 0, 0, 0, 0, 0, 0}}, {"m", {0, 1, 0, 0, 0, 0, 0}},   {"s", {0, 0, 1, 0, 0, 0, 0}},
    {"K", {0, 0, 0, 1, 0, 0, 0}},  {"mol", {0, 0, 0, 0, 1, 0, 0}}, {"A", {0, 0, 0, 0, 0, 1, 0}},
    {"Cd", {0, 0, 0, 0, 0, 0, 1}}, {"N", {1, 1, -2, 0, 0, 0, 0}},  {"Pa", {1, -1, -2, 0, 0, 0, 0}},
    {"J", {1, 2, -2, 0, 0, 0, 0}}, {"W", {1, 2, -3, 0, 0, 0, 0}},  {"Hz", {0, 0, -1, 0, 0, 0, 0}},
    {"-", {0, 0, 0, 0, 0, 0, 0}},  {"deg", {0, 0, 0, 0, 0, 0, 0}}, {"rad", {0, 0, 0, 0, 0, 0, 0}},
    {"1", {0, 0, 0, 0, 0, 0, 0}},
};

} // namespace

std::optional<Dimensions> dimensionsOf(std::string_view unit)
{
    if (unit.empty()) {
        return std::nullopt;
    }
    Dimensions result{};
    double sign = 1;
    std::size_t i = 0;
    while (i < unit.size()) {
        if (unit[i] == ' ' || unit[i] == '*') {
            ++i;
            continue;
        }
        if (unit[i] == '/') {
            sign = -1;
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        if (std::isalpha(static_cast<unsigned char>(unit[i]))) {
            while (end < unit.size() && std::isalpha(static_cast<unsigned char>(unit[end]))) {
                ++end;
            }
        }
        const std::string_view name = unit.substr(i, end - i);
        const Unit* found = nullptr;
        for (const Unit& candidate : units) {
            if (candidate.name == name) {
                found = &candidate;
            }
        }
        if (!found) {
            return std::nullopt;
        }
        i = end;
        double power = 1;
        if (name != "1" && name != "-") {
            if (i < unit.size() && unit[i] == '^') {
                ++i;
            }
            const auto parsed = std::from_chars(unit.data() + i, unit.data() + unit.size(), power);
            if (parsed.ec == std::errc()) {
                i = parsed.ptr - unit.data();
            } else {
                power = 1;
            }
        }
        for (std::size_t k = 0; k < result.size(); ++k) {
            result[k] += sign * power * found->dimensions[k];
        }
        sign = 1; // '/' is for the next unit only
    }
    return result;
}

std::string printDimensions(const Dimensions& dimensions)
{
    std::string text = "[";
    for (std::size_t k = 0; k < dimensions.size(); ++k) {
        std::string number = std::to_string(dimensions[k]);
        number.erase(number.find_last_not_of('0') + 1);
        if (number.ends_with('.')) {
            number.pop_back();
        }
        text += (k > 0 ? " " : "") + number;
    }
    return text + "]";
}

} // namespace caisson
