// Policy blocks as users run them.
#include "program.hpp"

namespace rddlc::cli {
namespace {

using nlohmann::json;

// It fills the emptiest tank, draws the power, and rests a tank that it has just filled.
constexpr const char* fill_up = R"(
policy fill_up {
    pvariables {
        FULL : { param-fluent, real, default = 8.0 };
        PATIENCE : { param-fluent, real, default = 0.75 };
        least : { derived-fluent, real };
        rests(tank) : { state-fluent, bool, default = false };
    };
    cpfs {
        least = min_{?t : tank} [water(?t)];
        pump(?t) = [?t == argmin_{?u : tank} [water(?u)]] ^ water(?t) < FULL ^ ~rests(?t);
        power = if (Bernoulli(PATIENCE)) then @low else @high;
        rests'(?t) = pump(?t) ^ least > 3.0;
    };
}
)";

class PolicyProgram : public Program {
  protected:
    PolicyProgram() { write_policy("0.0"); }

    static std::string with_extra(const std::string& extra) {
        std::string text = fill_up;
        return text.insert(text.find("        rests'("), "        extra = " + extra + ";\n");
    }
    void write_policy(const std::string& extra) const {
        write_file(folder_ / "policy.rddl", with_extra(extra));
    }
    static std::string on_tanks(const std::string& command, const std::string& options) {
        return command + " domain.rddl instance.rddl " + options;
    }
};

TEST_F(PolicyProgram, RunsFromAFile) {
    const std::string run_it = on_tanks("run", "--policy policy.rddl --episodes 40 --json");
    const json summary = without_speed(run_json(run_it));
    EXPECT_EQ(summary["policy"], "rddl");
    EXPECT_EQ(summary["faulted"], 0) << summary["first_fault"];
    for (const char* other : {" --threads 1 --batch 1", " --threads 3 --batch 7", interpreted})
        EXPECT_EQ(without_speed(run_json(run_it + other)), summary) << other;
    EXPECT_NE(without_speed(run_json(run_it + " --seed 4" + interpreted)), summary);
}

TEST_F(PolicyProgram, EvaluatesFilesSideBySide) {
    const std::string settings = " --episodes 40 --json" + std::string(interpreted);
    const json ran = run_json(on_tanks("run", "--policy policy.rddl" + settings));
    const json evaluated = run_json(on_tanks("evaluate", "--policy policy.rddl" + settings));
    EXPECT_EQ(evaluated["policies"][0]["return"]["mean"], ran["return"]["mean"]);
    EXPECT_EQ(evaluated["policies"][0]["policy"], "policy.rddl");

    write_file(folder_ / "lazy.rddl",
               "policy lazy { cpfs { pump(?t) = false; power = @low; "
               "extra = 0.0; }; }");
    const json compared =
        run_json(on_tanks("compare", "--policies noop,lazy.rddl,policy.rddl" + settings));
    const json& policies = compared["policies"];
    EXPECT_EQ(policies[1]["return"], policies[0]["return"]) << "it does nothing";
    EXPECT_EQ(policies[2]["return"], evaluated["policies"][0]["return"]);

    write_file(folder_ / "greedy.rddl",
               "policy greedy { cpfs { pump(?t) = true; power = @high; "
               "extra = 0.0; }; }");
    const Outcome greedy = run(on_tanks("compare", "--policies noop,greedy.rddl" + settings));
    expect_part(greedy.err, "faults ended 40 of 40 episodes of 'greedy.rddl'");
    expect_part(greedy.err, "  the first fault: episode 0, step 0: ");

    write_file(folder_ / "wrong.rddl", "policy wrong { cpfs { pumps(?t) = true; }; }");
    const Outcome refused = run(on_tanks("compare", "--policies noop,wrong.rddl" + settings));
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("wrong.rddl:1:"), std::string::npos) << refused.err;
}

TEST_F(PolicyProgram, ShowsTheWarningsOfItsFile) {
    write_file(folder_ / "two.rddl",
               "policy first { cpfs { pump(?t) = true; power = @low; extra = 0.0; }; }\n"
               "policy second { domain = others; cpfs { pump(?t) = false; power = @low; extra = "
               "0.0; }; }");
    for (const char* command : {"run", "evaluate"}) {
        const Outcome outcome =
            run(on_tanks(command, "--policy two.rddl --episodes 2") + interpreted);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        expect_part(outcome.err, "two.rddl:1:1: warning: this 'policy' is ignored: a later one");
        expect_part(outcome.err, "two.rddl:2:26: warning: this is for domain 'others', but");
    }
    // The domain's own warnings are those of `rddl check`, also if the policy has none.
    write_file(folder_ / "instance.rddl", tanks_instance + with_extra("0.0") + with_extra("0.0"));
    EXPECT_EQ(run(on_tanks("run", "--policy policy.rddl --episodes 2") + interpreted).err, "");
}

// The part of a trace about the steps.
std::string steps_of(const std::string& trace) {
    return trace.substr(trace.find('\n'));
}

TEST_F(PolicyProgram, TracesAreTheSameWithBothEngines) {
    const std::string run_it =
        on_tanks("run", "--policy=policy.rddl --episodes 9 --quiet --trace -");
    const Outcome compiled = run(run_it);
    EXPECT_EQ(compiled.status, 0) << compiled.err;
    EXPECT_NE(compiled.out.find("\"power\":\"high\""), std::string::npos) << "some draws";
    for (const char* other : {" --threads 1 --batch 1", " --threads 4 --batch 2"})
        EXPECT_EQ(steps_of(run(run_it + other + interpreted).out), steps_of(compiled.out));

    // A trace is replayed without the policy.
    write_file(folder_ / "trace.jsonl", compiled.out);
    const Outcome replayed = run(on_tanks("replay", "--input trace.jsonl") + interpreted);
    EXPECT_EQ(replayed.status, 0) << replayed.err;
    EXPECT_EQ(replayed.out.find("error"), std::string::npos) << replayed.out;
}

TEST_F(PolicyProgram, RunsTheBlockOfTheProblem) {
    const std::string run_it =
        on_tanks("run", "--episodes 5 --json --engine interpreter --policy ");
    const json from_file = without_speed(run_json(run_it + "policy.rddl"));
    write_file(folder_ / "instance.rddl", tanks_instance + with_extra("0.0"));
    EXPECT_EQ(without_speed(run_json(run_it + "rddl")), from_file);
    // The last block counts, which is that of the file.
    write_policy("-1.0");
    const json other = run_json(run_it + "policy.rddl", 1);
    EXPECT_EQ(other["faulted"], 5) << "more than max-nondef-actions";
    EXPECT_NE(without_speed(other), from_file);
    EXPECT_EQ(without_speed(run_json(run_it + "rddl")), from_file);
}

TEST_F(PolicyProgram, TakesNothingButThePolicyFromItsFile) {
    const std::string policy =
        "policy p { cpfs { pump(?t) = water(?t) < 3.0; power = @low; extra = 0.0; }; }\n";
    write_file(folder_ / "policy.rddl", policy);
    std::string other = tanks_domain;  // in which pumps are stronger
    other.replace(other.find("then 2.0"), 8, "then 9.0");
    write_file(folder_ / "other.rddl", other + tanks_instance + policy);
    const std::string run_it =
        on_tanks("run", "--engine interpreter --episodes 20 --json --policy ");
    EXPECT_EQ(without_speed(run_json(run_it + "other.rddl")),
              without_speed(run_json(run_it + "policy.rddl")));
}

// A planner improves the block that the problem is loaded with; no file of a block is read for it.
TEST_F(PolicyProgram, OfAPlannerIsTheBlockOfTheProblem) {
    const std::string planner = "plan:rollout,iterations=1,policy=";
    for (const auto& [name, option] :
         {std::pair{"run", "--policy "}, {"evaluate", "--policy "}, {"compare", "--policies "}}) {
        const Outcome outcome =
            run(on_tanks(name, "--episodes 1 --engine interpreter " + (option + planner)) +
                "policy.rddl");
        EXPECT_EQ(outcome.status, 2) << name;
        expect_part(outcome.err, "'policy.rddl' holds a policy block");
        expect_part(outcome.err, "write the block into one of the problem's files");
    }
    const Outcome works = run(on_tanks("evaluate", "--episodes 1 --engine interpreter") +
                              " --policy-block policy.rddl --policy " + planner + "rddl");
    EXPECT_EQ(works.status, 0) << works.err;
}

TEST_F(PolicyProgram, SaysWhatIsMissing) {
    const std::string run_it = on_tanks("run", "--engine interpreter --policy ");
    const Outcome none = run(run_it + "rddl");
    EXPECT_EQ(none.status, 1);
    EXPECT_EQ(none.err,
              "rddl: error: there is no policy block in the files of the problem\n"
              "  name the file that has it: --policy=FILE.rddl\n");
    const Outcome wrong = run(run_it + "domain.rddl");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("there is no policy block in 'domain.rddl'"), std::string::npos);
    const Outcome missing = run(run_it + "nowhere.rddl");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.err.find("cannot read 'nowhere.rddl'"), std::string::npos) << missing.err;
    const Outcome unknown = run(run_it + "greedy");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("'greedy' is neither random, noop, rddl nor a file"),
              std::string::npos)
        << unknown.err;
    EXPECT_NE(run(run_it + "randm").err.find("; did you mean 'random'?"), std::string::npos);
}

TEST_F(PolicyProgram, SaysWhatIsWrong) {
    write_file(folder_ / "policy.rddl", fill_up);
    const Outcome outcome = run(on_tanks("run", "--policy policy.rddl") + interpreted);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("policy.rddl:2:8: error: action-fluent 'extra' has no CPF"),
              std::string::npos)
        << outcome.err;
}

TEST_F(PolicyProgram, TellsFaults) {
    write_policy("if (least < 3.0 ^ Bernoulli(least - 3.0)) then 0.5 else 0.0");
    const std::string run_it =
        on_tanks("run", "--policy policy.rddl --episodes 30 --json") + interpreted;
    const json faulty = run_json(run_it);
    EXPECT_GT(faulty["faulted"], 0);
    const auto message = faulty["first_fault"].get<std::string>();
    EXPECT_NE(message.find("policy.rddl:13:35: Bernoulli's probability must be in [0, 1], found -"),
              std::string::npos)
        << message;
}

TEST_F(PolicyProgram, HoldsPoliciesToTheRules) {
    const std::string run_it =
        on_tanks("run", "--policy greedy.rddl --episodes 3 --json") + interpreted;
    write_file(folder_ / "greedy.rddl",
               "policy greedy { cpfs { pump(?t) = true; power = @low; extra = 2.0; }; }");
    const json greedy = run_json(run_it, 1);
    EXPECT_EQ(greedy["faulted"], 3);
    EXPECT_EQ(greedy["first_fault"],
              "episode 0, step 0: greedy.rddl:1:8: the policy's number of actions that are not the "
              "default must not exceed max-nondef-actions, found 4");
    write_file(folder_ / "greedy.rddl",
               "policy greedy { cpfs { pump(?t) = false; power = @low; extra = 2.0; }; }");
    const Outcome warned = run(run_it + " --preconditions warn");
    EXPECT_NE(warned.err.find("precondition violated in episode 0, step 0"), std::string::npos)
        << warned.err;
}

TEST_F(PolicyProgram, IsDescribed) {
    EXPECT_EQ(run_json(on_tanks("info", "--json"))["policy"], nullptr);
    EXPECT_EQ(run(on_tanks("info", "")).out.find("policy"), std::string::npos);
    const json policy = run_json(on_tanks("info", "--policy policy.rddl --json"))["policy"];
    EXPECT_EQ(policy["name"], "fill_up");
    EXPECT_EQ(policy["stochastic"], true);
    EXPECT_EQ(policy["memory_size"], 3);
    EXPECT_EQ(policy["fluents"].size(), 4u);
    EXPECT_EQ(policy["fluents"][1]["default"], 0.75);
    const std::string text = run(on_tanks("info", "--policy policy.rddl")).out;
    EXPECT_NE(text.find("\npolicy fill_up (policy.rddl:2): stochastic, remembers 3 bytes\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("(instance.rddl)"), std::string::npos) << text;
}

}  // namespace
}  // namespace rddlc::cli
