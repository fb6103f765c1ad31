// The same answers from a linked, a loaded and an interpreted simulator, and from one that changes
// between the last two.
#include "engines/load_simulator.hpp"
#include "network.h"
#include "reservoir.h"
#include "solvers/batches/batch.hpp"
#include "tree_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rddlc::workbench {
namespace {

Simulator load(const std::string& name, Engine engine, bool details = true) {
    const auto folder = std::filesystem::path(RDDL_EXAMPLES) / name;
    ProblemFiles files;
    files.name = name;
    files.domain = folder / "domain.rddl";
    files.instance = folder / "instance.rddl";
    LoadOptions options;
    options.engine = engine;
    options.quiet = true;
    options.details = details;
    return load_problem(files, options).simulator;
}

// All of them, by what they are.
std::map<std::string, Simulator> simulators_of(const std::string& name,
                                               const rddl_simulator* linked) {
    return {{"linked", Simulator(linked, [](const rddl_simulator*) {})},
            {"loaded", load(name, Engine::Compiled)},
            {"interpreted", load(name, Engine::Interpreter)},
            {"auto", load(name, Engine::Auto)}};
}
const std::map<std::string, Simulator>& networks() {
    static const auto all = simulators_of("network", rddl_simulator_network_network_1());
    return all;
}
const std::map<std::string, Simulator>& reservoirs() {
    static const auto all = simulators_of("reservoir", rddl_simulator_reservoir_reservoir_1());
    return all;
}

std::int32_t fluent_named(const rddl_simulator& simulator, const std::string& name) {
    for (std::int32_t f = 0; f < simulator.problem->fluent_count; ++f)
        if (rddl_fluent_at(simulator.problem, f)->name == name) return f;
    ADD_FAILURE() << "no " << name;
    return 0;
}

// A record's values of a fluent of reals.
std::vector<double> reals(const rddl_simulator& simulator, const std::vector<std::byte>& record,
                          const std::string& name) {
    const rddl_fluent& fluent = simulator.problem->fluents[fluent_named(simulator, name)];
    std::vector<double> values(static_cast<std::size_t>(fluent.count));
    std::memcpy(values.data(), record.data() + fluent.offset, values.size() * sizeof(double));
    return values;
}

// Written on two lines.
TEST(Conditions, AreToldOnOneLine) {
    for (const Engine engine : {Engine::Compiled, Engine::Interpreter})
        EXPECT_STREQ(load("delivery", engine)->problem->preconditions[0].text,
                     "forall_{?v : van, ?p : parcel} [ take(?v, ?p) => (status(?p) == @waiting ^ "
                     "position(?v) == ORIGIN(?p)) ]");
}

TEST(TreeSearch, GrowsTheSameTreeOnEverySimulator) {
    // Half of the network is down in the middle of an episode.
    const rddl_problem& problem = *networks().at("linked")->problem;
    std::vector<std::byte> root(static_cast<std::size_t>(problem.state_size));
    for (std::size_t i = 0; i < root.size(); i += 2) root[i] = std::byte{1};
    const std::int64_t steps = problem.horizon - 6;
    std::vector<TreeSearch::Verdict> verdicts;
    for (const auto& [kind, simulator] : networks()) {
        TreeSearch search(simulator.get(), root.data(), steps);
        search.grow(600);
        verdicts.push_back(search.verdict());
        EXPECT_EQ(verdicts.back().visits, verdicts.front().visits) << kind;
        EXPECT_EQ(verdicts.back().values, verdicts.front().values) << kind;
    }
    // A reboot of what is down is worth more than nothing, and than one of what runs.
    const auto& visits = verdicts.front().visits;
    const auto best = std::max_element(visits.begin(), visits.end()) - visits.begin();
    EXPECT_GT(best, 0);
    EXPECT_EQ(best % 2, 0) << "choice k reboots computer k - 1, of which the odd ones are down";
}

TEST(Constants, AreThoseOfTheInstance) {
    for (const auto& [kind, simulator] : networks()) {
        const std::int32_t link = fluent_named(*simulator, "LINK");
        const std::int64_t count = simulator->problem->fluents[link].count;
        std::vector<std::uint8_t> links(static_cast<std::size_t>(count));
        ASSERT_EQ(simulator->get_constants(simulator.get(), link, 0, count, links.data()), RDDL_OK);
        EXPECT_EQ(std::count(links.begin(), links.end(), 1), 8) << kind << ": a ring of 8";
        double up = 0;
        const std::int32_t alone = fluent_named(*simulator, "ALONE-UP");
        ASSERT_EQ(simulator->get_constants(simulator.get(), alone, 0, 1, &up), RDDL_OK);
        EXPECT_EQ(up, 0.45) << kind;
    }
    std::vector<std::vector<double>> tables;
    for (const auto& [kind, simulator] : reservoirs())
        for (const char* const name : {"CAPACITY", "RAIN-SHAPE", "SAFE-LOW"}) {
            const std::int32_t fluent = fluent_named(*simulator, name);
            std::vector<double> values(
                static_cast<std::size_t>(simulator->problem->fluents[fluent].count));
            ASSERT_EQ(simulator->get_constants(simulator.get(), fluent, 0, std::ssize(values),
                                               values.data()),
                      RDDL_OK);
            tables.push_back(values);
            EXPECT_EQ(values, tables[(tables.size() - 1) % 3]) << kind << " " << name;
        }
}

TEST(InitialState, IsThatOfAReset) {
    for (const auto& [kind, simulator] : reservoirs()) {
        const solvers::BatchHandle batch = solvers::create_batch(*simulator, {});
        const auto size = static_cast<std::size_t>(simulator->problem->state_size);
        std::vector<std::byte> reset(size), initial(size);
        simulator->get_state(batch.get(), 0, 1, reset.data());
        ASSERT_EQ(simulator->initial_state(simulator.get(), initial.data()), RDDL_OK);
        EXPECT_EQ(reset, initial) << kind;
    }
}

// Random levels, and releases that the preconditions allow.
TEST(Interm, IsWhatTheLastStepComputed) {
    std::vector<std::vector<std::byte>> records;
    for (const auto& [kind, simulator] : reservoirs()) {
        const rddl_problem& problem = *simulator->problem;
        rddl_batch_options options{};
        options.environment_count = 20;
        options.seed = 3;
        options.keeps_steps = 1;
        options.autoreset = RDDL_AUTORESET_SAME_STEP;
        options.horizon = 7;
        const solvers::BatchHandle batch = solvers::create_batch(*simulator, options);
        const auto size = static_cast<std::size_t>(problem.interm_size);
        std::vector<std::byte> interm(size);
        EXPECT_EQ(simulator->get_interm(batch.get(), 17, 1, interm.data()), RDDL_BAD_ARGUMENT);
        EXPECT_STREQ(simulator->last_error(simulator.get()), "environment 17 has made no step");
        std::vector<double> actions(20 * 4, 1.5);
        const std::int64_t state_size = problem.state_size;
        std::vector<std::byte> finals(static_cast<std::size_t>(20 * state_size));
        std::vector<std::byte> state(static_cast<std::size_t>(state_size));
        rddl_transition out{};
        out.final_states = finals.data();
        int rainy = 0;
        for (int time = 1; time <= 10; ++time) {
            ASSERT_EQ(simulator->step(batch.get(), actions.data(), &out), RDDL_OK);
            simulator->get_state(batch.get(), 17, 1, state.data());
            if (time == 7)  // the episode is over, and its last state known
                std::copy_n(finals.begin() + 17 * state_size, state_size, state.begin());
            ASSERT_EQ(simulator->get_interm(batch.get(), 17, 1, interm.data()), RDDL_OK);
            const auto water = reals(*simulator, state, "water");
            const auto balance = reals(*simulator, interm, "balance");
            const auto spill = reals(*simulator, interm, "spill");
            const auto rain = reals(*simulator, interm, "rain");
            for (std::size_t b = 0; b < water.size(); ++b) {
                EXPECT_EQ(water[b], std::max(0.0, balance[b] - spill[b])) << kind << time;
                rainy += rain[b] > 0;
            }
            const auto place = static_cast<std::size_t>(time - 1);
            if (records.size() <= place) records.push_back(interm);
            EXPECT_EQ(interm, records[place]) << kind << time;
        }
        EXPECT_GT(rainy, 0);
    }
}

TEST(Interm, GoesAlongWithCopies) {
    for (const auto& [kind, simulator] : reservoirs()) {
        rddl_batch_options options{};
        options.environment_count = 2;
        options.keeps_steps = 1;
        const solvers::BatchHandle from = solvers::create_batch(*simulator, options),
                                   to = solvers::create_batch(*simulator, options);
        const std::vector<double> actions(2 * 4, 1.0);
        const rddl_transition nothing{};
        ASSERT_EQ(simulator->step(from.get(), actions.data(), &nothing), RDDL_OK);
        const std::int64_t source = 1;
        ASSERT_EQ(simulator->copy_environments(to.get(), 0, 1, from.get(), &source), RDDL_OK);
        const auto size = static_cast<std::size_t>(simulator->problem->interm_size);
        std::vector<std::byte> expected(size), copied(size);
        ASSERT_EQ(simulator->get_interm(from.get(), 1, 1, expected.data()), RDDL_OK);
        ASSERT_EQ(simulator->get_interm(to.get(), 0, 1, copied.data()), RDDL_OK) << kind;
        EXPECT_EQ(copied, expected) << kind;
        EXPECT_EQ(simulator->get_interm(to.get(), 1, 1, copied.data()), RDDL_BAD_ARGUMENT);
    }
}

TEST(Interm, NeedsABatchThatKeepsStepsAndASimulatorWithDetails) {
    const Simulator plain = load("reservoir", Engine::Interpreter, false);
    EXPECT_EQ(plain->problem->interm_size, 0);
    EXPECT_EQ(plain->problem->fluents[fluent_named(*plain, "rain")].offset, -1);
    const solvers::BatchHandle batch = solvers::create_batch(*plain, {});
    double record[16];
    EXPECT_EQ(plain->get_interm(batch.get(), 0, 1, record), RDDL_UNSUPPORTED);
    EXPECT_STREQ(plain->last_error(plain.get()), "the simulator was made without rddlc --details");
    const Simulator& detailed = reservoirs().at("interpreted");
    const solvers::BatchHandle forgetful = solvers::create_batch(*detailed, {});
    EXPECT_EQ(detailed->get_interm(forgetful.get(), 0, 1, record), RDDL_UNSUPPORTED);
    EXPECT_STREQ(detailed->last_error(detailed.get()), "the batch was created without keeps_steps");
}

TEST(Violations, NameTheObjects) {
    for (const auto& [kind, simulator] : reservoirs()) {
        rddl_batch_options options{};
        options.environment_count = 3;
        const solvers::BatchHandle batch = solvers::create_batch(*simulator, options);
        std::vector<double> action = {0, 0, 1e6, 0};
        rddl_violation violation{};
        ASSERT_EQ(simulator->explain_violation(batch.get(), 2, action.data(), &violation), RDDL_OK);
        EXPECT_EQ(violation.precondition, 1) << kind;
        const std::string message = violation.message;
        EXPECT_NE(message.find(": precondition violated: forall_{?b : basin} [release(?b) <= "
                               "water(?b)] (at ?b = "),
                  std::string::npos)
            << kind << ": " << message;
        const rddl_type& basins = *rddl_type_at(simulator->problem, 0);
        EXPECT_NE(message.find(std::string("?b = ") + basins.objects[2] + ")"), std::string::npos)
            << kind << ": " << message;
        EXPECT_GT(violation.source.line, 0);
        action[2] = 0;
        ASSERT_EQ(simulator->explain_violation(batch.get(), 2, action.data(), &violation), RDDL_OK);
        EXPECT_EQ(violation.precondition, -1);
    }
}

}  // namespace
}  // namespace rddlc::workbench
