// Intruders_Discrete 0: three intruders and two cameras, of which the state is the place.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Intruders : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t places = 16, directions = 5,
                                 intruders = std::size(intruders_discrete::intruders),
                                 cameras = std::size(intruders_discrete::cameras);

    template <class L>
    struct State {
        typename L::Int intruder[intruders], camera[cameras];
    };
    template <class L>
    struct Actions {
        typename L::Int direction[cameras];
    };

    static void start(State<rddl::Scalar>& state) {
        std::copy_n(intruders_discrete::intruders, intruders, state.intruder);
        std::copy_n(intruders_discrete::cameras, cameras, state.camera);
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (std::size_t i = 0; i < intruders; ++i)
            state.intruder[i] = select(where, intruders_discrete::intruders[i], state.intruder[i]);
        for (std::size_t c = 0; c < cameras; ++c)
            state.camera[c] = select(where, intruders_discrete::cameras[c], state.camera[c]);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        std::memcpy(actions.direction, record, sizeof actions.direction);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const std::int64_t*>(records);
        const typename L::Int rows = row_starts<L>(cameras);
        for (std::size_t c = 0; c < cameras; ++c)
            actions.direction[c] = gather_integers(values + c, rows);
    }

    // The next place in each direction.
    static std::int64_t moved(std::int64_t direction, std::int64_t place) {
        return intruders_discrete::next[direction][place];
    }
    template <int n>
    static rddl::Lanes<std::int64_t, n> moved(const rddl::Lanes<std::int64_t, n>& direction,
                                              const rddl::Lanes<std::int64_t, n>& place) {
        return gather_integers(intruders_discrete::next[0],
                               rddl::ints_of(rddl::words_of(direction) << 4) + place);
    }

    // All directions are equally likely; the sums are those of 0.2, one after the other.
    static constexpr double sums[] = {0.2, 0.2 + 0.2, 0.2 + 0.2 + 0.2, 0.2 + 0.2 + 0.2 + 0.2};
    template <class L>
    static typename L::Int direction_of(const typename L::Word& number) {
        using Int = typename L::Int;
        using Word = typename L::Word;
        Int direction{0};
        for (const double sum : sums)
            direction = direction + select(is_below(number, Word{threshold(sum)}), Int{0}, Int{1});
        return direction;
    }

    template <class L>
    static typename L::Real seen_dangers(const State<L>& s) {
        using Int = typename L::Int;
        Int count{0};
        for (const Int& place : s.intruder) {
            auto is_unseen = place == intruders_discrete::danger[0];
            for (const std::int64_t danger : intruders_discrete::danger)
                is_unseen = is_unseen || place == danger;
            for (const Int& camera : s.camera) is_unseen = is_unseen && !(camera == place);
            count = count + select(is_unseen, Int{1}, Int{0});
        }
        return -rddl::to_real(count);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const auto reward = seen_dangers(s);
        for (std::size_t c = 0; c < cameras; ++c)
            s.camera[c] = moved(actions.direction[c], s.camera[c]);
        for (std::size_t i = 0; i < intruders; i += 2) {
            const auto numbers = draws.two_integers(Word{std::uint64_t{0}}, Word{i / 2});
            s.intruder[i] = moved(direction_of<L>(numbers.even), s.intruder[i]);
            if (i + 1 < intruders)
                s.intruder[i + 1] = moved(direction_of<L>(numbers.odd), s.intruder[i + 1]);
        }
        return reward;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        std::memset(record, 0, (intruders + cameras) * places);
        for (const auto& place : s.intruder) {
            record[lane_of(place, lane)] = std::byte{1};
            record += places;
        }
        for (const auto& place : s.camera) {
            record[lane_of(place, lane)] = std::byte{1};
            record += places;
        }
    }
};

}  // namespace handwritten
