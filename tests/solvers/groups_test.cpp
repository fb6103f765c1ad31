// Bools that preconditions allow to change one at a time.
#include "action_batch.hpp"
#include "simulators.hpp"
#include "solver_harbour.h"
#include "solver_museum.h"
#include "solver_shop.h"
#include "solvers/action_distribution/action_distribution.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/cgp/scope.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/spaces/actions.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

namespace rddlc::solvers {
namespace {

const rddl_simulator& shop() {
    return *rddl_simulator_shop_shop_1();
}
const rddl_simulator& museum() {
    return *rddl_simulator_museum_museum_1();
}
const rddl_simulator& harbour() {
    return *rddl_simulator_harbour_harbour_1();
}

std::set<std::string> names_of(const ActionSpace& space, const CategoryHead& head) {
    std::set<std::string> names;
    for (const int column : head.group) names.insert(space.names[static_cast<std::size_t>(column)]);
    return names;
}

std::vector<float> action_of(const ActionSpace& space, const std::vector<std::int32_t>& indices) {
    std::vector<float> values(static_cast<std::size_t>(space.column_count));
    write_action(space, nullptr, indices.data(), values.data());
    return values;
}

TEST(Groups, AtMostOneOfThoseOfAnObject) {
    const ActionSpace space = action_space(shop());
    EXPECT_EQ(space.max_sub_actions, 0);
    EXPECT_FALSE(space.masked);
    ASSERT_EQ(space.categories.size(), 3u);
    EXPECT_EQ(space.logit_count, 3 * 5);
    for (int c = 0; c < 3; ++c) {
        const CategoryHead& head = space.categories[static_cast<std::size_t>(c)];
        EXPECT_EQ(head.count, 5);
        EXPECT_EQ(head.first_value, 0);
        EXPECT_EQ(head.first_logit, 5 * c);
        const std::string customer = "recommend(c" + std::to_string(c + 1);
        EXPECT_EQ(names_of(space, head),
                  (std::set<std::string>{customer + ", i1)", customer + ", i2)", customer + ", i3)",
                                         customer + ", i4)"}));
    }
    std::vector<float> expected(12, 0.0f);
    expected[4 + 0] = 1;  // c2, i1
    expected[8 + 3] = 1;  // c3, i4
    EXPECT_EQ(action_of(space, {0, 1, 4}), expected);
}

// The group consists of several fluents; lamps are chosen by themselves.
TEST(Groups, ExactlyOneOfThoseOfAnObject) {
    const ActionSpace space = action_space(museum());
    EXPECT_EQ(space.max_sub_actions, 0);
    ASSERT_EQ(space.categories.size(), 2u + 3u);
    std::size_t lamps = 0, guards = 0;
    for (const CategoryHead& head : space.categories) {
        if (head.group.empty()) {
            EXPECT_EQ(head.count, 2);
            ++lamps;
            continue;
        }
        const std::string guard = "g" + std::to_string(++guards);
        EXPECT_EQ(head.count, 4);
        EXPECT_EQ(head.first_value, 1);
        EXPECT_EQ(
            names_of(space, head),
            (std::set<std::string>{"watch(hall, " + guard + ")", "watch(attic, " + guard + ")",
                                   "watch(cellar, " + guard + ")", "rest(" + guard + ")"}));
    }
    EXPECT_EQ(lamps, 3u);
    EXPECT_EQ(guards, 2u);
    const std::vector<float> action = action_of(space, {0, 3, 0, 1, 0});
    EXPECT_EQ(std::count(action.begin(), action.end(), 1.0f), 3);
}

// Though max-nondef-actions lets no more change than one bool of each ship, and the numbers, which
// preconditions limit together.
TEST(Groups, BesideALimitAndNumbers) {
    const ActionSpace space = action_space(harbour());
    ASSERT_EQ(harbour().problem->max_nondef_actions, 6);
    EXPECT_EQ(space.max_sub_actions, 0);
    EXPECT_EQ(space.reals.size(), 3u);
    ASSERT_EQ(space.categories.size(), 3u);
    for (const CategoryHead& head : space.categories) {
        EXPECT_EQ(head.group.size(), 3u);
        EXPECT_EQ(head.first_value, 1);
    }
    EXPECT_TRUE(space.may_be_illegal);
}

// No default is legal where each ship has to do something: numbers alone fall back, and not all the
// way where half of them is legal.
TEST(Groups, KeepWhatWasChosenWhereNumbersAreRepaired) {
    ActionBatch all(harbour());
    std::mt19937 random(3);
    for (std::size_t e = 0; e < all.environments; ++e) {
        std::vector<float> numbers(3);
        for (float& number : numbers) number = static_cast<float>(random() % 2000) / 500 - 2;
        std::vector<std::int32_t> indices(3);
        for (std::int32_t& index : indices) index = static_cast<std::int32_t>(random() % 3);
        write_action(all.space, numbers.data(), indices.data(), all.row(e));
    }
    all.write();
    const std::vector<float> wanted = all.values;
    EXPECT_GT(all.mend(), static_cast<std::int64_t>(all.environments / 2));
    EXPECT_EQ(all.violated(), all_legal);
    bool any_halved = false;
    for (std::size_t e = 0; e < all.environments; ++e) {
        const float* const before = wanted.data() + e * all.columns;
        for (const CategoryHead& head : all.space.categories)
            for (const int column : head.group) EXPECT_EQ(all.row(e)[column], before[column]);
        for (const RealHead& head : all.space.reals) {
            const float pumped = all.row(e)[head.column];
            any_halved |= pumped > 0 && pumped < before[head.column];
        }
    }
    EXPECT_TRUE(any_halved);
}

// Whatever is wanted: a random legal action is what values fall back to.
TEST(Groups, AnyActionIsRepairedWhereTheDefaultIsIllegal) {
    ActionBatch all(museum());
    std::mt19937 random(5);
    for (float& value : all.values) value = static_cast<float>(random() % 2);
    all.write();
    const std::vector<std::int32_t> before = all.violated();
    const std::vector<float> wanted = all.values;
    EXPECT_GT(all.mend(), static_cast<std::int64_t>(all.environments / 2));
    EXPECT_EQ(all.violated(), all_legal);
    for (std::size_t e = 0; e < all.environments; ++e) {
        std::vector<float> row(all.columns);
        all.records.read(all.record(e), row.data());
        EXPECT_TRUE(std::equal(row.begin(), row.end(), all.row(e)));
        if (before[e] >= 0) continue;
        EXPECT_TRUE(std::equal(row.begin(), row.end(), wanted.data() + e * all.columns));  // stays
    }
}

// If preconditions say something else, one change is chosen after the other, as before.
TEST(Groups, AreNotSeenWhereThereAreNone) {
    for (const rddl_simulator* const simulator : simulators())
        for (const CategoryHead& head : action_space(*simulator).categories)
            EXPECT_TRUE(head.group.empty()) << simulator->problem->instance;
}

// Random choices satisfy the preconditions, so nothing has to be repaired.
TEST(Groups, MakeLegalActions) {
    for (const rddl_simulator* const simulator : {&shop(), &museum()}) {
        const ActionSpace space = action_space(*simulator);
        constexpr std::int64_t environments = 8, steps = 50;
        rddl_batch_options options{};
        options.environment_count = environments;
        options.autoreset = RDDL_AUTORESET_SAME_STEP;
        const BatchHandle batch = create_batch(*simulator, options);
        ActionDistribution distribution(*simulator, space, Noise::White, 0, environments);
        const auto logits = static_cast<std::size_t>(space.logit_count);
        const auto columns = static_cast<std::size_t>(space.column_count);
        std::vector<float> outputs(environments * logits), actions(environments * columns),
            spreads(environments), log_probabilities(environments);
        std::vector<std::int32_t> indices(environments *
                                          static_cast<std::size_t>(space.index_count()));
        const ActionRecords records(*simulator);
        std::vector<std::byte> bytes(environments * records.record_size());
        std::set<std::int32_t> chosen;
        const float no_deviation = 0;
        for (std::int64_t t = 0; t < steps; ++t) {
            distribution.choose(
                batch.get(), outputs.data(), space.logit_count, Deviations{&no_deviation},
                [&](std::int64_t e) {
                    return ChoiceKey{5, static_cast<std::uint64_t>(e),
                                     static_cast<std::uint64_t>(t)};
                },
                {nullptr, nullptr, spreads.data(), indices.data(), nullptr,
                 log_probabilities.data()},
                actions.data());
            chosen.insert(indices.begin(), indices.end());
            for (std::int64_t e = 0; e < environments; ++e)
                records.write(actions.data() + static_cast<std::size_t>(e) * columns,
                              bytes.data() + static_cast<std::size_t>(e) * records.record_size());
            rddl_transition unread{};
            ASSERT_EQ(simulator->step(batch.get(), bytes.data(), &unread), RDDL_OK);
        }
        EXPECT_EQ(distribution.repaired(), 0) << simulator->problem->instance;
        EXPECT_GE(chosen.size(), 4u);  // all of a group
    }
}

// A program writes a number for each bool; the greatest above 0 of a group says which one changes.
TEST(Groups, ProgramsChooseTheGreatest) {
    const ProgramScope scope = program_scope(shop(), Lifting::On, false, 1);
    ASSERT_EQ(scope.units.size(), 12u);
    const std::vector<double> values = {-1, 2, 3, 1, -1, -2, -3, -4, 0.5, 0, 0, 0};
    std::vector<float> logits(15);
    write_outputs(scope, values.data(), 1, logits.data());
    const auto greatest = [&](int head) {
        return std::max_element(logits.begin() + 5 * head, logits.begin() + 5 * head + 5) -
               (logits.begin() + 5 * head);
    };
    EXPECT_EQ(greatest(0), 3);
    EXPECT_EQ(greatest(1), 0);  // no change
    EXPECT_EQ(greatest(2), 1);
}

// The programs of scikit-decide make one choice.
TEST(Groups, AreNotForProgramsOfScikitDecide) {
    EXPECT_THROW(skdecide_scope(shop()), Failure);
}

// Random actions that know the groups are legal at once, and each of a group's changes, and no
// change, is equally likely.
TEST(Groups, RandomActionsAreLegalAtOnce) {
    for (const rddl_simulator* const simulator : {&shop(), &museum()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const auto groups = groups_without_limit(*simulator, 1);
        ASSERT_TRUE(groups);
        RandomPolicy policy(*simulator->problem, 1, *groups);
        ActionBatch all(*simulator);
        constexpr int steps = 100;
        std::vector<int> changed(all.columns), none(groups->columns.size());
        for (int step = 0; step < steps; ++step) {
            for (std::size_t e = 0; e < all.environments; ++e) {
                policy.act(static_cast<std::int64_t>(e), step, all.record(e));
                all.records.read(all.record(e), all.row(e));
                for (std::size_t g = 0; g < groups->columns.size(); ++g) {
                    int count = 0;
                    for (const int column : groups->columns[g]) {
                        const auto c = static_cast<std::size_t>(column);
                        const bool is_changed = all.row(e)[c] != all.space.defaults[c];
                        changed[c] += is_changed;
                        count += is_changed;
                    }
                    EXPECT_LE(count, 1);
                    none[g] += count == 0;
                }
            }
            EXPECT_EQ(all.violated(), all_legal);
        }
        for (std::size_t g = 0; g < groups->columns.size(); ++g) {
            const std::vector<int>& group = groups->columns[g];
            const double share = 1.0 / static_cast<double>(group.size() + groups->may_be_none);
            const double draws = steps * static_cast<double>(all.environments);
            const double deviation = std::sqrt(draws * share * (1 - share));
            for (const int column : group)
                EXPECT_NEAR(changed[static_cast<std::size_t>(column)], draws * share,
                            5 * deviation);
            EXPECT_NEAR(none[g], groups->may_be_none ? draws * share : 0, 5 * deviation);
        }
    }
}

}  // namespace
}  // namespace rddlc::solvers
