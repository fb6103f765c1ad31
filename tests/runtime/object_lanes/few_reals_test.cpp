// Loops over so few reals that half a register of AVX-512 holds them give what one object after the
// other gives. Also built for other instruction sets (CMakeLists.txt).
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddl {
namespace {

constexpr std::array<std::array<double, 3>, 4> rows = {
    {{0.5, 1.5, 4.0}, {-0.0, 2.0, 8.0}, {1e300, -1.0, 7.0}, {0.25, 3.0, -2.0}}};
constexpr std::array<std::array<bool, 3>, 4> flags = {
    {{true, false, true}, {false, false, true}, {true, true, false}, {false, true, true}}};
constexpr std::array<double, 40> long_table = [] {
    std::array<double, 40> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = 1.0 / static_cast<double>(i + 3);
    return table;
}();

template <std::size_t count>
struct Tables {
    std::array<double, count> level{}, angle{};
    std::array<std::int64_t, count> number{};
    std::array<std::array<double, 2>, count> pair{};
    std::array<double, count> computed{}, chosen{}, normal{}, uniform{}, wait{};
    double behind = -1;
    std::array<std::int64_t, count> rounded{};
    std::int64_t behind_rounded = -1;

    std::vector<std::uint64_t> results() const {
        std::vector<std::uint64_t> bits = {std::bit_cast<std::uint64_t>(behind),
                                           static_cast<std::uint64_t>(behind_rounded)};
        for (const auto* table : {&computed, &chosen, &normal, &uniform, &wait})
            for (const double each : *table) bits.push_back(std::bit_cast<std::uint64_t>(each));
        for (const std::int64_t each : rounded) bits.push_back(static_cast<std::uint64_t>(each));
        return bits;
    }
};
template <std::size_t count>
Tables<count> tables() {
    Tables<count> all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto number = static_cast<double>(i);
        all.level[i] = 0.5 + 0.75 * number;
        all.angle[i] = i == 1 ? 1e9 : 100.0 * number;  // a great angle is the C library's
        all.number[i] = static_cast<std::int64_t>(2 * i) % 3;
        all.pair[i] = {number, 1.0 - 0.3 * number};
    }
    return all;
}

// For several objects or for one.
template <std::size_t count, class Several, class Object>
void evaluate(Tables<count>& all, Several& several, const Object& x) {
    const auto level = at(all.level, x);
    const auto number = at(all.number, x);
    const auto term = rddl::sin(at(all.angle, x)) * at(all.pair, x, 1) / (level + 1.0);
    elements(all.computed, x) = minimum(1e6, maximum(-0.25, term - rddl::sqrt(level)));
    const auto element = at_own(long_table, x, wrap_add(number, 35)) + at_own(rows, x, number, 1);
    elements(all.chosen, x) = branch(
        several, at(flags, x, number), [&] { return rddl::exp(level) * at(rows, x, number); },
        [&] { return element + to_real(number) + to_real(level > 1.0); });
    elements(all.rounded, x) = rddl::round(level * 3.0);
    elements(all.normal, x) = sample::normal(several, PlaceAmong<Index{count}>{0, x}, level, 4.0);
    elements(all.uniform, x) = sample::uniform(several, {1, x}, 0.0, level);
    elements(all.wait, x) = sample::weibull(several, {2, x}, 1.5, level);
}

template <std::size_t count>
void expect_values_one_by_one(StreamKey key) {
    Context<Scalar> context{key, 5, {}}, other = context;
    Tables<count> together = tables<count>(), one_by_one = together;
    for_few_reals<Index{count}>(
        context, [&](auto& several, auto x) { evaluate<count>(together, several, x); });
    for (Index i = 0; i < Index{count}; ++i) evaluate<count>(one_by_one, other, OneObject{i});
    EXPECT_EQ(together.results(), one_by_one.results()) << count << " on " << simd::level;
    EXPECT_FALSE(context.faulted());
}

TEST(FewReals, AreThoseOfOneObjectAfterTheOther) {
    for (const StreamKey key : {stream_key(1, 2, 3), stream_key(4, 5, 6), median_key}) {
        expect_values_one_by_one<1>(key);
        expect_values_one_by_one<2>(key);
        expect_values_one_by_one<3>(key);
        expect_values_one_by_one<4>(key);
    }
}

TEST(FewReals, TellTheFaultOfTheFirstObject) {
    const std::array<double, 4> variance = {1, 2, -3, -4};
    std::array<double, 4> levels{};
    Context<Scalar> context{stream_key(1, 2, 3), 1, {}};
    for_few_reals<4>(context, [&](auto& several, auto x) {
        elements(levels, x) = sample::normal(several, {1, x}, 0.0, at(variance, x));
    });
    EXPECT_EQ(context.fault.kind, FaultKind::Variance);
    EXPECT_EQ(context.fault.place, Place(1, 2));
    EXPECT_EQ(context.fault.value, -3);
}

// Four floats take no less than half a register.
TEST(FewReals, MayBeFloats) {
    const std::array<float, 3> level = {0.5f, 1.25f, 3.0f};
    std::array<float, 3> result{};
    Context<ScalarOf<float>> context{stream_key(1, 2, 3), 1, {}};
    for_few_reals<3>(context, [&](auto&, auto x) {
        elements(result, x) = rddl::sin(at(level, x)) / at(level, x);
    });
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(result[i], rddl::sin(level[i]) / level[i]);
}

TEST(FewReals, ArePlainElementsInPacks) {
    using L = Pack<16>;
    auto context = Context<L>::of(L::Word{7}, L::Word{9}, L::Word{1}, true);
    const std::array<L::Real, 3> level = {L::Real{1.0}, L::Real{2.0}, L::Real{3.0}};
    std::array<L::Real, 3> half;
    for_few_reals<3>(context, [&](auto&, auto x) { elements(half, x) = 0.5 * at(level, x); });
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(half[i][5], 0.5 * static_cast<double>(i + 1));
}

}  // namespace
}  // namespace rddl
