// Pizza_rddlsim 0: two trucks, six places and four pizzas.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct Pizza : RunsToTheHorizon {
    static constexpr int width = 8;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr int places = 6, pizzas = 4, trucks = 2;
    static constexpr std::uint64_t all_places = first_bits(places), all_pizzas = first_bits(pizzas);
    static constexpr std::size_t record_size =
        trucks * (places + pizzas * places + pizzas + pizzas);

    // The places of each truck, delivered pizzas by their number and their place, and the pizzas in
    // each truck.
    template <class L>
    struct State {
        typename L::Word at[trucks], delivered, inside[trucks], hot, disposed;
    };
    template <class L>
    struct Actions {
        typename L::Word drive[trucks], deliver[trucks], load[trucks], dispose[trucks];
    };

    static void start(State<rddl::Scalar>& state) {
        state = {};
        state.at[0] = state.at[1] = pizza::shop;
        state.hot = all_pizzas;
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        const auto become = [&](typename L::Word& word, std::uint64_t value) {
            word = select(where, value, word);
        };
        for (int t = 0; t < trucks; ++t) {
            become(s.at[t], pizza::shop);
            become(s.inside[t], 0);
        }
        become(s.delivered, 0);
        become(s.hot, all_pizzas);
        become(s.disposed, 0);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        using Word = typename L::Word;
        Word first, second;
        load_words(first, records, record_size, bits_of_bytes<64>);
        load_words(second, records + 64, record_size, bits_of_bytes<record_size - 64>);
        constexpr int deliveries = pizzas * places, delivers = trucks * places,
                      loads = delivers + trucks * deliveries - 64,
                      disposes = loads + trucks * pizzas;
        static_assert(loads < 0 && disposes >= 0);
        const Word rest = first >> (64 + loads) | second << -loads;
        for (int t = 0; t < trucks; ++t) {
            actions.drive[t] = first >> t * places & all_places;
            actions.deliver[t] =
                first >> (delivers + t * deliveries) & first_bits(std::size_t{deliveries});
            actions.load[t] = rest >> t * pizzas & all_pizzas;
            actions.dispose[t] = rest >> (trucks + t) * pizzas & all_pizzas;
        }
    }

    template <class Word>
    static Word choose(const Word& where, const Word& yes, const Word& no) {
        return no ^ ((yes ^ no) & where);
    }
    // All bits, or none.
    template <class Word>
    static Word if_any(const Word& word, std::uint64_t yes) {
        return if_zero(word, Word{std::uint64_t{0}}, Word{yes});
    }
    // For each pizza whether one of its six bits is set.
    template <class Word>
    static Word by_pizza(const Word& bits) {
        Word any{std::uint64_t{0}};
        for (int p = 0; p < pizzas; ++p)
            any = any | if_any(bits & all_places << p * places, std::uint64_t{1} << p);
        return any;
    }
    // The six bits of each pizza.
    template <class Word>
    static Word to_places(const Word& of_pizzas) {
        Word bits{std::uint64_t{0}};
        for (int p = 0; p < pizzas; ++p)
            bits = bits | if_any(of_pizzas & std::uint64_t{1} << p, all_places << p * places);
        return bits;
    }

    static constexpr Thresholds drives = [] {
        Thresholds all;
        all.of.fill(threshold(pizza::drive_probability));
        return all;
    }();
    // A pizza stays hot among `count` hot ones with probability count / (count + 1).
    static constexpr auto stays = [] {
        std::array<Thresholds, 2 * pizzas + 1> all;
        for (std::size_t count = 0; count < all.size(); ++count)
            all[count].of.fill(threshold(static_cast<double>(count) / (count + 1.0)));
        return all;
    }();

    // The reward for a place, by the number of pizzas there and that of hot ones.
    template <class Word>
    static auto reward_at(const Word& delivered, const Word& hot, int place, std::uint64_t orders) {
        std::uint64_t row = 0;
        for (int p = 0; p < pizzas; ++p) row |= std::uint64_t{1} << (p * places + place);
        const Word there = delivered & row;
        const Word count = bit_count(there), warm = bit_count(there & hot);
        Word rewarded{std::uint64_t{0}};
        for (std::uint64_t allowed = 0; allowed <= orders; ++allowed)
            rewarded = rewarded | if_zero(count ^ Word{allowed}, warm, Word{std::uint64_t{0}});
        return real_of_count(rewarded) - static_cast<double>(orders);
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word hot_places = to_places(s.hot);
        typename L::Real reward{0.0};
        for (const auto& [place, orders] : pizza::orders)
            reward = reward + reward_at(s.delivered, hot_places, place, orders);

        // Two trucks block each other if they take the same road.
        const Word meet = if_any(s.at[0] & s.at[1], ~std::uint64_t{0}) &
                          if_any(actions.drive[0] & actions.drive[1], ~std::uint64_t{0});
        const Word both = actions.drive[0] | actions.drive[1] << places;
        const Word wanted = both ^ (both & meet);
        const auto [lucky] = draw_bits<std::size_t{trucks * places}>(draws, 1, wanted, drives);
        const Word arrive = wanted & lucky;

        Word carried{std::uint64_t{0}}, stays_hot{std::uint64_t{0}};
        const Word delivered = by_pizza(s.delivered);
        const Word inside = s.inside[0] | s.inside[1];
        const Word at_risk = (s.hot & inside) ^ (s.hot & inside & delivered);
        if (any_of(at_risk)) stays_hot = cool(s, at_risk, draws);
        s.hot = choose(at_risk, stays_hot, s.hot);
        for (int t = 0; t < trucks; ++t) {
            const Word target = arrive >> t * places & all_places;
            const Word leaves =
                if_any(actions.drive[t], ~std::uint64_t{0}) & if_any(target, ~std::uint64_t{0});
            s.at[t] = (s.at[t] ^ (s.at[t] & leaves)) | target;
            carried = carried | (to_places(s.inside[t]) & actions.deliver[t]);
            const Word gone = by_pizza(actions.deliver[t]) | actions.dispose[t];
            s.inside[t] = (s.inside[t] ^ (s.inside[t] & gone)) | actions.load[t];
            s.disposed = s.disposed | actions.dispose[t];
        }
        s.delivered = s.delivered | carried;
        return reward;
    }

    static bool any_of(std::uint64_t a) { return a != 0; }
    template <int n>
    static bool any_of(const rddl::Lanes<std::uint64_t, n>& a) {
        return !all(is_zero(a));
    }

    // The pizzas at risk that stay hot: by the hot ones in each truck that a pizza is in.
    template <class Word>
    static Word hot_beside(const Word& inside, const Word& hot, std::uint64_t pizza) {
        return if_zero(inside & pizza, Word{std::uint64_t{0}}, bit_count(inside & hot));
    }
    template <class L, class Draws>
    static typename L::Word cool(const State<L>& s, const typename L::Word& at_risk,
                                 const Draws& draws) {
        using Word = typename L::Word;
        Word result{std::uint64_t{0}};
        for (std::uint64_t p = 0; p < pizzas; ++p) {
            const std::uint64_t bit = std::uint64_t{1} << p;
            if (!any_of(at_risk & bit)) continue;
            const Word count =
                hot_beside(s.inside[0], s.hot, bit) + hot_beside(s.inside[1], s.hot, bit);
            const auto numbers = draws.two_integers(Word{std::uint64_t{0}}, Word{p / 2});
            const Word number = p % 2 == 0 ? numbers.even : numbers.odd;
            Word limit{std::uint64_t{0}};
            for (std::uint64_t k = 1; k < stays.size(); ++k)
                limit = if_zero(count ^ Word{k}, Word{stays[k][0]}, limit);
            result = result | choose(all_if(is_below(number, limit), Word{}), Word{bit},
                                     Word{std::uint64_t{0}});
        }
        return result;
    }
    static std::uint64_t all_if(bool condition, std::uint64_t) {
        return condition ? ~std::uint64_t{0} : 0;
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> all_if(const rddl::Mask<n>& condition,
                                                const rddl::Lanes<std::uint64_t, n>&) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        return select(condition, Word{~std::uint64_t{0}}, Word{std::uint64_t{0}});
    }

    // Each truck is at one place, if it is told to drive to one at most.
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        for (int t = 0; t < trucks; ++t)
            store_bits_as_bytes<places>(lane_of(s.at[t], lane), record + t * places);
        record += trucks * places;
        store_bits_as_bytes<pizzas * places>(lane_of(s.delivered, lane), record);
        record += pizzas * places;
        for (int p = 0; p < pizzas; ++p)
            for (int t = 0; t < trucks; ++t)
                *record++ = static_cast<std::byte>(lane_of(s.inside[t], lane) >> p & 1);
        store_bits_as_bytes<pizzas>(lane_of(s.hot, lane), record);
        store_bits_as_bytes<pizzas>(lane_of(s.disposed, lane), record + pizzas);
    }
};

}  // namespace handwritten
