// The output of list, info, check, run and bench.
//
// Over 400 lines: a test for each thing that can be seen.
#include "program.hpp"

#include <algorithm>
#include <set>
#include <sstream>

namespace rddlc::cli {
namespace {

using nlohmann::json;

TEST_F(Program, ExplainsItself) {
    const Outcome help = run("--help");
    EXPECT_EQ(help.status, 0);
    for (const char* command : {"list", "info", "check", "fmt", "run", "replay", "bench"}) {
        EXPECT_NE(help.out.find(std::string("\n  ") + command), std::string::npos) << command;
        const Outcome own = run(std::string(command) + " --help");
        EXPECT_EQ(own.status, 0);
        EXPECT_NE(own.out.find("Examples:\n  "), std::string::npos) << command;
    }
    EXPECT_TRUE(run("--version").out.starts_with("rddl "));
}

struct Misuse {
    const char* arguments;
    const char* message;
};
class MisusedProgram : public Program, public testing::WithParamInterface<Misuse> {};

TEST_P(MisusedProgram, SaysWhatIsWrong) {
    const Outcome outcome = run(GetParam().arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with(std::string("rddl: error: ") + GetParam().message))
        << outcome.err;
    const std::string command =
        std::string(GetParam().arguments).substr(0, 4) == "run " ? "rddl run" : "rddl";
    EXPECT_NE(outcome.err.find("\n'" + command), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Program, MisusedProgram,
    testing::Values(
        Misuse{"", "name a command, such as 'rddl list'"},
        Misuse{"--explain E9999", "there is no diagnostic 'E9999'; '--explain list'"},
        Misuse{"--explain", "--explain is given no value; expected --explain CODE"},
        Misuse{"rum domain.rddl", "no command is called 'rum'; did you mean 'run'?"},
        Misuse{"hlep", "no command is called 'hlep'; did you mean 'help'?"},
        Misuse{"help rum", "no command is called 'rum'; did you mean 'run'?"},
        Misuse{"help nosuch", "no command is called 'nosuch'\n"},
        Misuse{"--completions", "--completions is given no value; expected --completions "},
        Misuse{"run", "DOMAIN is required"},
        Misuse{"run domain.rddl instance.rddl --episode=3",
               "unknown option '--episode'; did you mean '--episodes'?"},
        Misuse{"run domain.rddl instance.rddl more", "too many arguments: 'more'"},
        Misuse{"compare domain.rddl instance.rddl --policies noop random",
               "too many arguments: 'random'; --policies takes one word, with commas and "
               "without blanks"},
        Misuse{"run domain.rddl instance.rddl --episodes 0",
               "--episodes: '0' is not an int from 1 to 100000000"},
        Misuse{"run domain.rddl instance.rddl --episodes abc",
               "--episodes: 'abc' is not an int from 1 to 100000000"},
        Misuse{"run domain.rddl instance.rddl --seed -1", "--seed: '-1' is not an int from 0 on"},
        Misuse{"run domain.rddl instance.rddl --seed",
               "--seed is given no value; expected --seed S: "},
        Misuse{"run domain.rddl instance.rddl --seed 1 --seed 2",
               "--seed is given twice: '1' and '2'"},
        Misuse{"run domain.rddl instance.rddl --engine compield",
               "--engine: 'compield' is not one of auto, compiled, interpreter; did you "
               "mean 'compiled'?"},
        Misuse{"verify domain.rddl instance.rddl --lanes 1,x",
               "--lanes: 'x' is not one of 1, 8, 16, 32, 64\n"},
        Misuse{"run domain.rddl instance.rddl --json=maybe",
               "--json: 'maybe' is not true or false"},
        Misuse{"compare domain.rddl instance.rddl --policies ,",
               "--policies: a value is missing in ','; expected --policies "
               "POLICY,...: "},
        Misuse{"compare domain.rddl instance.rddl --policies noop,,random",
               "--policies: a value is missing in 'noop,,random'"},
        Misuse{"compare domain.rddl instance.rddl --policies noop,",
               "--policies: a value is missing in 'noop,'"},
        Misuse{"compare domain.rddl instance.rddl --policies ''",
               "--policies is given no value; expected --policies POLICY,...: "},
        Misuse{"run domain.rddl instance.rddl --memory-limit abc",
               "--memory-limit: 'abc' is not a size, such as 512M, 4G or a number"},
        Misuse{"run domain.rddl instance.rddl --memory-limit -1",
               "--memory-limit: '-1' is not a size"},
        Misuse{"run domain.rddl instance.rddl --memory-limit 0",
               "--memory-limit: '0' is not a size"},
        Misuse{"run domain.rddl instance.rddl --memory-limit 4X",
               "--memory-limit: '4X' is not a size"},
        Misuse{"run domain.rddl instance.rddl --memory-limit 9999999999999G",
               "--memory-limit: '9999999999999G' is not a size"},
        Misuse{"run domain.rddl instance.rddl --trace= --engine=interpreter",
               "--trace is given no value"},
        Misuse{"run domain.rddl instance.rddl --trace ''", "--trace is given no value"},
        Misuse{"check", "name a problem, or say --all"},
        Misuse{"check --all domain.rddl", "--all checks the whole repository"}));

TEST_F(Program, ExplainsDiagnosticsAsTheCompilerDoes) {
    const auto page = std::filesystem::path(RDDL_EXAMPLES) / "../docs/diagnostics/E0203.md";
    const Outcome outcome = run("--explain E0203");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, read_file(page));
    EXPECT_TRUE(run("--explain=list").out.starts_with("E0101: "));
}

TEST_F(Program, WritesTwoOutputsToTwoFiles) {
    const Outcome outcome =
        run("run domain.rddl instance.rddl --trace a.jsonl --explain-decisions ./a.jsonl");
    EXPECT_EQ(outcome.status, 2);
    expect_part(outcome.err, "two outputs would be written to './a.jsonl'");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.jsonl"));
}

TEST_F(Program, TakesSizesWithUnits) {
    const auto told = [&](const std::string& size) {
        return run("info domain.rddl instance.rddl --memory-limit " + size).err;
    };
    for (const char* one_kilobyte : {"1024", "1k", "1K", "1KB", "1KiB", "'1 kib'", "1024b"})
        EXPECT_EQ(told(one_kilobyte), "") << one_kilobyte;
    for (const char* much : {"1e9", "1.5G", "1E9", "'1.5 kib'"}) EXPECT_EQ(told(much), "") << much;
    EXPECT_NE(told("1e1").find("more than the limit of 10 bytes"), std::string::npos);
    EXPECT_NE(told("8").find("more than the limit of 8 bytes"), std::string::npos) << told("8");
    EXPECT_EQ(run("info domain.rddl instance.rddl --json=false").out.find('{'), std::string::npos);
}

TEST_F(Program, TellsOfFilesWhoseNamesAreNoUtf8) {
    const std::string name = "d\xff.rddl";
    write_file(folder_ / name, tanks_domain);
    const std::string problem = "'" + name + "' instance.rddl --engine interpreter ";
    EXPECT_EQ(run_json("run " + problem + "--json")["episodes"], 1);
    EXPECT_EQ(run("run " + problem + "--quiet --trace t.jsonl").status, 0);
    EXPECT_TRUE(read_file(folder_ / "t.jsonl").starts_with("{\"rddl_trace\":1"));
    EXPECT_EQ(run_json("info '" + name + "' instance.rddl --json")["files"][0],
              "d\xEF\xBF\xBD.rddl");
    EXPECT_EQ(run("bench " + problem + "--json --seconds 0.01").status, 0);
}

// ----------------------------------------------------------------------------- finding problems

TEST_F(Program, TellsHowToInstallTheRepository) {
    for (const char* arguments : {"list", "run SysAdmin_MDP_ippc2011 1", "check --all"}) {
        const Outcome outcome = run(arguments, "PATH=/nonexistent");
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("pip install rddlrepository"), std::string::npos) << outcome.err;
    }
}

class Repository : public Program {
  protected:
    Repository() {
        const auto problem = folder_ / "repository/archive/water/Tanks";
        write_file(problem / "domain.rddl", tanks_domain);
        write_file(problem / "instance0.rddl", tanks_instance);
        write_file(problem / "instance1.rddl", "instance broken {");
        write_file(problem / "__init__.py",
                   "info = {'name': 'Tanks', 'context': 'water', "
                   "'description': 'Tanks that leak.'}");
    }
    Outcome run_there(const std::string& arguments) const {
        return run(arguments, "RDDL_REPOSITORY=repository");
    }
};

TEST_F(Repository, IsListed) {
    const Outcome outcome = run_there("list");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("Tanks_water  0-1        stochastic MDP  mixed    Tanks that leak."),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("1 problem, 2 instances in "), std::string::npos);

    const json listed = json::parse(run_there("list leak --json").out);
    ASSERT_EQ(listed.size(), 1u);
    EXPECT_EQ(listed[0]["instances"], (json{"0", "1"}));
    EXPECT_EQ(listed[0]["stochastic"], true);
    EXPECT_EQ(run_there("list nothing-like-this").status, 1);
}

TEST_F(Repository, IsRunByName) {
    EXPECT_EQ(run_there("run Tanks_water 0 --engine interpreter").status, 0);
    const Outcome misspelt = run_there("run Tank_water 0");
    EXPECT_EQ(misspelt.status, 1);
    EXPECT_NE(misspelt.err.find("did you mean 'Tanks_water'?"), std::string::npos) << misspelt.err;
}

TEST_F(Repository, IsCheckedAsAWhole) {
    for (const char* arguments : {"check --all", "check Tanks_water"}) {
        const Outcome outcome = run_there(arguments);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.out.find("1 of 2 instances without errors, 1 error"), std::string::npos)
            << outcome.out;
        EXPECT_NE(outcome.err.find("instance1.rddl:1:"), std::string::npos) << outcome.err;
    }
}

// -------------------------------------------------------------------------------- info and check

TEST_F(Program, DescribesAProblem) {
    const Outcome outcome = run("info domain.rddl instance.rddl");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* part :
         {"tanks_1 (instance.rddl)", "12 steps", "at most 2 of 5 may differ from the default",
          "action choices   5: the default, or 4 changes of one value",
          "stochastic: water', reward", "Exponential, Normal", "mixed, concurrent",
          "3 action-preconditions", "train ppo      yes\ntrain cgp      yes\ntrain drp      yes\n",
          "tank     object            3  t1, t2, t3", "[-2, 1]"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << '\n' << outcome.out;
}

// Training would refuse it with the same sentence, but this takes no step.
TEST_F(Program, TellsWhichLearnersTakeAProblem) {
    write_file(folder_ / "idle.rddl",
               "domain idle { pvariables { x : { state-fluent, real, default = 1.0 }; };\n"
               "  cpfs { x' = x; }; reward = x; }");
    write_file(folder_ / "idle_1.rddl",
               "non-fluents idle_nf { domain = idle; } instance idle_1 { domain = idle; "
               "non-fluents = idle_nf; horizon = 3; discount = 1.0; }");
    const Outcome outcome = run("info idle.rddl idle_1.rddl");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string reason =
        "there is nothing to choose in this problem: it has no action but the default";
    for (const std::string learner : {"train ppo", "train cgp", "train drp"})
        EXPECT_NE(outcome.out.find(learner + "    no: " + reason + "\n"), std::string::npos)
            << outcome.out;
    const json learners = run_json("info idle.rddl idle_1.rddl --json")["learners"];
    EXPECT_EQ(learners["ppo"], (json{{"takes", false}, {"reason", reason}}));
    const Outcome trained = run("train cgp idle.rddl idle_1.rddl --engine interpreter");
    EXPECT_EQ(trained.status, 1);
    EXPECT_NE(trained.err.find(reason), std::string::npos) << trained.err;
}

// Derivatives are of the program before its optimisation: that computes three sines together, and
// folds the factor of a matrix of constants.
TEST_F(Program, TellsWhatHasDerivatives) {
    const auto drp = [&](const std::string& root, const std::string& angles) {
        write_file(folder_ / "turn.rddl",
                   "domain turn { types { axis : object; };\n"
                   "  pvariables { A(axis, axis) : { non-fluent, real, default = 0.0 };\n"
                   "    x : { state-fluent, real, default = 1.0 };\n"
                   "    root(axis, axis) : { interm-fluent, real };\n"
                   "    turn : { action-fluent, real, default = 0.0 }; };\n"
                   "  cpfs { root(?r, ?c) = " +
                       root + ";\n    x' = turn + [sum_{?a : axis} root(?a, ?a)] + " + angles +
                       "; };\n"
                       "  reward = -x * x; action-preconditions { turn >= -1; turn <= 1; }; }");
        write_file(folder_ / "turn_1.rddl",
                   "non-fluents n { domain = turn; objects { axis : {a1, a2}; }; } instance turn_1 "
                   "{ domain = turn; non-fluents = n; horizon = 3; discount = 1.0; }");
        return run_json("info turn.rddl turn_1.rddl --json")["learners"]["drp"];
    };
    EXPECT_EQ(drp("A(?r, ?c)", "sin[x] + sin[2 * x] + sin[3 * x]"),
              (json{{"takes", true}, {"reason", nullptr}}));
    EXPECT_EQ(drp("cholesky[row=?r, col=?c][A(?r, ?c) + (?r == ?c)]", "x"),
              (json{{"takes", false}, {"reason", "there are no derivatives of cholesky"}}));
}

TEST_F(Program, DescribesAProblemAsJson) {
    const json info = run_json("info domain.rddl instance.rddl --json");
    EXPECT_EQ(info["domain"], "tanks");
    EXPECT_EQ(info["horizon"], 12);
    EXPECT_EQ(info["max_nondef_actions"], 2);
    EXPECT_EQ(info["action_choices"], 5);
    EXPECT_EQ(info["characteristics"]["random_cpfs"], (json{"water'"}));
    EXPECT_EQ(info["sizes"]["state"]["values"], 5);
    EXPECT_EQ(info["sizes"]["state"]["bytes"], 40);
    const json& water = info["fluents"][1];
    EXPECT_EQ(water["name"], "water");
    EXPECT_EQ(water["parameters"], (json{"tank"}));
    EXPECT_EQ(water["shape"], (json{3}));
    EXPECT_EQ(water["default"], 5.0);
    EXPECT_EQ(water["source"]["line"], 5);
    const json& extra = info["fluents"][6];
    EXPECT_EQ(extra["lower"], (json{-2.0}));
    EXPECT_EQ(extra["upper"], (json{1.0}));
    EXPECT_EQ(info["fluents"][5]["default"], "low");
    EXPECT_EQ(info["terminations"][0]["text"], "exists_{?t : tank} [water(?t) < 0.0]");
}

TEST_F(Program, ChecksAProblem) {
    const Outcome good = run("check domain.rddl instance.rddl");
    EXPECT_EQ(good.status, 0) << good.err;
    EXPECT_EQ(good.out, "domain.rddl instance.rddl: no errors, 1 warning\n");
    EXPECT_NE(good.err.find("domain.rddl:7:9: warning: "), std::string::npos) << good.err;

    write_file(folder_ / "bad.rddl",
               "domain d { pvariables { x : { state-fluent, int, default = 0 }; };\n"
               "  cpfs { x' = y + 1; }; reward = x; }");
    const Outcome bad = run("check bad.rddl instance.rddl");
    EXPECT_EQ(bad.status, 1);
    EXPECT_EQ(bad.out, "");
    EXPECT_NE(bad.err.find("bad.rddl:2:15: error: "), std::string::npos) << bad.err;

    const Outcome missing = run("check none.rddl instance.rddl");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.err.find("cannot read 'none.rddl': No such file"), std::string::npos);
}

TEST_F(Program, NamesItsOwnExplanation) {
    write_file(folder_ / "bad/domain.rddl",
               "domain d { pvariables { x : { state-fluent, int }; };");
    write_file(folder_ / "bad/instance1.rddl", tanks_instance);
    for (const char* arguments :
         {"check bad/domain.rddl", "check bad", "fmt bad/domain.rddl", "run bad"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_TRUE(outcome.err.ends_with("\n'rddl --explain E0103' explains it\n"))
            << arguments << '\n'
            << outcome.err;
    }
    const Outcome unbuilt =
        run("run domain.rddl instance.rddl --engine compiled --no-cache", "CXX=nosuch");
    EXPECT_EQ(unbuilt.status, 1);
    EXPECT_NE(unbuilt.err.find("\n'rddl --explain E0905' explains it\n"), std::string::npos)
        << unbuilt.err;
}

TEST_F(Program, TellsOnceWhatInstancesShare) {
    std::string domain = tanks_domain;
    domain.replace(domain.find("LEAK(?t))"), 9, "LEAK(?s))");
    write_file(folder_ / "bad/domain.rddl", domain);
    write_file(folder_ / "bad/instance1.rddl", tanks_instance);
    write_file(folder_ / "bad/instance2.rddl", tanks_instance);
    const Outcome outcome = run("check bad");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find("domain.rddl:13:51"), outcome.err.rfind("domain.rddl:13:51"));
    EXPECT_NE(outcome.out.find("0 of 2 instances without errors, 1 error, "), std::string::npos)
        << outcome.out;
}

TEST_F(Program, SaysHowToSeeTheWarningsOfAFolder) {
    write_file(folder_ / "tanks/domain.rddl", tanks_domain);
    write_file(folder_ / "tanks/instance1.rddl", tanks_instance);
    const Outcome quiet = run("check tanks");
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.err, "");
    EXPECT_TRUE(quiet.out.ends_with("0 errors, 1 warning; --verbose shows the warning\n"))
        << quiet.out;
    const Outcome verbose = run("check --verbose tanks");
    EXPECT_NE(verbose.err.find("domain.rddl:7:9: warning: "), std::string::npos) << verbose.err;
    EXPECT_TRUE(verbose.out.ends_with("0 errors, 1 warning\n")) << verbose.out;
}

TEST_F(Program, TellsCertainFaultsOfADomainAlone) {
    std::string domain = tanks_domain;
    domain.replace(domain.find("Exponential(LEAK(?t))"), 21, "Bernoulli(0.5 + 1.0) ");
    domain.replace(domain.find("Normal(0.0, 2.0 + extra)"), 24, "Normal(0.0, extra - 2.0)");
    write_file(folder_ / "certain.rddl", domain);
    const Outcome outcome = run("check certain.rddl");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string warning =
        "certain.rddl:13:34: warning: Bernoulli's probability must be in [0, 1], found 1.5: this "
        "faults whenever it is evaluated [W0601]\n";
    EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("W0601"), outcome.err.rfind("W0601")) << outcome.err;
}

TEST_F(Program, SaysWhichFilesAreMissing) {
    const auto told = [&](const std::string& arguments) {
        return run(arguments).err;
    };
    EXPECT_EQ(told("run domain.rddl"),
              "error: there is no instance block [E0204]\n"
              "hint: give the instance's file after the domain's\n"
              "1 error\n'rddl --explain E0204' explains it\n");
    EXPECT_TRUE(
        told("run domain.rddl 1").starts_with("rddl: error: there is no instance file '1'\n"));
    write_file(folder_ / "e/other.rddl", "");
    EXPECT_TRUE(told("run e e").starts_with("rddl: error: there is no domain.rddl in 'e'\n"));
    EXPECT_TRUE(told("run e instance.rddl")
                    .starts_with("error: cannot read 'e': Is a directory [E0901]\n"));
}

constexpr const char* domain_alone =
    ": no errors in the domain, 1 warning\n"
    "no instance was given: objects, values and what depends on them were not checked\n";

TEST_F(Program, ChecksADomainAlone) {
    const Outcome good = run("check domain.rddl");
    EXPECT_EQ(good.status, 0) << good.err;
    EXPECT_EQ(good.out, std::string("domain.rddl") + domain_alone);
    EXPECT_NE(good.err.find("domain.rddl:7:9: warning: "), std::string::npos) << good.err;

    std::string domain = tanks_domain;
    domain.replace(domain.find("LEAK(?t))"), 9, "LEAK(?s))");
    domain.replace(domain.find("power;"), 6, "true;");
    write_file(folder_ / "bad.rddl", domain);
    const Outcome bad = run("check bad.rddl");
    EXPECT_EQ(bad.status, 1);
    EXPECT_EQ(bad.out, "");
    for (const char* place : {"bad.rddl:13:51: error: ", "bad.rddl:15:17: error: ", "2 errors\n",
                              "no instance was given: "})
        EXPECT_NE(bad.err.find(place), std::string::npos) << place << '\n' << bad.err;

    // Other commands need an instance, and a second file is not read as another domain.
    EXPECT_EQ(run("info domain.rddl").status, 1);
    EXPECT_EQ(run("check domain.rddl domain.rddl").status, 1);
}

TEST_F(Program, ChecksAFolderWithoutInstances) {
    write_file(folder_ / "alone/domain.rddl", tanks_domain);
    const Outcome outcome = run("check alone");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, std::string("alone/domain.rddl") + domain_alone);
}

TEST_F(Program, TakesBothBlocksFromOneFile) {
    write_file(folder_ / "both.rddl", std::string(tanks_domain) + tanks_instance);
    EXPECT_EQ(run("check both.rddl").status, 0);
    EXPECT_EQ(run(std::string("run both.rddl") + interpreted).status, 0);
}

TEST_F(Program, TellsWhenStandardOutputIsFull) {
    const std::string to_full_disk =
        command("info domain.rddl instance.rddl") + " >/dev/full 2>'" + stderr_file() + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(to_full_disk.c_str())), 1);
    EXPECT_EQ(read_file(stderr_file()),
              "rddl: error: cannot write to standard output: No space left on device\n");
}

// ------------------------------------------------------------------------------------------ run

TEST_F(Program, RunsReproducibly) {
    const std::string run_it = "run domain.rddl instance.rddl --episodes 60 --json";
    const json summary = without_speed(run_json(run_it));
    EXPECT_EQ(summary["episodes"], 60);
    EXPECT_EQ(summary["faulted"], 0) << summary["first_fault"];
    EXPECT_GT(summary["terminated"], 0);
    EXPECT_GT(summary["return"]["std"], 0);
    for (const char* other :
         {" --threads 1 --batch 1", " --threads 3 --batch 7", interpreted, " --quiet"})
        EXPECT_EQ(without_speed(run_json(run_it + other)), summary) << other;
    EXPECT_NE(without_speed(run_json(run_it + " --seed 4")), summary);
    EXPECT_NE(without_speed(run_json(run_it + " --policy noop")), summary);
}

TEST_F(Program, SummarisesForPeople) {
    const Outcome outcome =
        run(std::string("run domain.rddl instance.rddl --episodes 20 --horizon 2") + interpreted);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "") << "no progress in a pipe";
    for (const char* part : {"tanks_1 (tanks): policy random, seed 0, interpreter", "mean",
                             "discounted return", "20 episodes: ", " at the horizon", "steps/s"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << '\n' << outcome.out;
    EXPECT_EQ(run(std::string("run domain.rddl instance.rddl --quiet") + interpreted).out, "");
}

TEST_F(Program, CountsFaults) {
    std::string domain = tanks_domain;
    domain.replace(domain.find("extra >= -2.0"), 13, "extra >= -9.0");
    write_file(folder_ / "domain.rddl", domain);
    const json summary =
        run_json(std::string("run domain.rddl instance.rddl --episodes 50 --json") + interpreted);
    EXPECT_GT(summary["faulted"], 0);
    const auto message = summary["first_fault"].get<std::string>();
    EXPECT_NE(message.find("domain.rddl:17:44: Normal's variance must not be negative, found -"),
              std::string::npos)
        << message;
}

// Lamp b heats up so fast that it faults in most episodes; the others continue to the horizon.
constexpr const char* risky_problem = R"(domain risky {
    types { lamp : object; };
    pvariables {
        MEAN(lamp) : { non-fluent, real, default = 0.1 };
        heat(lamp) : { state-fluent, real, default = 0.0 };
        on(lamp) : { state-fluent, bool, default = true };
        push(lamp) : { action-fluent, bool, default = false };
    };
    cpfs {
        heat'(?l) = heat(?l) + (if (push(?l)) then Exponential(MEAN(?l)) else 0.0);
        on'(?l) = Bernoulli(1.0 - heat(?l) / 100.0);
    };
    reward = sum_{?l : lamp} on(?l);
}
non-fluents more { domain = risky; objects { lamp : { a, b, c }; }; non-fluents { MEAN(b) = 30.0; }; }
instance risky_1 { domain = risky; non-fluents = more; horizon = 8; discount = 1.0; }
)";

TEST_F(Program, KeepsGoingAfterFaults) {
    write_file(folder_ / "risky.rddl", risky_problem);
    const std::string run_it = "run risky.rddl --episodes 300 --json";
    const json summary = without_speed(run_json(run_it + interpreted));
    EXPECT_EQ(summary["episodes"], 300);
    EXPECT_GT(summary["faulted"], 50);
    EXPECT_GT(summary["truncated_horizon"], 50);
    EXPECT_EQ(summary["faulted"].get<int>() + summary["truncated_horizon"].get<int>(), 300);
    const auto message = summary["first_fault"].get<std::string>();
    for (const char* part : {"episode ", ", step ",
                             ": risky.rddl:11:19: Bernoulli's probability must be in [0, 1], found "
                             "-0.",
                             " (at ?l = b)"})
        EXPECT_NE(message.find(part), std::string::npos) << message;
    for (const char* other : {" --threads 1 --batch 1", " --threads 3 --batch 300"})
        EXPECT_EQ(without_speed(run_json(run_it + other)), summary) << other;

    const Outcome text = run("run risky.rddl --episodes 300" + std::string(interpreted));
    EXPECT_EQ(text.status, 0);
    EXPECT_NE(text.out.find("first fault: " + message), std::string::npos) << text.out;
}

TEST_F(Program, EndsWithStatus1IfEveryEpisodeFaulted) {
    write_file(folder_ / "faulty.rddl", faulty_problem("1.0"));
    const std::string all =
        "rddl: error: all 5 episodes faulted; the first fault: episode 0, step 1: "
        "faulty.rddl:2:17: "
        "Bernoulli's probability must be in [0, 1], found 1.5\n";
    for (const char* form : {"", " --json", " --quiet", " --trace -"}) {
        const Outcome outcome =
            run("run faulty.rddl --episodes 5" + std::string(interpreted) + form);
        EXPECT_EQ(outcome.status, 1) << form;
        EXPECT_EQ(outcome.err, all) << form;
    }
    EXPECT_TRUE(
        run(std::string("run faulty.rddl") + interpreted)
            .err.starts_with("rddl: error: the only episode faulted; the first fault: episode 0"));
}

// A program that reads lines of JSON meets nothing else.
TEST_F(Program, ExplainsDecisionsToStandardOutputAlone) {
    for (const char* const command : {"run", "evaluate"}) {
        const Outcome outcome =
            run(command +
                std::string(" domain.rddl instance.rddl --episodes 1 --horizon 2 "
                            "--policy plan:cem,iterations=1 --explain-decisions -") +
                interpreted);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::istringstream lines(outcome.out);
        int steps = 0;
        for (std::string line; std::getline(lines, line); ++steps)
            EXPECT_EQ(json::parse(line)["step"], steps);
        EXPECT_EQ(steps, 2) << command;
    }
}

TEST_F(Program, EvaluatesWithTheReasonOfTheFirstFault) {
    write_file(folder_ / "faulty.rddl", faulty_problem("1.0"));
    const Outcome outcome = run("evaluate faulty.rddl --episodes 5" + std::string(interpreted));
    EXPECT_EQ(outcome.status, 0);
    expect_part(outcome.err, "faults ended 5 of 5 episodes of 'random'");
    expect_part(outcome.err,
                "  the first fault: episode 0, step 1: faulty.rddl:2:17: "
                "Bernoulli's probability must be in [0, 1], found 1.5\n");
}

TEST_F(Program, TellsHowManyEpisodesFaulted) {
    write_file(folder_ / "faulty.rddl", faulty_problem("0.5"));
    const Outcome some = run(std::string("run faulty.rddl --episodes 40 --quiet") + interpreted);
    EXPECT_EQ(some.status, 0);
    EXPECT_TRUE(some.err.starts_with("rddl: warning: ")) << some.err;
    EXPECT_NE(some.err.find(" of 40 episodes faulted; the first fault: episode "),
              std::string::npos);

    write_file(folder_ / "faulty.rddl", faulty_problem("0.0"));
    const Outcome none = run(std::string("run faulty.rddl --episodes 40") + interpreted);
    EXPECT_EQ(none.status, 0);
    EXPECT_EQ(none.err, "");
}

TEST_F(Program, RefusesEndlessEpisodes) {
    write_file(folder_ / "endless.rddl",
               "domain d { pvariables { x : { state-fluent, int, default = 0 }; };\n"
               "  cpfs { x' = x + 1; }; reward = x; }\n"
               "non-fluents n { domain = d; }\n"
               "instance i { domain = d; non-fluents = n; horizon = 0; discount = 1.0; }");
    const Outcome outcome = run(std::string("run endless.rddl") + interpreted);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("give one with --horizon"), std::string::npos) << outcome.err;
    EXPECT_EQ(run(std::string("run endless.rddl --horizon 3") + interpreted).status, 0);
    for (const char* const command : {"evaluate", "compare"}) {
        const Outcome endless = run(command + std::string(" endless.rddl") + interpreted);
        EXPECT_EQ(endless.status, 2);
        expect_part(endless.err, "give one with --horizon");
        EXPECT_EQ(run(command + std::string(" endless.rddl --horizon 3") + interpreted).status, 0);
    }
}

constexpr const char* random_start =
    "domain d { pvariables { x : { state-fluent, real, default = 0.0 }; };\n"
    "  cpfs { x' = x + 1e-3; }; reward = x; termination { x > 0.9; }; }\n"
    "non-fluents n { domain = d; }\n"
    "instance i { domain = d; non-fluents = n; init-state { x = Uniform(0.0, 1.0); };\n"
    "  horizon = pos-inf; discount = 1; }";

TEST_F(Program, ReadsExtensionsWhereAskedFor) {
    write_file(folder_ / "random.rddl", random_start);
    for (const char* command : {"run", "info", "check", "fmt", "bench", "replay"}) {
        const Outcome refused = run(std::string(command) + " random.rddl");
        EXPECT_EQ(refused.status, 1) << command;
        EXPECT_NE(refused.err.find("--std=rddlc allows it"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(run("check --std=rddlc random.rddl").status, 0);
    const std::string text = random_start;
    const std::size_t instance = text.find("non-fluents n");
    write_file(folder_ / "many/domain.rddl", text.substr(0, instance));
    write_file(folder_ / "many/instance1.rddl", text.substr(instance));
    EXPECT_EQ(run("check many").status, 1);
    EXPECT_EQ(run("check --std=rddlc many").status, 0);
    EXPECT_EQ(run("fmt --std=rddlc --stdout random.rddl").status, 0);
    const json info = run_json("info --std=rddlc random.rddl --json");
    EXPECT_EQ(info["horizon"], 0);
    EXPECT_TRUE(info["characteristics"]["random_initial_state"]) << info;
    EXPECT_EQ(run("run random.rddl --std c99").status, 2);
}

// One line an episode: what 'run' traces without the header, which names the engine.
std::string steps_of(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out.substr(outcome.out.find('\n') + 1);
}

TEST_F(Program, StartsEachEpisodeAnewAndReproducibly) {
    write_file(folder_ / "random.rddl", random_start);
    const std::string run_it =
        "run --std=rddlc random.rddl --episodes 20 --horizon 1 --trace - --quiet";
    const std::string steps = steps_of(run(run_it));
    for (const char* other : {" --threads 1 --batch 1", " --threads 3 --batch 7", interpreted})
        EXPECT_EQ(steps_of(run(run_it + other)), steps) << other;
    EXPECT_NE(steps_of(run(run_it + " --seed 4" + interpreted)), steps);

    std::set<double> states;
    std::istringstream lines(steps);
    for (std::string line; std::getline(lines, line);)
        states.insert(json::parse(line)["state"]["x"].get<double>());
    EXPECT_GT(states.size(), 10u) << "some episodes are over before their first step";
}

// The signal comes late enough for a busy machine to have begun by then.
TEST_F(Program, EndsCleanlyWhenInterrupted) {
    const Outcome outcome =
        run(std::string("run domain.rddl instance.rddl --episodes 50000000") + interpreted,
            "timeout --signal INT --preserve-status 5");
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.out.find(" episodes: "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("rddl: interrupted after "), std::string::npos) << outcome.err;
}

TEST_F(Program, ShowsNoReturnWhereNoEpisodeWasFinished) {
    const std::string evaluate =
        "evaluate domain.rddl instance.rddl --policy plan:cem,seconds=60 --episodes 1" +
        std::string(interpreted);
    const std::string soon = "timeout --signal INT --preserve-status 2";
    const Outcome table = run(evaluate, soon);
    EXPECT_EQ(table.status, 130);
    expect_part(table.out, "plan:cem,seconds=60       -           -    -    -");
    const Outcome written = run(evaluate + " --json", soon);
    EXPECT_EQ(written.status, 130);
    const json policy = json::parse(written.out)["policies"][0];
    EXPECT_EQ(policy["episodes"], 0);
    for (const char* figure : {"return", "discounted_return", "length"})
        EXPECT_TRUE(policy[figure]["mean"].is_null()) << written.out;
}

TEST_F(Program, NeedsNoCompilerToInterpret) {
    const Outcome by_itself = run("run domain.rddl instance.rddl", "CXX=/no/such/compiler");
    EXPECT_EQ(by_itself.status, 0);
    EXPECT_EQ(by_itself.err,
              "warning: there is no C++ compiler '/no/such/compiler': the problem is interpreted, "
              "which is slower\n");
    const Outcome compiled =
        run("run domain.rddl instance.rddl --engine compiled", "CXX=/no/such/compiler");
    EXPECT_EQ(compiled.status, 1);
    EXPECT_NE(compiled.err.find("--engine=interpreter"), std::string::npos) << compiled.err;
    const std::string interpret = std::string("run domain.rddl instance.rddl") + interpreted;
    EXPECT_EQ(run(interpret, "CXX=/no/such/compiler").status, 0);
}

}  // namespace
}  // namespace rddlc::cli
