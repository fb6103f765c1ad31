// Messages of learners about no-op and random, and `rddl train ppo --imitate`.
#include "program.hpp"

namespace rddlc::cli {
namespace {

// A goal behind costs: each of twelve steps costs 1, to the right and to the left in turn, and the
// last one pays 100. A wrong step leads back to the beginning, so that random actions never get
// there, and learners find out that it is best to stay.
constexpr const char* corridor = R"(
domain corridor {
    pvariables {
        place : { state-fluent, int, default = 0 };
        even  : { state-fluent, bool, default = true };
        right : { action-fluent, bool, default = false };
        left  : { action-fluent, bool, default = false };
    };
    cpfs {
        place' = if (place >= 12) then place
                 else if (even ^ right | ~even ^ left) then place + 1
                 else if (left | right) then 0 else place;
        even' = if (even ^ right | ~even ^ left) then ~even else if (left | right) then true else even;
    };
    reward = if (place >= 12) then 0.0
             else (if (place == 11 ^ left) then 100.0 else 0.0) - (if (right | left) then 1.0 else 0.0);
}
non-fluents n { domain = corridor; }
instance corridor_1 { domain = corridor; non-fluents = n; max-nondef-actions = 1; horizon = 14; discount = 1.0; }
)";

constexpr const char* few =
    " --engine interpreter --envs 8 --rollout 32 --minibatch 64 --epochs 1 --hidden 16 ";

class Imitation : public Program {
  protected:
    Imitation() { write_file(folder_ / "p.rddl", corridor); }
};

TEST_F(Imitation, OfTheOptimumReachesGoalsBehindCosts) {
    ASSERT_EQ(run("solve p.rddl --out best.optimum").status, 0);
    const Outcome alone = run(fmt::format("train ppo p.rddl --steps 1024 --out a{}", few));
    EXPECT_EQ(alone.status, 0) << alone.err;
    expect_part(alone.err, "noop 0  random -");
    expect_part(alone.err, "warning: the best policy");
    expect_part(alone.err, "is no better than no-op (0)");

    const std::string command = fmt::format(
        "train ppo p.rddl --steps 512 --imitate best.optimum --imitate-episodes 4{}", few);
    const Outcome shown = run(command + "--out b");
    EXPECT_EQ(shown.status, 0) << shown.err;
    expect_part(shown.err, "whose episodes return 88; the policy that imitates it 88\n");
    expect_part(shown.out, "best return 88 in 14 steps");
    EXPECT_EQ(shown.err.find("warning"), std::string::npos) << shown.err;

    // The same bytes again, on more threads.
    ASSERT_EQ(run(command + "--threads 3 --out c").status, 0);
    EXPECT_EQ(read_file(folder_ / "b" / "policy.json"), read_file(folder_ / "c" / "policy.json"));
    const Outcome other = run(fmt::format("train ppo p.rddl --steps 1024 --resume --out b{}", few));
    EXPECT_EQ(other.status, 0) << "a run that has begun needs no imitation: " << other.err;
}

TEST_F(Imitation, LeavesNothingWhenItIsInterrupted) {
    const Outcome outcome =
        run(fmt::format("train ppo p.rddl --imitate plan:uct,seconds=60 --out a{}", few),
            "timeout --preserve-status -s INT 2");
    EXPECT_EQ(outcome.status, 130);
    expect_part(outcome.err, "interrupted while it was shown what to imitate");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
}

TEST_F(Imitation, IsRefusedWhereItCannotBe) {
    const Outcome recurrent = run(fmt::format(
        "train ppo p.rddl --imitate noop --recurrent 8 --rollout 8 --minibatch 8{}", interpreted));
    EXPECT_EQ(recurrent.status, 2);
    expect_part(recurrent.err, "--imitate goes neither with --recurrent nor with several ranks");
    EXPECT_EQ(run("train ppo p.rddl --imitate plan:none").status, 2);
    EXPECT_EQ(run(fmt::format("train ppo p.rddl --imitate nothing{}", few)).status, 2);
    // The hint names no option that this command lacks.
    const Outcome block = run(fmt::format("train ppo p.rddl --imitate hand.rddl{}", few));
    EXPECT_EQ(block.status, 2);
    expect_part(block.err, "--policy hand.rddl --trace episodes.jsonl");
    EXPECT_EQ(block.err.find("--policy-block"), std::string::npos) << block.err;
}

TEST_F(Imitation, LearnersOfFormulasWarnAsWell) {
    const Outcome cgp = run(fmt::format("train cgp p.rddl --gens 2 --out g{}", interpreted));
    EXPECT_EQ(cgp.status, 0) << cgp.err;
    expect_part(cgp.err, "noop 0  random -");
    expect_part(cgp.err, "is no better than no-op (0). If better is possible, try more --gens");
}

}  // namespace
}  // namespace rddlc::cli
