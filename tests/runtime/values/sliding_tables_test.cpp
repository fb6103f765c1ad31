#include <rddl/values/sliding_tables.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace rddl {
namespace {

constexpr std::size_t row = 9, rows = 3;
template <class L>
using Table = std::array<std::array<typename L::Real, row>, rows>;

// Two records of a state, which take turns. Packs of programs that may fault have no sliding
// buffers either.
template <class L, class Buffer = SlidingBuffer<L, Table<L>>>
struct Records {
    struct Record {
        Table<L> table{};
        [[no_unique_address]] Buffer buffer{};
    };
    std::array<Record, 2> of{};
    std::size_t current = 0;

    Record& state() { return of[current]; }
    // The terms have the places that each lane has in `places`, for all rows alike.
    void step(const Context<L>& context, const std::array<typename L::Int, 2>& places,
              const std::array<typename L::Real, 2>& terms) {
        Record& from = of[current];
        Record& to = of[1 - current];
        shift<row>(context, from.table, from.buffer, to.table, to.buffer);
        for (std::size_t r = 0; r < rows; ++r)
            add_to_row(window(to.table, to.buffer)[r], to.buffer,
                       Added<typename L::Int, typename L::Real>{places[0], terms[0]},
                       Added<typename L::Int, typename L::Real>{places[1], terms[1]});
        current = 1 - current;
    }
};

template <class R>
using PlainTable = std::array<std::array<R, row>, rows>;
template <class R>
PlainTable<R> plain_step(const PlainTable<R>& table, const std::array<std::int64_t, 2>& places,
                         const std::array<R, 2>& terms) {
    PlainTable<R> next;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t t = 0; t < row; ++t) {
            const auto term = [&](std::size_t i) {
                return places[i] == static_cast<std::int64_t>(t) ? terms[i] : R(0.0);
            };
            next[r][t] = R(0.0) + (term(0) + term(1) + (t + 1 < row ? table[r][t + 1] : R(0.0)));
        }
    return next;
}

template <class L>
Context<L> running(typename L::Bool active) {
    return Context<L>::of({}, {}, {}, active);
}
template <class Real>
void expect_same(const Real& a, const Real& b) {
    EXPECT_EQ(bits_of(a), bits_of(b)) << a << ' ' << b;
}

// Many steps, so that the table comes to the end of the buffer; some are settled, and some do not
// run in all lanes, as those where an episode is over.
template <class L, class Buffer = SlidingBuffer<L, Table<L>>>
void expect_same_as_plain() {
    using R = typename L::Element;
    constexpr int n = L::width;
    std::mt19937 random(7);
    Records<L, Buffer> records;
    std::array<PlainTable<R>, static_cast<std::size_t>(n)> plain{};
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t t = 0; t < row; ++t)
            for (int lane = 0; lane < n; ++lane) {
                const R value = t % 3 == 0 ? R(-0.0) : R(static_cast<int>(random() % 9) - 4);
                plain[static_cast<std::size_t>(lane)][r][t] = value;
                set_lane(records.state().table[r][t], lane, value);
            }
    for (int step = 0; step < 600; ++step) {
        const bool all_run = random() % 32 != 0;
        typename L::Bool active{true};
        if (!all_run || random() % 64 == 0) settle(records.state().table, records.state().buffer);
        if (!all_run) set_lane(active, static_cast<int>(random() % n), false);
        std::array<typename L::Int, 2> places{};
        std::array<typename L::Real, 2> terms{};
        std::array<std::int64_t, 2> last_places{};
        const bool are_places_alike = random() % 3 == 0;
        for (int lane = 0; lane < n; ++lane) {
            std::array<std::int64_t, 2> its_places{};
            std::array<R, 2> its_terms{};
            for (std::size_t i = 0; i < 2; ++i) {
                its_places[i] = static_cast<std::int64_t>(random() % (row + 4)) - 2;
                if (are_places_alike && lane > 0) its_places[i] = last_places[i];
                last_places[i] = its_places[i];
                its_terms[i] = random() % 4 == 0 ? R(-0.0) : R(static_cast<int>(random() % 5) - 2);
                set_lane(places[i], lane, its_places[i]);
                set_lane(terms[i], lane, its_terms[i]);
            }
            auto& table = plain[static_cast<std::size_t>(lane)];
            table = plain_step(table, its_places, its_terms);
        }
        records.step(running<L>(active), places, terms);
        const auto& state = records.state();
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t t = 0; t < row; ++t)
                for (int lane = 0; lane < n; ++lane)
                    expect_same<R>(get_lane(window(state.table, state.buffer)[r][t], lane),
                                   plain[static_cast<std::size_t>(lane)][r][t]);
    }
}

TEST(SlidingTables, MoveAndAddAsLoopsDo) {
    expect_same_as_plain<Scalar>();
    expect_same_as_plain<ScalarOf<float>>();
    expect_same_as_plain<Pack<16>>();
    expect_same_as_plain<Pack<8>>();
    expect_same_as_plain<Pack<16, float>>();
    expect_same_as_plain<Pack<16>, NoSlidingBuffer>();
}

TEST(SlidingTables, AreSharedWhileAllLanesRun) {
    Records<Pack<16>> records;
    for (int step = 0; step < steps_before_sliding; ++step) {
        records.step(running<Pack<16>>(true), {}, {});
        EXPECT_EQ(records.state().buffer.place, 0) << step;
    }
    records.step(running<Pack<16>>(true), {}, {});
    EXPECT_NE(records.state().buffer.place, 0);
    const auto* const elements = &window(records.state().table, records.state().buffer)[0][0];
    records.step(running<Pack<16>>(true), {}, {});
    EXPECT_EQ((&window(records.state().table, records.state().buffer)[0][0]), elements + 1);
    records.step(running<Pack<16>>(Mask<16>::of_bits(7)), {}, {});
    EXPECT_EQ(records.state().buffer.place, 0);
}

TEST(SlidingTables, KnowGreatElements) {
    using L = Pack<16>;
    Records<L> records;
    const auto is_moderate_now = [&] {
        return is_moderate<L>(records.state().table, records.state().buffer);
    };
    for (int step = 0; step <= steps_before_sliding; ++step)
        records.step(running<L>(true), {}, {L::Real{moderate}, L::Real{0.0}});
    EXPECT_NE(records.state().buffer.place, 0);
    EXPECT_TRUE(all(is_moderate_now()));
    L::Real term{0.0};
    term.set(5, std::numeric_limits<double>::infinity());
    records.step(running<L>(true), {L::Int{3}, L::Int{4}}, {L::Real{0.0}, term});
    EXPECT_EQ(is_moderate_now().bits, 0xffffU & ~(1U << 5));
    settle(records.state().table, records.state().buffer);
    EXPECT_EQ(is_moderate_now().bits, 0xffffU & ~(1U << 5));
}

}  // namespace
}  // namespace rddl
