// Policies and checkpoints that meet a simulator: which they fit, and which files are refused.
#include "program.hpp"

#include <chrono>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rddlc::cli {
namespace {

using nlohmann::json;

constexpr const char* quick_ppo =
    " --envs 16 --rollout 24 --minibatch 192 --epochs 2 --hidden 8 --evaluations 2 "
    "--evaluation-episodes 4 --quiet";
constexpr const char* quick_cgp =
    " --lambda 4 --cols 20 --episodes 4 --evaluations 2 --evaluation-episodes 4 --quiet";

class PolicyFiles : public Program {
  protected:
    static std::string on(const std::string& instance, const std::string& options) {
        return " domain.rddl " + instance + interpreted + " " + options;
    }
    Outcome train(const std::string& solver, const std::string& options,
                  const std::string& instance = "instance.rddl") const {
        return run("train " + solver + on(instance, options) +
                   (solver == "ppo" ? quick_ppo : quick_cgp));
    }
    void change(const char* file, const std::string& from, const std::string& to) const {
        std::string text = read_file(folder_ / file);
        const std::size_t at = text.find(from);
        ASSERT_NE(at, text.npos) << from;
        write_file(folder_ / file, text.replace(at, from.size(), to));
    }
    void restore() const {
        write_file(folder_ / "domain.rddl", tanks_domain);
        write_file(folder_ / "instance.rddl", tanks_instance);
    }
    void refuses(const Outcome& outcome, const std::string& part) const {
        EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << outcome.status << outcome.err;
        expect_part(outcome.err, part);
    }
};

TEST_F(PolicyFiles, AreResumedInTheSameDynamicsOnly) {
    struct Change {
        const char *file, *from, *to, *told;
    };
    const std::vector<Change> changes = {
        {"domain.rddl", "then 2.0 else", "then 3.0 else", "a CPF, the reward"},
        {"domain.rddl", "reward = (", "reward = 1.0 + (", "a CPF, the reward"},
        {"domain.rddl", "extra <= 1.0", "extra <= 2.0", "observations or actions have changed"},
        {"domain.rddl", "<= 8.0", "<= 7.0", "a CPF, the reward, a condition"},
        {"domain.rddl", "[water(?t) < 0.0]", "[water(?t) < -1.0]", "a condition"},
        {"domain.rddl", "real, default = 5.0", "real, default = 6.0", "the initial state"},
        {"instance.rddl", "LEAK(t2) = 0.25", "LEAK(t2) = 0.5", "a non-fluent"},
        {"instance.rddl", "t3 }", "t3, t4 }", "observations or actions have changed"},
        {"instance.rddl", "horizon = 12", "horizon = 13", "the horizon was 12 and is 13"},
        {"instance.rddl", "discount = 0.9", "discount = 0.5", "the discount was 0.9 and is 0.5"},
        {"instance.rddl", "instance tanks_1", "instance tanks_2",
         "it is of the problem tanks_1 (tanks), not of tanks_2 (tanks)"}};
    for (const auto& [solver, begun, whole] : {std::tuple{"ppo", "--steps 400", "--steps 800"},
                                               std::tuple{"cgp", "--gens 4", "--gens 8"}}) {
        const std::string out = fmt::format(" --out {}", solver);
        ASSERT_EQ(train(solver, begun + out).status, 0);
        for (const Change& each : changes) {
            change(each.file, each.from, each.to);
            const Outcome outcome = train(solver, whole + out + " --resume");
            EXPECT_EQ(outcome.status, 1) << each.from;
            expect_part(outcome.err, each.told);
            restore();
        }
        change("domain.rddl", "reward =", "// the same problem\n    reward   =");
        EXPECT_EQ(train(solver, whole + out + " --resume --no-cache --pass=none").status, 2);
        const Outcome same = train(solver, whole + out + " --resume");
        EXPECT_EQ(same.status, 0) << same.err;
        restore();
    }
}

// Compiled and interpreted simulators of a problem are the same problem.
TEST_F(PolicyFiles, AreResumedByAnotherEngine) {
    ASSERT_EQ(train("cgp", "--gens 4 --out c").status, 0);
    const Outcome compiled =
        run("train cgp domain.rddl instance.rddl --engine compiled --gens 8 "
            "--out c --resume" +
            std::string(quick_cgp));
    EXPECT_EQ(compiled.status, 0) << compiled.err;
}

TEST_F(PolicyFiles, ActInOtherInstancesOfTheSameSpaces) {
    std::string text = tanks_instance;
    text.replace(text.find("tanks_1"), 7, "tanks_2");
    text.replace(text.find("0.25"), 4, "0.75");
    text.replace(text.find("horizon = 12"), 12, "horizon = 15");
    write_file(folder_ / "leaky.rddl", text);
    text.replace(text.find("t1, t2, t3"), 10, "t1, t2, t3, t4");
    write_file(folder_ / "larger.rddl", text);
    ASSERT_EQ(train("ppo", "--steps 400 --out ppo").status, 0);
    ASSERT_EQ(train("cgp", "--gens 4 --lifted off --out flat").status, 0);
    ASSERT_EQ(train("cgp", "--gens 4 --lifted on --out lifted").status, 0);
    for (const std::string policy : {"ppo", "flat", "lifted"})
        for (const std::string command : {"run", "evaluate", "export"}) {
            const std::string options = "--policy " + policy;
            const Outcome acts = run(command + on("leaky.rddl", options));
            EXPECT_EQ(acts.status, 0) << acts.err;
            const Outcome larger = run(command + on("larger.rddl", options));
            if (policy == "lifted")
                EXPECT_EQ(larger.status, 0) << larger.err;
            else
                refuses(larger, "whose observations or actions differ from those of tanks_2");
        }
    change("domain.rddl", "domain tanks", "domain basins");
    for (const char* const file : {"instance.rddl", "larger.rddl"}) {
        change(file, "domain = tanks", "domain = basins");
        change(file, "domain = tanks", "domain = basins");
    }
    refuses(run("evaluate" + on("instance.rddl", "--policy ppo")), "it is of the problem tanks_1");
    for (const std::string policy : {"flat", "lifted"})
        refuses(run("evaluate" + on("larger.rddl", "--policy " + policy)),
                "it is of the domain tanks, not of basins");
}

TEST_F(PolicyFiles, OfTwoInAFolderRunJsonSaysWhich) {
    ASSERT_EQ(train("cgp", "--gens 4 --out r").status, 0);
    ASSERT_EQ(train("ppo", "--steps 400 --out p").status, 0);
    std::filesystem::copy(folder_ / "p/policy.json", folder_ / "r/policy.json");
    const auto mean_of = [&](const std::string& policy) {
        const json told = run_json("evaluate" + on("instance.rddl", "--json --policy " + policy));
        return told["policies"][0]["return"]["mean"].get<double>();
    };
    ASSERT_NE(mean_of("r/policy.cgp"), mean_of("r/policy.json"));
    EXPECT_EQ(mean_of("r"), mean_of("r/policy.cgp"));
    std::filesystem::copy(folder_ / "p/run.json", folder_ / "r/run.json",
                          std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(mean_of("r"), mean_of("r/policy.json"));
    std::filesystem::remove(folder_ / "r/run.json");
    refuses(run("evaluate" + on("instance.rddl", "--policy r")),
            "holds policy.cgp and policy.json, and no run.json that says which");
}

TEST_F(PolicyFiles, OfAFolderWhoseRunJsonMakesNoSenseAreRefused) {
    ASSERT_EQ(train("cgp", "--gens 4 --out r").status, 0);
    const std::pair<std::string, const char*> wrong[] = {
        {"", "is not the JSON of a run"},
        {"[]", "is not the JSON of a run: it is not an object"},
        {"{\"solver\":1}", "'solver' is a text, not 1"},
        {"{\"solver\":\"cgp\",\"domain\":[2]}", "'domain' is a text, not an array"},
        {"{\"solver\":\"x\"}", "'x' is not ppo, cgp or drp"},
        {"{\"seed\":1}", "does not state the solver of a run"},
        {"1e999", "is not the JSON of a run"},
        {"{\"solver\":\"ppo\"}", "there is no policy.json in the folder 'r'"}};
    for (const auto& [run_json, message] : wrong) {
        write_file(folder_ / "r/run.json", run_json);
        refuses(run("evaluate" + on("instance.rddl", "--policy r")), message);
    }
    std::filesystem::remove(folder_ / "r/run.json");
    EXPECT_EQ(run("evaluate" + on("instance.rddl", "--policy r")).status, 0);
}

TEST_F(PolicyFiles, OfAnEarlierRunAreRemovedOnceThereAreNewOnes) {
    ASSERT_EQ(train("cgp", "--gens 4 --out r").status, 0);
    write_file(folder_ / "r/notes.cgp", "mine");
    write_file(folder_ / "r/best.json", "mine");
    refuses(train("ppo", "--steps 400 --out r"), "holds a run already");
    std::filesystem::remove(folder_ / "r/checkpoint");
    // A run that does not begin leaves everything.
    refuses(run("train ppo" + on("instance.rddl", "--minibatch 9999999 --quiet --out r")),
            "a minibatch is larger");
    for (const char* const left : {"policy.cgp", "last.cgp", "run.json", "progress.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "r" / left)) << left;
    ASSERT_EQ(train("ppo", "--steps 400 --out r").status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "r/policy.cgp"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "r/last.cgp"));
    EXPECT_EQ(read_file(folder_ / "r/notes.cgp"), "mine");
    EXPECT_EQ(read_file(folder_ / "r/best.json"), "mine");
    EXPECT_EQ(run("evaluate" + on("instance.rddl", "--policy r")).status, 0);
}

// Files that anybody may have written: a sentence, soon, and in little memory.
TEST_F(PolicyFiles, OfPpoWithWrongNumbersAreRefused) {
    ASSERT_EQ(train("ppo", "--steps 400 --recurrent 4 --out p").status, 0);
    const json policy = json::parse(read_file(folder_ / "p/policy.json"));
    const auto refuses_text = [&](const std::string& text, const std::string& sentence) {
        write_file(folder_ / "hostile.json", text);
        for (const char* const command : {"evaluate", "run", "export"}) {
            const Outcome outcome = run(command + on("instance.rddl",
                                                     "--policy hostile.json "
                                                     "--memory-limit 100M"),
                                        "prlimit --as=2000000000");
            EXPECT_EQ(outcome.status, 1) << command << " " << text.substr(0, 200);
            expect_part(outcome.err, sentence);
        }
    };
    const auto refuses_value = [&](const char* const pointer, const char* const value,
                                   const std::string& sentence) {
        json other = policy;
        other[json::json_pointer(pointer)] = "@";
        std::string text = other.dump();
        text.replace(text.find("\"@\""), 3, value);
        refuses_text(text, sentence);
    };
    const auto refuses_numbers = [&](const char* const pointer, const std::string& what) {
        for (const char* const value :
             {"20000000", "-1", "0", "2147483647", "4294967297", "18446744073709551617", "1.5",
              "true", "\"1\"", "null", "[1]"})
            refuses_value(pointer, value, what);
    };
    refuses_numbers("/version", "version ");
    refuses_numbers("/observation/stack", "its stack is ");
    refuses_numbers("/noise_steps", "its number of steps with the same noise is ");
    refuses_value("/version", "7", "it is of version 7, and this program reads versions up to 6");
    refuses_value("/version", "1.7", "its version is 1.7, not an int from 1 to 6");
    for (const char* const units : {"-1", "0", "64.5", "2147483647", "1e400", "\"8\"", "null"})
        for (const char* const pointer : {"/hidden/0", "/recurrent/units"})
            refuses_value(pointer, units,
                          std::string(units) == "1e400" ? "number overflow parsing '1e400'"
                                                        : "its number of units is ");
    refuses_value("/hidden/0", "9", "its layers do not fit");
    refuses_value("/hidden", "[]", "its layers do not fit");
    for (const char* const weight : {"3e38", "-3e38", "1e39", "2e37"})
        for (const char* const pointer :
             {"/policy/0/weights/0/0", "/policy/0/bias/0", "/value/1/weights/0/0",
              "/recurrent/reset/input/0/0", "/recurrent/reset/state/0/0", "/observation/means/0",
              "/observation/factors/0"})
            refuses_value(pointer, weight, "a number in it is too large for a weight");
    refuses_value("/policy/0/weights/0/0", "true", "its weight is not a number");
    refuses_value("/log_deviations/0", "100", "its noise is too large");
    refuses_value("/correlation", "1.5", "its correlation is 1.5, not from 0 to 1");
    refuses_text(std::string(200'000, '['), "more than 256 brackets");
    refuses_text("[" + std::string(20'000'000, ',') + "]", "more than the limit of 100 MiB");
    // A small file whose layers would be large.
    json wide = policy;
    wide.erase("recurrent");
    wide["hidden"] = {40'000, 40'000};
    const json layer = {{"weights", json::array()}, {"bias", std::vector<int>(40'000, 0)}};
    wide["policy"] = {layer, layer, policy["policy"][1]};
    refuses_text(wide.dump(), "its layers do not fit");
}

TEST_F(PolicyFiles, OfCgpWithWrongNumbersAreRefused) {
    ASSERT_EQ(train("cgp", "--gens 4 --lifted off --out c").status, 0);
    const std::string program = read_file(folder_ / "c/policy.cgp");
    const auto refuses_number = [&](const std::string& word, const std::string& number) {
        std::string text = program;
        const std::size_t at = text.find("\n" + word + " ") + word.size() + 2;
        text.replace(at, text.find_first_of(" \n", at) - at, number);
        write_file(folder_ / "hostile.cgp", text);
        const Outcome outcome =
            run("evaluate" + on("instance.rddl", "--policy hostile.cgp --memory-limit 100M"),
                "prlimit --as=2000000000");
        EXPECT_EQ(outcome.status, 1) << word << " " << number;
        expect_part(outcome.err, "cannot act by 'hostile.cgp': ");
    };
    for (const char* const word : {"inputs", "constants", "nodes", "outputs", "output", "lifted"})
        for (const char* const number : {"-1", "2147483647", "4294967297", "1.7", "1e1", "x"})
            refuses_number(word, number);
    for (const char* const number : {"16777216", "16777215"}) refuses_number("nodes", number);
    for (const char* const number : {"1e400", "nan", "inf", "1.5x"}) {
        refuses_number("input", number);
        refuses_number("constant", number);
    }
    write_file(folder_ / "hostile.cgp", "rddl-cgp 1.7" + program.substr(program.find('\n')));
    refuses(run("evaluate" + on("instance.rddl", "--policy hostile.cgp")),
            "the number behind 'rddl-cgp' is not an int");
}

// Episode e plays the actions of the trace's episode e; after the last one comes the first again.
TEST_F(PolicyFiles, TracesPlayEachEpisodeByItself) {
    const auto lines_of = [&](const std::string& file, int episode) {
        std::string actions;
        std::istringstream lines(read_file(folder_ / file));
        for (std::string line; std::getline(lines, line);) {
            const json step = json::parse(line);
            if (step.value("episode", -1) == episode && step.contains("action"))
                actions += step["action"].dump() + "\n";
        }
        return actions;
    };
    const std::string quiet = "--quiet --trace ";
    change("domain.rddl", "termination { exists_{?t : tank} [water(?t) < 0.0]; };", "");
    ASSERT_EQ(run("run" + on("instance.rddl", "--episodes 3 --seed 5 " + quiet + "t.jsonl")).status,
              0);
    ASSERT_NE(lines_of("t.jsonl", 0), lines_of("t.jsonl", 1));
    const std::string play = "--policy t.jsonl --seed 9 --batch 2 --trace ";
    const Outcome played = run("run" + on("instance.rddl", "--episodes 7 " + play + "p.jsonl"));
    ASSERT_EQ(played.status, 0) << played.err;
    expect_part(played.err, "note: 't.jsonl' has 3 episodes, which the 7 play in turn");
    for (int episode = 0; episode < 7; ++episode)
        EXPECT_EQ(lines_of("p.jsonl", episode), lines_of("t.jsonl", episode % 3)) << episode;
    const Outcome fewer = run("run" + on("instance.rddl", "--episodes 2 " + play + "q.jsonl"));
    EXPECT_EQ(fewer.err.find("note"), std::string::npos) << fewer.err;
    EXPECT_EQ(lines_of("q.jsonl", 1), lines_of("t.jsonl", 1));
}

// So many bools that one choice of a learner takes minutes: Ctrl-C is heard all the same.
TEST_F(PolicyFiles, CtrlCIsHeardWithinAChoiceAmongThousands) {
    std::string things = "t0";
    for (int t = 1; t < 3000; ++t) things += fmt::format(", t{}", t);
    const auto problem = [&](const std::string& conditions) {
        return "domain many { types { thing : object; }; pvariables {\n"
               "  on(thing) : { state-fluent, bool, default = false };\n"
               "  set(thing) : { action-fluent, bool, default = false }; };\n"
               "  cpfs { on'(?t) = set(?t) ^ Bernoulli(0.5); };\n"
               "  reward = sum_{?t : thing} on(?t);" +
               conditions + "}\n non-fluents n { domain = many; objects { thing : { " + things +
               " }; }; }\n instance i { domain = many; non-fluents = n;\n"
               " max-nondef-actions = 2500; horizon = 20; discount = 1.0; }\n";
    };
    write_file(folder_ / "free.rddl", problem(""));
    write_file(folder_ / "tied.rddl",
               problem(" action-preconditions { (sum_{?t : thing} set(?t)) <= 1; };"));
    constexpr int seconds = 2;
    int number = 0;
    for (const char* const file : {"free.rddl", "tied.rddl"})
        for (const char* const solver :
             {"ppo --steps 1e12 --envs 64 --rollout 2 --minibatch 64", "cgp --gens 1000000"}) {
            const auto begin = std::chrono::steady_clock::now();
            const Outcome outcome =
                run(fmt::format("train {} {} {} --quiet --out o{}", solver, file, interpreted,
                                number++),
                    fmt::format("timeout --preserve-status -s INT -k 60 {}", seconds));
            const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
            EXPECT_EQ(outcome.status, 130) << file << " " << solver << outcome.err;
            EXPECT_LT(taken.count(), seconds + 15) << file << " " << solver;
        }
}

// Each of many objects may get one of many, so random actions give most of them one: they are not
// drawn freely and repaired until hardly any is left.
TEST_F(PolicyFiles, RandomActionsKnowWhatExcludesEachOther) {
    std::string items = "i0", people = "p0";
    for (int i = 1; i < 30; ++i) {
        items += fmt::format(", i{}", i);
        people += fmt::format(", p{}", i);
    }
    write_file(
        folder_ / "shop.rddl",
        "domain shop { types { person : object; item : object; }; pvariables {\n"
        "  sold : { state-fluent, int, default = 0 };\n"
        "  show(person, item) : { action-fluent, bool, default = false }; };\n"
        "  cpfs { sold' = sold + (sum_{?p : person, ?i : item} show(?p, ?i)); };\n"
        "  reward = sum_{?p : person, ?i : item} show(?p, ?i);\n"
        "  action-preconditions { forall_{?p : person} [(sum_{?i : item} show(?p, ?i)) <= 1]; "
        "}; }\n"
        "non-fluents n { domain = shop; objects { person : { " +
            people + " }; item : { " + items +
            " }; }; }\n"
            "instance i { domain = shop; non-fluents = n; max-nondef-actions = pos-inf;\n"
            "  horizon = 10; discount = 1.0; }\n");
    const std::string options = std::string("run shop.rddl --episodes 20 --json") + interpreted;
    const json ran = run_json(options);
    EXPECT_EQ(ran["illegal_actions"], 0);
    // 30 persons, 10 steps: with 31 choices each, 290 are expected, and a deviation below 1.
    EXPECT_NEAR(ran["return"]["mean"].get<double>(), 290.3, 5.0);
    EXPECT_EQ(without_speed(run_json(options + " --threads 2 --batch 3")), without_speed(ran));
}

}  // namespace
}  // namespace rddlc::cli
