#include <rddl/batch/record_checks.hpp>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddl {
namespace {

bool are_valid(const Columns& columns, const std::vector<std::int64_t>& rows) {
    const auto bytes = std::as_bytes(std::span(rows));
    const auto count = static_cast<std::int64_t>(bytes.size()) / columns.row_size;
    const bool are_valid = records_are_valid(columns, bytes.data(), count);
    if (count == 1) {
        EXPECT_EQ(record_is_valid(columns, bytes.data()), are_valid);
    }
    return are_valid;
}

// Each place of a run of rows is looked at, in registers or behind the last full one.
void expect_all_are_checked(const Columns& columns, std::size_t rows) {
    const Column& column = columns.list.back();
    const auto words = static_cast<std::size_t>(columns.row_size / 8);
    std::vector<std::int64_t> values(rows * words, 0);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t k = 0; k < static_cast<std::size_t>(column.count); ++k) {
            std::int64_t& value =
                values[row * words + static_cast<std::size_t>(column.row / 8) + k];
            for (const std::int64_t other :
                 {std::int64_t{-1}, column.limit, INT64_MIN, INT64_MAX}) {
                value = other;
                EXPECT_FALSE(are_valid(columns, values)) << row << " " << k << " " << other;
            }
            value = column.limit - 1;
            EXPECT_TRUE(are_valid(columns, values)) << row << " " << k;
        }
}

TEST(RecordChecks, FindEachValueThatIsNoObject) {
    const Column objects{.scalar = RDDL_INT, .limit = 5, .count = 3};
    const Columns alone{.list = {objects}, .row_size = 24, .has_objects = true};
    for (const std::size_t rows : {1, 2, 3, 11}) expect_all_are_checked(alone, rows);
}

TEST(RecordChecks, LeaveNumbersBesideObjects) {
    const Column numbers{.scalar = RDDL_INT, .count = 1};
    const Column objects{.scalar = RDDL_INT, .limit = 5, .count = 2, .first = 1, .row = 8};
    const Columns both{.list = {numbers, objects}, .row_size = 24, .has_objects = true};
    EXPECT_TRUE(are_valid(both, {77, 4, 4, -8, 0, 0}));
    for (const std::size_t rows : {1, 5}) expect_all_are_checked(both, rows);
    const Column many{.scalar = RDDL_INT, .limit = 5, .count = 19, .first = 1, .row = 8};
    expect_all_are_checked({.list = {numbers, many}, .row_size = 160, .has_objects = true}, 1);
}

#ifdef RDDL_SIMD_BYTE_INTS
// The last of two blocks of byte ints.
void expect_objects_are_read(std::int64_t count, std::int64_t objects) {
    using L = ByteIntPack<>;
    constexpr std::size_t width = L::width, blocks = 2;
    const auto row = static_cast<std::size_t>(count);
    const Columns columns{.list = {{.scalar = RDDL_INT, .limit = objects, .count = count}},
                          .row_size = 8 * count,
                          .block_size = 64 * count,
                          .has_objects = true};
    ASSERT_TRUE(are_read_when_checked<L>(columns));
    std::vector<std::int64_t> values(blocks * width * row);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<std::int64_t>(i * 7) % objects;
    std::vector<L::Int> read(blocks * row);
    const auto are_read = [&] {
        return read_objects<L>(columns, std::as_bytes(std::span(values)).data(), blocks,
                               std::as_writable_bytes(std::span(read)).data());
    };
    EXPECT_TRUE(are_read());
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(read[i / row / width * row + i % row][static_cast<int>(i / row % width)],
                  values[i]);
    for (std::size_t i = values.size() / 2; i < values.size(); ++i) {
        const std::int64_t valid = values[i];
        for (const std::int64_t other :
             {std::int64_t{-1}, objects, objects + 256, INT64_MIN, INT64_MAX}) {
            values[i] = other;
            EXPECT_FALSE(are_read()) << i << " " << other;
        }
        values[i] = valid;
    }
}

TEST(RecordChecks, ReadByteObjects) {
    for (const std::int64_t objects : {1, 5, 127, 128})
        for (const std::int64_t count : {2, 4, 8}) expect_objects_are_read(count, objects);
}
#endif

}  // namespace
}  // namespace rddl
