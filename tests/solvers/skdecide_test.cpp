// Programs of scikit-decide: they answer as there, their files go both ways, and searches find
// them.
#include "solvers/cgp/skdecide.hpp"

#include "simulators.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/program.hpp"
#include "solvers/cgp/search.hpp"
#include "solvers/evaluation/summary.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace rddlc::solvers {
namespace {

// The file that record_skdecide_programs.py has written.
nlohmann::json recording() {
    return nlohmann::json::parse(std::ifstream(SKDECIDE_PROGRAMS));
}

std::string names_of(const nlohmann::json& recorded) {
    std::string names;
    for (const std::string name : recorded["functions"]) names += name + " ";
    return names;
}

std::string file_of(const nlohmann::json& program, const std::string& names) {
    return program["lines"][0].get<std::string>() + "\n" + program["lines"][1].get<std::string>() +
           "\n" + names;
}

TEST(Skdecide, AnswersAsScikitDecideDoes) {
    const nlohmann::json recorded = recording();
    const std::string names = names_of(recorded);
    EXPECT_EQ(recorded["example"], file_of(recorded["programs"][0], names));
    ASSERT_GE(recorded["programs"].size(), 100u);
    int moving = 0;
    std::set<Function> seen;  // in nodes that count
    for (const nlohmann::json& example : recorded["programs"]) {
        const std::string text = file_of(example, names);
        ASSERT_TRUE(is_skdecide_genome(text));
        const Genome genome = read_skdecide_genome(text);
        const Activity activity = activity_of(genome);
        for (std::size_t n = 0; n < genome.nodes.size(); ++n)
            if (activity.used[static_cast<std::size_t>(genome.first_node()) + n])
                seen.insert(genome.nodes[n].function);
        const Program program(genome);
        std::vector<double> values(static_cast<std::size_t>(program.slots()));
        const auto outputs = example["outputs"][0].size();
        for (std::size_t step = 0; step < example["inputs"].size(); ++step) {
            const std::vector<double> inputs = example["inputs"][step],
                                      expected = example["outputs"][step];
            std::vector<double> found(outputs);
            program.run(1, inputs.data(), 1, values.data(), found.data());
            for (std::size_t o = 0; o < outputs; ++o)
                EXPECT_NEAR(found[o], expected[o], 1e-10) << text << " in step " << step;
        }
        moving += example["outputs"].front() != example["outputs"].back();
    }
    EXPECT_GT(moving, 50);
    const std::vector<Function> all = skdecide_functions();
    EXPECT_EQ(seen, std::set<Function>(all.begin(), all.end()));
}

TEST(Skdecide, LanesRememberWhatOneDoes) {
    const nlohmann::json recorded = recording();
    const std::string names = names_of(recorded);
    for (std::size_t p = 0; p < 100; ++p) {
        const Genome genome = read_skdecide_genome(file_of(recorded["programs"][p], names));
        const Program program(genome);
        const auto slots = static_cast<std::size_t>(program.slots()),
                   outputs = genome.outputs.size(), width = static_cast<std::size_t>(genome.inputs);
        std::vector<double> one(slots), three(slots * 3), alone(outputs), together(outputs * 3);
        for (const auto& row : recorded["programs"][p]["inputs"]) {
            const std::vector<double> inputs = row;
            std::vector<double> rows(width * 3, 0.5);
            for (std::size_t i = 0; i < width; ++i) rows[i * 3 + 1] = inputs[i];
            program.run(1, inputs.data(), 1, one.data(), alone.data());
            program.run(3, rows.data(), 3, three.data(), together.data());
            for (std::size_t o = 0; o < outputs; ++o) EXPECT_EQ(alone[o], together[o * 3 + 1]);
        }
    }
}

TEST(Skdecide, MapsInputsAndOutputs) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const nlohmann::json recorded = recording();
    ProgramScope scope;
    const double bounds[][2] = {{-2.5, 4}, {0, 1}, {0, 4}, {-infinite, infinite}, {0, infinite}};
    std::vector<int> used;
    for (const auto& [lower, upper] : bounds) {
        ObservationSpace::Column column;
        column.lower = lower;
        column.upper = upper;
        scope.observations.columns.push_back(column);
        used.push_back(static_cast<int>(used.size()));
    }
    for (const nlohmann::json& row : recorded["inputs"]) {
        const std::vector<float> observed = row["observed"];
        const std::vector<double> expected = row["inputs"];
        std::vector<double> inputs(5);
        read_skdecide_inputs(scope, observed.data(), used, inputs.data(), 1);
        for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(inputs[i], expected[i], 1e-6) << row;
    }
    RealHead real;
    real.range = RealHead::Range::Bounded;
    real.lower = -3;
    real.upper = 5;
    scope.actions.reals = {real};
    scope.actions.categories = {{1, 0, 2, 0}, {2, 2, 7, 0}};
    scope.actions.logit_count = 9;
    for (const nlohmann::json& each : recorded["outputs"]) {
        const std::vector<double> values(3, each["output"].get<double>());
        const std::vector<double> expected = each["action"];
        std::vector<float> row(10);
        write_skdecide_outputs(scope, values.data(), 1, row.data());
        EXPECT_NEAR(real_value(real, row[0]), expected[0], 1e-5);
        const auto chosen = [&](int first, int last) {
            return std::max_element(row.begin() + first, row.begin() + last) - row.begin() - first;
        };
        EXPECT_EQ(chosen(1, 3), expected[1]) << each;
        EXPECT_EQ(chosen(3, 10), expected[2]) << each;
    }
}

CgpOptions skdecide_search() {
    CgpOptions options;
    options.skdecide = true;
    options.generations = 60;
    options.nodes = 40;
    options.seed = 5;
    return options;
}

TEST(Skdecide, SearchesDriveUphillAndGoOn) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    CgpSearch whole(car, skdecide_search()), first(car, skdecide_search()),
        second(car, skdecide_search());
    whole.run(60);
    first.run(25);
    second.load(first.save());
    second.run(35);
    const std::string text = program_text(car, whole.scope(), whole.best());
    EXPECT_EQ(text, program_text(car, second.scope(), second.best()));
    EXPECT_GT(whole.progress().best.value, 0);
    EXPECT_NE(program_formula(whole.scope(), whole.best()).find("before("), std::string::npos);

    // Episodes begin with nothing in mind: those of a batch are as the one of the search.
    const auto found = read_program(car, text);
    EpisodeOptions episodes;
    episodes.episodes = 3;
    episodes.batch = 1;
    const Rollouts rollouts = run_episodes(car, program_policy(car, found, "cgp"), episodes, {});
    for (const Episode& episode : rollouts.episodes)
        EXPECT_EQ(episode.undiscounted_return, whole.progress().best.value);
    CgpOptions other = skdecide_search();
    other.skdecide = false;
    EXPECT_THROW(CgpSearch(car, other).load(first.save()), Failure);
}

TEST(Skdecide, ActsInAllKindsOfProblemsOrSaysWhyNot) {
    int acts = 0;
    for (const rddl_simulator* simulator : simulators()) {
        try {
            CgpSearch search(*simulator, skdecide_search());
            search.run(2);
            read_program(*simulator, program_text(*simulator, search.scope(), search.best()));
            acts += 1;
        } catch (const Failure& failure) {
            EXPECT_NE(std::string(failure.what()).find("scikit-decide"), std::string::npos);
        }
    }
    EXPECT_GE(acts, 2);
}

TEST(Skdecide, RefusesOptionsThatItBringsItself) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    CgpOptions options = skdecide_search();
    options.constants = 2;
    EXPECT_THROW(CgpSearch(car, options), Failure);
    options = skdecide_search();
    options.functions = functions_named({"arith"});
    EXPECT_THROW(CgpSearch(car, options), Failure);
}

TEST(Skdecide, RefusesWhatIsNoGenome) {
    const rddl_simulator& car = *rddl_simulator_mountain_car_mountain_car_1();
    CgpSearch search(car, skdecide_search());
    const std::string text = program_text(car, search.scope(), search.best());
    EXPECT_NO_THROW(read_program(car, text));
    const std::size_t names = text.find("sum "), ours = text.find("domain ");
    EXPECT_NO_THROW(read_program(car, text.substr(0, ours)));  // theirs
    for (const std::size_t size :
         {std::size_t{3}, std::size_t{20}, names / 2, names, names + 1, ours + 3, text.size() - 6})
        EXPECT_THROW(read_program(car, text.substr(0, size)), Failure) << size;
    EXPECT_THROW(read_program(*rddl_simulator_reservoir_reservoir_1(), text), Failure);
    EXPECT_THROW(read_program(car, "2 1 1 1\n0 0 9 2\nsum"), Failure);    // no such address
    EXPECT_THROW(read_program(car, "2 1 1 1\n1 0 1 2\nsum"), Failure);    // no such function
    EXPECT_THROW(read_program(car, "2 1 1 1\n0 0 1 2\nmagic"), Failure);  // nor its name
    EXPECT_THROW(read_program(car, "2 1 1 1\n0 0 x 2\nsum"), Failure);
    EXPECT_THROW(read_program(car, "2 1 99999999 9999\n0\nsum"), Failure);
    EXPECT_THROW(read_program(car, "3 1 1 1\n0 0 1 3\nsum"), Failure);  // other inputs
}

}  // namespace
}  // namespace rddlc::solvers
