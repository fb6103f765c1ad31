// Training, evaluation and export as users run them, on a problem whose actions are bools, objects
// and reals, of which few may change, and which preconditions couple.
#include "program.hpp"

#include <algorithm>
#include <sstream>
#include <string>

namespace rddlc::cli {
namespace {

using nlohmann::json;

class LearningProgram : public Program {
  protected:
    static std::string on_tanks(const std::string& command, const std::string& options) {
        return command + " domain.rddl instance.rddl " + options + " --engine interpreter";
    }
    static constexpr const char* small_ppo =
        "--envs 16 --rollout 24 --minibatch 192 --epochs 2 --hidden 16,16 --evaluations 4 "
        "--evaluation-episodes 10 ";
    static constexpr const char* small_cgp = "--lambda 4 --cols 20 --episodes 4 --evaluations 4 ";
};

// The formula beside the best return is that of policy.cgp, not of the search's last program.
TEST_F(LearningProgram, PrintsTheFormulaThatEarnsTheBestReturn) {
    const auto formula_of = [&](const char* const file) {
        std::istringstream lines(read_file(folder_ / "c" / file));
        std::string formula;
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("# ")) formula += line.substr(2) + "\n";
        return formula;
    };
    int others = 0;
    for (int seed = 0; seed < 10; ++seed) {
        const Outcome trained = run(
            on_tanks("train cgp", fmt::format("--gens 40 --seed {} --out c {}", seed, small_cgp)));
        ASSERT_EQ(trained.status, 0) << trained.err;
        EXPECT_TRUE(trained.out.ends_with("\n" + formula_of("policy.cgp"))) << trained.out;
        others += formula_of("policy.cgp") != formula_of("last.cgp");
        std::filesystem::remove_all(folder_ / "c");
    }
    EXPECT_GT(others, 0);
}

TEST_F(LearningProgram, TrainsEvaluatesAndCompares) {
    for (const std::string& solver : {"ppo --steps 20000 " + std::string(small_ppo),
                                      "cgp --gens 40 " + std::string(small_cgp)}) {
        const std::string name = solver.substr(0, 3);
        const Outcome trained = run(on_tanks("train " + solver, "--out runs/" + name));
        ASSERT_EQ(trained.status, 0) << trained.err;
        EXPECT_NE(trained.out.find("best return"), std::string::npos);
        const std::string progress = read_file(folder_ / "runs" / name / "progress.csv");
        EXPECT_EQ(progress.find("time/total_timesteps,time/time_elapsed,"), 0u);
        EXPECT_GT(std::count(progress.begin(), progress.end(), '\n'), 4);
    }
    const json compared = run_json(on_tanks(
        "compare", "--policies random,noop,runs/ppo,runs/cgp --episodes 200 --json --threads 2"));
    ASSERT_EQ(compared["policies"].size(), 4u);
    double best = -1e9;
    for (const json& each : compared["policies"]) {
        EXPECT_EQ(each["episodes"], 200);
        EXPECT_EQ(each["faulted"], 0);
        EXPECT_EQ(each["illegal_actions"], 0) << each["policy"];
        const double mean = each["return"]["mean"];
        EXPECT_GT(each["return"]["half_width_95"].get<double>(), 0);
        if (each["policy"].get<std::string>().starts_with("runs/"))
            EXPECT_GT(mean, best) << each["policy"];
        else
            best = std::max(best, mean);
    }
    // The same by 'rddl run', and of the same file by its name.
    const json ran = run_json(on_tanks("run", "--policy runs/cgp --episodes 200 --json"));
    EXPECT_EQ(ran["return"]["mean"], compared["policies"][3]["return"]["mean"]);
    const json evaluated =
        run_json(on_tanks("evaluate", "--policy runs/ppo/policy.json --episodes 200 --json"));
    EXPECT_EQ(evaluated["policies"][0]["return"]["mean"],
              compared["policies"][2]["return"]["mean"]);
}

// A run that is killed at any moment resumes as if nothing had happened.
TEST_F(LearningProgram, GoesOnAfterItWasKilled) {
    for (const char* const network : {"", "--activation relu ", "--recurrent 8 --segment 10 "}) {
        std::filesystem::remove_all(folder_ / "parts");
        std::filesystem::remove_all(folder_ / "whole");
        const std::string options = fmt::format("--steps 40000 --seed 3 {}{}", network, small_ppo);
        ASSERT_EQ(run(on_tanks("train ppo", options + "--out whole")).status, 0);
        // The first part is ended by its time, the second is killed: it leaves a whole checkpoint.
        ASSERT_EQ(run(on_tanks("train ppo", options + "--out parts --time 0.02")).status, 0);
        run(on_tanks("train ppo", options + "--out parts --resume --quiet"),
            "timeout -s KILL 0.15");
        const Outcome rest = run(on_tanks("train ppo", options + "--out parts --resume"));
        ASSERT_EQ(rest.status, 0) << rest.err;
        for (const char* const name : {"policy.json", "last.json"})
            EXPECT_EQ(read_file(folder_ / "parts" / name), read_file(folder_ / "whole" / name));
    }
}

// This also holds with a memory: a trace by a policy file has the return that its evaluation
// reports.
TEST_F(LearningProgram, RemembersInEveryCommand) {
    const std::string maze = " " RDDL_EXAMPLES "/t_maze/domain.rddl " RDDL_EXAMPLES
                             "/t_maze/instance.rddl --engine interpreter ";
    const Outcome trained =
        run("train ppo" + maze +
            "--recurrent 16 --steps 80000 --envs 16 --minibatch 256 --epochs 10 --lr 1e-3 "
            "--hidden 32,32 --quiet --out r");
    ASSERT_EQ(trained.status, 0) << trained.err;
    for (const char* const command : {"run", "evaluate"})
        for (const char* const batch : {"--threads 1", "--threads 2"}) {
            const json told = run_json(command + maze + "--policy r --episodes 60 --json " + batch);
            const json& policy = told.contains("policies") ? told["policies"][0] : told;
            EXPECT_EQ(policy["return"]["mean"], 4.0) << command;
        }
    const json random =
        run_json("evaluate" + maze + "--policy r/last.json --stochastic --episodes 60 --json");
    EXPECT_GT(random["policies"][0]["return"]["mean"], 3.5);
    // A run with another network cannot be resumed.
    const Outcome other = run("train ppo" + maze + "--recurrent 8 --resume --out r");
    EXPECT_EQ(other.status, 1);
    expect_part(other.err, "it is of a run with other options: --envs was 16 and is 64, ");
    expect_part(other.err, "--recurrent was 16 and is 8");
}

TEST_F(LearningProgram, CtrlCSavesAndEnds) {
    const Outcome outcome =
        run(on_tanks("train ppo", "--steps 1e12 --out run --quiet " + std::string(small_ppo)),
            "timeout --preserve-status -s INT 2");
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run/checkpoint"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run/policy.json"));
}

// Ctrl-C comes in the middle of an update, which is made again: the result is the same to the byte.
TEST_F(LearningProgram, GoesOnAfterCtrlCAsIfNothingHadHappened) {
    const std::string ppo =
        "ppo --steps 9600 --envs 16 --rollout 200 --minibatch 800 --epochs 60 "
        "--evaluations 2 --evaluation-episodes 4 ";
    const std::string cgp = "cgp --gens 60 --cols 30 --episodes 60 --islands 2 --evaluations 3 ";
    for (const std::string& solver : {ppo, cgp}) {
        std::filesystem::remove_all(folder_ / "parts");
        std::filesystem::remove_all(folder_ / "whole");
        ASSERT_EQ(run(on_tanks("train " + solver, "--quiet --out whole")).status, 0);
        int status = 130, interrupts = 0;
        for (; status == 130 && interrupts < 40; ++interrupts)
            status =
                run(on_tanks("train " + solver, std::string("--quiet --out parts") +
                                                    (interrupts > 0 ? " --resume" : "")),
                    fmt::format("timeout --preserve-status -s INT {:.2f}", 0.2 + 0.1 * interrupts))
                    .status;
        EXPECT_EQ(status, 0);
        EXPECT_GT(interrupts, 1) << "it was not interrupted";
        for (const char* const name : {"policy.json", "last.json", "policy.cgp", "last.cgp"})
            EXPECT_EQ(read_file(folder_ / "parts" / name), read_file(folder_ / "whole" / name));
    }
}

TEST_F(LearningProgram, RefusesCheckpointsThatAreNotAsTheyWere) {
    const std::string options = "--gens 10 --quiet --out c " + std::string(small_cgp);
    ASSERT_EQ(run(on_tanks("train cgp", options)).status, 0);
    const std::filesystem::path file = folder_ / "c/checkpoint";
    const std::string whole = read_file(file);
    const auto refuses = [&](const std::string& sentence, const std::string& more = "") {
        const Outcome outcome = run(on_tanks("train cgp", options + "--resume " + more));
        EXPECT_EQ(outcome.status, 1);
        expect_part(outcome.err, "cannot resume from 'c/checkpoint': " + sentence);
    };
    for (const std::size_t at :
         {std::size_t{20}, std::size_t{26}, whole.size() / 2, whole.size() - 1}) {
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 4);
        write_file(file, flipped);
        refuses("it is damaged");
    }
    write_file(file, whole.substr(0, whole.size() - 1));
    refuses("it is damaged");
    write_file(file, whole.substr(0, 10));
    refuses("it is not a checkpoint, or one of another version of this program");
    std::filesystem::resize_file(file, 100'000'000'000);
    refuses("it has 93.1 GiB, more than the limit of 4 GiB");
    std::filesystem::remove(file);
    std::filesystem::create_symlink("/dev/zero", file);
    refuses("it is not a regular file");
    std::filesystem::remove(file);
    write_file(file, whole);
    const Outcome ppo = run(on_tanks("train ppo", "--resume --out c"));
    expect_part(ppo.err, "it is of a run of cgp, and this is one of ppo");
    // Options that change what is learned have to stay; how long it takes may change.
    refuses("it is of a run with other options: --evaluation-episodes was 20 and is 7",
            "--evaluation-episodes 7");
    refuses("it is of a run with other options: --seed was 0 and is 1", "--seed 1");
    refuses("it is of a run with other options: --fast-math was false and is true", "--fast-math");
    EXPECT_EQ(run(on_tanks("train cgp", "--gens 20 --quiet --resume --threads 2 --out c " +
                                            std::string(small_cgp)))
                  .status,
              0);
}

TEST_F(LearningProgram, SaysWhichRewardIsNotFinite) {
    const auto problem = [](const std::string& reward) {
        return fmt::format(R"(
domain d {{
    pvariables {{
        x : {{ state-fluent, real, default = 0.0 }};
        up : {{ action-fluent, bool, default = false }};
    }};
    cpfs {{ x' = x + 1.0; }};
    reward = {};
}}
non-fluents n {{ domain = d; }}
instance i {{ domain = d; non-fluents = n; horizon = 9; discount = 1.0; }}
)",
                           reward);
    };
    const auto train = [&](const std::string& options) {
        return run("train " + options + " --engine interpreter --quiet --out " +
                   options.substr(0, 3));
    };
    write_file(folder_ / "nan.rddl", problem("if (x > 3.5) then ln[-1.0 * x] else x"));
    const Outcome ppo = train("ppo nan.rddl --steps 1000");
    EXPECT_EQ(ppo.status, 1);
    expect_part(ppo.err, "the reward of step 4 of an episode of environment 0 is ");
    const Outcome cgp = train("cgp nan.rddl --gens 5");
    EXPECT_EQ(cgp.status, 1);
    expect_part(
        cgp.err,
        "no evaluation has a finite return: the reward of step 4 of episode 0 is not finite");
    // A policy that chooses well never meets the fault.
    std::filesystem::remove_all(folder_ / "cgp");
    write_file(folder_ / "some.rddl", problem("if (up) then 1.0 else exp[800.0 + x]"));
    const Outcome some = train("cgp some.rddl --gens 30");
    EXPECT_EQ(some.status, 0) << some.err;
    std::filesystem::remove_all(folder_ / "cgp");
    write_file(folder_ / "sum.rddl", problem("if (x > 0.5) then pow[10.0, 308.0] else 0.0"));
    const Outcome sum = train("cgp sum.rddl --gens 5");
    EXPECT_EQ(sum.status, 1);
    expect_part(sum.err, "the rewards of episode 0 add up to inf");
}

// A trace is a plan: in a problem without chance it leads to where it was recorded.
TEST_F(LearningProgram, ReplaysRecordedPlans) {
    const std::string car = " " RDDL_EXAMPLES "/mountain_car/domain.rddl " RDDL_EXAMPLES
                            "/mountain_car/instance.rddl --engine interpreter ";
    ASSERT_EQ(run("run" + car + "--policy random --seed 4 --trace plan.jsonl --quiet").status, 0);
    const json random = run_json("run" + car + "--policy random --seed 4 --json");
    const json plan = run_json("run" + car + "--policy plan.jsonl --json");
    EXPECT_EQ(plan["return"]["mean"], random["return"]["mean"]);
    const json compared =
        run_json("compare" + car + "--policies noop,plan.jsonl --episodes 3 --json");
    EXPECT_EQ(compared["policies"][1]["return"]["max"], random["return"]["mean"]);
    EXPECT_NE(compared["policies"][0]["return"]["max"], random["return"]["mean"]);
    // A trace of another problem, or without actions, is refused.
    EXPECT_NE(run(on_tanks("evaluate", "--policy plan.jsonl")).err.find("plan.jsonl', line 1"),
              std::string::npos);
    write_file(folder_ / "empty.jsonl", "\n");
    EXPECT_NE(run(on_tanks("evaluate", "--policy empty.jsonl")).err.find("it holds no actions"),
              std::string::npos);
}

// Width and height in the header of a PNG file.
std::pair<int, int> png_size(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t i = at; i < at + 4; ++i)
            value = value * 256 + static_cast<unsigned char>(bytes.at(i));
        return value;
    };
    return bytes.starts_with("\x89PNG") ? std::pair{number(16), number(20)} : std::pair{0, 0};
}

TEST_F(LearningProgram, DrawsLearningCurvesAndComparisons) {
    for (const char* const seed : {"0", "1"})
        ASSERT_EQ(run(on_tanks("train cgp", fmt::format("--gens 20 --seed {0} --quiet --out "
                                                        "runs/tanks_cgp_{0} {1}",
                                                        seed, small_cgp)))
                      .status,
                  0);
    const Outcome plotted = run("plot runs --png a.png --svg a.svg --size 640x480");
    if (plotted.err.find("without pictures") != std::string::npos) GTEST_SKIP() << plotted.err;
    ASSERT_EQ(plotted.status, 0) << plotted.err;
    EXPECT_EQ(plotted.out, "wrote a.png\nwrote a.svg\n");
    EXPECT_EQ(png_size(read_file(folder_ / "a.png")), (std::pair{640, 480}));
    EXPECT_NE(read_file(folder_ / "a.svg").find("<svg"), std::string::npos);
    // A band about one curve, or two curves.
    ASSERT_EQ(run("plot runs/tanks_cgp_0/ runs/tanks_cgp_1 --size 640x480 --png b.png").status, 0);
    // A number in a name that is not the seed does not group runs: two curves, though the runs are
    // the same.
    std::filesystem::create_directories(folder_ / "lambdas");
    for (const char* const children : {"4", "8"})
        std::filesystem::copy(folder_ / "runs/tanks_cgp_0",
                              folder_ / "lambdas" / ("lambda_" + std::string(children)),
                              std::filesystem::copy_options::recursive);
    const std::string lambdas = "plot lambdas/lambda_4 lambdas/lambda_8 --size 640x480 ";
    ASSERT_EQ(run(lambdas + "--png l.png").status, 0);
    ASSERT_EQ(run(lambdas + "--png each.png --each").status, 0);
    EXPECT_EQ(read_file(folder_ / "l.png"), read_file(folder_ / "each.png"));
    write_file(folder_ / "lambdas/lambda_4/run.json", "{\"seed\": -1}");
    EXPECT_NE(run("plot lambdas/lambda_4").err.find("does not state the seed"), std::string::npos);
    ASSERT_EQ(run("plot runs --each --size 640x480 --png c.png").status, 0);
    EXPECT_NE(read_file(folder_ / "a.png"), read_file(folder_ / "c.png"));
    const Outcome wrong = run("plot runs --y rollout/loss");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("has no column 'rollout/loss'"), std::string::npos) << wrong.err;
    EXPECT_EQ(run("plot nowhere").status, 2);
    ASSERT_EQ(run(on_tanks("compare", "--policies noop,random --episodes 9 --png d.png")).status,
              0);
    EXPECT_EQ(png_size(read_file(folder_ / "d.png")), (std::pair{900, 600}));
}

TEST_F(LearningProgram, ExportsWhatItLearned) {
    ASSERT_EQ(
        run(on_tanks("train cgp", "--gens 5 --quiet --out c " + std::string(small_cgp))).status, 0);
    for (const char* const form : {"formula", "cpp", "dot", "py", "latex"}) {
        const Outcome outcome = run(on_tanks("export", "--policy c --as " + std::string(form)));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.out.find("pump"), std::string::npos) << form;
    }
    ASSERT_EQ(
        run(on_tanks("train ppo", "--steps 400 --quiet --out p " + std::string(small_ppo))).status,
        0);
    ASSERT_EQ(run(on_tanks("train ppo",
                           "--steps 400 --recurrent 5 --quiet --out r " + std::string(small_ppo)))
                  .status,
              0);
    for (const char* const policy : {"r", "p"}) {
        for (const char* const form : {"json", "cpp", "onnx"})
            EXPECT_EQ(run(on_tanks("export",
                                   fmt::format("--policy {0} --as {1} -o out.{1}", policy, form)))
                          .status,
                      0);
        EXPECT_EQ(read_file(folder_ / "out.json"),
                  read_file(folder_ / fmt::format("{}/policy.json", policy)));
    }
    EXPECT_GT(read_file(folder_ / "out.onnx").size(), 500u);
    // Evaluations say so if random actions had a much higher return during learning.
    for (const auto& [returns, is_told] :
         {std::pair{"1000000", true}, {"-1000000", false}, {"x", false}}) {
        write_file(folder_ / "p/progress.csv", fmt::format("rollout/ep_rew_mean\n{}\n", returns));
        const Outcome likeliest = run(on_tanks("evaluate", "--policy p"));
        EXPECT_EQ(likeliest.err.find("as --stochastic takes them") != std::string::npos, is_told);
        const Outcome random = run(on_tanks("evaluate", "--policy p --stochastic"));
        EXPECT_EQ(random.err.find("--stochastic"), std::string::npos) << random.err;
    }
    const Outcome wrong = run(on_tanks("export", "--policy p --as dot"));
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("json, cpp and onnx are"), std::string::npos) << wrong.err;
}

TEST_F(LearningProgram, RefusesWhatCannotBe) {
    const auto refuses = [&](const std::string& arguments, const std::string& sentence) {
        const Outcome outcome = run(arguments);
        EXPECT_NE(outcome.status, 0) << arguments;
        EXPECT_NE(outcome.err.find(sentence), std::string::npos) << arguments << "\n"
                                                                 << outcome.err;
    };
    refuses("train", "name a command");
    refuses("train pso", "no command is called 'pso'");
    refuses("train sac", "no command is called 'sac'; 'rddl train' has ppo and cgp");
    refuses("help train sac", "'rddl train' has ppo and cgp");
    refuses(on_tanks("train ppo", "--envs 2 --rollout 4"), "a minibatch is larger");
    refuses(on_tanks("train ppo", "--recurrent 8 --rollout 1 --minibatch 9"),
            "a recurrent network learns from several steps in a row");
    refuses(on_tanks("train ppo", "--recurrent -1"), "--recurrent");
    refuses(on_tanks("train ppo", "--hidden ,"), "--hidden: a value is missing in ','");
    refuses(on_tanks("train ppo", "--activation gelu"), "--activation");
    refuses(on_tanks("train ppo", "--recurrent 8 --segment 1"), "--segment");
    refuses(on_tanks("train ppo", "--envs 1048576"), "PPO would take about ");
    refuses(on_tanks("train ppo", "--envs 1048576"),
            "try a smaller --rollout, --envs or --stack, or a larger --memory-limit");
    refuses(on_tanks("train ppo", "--recurrent 16384"), "try smaller --hidden, --recurrent");
    refuses(on_tanks("train ppo", "--envs 1048576 --rollout 1048576"), "less than 2^31 steps");
    refuses(on_tanks("train cgp", "--lambda 65536 --episodes 1000000"),
            "try a smaller --lambda, --episodes or --islands, or a larger --memory-limit");
    refuses(on_tanks("train cgp", "--cols 1000000 --lambda 60000"), "CGP would take about ");
    // Fewer steps are made unless the user asks for so many.
    const Outcome fitting = run(on_tanks("train ppo", "--steps 100 --memory-limit 2M --out f"));
    EXPECT_EQ(fitting.status, 0) << fitting.err;
    expect_part(fitting.err, " in place of 128, since this problem is large");
    refuses(on_tanks("train cgp", "--functions add,nothing"), "'nothing' is not a CGP function");
    refuses(on_tanks("train ppo", "--resume --out nowhere"), "cannot read");
    refuses(on_tanks("evaluate", "--policy nothing"), "neither random, noop, rddl");
    write_file(folder_ / "broken.json",
               R"({"format": "rddl-policy", "solver": "ppo", "version": 1})");
    refuses(on_tanks("evaluate", "--policy broken.json"), "something in it is missing");
}

}  // namespace
}  // namespace rddlc::cli
