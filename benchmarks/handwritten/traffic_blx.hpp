// TrafficBLX_SimplePhases 0: a crossing with four links that lead to it, each with a turn to the
// right, one ahead and one to the left, and four links that lead away. What travels along a link
// is a ring of the times at which it arrives, so that time passes without a move.
#pragma once

#include "bools.hpp"
#include "tables.hpp"

namespace handwritten {

struct TrafficBlx : RunsToTheHorizon {
    static constexpr int width = 16;
    static constexpr std::uint64_t horizon = 200;
    static constexpr bool stochastic = false;
    static constexpr std::size_t links = 4, times = 21, ring = 16, phases = 8;
    static constexpr double capacity = 100, arrivals = 0.3, greatest_inflow = 0.4,
                            greatest_turn = 0.53, share = 0.33;
    // A car of 6 m on one of four lanes, which it travels with 13.8 m/s.
    static constexpr double seconds_a_car = 6 / (4 * 13.8);

    // Four links: vectors of doubles for one environment, an array of registers for others.
    using Four = double __attribute__((vector_size(4 * sizeof(double))));
    template <class Real>
    struct Fours {
        Real of[links];
        friend Fours operator+(Fours a, const Fours& b) {
            return each(a, b, [](const Real& x, const Real& y) { return x + y; });
        }
        friend Fours operator-(Fours a, const Fours& b) {
            return each(a, b, [](const Real& x, const Real& y) { return x - y; });
        }
        friend Fours operator*(Fours a, const Fours& b) {
            return each(a, b, [](const Real& x, const Real& y) { return x * y; });
        }
        template <class Operation>
        static Fours each(Fours a, const Fours& b, const Operation& operation) {
            for (std::size_t k = 0; k < links; ++k) a.of[k] = operation(a.of[k], b.of[k]);
            return a;
        }
    };
    template <class L>
    static constexpr bool is_one = std::is_same_v<L, rddl::Scalar>;
    template <class L>
    using Links = std::conditional_t<is_one<L>, Four, Fours<typename L::Real>>;

    static Four everywhere(const Four&, double value) { return Four{} + value; }
    template <class Real>
    static Fours<Real> everywhere(const Fours<Real>&, double value) {
        return {{Real{value}, Real{value}, Real{value}, Real{value}}};
    }
    static Four least(const Four& a, const Four& b) { return a < b ? a : b; }
    static Four most(const Four& a, const Four& b) { return a > b ? a : b; }
    template <class Real>
    static Fours<Real> least(const Fours<Real>& a, const Fours<Real>& b) {
        return Fours<Real>::each(a, b,
                                 [](const Real& x, const Real& y) { return select(x < y, x, y); });
    }
    template <class Real>
    static Fours<Real> most(const Fours<Real>& a, const Fours<Real>& b) {
        return Fours<Real>::each(a, b,
                                 [](const Real& x, const Real& y) { return select(x > y, x, y); });
    }
    // Link k of the result is link k + `by` of four in a circle.
    template <int by>
    static Four turned(const Four& a) {
        return Four{a[by % 4], a[(1 + by) % 4], a[(2 + by) % 4], a[(3 + by) % 4]};
    }
    template <int by, class Real>
    static Fours<Real> turned(const Fours<Real>& a) {
        return {{a.of[by % 4], a.of[(1 + by) % 4], a.of[(2 + by) % 4], a.of[(3 + by) % 4]}};
    }
    static double total(const Four& a) { return (a[0] + a[1]) + (a[2] + a[3]); }
    template <class Real>
    static Real total(const Fours<Real>& a) {
        return (a.of[0] + a.of[1]) + (a.of[2] + a.of[3]);
    }

    // Episodes have the same length, so all environments of registers are at the same time.
    template <class L>
    struct State {
        Links<L> coming[ring], leaving[ring];  // by the time of arrival
        Links<L> right, ahead, left;           // queues
        Links<L> cars, cars_leaving, waiting;  // in links; before the links
        typename L::Int phase;
        typename L::Real phase_time;
        std::size_t now;
    };
    template <class L>
    struct Actions {
        typename L::Word advance;
    };

    static void start(State<rddl::Scalar>& s) { s = State<rddl::Scalar>{}; }
    template <class L>
    static void start(State<L>& s, typename L::Bool) {
        const Links<L> none = everywhere(s.right, 0);
        for (std::size_t time = 0; time < ring; ++time) s.coming[time] = s.leaving[time] = none;
        s.right = s.ahead = s.left = s.cars = s.cars_leaving = s.waiting = none;
        s.phase = typename L::Int{std::int64_t{0}};
        s.phase_time = typename L::Real{0.0};
        s.now = 0;
    }
    template <class L>
    static void load(Actions<L>& actions, const std::byte* records) {
        load_words(actions.advance, records, 1,
                   [](const std::byte* record) { return std::to_integer<std::uint64_t>(*record); });
    }

    static Four of_phase(const double (&table)[phases][links], std::int64_t phase) {
        Four values;
        std::memcpy(&values, table[phase], sizeof values);
        return values;
    }
    template <int n>
    static Fours<rddl::Lanes<double, n>> of_phase(const double (&table)[phases][links],
                                                  const rddl::Lanes<std::int64_t, n>& phase) {
        Fours<rddl::Lanes<double, n>> values;
        for (std::size_t k = 0; k < links; ++k)
            values.of[k] = gather(table[0] + k, phase * rddl::Lanes<std::int64_t, n>{links});
        return values;
    }
    static double of_phase(const double (&table)[phases], std::int64_t phase) {
        return table[phase];
    }
    template <int n>
    static rddl::Lanes<double, n> of_phase(const double (&table)[phases],
                                           const rddl::Lanes<std::int64_t, n>& phase) {
        return gather(table, phase);
    }

    // Cars that enter a link reach its queue after some steps, in two parts.
    static void send(State<rddl::Scalar>& s, const Four& entering, const Four& delay) {
        for (std::size_t k = 0; k < links; ++k) {
            const auto steps = static_cast<std::size_t>(delay[k]);
            const double later = entering[k] * (delay[k] - static_cast<double>(steps));
            s.coming[(s.now + steps) % ring][k] += entering[k] - later;
            s.coming[(s.now + steps + 1) % ring][k] += later;
        }
    }
    template <int n>
    static void send(State<rddl::Pack<n>>& s, const Fours<rddl::Lanes<double, n>>& entering,
                     const Fours<rddl::Lanes<double, n>>& delay) {
        using Real = rddl::Lanes<double, n>;
        static_assert(sizeof(Links<rddl::Pack<n>>) == links * n * sizeof(double));
        for (std::size_t k = 0; k < links; ++k) {
            const auto whole = rddl::floor(delay.of[k]);
            const Real later = entering.of[k] * (delay.of[k] - rddl::to_real(whole)),
                       sooner = entering.of[k] - later;
            for (int lane = 0; lane < n; ++lane) {
                const std::size_t at = s.now + static_cast<std::size_t>(whole[lane]);
                auto* const first = reinterpret_cast<double*>(&s.coming[at % ring].of[k]);
                auto* const second = reinterpret_cast<double*>(&s.coming[(at + 1) % ring].of[k]);
                first[lane] += sooner[lane];
                second[lane] += later[lane];
            }
        }
    }

    template <class L, class Draws>
    static typename L::Real step(State<L>& s, const Actions<L>& actions, const Draws&) {
        using Real = typename L::Real;
        using Int = typename L::Int;
        using Each = Links<L>;
        const auto same = [&](double value) {
            return everywhere(s.right, value);
        };
        const Each none = same(0);
        const Real value = -(total(s.cars) + total(s.cars_leaving) + total(s.waiting));

        const Each room = same(capacity) - s.cars, room_leaving = same(capacity) - s.cars_leaving;
        const Each wanted = s.waiting + same(arrivals);
        const Each entering = least(wanted, least(same(greatest_inflow), room));
        const Each reach_queue = s.coming[s.now], leave = s.leaving[s.now];
        const Each joins = same(share) * reach_queue;
        const auto flow = [&](const Each& queue, const Each& room_there) {
            return most(none, least(queue, least(same(greatest_turn), room_there)));
        };
        const Each queue_right = s.right + joins, queue_ahead = s.ahead + joins,
                   queue_left = s.left + joins;
        const Each delay = (same(capacity) - ((s.right + s.ahead) + s.left)) * same(seconds_a_car);
        const Each right = flow(queue_right, room_leaving);
        const Each ahead = of_phase(traffic_blx::green_through, s.phase) *
                           flow(queue_ahead, turned<1>(room_leaving));
        const Each left =
            of_phase(traffic_blx::green_left, s.phase) * flow(queue_left, turned<2>(room_leaving));
        const Each entering_leaving = right + turned<3>(ahead) + turned<2>(left);

        s.coming[s.now] = s.leaving[s.now] = none;
        s.now = (s.now + 1) % ring;
        send(s, entering, delay);
        // The way out is always as long.
        constexpr double whole_delay = capacity * seconds_a_car;
        constexpr auto steps = static_cast<std::size_t>(whole_delay);
        const Each later = entering_leaving * same(whole_delay - steps);
        Each& sooner = s.leaving[(s.now + steps) % ring];
        sooner = sooner + (entering_leaving - later);
        s.leaving[(s.now + steps + 1) % ring] = later;

        s.waiting = wanted - entering;
        s.right = queue_right - right;
        s.ahead = queue_ahead - ahead;
        s.left = queue_left - left;
        s.cars = s.cars + entering - ((right + ahead) + left);
        s.cars_leaving = s.cars_leaving + entering_leaving - leave;

        const auto may = s.phase_time >= of_phase(traffic_blx::least, s.phase);
        const auto must = s.phase_time >= of_phase(traffic_blx::most, s.phase);
        const auto advances = may && (must || !is_zero(actions.advance));
        s.phase = choose(advances, (s.phase + Int{1}) & Int{phases - 1}, s.phase);
        s.phase_time = select(advances, Real{0.0}, s.phase_time + 1.0);
        return value;
    }
    static std::int64_t choose(bool condition, std::int64_t a, std::int64_t b) {
        return condition ? a : b;
    }
    template <int n>
    static rddl::Lanes<std::int64_t, n> choose(rddl::Mask<n> condition,
                                               const rddl::Lanes<std::int64_t, n>& a,
                                               const rddl::Lanes<std::int64_t, n>& b) {
        return select(condition, a, b);
    }

    static double one_of(const Four& a, std::size_t link, std::int64_t) { return a[link]; }
    template <class Real>
    static double one_of(const Fours<Real>& a, std::size_t link, std::int64_t lane) {
        return lane_of(a.of[link], lane);
    }
    template <class L>
    static void store(const State<L>& s, std::int64_t lane, std::byte* record) {
        constexpr std::size_t all = 2 * links;  // those that leave have odd numbers
        struct Record {
            double flow[all][times], queue[all][all], cars[all], waiting[all];
            std::int64_t phase;
            double phase_time;
        } r{};
        for (std::size_t k = 0; k < links; ++k) {
            const std::size_t comes = 2 * k, leaves = 2 * k + 1;
            for (std::size_t time = 0; time < ring; ++time) {
                r.flow[comes][time] = one_of(s.coming[(s.now + time) % ring], k, lane);
                r.flow[leaves][time] = one_of(s.leaving[(s.now + time) % ring], k, lane);
            }
            r.queue[comes][(comes + 1) % all] = one_of(s.right, k, lane);
            r.queue[comes][(comes + 3) % all] = one_of(s.ahead, k, lane);
            r.queue[comes][(comes + 5) % all] = one_of(s.left, k, lane);
            r.cars[comes] = one_of(s.cars, k, lane);
            r.cars[leaves] = one_of(s.cars_leaving, k, lane);
            r.waiting[comes] = one_of(s.waiting, k, lane);
        }
        r.phase = lane_of(s.phase, lane);
        r.phase_time = lane_of(s.phase_time, lane);
        std::memcpy(record, &r, sizeof r);
    }
};

}  // namespace handwritten
