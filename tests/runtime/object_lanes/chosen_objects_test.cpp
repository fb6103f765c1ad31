// Loops over objects of which an action chooses few give what all iterations give. Also built for
// other instruction sets (CMakeLists.txt).
#include <rddl/object_lanes/chosen_objects.hpp>
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rddl {
namespace {

// Every `every`-th object is chosen. Some numbers are not probabilities.
template <std::size_t n>
void expect_the_chosen(std::size_t every, StreamKey key) {
    constexpr auto count = static_cast<Index>(n);
    std::array<bool, n> choices{}, kept{};
    std::array<double, n> chance{};
    for (std::size_t x = 0; x < n; ++x) {
        choices[x] = x % every == every / 2;
        kept[x] = x % 3 == 0;
        chance[x] = x == n / 2 ? 2 : static_cast<double>(x % 10) / 9;
    }
    const auto body = [&](auto& target) {
        return [&](auto& several, auto x) {
            elements(target, x) = branch(
                several, at(choices, x),
                [&] {
                    return sample::bernoulli(several, {3, x, 1}, at(chance, x));
                },
                [&] { return at(kept, x); });
        };
    };
    struct {
        std::array<bool, n> bools{};
        bool behind = true;
    } result;
    std::array<bool, n> expected{};
    Context<Scalar> context{key, 1, {}}, same_context = context;
    for_each_object<count>(context, body(expected));
    for_chosen_objects<count>(same_context, choices, kept, result.bools, body(result.bools));
    EXPECT_EQ(result.bools, expected) << n << " " << every;
    EXPECT_TRUE(result.behind);
    EXPECT_EQ(same_context.fault.kind, context.fault.kind);
    EXPECT_EQ(same_context.fault.place, context.fault.place);

    kept.fill(false);
    Context<Scalar> third_context{key, 1, {}};
    for_each_object<count>(context, body(expected));
    for_chosen_objects<count>(third_context, choices, result.bools, body(result.bools));
    EXPECT_EQ(result.bools, expected) << n << " " << every;
    EXPECT_TRUE(result.behind);
}

TEST(ChosenObjects, AreComputedAlone) {
    const StreamKey key = stream_key(1, 2, 3);
    for (const std::size_t every : {1, 4, 9, 20, 1000}) {
        expect_the_chosen<17>(every, key);
        expect_the_chosen<30>(every, key);
        expect_the_chosen<64>(every, key);
        expect_the_chosen<65>(every, key);
        expect_the_chosen<200>(every, key);
    }
    expect_the_chosen<64>(20, median_key);
}

// Callers write true as any byte but 0.
TEST(ChosenObjects, HaveAnyByteThatIsTrue) {
    std::array<bool, 40> choices{}, kept{}, target{};
    const unsigned char byte = 8;
    __builtin_memcpy(&choices[33], &byte, 1);
    Context<Scalar> context{stream_key(1, 2, 3), 1, {}};
    for_chosen_objects<40>(context, choices, kept, target,
                           [&](auto&, auto x) { elements(target, x) = true; });
    for (std::size_t x = 0; x < target.size(); ++x) EXPECT_EQ(target[x], x == 33);
}

// ----------------------------------------------------------------------------------- packs

constexpr std::size_t courses = 70;  // more than a word has bits

template <class T, class Make>
constexpr auto table_of(Make make) {
    std::array<T, courses> table{};
    for (std::size_t x = 0; x < courses; ++x) table[x] = static_cast<T>(make(x));
    return table;
}
constexpr auto kinds = table_of<std::int64_t>([](std::size_t x) { return x % 2; });
constexpr auto places = table_of<std::uint8_t>([](std::size_t x) { return x * 3 % courses; });
template <class R>
constexpr auto chance = table_of<R>([](std::size_t x) { return static_cast<R>(x) / 8; });
template <class R>
constexpr std::array<std::array<R, 3>, 2> by_kind{{{0.125, 0.25, 0.75}, {0.625, 0.5, 0.375}}};
template <class R>
constexpr auto by_count = table_of<std::array<R, 3>>([](std::size_t x) {
    return std::array<R, 3>{0.25, 0.5, static_cast<R>(x) / 8};
});

// Each environment chooses objects of its own, `most` at most; the last one has no stream but
// medians.
template <int n, class R>
void expect_the_own(int most) {
    using L = Pack<n, R>;
    struct {
        std::array<Mask<n>, courses> bools, behind;
    } result;
    std::array<Mask<n>, courses> choices, kept, expected;
    result.behind.fill(true);
    choices.fill(false);
    typename L::Word keys{};
    for (int lane = 0; lane < n; ++lane) {
        keys.set(lane, lane + 1 == n ? median_key.low : 10 + static_cast<std::uint64_t>(lane));
        for (int i = 0; i < lane % (most + 1); ++i)
            choices[static_cast<std::size_t>(lane * 11 + i * 33) % courses].set(lane, true);
    }
    for (std::size_t x = 0; x < courses; ++x)
        kept[x] = Mask<n>::of_bits(0x9E3779B97F4A7C15 * (x + 1) >> x % 17);
    const typename L::Word high{std::uint64_t{median_key.high}};
    Context<L> context = Context<L>::of(keys, high, typename L::Word{std::uint64_t{3}}, true);
    Context<L> same_context = context;
    const auto count = select(kept[5], std::int64_t{1}, std::int64_t{2});
    const auto body = [&](auto& target) {
        return [&](auto& several, auto x) {
            elements(target, x) = branch(
                several, at(choices, x),
                [&] {
                    const auto p = select(at_places<places>(kept, x), at(chance<R>, x),
                                          at_row<by_kind<R>, kinds>(x, count));
                    const auto q = select(at(kept, x), at_row<by_count<R>>(x, count), p);
                    const auto own = at_own(by_kind<R>, x, at(kinds, x), std::int64_t{1});
                    const auto r = select(at_own(kept, x, at(kinds, x)), own, q);
                    return sample::bernoulli(several, {3, x, 1}, r) ||
                           sample::valid_bernoulli(several, {4, x}, R(0.25));
                },
                [&] { return at(kept, x); });
        };
    };
    for_each_object<courses>(context, body(expected));
    for_chosen_objects<courses>(same_context, choices, kept, result.bools, body(result.bools));
    for (std::size_t x = 0; x < courses; ++x) {
        EXPECT_EQ(result.bools[x].bits, expected[x].bits) << x;
        EXPECT_TRUE(all(result.behind[x]));
    }
    EXPECT_TRUE(any(context.faulty));
    EXPECT_EQ(same_context.faulty.bits, context.faulty.bits);
    for_each_lane(context.faulty, [&](int lane) {
        EXPECT_EQ(same_context.fault_of(lane).place, context.fault_of(lane).place);
        EXPECT_EQ(same_context.fault_of(lane).value, context.fault_of(lane).value);
    });

    for (Mask<n>& each : kept) each = false;
    const auto draw = [&](auto& target) {
        return [&](auto& several, auto x) {
            elements(target, x) = branch(
                several, at(choices, x),
                [&] {
                    return sample::valid_bernoulli(several, {3, x}, at(chance<R>, x));
                },
                [&] { return false; });
        };
    };
    for_each_object<courses>(context, draw(expected));
    for_chosen_objects<courses>(context, choices, result.bools, draw(result.bools));
    for (std::size_t x = 0; x < courses; ++x) {
        EXPECT_EQ(result.bools[x].bits, expected[x].bits) << x;
        EXPECT_TRUE(all(result.behind[x]));
    }
}

TEST(ChosenObjects, AreEachEnvironmentsOwnInPacks) {
    expect_the_own<16, double>(3);
    expect_the_own<64, double>(2);
    expect_the_own<16, float>(3);
    expect_the_own<16, double>(20);  // too many: all objects are computed
}

}  // namespace
}  // namespace rddl
