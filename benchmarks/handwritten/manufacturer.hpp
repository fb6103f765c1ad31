// Manufacturer_ippc2018 13: five goods, whose prices follow trends. The first two are raw, the
// third is made of them, and the last two are sold.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

// By the trend, which is down, stable or up: numbers below the first limit mean a step down or the
// lowest trend, and those from the second limit on a step up or the highest one.
struct TrendLimits {
    std::array<std::uint64_t, 3> first, second;

    static constexpr TrendLimits of(const double (&chances)[2][3]) {
        TrendLimits limits{};
        for (std::size_t trend = 0; trend < 3; ++trend) {
            limits.first[trend] = threshold(chances[0][trend]);
            limits.second[trend] = threshold(chances[1][trend]);
        }
        return limits;
    }
};

struct Manufacturer : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 50;
    static constexpr bool stochastic = true;
    static constexpr std::size_t goods = 5, pairs = goods * goods;
    // Two raw goods; the third is a part of others; factories are built for the third and the
    // fourth.
    static constexpr std::size_t raw = 2, part = 2, first_built = 2, built = 2;
    static constexpr std::uint64_t greatest_level = manufacturer::levels - 1, finishing = 4;

    // Sets of goods and of pairs of goods (first * goods + second); 0 or 1 for other bools.
    template <class L>
    struct State {
        using Word = typename L::Word;
        Word in_stock, for_sale, factories, managers;
        Word level[goods], trend[goods], progress[built];
        Word lobbyist, marketing, manager_applies, lobbyist_applies, marketing_applies;
    };
    template <class L>
    struct Actions {
        using Word = typename L::Word;
        Word first, second;  // 60 bools and the others

        Word purchase() const { return field(first, 0, pairs); }
        Word produce() const { return field(first, pairs, pairs); }
        Word produce_for_sale() const { return field(first, 2 * pairs, goods); }
        Word sell() const { return field(first, 2 * pairs + goods, goods); }
        Word purchase_produce() const { return field(second, 0, pairs); }
        Word purchase_produce_sell() const { return field(second, pairs, goods); }
        Word build() const { return field(second, pairs + goods, goods); }
        Word hire_manager() const { return field(second, pairs + 2 * goods, goods); }
        Word hire_lobbyist() const { return field(second, pairs + 3 * goods, 1); }
        Word hire_marketing() const { return field(second, pairs + 3 * goods + 1, 1); }

      private:
        static Word field(const Word& word, std::size_t at, std::size_t count) {
            return word >> static_cast<int>(at) & first_bits(count);
        }
    };
    static constexpr std::size_t in_first = 2 * (pairs + goods), in_second = pairs + 3 * goods + 2;

    static void start(State<rddl::Scalar>& s) {
        s = {};
        s.factories = manufacturer::factories[0];
        for (std::size_t g = 0; g < goods; ++g) {
            s.level[g] = greatest_level / 2;
            s.trend[g] = manufacturer::trends[g];
        }
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        State<rddl::Scalar> first;
        start(first);
        const auto set = [&](auto& value, std::uint64_t to) {
            value = select(where, to, value);
        };
        set(s.in_stock, first.in_stock);
        set(s.for_sale, first.for_sale);
        set(s.factories, first.factories);
        set(s.managers, first.managers);
        for (std::size_t g = 0; g < goods; ++g) {
            set(s.level[g], first.level[g]);
            set(s.trend[g], first.trend[g]);
        }
        for (auto& progress : s.progress) set(progress, 0);
        for (auto* bool_ : {&s.lobbyist, &s.marketing, &s.manager_applies, &s.lobbyist_applies,
                            &s.marketing_applies})
            set(*bool_, 0);
    }

    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        constexpr std::size_t all = in_first + in_second;
        load_words(actions.first, records, all, bits_of_bytes<in_first>);
        load_words(actions.second, records + in_first, all, bits_of_bytes<in_second>);
    }

    // --------------------------------------------------------------------------------- draws

    template <class Word>
    struct Numbers {
        Word level[goods + 1], trend[goods + 1], delay[built], lobbyist, marketing, manager;
    };
    enum Site : std::uint64_t { delays, levels, lobbyists, marketing, trends, managers };
    static constexpr std::size_t blocks = (goods + 1) / 2;

    // One register for all.
    static Numbers<std::uint64_t> numbers(const State<rddl::Scalar>&,
                                          const Draws<std::uint64_t>& draws) {
        constexpr int n = 2 * lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        static constexpr std::uint64_t sites[n] = {levels, levels, levels,    trends,    trends,
                                                   trends, delays, lobbyists, marketing, managers};
        static constexpr std::uint64_t blocks_of[n] = {0, 1, 2, 0, 1, 2, first_built / 2};
        const Draws<Word> many{Word{draws.step}, {Word{draws.key[0]}, Word{draws.key[1]}}};
        const auto both = many.two_integers(Word::load(sites), Word::load(blocks_of));
        Numbers<std::uint64_t> numbers;
        for (int b = 0; b < static_cast<int>(blocks); ++b) {
            numbers.level[2 * b] = both.even[b];
            numbers.level[2 * b + 1] = both.odd[b];
            numbers.trend[2 * b] = both.even[3 + b];
            numbers.trend[2 * b + 1] = both.odd[3 + b];
        }
        numbers.delay[0] = both.even[6];
        numbers.delay[1] = both.odd[6];
        numbers.lobbyist = both.even[7];
        numbers.marketing = both.even[8];
        numbers.manager = both.even[9];
        return numbers;
    }
    template <int n>
    static Numbers<rddl::Lanes<std::uint64_t, n>> numbers(
        const State<rddl::Pack<n>>& s, const Draws<rddl::Lanes<std::uint64_t, n>>& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        Numbers<Word> numbers;
        const auto pair = [&](Site site, std::size_t block) {
            return draws.two_integers(Word{std::uint64_t{site}}, Word{std::uint64_t{block}});
        };
        const auto set = [](Word* at, const auto& two) {
            at[0] = two.even;
            at[1] = two.odd;
        };
        for (std::size_t b = 0; b < blocks; ++b) {
            set(&numbers.level[2 * b], pair(levels, b));
            set(&numbers.trend[2 * b], pair(trends, b));
        }
        if (!all(is_zero(s.progress[0] | s.progress[1])))
            set(numbers.delay, pair(delays, first_built / 2));
        numbers.lobbyist = pair(lobbyists, 0).even;
        numbers.marketing = pair(marketing, 0).even;
        numbers.manager = pair(managers, 0).even;
        return numbers;
    }

    // ------------------------------------------------------------------------------ prices

    static constexpr TrendLimits of_level = TrendLimits::of(manufacturer::level_limits);
    static constexpr auto of_trend = [] {
        std::array<TrendLimits, goods> all{};
        for (std::size_t g = 0; g < goods; ++g)
            all[g] = TrendLimits::of(manufacturer::trend_limits[g]);
        return all;
    }();
    static std::uint64_t by_trend(const std::array<std::uint64_t, 3>& limits, std::uint64_t trend) {
        return limits[trend];
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> by_trend(const std::array<std::uint64_t, 3>& limits,
                                                  const rddl::Lanes<std::uint64_t, n>& trend) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        return if_zero(trend, Word{limits[0]},
                       if_zero(trend & std::uint64_t{1}, Word{limits[2]}, Word{limits[1]}));
    }
    template <class Word>
    static Word next_level(const Word& level, const Word& trend, const Word& number) {
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}}, most{greatest_level};
        const Word down = select(is_below(number, by_trend(of_level.first, trend)), one, zero);
        const Word up = select(is_below(number, by_trend(of_level.second, trend)), zero, one);
        return level + if_zero(level ^ most, zero, up) - if_zero(level, zero, down);
    }
    template <class Word>
    static Word next_trend(std::size_t good, const Word& trend, const Word& number) {
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}}, two{std::uint64_t{2}};
        const Word more =
            select(is_below(number, by_trend(of_trend[good].second, trend)), one, two);
        return select(is_below(number, by_trend(of_trend[good].first, trend)), zero, more);
    }

    static double price(std::size_t good, std::uint64_t level) {
        return manufacturer::price[good] * manufacturer::factor[level];
    }
    template <int n>
    static rddl::Lanes<double, n> price(std::size_t good,
                                        const rddl::Lanes<std::uint64_t, n>& level) {
        return manufacturer::price[good] * gather(manufacturer::factor, rddl::ints_of(level));
    }

    // -------------------------------------------------------------------------------- a step

    // The pairs whose second good is one of those.
    template <class Word>
    static Word pairs_with(const Word& seconds) {
        Word all = seconds;
        for (std::size_t g = 1; g < goods; ++g) all = all | seconds << static_cast<int>(goods * g);
        return all;
    }
    // The set of the third good, if a pair is chosen; no other good is made for others.
    template <class Word>
    static Word if_any(const Word& chosen) {
        return if_zero(chosen, Word{std::uint64_t{0}}, Word{std::uint64_t{1} << part});
    }

    template <class L>
    static typename L::Real reward(const State<L>& s, const Actions<L>& actions) {
        using Word = typename L::Word;
        using Real = typename L::Real;
        const Word at_once = actions.purchase_produce_sell();
        const Word makes = at_once | if_any(actions.purchase_produce());
        const Word missing = pairs_with(makes) & manufacturer::processed[0];
        const Word bought = actions.purchase() | (missing ^ (missing & s.in_stock));
        const Word sold = actions.sell() | at_once;
        Real income{0.0}, cost{0.0};
        for (std::size_t g = 0; g < goods; ++g) {
            const Real now = price(g, s.level[g]);
            if (g <= part) cost = cost + times(bought, goods * g, goods, now);
            if (g >= raw) income = income + times(sold, g, 1, now);
        }
        const auto real = [](const Word& count) {
            return real_of_count(count);
        };
        Real reward = income * (1.0 + real(s.marketing) * manufacturer::marketing_bonus) -
                      cost * (1.0 - real(s.lobbyist) * manufacturer::lobbyist_bonus);
        const Word zero{std::uint64_t{0}};
        for (std::size_t b = 0; b < built; ++b)
            reward = reward - real(if_zero(s.progress[b], zero,
                                           Word{manufacturer::build_cost[first_built + b]}));
        return reward - real(bit_count(s.managers)) * manufacturer::manager_salary -
               real(s.marketing) * manufacturer::marketing_salary -
               real(s.lobbyist) * manufacturer::lobbyist_salary;
    }
    // So many times the price as bits are set.
    template <class Word, class Real>
    static Real times(const Word& bits, std::size_t first, std::size_t count, const Real& price) {
        return real_of_count(bit_count(bits & (first_bits(count) << first))) * price;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const Word zero{std::uint64_t{0}}, one{std::uint64_t{1}};
        const auto value = reward(s, actions);
        const auto number = numbers(s, draws);
        const Word used = actions.produce_for_sale() | actions.purchase_produce_sell() |
                          if_any(actions.produce());
        s.in_stock = (s.in_stock ^ (s.in_stock & pairs_with(used))) | actions.purchase() |
                     actions.produce() | actions.purchase_produce();
        s.for_sale = (s.for_sale ^ (s.for_sale & actions.sell())) | actions.produce_for_sale();
        const Word build = actions.build();
        for (std::size_t b = 0; b < built; ++b) {
            const std::uint64_t good = std::uint64_t{1} << (first_built + b);
            const Word progress = s.progress[b], left = progress ^ Word { finishing };
            s.factories = s.factories | if_zero(left, Word{good}, zero);
            const Word further =
                progress + select(is_below(number.delay[b], Word{delay[b]}), zero, one);
            const Word goes_on = if_zero(progress, zero, if_zero(left, zero, further));
            s.progress[b] = if_zero(build & good, goes_on, one);
        }
        for (std::size_t g = 0; g < goods; ++g) {
            s.level[g] = next_level(s.level[g], s.trend[g], number.level[g]);
            s.trend[g] = next_trend(g, s.trend[g], number.trend[g]);
        }
        s.managers = s.managers | actions.hire_manager();
        s.lobbyist = s.lobbyist | actions.hire_lobbyist();
        s.marketing = s.marketing | actions.hire_marketing();
        const auto applies = [&](const Word& its_number, double chance) {
            return select(is_below(its_number, Word{threshold(chance)}), one, zero);
        };
        s.manager_applies = applies(number.manager, manufacturer::manager_applies);
        s.lobbyist_applies = applies(number.lobbyist, manufacturer::lobbyist_applies);
        s.marketing_applies = applies(number.marketing, manufacturer::marketing_applies);
        return value;
    }
    static constexpr std::uint64_t delay[built] = {threshold(manufacturer::delay[first_built]),
                                                   threshold(manufacturer::delay[first_built + 1])};

    struct Record {
        std::byte in_stock[pairs], for_sale[goods];
        std::uint64_t level[goods], trend[goods];
        std::byte factories[goods];
        std::uint64_t progress[goods];
        std::byte managers[goods], lobbyist, marketing, manager_applies, lobbyist_applies,
            marketing_applies;
    };
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        Record values{};
        const auto byte = [&](const auto& bool_) {
            return static_cast<std::byte>(lane_of(bool_, lane));
        };
        store_bits_as_bytes<pairs>(lane_of(s.in_stock, lane), values.in_stock);
        store_bits_as_bytes<goods>(lane_of(s.for_sale, lane), values.for_sale);
        store_bits_as_bytes<goods>(lane_of(s.factories, lane), values.factories);
        store_bits_as_bytes<goods>(lane_of(s.managers, lane), values.managers);
        for (std::size_t g = 0; g < goods; ++g) {
            values.level[g] = lane_of(s.level[g], lane);
            values.trend[g] = lane_of(s.trend[g], lane);
        }
        for (std::size_t b = 0; b < built; ++b)
            values.progress[first_built + b] = lane_of(s.progress[b], lane);
        values.lobbyist = byte(s.lobbyist);
        values.marketing = byte(s.marketing);
        values.manager_applies = byte(s.manager_applies);
        values.lobbyist_applies = byte(s.lobbyist_applies);
        values.marketing_applies = byte(s.marketing_applies);
        std::memcpy(record, &values, sizeof values);
    }
};

}  // namespace handwritten
