// Parameters that made the data are found again.
#include "fitting/fit.hpp"

#include "formats/trace.hpp"
#include "rollouts/rollouts.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>

namespace rddlc::workbench {
namespace {

namespace fs = std::filesystem;

std::string domain_text(const std::string& noise) {
    return "domain cart {\n"
           "types { wheel : object; };\n"
           "pvariables {\n"
           "GAIN(wheel) : { non-fluent, real, default = 1.0 };\n"
           "DRAG : { non-fluent, real, default = 0.1 };\n"
           "PRICE : { non-fluent, real, default = 0.3 };\n"
           "CHANCE : { non-fluent, real, default = 0.5 };\n"
           "UNUSED : { non-fluent, real, default = 2.0 };\n"
           "TWIN : { non-fluent, real, default = 1.0 };\n"
           "BIAS : { non-fluent, real, default = 300000000.0 };\n"
           "KIND : { non-fluent, int, default = 2 };\n"
           "speed : { state-fluent, real, default = 0.0 };\n"
           "push(wheel) : { action-fluent, real, default = 0.0 };\n"
           "};\n"
           "cpfs { speed' = speed * exp[-DRAG * TWIN * abs[speed]] + (sum_{?w : wheel} [GAIN(?w) * "
           "push(?w)])" +
           noise +
           "; };\n"
           "reward = -DRAG * TWIN * speed * speed - PRICE * abs[speed] + BIAS / 100000000;\n"
           "action-preconditions { forall_{?w : wheel} [push(?w) >= -1 ^ push(?w) <= 1]; };\n"
           "}\n";
}

std::string instance_text(const std::string& values) {
    return "non-fluents n { domain = cart; objects { wheel : {w1, w2}; }; non-fluents { " + values +
           " }; }\n"
           "instance i { domain = cart; non-fluents = n; max-nondef-actions = pos-inf;\n"
           " horizon = 40; discount = 1.0; }\n";
}

class FitTest : public ::testing::Test {
  protected:
    FitTest() {
        static int number = 0;
        folder_ = fs::temp_directory_path() /
                  ("rddlc_fit_" + std::to_string(getpid()) + "_" + std::to_string(number++));
        fs::create_directories(folder_);
        load_.engine = Engine::Interpreter;
    }
    ~FitTest() override { fs::remove_all(folder_); }

    ProblemFiles files(const std::string& instance) const {
        ProblemFiles found;
        found.name = "cart";
        found.domain = folder_ / "domain.rddl";
        found.instance = folder_ / instance;
        return found;
    }
    void write(const std::string& file, const std::string& text) const {
        std::ofstream(folder_ / file) << text;
    }
    // Records random actions in the instance "true.rddl".
    void record(const std::string& noise) {
        write("domain.rddl", domain_text(noise));
        write("true.rddl", instance_text("GAIN(w1) = 0.75; GAIN(w2) = 1.5; DRAG = 0.2;"));
        write("guess.rddl", instance_text("DRAG = 0.05;"));
        const LoadedProblem problem = load_problem(files("true.rddl"), load_);
        std::ofstream trace(folder_ / "steps.jsonl");
        TraceHeader header;
        header.horizon = 40;
        trace << trace_header_line(header, *problem.simulator->problem);
        RolloutOptions options;
        options.episodes = 3;
        run_episodes(
            *problem.simulator, options, [&](const std::string& lines) { trace << lines; }, false);
    }
    Fit fit_to(const std::vector<std::string>& parameters, FitOptions options = {}) const {
        const LoadedProblem problem = load_problem(files("guess.rddl"), load_);
        options.parameters = parameters;
        options.traces = {folder_ / "steps.jsonl"};
        return fit(problem.files, load_, *problem.simulator, options);
    }
    std::string failure_of(const std::vector<std::string>& parameters) const {
        try {
            fit_to(parameters);
        } catch (const Failure& failure) {
            return failure.what();
        }
        return "nothing";
    }

    // Lines of the trace without the header.
    std::vector<nlohmann::json> lines() const {
        std::ifstream trace(folder_ / "steps.jsonl");
        std::vector<nlohmann::json> found;
        for (std::string line; std::getline(trace, line);)
            if (nlohmann::json each = nlohmann::json::parse(line); !each.contains("rddl_trace"))
                found.push_back(std::move(each));
        return found;
    }
    void write_lines(const std::vector<nlohmann::json>& all) const {
        std::string text;
        for (const nlohmann::json& line : all) text += line.dump() + "\n";
        write("steps.jsonl", text);
    }
    // The failure, without the name of the file, once `change` was made to line 3.
    std::string failure_with(const std::function<void(nlohmann::json&)>& change) const {
        std::vector<nlohmann::json> all = lines();
        const std::vector<nlohmann::json> before = all;
        change(all[2]);
        write_lines(all);
        const std::string failure = failure_of({"GAIN"});
        write_lines(before);
        const std::size_t end = failure.find("steps.jsonl', ");
        return end == std::string::npos ? failure : failure.substr(end + 14);
    }

    fs::path folder_;
    LoadOptions load_;
};

TEST_F(FitTest, FindsWhatMadeTheData) {
    record("");
    const Fit found = fit_to({"GAIN", "DRAG"});
    ASSERT_EQ(found.parameters.size(), 3u);
    EXPECT_EQ(found.steps, 120);
    const std::map<std::string, double> expected = {
        {"GAIN___w1", 0.75}, {"GAIN___w2", 1.5}, {"DRAG", 0.2}};
    for (const FittedParameter& each : found.parameters)
        EXPECT_NEAR(each.value, expected.at(each.name), 1e-8) << each.name;
    EXPECT_LT(found.error_after, 1e-9);
    EXPECT_GT(found.error_before, 1e-2);
}

TEST_F(FitTest, SaysHowSureItIs) {
    record(" + Normal(0, 0.01)");
    for (const FittedParameter& each : fit_to({"GAIN"}).parameters) {
        const double truth = each.name == "GAIN___w1" ? 0.75 : 1.5;
        EXPECT_GT(each.error, 0.001);
        EXPECT_LT(each.error, 0.2);
        EXPECT_LT(std::abs(each.value - truth), 5 * each.error) << each.name;
    }
}

TEST_F(FitTest, UnitsDoNotMatter) {
    record(" + Normal(0, 0.01)");
    write("guess.rddl", instance_text("BIAS = 100000000.0;"));
    const Fit found = fit_to({"GAIN", "BIAS", "DRAG"});
    ASSERT_EQ(found.parameters.size(), 4u);
    EXPECT_TRUE(found.has_converged);
    for (const FittedParameter& each : found.parameters) {
        const double truth = each.name == "BIAS" ? 3e8 : each.name == "DRAG" ? 0.2 : 0.75;
        if (each.name == "GAIN___w2") continue;
        EXPECT_NEAR(each.value, truth, 0.05 * truth) << each.name;
        EXPECT_GT(each.error, 0) << each.name;
        EXPECT_LT(each.error, 0.05 * truth) << each.name;
    }
}

TEST_F(FitTest, SaysThatIterationsEndedTheSearch) {
    record("");
    FitOptions once;
    once.iterations = 1;
    EXPECT_FALSE(fit_to({"GAIN", "DRAG"}, once).has_converged);
    EXPECT_TRUE(fit_to({"GAIN", "DRAG"}).has_converged);
}

TEST_F(FitTest, RefusesWhatCannotBeFitted) {
    record("");
    EXPECT_EQ(failure_of({"UNUSED"}), "no recorded step depends on 'UNUSED'");
    EXPECT_EQ(failure_of({"KIND"}), "'KIND' is a non-fluent of type int: only reals can be fitted");
    EXPECT_EQ(failure_of({"DRAGG"}), "there is no real non-fluent 'DRAGG'; did you mean 'DRAG'?");
    EXPECT_EQ(failure_of({"DRAG", "TWIN"}), "the recorded steps do not tell the parameters apart");
    write("steps.jsonl", "");
    EXPECT_EQ(failure_of({"DRAG"}), "the traces hold no step");
}

TEST_F(FitTest, TakesEachLineByItself) {
    record("");
    std::vector<nlohmann::json> all = lines(), some;
    std::shuffle(all.begin(), all.end(), std::minstd_rand(1));
    for (std::size_t i = 0; i < all.size(); i += 2) {
        all[i].erase("episode");
        all[i].erase("step");
        some.push_back(all[i]);
    }
    write_lines(some);
    const Fit found = fit_to({"GAIN", "DRAG"});
    EXPECT_EQ(found.steps, 60);
    EXPECT_NEAR(found.parameters[0].value, 0.75, 1e-8);
    EXPECT_NEAR(found.parameters[1].value, 1.5, 1e-8);
    EXPECT_NEAR(found.parameters[2].value, 0.2, 1e-8);
}

TEST_F(FitTest, LeavesOutRewardsThatAreMissing) {
    record("");
    std::vector<nlohmann::json> all = lines();
    for (std::size_t i = 0; i < all.size(); i += 3) all[i].erase("reward");
    write_lines(all);
    EXPECT_NEAR(fit_to({"DRAG", "GAIN"}).parameters[0].value, 0.75, 1e-8);
    EXPECT_EQ(failure_of({"PRICE"}), "nothing");
    for (nlohmann::json& line : all) line.erase("reward");
    write_lines(all);
    EXPECT_EQ(failure_of({"DRAG", "GAIN"}), "nothing");
    EXPECT_EQ(failure_of({"PRICE"}), "only rewards depend on 'PRICE', and the traces have none");
}

TEST_F(FitTest, RefusesLinesThatAreNoTransitions) {
    record("");
    const auto without = [&](const char* member) {
        return failure_with([&](nlohmann::json& line) { line.erase(member); });
    };
    const auto with = [&](const char* member, const char* name, const nlohmann::json& value) {
        return failure_with([&](nlohmann::json& line) { line[member][name] = value; });
    };
    EXPECT_EQ(without("state"), "line 3: the line has no 'state'");
    EXPECT_EQ(without("action"), "line 3: the line has no 'action'");
    EXPECT_EQ(without("next_state"), "line 3: the line has no 'next_state'");
    EXPECT_EQ(failure_with([](nlohmann::json& line) { line["state"].erase("speed"); }),
              "line 3: 'state' has no value of 'speed'");
    EXPECT_EQ(with("state", "speed", "nan"),
              "line 3: 'state': 'speed' is nan, and a fit takes finite values only");
    EXPECT_EQ(with("next_state", "speed", "inf"),
              "line 3: 'next_state': 'speed' is inf, and a fit takes finite values only");
    EXPECT_EQ(with("action", "push___w1", 1.5),
              "line 3: 'action': 'push___w1' is 1.5, outside of its bounds -1 and 1");
    EXPECT_EQ(failure_with([](nlohmann::json& line) { line["reward"] = "nan"; }),
              "line 3: 'reward' is nan, and a fit takes finite values only");
}

TEST_F(FitTest, SaysWhereDerivativesAreZero) {
    record(" + (if (Bernoulli(CHANCE)) then 0.1 else 0.0)");
    EXPECT_EQ(
        failure_of({"CHANCE"}),
        "derivatives by 'CHANCE' are 0: it acts only through comparisons, roundings, or draws "
        "of bools and ints");
}

TEST_F(FitTest, EndsInTheMiddleOfAnIteration) {
    record("");
    int asked = 0;
    FitOptions options;
    options.stops = [&] {
        return ++asked > 200;
    };  // after 120 steps of the first evaluation
    const Fit found = fit_to({"GAIN"}, options);
    EXPECT_TRUE(found.interrupted);
    EXPECT_LT(asked, 210);
    EXPECT_EQ(found.iterations, 0);
}

TEST_F(FitTest, DrawsBySeed) {
    record(" + Normal(0, 0.01)");
    FitOptions other;
    other.seed = 7;
    const double value = fit_to({"GAIN"}).parameters[0].value;
    EXPECT_EQ(value, fit_to({"GAIN"}).parameters[0].value);
    EXPECT_NE(value, fit_to({"GAIN"}, other).parameters[0].value);
}

}  // namespace
}  // namespace rddlc::workbench
