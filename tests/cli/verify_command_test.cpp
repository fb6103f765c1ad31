// rddl verify as users run it.
#include "program.hpp"

#include <algorithm>

namespace rddlc::cli {
namespace {

using nlohmann::json;

constexpr const char* by_interpreter =
    "verify domain.rddl instance.rddl --engine interpreter --steps 500 ";

TEST_F(Program, VerifiesCompiledCodeInOneLine) {
    const Outcome outcome =
        run("verify domain.rddl instance.rddl --steps 2000 --lanes 1,8 --no-pyrddlgym");
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
    for (const char* part :
         {"domain.rddl instance.rddl: all agree over ", "plain interpreter", "after all passes",
          "single environments", "a batch", "packs of 8 (", "random states"})
        expect_part(outcome.out, part);
}

TEST_F(Program, VerifiesWithFastMath) {
    const json report = run_json(std::string(by_interpreter) + "--fast-math --no-pyrddlgym --json");
    EXPECT_EQ(report["agree"], true);
    EXPECT_EQ(report["engines"].size(), 2u);
    EXPECT_GE(report["steps"], 500);
    EXPECT_GT(report["values"]["states"], 2500);
    EXPECT_GT(report["random_states"], 100);
    EXPECT_FALSE(report.contains("pyrddlgym"));
}

TEST_F(Program, VerifiesTheSameStepsAgain) {
    const std::string command = std::string(by_interpreter) + "--no-pyrddlgym --json --seconds 60";
    EXPECT_EQ(run_json(command + " --seed 5"), run_json(command + " --seed 5"));
}

TEST_F(Program, VerifiesFromRecordedStates) {
    ASSERT_EQ(run("run domain.rddl instance.rddl --engine interpreter --episodes 3 --quiet "
                  "--trace trace.jsonl")
                  .status,
              0);
    const std::string trace = read_file(folder_ / "trace.jsonl");
    const auto steps = std::count(trace.begin(), trace.end(), '\n') - 1;
    const json report =
        run_json(std::string(by_interpreter) + "--states trace.jsonl --no-pyrddlgym --json");
    EXPECT_EQ(report["recorded_states"], steps);
    EXPECT_EQ(report["random_states"], 0);

    write_file(folder_ / "bad.jsonl",
               "{\"state\":{\"water___t1\":1.0}}\n{\"state\":{\"wine\":1}}\n");
    const Outcome bad = run(std::string(by_interpreter) + "--states bad.jsonl");
    EXPECT_EQ(bad.status, 1);
    expect_part(bad.err, "line 2 of 'bad.jsonl': no state-fluent is called 'wine'");
}

TEST_F(Program, VerifiesPolicies) {
    write_file(folder_ / "policy.rddl",
               "policy p { cpfs { pump(?t) = forall_{?u : tank} [water(?t) <= water(?u)]; "
               "power = @low; extra = if (Bernoulli(0.3)) then 0.5 else 0.0; }; }");
    const json report =
        run_json(std::string(by_interpreter) + "--policy policy.rddl --no-pyrddlgym --json");
    EXPECT_GT(report["values"]["actions"], 0);
    EXPECT_EQ(
        run_json(std::string(by_interpreter) + "--policy noop --no-pyrddlgym --json")["agree"],
        true);
    const Outcome none = run(std::string(by_interpreter) + "--policy rddl");
    EXPECT_EQ(none.status, 1);
    expect_part(none.err, "there is no policy block");
}

TEST_F(Program, TellsWhatItCannotVerify) {
    EXPECT_EQ(run("verify domain.rddl instance.rddl --lanes 3").status, 2);
    EXPECT_EQ(run("verify domain.rddl instance.rddl --engine pyrddlgym").status, 2);
    EXPECT_EQ(run("verify domain.rddl instance.rddl --steps 0").status, 2);
    write_file(folder_ / "trace.jsonl", "{}\n");
    const Outcome plan = run("verify domain.rddl instance.rddl --policy trace.jsonl");
    EXPECT_EQ(plan.status, 2);
    EXPECT_NE(plan.err.find("--states takes the states of a trace"), std::string::npos) << plan.err;
    EXPECT_EQ(run("verify domain.rddl instance.rddl --without no_such_pass").status, 2);
    EXPECT_EQ(run("verify domain.rddl none.rddl").status, 1);
    write_file(folder_ / "wrong.rddl", "domain d { oops }");
    const Outcome wrong = run("verify wrong.rddl");
    EXPECT_EQ(wrong.status, 1);
    expect_part(wrong.err, "wrong.rddl:1:");
    const Outcome none = run(by_interpreter + std::string("--python /no/such/python"));
    EXPECT_EQ(none.status, 0) << none.err;
    expect_part(none.out, "; pyRDDLGym: not compared, there is no '/no/such/python'");
    EXPECT_EQ(run(std::string(by_interpreter) + "--quiet --no-pyrddlgym").out, "");
}

// ------------------------------------------------------------------------------------- pyRDDLGym

// One tank, in which all is deterministic but the reward.
constexpr const char* tank = R"(domain tank {
    pvariables {
        water : { state-fluent, real, default = 5.0 };
        pump : { action-fluent, bool, default = false };
    };
    cpfs { water' = if (pump) then water + 2.0 else water - 1.0; };
    reward = Normal(water, 1.0);
}
non-fluents n { domain = tank; }
instance i { domain = tank; non-fluents = n; horizon = 10; discount = 1.0; }
)";

// A Python in whose place a program answers as ours does with pyRDDLGym: it computes the tank, `of`
// which the value of a step is made, and refuses what `refused` says.
class PyRddlGym : public Program {
  protected:
    PyRddlGym() { write_file(folder_ / "tank.rddl", tank); }

    Outcome verify(const std::string& water, const std::string& refused = "False") const {
        write_file(folder_ / "fake.py", fmt::format(R"(import json, sys
_, domain, instance, questions, answers, seconds = sys.argv[1:]
with open(answers, "w") as out:
    print(json.dumps(dict(version="9.9", random=[], random_reward=True, random_ending=False)), file=out)
    for line in open(questions):
        start = json.loads(line)
        water, pump = start["state"]["water"], start["action"]["pump"]
        if {}:
            print(json.dumps(dict(refused="ValueError: no")), file=out)
            continue
        print(json.dumps(dict(state=dict(water={}), observation=None, reward=0.0, terminated=False,
                              truncated=False, legal=True)), file=out)
)",
                                                    refused, water));
        write_file(folder_ / "python", "#!/bin/sh\nshift\nexec python3 fake.py \"$@\"\n");
        std::filesystem::permissions(folder_ / "python", std::filesystem::perms::owner_all);
        return run("verify tank.rddl --engine interpreter --steps 400 --python ./python");
    }
};

// pyRDDLGym takes the last non-fluents of a file.
TEST_F(PyRddlGym, ReadsTheNonFluentsThatTheInstanceNames) {
    std::string text = tank;
    const std::size_t begin = text.find("instance i");
    ASSERT_NE(begin, std::string::npos);
    write_file(
        folder_ / "tank.rddl",
        text.substr(0, begin) + "non-fluents other { domain = tank; }\n" + text.substr(begin));
    write_file(folder_ / "python", "#!/bin/sh\ncat \"$3\" >given.rddl\n");
    std::filesystem::permissions(folder_ / "python", std::filesystem::perms::owner_all);
    run("verify tank.rddl --engine interpreter --steps 20 --python ./python");
    const std::string given = read_file(folder_ / "given.rddl");
    EXPECT_NE(given.find("non-fluents n {"), std::string::npos) << given;
    EXPECT_EQ(given.find("other"), std::string::npos) << given;
}

constexpr const char* right = "water + 2.0 if pump else water - 1.0";

TEST_F(PyRddlGym, IsComparedInWhatIsNotDrawn) {
    const Outcome outcome = verify(right);
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    expect_part(outcome.out,
                "; pyRDDLGym 9.9 over 200 values of 200 steps, all but what is drawn at "
                "random (the reward)");
}

TEST_F(PyRddlGym, DiffersInAValue) {
    const Outcome outcome = verify("water + 2.0 if pump else water - 1.0001");
    EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
    expect_part(outcome.out, "error: the engines differ in water'\n");
    expect_part(outcome.out, "tank.rddl:6:12");
    expect_part(outcome.out, "note: pyRDDLGym 9.9: ");
    expect_part(outcome.out, "note: plain interpreter: ");
    expect_part(outcome.out, "docs/dialects.md");
}

TEST_F(PyRddlGym, MayRefuseSteps) {
    const Outcome outcome = verify(right, "pump");
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    expect_part(outcome.out, "steps that pyRDDLGym refuses left out");
}

TEST_F(PyRddlGym, IsNotAskedWhereItCannotRead) {
    const Outcome outcome = run("verify --std=rddlc tank.rddl --engine interpreter --steps 100");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_part(outcome.out, "pyRDDLGym: not compared, it does not read --std=rddlc");
}

}  // namespace
}  // namespace rddlc::cli
