// `rddl solve` and `compare --optimum`: optima that can be computed by hand.
#include "program.hpp"

namespace rddlc::cli {
namespace {

using nlohmann::json;

// Rungs 0 to 3: see tests/planners/problems/ladder for the values of all rungs. With 4 steps left
// on rung 1 to climb is best: 6/2 + 3.5/2 = 4.75.
constexpr const char* ladder = R"(
domain ladder {
    pvariables {
        rung  : { state-fluent, int, default = 1 };
        done  : { state-fluent, bool, default = false };
        climb : { action-fluent, bool, default = false };
        leap  : { action-fluent, bool, default = false };
    };
    cpfs {
        rung' = if (climb ^ rung < 3) then (if (Bernoulli(0.5)) then rung + 1 else 0)
                else if (leap ^ rung < 3) then (if (Bernoulli(0.25)) then 3 else 0)
                else rung;
        done' = done | (rung == 3);
    };
    reward = if (done) then 0.0 else if (climb | leap) then 0.0 else if (rung == 3) then 8.0 else 1.0 * rung;
    action-preconditions { ~(climb ^ leap); };
}
non-fluents n { domain = ladder; }
instance ladder_1 { domain = ladder; non-fluents = n; horizon = 4; discount = 1.0; }
)";

// Each step that works pays 1, and is the last one with 1/2; one that rests pays 0.1. Discounted by
// 0.9 for ever, work is worth 1 / (1 - 0.45), and rest 0.1 / (1 - 0.9) = 1.
constexpr const char* work = R"(
domain work {
    pvariables {
        broken : { state-fluent, bool, default = false };
        wild   : { action-fluent, bool, default = false };
        rest   : { action-fluent, bool, default = false };
    };
    cpfs { broken' = broken | (~rest ^ Bernoulli(0.5)); };
    // A wild step faults.
    reward = if (wild) then 1.0 / (if (broken) then 1.0 else 0.0) else if (rest) then 0.1 else 1.0;
    termination { broken; };
}
non-fluents n { domain = work; }
instance work_1 { domain = work; non-fluents = n; horizon = 3; discount = 0.9; }
)";

class Solve : public Program {
  protected:
    void use(const std::string& text) const { write_file(folder_ / "p.rddl", text); }
    std::string complaint(const std::string& options) const {
        const Outcome outcome = run("solve p.rddl " + options);
        EXPECT_EQ(outcome.status, 1) << outcome.out;
        return outcome.err;
    }
    static std::string with(std::string text, const std::string& from, const std::string& to) {
        return text.replace(text.find(from), from.size(), to);
    }
};

TEST_F(Solve, AgreesWithValuesByHand) {
    use(ladder);
    const json found = run_json("solve p.rddl --json --out a.optimum --threads 1");
    EXPECT_EQ(found["optimum"], 4.75);
    EXPECT_EQ(found["error"], 0.0);
    EXPECT_EQ(found["states"], 5) << "rungs 0 to 3, and 3 when it is done";
    EXPECT_EQ(found["actions"], 3);
    for (const auto& [horizon, value] : {std::pair(1, 1.0), {2, 2.0}, {3, 3.5}})
        EXPECT_EQ(run_json(fmt::format("solve p.rddl --json --horizon {}", horizon))["optimum"],
                  value);
    run("solve p.rddl --out b.optimum --threads 3");
    EXPECT_EQ(read_file(folder_ / "a.optimum"), read_file(folder_ / "b.optimum"));
}

TEST_F(Solve, WritesAPolicyThatHasTheOptimum) {
    use(ladder);
    ASSERT_EQ(run("solve p.rddl --out a.optimum").status, 0);
    for (const char* optimum : {"a.optimum", "now"}) {
        const json all = run_json(fmt::format(
            "compare p.rddl --policies noop,a.optimum --episodes 4000 --json --engine interpreter "
            "--optimum {}",
            optimum));
        EXPECT_EQ(all["optimum"], 4.75);
        EXPECT_EQ(all["policies"][0]["below_optimum"], 0.75) << "to stay pays 1 in each step";
        const json& best = all["policies"][1];
        EXPECT_NEAR(best["below_optimum"].get<double>(), 0.0,
                    2 * best["return"]["half_width_95"].get<double>());
        EXPECT_EQ(best["illegal_actions"], 0);
    }
    expect_part(
        run("compare p.rddl --policies noop --optimum a.optimum" + std::string(interpreted)).out,
        "below optimum");
    expect_part(
        run("evaluate p.rddl --policy a.optimum --horizon 5" + std::string(interpreted)).err,
        "the solution is of at most 4 steps");
    expect_part(
        run("compare p.rddl --optimum a.optimum --horizon 3" + std::string(interpreted)).err,
        "is of 4 steps, and episodes have 3");
}

TEST_F(Solve, WithoutAHorizonByTheDiscount) {
    use(work);
    const json found = run_json("solve p.rddl --json --horizon 0 --out a.optimum");
    EXPECT_NEAR(found["optimum"].get<double>(), 1 / 0.55, 1e-9);
    EXPECT_GT(found["error"].get<double>(), 0.0);
    EXPECT_LT(found["error"].get<double>(), 1e-9);
    // Within 3 steps: 1 + 0.45 * (1 + 0.45).
    EXPECT_NEAR(run_json("solve p.rddl --json")["optimum"].get<double>(), 1.6525, 1e-12);
    use(with(work, "discount = 0.9", "discount = 1.0"));
    expect_part(complaint("--horizon 0"), "no horizon, and a discount of 1");
}

TEST_F(Solve, ARandomStartIsPartOfTheValue) {
    use(with(work, "non-fluents = n;",
             "non-fluents = n; init-state { broken = Bernoulli(0.25); };"));
    // An episode that starts broken is over at once.
    EXPECT_NEAR(run_json("solve p.rddl --std=rddlc --json")["optimum"].get<double>(), 0.75 * 1.6525,
                1e-12);
}

TEST_F(Solve, RandomRewardsCountAsTheirMeans) {
    use(with(ladder, "1.0 * rung;", "1.0 * rung * (if (Bernoulli(0.5)) then 2.0 else 0.0);"));
    EXPECT_EQ(run_json("solve p.rddl --json")["optimum"], 4.75);
}

TEST_F(Solve, RefusesInASentence) {
    write_file(folder_ / "p.rddl", std::string(tanks_domain) + tanks_instance);
    expect_part(complaint(""), "tanks_1 (tanks) is not discrete: 'extra' is any number");
    use(ladder);
    expect_part(complaint("--max-states 3"), "more than 3 states can be reached");
    expect_part(complaint("--max-actions 2"), "has more than 2 joint actions");
    expect_part(complaint("--memory-limit 50"), "one step may lead to takes more bytes than it");
    expect_part(complaint("--memory-limit 500"), "reached so far, with 5 transitions, take more");
    use(with(ladder, "Bernoulli(0.25)", "Uniform(0.0, 1.0) < 0.25"));
    expect_part(complaint(""), "the outcomes of Uniform are not listed one by one");
    use(with(work, "{ broken; }", "{ broken ^ Bernoulli(0.5); }"));
    expect_part(complaint(""), "a termination, an invariant or a precondition draws at random");
    use(with(work, "termination {", "action-preconditions { wild; }; termination {"));
    expect_part(complaint(""), "each action may lead to a fault");
    use(ladder);
    EXPECT_EQ(run("solve p.rddl --out a.txt").status, 2);
}

TEST_F(Solve, RefusesFilesThatAreDamagedOrOfOthers) {
    use(ladder);
    ASSERT_EQ(run("solve p.rddl --out a.optimum").status, 0);
    std::string bytes = read_file(folder_ / "a.optimum");
    const auto complaint_about = [&](const std::string& file) {
        write_file(folder_ / "b.optimum", file);
        const Outcome outcome =
            run("evaluate p.rddl --policy b.optimum" + std::string(interpreted));
        EXPECT_EQ(outcome.status, 1);
        return outcome.err;
    };
    for (std::size_t size = 0; size < bytes.size(); size += 37)
        expect_part(complaint_about(bytes.substr(0, size)), "cannot act by 'b.optimum'");
    bytes[bytes.size() / 2] ^= 1;
    expect_part(complaint_about(bytes), "it is damaged");
    bytes[bytes.size() / 2] ^= 1;
    use(with(ladder, "0.25", "0.3"));
    expect_part(complaint_about(bytes), "cannot act by 'b.optimum'");
}

}  // namespace
}  // namespace rddlc::cli
