#include "passes/arithmetic/prove_invariants.hpp"

#include "texts.hpp"

#include <string>

namespace rddlc {
namespace {

// Is the invariant proved, given the CPFs of speed(?o) and x?
bool is_proved(const std::string& invariant, const std::string& cpf_of_speed,
               const std::string& cpf_of_x = "x") {
    const Problem problem{.pvariables =
                              "FASTEST(obj) : { non-fluent, real, default = 2.0 };\n"
                              "speed(obj) : { state-fluent, real, default = 0.0 };\n"
                              "OTHER : { non-fluent, obj };\n"
                              "car : { state-fluent, obj };\n"
                              "x : { state-fluent, real, default = 0.0 };",
                          .cpfs = "speed'(?o) = " + cpf_of_speed + ";\nx' = " + cpf_of_x +
                                  ";\ncar' = if (x > 1.0) then OTHER else car;",
                          .blocks = "state-invariants { " + invariant + "; };",
                          .non_fluents = "FASTEST(b2) = 4.0; OTHER = b2;",
                          .init_state = "car = b1;"};
    passes::Report report;
    const ir::Program program = valid(passes::prove_invariants(grounded(problem), report));
    const auto* known = std::get_if<ir::Constant>(&program[program.invariants[0].value].form);
    const bool is_true = known && known->value == ir::Value(true);
    EXPECT_EQ(report["invariants proved"], is_true ? 1 : 0);
    return is_true;
}

TEST(ProveInvariants, ByConstants) {
    EXPECT_TRUE(is_proved("x >= -1.5", "0.0", "max[-1.0, x - 1.0]"));
    EXPECT_TRUE(is_proved("x >= -1.0", "0.0", "max[-1.0, min[x - 1.0, 3.0]]"));
    EXPECT_TRUE(is_proved("3.0 >= x", "0.0", "min[max[-1.0, x - 1.0], 3.0]"));
    EXPECT_TRUE(is_proved("x <= 3.0", "0.0", "max[-1.0, min[x - 1.0, 3.0]]"));
    EXPECT_TRUE(is_proved("x <= 3.0", "0.0", "0.0 + Bernoulli(0.5)"));
}

TEST(ProveInvariants, OfAllObjects) {
    EXPECT_TRUE(is_proved("forall_{?o : obj} [speed(?o) <= FASTEST(?o)]",
                          "min[FASTEST(?o), max[0.0, speed(?o) + x]]"));
    EXPECT_TRUE(is_proved("forall_{?o : obj} [speed(?o) >= 0.0 ^ speed(?o) <= 4.0]",
                          "min[FASTEST(?o), max[0.0, speed(?o) + x]]"));
}

TEST(ProveInvariants, NotWhatAStepMayViolate) {
    EXPECT_FALSE(is_proved("x >= -1.0", "0.0"));
    EXPECT_FALSE(is_proved("x >= -0.5", "0.0", "max[-1.0, x - 1.0]"));
    EXPECT_FALSE(is_proved("x > -1.0", "0.0", "max[-1.0, x - 1.0]"));
    EXPECT_FALSE(is_proved("x <= 3.0", "0.0", "max[min[x - 1.0, 3.0], x]"));
    EXPECT_FALSE(is_proved("x >= -1.0 | x <= 3.0", "0.0", "x + 1.0"));
    EXPECT_FALSE(is_proved("exists_{?o : obj} [speed(?o) <= FASTEST(?o)]", "speed(?o) + x"));
    EXPECT_FALSE(is_proved("forall_{?o : obj} [speed(?o) <= 2.0]", "min[FASTEST(?o), x]"));
    EXPECT_FALSE(is_proved("speed(car) <= FASTEST(car)", "min[FASTEST(car), x]"))
        << "the car is another one after the step";
    EXPECT_FALSE(is_proved("speed(car) <= 4.0 ^ speed(car) >= x", "min[4.0, speed(car)]"));
    EXPECT_FALSE(is_proved("forall_{?o : obj, ?p : obj} [speed(?o) <= FASTEST(?p)]",
                           "min[FASTEST(?o), speed(?o) + x]"));
}

}  // namespace
}  // namespace rddlc
