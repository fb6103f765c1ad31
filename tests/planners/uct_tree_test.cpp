// Plan:uct searches in its tree and in the determinised problem.
#include "planners/simulation/record_hash.hpp"
#include "planners/uct/determinised_problem.hpp"
#include "planners/uct/tree.hpp"
#include "planning.hpp"
#include "solvers/spaces/actions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

namespace rddlc::planners {
namespace {

// Each byte counts, whatever the size, and so does the step. All records of 12 bools differ.
TEST(RecordHash, DiffersWithEachByte) {
    EXPECT_NE(hash_of(nullptr, 0), hash_of(nullptr, 0, 1));  // a problem without state fluents
    for (std::size_t size = 1; size < 40; ++size) {
        std::vector<std::byte> record(size);
        std::set<std::uint64_t> keys{hash_of(record.data(), size), hash_of(record.data(), size, 1)};
        for (std::byte& byte : record) {
            byte = std::byte{1};
            keys.insert(hash_of(record.data(), size));
            byte = std::byte{0};
        }
        EXPECT_EQ(keys.size(), size + 2);
    }
    constexpr std::size_t bools = 12;
    std::set<std::uint64_t> keys;
    for (unsigned k = 0; k < 1u << bools; ++k) {
        std::array<std::byte, bools + 3> record{};
        for (unsigned b = 0; b < bools; ++b) record[b] = static_cast<std::byte>(k >> b & 1);
        keys.insert(hash_of(record.data(), record.size()));
    }
    EXPECT_EQ(keys.size(), 1u << bools);
}

// A tree of states that have numbers.
struct SmallTree {
    Tree tree{sizeof(std::uint64_t), 1, Backup::Max};

    SmallTree() { tree.clear(); }
    static std::vector<std::byte> record(std::uint64_t state) {
        std::vector<std::byte> bytes(sizeof state);
        std::memcpy(bytes.data(), &state, sizeof state);
        return bytes;
    }
    NodeId open(std::uint64_t state, std::int64_t step) {
        const NodeId node = tree.node_of(record(state).data(), step);
        tree.node(node).is_open = true;
        return node;
    }
    // A trial that ends in a node of that value.
    void go(NodeId from, EdgeId edge, NodeId to, double value) {
        tree.start(from, edge);
        tree.node(to).value = value;
        tree.back_up({from, edge, to, tree.add_outcome(edge, to)}, 0, value);
    }
};

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

// Each edge has a table of its own, which moves as it grows.
TEST(Tree, FindsEachOfManyOutcomes) {
    constexpr std::int32_t count = 40;
    Tree tree(sizeof(std::int32_t), 1, Backup::Max);
    tree.clear();
    const auto node_of = [&tree](std::int32_t state, std::int64_t step) {
        return tree.node_of(reinterpret_cast<const std::byte*>(&state), step);
    };
    const NodeId root = node_of(0, 0);
    const EdgeId edges[] = {tree.add_edge(root, 0), tree.add_edge(root, 1)};
    for (int round = 0; round < 3; ++round)
        for (std::int32_t state = 0; state < count; ++state)
            for (const EdgeId edge : edges) {
                const NodeId node = node_of(state, 1);
                const std::uint32_t place = tree.add_outcome(edge, node);
                EXPECT_TRUE(tree.edge(edge).outcomes.has(place));
                EXPECT_EQ(tree.add_outcome(edge, node), place);
            }
    for (const EdgeId edge : edges) EXPECT_EQ(tree.edge(edge).outcomes.count, count);
}

// Trials of a round end after all of them have met their outcomes.
TEST(Tree, FindsAnOutcomeWhoseTableHasGrown) {
    SmallTree small;
    Tree& tree = small.tree;
    const NodeId root = small.open(0, 0);
    const EdgeId edge = tree.add_edge(root, 0);
    constexpr std::uint32_t count = 100;
    std::vector<Transition> made;
    for (std::uint32_t k = 0; k < count; ++k) {
        const NodeId node = small.open(k, 1);
        tree.node(node).value = k;
        tree.start(root, edge);
        made.push_back({root, edge, node, tree.add_outcome(edge, node)});
    }
    for (const Transition& each : made) tree.back_up(each, 0, 0);
    EXPECT_EQ(tree.edge(edge).outcomes.count, count);
    EXPECT_EQ(tree.arm(edge).value, 49.5);
    const std::uint32_t place = made.back().outcome;
    tree.start(root, edge);
    tree.cancel({root, edge, made.back().after, place});
    EXPECT_EQ(tree.arm(edge).weight, static_cast<std::int32_t>(count));
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
    const EdgeId only = tree.node(node).first_edge;
    tree.back_up({node, only, other, tree.add_outcome(only, other)}, 1, 0);
    tree.reopen_edges(node);
    tree.add_estimate(node, tree.add_edge(node, 7), 2);
    const auto edges = tree.edges(tree.node(node));
    ASSERT_EQ(edges.size(), 2u);
    EXPECT_EQ(edges[0].action, 5u);
    EXPECT_EQ(edges[0].known_weight, 2);  // with its first value
    EXPECT_EQ(tree.arms(tree.node(node))[0].value, 2);
    EXPECT_EQ(edges[1].action, 7u);
    EXPECT_EQ(tree.arms(tree.node(node))[0].weight, 2);
    EXPECT_EQ(tree.node(node).weight, 3);
    tree.add_outcome(tree.node(node).first_edge, other);
    EXPECT_EQ(edges[0].outcomes.count, 1u);  // not another one
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
        tree.back_up({node, edge, to, tree.add_outcome(edge, to)}, 0, 0);
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
        return Transition{from, edge, to, tree.add_outcome(edge, to)};
    };
    const auto go = [&](NodeId from, std::uint32_t action, NodeId to, double reward, double rest) {
        tree.back_up(start(from, action, to), reward, rest);
    };
    go(last, 1, Tree::over, 5, 0);
    go(right, 0, last, 1, 5);
    tree.cancel(start(right, 0, closed));
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
    EXPECT_EQ(edge.known_weight, 1);
    EXPECT_EQ(tree.node(*kept).weight, 1);
    EXPECT_EQ(tree.node(*kept).untried, 1);
    EXPECT_EQ(edge.outcomes.count, 1u);
    EXPECT_EQ(tree.seen_outcome(tree.id_of(edge), 0.5), *tree.find(state(4).data(), 2));
    EXPECT_EQ(tree.arms(tree.node(*tree.find(state(4).data(), 2)))[1].value, 5);
}

// Edges that get other numbers find their outcomes.
TEST(Tree, FindsOutcomesOfReopenedEdges) {
    for (const std::uint32_t count : {8u, 9u, 40u}) {
        SCOPED_TRACE(count);
        SmallTree small;
        Tree& tree = small.tree;
        const NodeId root = small.open(0, 0);
        const EdgeId left = tree.add_edge(root, 0), right = tree.add_edge(root, 1);
        const auto meet_all = [&](EdgeId edge, double value) {
            for (std::uint32_t k = 0; k < count; ++k) small.go(root, edge, small.open(k, 1), value);
        };
        meet_all(left, 10);
        meet_all(right, 10);
        tree.reopen_edges(root);
        meet_all(tree.node(root).first_edge, 2);
        EXPECT_EQ(tree.edges(tree.node(root))[0].outcomes.count, count);
        EXPECT_EQ(tree.arms(tree.node(root))[0].value, 2);
        EXPECT_EQ(tree.arms(tree.node(root))[1].value, 10);
    }
}

// Trials that meet a kept outcome again do not take it for another one, whatever way they come.
TEST(Tree, FindsOutcomesThatWereKept) {
    SmallTree small;
    Tree& tree = small.tree;
    const NodeId root = small.open(1, 0), middle = small.open(2, 1), last = small.open(3, 2);
    const EdgeId first = tree.add_edge(root, 0);
    for (const std::uint32_t action : {0u, 1u}) tree.add_edge(middle, action);
    for (const EdgeId edge : {0u, 1u}) {
        small.go(middle, tree.node(middle).first_edge + edge, last, 10);
        small.go(root, first, middle, 10);
    }
    tree.keep_below(first);
    const NodeId kept = small.open(2, 1);
    for (const EdgeId edge : {0u, 1u}) {
        small.go(kept, tree.node(kept).first_edge + edge, small.open(3, 2), 2);
        EXPECT_EQ(tree.edges(tree.node(kept))[edge].outcomes.count, 1u);
        EXPECT_EQ(tree.arms(tree.node(kept))[edge].value, 2);
    }
}

// A node whose value is out of date, and was not found again in time, is not an end of the episode.
TEST(Tree, KeepsNodesThatWaitForANewValue) {
    SmallTree small;
    Tree& tree = small.tree;
    const NodeId root = small.open(1, 0), middle = small.open(2, 1), last = small.open(3, 2);
    const EdgeId first = tree.add_edge(root, 0);
    small.go(middle, tree.add_edge(middle, 0), last, 10);
    small.go(root, first, middle, 10);
    tree.node(last).is_open = false;
    tree.keep_below(first);
    const NodeId* const kept = tree.find(small.record(3).data(), 2);
    ASSERT_NE(kept, nullptr);
    EXPECT_FALSE(tree.node(*kept).is_open);
    EXPECT_EQ(tree.node(*kept).value, 10);
    const NodeId before = *tree.find(small.record(2).data(), 1);
    EXPECT_EQ(tree.seen_outcome(tree.node(before).first_edge, 0), *kept);
}

}  // namespace
}  // namespace rddlc::planners
