// rddl train plan as users run it.
#include "program.hpp"

#include <sstream>
#include <string>

namespace rddlc::cli {
namespace {

using nlohmann::json;

class TrainPlan : public Program {
  protected:
    Outcome plan(const std::string& options, const std::string& environment = "") const {
        return run("train plan domain.rddl instance.rddl" + options + interpreted, environment);
    }
    // A domain d, and an instance of six steps.
    void write_problem(const std::string& domain) const {
        write_file(folder_ / "domain.rddl", domain);
        write_file(folder_ / "instance.rddl",
                   "non-fluents n { domain = d; }\n"
                   "instance i { domain = d; non-fluents = n; horizon = 6; discount = 1.0; }\n");
    }
    bool has_plan() const { return std::filesystem::exists(folder_ / "plan.jsonl"); }
};

TEST_F(TrainPlan, refuses_a_name_that_no_policy_has) {
    const Outcome outcome = plan(" --out plan.txt --seconds 100");
    EXPECT_EQ(outcome.status, 2);
    expect_part(outcome.err, "the name of a plan ends with .jsonl, and 'plan.txt' does not");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plan.txt"));
}

TEST_F(TrainPlan, notes_that_no_time_finds_the_default_actions) {
    const Outcome outcome = plan(" --out plan.jsonl --seconds 0 --episodes 3");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_part(outcome.err, "each action of the plan is the default");
}

TEST_F(TrainPlan, RefusesAnEpisodeThatIsOverAtOnce) {
    write_problem(
        "domain d { pvariables { depth : { state-fluent, real, default = 0.0 };\n"
        "  fill : { action-fluent, real, default = 0.0 }; };\n"
        "  cpfs { depth' = depth + fill; }; reward = depth; termination { depth == 0; }; }\n");
    const Outcome outcome = plan(" --out plan.jsonl --iterations 2");
    EXPECT_EQ(outcome.status, 1);
    expect_part(outcome.err, "the episode is over before its first action");
    EXPECT_FALSE(has_plan());
}

// Adam squares them.
TEST_F(TrainPlan, LeavesOutDerivativesWhoseSquaresAreInfinite) {
    write_problem(
        "domain d { pvariables { depth : { state-fluent, real, default = 0.0 };\n"
        "  fill : { action-fluent, real, default = 0.0 }; };\n"
        "  cpfs { depth' = depth + fill; }; reward = 1e160 * depth;\n"
        "  action-preconditions { fill >= 0; fill <= 1; }; }\n");
    const Outcome outcome = plan(" --out plan.jsonl --iterations 5 --std=rddlc");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_part(outcome.out, "plan.jsonl");
    EXPECT_EQ(read_file(folder_ / "plan.jsonl").find("nan"), std::string::npos);
}

// A plan pumps whatever the water is, so that its steps break the precondition in some episodes.
TEST_F(TrainPlan, counts_steps_that_violate_preconditions) {
    write_problem(
        "domain d { pvariables { depth : { state-fluent, real, default = 0.0 };\n"
        "  fill : { action-fluent, real, default = 0.0 }; };\n"
        "  cpfs { depth' = Uniform(0.0, 3.0); }; reward = fill;\n"
        "  action-preconditions { fill >= 0; fill <= 1; fill > 0 => depth <= 2; }; }\n");
    const Outcome outcome = plan(" --out plan.jsonl --iterations 30 --episodes 50");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_part(outcome.err, "steps of 'plan.jsonl' violate preconditions");
}

TEST_F(TrainPlan, keeps_the_plan_after_an_interrupt) {
    const std::string start = command(
        "train plan domain.rddl instance.rddl --out plan.jsonl "
        "--seconds 100 --engine interpreter");
    const std::string here =
        fmt::format("cd '{}' && timeout --preserve-status -s INT 2 {} >/dev/null 2>'{}'",
                    folder_.string(), start.substr(start.find("env ")), stderr_file());
    const int status = std::system(here.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 130);
    expect_part(read_file(stderr_file()), "interrupted; 'plan.jsonl' is the best plan so far, of ");
    ASSERT_TRUE(has_plan());
    const Outcome played =
        run("evaluate domain.rddl instance.rddl --policy plan.jsonl --episodes 2" +
            std::string(interpreted));
    EXPECT_EQ(played.status, 0) << played.err;
}

// The first gradient of so many steps and plans takes far longer than two seconds.
TEST_F(TrainPlan, WritesNothingAfterAnInterruptBeforeTheFirstGradient) {
    write_file(folder_ / "p.rddl",
               "domain d { types { cell : { @a, @b, @c, @d, @e, @f, @g, @h, @i, @j }; };\n"
               "  pvariables { at(cell) : { state-fluent, real, default = 0.0 };\n"
               "  move(cell) : { action-fluent, real, default = 0.0 }; };\n"
               "  cpfs { at'(?c) = move(?c) + (sum_{?d : cell, ?e : cell} cos[at(?c) * at(?d) + "
               "at(?e)]) / 99.0; };\n"
               "  reward = -(sum_{?c : cell} at(?c) * at(?c));\n"
               "  action-preconditions { forall_{?c : cell} [move(?c) >= -1 ^ move(?c) <= 1]; }; "
               "}\n"
               "non-fluents n { domain = d; }\n"
               "instance i { domain = d; non-fluents = n; horizon = 2; discount = 1.0; }\n");
    const Outcome outcome =
        run("train plan p.rddl --out plan.jsonl --iterations 1000 --horizon 100000" +
                std::string(interpreted),
            "timeout --preserve-status -s INT 2");
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.out, "");
    expect_part(outcome.err,
                "rddl: error: interrupted while computing the first gradient: there is no plan "
                "yet\n");
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
        EXPECT_EQ(entry.path().string().find("plan.jsonl"), std::string::npos) << entry;
}

TEST_F(TrainPlan, SaysThatThePlanIsThereAfterAnInterruptOfItsEvaluation) {
    const Outcome outcome =
        run("train plan domain.rddl instance.rddl --out plan.jsonl --iterations 1 "
            "--episodes 1000000" +
                std::string(interpreted),
            "timeout --preserve-status -s INT 3");
    EXPECT_EQ(outcome.status, 130);
    expect_part(outcome.out, "mean returns of 1000000 episodes:");
    expect_part(outcome.err, "interrupted before all was evaluated; 'plan.jsonl' holds the plan\n");
    EXPECT_TRUE(has_plan());
}

// Each step earns -0.6^2 until the number is moved, in as many steps as --horizon says.
TEST_F(TrainPlan, PlansTheStepsThatHorizonSays) {
    write_file(folder_ / "p.rddl",
               "domain d { pvariables { at : { state-fluent, real, default = 0.0 };\n"
               "  move : { action-fluent, real, default = 0.0 }; };\n"
               "  cpfs { at' = at + move; }; reward = -(at + move - 0.6) * (at + move - 0.6);\n"
               "  action-preconditions { move >= -1; move <= 1; }; }\n"
               "non-fluents n { domain = d; }\n"
               "instance i { domain = d; non-fluents = n; horizon = 2; discount = 1.0; }\n");
    const Outcome plan = run("train plan p.rddl --out plan.jsonl --iterations 100 --horizon 5" +
                             std::string(interpreted));
    ASSERT_EQ(plan.status, 0) << plan.err;
    std::istringstream out(plan.out);
    std::string line, noop, file;
    double of_noop = 0, of_plan = 0;
    std::getline(out, line);
    ASSERT_TRUE(out >> noop >> of_noop >> file >> of_plan) << plan.out;
    EXPECT_EQ(noop, "noop");
    EXPECT_NEAR(of_noop, -5 * 0.36, 1e-5);
    EXPECT_EQ(file, "plan.jsonl");
    EXPECT_GT(of_plan, -0.05);
    EXPECT_LE(of_plan, 0);
    const std::string played = read_file(folder_ / "plan.jsonl");
    std::istringstream trace(played);
    int steps = 0;
    while (std::getline(trace, line)) steps += json::parse(line).contains("action") ? 1 : 0;
    EXPECT_EQ(steps, 5) << played;
}

// Where one of three reals may differ from its default, a plan moves one in each step. The others
// are 0.1 to the last bit, which no float is.
TEST_F(TrainPlan, KeepsToTheNumberOfChanges) {
    write_file(
        folder_ / "p.rddl",
        "domain d { types { wheel : object; };\n"
        "  pvariables { at(wheel) : { state-fluent, real, default = 0.0 };\n"
        "    move(wheel) : { action-fluent, real, default = 0.1 }; };\n"
        "  cpfs { at'(?w) = at(?w) + move(?w); };\n"
        "  reward = -(sum_{?w : wheel} [(at(?w) - 1) * (at(?w) - 1)]);\n"
        "  action-preconditions { forall_{?w : wheel} [move(?w) >= -1 ^ move(?w) <= 1]; }; }\n"
        "non-fluents n { domain = d; objects { wheel : { w1, w2, w3 }; }; }\n"
        "instance i { domain = d; non-fluents = n; max-nondef-actions = 1; horizon = 4;\n"
        "  discount = 1.0; }\n");
    const Outcome plan =
        run("train plan p.rddl --out plan.jsonl --iterations 50" + std::string(interpreted));
    EXPECT_EQ(plan.status, 0) << plan.out << plan.err;
    std::istringstream trace(read_file(folder_ / "plan.jsonl"));
    int steps = 0, moves = 0;
    for (std::string line; std::getline(trace, line);) {
        const json step = json::parse(line);
        if (!step.contains("action")) continue;
        ++steps;
        EXPECT_LE(step["action"].size(), 1u) << line;
        moves += static_cast<int>(step["action"].size());
    }
    EXPECT_EQ(steps, 4);
    EXPECT_GT(moves, 0);
}

}  // namespace
}  // namespace rddlc::cli
