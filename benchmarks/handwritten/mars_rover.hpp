// MarsRover_ippc2023 3: six rovers, which a register holds, and seven minerals.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct MarsRover : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = false;
    static constexpr std::size_t rovers = std::size(mars_rover::x),
                                 minerals = std::size(mars_rover::area);
    // One environment has a register of rovers, others a register of environments for each rover.
    using Rovers = rddl::Lanes<double, lanes_in_one>;
    template <class L>
    static constexpr bool is_one = std::is_same_v<L, rddl::Scalar>;
    template <class L>
    using Real = std::conditional_t<is_one<L>, Rovers, typename L::Real>;
    template <class L>
    static constexpr std::size_t registers = is_one<L> ? 1 : rovers;

    template <class L>
    struct State {
        Real<L> velocity_x[registers<L>], x[registers<L>], velocity_y[registers<L>],
            y[registers<L>];
        typename L::Word harvested;
    };
    template <class L>
    struct Actions {
        Real<L> power_x[registers<L>], power_y[registers<L>];
        typename L::Word harvest;
    };

    static Rovers load_rovers(const double* values) {
        double eight[lanes_in_one]{};
        std::copy_n(values, rovers, eight);
        return Rovers::load(eight);
    }
    static void start(State<rddl::Scalar>& s) {
        s = {{Rovers{0.0}},
             {load_rovers(mars_rover::x)},
             {Rovers{0.0}},
             {load_rovers(mars_rover::y)},
             0};
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        for (std::size_t d = 0; d < rovers; ++d) {
            s.velocity_x[d] = select(where, 0.0, s.velocity_x[d]);
            s.velocity_y[d] = select(where, 0.0, s.velocity_y[d]);
            s.x[d] = select(where, mars_rover::x[d], s.x[d]);
            s.y[d] = select(where, mars_rover::y[d], s.y[d]);
        }
        s.harvested = select(where, std::uint64_t{0}, s.harvested);
    }

    static constexpr std::size_t record_size = 2 * rovers + 1;  // in doubles
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        const auto* const values = reinterpret_cast<const double*>(record);
        actions.power_x[0] = load_rovers(values);
        actions.power_y[0] = load_rovers(values + rovers);
        actions.harvest = bits_of_bytes<rovers>(record + 2 * rovers * sizeof(double));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(record_size);
        for (std::size_t d = 0; d < rovers; ++d) {
            actions.power_x[d] = gather(values + d, rows);
            actions.power_y[d] = gather(values + rovers + d, rows);
        }
        load_words(actions.harvest, records, record_size * sizeof(double),
                   [](const std::byte* record) {
                       return bits_of_bytes<rovers>(record + 2 * rovers * sizeof(double));
                   });
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Sum = typename L::Real;
        using Word = typename L::Word;
        Word taken{std::uint64_t{0}};
        Sum value{0.0};
        for (std::size_t m = 0; m < minerals; ++m) {
            const Word mineral{std::uint64_t{1} << m};
            const auto is_taken = any_near(s, actions, m) && is_zero(s.harvested & mineral);
            taken = taken | select(is_taken, mineral, Word{std::uint64_t{0}});
            value = value + select(is_taken, Sum{mars_rover::value[m]}, Sum{0.0});
        }
        s.harvested = s.harvested | taken;
        Real<L> costs{0.0};
        for (std::size_t d = 0; d < registers<L>; ++d) {
            const Real<L> x = actions.power_x[d], y = actions.power_y[d];
            const Real<L> square = x * x + y * y;
            // The power is 0.1 at most.
            const Real<L> scale =
                select(square >= 0.1 * 0.1, 0.1 / rddl::sqrt(square), Real<L>{1.0});
            const Real<L> force_x = scale * x, force_y = scale * y;
            costs = costs + force_x * force_x + force_y * force_y;
            s.x[d] = s.x[d] + 0.1 * s.velocity_x[d];
            s.y[d] = s.y[d] + 0.1 * s.velocity_y[d];
            s.velocity_x[d] = s.velocity_x[d] + 0.1 * force_x;
            s.velocity_y[d] = s.velocity_y[d] + 0.1 * force_y;
        }
        return value - total<L>(costs) - real_of_count(bit_count(actions.harvest));
    }

    // A rover harvests that is near mineral m.
    template <class L>
    static auto any_near(const State<L>& s, const Actions<L>& actions, std::size_t m) {
        const auto is_near = [&](std::size_t d) {
            const Real<L> x = s.x[d] - mars_rover::mineral_x[m],
                          y = s.y[d] - mars_rover::mineral_y[m];
            return x * x + y * y < mars_rover::area[m] * mars_rover::area[m];
        };
        if constexpr (is_one<L>) {
            return (is_near(0).bits & actions.harvest) != 0;
        } else {
            typename L::Bool any(false);
            for (std::size_t d = 0; d < rovers; ++d)
                any = any || (is_near(d) && !is_zero(actions.harvest & (std::uint64_t{1} << d)));
            return any;
        }
    }
    template <class L>
    static typename L::Real total(const Real<L>& costs) {
        if constexpr (is_one<L>) {
            double sum = 0;
            for (int d = 0; d < static_cast<int>(rovers); ++d) sum += costs[d];
            return sum;
        } else {
            return costs;
        }
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double values[4 * rovers];
        const auto store_all = [&](const Real<L>* from, std::size_t at) {
            for (std::size_t d = 0; d < rovers; ++d) {
                if constexpr (is_one<L>)
                    values[at + d] = (*from)[static_cast<int>(d)];
                else
                    values[at + d] = lane_of(from[d], lane);
            }
        };
        store_all(s.velocity_x, 0);
        store_all(s.x, rovers);
        store_all(s.velocity_y, 2 * rovers);
        store_all(s.y, 3 * rovers);
        std::memcpy(record, values, sizeof values);
        store_bits_as_bytes<minerals>(lane_of(s.harvested, lane), record + sizeof values);
    }
};

}  // namespace handwritten
