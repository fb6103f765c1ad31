// Operators on packs give in each lane the bits that they give for the scalars there. This file is
// also built for other instruction sets than the compiler's default (CMakeLists.txt).
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace rddl {
namespace {

constexpr int width = 16;
using Reals = Pack<width>::Real;
using Ints = Pack<width>::Int;
using Bools = Pack<width>::Bool;

std::uint64_t bits(double a) {
    return std::isnan(a) ? 1 : std::bit_cast<std::uint64_t>(a);  // no nan but the one
}
std::uint64_t bits(std::int64_t a) {
    return static_cast<std::uint64_t>(a);
}
std::uint64_t bits(bool a) {
    return a;
}

std::vector<double> reals(unsigned seed) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> result = {0.0,   -0.0,     1.0,       -1.0,     0.5,       -0.5,   1.5,
                                  2.5,   infinity, -infinity, NAN,      0x1p-1074, 0x1p63, -0x1p63,
                                  1e300, -1e300,   0x1p52,    0x1.8p52, 0x1p62,    3.0};
    std::mt19937_64 random(seed);
    while (result.size() < 4000) {
        const double bounded = std::uniform_real_distribution<>(-20, 20)(random);
        result.push_back(random() % 4 ? bounded : std::bit_cast<double>(random()));
    }
    std::shuffle(result.begin(), result.end(), random);
    return result;
}

std::vector<std::int64_t> ints(unsigned seed) {
    using Limits = std::numeric_limits<std::int64_t>;
    std::vector<std::int64_t> result = {
        0, 1, -1, Limits::min(), Limits::max(), 1ll << 53, (1ll << 53) + 1, (1ll << 62) + 1};
    std::mt19937_64 random(seed);
    while (result.size() < 4000)
        result.push_back(static_cast<std::int64_t>(random()) >> (random() % 64));
    std::shuffle(result.begin(), result.end(), random);
    return result;
}

template <int n, class Function, class First, class... Others>
void expect_bits_in_lanes(const char* name, Function function, const std::vector<First>& first,
                          const std::vector<Others>&... others) {
    for (std::size_t i = 0; i + n <= first.size(); i += n) {
        const auto found =
            function(LanesOf<First, n>::load(&first[i]), LanesOf<Others, n>::load(&others[i])...);
        for (int lane = 0; lane < n; ++lane) {
            const std::size_t at = i + static_cast<std::size_t>(lane);
            ASSERT_EQ(bits(found[lane]), bits(function(first[at], others[at]...)))
                << name << " of " << first[at] << " in " << n << " lanes on " << simd::level;
        }
    }
}
// Four lanes are half a register of AVX-512.
template <class Function, class... Operands>
void expect_bits_of_scalars(const char* name, Function function,
                            const std::vector<Operands>&... operands) {
    expect_bits_in_lanes<width>(name, function, operands...);
    expect_bits_in_lanes<4>(name, function, operands...);
}

#define EXPECT_BITS_OF_SCALARS(expression, ...) \
    expect_bits_of_scalars(                     \
        #expression, [](auto... x) { return expression; }, __VA_ARGS__)

#ifdef RDDL_EXPECTED_LEVEL
TEST(Packs, UseTheRegistersAskedFor) {
    EXPECT_STREQ(simd::level, RDDL_EXPECTED_LEVEL);
}
#endif

TEST(Packs, ComputeWithRealsAsScalarsDo) {
    const std::vector<double> a = reals(1), b = reals(2);
    EXPECT_BITS_OF_SCALARS((x + ...), a, b);
    EXPECT_BITS_OF_SCALARS((x - ...), a, b);
    EXPECT_BITS_OF_SCALARS((x * ...), a, b);
    EXPECT_BITS_OF_SCALARS((x / ...), a, b);
    EXPECT_BITS_OF_SCALARS(-(x + ...), a);
    EXPECT_BITS_OF_SCALARS(minimum(x...), a, b);
    EXPECT_BITS_OF_SCALARS(maximum(x...), a, b);
    EXPECT_BITS_OF_SCALARS(minimum(0.0, x...), a);
    EXPECT_BITS_OF_SCALARS(maximum(0.0, x...), a);
    EXPECT_BITS_OF_SCALARS(minimum(-0.0, x...), a);
    EXPECT_BITS_OF_SCALARS(maximum(-0.0, x...), a);
    EXPECT_BITS_OF_SCALARS(minimum(1.0, x...), a);
    EXPECT_BITS_OF_SCALARS(maximum(x..., 0.0), a);
    EXPECT_BITS_OF_SCALARS(absolute(x...), a);
    EXPECT_BITS_OF_SCALARS(sign(x...), a);
    EXPECT_BITS_OF_SCALARS(floor_mod(x...), a, b);
    EXPECT_BITS_OF_SCALARS(truncate_to_int(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::round(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::floor(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::ceil(x...), a);
    EXPECT_BITS_OF_SCALARS(round_as_real(x...), a);
    EXPECT_BITS_OF_SCALARS(floor_as_real(x...), a);
    EXPECT_BITS_OF_SCALARS(ceil_as_real(x...), a);
}

TEST(Packs, ComputeElementaryFunctionsAsScalarsDo) {
    const std::vector<double> a = reals(3), b = reals(4);
    EXPECT_BITS_OF_SCALARS(rddl::sqrt(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::exp(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::ln(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::sin(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::cos(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::tan(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::tanh(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::atan(x...), a);
    EXPECT_BITS_OF_SCALARS(rddl::power(x...), a, b);
    EXPECT_BITS_OF_SCALARS(rddl::hypot(x...), a, b);
    EXPECT_BITS_OF_SCALARS(rddl::atan2(x...), a, b);
}

// Lanes far from the median are brought together where a pack has few of them.
TEST(Packs, FindNormalQuantilesAsScalarsDo) {
    const std::vector<double> central = {0.5, 0.075, 0.925, 0.0750000001, 0.3, 0.7, 0.9, 0.1};
    const std::vector<double> outside = {0x1p-53, 1 - 0x1p-53, 1e-12, 1 - 1e-12,
                                         1e-9,    0.0749999,   0.95,  0.01};
    std::mt19937_64 random(12);
    std::vector<double> probabilities;
    for (int count = 0; count <= width; ++count)
        for (int repetition = 0; repetition < 20; ++repetition) {
            std::array<double, width> pack;
            for (int i = 0; i < width; ++i)
                pack[static_cast<std::size_t>(i)] = (i < count ? outside : central)[random() % 8];
            std::shuffle(pack.begin(), pack.end(), random);
            probabilities.insert(probabilities.end(), pack.begin(), pack.end());
        }
    EXPECT_BITS_OF_SCALARS(normal_quantile(x...), probabilities);

    // Several packs whose lanes share registers.
    using Packed = Lanes<double, width>;
    const std::size_t packs = probabilities.size() / width;
    for (std::size_t first = 0; first < packs; ++first)
        for (std::uint32_t count = 1; count <= std::min<std::size_t>(4, packs - first); ++count) {
            const double* const p = probabilities.data() + first * width;
            std::array<Packed, 4> several;
            for (std::uint32_t i = 0; i < count; ++i) several[i] = Packed::load(p + i * width);
            replace_by_normal_quantiles<4>(several.data(), count);
            for (std::uint32_t i = 0; i < count * width; ++i)
                ASSERT_EQ(several[i / width][static_cast<int>(i % width)], normal_quantile(p[i]));
        }
}

// Packs of floats whose quantiles are computed in turns: in the middle, in the tails that uniform
// numbers reach, and beyond.
TEST(Packs, FindNormalQuantilesOfFloatsInTurns) {
    const std::vector<float> some = {0.5f,     0.3f, 0.9f, 0.01f, 1e-5f, 1.0f - 0x1p-24f,
                                     0x1p-24f, 1e-9f};
    std::mt19937_64 random(13);
    constexpr std::uint32_t most = 7;
    for (int repetition = 0; repetition < 50; ++repetition)
        for (std::uint32_t count = 1; count <= most; ++count) {
            std::array<Lanes<float, width>, most> packs;
            for (Lanes<float, width>& pack : packs)
                for (int lane = 0; lane < width; ++lane)
                    pack.set(lane, some[random() % (repetition % 8 + 1)]);
            const auto numbers = packs;
            replace_by_normal_quantiles<most>(packs.data(), count);
            for (std::uint32_t i = 0; i < count; ++i)
                for (int lane = 0; lane < width; ++lane)
                    ASSERT_EQ(packs[i][lane], normal_quantile(numbers[i][lane]));
        }
}

// A loop's normals in packs are those that each would be alone, in whichever order they are drawn.
template <class R>
void expect_normals_of_neighbours() {
    const auto context = [] {
        std::array<std::uint64_t, width> low, high;
        for (std::size_t lane = 0; lane < width; ++lane) {
            const StreamKey key = lane == 3 ? median_key : stream_key(5, lane, 0);
            low[lane] = key.low;
            high[lane] = key.high;
        }
        using Word = typename Pack<width, R>::Word;
        return Context<Pack<width, R>>::of(Word::load(low.data()), Word::load(high.data()),
                                           Word{std::uint64_t{3}}, true);
    };
    const auto expect_same = [&]<Index count>() {
        for (const Index first : {0, 1, 3, 4}) {
            auto together = context(), alone = context();
            for (Index i = first; i < first + count; ++i)
                for (const std::uint32_t series : {2, 6, 3}) {
                    const Place place(0, i % count, series);
                    const auto drawn =
                        sample::normal(together, PlaceAmong<count>(0, i % count, series), 2.0, 3.0);
                    const auto expected = sample::normal(alone, place, 2.0, 3.0);
                    const Place next(1, i % count, series + 1);
                    const auto number =
                        uniform_at(together, PlaceAmong<count>(1, i % count, series + 1));
                    const auto expected_number = uniform_at(alone, next);
                    for (int lane = 0; lane < width; ++lane) {
                        ASSERT_EQ(drawn[lane], expected[lane]) << count << ": " << i % count;
                        ASSERT_EQ(number[lane], expected_number[lane])
                            << count << ": " << i % count;
                    }
                }
        }
    };
    expect_same.template operator()<2>();
    expect_same.template operator()<3>();
    expect_same.template operator()<5>();
    expect_same.template operator()<6>();
    expect_same.template operator()<9>();
}
TEST(Packs, DrawNormalsOfNeighboursTogether) {
    expect_normals_of_neighbours<double>();
    expect_normals_of_neighbours<float>();
}

// A bool stands for 0 or 1, on both sides.
auto product_if_first_is_less(const auto& a, const auto& b) {
    return wrap_sub(wrap_mul(a < b, b), wrap_mul(a, b < a));
}

TEST(Packs, TakeABoolOfAllLanesAsAFactorOfInts) {
    const Lanes<std::int64_t, width> a{7};
    for (const bool is_one : {false, true})
        for (int lane = 0; lane < width; ++lane) {
            EXPECT_EQ(wrap_mul(a, is_one)[lane], 7 * is_one);
            EXPECT_EQ(wrap_mul(is_one, a)[lane], 7 * is_one);
        }
}

TEST(Packs, ComputeWithIntsAsScalarsDo) {
    const std::vector<std::int64_t> a = ints(5), b = ints(6);
    EXPECT_BITS_OF_SCALARS(wrap_add(x...), a, b);
    EXPECT_BITS_OF_SCALARS(wrap_sub(x...), a, b);
    EXPECT_BITS_OF_SCALARS(wrap_mul(x...), a, b);
    EXPECT_BITS_OF_SCALARS(wrap_neg(x...), a);
    EXPECT_BITS_OF_SCALARS(product_if_first_is_less(x...), a, b);
    EXPECT_BITS_OF_SCALARS(minimum(x...), a, b);
    EXPECT_BITS_OF_SCALARS(maximum(x...), a, b);
    EXPECT_BITS_OF_SCALARS(absolute(x...), a);
    EXPECT_BITS_OF_SCALARS(sign(x...), a);
    EXPECT_BITS_OF_SCALARS(to_real(x...), a);
    EXPECT_BITS_OF_SCALARS(bit_and(x...), a, b);
    EXPECT_BITS_OF_SCALARS(bit_or(x...), a, b);
    EXPECT_BITS_OF_SCALARS(bit_xor(x...), a, b);
    EXPECT_BITS_OF_SCALARS(shift_right(x..., 5), a);
    EXPECT_BITS_OF_SCALARS(count_ones(x...), a);
}

// The six comparisons, each once, of a and b.
template <class T>
void expect_comparisons_of_scalars(const std::vector<T>& a, const std::vector<T>& b) {
    expect_bits_of_scalars(
        "<", [](auto x, auto y) { return x < y; }, a, b);
    expect_bits_of_scalars(
        "<=", [](auto x, auto y) { return x <= y; }, a, b);
    expect_bits_of_scalars(
        "==", [](auto x, auto y) { return x == y; }, a, b);
    expect_bits_of_scalars(
        "!=", [](auto x, auto y) { return x != y; }, a, b);
    expect_bits_of_scalars(
        ">", [](auto x, auto y) { return x > y; }, a, b);
    expect_bits_of_scalars(
        ">=", [](auto x, auto y) { return x >= y; }, a, b);
    expect_bits_of_scalars(
        "select", [](auto x, auto y) { return select(x < y && !(y == x), y, x); }, a, b);
}

TEST(Packs, CompareAsScalarsDo) {
    expect_comparisons_of_scalars(reals(7), reals(8));
    expect_comparisons_of_scalars(ints(9), ints(10));
    expect_comparisons_of_scalars(reals(7), reals(7));
    expect_comparisons_of_scalars(ints(9), ints(9));
}

TEST(Packs, TakeBranchesInEachLane) {
    const auto third = [] {
        return Bools::of_bits(0x00FF);
    };
    for (const std::uint64_t pattern : {0x0000u, 0x0001u, 0xA5A5u, 0xFFFFu}) {
        const Bools first = Bools::of_bits(pattern);
        const Bools chosen = branch(
            first, [] { return true; }, [&] { return !first; }, [] { return false; }, third);
        EXPECT_EQ(chosen.bits, pattern) << "the second condition holds where the first does not";
        const auto number = branch(
            first, [] { return Ints{1}; }, third, [] { return Ints{2}; }, [] { return Ints{3}; });
        for (int lane = 0; lane < width; ++lane)
            EXPECT_EQ(number[lane], first[lane] ? 1 : third()[lane] ? 2 : 3);
    }
    const Bools of_all = branch(true, third, [] { return false; });
    EXPECT_EQ(of_all.bits, third().bits);
}

template <std::size_t size>
void expect_elements_of_scalars() {
    std::array<double, size> table;
    std::array<float, size> floats;
    std::array<std::int64_t, size> numbers;
    std::array<bool, size> flags;
    std::array<Bools, size> flags_of_lanes;
    for (std::size_t i = 0; i < size; ++i) {
        table[i] = 0.1 * static_cast<double>(i);
        floats[i] = static_cast<float>(table[i]);
        numbers[i] = -static_cast<std::int64_t>(i * i);
        flags[i] = i * i % 7 < 3;
        flags_of_lanes[i] = Bools::of_bits(0x9E3779B9 * (i + 1) >> 7);
    }
    std::vector<std::int64_t> indices = ints(11);
    for (std::int64_t& index : indices) index = floor_mod(index, std::int64_t{size});
    expect_bits_of_scalars(
        "at", [&](auto i) { return at(table, i); }, indices);
    expect_bits_in_lanes<width>(
        "at", [&](auto i) { return at(floats, i); }, indices);
    expect_bits_of_scalars(
        "at", [&](auto i) { return at(numbers, i); }, indices);
    expect_bits_of_scalars(
        "at", [&](auto i) { return at(flags, i); }, indices);
    const Ints own = Ints::load(indices.data());
    const Bools found = at(flags_of_lanes, own);
    for (int lane = 0; lane < width; ++lane)
        EXPECT_EQ(found[lane], flags_of_lanes[static_cast<std::size_t>(own[lane])][lane])
            << own[lane] << " of " << size << " in lane " << lane << " on " << simd::level;
}

// Tables of up to 32 numbers or 64 bools, or 32 bools of each lane, are kept in registers. Small
// tables are not read in units of 8 bytes.
TEST(Packs, ReadTablesInEachLane) {
    expect_elements_of_scalars<1>();
    expect_elements_of_scalars<3>();
    expect_elements_of_scalars<8>();
    expect_elements_of_scalars<9>();
    expect_elements_of_scalars<16>();
    expect_elements_of_scalars<17>();
    expect_elements_of_scalars<32>();
    expect_elements_of_scalars<33>();
    expect_elements_of_scalars<37>();
    expect_elements_of_scalars<64>();
    expect_elements_of_scalars<65>();
    expect_elements_of_scalars<513>();
}

template <std::size_t rows>
void expect_columns_of_scalars() {
    std::array<std::array<std::array<bool, 5>, 6>, rows> table;
    for (std::size_t i = 0; i < rows * 30; ++i) table[i / 30][i / 5 % 6][i % 5] = i * i % 7 < 3;
    std::vector<std::int64_t> indices = ints(11);
    for (std::int64_t& index : indices) index = floor_mod(index, std::int64_t{rows});
    for (const std::int64_t x : {0, 3, 5})
        for (const std::int64_t y : {0, 4})
            expect_bits_of_scalars(
                "at", [&](auto i) { return at(table, i, x, y); }, indices);
}

// Few rows: a column is the bits of a number. Two rows of 30 have no more than a word.
TEST(Packs, ReadColumnsInEachLane) {
    expect_columns_of_scalars<2>();
    expect_columns_of_scalars<3>();
    expect_columns_of_scalars<16>();
    expect_columns_of_scalars<17>();
}

}  // namespace
}  // namespace rddl
