// The external functions of domain.rddl.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace rddl_extern {

// Water that evaporates in a day, in mm, at a temperature in degrees Celsius.
inline double evaporation(double temperature) {
    const double pressure = 0.61094 * std::exp(17.625 * temperature / (temperature + 243.04));
    return 1.2 * pressure;
}

// The water of each plot once nothing overflows any more: plots in their order pass on what they
// cannot hold, `runs_to[from][to]` of it to each other plot.
template <std::size_t plots>
void settle(std::span<const double, plots> supplied, std::span<const double, plots> capacity,
            std::span<const std::array<double, plots>, plots> runs_to,
            std::span<double, plots> settled) {
    for (std::size_t p = 0; p < plots; ++p) settled[p] = supplied[p];
    for (std::size_t p = 0; p < plots; ++p) {
        const double overflow = settled[p] > capacity[p] ? settled[p] - capacity[p] : 0.0;
        settled[p] = settled[p] - overflow;
        for (std::size_t to = 0; to < plots; ++to)
            settled[to] = settled[to] + runs_to[p][to] * overflow;
    }
}

}  // namespace rddl_extern
