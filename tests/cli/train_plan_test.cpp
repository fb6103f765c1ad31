// rddl train plan as users run it.
#include "program.hpp"

namespace rddlc::cli {
namespace {

class TrainPlan : public Program {
  protected:
    Outcome plan(const std::string& options, const std::string& environment = "") const {
        return run("train plan domain.rddl instance.rddl" + options + interpreted, environment);
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

// A plan pumps whatever the water is, so that its steps break the precondition in some episodes.
TEST_F(TrainPlan, counts_steps_that_violate_preconditions) {
    write_file(folder_ / "domain.rddl",
               "domain d { pvariables { depth : { state-fluent, real, default = 0.0 };\n"
               "  fill : { action-fluent, real, default = 0.0 }; };\n"
               "  cpfs { depth' = Uniform(0.0, 3.0); }; reward = fill;\n"
               "  action-preconditions { fill >= 0; fill <= 1; fill > 0 => depth <= 2; }; }\n");
    write_file(folder_ / "instance.rddl",
               "non-fluents n { domain = d; }\n"
               "instance i { domain = d; non-fluents = n; horizon = 6; discount = 1.0; }\n");
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

}  // namespace
}  // namespace rddlc::cli
