// Blackjack_arcade 0: a look-up of the next stage, and one card for each step.
#pragma once

#include "bools.hpp"

namespace handwritten {

struct Blackjack {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    enum Stage : std::int64_t { p1, p2, d1, d2, pn, dn, done };

    template <class L>
    struct State {
        typename L::Int stage, player, dealer;
    };
    template <class L>
    struct Actions {
        typename L::Bool hit;
    };

    static void start(State<rddl::Scalar>& state) { state = {p1, 0, 0}; }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        state.stage = select(where, std::int64_t{p1}, state.stage);
        state.player = select(where, std::int64_t{0}, state.player);
        state.dealer = select(where, std::int64_t{0}, state.dealer);
    }

    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        actions.hit = record[0] != std::byte{0};
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        actions.hit = L::Bool::of_bits(bits_of_bytes<L::width>(records));
    }

    static constexpr std::size_t cards = 14;
    static constexpr std::int64_t ace = 11, most = 21, dealer_stops = 17;
    static constexpr std::int64_t values[cards] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 10, 10, 10, ace};
    static std::int64_t value_of(std::uint64_t number) { return values[number * cards >> 52]; }
    template <int n>
    static rddl::Lanes<std::int64_t, n> value_of(const rddl::Lanes<std::uint64_t, n>& number) {
        const auto card = rddl::ints_of(((number << 4) - (number << 1)) >> 52);
        return select(card == std::int64_t{13}, rddl::Lanes<std::int64_t, n>{ace},
                      rddl::minimum(card + std::int64_t{1}, std::int64_t{10}));
    }

    template <class Int>
    static Int with_card(const Int& total, const Int& value) {
        const Int sum = total + value;
        return select(value == ace && sum > most, total + std::int64_t{1}, sum);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        using Int = typename L::Int;
        const Word zero{std::uint64_t{0}};
        const Int value = value_of(draws.two_integers(zero, zero).even);
        const auto is = [&](Stage stage) {
            return s.stage == std::int64_t{stage};
        };
        const auto is_later = is(pn), is_dealt = is_later || is(d2);
        const auto of_player = s.stage <= std::int64_t{p2} || is_later;
        s.player = select(of_player, with_card(s.player, value), s.player);
        s.dealer = select(of_player, s.dealer, with_card(s.dealer, value));
        const auto busts = s.player > most;
        const Int last =
            select(s.dealer < dealer_stops, Int{std::int64_t{dn}}, Int{std::int64_t{done}});
        const Int chosen = select(actions.hit, Int{std::int64_t{pn}}, last);
        const Int dealt = select(is_later && busts, Int{std::int64_t{done}}, chosen);
        const Int later = select(is_dealt, dealt, last);
        s.stage = select(s.stage <= std::int64_t{d1}, s.stage + std::int64_t{1}, later);
        const auto wins =
            s.stage == std::int64_t{done} && !busts && (s.dealer > most || s.player > s.dealer);
        return select(wins, typename L::Real{1.0}, typename L::Real{0.0});
    }

    template <class State>
    static auto terminated(const State& state) {
        return state.stage == std::int64_t{done};
    }
    static constexpr bool broken(const auto&) { return false; }

    template <class L>
    static void store(const State<L>& state, std::int64_t lane, std::byte* record) {
        const std::int64_t all[] = {lane_of(state.stage, lane), lane_of(state.player, lane),
                                    lane_of(state.dealer, lane)};
        std::memcpy(record, all, sizeof all);
    }
};

}  // namespace handwritten
