// RecSim_ippc2023 1: 15 items of three providers, and a fourth one that has nothing to give, for
// ten consumers.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

#include <rddl/random/distributions/normal_quantile.hpp>

#include <cmath>

namespace handwritten {

struct RecSim : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 100;
    static constexpr bool stochastic = true;
    static constexpr std::size_t items = 15, consumers = std::size(recsim::affinity),
                                 providers = std::size(recsim::competence), features = 2, room = 16;
    static constexpr std::int64_t no_provider = providers;  // an item that no provider has

    template <class L>
    struct State {
        typename L::Real provider[providers], consumer[consumers], feature[features][room];
        typename L::Int owner[room];
    };
    // The recommendation to each consumer: one item, or no item.
    static constexpr std::int64_t none = items;
    template <class L>
    struct Actions {
        typename L::Int item[consumers];
    };

    static void start(State<rddl::Scalar>& state) {
        state = {};
        for (std::size_t p = 0; p < providers; ++p) state.provider[p] = recsim::satisfaction[p];
        for (std::int64_t& owner : state.owner) owner = no_provider;
        for (std::size_t i = 0; i < items; ++i)
            for (std::size_t f = 0; f < features; ++f)
                state.feature[f][i] = recsim::first_features[i][f];
    }
    template <class L>
    static void start(State<L>& state, typename L::Bool where) {
        for (std::size_t p = 0; p < providers; ++p)
            state.provider[p] = select(where, recsim::satisfaction[p], state.provider[p]);
        for (auto& satisfaction : state.consumer) satisfaction = select(where, 0.0, satisfaction);
        for (auto& owner : state.owner) owner = select(where, no_provider, owner);
        for (std::size_t i = 0; i < items; ++i)
            for (std::size_t f = 0; f < features; ++f)
                state.feature[f][i] =
                    select(where, recsim::first_features[i][f], state.feature[f][i]);
    }

    static std::int64_t only_item(const std::byte* row) {
        const std::uint64_t bits = bits_of_bytes<items>(row);
        return bits != 0 && (bits & (bits - 1)) == 0 ? __builtin_ctzll(bits) : none;
    }
    static void load(Actions<rddl::Scalar>& actions, const std::byte* record) {
        for (std::size_t c = 0; c < consumers; ++c) actions.item[c] = only_item(record + c * items);
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        for (std::size_t c = 0; c < consumers; ++c) {
            std::int64_t each[L::width];
            for (std::size_t lane = 0; lane < L::width; ++lane)
                each[lane] = only_item(records + (lane * consumers + c) * items);
            actions.item[c] = L::Int::load(each);
        }
    }

    static double root(double a) { return std::sqrt(a); }
    template <int n>
    static rddl::Lanes<double, n> root(const rddl::Lanes<double, n>& a) {
        return rddl::sqrt(a);
    }
    template <class Real>
    static Real affinity(const double (&of)[features], const Real& first, const Real& second) {
        const Real x = of[0] - first, y = of[1] - second;
        return recsim::greatest_affinity - root(x * x + y * y);
    }
    // An item belongs to the provider in whose part of [0, total) a number falls.
    template <class Real>
    struct Shares {
        Real limit[providers];
    };
    template <class Real>
    static Shares<Real> shares(const Real (&satisfaction)[providers]) {
        Shares<Real> shares;
        Real total{0.0};
        for (std::size_t p = 0; p < providers; ++p) {
            total = total + satisfaction[p];
            shares.limit[p] = total;
        }
        for (Real& limit : shares.limit) limit = limit / total;
        return shares;
    }

    // The competence of each provider, and that of no provider.
    static constexpr auto competence = [] {
        std::array<std::array<double, providers + 1>, features> all{};
        for (std::size_t p = 0; p < providers; ++p)
            for (std::size_t f = 0; f < features; ++f) all[f][p] = recsim::competence[p][f];
        return all;
    }();
    template <class Real>
    static Real normal(const Real& number) {
        return rddl::normal_quantile(rddl::open_unit_real(number));
    }

    // Registers over the items; even numbers are first features.
    template <class Draws>
    static double step(State<rddl::Scalar>& s, const Actions<rddl::Scalar>& actions,
                       const Draws& draws) {
        constexpr int n = lanes_in_one;
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Int = rddl::Lanes<std::int64_t, n>;
        using Real = rddl::Lanes<double, n>;
        const auto limits = shares(s.provider);
        double reward = 0;
        std::int64_t count[providers + 1]{};
        for (std::size_t c = 0; c < consumers; ++c) {
            reward += s.consumer[c];
            const std::int64_t item = actions.item[c];
            const auto i = static_cast<std::size_t>(item);
            s.consumer[c] = 0;
            if (item == none) continue;
            s.consumer[c] = affinity(recsim::affinity[c], s.feature[0][i], s.feature[1][i]);
            ++count[s.owner[i]];
        }
        for (std::size_t p = 0; p < providers; ++p)
            s.provider[p] = 0.5 * s.provider[p] + static_cast<double>(count[p]);

        const handwritten::Draws<Word> many{Word{draws.step},
                                            {Word{draws.key[0]}, Word{draws.key[1]}}};
        double luck[2 * n];
        const auto pairs = many.two(Word{std::uint64_t{1}}, counting_from<n>(0));
        for (int lane = 0; lane < n; ++lane) {
            luck[2 * lane] = pairs.even[lane];
            luck[2 * lane + 1] = pairs.odd[lane];
        }
        for (std::size_t i = 0; i < items; i += n) {
            const auto numbers = many.two(Word{std::uint64_t{0}}, counting_from<n>(i));
            const Int owner = Int::load(&s.owner[i]);
            const Real first = normal(numbers.even) + gather(competence[0].data(), owner),
                       second = normal(numbers.odd) + gather(competence[1].data(), owner);
            first.store(&s.feature[0][i]);
            second.store(&s.feature[1][i]);
            owner_by(Real::load(&luck[i]), limits).store(&s.owner[i]);
        }
        return reward;
    }
    template <int n, class Real>
    static rddl::Lanes<std::int64_t, n> owner_by(const rddl::Lanes<double, n>& number,
                                                 const Shares<Real>& shares) {
        using Int = rddl::Lanes<std::int64_t, n>;
        Int owner{0};
        for (const Real& limit : shares.limit)
            owner = owner + select(number < limit, Int{0}, Int{1});
        return owner;
    }

    // Registers over environments.
    template <int n, class Draws>
    static rddl::Lanes<double, n> step(State<rddl::Pack<n>>& s,
                                       const Actions<rddl::Pack<n>>& actions, const Draws& draws) {
        using Word = rddl::Lanes<std::uint64_t, n>;
        using Int = rddl::Lanes<std::int64_t, n>;
        using Real = rddl::Lanes<double, n>;
        const auto limits = shares(s.provider);
        const Int lanes = rddl::ints_of(counting_from<n>(0));
        Real reward{0.0};
        Int count[providers];
        for (Int& all : count) all = Int{0};
        for (std::size_t c = 0; c < consumers; ++c) {
            reward = reward + s.consumer[c];
            const auto is_one = actions.item[c] < none;
            const Int at =
                rddl::ints_of(rddl::words_of(actions.item[c]) * std::uint64_t{n}) + lanes;
            const auto feature = [&](std::size_t f) {
                return gather(reinterpret_cast<const double*>(s.feature[f]), at);
            };
            s.consumer[c] =
                select(is_one, affinity(recsim::affinity[c], feature(0), feature(1)), Real{0.0});
            const Int owner = gather_integers(reinterpret_cast<const std::int64_t*>(s.owner), at);
            for (std::size_t p = 0; p < providers; ++p)
                count[p] = count[p] +
                           select(is_one && owner == static_cast<std::int64_t>(p), Int{1}, Int{0});
        }
        for (std::size_t p = 0; p < providers; ++p)
            s.provider[p] = 0.5 * s.provider[p] + rddl::to_real(count[p]);
        for (std::size_t i = 0; i < items; ++i) {
            const auto numbers = draws.two(Word{std::uint64_t{0}}, Word{std::uint64_t{i}});
            s.feature[0][i] = normal(numbers.even) + gather(competence[0].data(), s.owner[i]);
            s.feature[1][i] = normal(numbers.odd) + gather(competence[1].data(), s.owner[i]);
        }
        for (std::size_t i = 0; i < items; i += 2) {
            const auto numbers = draws.two(Word{std::uint64_t{1}}, Word{std::uint64_t{i / 2}});
            s.owner[i] = owner_by(numbers.even, limits);
            if (i + 1 < items) s.owner[i + 1] = owner_by(numbers.odd, limits);
        }
        return reward;
    }

    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        double values[providers + consumers + items * features];
        double* next = values;
        for (const auto& satisfaction : s.provider) *next++ = lane_of(satisfaction, lane);
        for (const auto& satisfaction : s.consumer) *next++ = lane_of(satisfaction, lane);
        for (std::size_t i = 0; i < items; ++i)
            for (std::size_t f = 0; f < features; ++f) *next++ = lane_of(s.feature[f][i], lane);
        std::memcpy(record, values, sizeof values);
        record += sizeof values;
        for (std::size_t p = 0; p < providers; ++p)
            for (std::size_t i = 0; i < items; ++i)
                *record++ = std::byte{lane_of(s.owner[i], lane) == static_cast<std::int64_t>(p)};
    }
};

}  // namespace handwritten
