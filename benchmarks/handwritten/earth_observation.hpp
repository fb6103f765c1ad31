// EarthObservation_ippc2018 17: 96 patches in columns of twelve, the last of which lies beside the
// first, and what is seen of them.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct EarthObservation : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 64;
    static constexpr bool stochastic = true;
    static constexpr std::size_t half = 48, patches = 2 * half, rows = 12;
    static constexpr std::uint64_t everywhere = first_bits(half);

    // A bool for each patch. Patches with even numbers are apart from the others, since one counter
    // value serves two neighbours.
    template <class Word>
    struct Bools {
        Word even, odd;

        friend Bools operator&(const Bools& a, const Bools& b) {
            return {a.even & b.even, a.odd & b.odd};
        }
        friend Bools operator|(const Bools& a, const Bools& b) {
            return {a.even | b.even, a.odd | b.odd};
        }
        friend Bools operator^(const Bools& a, const Bools& b) {
            return {a.even ^ b.even, a.odd ^ b.odd};
        }
    };
    static constexpr Bools<std::uint64_t> bools_of(const bool (&values)[patches]) {
        Bools<std::uint64_t> bools{0, 0};
        for (std::size_t p = 0; p < patches; ++p)
            (p % 2 == 0 ? bools.even : bools.odd) |= std::uint64_t{values[p]} << p / 2;
        return bools;
    }

    template <class L>
    struct State {
        // The visibility is high, medium, or low.
        Bools<typename L::Word> focal_point, target, high, low;
    };
    template <class L>
    struct Actions {
        FourBools<typename L::Word> bools;  // slew north-east, south-east and east; take an image
    };

    static void start(State<rddl::Scalar>& s) {
        s = {bools_of(earth_observation::focal_point), bools_of(earth_observation::target),
             bools_of(earth_observation::high), bools_of(earth_observation::low)};
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        State<rddl::Scalar> first;
        start(first);
        const auto set = [&](auto& bools, const Bools<std::uint64_t>& to) {
            bools = {select(where, to.even, bools.even), select(where, to.odd, bools.odd)};
        };
        set(s.focal_point, first.focal_point);
        set(s.target, first.target);
        set(s.high, first.high);
        set(s.low, first.low);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_four_bools(actions.bools, records);
    }

    // The bits of one half, `by` places further.
    template <int by, class Word>
    static Word turned(const Word& bits) {
        return (bits << by | bits >> (static_cast<int>(half) - by)) & everywhere;
    }
    // A column further, and a row up or down.
    template <class Word>
    static Bools<Word> moved(const Bools<Word>& at, const FourBools<Word>& slew) {
        constexpr auto first_rows = every_column(0), last_rows = every_column(rows / 2 - 1);
        const Bools<Word> east{turned<6>(at.even), turned<6>(at.odd)};
        const Bools<Word> north_east{turned<7>(at.odd & ~last_rows), turned<6>(at.even)};
        const Bools<Word> south_east{turned<6>(at.odd), turned<5>(at.even & ~first_rows)};
        return (north_east & both(slew.first)) | (south_east & both(slew.second)) |
               (east & both(slew.third));
    }
    static constexpr std::uint64_t every_column(std::size_t place) {
        return std::uint64_t{0x041041041041} << place;
    }
    template <class Word>
    static Bools<Word> both(const Word& word) {
        return {word, word};
    }

    // The thresholds of the next visibility: high below the first, low from the second on.
    struct Next {
        std::uint64_t high, low;
    };
    static constexpr std::size_t first_after = 3;  // the site

    static State<rddl::Scalar> seen(const State<rddl::Scalar>& s,
                                    const Draws<std::uint64_t>& draws) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Draws<Word> many{Word{draws.step}, {Word{draws.key[0]}, Word{draws.key[1]}}};
        Bools<std::uint64_t> below[3][2]{};
        for (std::size_t first = 0; first < half; first += n) {
            const auto numbers =
                many.two_integers(Word{std::uint64_t{first_after}}, counting_from<n>(first));
            for (std::size_t kind = 0; kind < 3; ++kind)
                for (std::size_t k = 0; k < 2; ++k) {
                    const Word limit{limits[kind][k]};
                    below[kind][k].even |= std::uint64_t{is_below(numbers.even, limit).bits}
                                           << first;
                    below[kind][k].odd |= std::uint64_t{is_below(numbers.odd, limit).bits} << first;
                }
        }
        const auto medium = (s.high | s.low) ^ both(everywhere);
        const auto chosen = [&](std::size_t k) {
            return (s.high & below[0][k]) | (medium & below[1][k]) | (s.low & below[2][k]);
        };
        State<rddl::Scalar> next = s;
        next.high = chosen(0);
        next.low = chosen(1) ^ both(everywhere);
        return next;
    }
    template <int n>
    static State<rddl::Pack<n>> seen(const State<rddl::Pack<n>>& s,
                                     const Draws<rddl::Lanes<std::uint64_t, n>>& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        const Word none{std::uint64_t{0}};
        State<rddl::Pack<n>> next = s;
        next.high = next.low = both(none);
        for (std::uint64_t k = 0; k < half; ++k) {
            const auto numbers = draws.two_integers(Word{std::uint64_t{first_after}}, Word{k});
            const Word bit{std::uint64_t{1} << k};
            const auto see = [&](const Word& number, const Word& high, const Word& low,
                                 Word& to_high, Word& to_low) {
                const auto limit = [&](std::size_t which) {
                    return if_zero(
                        high & bit,
                        if_zero(low & bit, Word{limits[1][which]}, Word{limits[2][which]}),
                        Word{limits[0][which]});
                };
                to_high = to_high | select(is_below(number, limit(0)), bit, none);
                to_low = to_low | select(is_below(number, limit(1)), none, bit);
            };
            see(numbers.even, s.high.even, s.low.even, next.high.even, next.low.even);
            see(numbers.odd, s.high.odd, s.low.odd, next.high.odd, next.low.odd);
        }
        return next;
    }
    // By the visibility before: high, medium, low.
    static constexpr std::uint64_t limits[3][2] = {
        {threshold(earth_observation::after_high[0]), threshold(earth_observation::after_high[1])},
        {threshold(earth_observation::after_medium[0]),
         threshold(earth_observation::after_medium[1])},
        {threshold(earth_observation::after_low[0]), threshold(earth_observation::after_low[1])}};
    static constexpr std::uint64_t failure[3] = {threshold(earth_observation::failure[0]),
                                                 threshold(earth_observation::failure[1]),
                                                 threshold(earth_observation::failure[2])};

    // Targets of which an image was taken. Few of the patches are wanted.
    static std::uint64_t taken(std::uint64_t wanted, std::uint64_t high, std::uint64_t low,
                               std::size_t is_odd, const Draws<std::uint64_t>& draws) {
        std::uint64_t taken = 0;
        for_each_bit(wanted, [&](std::size_t k) {
            const std::size_t kind = high >> k & 1 ? 0 : low >> k & 1 ? 2 : 1;
            const std::uint64_t number = integer_at(draws, 0, 2 * k + is_odd);
            taken |= std::uint64_t{number >= failure[kind]} << k;
        });
        return taken;
    }
    template <int n>
    static rddl::Lanes<std::uint64_t, n> taken(const rddl::Lanes<std::uint64_t, n>& wanted,
                                               const rddl::Lanes<std::uint64_t, n>& high,
                                               const rddl::Lanes<std::uint64_t, n>& low,
                                               std::size_t is_odd,
                                               const Draws<rddl::Lanes<std::uint64_t, n>>& draws) {
        rddl::Lanes<std::uint64_t, n> all{std::uint64_t{0}};
        rddl::for_each_lane(!is_zero(wanted), [&](int lane) {
            const Draws<std::uint64_t> of_lane{draws.step[lane],
                                               {draws.key[0][lane], draws.key[1][lane]}};
            all.set(lane, taken(wanted[lane], high[lane], low[lane], is_odd, of_lane));
        });
        return all;
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws& draws) {
        using Word = typename L::Word;
        const auto& [north_east, south_east, east, take] = actions.bools;
        const Word costs = bit_count(s.target.even) + bit_count(s.target.odd) +
                           (north_east & std::uint64_t{1}) + (south_east & std::uint64_t{1}) +
                           (take & std::uint64_t{1});
        State<L> next = seen(s, draws);
        const auto wanted = s.target & s.focal_point & both(take);
        next.target.even = s.target.even ^ taken(wanted.even, s.high.even, s.low.even, 0, draws);
        next.target.odd = s.target.odd ^ taken(wanted.odd, s.high.odd, s.low.odd, 1, draws);
        next.focal_point = moved(s.focal_point, actions.bools);
        s = next;
        return -real_of_count(costs);
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        const auto has = [&](const Bools<typename L::Word>& bools, std::size_t p) {
            return (lane_of(p % 2 == 0 ? bools.even : bools.odd, lane) >> p / 2 & 1) != 0;
        };
        for (std::size_t p = 0; p < patches; ++p) {
            record[p] = static_cast<std::byte>(has(s.focal_point, p));
            record[patches + p] = static_cast<std::byte>(has(s.target, p));
            const std::int64_t visibility = has(s.high, p) ? 0 : has(s.low, p) ? 2 : 1;
            std::memcpy(record + 2 * patches + p * sizeof visibility, &visibility,
                        sizeof visibility);
        }
    }
};

}  // namespace handwritten
