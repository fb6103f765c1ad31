// TriangleTireworld_MDP_ippc2014 10: one vehicle on 66 places, of which the state is its place. An
// action is one bool among thousands (max-nondef-actions): few of them matter where the vehicle is.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct TriangleTireworld : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t places = std::size(triangle_tireworld::spares);
    static constexpr std::size_t moves_size = places * places,
                                 record_size = moves_size + places + 1;

    struct Vehicle {
        std::size_t place;
        std::array<bool, places> spares;
        bool has_good_tire, has_spare, was_rewarded;
    };
    static constexpr Vehicle first{triangle_tireworld::start, triangle_tireworld::spares,
                                   triangle_tireworld::good_tire != 0, false, false};
    template <class L>
    struct State {
        Vehicle vehicles[L::width];
    };
    template <class L>
    struct Actions {
        const std::byte* records;
    };

    static void start(State<rddl::Scalar>& state) { state.vehicles[0] = first; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        rddl::for_each_lane(where, [&](int lane) { state.vehicles[lane] = first; });
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.records = records;
    }

    // The places that roads lead to, at most `most_roads`; the place itself where there are fewer.
    static constexpr std::size_t most_roads = 4;
    static constexpr auto roads = [] {
        std::array<std::array<std::uint8_t, most_roads>, places> all{};
        for (std::size_t from = 0; from < places; ++from) {
            all[from].fill(static_cast<std::uint8_t>(from));
            std::size_t count = 0;
            for (std::size_t to = 0; to < places; ++to)
                if (triangle_tireworld::road[from][to])
                    all[from].at(count++) = static_cast<std::uint8_t>(to);
        }
        return all;
    }();

    // Returns whether the vehicle moves, and then needs luck.
    static bool move(Vehicle& vehicle, const std::byte* record) {
        if (!vehicle.has_good_tire) return false;
        const std::byte* const row = record + vehicle.place * places;
        for (const std::uint8_t to : roads[vehicle.place]) {
            if (row[to] == std::byte{0} || to == vehicle.place) continue;
            vehicle.place = to;
            return true;
        }
        return false;
    }
    struct Outcome {
        double reward;
        bool moves;
    };
    static Outcome act(Vehicle& vehicle, const std::byte* record) {
        const bool is_there = vehicle.place == triangle_tireworld::goal;
        const double reward = vehicle.was_rewarded ? 0.0 : is_there ? 100.0 : -1.0;
        vehicle.was_rewarded |= is_there;
        const std::byte* const loads = record + moves_size;
        bool& spare = vehicle.spares[vehicle.place];
        const bool takes = spare && loads[vehicle.place] != std::byte{0};
        const bool changes = vehicle.has_spare && loads[places] != std::byte{0};
        spare = spare && !takes;
        vehicle.has_spare = !changes && (vehicle.has_spare || takes);
        const bool moves = move(vehicle, record);
        vehicle.has_good_tire |= changes;
        return {reward, moves};
    }

    static constexpr std::uint64_t good = threshold(triangle_tireworld::flat_probability);

    template <class Draws>
    static double step(State<rddl::Scalar>& state, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        Vehicle& vehicle = state.vehicles[0];
        const Outcome outcome = act(vehicle, actions.records);
        if (outcome.moves) vehicle.has_good_tire = integer_at(draws, 0, 0) < good;
        return outcome.reward;
    }
    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& state,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        double rewards[n];
        unsigned moving = 0;
        for (int lane = 0; lane < n; ++lane) {
            const Outcome outcome =
                act(state.vehicles[lane],
                    actions.records + static_cast<std::size_t>(lane) * record_size);
            rewards[lane] = outcome.reward;
            moving |= unsigned{outcome.moves} << lane;
        }
        if (moving != 0) {
            const Word none{std::uint64_t{0}};
            const auto lucky = is_below(draws.two_integers(none, none).even, Word{good});
            for_each_bit(moving, [&](std::size_t lane) {
                state.vehicles[lane].has_good_tire = lucky[static_cast<int>(lane)];
            });
        }
        return rddl::Lanes<double, n>::load(rewards);
    }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        const Vehicle& vehicle = state.vehicles[lane];
        std::memset(record, 0, places);
        record[vehicle.place] = std::byte{1};
        std::memcpy(record + places, vehicle.spares.data(), places);
        const bool rest[] = {vehicle.has_good_tire, vehicle.has_spare, vehicle.was_rewarded};
        std::memcpy(record + 2 * places, rest, sizeof rest);
    }
};

}  // namespace handwritten
