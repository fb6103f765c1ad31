// Parameters that made the data are found again.
#include "fitting/fit.hpp"

#include "formats/trace.hpp"
#include "rollouts/rollouts.hpp"
#include "support/failure.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace rddlc::workbench {
namespace {

namespace fs = std::filesystem;

std::string domain_text(const std::string& noise) {
    return "domain cart {\n"
           "types { wheel : object; };\n"
           "pvariables {\n"
           "GAIN(wheel) : { non-fluent, real, default = 1.0 };\n"
           "DRAG : { non-fluent, real, default = 0.1 };\n"
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
           "reward = -DRAG * TWIN * speed * speed + BIAS / 100000000;\n"
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
    Fit fit_to(const std::vector<std::string>& parameters, int iterations = 100) const {
        const LoadedProblem problem = load_problem(files("guess.rddl"), load_);
        FitOptions options;
        options.parameters = parameters;
        options.iterations = iterations;
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
    EXPECT_FALSE(fit_to({"GAIN", "DRAG"}, 1).has_converged);
    EXPECT_TRUE(fit_to({"GAIN", "DRAG"}).has_converged);
}

TEST_F(FitTest, RefusesWhatCannotBeFitted) {
    record("");
    EXPECT_EQ(failure_of({"UNUSED"}), "no recorded step depends on 'UNUSED'");
    EXPECT_EQ(failure_of({"KIND"}), "'KIND' is a non-fluent of type int: only reals can be fitted");
    EXPECT_EQ(failure_of({"DRAGG"}), "there is no real non-fluent 'DRAGG'; did you mean 'DRAG'?");
    EXPECT_EQ(failure_of({"DRAG", "TWIN"}), "the recorded steps do not tell the parameters apart");
    write("steps.jsonl", "");
    EXPECT_EQ(failure_of({"DRAG"}), "the traces hold no step whose next state they have");
}

}  // namespace
}  // namespace rddlc::workbench
