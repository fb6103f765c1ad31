// HVAC_ippc2023 5: 20 zones and 15 heaters, with the lists of those that are adjacent.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

// For each row of a matrix of bools the columns where it is true, one row after the other.
template <std::size_t rows>
struct Lists {
    std::uint8_t columns[256]{};
    std::size_t ends[rows]{};
};
template <std::size_t rows>
constexpr Lists<rows> lists_of(const std::uint64_t (&bits)[rows]) {
    Lists<rows> lists;
    std::size_t end = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::uint8_t k = 0; k < 64; ++k)
            if (bits[row] >> k & 1) lists.columns[end++] = k;
        lists.ends[row] = end;
    }
    return lists;
}

struct Hvac : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t zones = std::size(hvac::zone_start),
                                 heaters = std::size(hvac::heater_start);

    template <class L>
    struct State {
        typename L::Real zone[zones], heater[heaters];
        typename L::Word occupied;
    };
    template <class L>
    struct Actions {
        typename L::Real fan[zones], heat[heaters];
    };

    static void start(State<rddl::Scalar>& state) {
        for (std::size_t z = 0; z < zones; ++z) state.zone[z] = hvac::zone_start[z];
        for (std::size_t h = 0; h < heaters; ++h) state.heater[h] = hvac::heater_start[h];
        state.occupied = first_bits(zones);
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (std::size_t z = 0; z < zones; ++z)
            state.zone[z] = select(where, hvac::zone_start[z], state.zone[z]);
        for (std::size_t h = 0; h < heaters; ++h)
            state.heater[h] = select(where, hvac::heater_start[h], state.heater[h]);
        state.occupied = select(where, first_bits(zones), state.occupied);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(&actions, record, sizeof actions);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(zones + heaters);
        for (std::size_t z = 0; z < zones; ++z) actions.fan[z] = gather(values + z, rows);
        for (std::size_t h = 0; h < heaters; ++h)
            actions.heat[h] = gather(values + zones + h, rows);
    }

    static constexpr auto neighbours = lists_of(hvac::neighbours);    // of zones
    static constexpr auto heated = lists_of(hvac::zones_of_heater);   // by heaters
    static constexpr auto heating = lists_of(hvac::heaters_of_zone);  // of zones

    struct Sums {
        std::size_t at = 0;
        // Adds values[k] for each k in the next list.
        template <std::size_t rows, class Real>
        Real next(const Lists<rows>& lists, std::size_t row, const Real* values) {
            Real sum{0.0};
            for (; at < lists.ends[row]; ++at) sum = sum + values[lists.columns[at]];
            return sum;
        }
    };

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Real = typename L::Real;
        Real heat_cost{0.0}, fan_cost{0.0}, discomfort{0.0};
        Real mixed[zones], zone[zones];
        for (std::size_t z = 0; z < zones; ++z) {
            const Real t = s.zone[z], fan = actions.fan[z];
            mixed[z] = t - t * hvac::out_air_flow / fan;  // above the temperature outside
            fan_cost = fan_cost + fan * fan;
            const Real cold = larger(hvac::least - t, 0.0), warm = larger(t - hvac::greatest, 0.0);
            const Real off = cold + warm;
            discomfort = discomfort + select(is_zero(s.occupied & (std::uint64_t{1} << z)),
                                             Real{0.0}, off * off);
        }
        Sums near, of_zone, of_heater, of_fan;
        for (std::size_t z = 0; z < zones; ++z) {
            const Real t = s.zone[z], away = t - hvac::outside;
            const double degree = __builtin_popcountll(hvac::neighbours[z]),
                         count = __builtin_popcountll(hvac::heaters_of_zone[z]);
            const Real exchange = near.next(neighbours, z, s.zone) - degree * t;
            const Real warming = of_zone.next(heating, z, s.heater) - count * t;
            zone[z] = t - hvac::zone_loss * (away * away) +
                      (count == 0 ? 0.0 : hvac::dt / (hvac::zone_volume * count)) * actions.fan[z] *
                          warming +
                      hvac::dt * hvac::exchange * exchange;
        }
        for (std::size_t h = 0; h < heaters; ++h) {
            const double count = __builtin_popcountll(hvac::zones_of_heater[h]);
            const Real t = s.heater[h], heat = actions.heat[h];
            const Real mix = of_heater.next(heated, h, mixed);
            const Real air = of_fan.next(heated, h, actions.fan);
            heat_cost = heat_cost + heat * heat;
            s.heater[h] = t - hvac::heater_loss * (t * t) +
                          hvac::dt / hvac::heater_volume / (count * count) * air * mix +
                          hvac::dt / (hvac::k * hvac::heater_volume) * heat;
        }
        for (std::size_t z = 0; z < zones; ++z) s.zone[z] = zone[z];
        const auto [stay] = draw_bits<zones>(draws, 0, s.occupied, stays);
        s.occupied = s.occupied & stay;
        return -hvac::heat_cost * heat_cost - hvac::air_cost * fan_cost -
               hvac::penalty * discomfort;
    }

    static constexpr Thresholds stays = [] {
        double chances[zones];
        for (std::size_t z = 0; z < zones; ++z) chances[z] = 1.0 - hvac::leave[z];
        return Thresholds::of_chances(chances);
    }();

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double values[zones + heaters];
        for (std::size_t z = 0; z < zones; ++z) values[z] = lane_of(s.zone[z], lane);
        for (std::size_t h = 0; h < heaters; ++h) values[zones + h] = lane_of(s.heater[h], lane);
        std::memcpy(record, values, sizeof values);
        store_bits_as_bytes<zones>(lane_of(s.occupied, lane), record + sizeof values);
    }
};

}  // namespace handwritten
