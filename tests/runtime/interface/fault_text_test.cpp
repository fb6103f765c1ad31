#include <rddl/interface/fault_text.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

namespace rddl {
namespace {

const char* const computers[] = {"c1", "c2", "c3"};
const char* const ports[] = {"p1", "p2"};
const rddl_type computer{"computer", computers, 3, 0};
const rddl_type port{"port", ports, 2, 0};
const SiteVariable scope[] = {{"c", &computer}, {"p", &port}};

std::string message(const FaultRecord& fault, const Site& site) {
    char buffer[512];
    describe_fault(fault, site, buffer);
    return buffer;
}

TEST(FaultMessages, NameThePlaceTheCauseTheValueAndTheObjects) {
    const Site site{{"reservoir.rddl", 41, 18}, "Bernoulli", std::span(scope, 1)};
    EXPECT_EQ(message({FaultKind::Probability, {0, 2}, 1.3}, site),
              "reservoir.rddl:41:18: Bernoulli's probability must be in [0, 1], found 1.3 "
              "(at ?c = c3)");
}

TEST(FaultMessages, CountObjectsRowMajor) {
    const Site site{{"a.rddl", 1, 2}, "Normal", scope};
    EXPECT_EQ(message({FaultKind::Variance, {0, 3}, -2}, site),
              "a.rddl:1:2: Normal's variance must not be negative, found -2 (at ?c = c2, ?p = p2)");
}

TEST(FaultMessages, OfTypesAreTheSitesText) {
    const Site site{{"a.rddl", 1, 2}, "x' is an int, and its value here is a real", {}};
    EXPECT_EQ(message({FaultKind::Type, {0, 0}, 0}, site),
              "a.rddl:1:2: x' is an int, and its value here is a real");
}

TEST(FaultMessages, OfMatricesHaveNoValue) {
    const Site inverse{{"a.rddl", 1, 2}, "the matrix of 'inverse' is singular", {}};
    EXPECT_EQ(message({FaultKind::Undefined, {0, 0}, 0}, inverse),
              "a.rddl:1:2: the matrix of 'inverse' is singular");
    const Site normal{{"a.rddl", 1, 2}, "MultivariateNormal", {}};
    EXPECT_EQ(message({FaultKind::Covariance, {0, 0}, 0}, normal),
              "a.rddl:1:2: MultivariateNormal's covariance must be positive definite");
}

TEST(FaultMessages, ShowNoSignOfANan) {
    const Site site{{"a.rddl", 1, 2}, "Bernoulli", {}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double value : {nan, -nan})
        EXPECT_EQ(message({FaultKind::Probability, {0, 0}, value}, site),
                  "a.rddl:1:2: Bernoulli's probability must be in [0, 1], found nan");
}

TEST(FaultMessages, AreCutOffAtTheEndOfTheBuffer) {
    const std::string long_text(600, 'x');
    const Site site{{"a.rddl", 1, 2}, long_text.c_str(), scope};
    const std::string text = message({FaultKind::Type, {0, 0}, 0}, site);
    EXPECT_EQ(text.size(), 511u);
    EXPECT_EQ(text, ("a.rddl:1:2: " + long_text).substr(0, 511));
}

TEST(FaultMessages, SayWhatEveryKindRequires) {
    for (int kind = 0; kind <= static_cast<int>(FaultKind::Undefined); ++kind)
        EXPECT_NE(requirement_of(static_cast<FaultKind>(kind)), "value is wrong") << kind;
}

}  // namespace
}  // namespace rddl
