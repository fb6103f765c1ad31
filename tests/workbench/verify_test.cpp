// The comparisons of `rddl verify` and the pass that it blames: with programs and engines that are
// altered on purpose.
//
// Over 400 lines: a test for each thing that can be seen.
#include "engines/interpreted_simulator.hpp"
#include "support/files.hpp"
#include "verify/difference_place.hpp"
#include "verify/verdict.hpp"
#include "verify/verified_problem.hpp"
#include "verify/verified_states.hpp"
#include "verify/verify_report.hpp"
#include "verify/walk_in_step.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>

namespace rddlc::workbench {
namespace {

// Each of the numbers stands in one place alone, so that a test can change what it says.
constexpr const char* problem_text = R"(domain d {
    types { tank : object; };
    pvariables {
        INFLOW(tank) : { non-fluent, real, default = 1.0 };
        water(tank) : { state-fluent, real, default = 5.0 };
        wet : { state-fluent, bool, default = false };
        turns : { state-fluent, int, default = 0 };
        seen : { observ-fluent, real };
        pump(tank) : { action-fluent, bool, default = false };
    };
    cpfs {
        water'(?t) = water(?t) + INFLOW(?t) - (if (pump(?t)) then 3.25 else 0.5);
        wet' = Bernoulli(0.875);
        turns' = turns + 101;
        seen = sum_{?t : tank} [water'(?t) * 1.125];
    };
    reward = (sum_{?t : tank} [water(?t)]) * 7.5;
    termination { exists_{?t : tank} [water(?t) > 11.75]; turns > 7070; };
    state-invariants { forall_{?t : tank} [water(?t) >= -20.5]; };
    action-preconditions { forall_{?t : tank} [pump(?t) => water(?t) > 2.625]; };
}
non-fluents n { domain = d; objects { tank : { t1, t2, t3 }; }; }
instance i { domain = d; non-fluents = n; max-nondef-actions = 2; horizon = 60; discount = 1.0; }
)";

template <class T>
ir::Program altered(ir::Program program, T from, T to) {
    int changed = 0;
    for (ir::Node& node : program.nodes) {
        auto* const constant = std::get_if<ir::Constant>(&node.form);
        if (!constant || constant->value != Value(from)) continue;
        constant->value = to;
        ++changed;
    }
    EXPECT_EQ(changed, 1) << "the number is to stand in one place";
    program.moderate.reset();  // which would make the steps in its place
    return program;
}

class Verify : public testing::Test {
  protected:
    Verify() {
        const auto* const info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            std::filesystem::path(testing::TempDir()) / fmt::format("verify-{}", info->name());
        std::filesystem::create_directories(folder_);
    }
    ~Verify() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const std::string& name, std::string_view text) const {
        UsedFiles used;
        write_file(folder_ / name, text, used);
        return folder_ / name;
    }
    VerifiedProblem load(std::string_view text = problem_text) const {
        ProblemFiles files;
        files.name = "d";
        files.domain = file("problem.rddl", text);
        return load_for_verification(files, {}, {.compiled = false});
    }

    std::filesystem::path folder_;
};

Simulator interpreted(const VerifiedProblem& problem, ir::Program program) {
    return interpreted_simulator(std::move(program), problem.sources);
}

WalkOptions short_walk(const VerifiedProblem& problem) {
    WalkOptions options;
    options.environments = problem.environments();
    options.steps = 3000;
    return options;
}

// Pretends that one pass changed the program in this way, after one that is innocent.
void plant_wrong_pass(VerifiedProblem& problem, const ir::Program& wrong) {
    problem.engines[1].simulator = interpreted(problem, wrong);
    problem.pipeline = [wrong](const ir::Program& plain, const TellProgram& tell) {
        tell("innocent", plain);
        tell("wrong", wrong);
        tell("late", wrong);
    };
}

VerifyReport report_of(const VerifiedProblem& problem, const OutcomeComparison& comparison,
                       const WalkOptions& options) {
    VerifyReport report{problem, comparison, "P", options.seed, {}, {}, {}};
    report.walk = walk_in_step(problem.engines, comparison, options);
    if (report.walk.disagreement)
        report.verdict = judge(problem, comparison, *report.walk.disagreement, options.seed);
    return report;
}

VerifyReport report_of(const VerifiedProblem& problem, const OutcomeComparison& comparison) {
    return report_of(problem, comparison, short_walk(problem));
}

void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n--- not in\n" << text;
}

// ------------------------------------------------------------------------------------- agreement

TEST_F(Verify, AgreesAndSaysOverWhat) {
    const VerifiedProblem problem = load();
    const OutcomeComparison comparison(problem.description());
    const VerifyReport report = report_of(problem, comparison);
    const Walk& walk = report.walk;
    ASSERT_TRUE(report.agrees()) << difference_text(report);
    EXPECT_GE(walk.steps, 3000);
    EXPECT_GT(walk.random_states, 1000);
    EXPECT_GT(walk.episodes, 19);
    EXPECT_EQ(walk.counts.faults, walk.steps);
    EXPECT_EQ(walk.counts.rewards, walk.steps) << "nothing faults here";
    EXPECT_EQ(walk.counts.observations, walk.steps);
    EXPECT_EQ(walk.counts.conditions, 3 * walk.steps);
    EXPECT_GE(walk.counts.states, 5 * walk.steps);
    const std::string line = agreement_line(report);
    EXPECT_EQ(std::ranges::count(line, '\n'), 1) << "one line";
    expect_part(line, "d: all agree over ");
    expect_part(line, "plain interpreter, interpreter after all passes");
}

// ------------------------------------------------------------------------------------ wrong pass

struct Plant {
    double from, to;
    Shown what;
    const char* name;  // of what differs
    const char* text;  // the line of the source that is shown
};

class WrongPass : public Verify, public testing::WithParamInterface<Plant> {};

TEST_P(WrongPass, IsFoundAndBlamed) {
    const Plant& plant = GetParam();
    VerifiedProblem problem = load();
    plant_wrong_pass(problem, altered(problem.plain, plant.from, plant.to));
    const OutcomeComparison comparison(problem.description());
    const VerifyReport report = report_of(problem, comparison);
    ASSERT_TRUE(report.walk.disagreement);
    EXPECT_EQ(report.walk.disagreement->engine, 1u);
    EXPECT_EQ(report.walk.disagreement->difference.what, plant.what);
    EXPECT_EQ(report.verdict->pass, "wrong") << "neither the one before nor the one after it";
    const std::string text = difference_text(report);
    expect_part(text, fmt::format("the engines differ in {}", plant.name));
    expect_part(text, plant.text);
    expect_part(text, "^~~");
    expect_part(text, "problem.rddl:");
    expect_part(text, "the pass 'wrong' is to blame");
    expect_part(text, "--without=wrong");
    const auto told = report_json(report);
    EXPECT_EQ(told["agree"], false);
    EXPECT_EQ(told["difference"]["pass"], "wrong");
    EXPECT_TRUE(told["difference"]["from"]["state"].contains("water___t1"));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongPass,
    testing::Values(
        Plant{3.25, 3.2500000001, Shown::State, "water'(", "water'(?t) = water(?t) + INFLOW"},
        Plant{1.125, 1.25, Shown::Observation, "seen", "seen = sum"},
        Plant{7.5, 7.6, Shown::Reward, "the reward", "reward = "},
        Plant{2.625, 2.0, Shown::Precondition, "the preconditions",
              "pump(?t) => water(?t) > 2.625"},
        Plant{11.75, 11.0, Shown::Ending, "the end of the episode", "water(?t) > 11.75"},
        Plant{-20.5, 1.0, Shown::Ending, "the end of the episode", "water(?t) >= -20.5"},
        Plant{0.875, 1.5, Shown::Fault, "the fault", "Bernoulli(0.875)"},
        Plant{0.875, 0.25, Shown::State, "wet'", "wet' = Bernoulli(0.875)"}));

TEST_F(Verify, NamesTheConditionThatEndsTheEpisode) {
    VerifiedProblem problem = load();
    plant_wrong_pass(problem, altered(problem.plain, std::int64_t{7070}, std::int64_t{700000}));
    const OutcomeComparison comparison(problem.description());
    VerifyReport report{problem, comparison, "P", 0, {}, {}, {}};
    WalkOptions options = short_walk(problem);
    Record state(static_cast<std::size_t>(problem.description().state_size));
    const auto message = comparison.state().read(nlohmann::json{{"turns", 7000}}, state.data());
    ASSERT_FALSE(message) << *message;
    options.recorded = {{state, {}}};
    report.walk = walk_in_step(problem.engines, comparison, options);
    ASSERT_TRUE(report.walk.disagreement);
    expect_part(difference_text(report), "turns > 7070;");
}

TEST_F(Verify, BlamesAPassForWhatThePolicyDoes) {
    const std::string policy =
        "policy p { cpfs { pump(?t) = (?t == argmax_{?u : tank} [INFLOW(?u)]) ^ seen > 16.875; }; "
        "}";
    VerifiedProblem problem = load(problem_text + policy);
    plant_wrong_pass(problem, altered(problem.plain, 16.875, 25.0));
    const OutcomeComparison comparison(problem.description());
    WalkOptions options = short_walk(problem);
    options.policy = Policy::Rddl;
    const VerifyReport report = report_of(problem, comparison, options);
    ASSERT_TRUE(report.walk.disagreement);
    EXPECT_EQ(report.walk.disagreement->difference.what, Shown::Action);
    EXPECT_EQ(report.verdict->pass, "wrong");
    const std::string text = difference_text(report);
    expect_part(text, "the engines differ in pump(");
    expect_part(text, "pump(?t) = (?t == argmax_{?u : tank} [INFLOW(?u)]) ^ seen > 16.875;");
}

TEST_F(Verify, TakesTheDefaultActionUnderNoop) {
    VerifiedProblem problem = load();
    const OutcomeComparison comparison(problem.description());
    WalkOptions options = short_walk(problem);
    options.policy = Policy::Noop;
    options.most_samples = 20;
    const VerifyReport report = report_of(problem, comparison, options);
    EXPECT_TRUE(report.agrees());
    ASSERT_FALSE(report.walk.samples.empty());
    const auto* const defaults =
        static_cast<const std::byte*>(problem.description().default_action);
    for (const StepSample& sample : report.walk.samples)
        EXPECT_TRUE(std::ranges::equal(
            sample.start.action,
            std::span(defaults, static_cast<std::size_t>(problem.description().action_size))));
}

TEST_F(Verify, TellsOfAPassThatMakesNoValidProgram) {
    VerifiedProblem problem = load();
    const Pipeline pipeline = [](ir::Program plain, const TellProgram& tell) {
        tell("innocent", plain);
        plain.step.pop_back();  // nothing computes that buffer any more
        plain.reward.value = ir::NodeId{1'000'000};
        tell("wrong", plain);
    };
    problem.invalid = invalid_program(problem.plain, pipeline);
    ASSERT_TRUE(problem.invalid);
    EXPECT_EQ(problem.invalid->pass, "wrong");
    expect_part(invalid_program_text(problem, "P"), "the pass 'wrong' makes a program that is not");
    EXPECT_EQ(invalid_program_json(problem)["pass"], "wrong");
}

// ----------------------------------------------------------------------------------- wrong engine

// A compiled engine that is wrong as long as a pass runs.
class WrongCode : public Verify {
  protected:
    VerifiedProblem load_wrong(const std::string& pass, std::vector<std::string> busy_passes) {
        VerifiedProblem problem = load();
        problem.compile = [&, pass, right = interpreted(problem, problem.plain),
                           wrong = interpreted(problem, altered(problem.plain, 7.5, 7.25))](
                              const LoadOptions& options) {
            ++compilations_;
            return options.passes.without.contains(pass) ? right : wrong;
        };
        problem.engines.push_back({.name = "planted",
                                   .simulator = problem.compile({}),
                                   .compiled = true,
                                   .reference = 1});
        problem.busy_passes = std::move(busy_passes);
        compilations_ = 0;
        return problem;
    }

    int compilations_ = 0;
};

TEST_F(WrongCode, IsFoundWhereTheInterpreterAgrees) {
    const VerifiedProblem problem = load_wrong("culprit", {"late", "culprit", "early"});
    const OutcomeComparison comparison(problem.description());
    const VerifyReport report = report_of(problem, comparison);
    ASSERT_TRUE(report.walk.disagreement);
    EXPECT_EQ(report.walk.disagreement->engine, 2u);
    EXPECT_TRUE(report.verdict->emitted_code);
    EXPECT_FALSE(report.verdict->pass);
    EXPECT_EQ(report.verdict->avoided_by, "culprit");
    EXPECT_EQ(compilations_, 2) << "one without 'late', one without 'culprit'";
    const std::string text = difference_text(report);
    expect_part(text, "the emitted code is to blame");
    expect_part(text, "note: planted: ");
    expect_part(text, "--without=culprit");
    EXPECT_EQ(text.find("--without=late"), std::string::npos);
}

TEST_F(WrongCode, IsToldWhereNoPassAvoidsIt) {
    const VerifiedProblem problem = load_wrong("none of these", {"late", "early"});
    const OutcomeComparison comparison(problem.description());
    const VerifyReport report = report_of(problem, comparison);
    ASSERT_TRUE(report.verdict);
    EXPECT_TRUE(report.verdict->emitted_code);
    EXPECT_FALSE(report.verdict->avoided_by);
    EXPECT_EQ(compilations_, 2);
    expect_part(difference_text(report), "the emitted code is to blame");
    EXPECT_EQ(difference_text(report).find("--without="), std::string::npos);
}

TEST_F(Verify, RepeatsAStepWithItsRandomNumbers) {
    const VerifiedProblem problem = load();
    const OutcomeComparison comparison(problem.description());
    WalkOptions options = short_walk(problem);
    options.most_samples = 10;
    const Walk walk = walk_in_step(problem.engines, comparison, options);
    ASSERT_EQ(walk.samples.size(), 10u);
    for (const StepSample& sample : walk.samples) {
        const auto again =
            repeat_step(problem.engines[1], problem.environments(), sample.start, options.seed);
        ASSERT_TRUE(again);
        EXPECT_EQ(again->state, sample.outcome.state) << "wet' is drawn";
        EXPECT_EQ(interpret_step(problem.plain, {}, sample.start, options.seed).state,
                  sample.outcome.state);
    }
}

// ------------------------------------------------------------------------------------- tolerance

TEST_F(Verify, AcceptsReorderedSumsAloneAndCountsThem) {
    VerifiedProblem problem = load();
    plant_wrong_pass(problem, altered(problem.plain, 7.5, 7.5 * (1 + 1e-12)));
    problem.engines[1].tolerance.of_reals = 1e-9;
    const OutcomeComparison comparison(problem.description());
    const VerifyReport rounded = report_of(problem, comparison);
    EXPECT_TRUE(rounded.agrees());
    EXPECT_GT(rounded.walk.counts.rounded, 1000);
    EXPECT_NEAR(rounded.walk.counts.largest_rounding, 1e-12, 1e-15);
    expect_part(agreement_line(rounded), "reals are not the same bits");

    plant_wrong_pass(problem, altered(problem.plain, 7.5, 7.5 * (1 + 1e-8)));
    EXPECT_FALSE(report_of(problem, comparison).agrees());
}

// A Newton iteration: exp[x] - 2.5 is a few units in the last place of 2.5.
TEST_F(Verify, AcceptsWhatIsLeftOfLargerNumbersThatCancel) {
    const VerifiedProblem problem = load(R"(domain roots {
        pvariables {
            x : { state-fluent, real, default = 0.9162907318741551 };
            small : { state-fluent, real, default = 0.0000000001 };
            none : { action-fluent, bool, default = false };
        };
        cpfs { x' = x - (exp[x] - 2.5) / 2.5; small' = small * 0.5; };
        reward = exp[x] - 2.5;
    }
    non-fluents n { domain = roots; }
    instance i { domain = roots; non-fluents = n; max-nondef-actions = 1; horizon = 5; discount = 1.0; }
    )");
    const OutcomeComparison comparison(problem.description());
    const VerifiedEnvironments fresh(problem.engines.front(), 1, 0, 0);
    const StepStart start{.state = fresh.state(0), .action = Record(comparison.action().size())};
    const ir::ExternalFunctions none;
    const StepOutcome ours = interpret_step(problem.plain, none, start, 0);
    const auto otherwise = interpret_step_otherwise(problem.plain, none, start, 0);
    const auto agrees = [&](const StepOutcome& theirs, std::span<const StepOutcome> others) {
        ValueCounts counts;
        return !comparison.compare(theirs, ours, {1e-9, false}, counts, others);
    };
    StepOutcome theirs = ours;
    theirs.reward += 0x1p-51;  // one unit in the last place of 2.5
    EXPECT_FALSE(agrees(theirs, {}));
    EXPECT_TRUE(agrees(theirs, otherwise));
    theirs.reward = ours.reward + 1e-12;
    EXPECT_FALSE(agrees(theirs, otherwise)) << "more than rounding explains";

    const auto with_small = [&](double factor) {
        StepOutcome changed = ours;
        const RecordEntry& entry = comparison.state().entries()[1];
        double value;
        std::memcpy(&value, changed.state.data() + entry.offset, sizeof value);
        value *= factor;
        std::memcpy(changed.state.data() + entry.offset, &value, sizeof value);
        return changed;
    };
    EXPECT_TRUE(agrees(with_small(1 + 1e-12), otherwise));
    EXPECT_FALSE(agrees(with_small(1 + 1e-8), otherwise)) << "a difference of 5e-19";
}

TEST(Tolerance, KnowsNanAndZeros) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = INFINITY;
    const Tolerance bits{}, rounding{1e-9, false}, fast_math{1e-9, true};
    EXPECT_TRUE(bits.accepts(nan, -nan));
    EXPECT_FALSE(bits.accepts(0.0, -0.0));
    EXPECT_FALSE(bits.accepts(1.0, std::nextafter(1.0, 2.0)));
    EXPECT_TRUE(rounding.accepts(0.0, -0.0));
    EXPECT_TRUE(rounding.accepts(1e300, 1e300 * (1 + 1e-12)));
    EXPECT_FALSE(rounding.accepts(inf, 1e300));
    EXPECT_FALSE(rounding.accepts(1.0, nan));
    EXPECT_TRUE(fast_math.accepts(inf, nan));
    EXPECT_FALSE(fast_math.accepts(1.0, nan));
}

// ---------------------------------------------------------------------------------------- states

TEST_F(Verify, DrawsStatesWithinBoundsAndToThem) {
    const VerifiedProblem problem = load(R"(domain b {
        types { o : { @a, @b, @c }; };
        pvariables {
            x : { state-fluent, real, default = 0.0 }; i : { state-fluent, int, default = 0 };
            at : { state-fluent, o, default = @a }; p : { state-fluent, bool, default = false };
        };
        cpfs { x' = x; i' = i; at' = at; p' = p; };
        reward = 0;
        state-invariants { x >= -2; x <= 3; i >= 1; i <= 4; };
    }
    non-fluents n { domain = b; }
    instance j { domain = b; non-fluents = n; horizon = 5; discount = 1.0; })");
    const OutcomeComparison comparison(problem.description());
    RandomStates states(comparison.state(), 7);
    std::set<std::string> ints, objects, bools;
    double least = 10, most = -10;
    for (int k = 0; k < 2000; ++k) {
        Record state(static_cast<std::size_t>(problem.description().state_size));
        comparison.state().read({{"i", 2}}, state.data());
        states.shake(state);
        std::string text;
        comparison.state().write(text, state.data());
        const auto values = nlohmann::json::parse(text);
        least = std::min(least, values["x"].get<double>());
        most = std::max(most, values["x"].get<double>());
        ints.insert(values["i"].dump());
        objects.insert(values["at"].dump());
        bools.insert(values["p"].dump());
    }
    EXPECT_EQ(least, -2.0);
    EXPECT_EQ(most, 3.0);
    EXPECT_EQ(ints, (std::set<std::string>{"1", "2", "3", "4"}));
    EXPECT_EQ(objects.size(), 3u);
    EXPECT_EQ(bools.size(), 2u);
}

TEST_F(Verify, ReadsRecordedStates) {
    const VerifiedProblem problem = load();
    const OutcomeComparison comparison(problem.description());
    const Record initial(static_cast<std::size_t>(problem.description().state_size));
    const auto path = file("states.jsonl",
                           "{\"rddl_trace\":1}\n\n{\"state\":{\"turns\":5},\"reward\":1.0}\n"
                           "{\"state\":{\"wet\":true},\"action\":{\"pump___t2\":true}}\n");
    const auto states = read_states(path, problem.description(), initial);
    ASSERT_EQ(states.size(), 2u);
    EXPECT_FALSE(states[0].action);
    ASSERT_TRUE(states[1].action);
    std::string text;
    comparison.action().write(text, states[1].action->data());
    EXPECT_EQ(nlohmann::json::parse(text)["pump___t2"], true);

    for (const auto& [line, why] :
         {std::pair{"{\"action\":{}}", "it has no state"},
          {"[1]", "it is not a JSON object"},
          {"{\"state\":{\"turn\":1}}", "no state-fluent is called 'turn'"},
          {"", "there is no state in"}}) {
        try {
            read_states(file("bad.jsonl", line), problem.description(), initial);
            ADD_FAILURE() << line;
        } catch (const Failure& failure) {
            expect_part(failure.what(), why);
        }
    }
}

}  // namespace
}  // namespace rddlc::workbench
