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
