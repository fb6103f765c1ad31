#include "model/table.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rddlc {
namespace {

TEST(Table, HoldsWhatIsNotCommon) {
    Table table(std::int64_t{1} << 40, false);
    table.set(7, true);
    table.set(std::int64_t{1} << 39, true);
    EXPECT_EQ(table[7], Value(true));
    EXPECT_EQ(table[8], Value(false));
    EXPECT_EQ(table.exceptions().size(), 2u);
    EXPECT_FALSE(table.is_uniform());
    table.set(7, false);
    table.set(std::int64_t{1} << 39, false);
    EXPECT_TRUE(table.exceptions().empty());
    EXPECT_TRUE(table.is_uniform());
}

TEST(Table, FindsTheCommonValueOfAList) {
    const Table table{1.5, 0.0, 0.0, 2.5, 0.0};
    EXPECT_EQ(table.common(), Value(0.0));
    EXPECT_EQ(table.exceptions().size(), 2u);
    EXPECT_EQ(table.dense(), (std::vector<Value>{1.5, 0.0, 0.0, 2.5, 0.0}));
    EXPECT_TRUE(table.all_of([](const Value& value) { return std::get<double>(value) >= 0; }));
    EXPECT_FALSE(table.all_of([](const Value& value) { return std::get<double>(value) < 2; }));
}

TEST(Table, ComparesBitByBit) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE((Table{0.0, -0.0}).is_uniform());
    EXPECT_TRUE((Table{nan, nan}).is_uniform());
    EXPECT_FALSE(identical(Table{0.0}, Table{-0.0}));
    EXPECT_TRUE(identical(Table{1.0, nan, 1.0}, Table{1.0, nan, 1.0}));
    EXPECT_TRUE(identical(Table{1.0, 2.0}, Table{1.0, 2.0}));
    EXPECT_FALSE(identical(Table(3, 1.0), Table(4, 1.0)));
}

TEST(Table, IsUniformAlsoWithoutCommonElements) {
    Table table(2, 0.0);
    table.set(0, 1.0);
    table.set(1, 1.0);
    EXPECT_FALSE(table.has_common());
    EXPECT_TRUE(table.is_uniform());
    EXPECT_FALSE(Table().is_uniform());
}

}  // namespace
}  // namespace rddlc
