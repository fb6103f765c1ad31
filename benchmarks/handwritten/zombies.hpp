// Zombies_arcade 2: five persons, of whom a register holds all.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/continuous.hpp>

namespace handwritten {

struct Zombies : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 40;
    static constexpr bool stochastic = true;
    static constexpr std::size_t persons = std::size(zombies::x);
    static constexpr double width_of_field = 10, height_of_field = 1;
    // One environment has a register of persons, others a register of environments for each person.
    using Persons = rddl::Lanes<double, lanes_in_one>;
    template <class L>
    static constexpr bool is_one = std::is_same_v<L, rddl::Scalar>;
    template <class L>
    using Real = std::conditional_t<is_one<L>, Persons, typename L::Real>;
    template <class L>
    using Bool = std::conditional_t<is_one<L>, rddl::Mask<lanes_in_one>, typename L::Bool>;
    template <class L>
    static constexpr std::size_t registers = is_one<L> ? 1 : persons;

    template <class L>
    struct State {
        Real<L> x[registers<L>], y[registers<L>], distance[registers<L>];
        Real<L> speed_x[registers<L>], speed_y[registers<L>];
        Bool<L> is_stunned[registers<L>], is_zombie[registers<L>];
    };
    template <class L>
    struct Actions {
        Real<L> x[registers<L>], y[registers<L>];
        Bool<L> stun[registers<L>];
    };

    static Persons load_persons(const double* values) {
        double eight[lanes_in_one]{};
        std::copy_n(values, persons, eight);
        return Persons::load(eight);
    }
    static constexpr double initial_y = 0.5;
    static void start(State<rddl::Scalar>& s) {
        const Persons zero{0.0};
        s = {{load_persons(zombies::x)},
             {Persons{initial_y}},
             {zero},
             {zero},
             {zero},
             {rddl::Mask<lanes_in_one>(false)},
             {rddl::Mask<lanes_in_one>::of_bits(zombies::zombies[0])}};
    }
    template <class L>
    static void start(State<L>& s, typename L::Bool where) {
        for (std::size_t p = 0; p < persons; ++p) {
            s.x[p] = select(where, zombies::x[p], s.x[p]);
            s.y[p] = select(where, initial_y, s.y[p]);
            s.distance[p] = select(where, 0.0, s.distance[p]);
            s.speed_x[p] = select(where, 0.0, s.speed_x[p]);
            s.speed_y[p] = select(where, 0.0, s.speed_y[p]);
            s.is_stunned[p] = !where && s.is_stunned[p];
            const bool is_zombie = zombies::zombies[0] >> p & 1;
            s.is_zombie[p] = is_zombie ? where || s.is_zombie[p] : !where && s.is_zombie[p];
        }
    }

    static constexpr std::size_t record_size = 2 * persons + 1;  // in doubles
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        const auto* const values = reinterpret_cast<const double*>(record);
        actions.x[0] = load_persons(values);
        actions.y[0] = load_persons(values + persons);
        actions.stun[0] = rddl::Mask<lanes_in_one>::of_bits(
            bits_of_bytes<persons>(record + 2 * persons * sizeof(double)));
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        const auto* const values = reinterpret_cast<const double*>(records);
        const typename L::Int rows = row_starts<L>(record_size);
        for (std::size_t p = 0; p < persons; ++p) {
            actions.x[p] = gather(values + p, rows);
            actions.y[p] = gather(values + persons + p, rows);
        }
        typename L::Word stunned;
        load_words(stunned, records, record_size * sizeof(double), [](const std::byte* record) {
            return bits_of_bytes<persons>(record + 2 * persons * sizeof(double));
        });
        for (std::size_t p = 0; p < persons; ++p)
            actions.stun[p] = !is_zero(stunned & (std::uint64_t{1} << p));
    }

    // A zombie moves by its own speed, unless it is stunned.
    template <class Real, class Bool>
    static Real moved(const Real& place, const Bool& is_zombie, const Bool& is_stunned,
                      const Real& speed, const Real& move, double limit) {
        const Real next = larger(smaller(place + select(is_zombie, speed, move), limit), 0.0);
        return select(is_zombie && is_stunned, place, next);
    }
    template <class L>
    static void move(State<L>& s, const Actions<L>& actions) {
        for (std::size_t p = 0; p < registers<L>; ++p) {
            const Real<L>&x = actions.x[p], &y = actions.y[p];
            s.distance[p] = select(s.is_zombie[p], Real<L>{0.0}, x * x + y * y);
            s.x[p] =
                moved(s.x[p], s.is_zombie[p], s.is_stunned[p], s.speed_x[p], x, width_of_field);
            s.y[p] =
                moved(s.y[p], s.is_zombie[p], s.is_stunned[p], s.speed_y[p], y, height_of_field);
            s.is_stunned[p] = actions.stun[p];
        }
    }

    template <class Real>
    static auto are_near(const Real& x, const Real& y, const Real& other_x, const Real& other_y) {
        return rddl::absolute(x - other_x) < 1.0 && rddl::absolute(y - other_y) < 1.0;
    }

    // ------------------------------------------------------------------------ one environment

    template <class Draws>
    static double step(State<rddl::Scalar>& s, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        using Mask = rddl::Mask<lanes_in_one>;
        const Mask is_zombie = s.is_zombie[0];
        const auto count = [](const Mask& mask) {
            return static_cast<double>(__builtin_popcountll(mask.bits));
        };
        double distances = 0;
        for (int p = 0; p < static_cast<int>(persons); ++p) distances += s.distance[0][p];
        const double reward = -distances - 20 * count(is_zombie && actions.stun[0]) -
                              50 * count(actions.stun[0] && !is_zombie) - 100 * count(is_zombie);

        Mask is_attacked(false);
        Persons chances{1.0};  // their reciprocals
        for_each_bit(is_zombie.bits, [&](std::size_t zombie) {
            const int z = static_cast<int>(zombie);
            const Mask near = are_near(s.x[0], s.y[0], Persons{s.x[0][z]}, Persons{s.y[0][z]});
            if (!(s.is_stunned[0].bits >> z & 1)) is_attacked = is_attacked || near;
            chances = chances + select(near, Persons{1.0}, Persons{0.0});
        });
        const Mask wanted = is_attacked && !is_zombie && Mask::of_bits(first_bits(persons));
        move(s, actions);

        const Numbers numbers(draws, wanted.bits >> (persons - 1));
        numbers.store_speeds(s);
        s.is_zombie[0] = is_zombie || (wanted && !(numbers.infections() < 1.0 / chances));
        return reward;
    }

    // All numbers of a step, by the lanes of one register: three pairs for the speeds of five
    // persons along each axis, and two for the infection of four; the fifth one's is made alone.
    struct Numbers {
        static constexpr int n = lanes_in_one;
        double even[n], odd[n];
        double normals[2 * n];
        double last;

        template <class Draws>
        Numbers(const Draws& draws, bool needs_last) {
            using Word = rddl::Lanes<std::uint64_t, n>;
            static constexpr std::uint64_t sites[n] = {0, 0, 0, 1, 1, 1, 2, 2},
                                           blocks[n] = {0, 1, 2, 0, 1, 2, 0, 1};
            const handwritten::Draws<Word> many{Word{draws.step},
                                                {Word{draws.key[0]}, Word{draws.key[1]}}};
            const auto made = many.two(Word::load(sites), Word::load(blocks));
            made.even.store(even);
            made.odd.store(odd);
            // Others than those of the speeds have the median, which takes no time.
            using Both = rddl::Lanes<double, 2 * n>;
            const auto half = [](const Persons& numbers, std::uint64_t used) {
                return select(rddl::Mask<n>::of_bits(used), rddl::open_unit_real(numbers),
                              Persons{0.5});
            };
            Both both;
            const Persons first = half(made.even, 0b00111111), second = half(made.odd, 0b00011011);
            constexpr int parts = Persons::part_count;
            for (int p = 0; p < parts; ++p) {
                both.part[p] = first.part[p];
                both.part[parts + p] = second.part[p];
            }
            rddl::normal_quantile(both).store(normals);
            last = needs_last ? draws.two(std::uint64_t{2}, std::uint64_t{persons / 2}).even : 0;
        }

        void store_speeds(State<rddl::Scalar>& s) const {
            s.speed_x[0] = five(normals, normals + n);
            s.speed_y[0] = five(normals + 3, normals + n + 3);
        }
        Persons infections() const {
            const double all[n] = {even[6], odd[6], even[7], odd[7], last};
            return Persons::load(all);
        }
        static Persons five(const double* even, const double* odd) {
            const double all[n] = {even[0], odd[0], even[1], odd[1], even[2]};
            return Persons::load(all);
        }
    };

    // ---------------------------------------------------------- environments in registers

    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& s,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Real = rddl::Lanes<double, n>;
        using Mask = rddl::Mask<n>;
        Real reward{0.0};
        for (std::size_t p = 0; p < persons; ++p) {
            const Real of_zombie = select(actions.stun[p], Real{-120.0}, Real{-100.0});
            const Real of_human = select(actions.stun[p], Real{-50.0}, Real{0.0});
            reward = reward - s.distance[p] + select(s.is_zombie[p], of_zombie, of_human);
        }
        Mask is_attacked[persons];
        Real chances[persons];  // their reciprocals
        for (std::size_t p = 0; p < persons; ++p) {
            is_attacked[p] = Mask(false);
            chances[p] = Real{1.0};
        }
        const auto attack = [&](std::size_t zombie, std::size_t other, const Mask& near) {
            const Mask is_near = near && s.is_zombie[zombie];
            is_attacked[other] = is_attacked[other] || (is_near && !s.is_stunned[zombie]);
            chances[other] = chances[other] + select(is_near, Real{1.0}, Real{0.0});
        };
        for (std::size_t p = 0; p < persons; ++p)
            for (std::size_t q = 0; q < p; ++q) {
                const Mask near = are_near(s.x[p], s.y[p], s.x[q], s.y[q]);
                attack(p, q, near);
                attack(q, p, near);
            }
        move(s, actions);
        draw_speeds(s.speed_x, 0, draws);
        draw_speeds(s.speed_y, 1, draws);
        for (std::size_t p = 0; p < persons; p += 2) {
            using Word = rddl::Lanes<std::uint64_t, n>;
            const auto wanted = [&](std::size_t k) {
                return k < persons && any(is_attacked[k] && !s.is_zombie[k]);
            };
            if (!wanted(p) && !wanted(p + 1)) continue;
            const auto numbers = draws.two(Word{std::uint64_t{2}}, Word{std::uint64_t{p / 2}});
            for (std::size_t k = p; k < std::min(p + 2, persons); ++k) {
                const Real& number = k == p ? numbers.even : numbers.odd;
                s.is_zombie[k] = s.is_zombie[k] || (is_attacked[k] && !(number < 1.0 / chances[k]));
            }
        }
        return reward;
    }
    template <int n, class Draws>
    static void draw_speeds(rddl::Lanes<double, n>* speeds, std::uint64_t site,
                            const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        for (std::size_t p = 0; p < persons; p += 2) {
            const auto numbers = draws.two(Word{site}, Word{std::uint64_t{p / 2}});
            speeds[p] = rddl::open_unit_real(numbers.even);
            if (p + 1 < persons) speeds[p + 1] = rddl::open_unit_real(numbers.odd);
        }
        rddl::replace_by_normal_quantiles<persons>(speeds, persons);
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double values[persons];
        std::byte bools[8]{};
        const auto store_all = [&](const auto* from, auto& all) {
            for (std::size_t p = 0; p < persons; ++p) {
                const int k = static_cast<int>(is_one<L> ? p : static_cast<std::size_t>(lane));
                const auto& of_register = from[is_one<L> ? 0 : p];
                all[p] = static_cast<std::remove_reference_t<decltype(all[p])>>(of_register[k]);
            }
            std::memcpy(record, all, sizeof all);
            record += sizeof all;
        };
        store_all(s.x, values);
        store_all(s.y, values);
        store_all(s.is_stunned, bools);
        store_all(s.distance, values);
        store_all(s.is_zombie, bools);
        store_all(s.speed_x, values);
        store_all(s.speed_y, values);
    }
};

}  // namespace handwritten
