// Byte ints give in each lane what ints of 64 bits give there.
#include <rddl/simulator.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace rddl {
namespace {

TEST(ByteBits, OfOneEnvironmentAreAnInt) {
    EXPECT_EQ(byte_bits(std::array{true, false, true, true}), 13);
    EXPECT_EQ(byte_action_bits(std::array{true, false, true, true}), 13);
}
TEST(ByteBits, OfSmallPacksAreInts) {
    std::mt19937_64 random(0);
    std::array<Mask<16>, 6> bools;
    for (Mask<16>& each : bools) each = Mask<16>::of_bits(random());
    EXPECT_TRUE(all(byte_bits(bools) == bits(bools)));
}

#ifdef RDDL_SIMD_BYTE_INTS

constexpr int width = 64;
using Wide = Lanes<std::int64_t, width>;
using Bytes = ByteIntPack<>::Int;

// All results of a function stay within a byte: halves of its range.
std::vector<std::int64_t> small_ints(unsigned seed) {
    std::mt19937_64 random(seed);
    std::vector<std::int64_t> ints(width);
    for (std::int64_t& each : ints) each = static_cast<std::int64_t>(random() % 128) - 64;
    return ints;
}

template <class Function>
void expect_ints_of_64_bits(const char* name, Function function) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const Wide a = Wide::load(small_ints(2 * seed).data());
        const Wide b = Wide::load(small_ints(2 * seed + 1).data());
        const auto found = function(Bytes(a), Bytes(b));
        const auto expected = function(a, b);
        for (int lane = 0; lane < width; ++lane)
            ASSERT_EQ(found[lane], expected[lane]) << name << " of " << a[lane] << ", " << b[lane];
    }
}
#define EXPECT_INTS_OF_64_BITS(expression) \
    expect_ints_of_64_bits(                \
        #expression, []([[maybe_unused]] auto x, [[maybe_unused]] auto y) { return expression; })

TEST(ByteInts, ComputeAsIntsOf64Bits) {
    EXPECT_INTS_OF_64_BITS(wrap_add(x, y));
    EXPECT_INTS_OF_64_BITS(wrap_sub(x, y));
    EXPECT_INTS_OF_64_BITS(wrap_add(x, 60));
    EXPECT_INTS_OF_64_BITS(wrap_sub(60, y));
    EXPECT_INTS_OF_64_BITS(wrap_neg(x));
    EXPECT_INTS_OF_64_BITS(minimum(x, y));
    EXPECT_INTS_OF_64_BITS(maximum(-3, y));
    EXPECT_INTS_OF_64_BITS(select(x < y, x, y));
    EXPECT_INTS_OF_64_BITS(select(x < 3, 7, y));
    EXPECT_INTS_OF_64_BITS(select(x < 3, x, 7));
    EXPECT_INTS_OF_64_BITS(wrap_add(y, select(x < 3, 5, 7)));
    EXPECT_INTS_OF_64_BITS(wrap_add(to_int(x < 3), y));
    EXPECT_INTS_OF_64_BITS(to_real(x));
    EXPECT_INTS_OF_64_BITS(to_float(x));
}

TEST(ByteInts, CompareAsIntsOf64Bits) {
    EXPECT_INTS_OF_64_BITS(x == y);
    EXPECT_INTS_OF_64_BITS(x != y);
    EXPECT_INTS_OF_64_BITS(x < y);
    EXPECT_INTS_OF_64_BITS(x <= y);
    EXPECT_INTS_OF_64_BITS(x > 3);
    EXPECT_INTS_OF_64_BITS(-3 >= y);
}

TEST(ByteInts, AreMadeOfBools) {
    const Mask<width> mask = Mask<width>::of_bits(0xF0F1F2F3F4F5F6F7);
    const auto bytes = to_int<Bytes>(mask);
    for (int lane = 0; lane < width; ++lane) EXPECT_EQ(bytes[lane], mask[lane]);
}

TEST(ByteInts, HaveBits) {
    EXPECT_INTS_OF_64_BITS(bit_and(x, y));
    EXPECT_INTS_OF_64_BITS(bit_or(x, y));
    EXPECT_INTS_OF_64_BITS(bit_xor(x, y));
    EXPECT_INTS_OF_64_BITS(bit_and(63, y));
    EXPECT_INTS_OF_64_BITS(count_ones(bit_and(x, 63)));
    EXPECT_EQ(count_ones(Bytes(-1))[5], 8);
}

TEST(ByteInts, AreTheBitsOfAFewBools) {
    std::mt19937_64 random(0);
    std::array<Mask<width>, 7> bools, spread_bools;
    for (Mask<width>& each : bools) each = Mask<width>::of_bits(random());
    const Bytes found = byte_bits(bools);
    const Wide expected = bits(bools);
    for (int lane = 0; lane < width; ++lane) EXPECT_EQ(found[lane], expected[lane]);
    spread(spread_bools, found);
    for (std::size_t i = 0; i < bools.size(); ++i)
        EXPECT_EQ(spread_bools[i].bits, bools[i].bits) << i;
}

template <class T, std::size_t rows, std::size_t columns>
auto table_of_remainders() {
    std::array<std::array<T, columns>, rows> table;
    for (std::size_t k = 0; k < rows * columns; ++k)
        table[k / columns][k % columns] = static_cast<T>(k * 5 % 7 % (sizeof(T) == 1 ? 2 : 7));
    return table;
}
template <class T, std::size_t rows, std::size_t columns>
void expect_elements() {
    const auto table = table_of_remainders<T, rows, columns>();
    Wide row, column;
    for (int lane = 0; lane < width; ++lane) {
        row.set(lane, lane % static_cast<int>(rows));
        column.set(lane, lane % static_cast<int>(columns));
    }
    const auto in_last_row = at(table, rows - 1, Bytes(column));
    const auto in_first_column = at(table, Bytes(row), 0);
    const auto anywhere = at(table, Bytes(row), Bytes(column));
    for (int lane = 0; lane < width; ++lane) {
        const auto r = static_cast<std::size_t>(row[lane]);
        const auto c = static_cast<std::size_t>(column[lane]);
        EXPECT_EQ(in_last_row[lane], table[rows - 1][c]) << c;
        EXPECT_EQ(in_first_column[lane], table[r][0]) << r;
        EXPECT_EQ(anywhere[lane], table[r][c]) << r << ", " << c;
    }
}
TEST(ByteInts, AreIndicesOfTables) {
    expect_elements<std::int64_t, 2, 3>();
    expect_elements<std::int64_t, 3, 8>();
    expect_elements<std::int64_t, 3, 13>();
    expect_elements<std::int64_t, 2, 64>();
    expect_elements<std::int64_t, 2, 70>();
    expect_elements<bool, 4, 5>();
    expect_elements<bool, 2, 64>();
    expect_elements<bool, 3, 70>();
    expect_elements<double, 3, 7>();
    expect_elements<double, 3, 40>();
}

template <int columns>
void expect_columns_of_rows() {
    std::array<std::array<std::int64_t, columns>, width> rows;
    for (std::size_t row = 0; row < width; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            rows[row][column] = static_cast<std::int64_t>(row * 2) - static_cast<int>(column * 7);
    simd::ByteInts found[columns];
    simd::Words any{};
    simd::narrow_rows(rows.data(), found, any);
    std::uint64_t bits = 0, bits_found = 0;
    for (std::size_t row = 0; row < width; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            bits |= static_cast<std::uint64_t>(rows[row][column]);
    for (int i = 0; i < simd::lanes; ++i) bits_found |= any[i];
    EXPECT_EQ(bits_found, bits);
    for (std::size_t row = 0; row < width; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            EXPECT_EQ(found[column][row], rows[row][column]) << row << ", " << column;
}
TEST(ByteInts, AreReadFromRows) {
    expect_columns_of_rows<2>();
    expect_columns_of_rows<4>();
    expect_columns_of_rows<8>();
}

#endif

}  // namespace
}  // namespace rddl
