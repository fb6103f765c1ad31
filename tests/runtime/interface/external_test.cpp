// External functions: which declarations fit a signature, and calls by arrays.
#include <rddl/external.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace rddl_extern {

inline double scaled(double value, std::int64_t factor) {
    return value * static_cast<double>(factor);
}
inline double whole(int value) {
    return value;
}
inline float single(double value) {
    return static_cast<float>(value);
}
inline bool positive(double value) {
    return value > 0;
}
inline auto doubled(auto value) {
    return std::sqrt(value) * 2.0;
}
template <class T>
T same(T value) {
    return value;
}
inline double first(std::span<const double> values) {
    return values[0];
}
inline double third(std::span<const double, 3> values) {
    return values[2];
}
inline void reversed(std::span<const std::int64_t> values, std::span<std::int64_t> result) {
    for (std::size_t i = 0; i < values.size(); ++i) result[i] = values[values.size() - 1 - i];
}
template <std::size_t rows, std::size_t columns>
void transposed(std::span<const std::array<double, columns>, rows> matrix,
                std::span<std::array<double, rows>, columns> result) {
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) result[j][i] = matrix[i][j];
}

}  // namespace rddl_extern

RDDL_EXTERN(scaled, double(double, std::int64_t))
RDDL_EXTERN(first, double(std::span<const double>))
RDDL_EXTERN(reversed, void(std::span<const std::int64_t>, std::span<std::int64_t>))
RDDL_EXTERN(transposed,
            void(std::span<const std::array<double, 3>, 2>, std::span<std::array<double, 2>, 3>),
            void(std::span<const std::array<double, 1>, 2>, std::span<std::array<double, 2>, 1>))

namespace rddl {
namespace {

template <class T, std::size_t n>
using In = std::span<const T, n>;
template <class T, std::size_t n>
using Out = std::span<T, n>;

// Values are passed as they are: no digit is lost on the way in.
static_assert(external::fits<double(double, std::int64_t)>(RDDL_EXTERN_FUNCTION(scaled)));
static_assert(!external::fits<double(std::int64_t, double)>(RDDL_EXTERN_FUNCTION(scaled)));
static_assert(!external::fits<double(double)>(RDDL_EXTERN_FUNCTION(scaled)));
static_assert(!external::fits<double(double)>(RDDL_EXTERN_FUNCTION(whole)));
static_assert(!external::fits<double(std::int64_t)>(RDDL_EXTERN_FUNCTION(whole)));
static_assert(external::fits<double(double)>(RDDL_EXTERN_FUNCTION(doubled)));
static_assert(external::fits<double(double)>(RDDL_EXTERN_FUNCTION(same)));
static_assert(external::fits<bool(bool)>(RDDL_EXTERN_FUNCTION(same)));

// Results are promoted, never back.
static_assert(external::fits<double(double)>(RDDL_EXTERN_FUNCTION(single)));
static_assert(!external::fits<std::int64_t(double)>(RDDL_EXTERN_FUNCTION(single)));
static_assert(external::fits<bool(double)>(RDDL_EXTERN_FUNCTION(positive)));
static_assert(external::fits<std::int64_t(double)>(RDDL_EXTERN_FUNCTION(positive)));
static_assert(!external::fits<bool(double)>(RDDL_EXTERN_FUNCTION(same)));

// Tables are spans of their size, or of any size.
static_assert(external::fits<double(In<double, 3>)>(RDDL_EXTERN_FUNCTION(third)));
static_assert(!external::fits<double(In<double, 4>)>(RDDL_EXTERN_FUNCTION(third)));
static_assert(external::fits<double(In<double, 4>)>(RDDL_EXTERN_FUNCTION(first)));
static_assert(!external::fits<double(In<bool, 4>)>(RDDL_EXTERN_FUNCTION(first)));
static_assert(!external::fits<double(double)>(RDDL_EXTERN_FUNCTION(first)));
static_assert(external::fits<void(In<std::array<double, 2>, 5>, Out<std::array<double, 5>, 2>)>(
    RDDL_EXTERN_FUNCTION(transposed)));
static_assert(!external::fits<void(In<std::array<double, 2>, 5>, Out<std::array<double, 2>, 5>)>(
    RDDL_EXTERN_FUNCTION(transposed)));

rddl_array value_of(rddl_scalar scalar, void* data) {
    return {scalar, 0, nullptr, data};
}

TEST(External, CallsOnValues) {
    double value = 1.5, result = 0;
    std::int64_t factor = 4;
    const rddl_array arguments[] = {value_of(RDDL_REAL, &value), value_of(RDDL_INT, &factor)};
    const rddl_array real = value_of(RDDL_REAL, &result);
    EXPECT_EQ(rddl_extern_scaled(arguments, 2, &real), 1);
    EXPECT_EQ(result, 6.0);
    EXPECT_EQ(rddl_extern_scaled(arguments, 1, &real), 0);
    const rddl_array integer = value_of(RDDL_INT, &result);
    EXPECT_EQ(rddl_extern_scaled(arguments, 2, &integer), 0);
}

TEST(External, CallsOnTables) {
    std::int64_t values[] = {1, 2, 3}, result[3] = {};
    const std::int64_t three[] = {3};
    const rddl_array argument{RDDL_INT, 1, three, values};
    const rddl_array output{RDDL_INT, 1, three, result};
    EXPECT_EQ(rddl_extern_reversed(&argument, 1, &output), 1);
    EXPECT_EQ(result[0], 3);
    EXPECT_EQ(result[2], 1);
    const rddl_array bools{RDDL_BOOL, 1, three, values};
    EXPECT_EQ(rddl_extern_reversed(&bools, 1, &output), 0);
}

TEST(External, ChoosesTheSignatureByTheShapes) {
    double matrix[] = {1, 2, 3, 4, 5, 6}, result[6] = {};
    const std::int64_t two_three[] = {2, 3}, three_two[] = {3, 2}, two_one[] = {2, 1},
                       one_two[] = {1, 2};
    const rddl_array wide{RDDL_REAL, 2, two_three, matrix};
    const rddl_array high{RDDL_REAL, 2, three_two, result};
    EXPECT_EQ(rddl_extern_transposed(&wide, 1, &high), 1);
    EXPECT_EQ(result[1], 4);
    EXPECT_EQ(result[2], 2);
    const rddl_array column{RDDL_REAL, 2, two_one, matrix};
    const rddl_array row{RDDL_REAL, 2, one_two, result};
    EXPECT_EQ(rddl_extern_transposed(&column, 1, &row), 1);
    EXPECT_EQ(result[1], 2);
    EXPECT_EQ(rddl_extern_transposed(&high, 1, &wide), 0);
    EXPECT_EQ(rddl_extern_transposed(&wide, 1, &row), 0);
}

TEST(External, OnlyAnswersWhereThereAreNoData) {
    const std::int64_t five[] = {5};
    const rddl_array values{RDDL_REAL, 1, five, nullptr};
    const rddl_array result{RDDL_REAL, 0, nullptr, nullptr};
    EXPECT_EQ(rddl_extern_first(&values, 1, &result), 1);
    EXPECT_EQ(rddl_extern_first(&result, 1, &result), 0);
}

}  // namespace
}  // namespace rddl
