#include "../runtime/tiny_simulator.hpp"
#include "formats/records_json.hpp"
#include "solvers/policies/random_actions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace rddlc::workbench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A problem whose only fluents are parameterless actions, 8 bytes each.
struct ActionProblem {
    std::vector<double> lower, upper;
    std::vector<rddl_fluent> fluents;
    std::vector<std::int64_t> defaults;
    const char* colours[3] = {"red", "green", "blue"};
    rddl_type type{"colour", colours, 3, 1};
    rddl_problem problem{};

    struct Fluent {
        rddl_scalar scalar;
        double lower = -infinity, upper = infinity;
        int range_type = -1;
    };
    explicit ActionProblem(const std::vector<Fluent>& given, std::int64_t limit = -1) {
        for (const Fluent& fluent : given) {
            lower.push_back(fluent.lower);
            upper.push_back(fluent.upper);
        }
        for (std::size_t i = 0; i < given.size(); ++i) {
            rddl_fluent fluent{};
            fluent.name = "a";
            fluent.role = RDDL_ACTION;
            fluent.scalar = given[i].scalar;
            fluent.range_type = given[i].range_type;
            fluent.count = 1;
            fluent.offset = static_cast<std::int64_t>(8 * i);
            fluent.lower = &lower[i];
            fluent.upper = &upper[i];
            fluents.push_back(fluent);
        }
        defaults.assign(given.size(), 0);
        problem.types = &type;
        problem.type_count = 1;
        problem.fluents = fluents.data();
        problem.fluent_count = static_cast<std::int32_t>(fluents.size());
        problem.action_size = static_cast<std::int64_t>(8 * given.size());
        problem.default_action = defaults.data();
        problem.max_nondef_actions = limit;
    }
};

using ActionValues = std::vector<std::int64_t>;

ActionValues act(solvers::RandomPolicy& policy, const ActionProblem& problem,
                 std::int64_t environment, std::int64_t step) {
    ActionValues record(problem.defaults.size(), -1);
    policy.act(environment, step, reinterpret_cast<std::byte*>(record.data()));
    return record;
}

double as_real(std::int64_t bits) {
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

TEST(RandomPolicy, DependsOnSeedEnvironmentAndStepOnly) {
    const ActionProblem problem({{RDDL_REAL, 0, 1}, {RDDL_REAL, 0, 1}, {RDDL_BOOL}}, 2);
    solvers::RandomPolicy first(problem.problem, 5), second(problem.problem, 5),
        other(problem.problem, 6);
    for (std::int64_t step = 0; step < 10; ++step) act(second, problem, 99, step);  // elsewhere
    std::map<ActionValues, int> distinct;
    for (std::int64_t environment = 0; environment < 5; ++environment)
        for (std::int64_t step = 0; step < 5; ++step) {
            const ActionValues record = act(first, problem, environment, step);
            EXPECT_EQ(record, act(second, problem, environment, step));
            EXPECT_NE(record, act(other, problem, environment, step));
            distinct[record] += 1;
        }
    EXPECT_EQ(distinct.size(), 25u);
}

TEST(RandomPolicy, StaysWithinTheBounds) {
    const ActionProblem problem({{RDDL_REAL, -2, 3},
                                 {RDDL_REAL, 1, infinity},
                                 {RDDL_REAL, -infinity, -1},
                                 {RDDL_INT, -2.5, 2.5},
                                 {RDDL_INT, 0.5, infinity},
                                 {RDDL_INT, -infinity, -0.5},
                                 {RDDL_INT, -infinity, infinity, 0},
                                 {RDDL_INT, 0.2, 0.8}});
    solvers::RandomPolicy policy(problem.problem, 1);
    std::map<std::int64_t, int> ints, colours;
    for (std::int64_t step = 0; step < 2000; ++step) {
        const ActionValues a = act(policy, problem, 0, step);
        EXPECT_GE(as_real(a[0]), -2);
        EXPECT_LE(as_real(a[0]), 3);
        EXPECT_GE(as_real(a[1]), 1);
        EXPECT_LE(as_real(a[2]), -1);
        EXPECT_GE(a[4], 1);
        EXPECT_LE(a[5], -1);
        EXPECT_EQ(a[7], 0) << "no int fits: the default";
        ints[a[3]] += 1;
        colours[a[6]] += 1;
    }
    EXPECT_EQ(ints.begin()->first, -2);
    EXPECT_EQ(ints.rbegin()->first, 2);
    EXPECT_EQ(ints.size(), 5u);
    EXPECT_EQ(colours.begin()->first, 0);
    EXPECT_EQ(colours.rbegin()->first, 2);
    // Each int has probability 1/5: 400 expected, standard deviation 18.
    for (const auto& [value, count] : ints) EXPECT_NEAR(count, 400, 110) << value;
}

TEST(RandomPolicy, HasTheMomentsItPromises) {
    const ActionProblem problem({{RDDL_REAL}, {RDDL_REAL, 2, infinity}, {RDDL_REAL, 0, 4}});
    solvers::RandomPolicy policy(problem.problem, 1);
    constexpr int draws = 20000;
    double sum[3] = {}, squares[3] = {};
    for (std::int64_t environment = 0; environment < draws; ++environment) {
        const ActionValues a = act(policy, problem, environment, 3);
        for (int i = 0; i < 3; ++i) {
            sum[i] += as_real(a[static_cast<std::size_t>(i)]);
            squares[i] += std::pow(as_real(a[static_cast<std::size_t>(i)]), 2);
        }
    }
    const auto mean = [&](int i) {
        return sum[i] / draws;
    };
    const auto variance = [&](int i) {
        return squares[i] / draws - mean(i) * mean(i);
    };
    // Within about six standard errors.
    EXPECT_NEAR(mean(0), 0, 0.045);
    EXPECT_NEAR(variance(0), 1, 0.06);
    EXPECT_NEAR(mean(1), 3, 0.045);
    EXPECT_NEAR(variance(1), 1, 0.13);
    EXPECT_NEAR(mean(2), 2, 0.05);
    EXPECT_NEAR(variance(2), 16.0 / 12, 0.06);
}

TEST(RandomPolicy, KeepsTheLimitOfNonDefaultValues) {
    const ActionProblem problem(std::vector<ActionProblem::Fluent>(10, {RDDL_REAL, 1, 2}), 3);
    solvers::RandomPolicy policy(problem.problem, 1);
    std::vector<int> chosen(10);
    for (std::int64_t step = 0; step < 3000; ++step) {
        const ActionValues a = act(policy, problem, 0, step);
        int changed = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            changed += a[i] != 0;
            chosen[i] += a[i] != 0;
        }
        EXPECT_EQ(changed, 3);
    }
    // Each is chosen with probability 3/10: 900 expected, standard deviation 25.
    for (const int count : chosen) EXPECT_NEAR(count, 900, 150);
}

TEST(RandomPolicy, DoesNothingWhenNothingMayDiffer) {
    const ActionProblem problem({{RDDL_BOOL}, {RDDL_BOOL}}, 0);
    solvers::RandomPolicy policy(problem.problem, 1);
    for (std::int64_t step = 0; step < 20; ++step)
        EXPECT_EQ(act(policy, problem, 0, step), (ActionValues{0, 0}));
}

// ------------------------------------------------------------------------- legal actions

// All proposals of the policy at one timestep to a caller that finds every action illegal.
std::vector<ActionValues> proposals(solvers::RandomPolicy& policy, const ActionProblem& problem,
                                    std::int64_t environment) {
    std::vector<ActionValues> all{act(policy, problem, environment, 3)};
    solvers::RandomPolicy::Search search;
    ActionValues record = all.back();
    while (policy.try_another(environment, 3, search, reinterpret_cast<std::byte*>(record.data())))
        all.push_back(record);
    EXPECT_EQ(record, problem.defaults);
    return all;
}

int changes(const ActionValues& from, const ActionValues& to) {
    int count = 0;
    for (std::size_t i = 0; i < from.size(); ++i) count += from[i] != to[i];
    return count;
}

TEST(RandomPolicy, ResetsOneValueAfterTheOtherThenDrawsAnew) {
    ActionProblem problem(std::vector<ActionProblem::Fluent>(6, {RDDL_REAL, 1, 2}));
    solvers::RandomPolicy policy(problem.problem, 1);
    const std::vector<ActionValues> all = proposals(policy, problem, 0);
    ASSERT_EQ(all.size(), 128u * 7 + 6 * 2) << "128 actions, each with 6 resets; 6 single changes";
    for (std::size_t k = 0; k < 128 * 7; ++k) {
        EXPECT_EQ(changes(all[k], problem.defaults), 6 - static_cast<int>(k % 7));
        if (k % 7 > 0) {
            EXPECT_EQ(changes(all[k], all[k - 1]), 1);
        }
    }
    EXPECT_EQ(changes(all[0], all[7]), 6);
    for (std::size_t k = 128 * 7; k < all.size(); k += 2)
        EXPECT_EQ(changes(all[k], problem.defaults), 1);
}

TEST(RandomPolicy, TriesEverySingleChange) {
    const ActionProblem problem(std::vector<ActionProblem::Fluent>(40, {RDDL_BOOL}));
    solvers::RandomPolicy policy(problem.problem, 1);
    const std::vector<ActionValues> all = proposals(policy, problem, 0);
    std::map<ActionValues, int> last;
    for (std::size_t k = all.size() - 80; k < all.size(); ++k) ++last[all[k]];
    EXPECT_EQ(last.size(), 41u) << "each of 40, and the default after it";
}

TEST(RandomPolicy, ResetsManyValuesInFewRounds) {
    ActionProblem problem(std::vector<ActionProblem::Fluent>(800, {RDDL_REAL, 1, 2}));
    solvers::RandomPolicy policy(problem.problem, 1);
    const std::vector<ActionValues> all = proposals(policy, problem, 0);
    EXPECT_EQ(changes(all[1], all[0]), 100);
    EXPECT_EQ(changes(all[1], problem.defaults), 700);
    EXPECT_LT(all.size(), 128u * 50 + 256 * 2);
}

// The default is forbidden, and independent values may be too unlikely to find a legal action.
TEST(RandomPolicy, TriesAllAndNoBoolsOfAFluent) {
    const ActionProblem problem(std::vector<ActionProblem::Fluent>(2, {RDDL_BOOL}));
    solvers::RandomPolicy policy(problem.problem, 1);
    std::map<ActionValues, int> found;
    for (const ActionValues& record : proposals(policy, problem, 0)) ++found[record];
    for (const ActionValues& record : {ActionValues{0, 0}, {0, 1}, {1, 0}, {1, 1}})
        EXPECT_GT(found[record], 4);
}

TEST(RandomPolicy, ResetsEachValueAlike) {
    const ActionProblem problem(std::vector<ActionProblem::Fluent>(4, {RDDL_REAL, 1, 2}));
    solvers::RandomPolicy policy(problem.problem, 1);
    std::vector<int> first(4);
    for (std::int64_t environment = 0; environment < 2000; ++environment) {
        ActionValues record = act(policy, problem, environment, 0);
        solvers::RandomPolicy::Search search;
        policy.try_another(environment, 0, search, reinterpret_cast<std::byte*>(record.data()));
        for (std::size_t i = 0; i < 4; ++i) first[i] += record[i] == 0;
    }
    // Each with probability 1/4: 500 expected, standard deviation 19.
    for (const int count : first) EXPECT_NEAR(count, 500, 110);
}

TEST(RandomPolicy, SearchesWithinTheLimitAndReproducibly) {
    const ActionProblem problem(std::vector<ActionProblem::Fluent>(10, {RDDL_REAL, 1, 2}), 3);
    solvers::RandomPolicy policy(problem.problem, 1), other(problem.problem, 1);
    const std::vector<ActionValues> all = proposals(policy, problem, 7);
    for (const ActionValues& record : all) EXPECT_LE(changes(record, problem.defaults), 3);
    proposals(other, problem, 8);
    EXPECT_EQ(proposals(other, problem, 7), all);

    const ActionProblem bound({{RDDL_BOOL}, {RDDL_BOOL}}, 0);
    solvers::RandomPolicy idle(bound.problem, 1);
    EXPECT_EQ(proposals(idle, bound, 0).size(), 1u);
}

}  // namespace
}  // namespace rddlc::workbench
