#include "engines/load_simulator.hpp"
#include "planners/uct/determinised_problem.hpp"
#include "planners/uct/tree.hpp"
#include "planning.hpp"
#include "solvers/spaces/actions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace rddlc::planners {
namespace {

// The values of the ladder as its file has them: no-op stays, then come to climb and to leap. They
// are found within less than two of them differ.
TEST(Uct, FindsTheValuesOfASmallProblem) {
    for (const std::string initial : {"determinised", "lookahead", "rollout"}) {
        SCOPED_TRACE(initial);
        const Played plan =
            run(ladder(), "plan:uct,iterations=40000,exploration=1,initial=" + initial);
        const Explanation& explanation = plan.thought(0, 0);
        ASSERT_EQ(explanation.candidates.size(), 3u);
        EXPECT_NEAR(explanation.candidates[0].value, 4.5, 0.12);
        EXPECT_NEAR(explanation.candidates[1].value, 4.75, 0.12);
        EXPECT_NEAR(explanation.candidates[2].value, 4.625, 0.12);
        EXPECT_EQ(explanation.chosen, 1u);
        EXPECT_EQ(explanation.depth, 4);
        EXPECT_GE(explanation.iterations, 40000);
    }
}

// The values of backups by means are those of what was tried, not of the best: lower.
TEST(Uct, BacksUpMeansIfTold) {
    const Played plan = run(ladder(), "plan:uct,iterations=40000,backup=mean");
    const Played other = run(ladder(), "plan:uct,iterations=40000");
    const Explanation& best = other.thought(0, 0);
    double mean = 0, most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        mean = std::max(mean, plan.thought(0, 0).candidates[c].value);
        most = std::max(most, best.candidates[c].value);
    }
    EXPECT_LT(mean, most);
    EXPECT_GT(mean, 4);
}

// Optimal play from rung 1 has a mean return of 4.75; a mean of 400 episodes has an error of 0.18.
TEST(Uct, PlaysOptimally) {
    const Played plan = run(ladder(), "plan:uct,iterations=3000", 400);
    EXPECT_NEAR(plan.mean(), 4.75, 0.55);
    EXPECT_EQ(plan.summary.illegal_actions, 0);
}

// Once the game is over, nothing changes any more, and there is no search.
TEST(Uct, SeesWhereNothingChanges) {
    const Played plan = run(ladder(), "plan:uct,iterations=500", 40);
    int over = 0;
    for (const auto& [place, explanation] : plan.explanation) {
        if (explanation.note.empty()) continue;
        ++over;
        EXPECT_EQ(explanation.iterations, 0);
        for (const Explanation::Candidate& candidate : explanation.candidates)
            EXPECT_EQ(candidate.value, 0);
    }
    EXPECT_GT(over, 0);
}

workbench::LoadedProblem interpreted(const std::string& name) {
    workbench::ProblemFiles files;
    files.name = name;
    files.domain = PROBLEMS "/" + name + "/domain.rddl";
    files.instance = PROBLEMS "/" + name + "/instance.rddl";
    workbench::LoadOptions load;
    load.engine = workbench::Engine::Interpreter;
    return workbench::load_problem(files, load);
}

// A decision whose steps do not last for those draws leaves the question to a later one.
TEST(Uct, SeesLaterWhereNothingChangesIfABudgetWasTooShort) {
    const workbench::LoadedProblem problem = interpreted("corridor");
    const Played plan =
        run(*problem.simulator, "plan:uct,lanes=1,steps=2100,initial=determinised", 3);
    int over = 0;
    for (const auto& [place, explanation] : plan.explanation) {
        const bool is_over = std::ranges::all_of(
            explanation.candidates, [](const auto& candidate) { return candidate.value == 0; });
        if (!is_over) continue;
        ++over;
        EXPECT_FALSE(explanation.note.empty()) << place.first << " " << place.second;
    }
    EXPECT_GT(over, 0);
}

// An error leaves no half of a node.
TEST(Uct, ForgetsAnEpisodeAfterAnError) {
    static int calls_left = 0;
    static const rddl_simulator& true_one = ladder();
    rddl_simulator simulator = ladder();
    simulator.step = [](rddl_batch* batch, const void* actions, const rddl_transition* out) {
        return --calls_left == 0 ? RDDL_OUT_OF_MEMORY : true_one.step(batch, actions, out);
    };
    const solvers::BatchHandle batch = solvers::create_batch(simulator, {});
    // The values that a decision finds after another one in which that call has failed; 0: none.
    const auto values_after = [&](int failing_call) {
        PolicySettings settings = settings_of(simulator);
        std::vector<double> values;
        settings.explain = [&](const Explanation& explanation) {
            for (const Explanation::Candidate& candidate : explanation.candidates)
                values.push_back(candidate.value);
        };
        const solvers::Actor actor =
            planner_policy(simulator, "plan:uct,iterations=20,lanes=4,initial=lookahead", settings)
                .start(1);
        std::vector<std::byte> action(static_cast<std::size_t>(simulator.problem->action_size));
        const std::int64_t episode = 0, step = 1;
        const std::uint8_t running = 1;
        solvers::Decision decision{batch.get(), {&running, 1}, {&episode, 1},
                                   {&step, 1},  action.data(), {}};
        calls_left = failing_call;
        if (failing_call > 0) {
            EXPECT_ANY_THROW(actor(decision));
        }
        calls_left = 0;
        actor(decision);
        return values;
    };
    const std::vector<double> expected = values_after(0);
    EXPECT_EQ(expected.size(), 3u);
    const int calls = -calls_left;
    for (int call = 1; call <= calls; ++call) EXPECT_EQ(values_after(call), expected) << call;
}

// A goal that no random play meets is found in the determinised problem: 12 steps, of which each is
// made 1 / 0.9 times. The mean of 20 episodes has an error of 0.3.
TEST(Uct, FindsADistantGoal) {
    const workbench::LoadedProblem problem = interpreted("corridor");
    const std::string planner = "plan:uct,iterations=50,lanes=8";
    EXPECT_NEAR(run(*problem.simulator, planner, 20).mean(), -13.3, 1.2);
    EXPECT_LT(run(*problem.simulator, planner + ",initial=rollout").mean(), -29);
}

// With a lookahead of one step a new state is worth that step and what a policy does after it. In
// the network random play, which is better than no-op, is worth 70.
TEST(Uct, ValuesTheRestByAPolicy) {
    const Explanation first =
        run(network(), "plan:uct,lookahead=1,iterations=1,lanes=1").thought(0, 0);
    double sum = 0;
    for (const Explanation::Candidate& candidate : first.candidates) sum += candidate.value;
    EXPECT_NEAR(sum / static_cast<double>(first.candidates.size()), 70, 12);
}

// A policy's own action is tried more often than without a policy, however bad it is. The values
// stay the same.
TEST(Uct, MakesTrialsWhereTheDeterminisedProblemWouldTakeTheBudget) {
    EXPECT_GT(run(network(), "plan:uct,steps=1000").thought(0, 0).iterations, 0);
    const Explanation asked =
        run(network(), "plan:uct,steps=50,initial=determinised").thought(0, 0);
    EXPECT_EQ(asked.iterations, 0);
    EXPECT_EQ(asked.note, "the budget did not last for a trial");
}

TEST(Uct, TriesTheActionOfThePolicyFirst) {
    const auto thought = [](const std::string& options) {
        return run(ladder(), "plan:uct,initial=lookahead,lanes=1," + options).thought(0, 0);
    };
    const Explanation with = thought("iterations=60,policy=noop"),
                      without = thought("iterations=60");
    EXPECT_GT(with.candidates[0].trials, without.candidates[0].trials + 5);
    EXPECT_EQ(thought("iterations=20000,policy=noop").chosen, 1u);
    EXPECT_NEAR(thought("iterations=20000,policy=noop").candidates[1].value, 4.75, 0.15);
    EXPECT_EQ(
        run(network(), "plan:uct,policy=random,initial=determinised,steps=5000").summary.episodes,
        1);
}

// The first decision has so many trials as candidates show. The second one has those of the first
// one that began with what came of it, as well.
TEST(Uct, KeepsTheTreeFromOneDecisionToTheNext) {
    const auto trials = [](const Explanation& explanation) {
        std::int64_t sum = 0;
        for (const Explanation::Candidate& candidate : explanation.candidates)
            sum += candidate.trials - 1;  // one value is by the determinised problem
        return sum;
    };
    const Played plan = run(ladder(), "plan:uct,iterations=2000,lanes=8", 20);
    int kept = 0;
    for (std::int64_t episode = 0; episode < 20; ++episode) {
        EXPECT_EQ(trials(plan.thought(episode, 0)), plan.thought(episode, 0).iterations);
        const Explanation& next = plan.thought(episode, 1);
        EXPECT_GE(trials(next), next.iterations);
        kept += trials(next) > next.iterations;
    }
    EXPECT_EQ(kept, 20);
}

// The typical outcome of a step forward is the next place. The goal is 12 of them away.
TEST(DeterminisedProblem, HasTheValuesOfTypicalCourses) {
    const workbench::LoadedProblem loaded = interpreted("corridor");
    const rddl_simulator& simulator = *loaded.simulator;
    const auto size = static_cast<std::size_t>(simulator.problem->state_size);
    const auto actions = FiniteActions::of(simulator, solvers::action_space(simulator), 10);
    ASSERT_TRUE(actions);
    TypicalSteps steps(simulator, *actions);
    DeterminisedProblem problem(size, 1);
    std::vector<std::byte> record(size);
    simulator.initial_state(&simulator, record.data());
    const auto start = problem.state_of(record.data());
    Budget budget;
    budget.iterations = 1;
    BudgetMeter meter(budget, nullptr);
    EXPECT_EQ(problem.affordable_depth(start, 20, 1, steps, meter), 1);
    EXPECT_EQ(problem.affordable_depth(start, 20, 5, steps, meter), 5);
    EXPECT_EQ(problem.affordable_depth(start, 20, 13, steps, meter), 20);  // there are no more
    problem.set_depth(20);
    const std::int64_t made = meter.steps();
    ASSERT_TRUE(problem.open({&start, 1}, steps, meter));
    EXPECT_EQ(meter.steps(), made);  // all is known
    const auto moves = problem.moves(start);
    ASSERT_EQ(moves.size(), 2u);  // no-op, forward
    ASSERT_EQ(problem.twins(start).size(), 1u);
    EXPECT_EQ(problem.twins(start)[0].action, 2u);  // side: as no-op
    const std::tuple<int, std::int64_t, double> courses[] = {
        {1, 5, -5}, {1, 13, -12}, {1, 20, -12}, {0, 1, -1}, {0, 20, -13}};
    for (const auto& [move, depth, value] : courses) {
        const auto course = problem.after(moves[static_cast<std::size_t>(move)], depth);
        EXPECT_EQ(course.value, value) << move << " " << depth;
        EXPECT_EQ(problem.stays(course.end), depth >= 13) << move << " " << depth;
    }
    EXPECT_FALSE(problem.stays(start));
    auto state = start;
    for (int place = 0; place < 12; ++place) state = problem.moves(state)[1].next;
    EXPECT_TRUE(problem.stays(state));
    Budget none;
    none.steps = 1;
    BudgetMeter empty(none, nullptr);
    problem.clear();
    EXPECT_EQ(problem.affordable_depth(problem.state_of(record.data()), 20, 5, steps, empty), 0);
}

// All three actions have the same typical outcome. Draws tell a wish from no-op, and a prayer is
// the same as no-op. Wishes are worth 0.3 + 0.51 + 0.657.
TEST(Uct, TellsTwinsApartByDraws) {
    const workbench::LoadedProblem problem = interpreted("lottery");
    const Played plan = run(*problem.simulator, "plan:uct,iterations=4000", 20);
    const Explanation& first = plan.thought(0, 0);
    ASSERT_EQ(first.candidates.size(), 2u);
    EXPECT_EQ(first.chosen, 1u);
    EXPECT_NEAR(first.candidates[1].value, 1.467, 0.1);
    EXPECT_EQ(plan.returns(), run(*problem.simulator, "plan:uct,iterations=4000", 20, 3).returns());
    // No draws, no difference.
    EXPECT_EQ(run(*problem.simulator, "plan:uct,steps=40,initial=determinised,lanes=1")
                  .thought(0, 0)
                  .candidates.size(),
              1u);
}

TEST(DeterminisedProblem, MakesMovesOfTwinsThatDiffer) {
    const workbench::LoadedProblem loaded = interpreted("lottery");
    const rddl_simulator& simulator = *loaded.simulator;
    const auto actions = FiniteActions::of(simulator, solvers::action_space(simulator), 10);
    ASSERT_TRUE(actions);
    TypicalSteps steps(simulator, *actions);
    DeterminisedProblem problem(static_cast<std::size_t>(simulator.problem->state_size), 1);
    std::vector<std::byte> record(static_cast<std::size_t>(simulator.problem->state_size));
    simulator.initial_state(&simulator, record.data());
    const auto start = problem.state_of(record.data());
    Budget budget;
    budget.iterations = 1;
    BudgetMeter meter(budget, nullptr);
    ASSERT_TRUE(problem.open({&start, 1}, steps, meter));
    ASSERT_EQ(problem.moves(start).size(), 1u);
    ASSERT_EQ(problem.twins(start).size(), 2u);
    const std::vector<std::uint8_t> last_differs{0, 1};
    problem.add_comparison(start, 4, last_differs);
    ASSERT_EQ(problem.moves(start).size(), 2u);
    EXPECT_EQ(problem.moves(start)[1].action, 2u);
    ASSERT_EQ(problem.twins(start).size(), 1u);
    EXPECT_EQ(problem.twins(start)[0].action, 1u);
    EXPECT_EQ(problem.compared(start), 4);
    problem.forget_twins(start);
    EXPECT_TRUE(problem.twins(start).empty());
    EXPECT_EQ(problem.moves(start).size(), 2u);
}

// Edges that are added later leave those that there are as they were.
TEST(Tree, AddsEdgesLater) {
    Tree tree(8, 1, Backup::Max);
    tree.clear();
    const std::vector<std::byte> first(8), second(8, std::byte{1});
    const NodeId node = tree.node_of(first.data(), 0), other = tree.node_of(second.data(), 0);
    tree.add_estimate(node, tree.add_edge(node, 5), 3);
    tree.add_estimate(other, tree.add_edge(other, 6), 4);
    tree.start(node, tree.node(node).first_edge);
    tree.back_up(node, tree.node(node).first_edge,
                 tree.add_outcome(tree.node(node).first_edge, other), 1, 0);
    tree.reopen_edges(node);
    tree.add_estimate(node, tree.add_edge(node, 7), 2);
    const auto edges = tree.edges(tree.node(node));
    ASSERT_EQ(edges.size(), 2u);
    EXPECT_EQ(edges[0].action, 5u);
    EXPECT_EQ(edges[0].done, 1);
    EXPECT_EQ(edges[1].action, 7u);
    EXPECT_EQ(tree.arms(tree.node(node))[0].weight, 2);
    EXPECT_EQ(tree.node(node).weight, 3);
    EXPECT_EQ(tree.add_outcome(tree.node(node).first_edge, other), 0u);  // not another one
    EXPECT_EQ(tree.edges(tree.node(other))[0].action, 6u);
}

// A state that several actions lead to has a place among the outcomes of each. The sum that an edge
// keeps is that of its outcomes, by the values that they had in its own trials.
TEST(Tree, SumsOutcomesAsTheyCome) {
    Tree tree(8, 1, Backup::Max);
    tree.clear();
    const std::vector<std::byte> first(8), second(8, std::byte{1}), third(8, std::byte{2});
    const NodeId node = tree.node_of(first.data(), 0), good = tree.node_of(second.data(), 1),
                 bad = tree.node_of(third.data(), 1);
    const EdgeId left = tree.add_edge(node, 0), right = tree.add_edge(node, 1);
    const auto go = [&](EdgeId edge, NodeId to) {
        tree.start(node, edge);
        tree.back_up(node, edge, tree.add_outcome(edge, to), 0, 0);
        return tree.arm(edge).value;
    };
    tree.node(good).value = 6;
    tree.node(bad).value = -3;
    EXPECT_EQ(go(left, good), 6);
    EXPECT_EQ(go(left, bad), 1.5);
    EXPECT_EQ(go(right, good), 6);
    EXPECT_EQ(tree.node(node).best, 1);
    tree.node(good).value = 9;
    EXPECT_EQ(go(left, bad), 0);   // 6, -3, -3
    EXPECT_EQ(go(left, good), 3);  // 9, 9, -3, -3
    tree.node(bad).value = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(go(left, bad), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(go(left, bad), -std::numeric_limits<double>::infinity());
    tree.node(bad).value = 0;
    EXPECT_DOUBLE_EQ(go(left, bad), 18.0 / 7);  // 9, 9, and 0 five times
    EXPECT_EQ(tree.node(node).value, 6);
}

// The tree keeps all that follows the action, with its counts, and forgets the rest.
TEST(Tree, KeepsWhatIsBelowAnAction) {
    Tree tree(8, 1, Backup::Max);
    tree.clear();
    const auto state = [](std::uint64_t number) {
        std::vector<std::byte> record(8);
        std::memcpy(record.data(), &number, 8);
        return record;
    };
    const auto add = [&](std::uint64_t number, std::int64_t step) {
        const NodeId node = tree.node_of(state(number).data(), step);
        for (const std::uint32_t action : {0u, 1u}) tree.add_edge(node, action);
        tree.node(node).is_open = true;
        return node;
    };
    const NodeId root = add(1, 0), left = add(2, 1), right = add(3, 1), last = add(4, 2);
    const NodeId closed = tree.node_of(state(5).data(), 2);
    const auto start = [&](NodeId from, std::uint32_t action, NodeId to) {
        const EdgeId edge = tree.node(from).first_edge + action;
        tree.start(from, edge);
        return tree.add_outcome(edge, to);
    };
    const auto go = [&](NodeId from, std::uint32_t action, NodeId to, double reward, double rest) {
        const std::uint32_t outcome = start(from, action, to);
        tree.back_up(from, tree.node(from).first_edge + action, outcome, reward, rest);
    };
    go(last, 1, Tree::over, 5, 0);
    go(right, 0, last, 1, 5);
    tree.cancel(right, tree.node(right).first_edge, start(right, 0, closed));
    go(root, 0, left, 0, 0);
    go(root, 1, right, 2, 6);
    const double value = tree.node(right).value;
    tree.keep_below(tree.node(root).first_edge + 1);
    EXPECT_EQ(tree.size(), 3u);  // with the node of all ends
    EXPECT_EQ(tree.find(state(1).data(), 0), nullptr);
    EXPECT_EQ(tree.find(state(2).data(), 1), nullptr);
    EXPECT_EQ(tree.find(state(5).data(), 2), nullptr);
    const NodeId* const kept = tree.find(state(3).data(), 1);
    ASSERT_NE(kept, nullptr);
    EXPECT_EQ(tree.node(*kept).value, value);
    const Edge& edge = tree.edges(tree.node(*kept))[0];
    EXPECT_EQ(edge.done, 1);
    EXPECT_EQ(tree.node(*kept).weight, 1);
    EXPECT_EQ(tree.node(*kept).untried, 1);
    EXPECT_EQ(edge.outcome_count, 1);
    EXPECT_EQ(tree.seen_outcome(tree.id_of(edge), 0.5), *tree.find(state(4).data(), 2));
    EXPECT_EQ(tree.arms(tree.node(*tree.find(state(4).data(), 2)))[1].value, 5);
}

// With few outcomes that are distinguished, trials go on from those that were seen.
TEST(Uct, WidensOutcomes) {
    const Played narrow = run(network(), "plan:uct,steps=20000,outcomes=0.5");
    EXPECT_EQ(narrow.summary.illegal_actions, 0);
    EXPECT_EQ(narrow.summary.episodes, 1);
    EXPECT_GT(narrow.thought(0, 0).iterations, 0);
}

TEST(Uct, TriesActionsByThePriorsOfAPolicy) {
    const Played by_action = run(network(), "plan:uct,iterations=200,policy=noop");
    const Played by_priors =
        run(network(), "plan:uct,iterations=200,policy=fond of the last action");
    const auto trials_of_last = [](const Played& played) {
        return played.thought(0, 0).candidates.back().trials;
    };
    EXPECT_GT(trials_of_last(by_priors), 2 * trials_of_last(by_action));
    for (const auto& candidate : by_priors.thought(0, 0).candidates)
        EXPECT_TRUE(std::isfinite(candidate.value));
    EXPECT_EQ(
        by_priors.returns(),
        run(network(), "plan:uct,iterations=200,policy=fond of the last action", 1, 2).returns());
}

TEST(Uct, ValuesNewStatesByTheValuesOfAPolicy) {
    const Played plan =
        run(ladder(), "plan:uct,iterations=4000,policy=knows the ladder,initial=value", 20);
    for (const auto& candidate : plan.thought(0, 0).candidates)
        if (candidate.trials > 1000) {
            EXPECT_NEAR(candidate.value, 4.75, 0.4);
        }
    EXPECT_NEAR(plan.mean(), 4.75, 2);
    // It is the default where the policy has values.
    EXPECT_EQ(plan.returns(),
              run(ladder(), "plan:uct,iterations=4000,policy=knows the ladder", 20).returns());
    // Without a trial the policy's likeliest action is taken.
    const Played none = run(ladder(), "plan:uct,steps=2,policy=knows the ladder,initial=value");
    EXPECT_EQ(none.mean(), 4);
}

}  // namespace
}  // namespace rddlc::planners
