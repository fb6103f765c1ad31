// The functions of functions.py. Sums run from the first element on, as Python's sum() does.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rddl_extern {

inline void mix_along(std::span<const double> heat, std::span<const double> height, double vent,
                      std::span<double> result) {
    for (std::size_t s = 0; s < heat.size(); ++s)
        result[s] = heat[s] * std::exp(-height[s] / 500.0) - vent * heat[0];
}

template <std::size_t sites, std::size_t layers>
void spread(std::span<const std::array<double, layers>, sites> flow,
            std::span<const bool, sites> burn, std::span<std::array<double, layers>, sites> result) {
    for (std::size_t s = 0; s < sites; ++s)
        for (std::size_t l = 0; l < layers; ++l)
            result[s][l] = flow[(s + 1) % sites][l] + (burn[s] ? 2.0 : 0.0);
}

template <std::size_t sites, std::size_t layers>
void spread_turned(std::span<const std::array<double, layers>, sites> flow,
                   std::span<std::array<double, sites>, layers> result) {
    for (std::size_t l = 0; l < layers; ++l)
        for (std::size_t s = 0; s < sites; ++s) result[l][s] = flow[s][l] * static_cast<double>(l + 1);
}

inline std::int64_t counted(bool works, std::int64_t sensors, std::int64_t sent) {
    return works ? sensors + sent : 0;
}

inline void is_warm(std::span<const double> heat, std::span<bool> result) {
    for (std::size_t l = 0; l < heat.size(); ++l) result[l] = heat[l] > 1.0;
}

inline bool any(std::span<const bool> values) {
    return std::ranges::find(values, true) != values.end();
}

inline double mean_of(std::span<const double> values) {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

inline std::int64_t largest(std::span<const std::int64_t> values) {
    return *std::ranges::max_element(values);
}

}  // namespace rddl_extern
