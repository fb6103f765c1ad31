// Rows of the C interface become blocks of packs and rows again. This file is also built for other
// instruction sets than the compiler's default (CMakeLists.txt).
#include <rddl/step/columns.hpp>
#include <rddl/values/tables.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace rddl {
namespace {

constexpr std::int64_t bool_count = 150, real_count = 3, int_count = 2;

// A row of the actions, and a block of them.
struct Row {
    std::array<bool, bool_count> bools;
    std::array<double, real_count> reals;
    std::array<std::int64_t, int_count> ints;
    bool last;
};
template <class L>
struct Block {
    std::array<typename L::Bool, bool_count> bools;
    std::array<typename L::Real, real_count> reals;
    std::array<typename L::Int, int_count> ints;
    typename L::Bool last;
};

constexpr rddl_fluent action(const char* name, rddl_scalar scalar, std::int64_t count,
                             std::int64_t offset) {
    return {name, RDDL_ACTION, scalar, -1, 0, nullptr, count, offset, nullptr, nullptr, {}};
}
constexpr rddl_fluent fluents[] = {
    action("bools", RDDL_BOOL, bool_count, offsetof(Row, bools)),
    action("reals", RDDL_REAL, real_count, offsetof(Row, reals)),
    {"state", RDDL_STATE, RDDL_REAL, -1, 0, nullptr, 1, 0, nullptr, nullptr, {}},
    action("ints", RDDL_INT, int_count, offsetof(Row, ints)),
    action("last", RDDL_BOOL, 1, offsetof(Row, last))};
constexpr rddl_problem problem = [] {
    rddl_problem described{};
    described.fluents = fluents;
    described.fluent_count = std::size(fluents);
    described.action_size = sizeof(Row);
    return described;
}();

std::vector<Row> random_rows(int count) {
    std::mt19937_64 random(21);
    std::vector<Row> rows(static_cast<std::size_t>(count));
    for (Row& row : rows) {
        std::memset(&row, 0, sizeof row);  // also padding
        for (bool& value : row.bools) value = random() % 3 == 0;
        for (double& value : row.reals) value = static_cast<double>(random() % 1000) / 8;
        for (std::int64_t& value : row.ints) value = static_cast<std::int64_t>(random());
        row.last = random() % 2 == 0;
    }
    return rows;
}

template <class L>
void expect_lane(const Block<L>& block, int lane, const Row& row) {
    for (std::size_t k = 0; k < bool_count; ++k)
        ASSERT_EQ(get_lane(block.bools[k], lane), row.bools[k]) << "bool " << k << " of " << lane;
    for (std::size_t k = 0; k < real_count; ++k)
        ASSERT_EQ(get_lane(block.reals[k], lane), row.reals[k]) << "real " << k << " of " << lane;
    for (std::size_t k = 0; k < int_count; ++k)
        ASSERT_EQ(get_lane(block.ints[k], lane), row.ints[k]) << "int " << k << " of " << lane;
    ASSERT_EQ(get_lane(block.last, lane), row.last) << lane;
}

template <class Lane>
struct ColumnsOf : testing::Test {};
using PackTypes = testing::Types<Pack<8>, Pack<16>, Pack<32>, Pack<64>, Pack<16, float>>;
TYPED_TEST_SUITE(ColumnsOf, PackTypes);

// The records are at an odd address, as callers may have them.
TYPED_TEST(ColumnsOf, ReadAndWriteWholeAndOtherBlocks) {
    using L = TypeParam;
    const Columns columns = columns_of<L>(problem, RDDL_ACTION, problem.action_size);
    constexpr auto known = known_columns<L, problem, RDDL_ACTION>(problem.action_size);
    ASSERT_EQ(columns.block_size, static_cast<std::int64_t>(sizeof(Block<L>)));
    ASSERT_EQ(known.block_size, columns.block_size);
    for (const int present : {1, 7, L::width - 1, L::width}) {
        const std::vector<Row> rows = random_rows(present);
        const std::size_t size = rows.size() * sizeof(Row);
        std::vector<std::byte> given(size + 1), written(size + 1);
        std::memcpy(given.data() + 1, rows.data(), size);

        Block<L> block, same;
        read_records(L{}, columns, given.data() + 1, present, reinterpret_cast<std::byte*>(&block));
        read_records(L{}, known, given.data() + 1, present, reinterpret_cast<std::byte*>(&same));
        for (int lane = 0; lane < present; ++lane) {
            expect_lane(block, lane, rows[static_cast<std::size_t>(lane)]);
            expect_lane(same, lane, rows[static_cast<std::size_t>(lane)]);
        }
        for (int lane = present; lane < L::width; ++lane)
            EXPECT_FALSE(get_lane(block.bools[0], lane));

        write_records(L{}, columns, reinterpret_cast<const std::byte*>(&block), written.data() + 1,
                      present);
        EXPECT_EQ(written, given) << present << " rows";
    }
}

// Records whose words are read at once, since they have few bools.
struct ShortRow {
    std::array<double, 9> reals;
    std::array<bool, 3> bools;
    std::array<std::int64_t, 2> ints;
    bool last;
};
template <class L>
struct ShortBlock {
    std::array<typename L::Real, 9> reals;
    std::array<typename L::Bool, 3> bools;
    std::array<typename L::Int, 2> ints;
    typename L::Bool last;
};
constexpr rddl_fluent short_fluents[] = {
    action("reals", RDDL_REAL, 9, offsetof(ShortRow, reals)),
    action("bools", RDDL_BOOL, 3, offsetof(ShortRow, bools)),
    action("ints", RDDL_INT, 2, offsetof(ShortRow, ints)),
    action("last", RDDL_BOOL, 1, offsetof(ShortRow, last))};
constexpr rddl_problem short_problem = [] {
    rddl_problem described{};
    described.fluents = short_fluents;
    described.fluent_count = std::size(short_fluents);
    described.action_size = sizeof(ShortRow);
    return described;
}();

TYPED_TEST(ColumnsOf, ReadRecordsOfSomeWords) {
    using L = TypeParam;
    constexpr auto columns =
        known_columns<L, short_problem, RDDL_ACTION>(short_problem.action_size);
    ASSERT_EQ(columns.block_size, static_cast<std::int64_t>(sizeof(ShortBlock<L>)));
    std::mt19937_64 random(23);
    std::vector<ShortRow> rows(static_cast<std::size_t>(L::width));
    for (ShortRow& row : rows) {
        for (double& value : row.reals) value = static_cast<double>(random() % 1000) / 8;
        for (bool& value : row.bools) value = random() % 2 == 0;
        for (std::int64_t& value : row.ints) value = static_cast<std::int64_t>(random());
        row.last = random() % 2 == 0;
    }
    ShortBlock<L> block;
    read_records(L{}, columns, reinterpret_cast<const std::byte*>(rows.data()), L::width,
                 reinterpret_cast<std::byte*>(&block));
    for (int lane = 0; lane < L::width; ++lane) {
        const ShortRow& row = rows[static_cast<std::size_t>(lane)];
        for (std::size_t k = 0; k < row.reals.size(); ++k)
            ASSERT_EQ(get_lane(block.reals[k], lane), row.reals[k]) << k << " of " << lane;
        for (std::size_t k = 0; k < row.bools.size(); ++k)
            ASSERT_EQ(get_lane(block.bools[k], lane), row.bools[k]) << k << " of " << lane;
        for (std::size_t k = 0; k < row.ints.size(); ++k)
            ASSERT_EQ(get_lane(block.ints[k], lane), row.ints[k]) << k << " of " << lane;
        ASSERT_EQ(get_lane(block.last, lane), row.last) << lane;
    }
}

// A constant of which GCC 12 makes a wrong copy by itself, with AVX-512.
constexpr std::array<std::int64_t, 7> ones_before_zeros = {1, 1, 0, 1, 1, 0, 0};

#ifdef __clang__
[[gnu::noinline]]
#else
[[gnu::noinline, gnu::optimize("O3")]]
#endif
void copy_ones_before_zeros(std::array<std::int64_t, 7>& target) {
    assign(target, ones_before_zeros);
}

TEST(Tables, AreCopiedAsTheyAre) {
    std::array<std::int64_t, 7> target;
    copy_ones_before_zeros(target);
    const std::int64_t expected[] = {1, 1, 0, 1, 1, 0, 0};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(target[i], expected[i]) << i;
}

TEST(Flags, AreBytes) {
    std::mt19937_64 random(22);
    for (const int present : {1, 8, 13, 32}) {
        const auto mask = Mask<32>::of_bits(random());
        std::array<std::uint8_t, 33> flags;
        flags.fill(7);
        write_flags(mask, flags.data(), present);
        for (int lane = 0; lane < present; ++lane)
            EXPECT_EQ(flags[static_cast<std::size_t>(lane)], mask[lane] ? 1 : 0);
        EXPECT_EQ(flags[static_cast<std::size_t>(present)], 7) << "written beyond the end";
    }
}

#ifdef RDDL_SIMD_AVX512
template <int n, class Read>
void expect_narrow_rows(Read read) {
    std::mt19937_64 random(3);
    for (std::int64_t row_size = 1; row_size <= widest_narrow_row; ++row_size)
        for (std::int64_t count = 1; count <= row_size; ++count) {
            std::vector<std::byte> rows(static_cast<std::size_t>((n - 1) * row_size + count));
            for (std::byte& byte : rows) byte = std::byte{random() % 3 == 0};
            std::vector<Mask<n>> masks(static_cast<std::size_t>(count));
            read(rows.data(), row_size, count, masks.data());
            for (int lane = 0; lane < n; ++lane)
                for (std::int64_t k = 0; k < count; ++k)
                    EXPECT_EQ(masks[static_cast<std::size_t>(k)][lane],
                              rows[static_cast<std::size_t>(lane * row_size + k)] != std::byte{0})
                        << row_size << " bytes, bool " << k << " of row " << lane;
        }
}

TEST(Columns, OfFewBools) {
    expect_narrow_rows<8>(read_narrow_rows<8>);
    expect_narrow_rows<16>(read_narrow_rows<16>);
    expect_narrow_rows<64>(read_narrow_rows<64>);
#ifdef RDDL_SIMD_SQUARES
    expect_narrow_rows<16>(read_narrow_rows_by_bytes);
#endif
}
#endif

#ifdef RDDL_SIMD_SQUARES
// Rows one behind the other, whose true bools may be any byte but 0.
template <int n>
void expect_runs_of_rows() {
    std::mt19937_64 random(4);
    for (std::int64_t count = 1; count <= widest_row_of_run; ++count) {
        std::vector<std::byte> rows(static_cast<std::size_t>(n * count));
        for (std::byte& byte : rows)
            byte = random() % 2 == 0 ? std::byte{0} : static_cast<std::byte>(random());
        std::vector<Mask<n>> masks(static_cast<std::size_t>(count));
        read_run_of_rows(rows.data(), count, masks.data());
        for (int lane = 0; lane < n; ++lane)
            for (std::int64_t k = 0; k < count; ++k)
                EXPECT_EQ(masks[static_cast<std::size_t>(k)][lane],
                          rows[static_cast<std::size_t>(lane * count + k)] != std::byte{0})
                    << "bool " << k << " of " << count << " of row " << lane;
    }
}

TEST(Columns, OfBoolsAlone) {
    expect_runs_of_rows<16>();
    expect_runs_of_rows<64>();
}
#endif

// Two tables side by side, and one behind a number.
TEST(Columns, WithBytesOtherThan0And1) {
    Columns columns;
    columns.has_bools = true;
    columns.list = {{.scalar = RDDL_BOOL, .count = 5, .row = 0},
                    {.scalar = RDDL_BOOL, .count = 75, .row = 5},
                    {.scalar = RDDL_INT, .count = 1, .row = 80},
                    {.scalar = RDDL_BOOL, .count = 9, .row = 88}};
    std::vector<std::byte> row(97, std::byte{1});
    std::memset(row.data() + 80, 7, 8);
    EXPECT_TRUE(has_plain_bools(columns, row.data()));
    for (const std::size_t k : {0, 4, 5, 63, 64, 79, 88, 96}) {
        row[k] = std::byte{2};
        EXPECT_FALSE(has_plain_bools(columns, row.data())) << k;
        row[k] = std::byte{0};
    }
    EXPECT_TRUE(has_plain_bools(columns, row.data()));
}

// One table of bools, of each length.
TEST(Columns, LookAtEachByteForOthersThan0And1) {
    for (std::int64_t count = 1; count <= bool_count; ++count) {
        Columns columns;
        columns.has_bools = true;
        columns.list = {{.scalar = RDDL_BOOL, .count = count, .row = 0}};
        std::vector<std::byte> row(static_cast<std::size_t>(count) + 8, std::byte{2});
        std::memset(row.data(), 1, static_cast<std::size_t>(count));
        EXPECT_TRUE(has_plain_bools(columns, row.data())) << count;
        for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
            row[k] = std::byte{2};
            EXPECT_FALSE(has_plain_bools(columns, row.data())) << k << " of " << count;
            row[k] = std::byte{0};
        }
    }
}

}  // namespace
}  // namespace rddl
