// The output of `rddl bench`, and its calls of other simulators.
#include "program.hpp"

#include <array>
#include <vector>

namespace rddlc::cli {
namespace {

using nlohmann::json;

constexpr const char* briefly = "bench domain.rddl instance.rddl --seconds 0.01 ";

class Bench : public Program {
  protected:
    // A Python whose programs all print this as their last line.
    void pretend_python(const std::string& last_line, int status = 0) const {
        write_file(folder_ / "python",
                   fmt::format("#!/bin/sh\necho \"$@\" >> asked\necho WARNING: noise\n"
                               "echo '{}'\nexit {}\n",
                               last_line, status));
        std::filesystem::permissions(folder_ / "python", std::filesystem::perms::owner_all);
    }
    std::string asked() const { return read_file(folder_ / "asked"); }
};

using Shape = std::array<std::int64_t, 3>;

// Environments, lanes and threads.
std::vector<Shape> shapes(const json& measurements) {
    std::vector<Shape> all;
    for (const json& m : measurements) all.push_back({m["environments"], m["lanes"], m["threads"]});
    return all;
}

void expect_speeds(const json& measurements) {
    for (const json& m : measurements) {
        EXPECT_GT(m["steps"], 0);
        EXPECT_GE(m["seconds"], 0.01);
        EXPECT_GT(m["processor_seconds"], 0);
        // Two clocks differ a little.
        EXPECT_LT(m["processor_seconds"],
                  (m["seconds"].get<double>() + 0.01) * m["threads"].get<int>());
        EXPECT_NEAR(m["steps_per_second"].get<double>(),
                    m["steps"].get<double>() / m["seconds"].get<double>(), 1e-6);
    }
}

TEST_F(Bench, TellsOfFaults) {
    const std::string bench =
        "bench faulty.rddl --seconds 0.01 --batch 16 --threads 1 --engine interpreter";
    write_file(folder_ / "faulty.rddl", faulty_problem("1.0"));
    const Outcome all = run(bench);
    EXPECT_EQ(all.status, 1);
    EXPECT_TRUE(all.err.starts_with("rddl: error: ")) << all.err;
    EXPECT_NE(all.err.find(" episodes ended with a fault"), std::string::npos) << all.err;
    const json told = run_json(bench + " --json", 1);
    EXPECT_GT(told["episodes"], 16);
    EXPECT_EQ(told["faulted"], told["episodes"]);

    write_file(folder_ / "faulty.rddl", faulty_problem("0.3"));
    const Outcome some = run(bench);
    EXPECT_EQ(some.status, 0);
    EXPECT_TRUE(some.err.starts_with("rddl: warning: ")) << some.err;
    write_file(folder_ / "faulty.rddl", faulty_problem("0.0"));
    EXPECT_EQ(run(bench).err, "");
}

TEST_F(Bench, TellsAsJson) {
    const json bench =
        run_json(std::string(briefly) + "--batch 16,7 --threads 3 --json --no-cache");
    EXPECT_EQ(bench["problem"], "domain.rddl instance.rddl");
    EXPECT_EQ(bench["engine"], "compiled");
    EXPECT_EQ(bench["real"], "double");
    EXPECT_GT(bench["rddlc_seconds"], 0);
    EXPECT_GT(bench["cxx_seconds"], 0);
    EXPECT_GT(bench["first_step_seconds"], bench["cxx_seconds"]);
    EXPECT_GT(bench["emitted_lines"], 50);
    EXPECT_GT(bench["emitted_bytes"], bench["emitted_lines"]);
    EXPECT_GT(bench["object_bytes"], 1000);
    const std::int64_t lanes = bench["lanes"];
    EXPECT_GE(lanes, 1);
    EXPECT_NE(bench["instruction_set"], "");
    std::vector<Shape> expected{{1, 1, 1}};
    for (const std::int64_t batch : {16, 7}) {
        if (lanes > 1) expected.push_back({batch, 1, 1});
        for (const std::int64_t threads : {1, 2, 3}) expected.push_back({batch, lanes, threads});
    }
    EXPECT_EQ(shapes(bench["measurements"]), expected);
    expect_speeds(bench["measurements"]);
    EXPECT_EQ(bench["peers"], json::array());
#ifdef __GLIBC__
    // At least the state: three reals, an int and an object.
    EXPECT_GE(bench["bytes_per_environment"], 5 * 8);
#endif
}

TEST_F(Bench, TakesTheNumberOfLanes) {
    const json bench = run_json(std::string(briefly) + "--lanes 64 --batch 64 --threads 1 --json");
    EXPECT_EQ(bench["lanes"], 64);
    const std::vector<Shape> expected{{1, 1, 1}, {64, 1, 1}, {64, 64, 1}};
    EXPECT_EQ(shapes(bench["measurements"]), expected);
}

TEST_F(Bench, NotesWhereLanesHaveNoEffect) {
    const Outcome outcome =
        run(std::string(briefly) + "--lanes 64 --batch 64 --threads 1" + interpreted);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err,
              "rddl: note: --lanes 64 has no effect: the interpreter steps one environment at a "
              "time\n");
}

TEST_F(Bench, TellsWhenNothingWasCompiled) {
    const std::string command = std::string(briefly) + "--threads 1 --batch 4 ";
    EXPECT_EQ(run(command).status, 0);
    const json again = run_json(command + "--json");
    EXPECT_EQ(again["cxx_seconds"], nullptr);
    EXPECT_EQ(again["first_step_seconds"], nullptr);
    EXPECT_NE(run(command).out.find("spared by the cache (--no-cache measures it)"),
              std::string::npos);
}

TEST_F(Bench, TellsThatItComputesInFloats) {
    const std::string command = std::string(briefly) + "--real=float --threads 1 --batch 4 ";
    EXPECT_EQ(run_json(command + "--json")["real"], "float");
    EXPECT_NE(run(command).out.find("reals         float\n"), std::string::npos);
}

TEST_F(Bench, MeasuresTheInterpreter) {
    const json bench =
        run_json(std::string(briefly) + "--engine=interpreter --threads 1 --batch 4 --json");
    EXPECT_EQ(bench["engine"], "interpreter");
    EXPECT_EQ(bench["cxx_seconds"], nullptr);
    EXPECT_GT(bench["first_step_seconds"], bench["rddlc_seconds"]);
    EXPECT_EQ(bench["emitted_lines"], 0);
    expect_speeds(bench["measurements"]);
}

TEST_F(Bench, AsksOthers) {
    pretend_python(
        R"({"name": "slow", "version": "1.2", "import_seconds": 0.5, "first_step_seconds": 2.0, )"
        R"("measurements": [{"environments": 4, "threads": 1, "steps": 50, "seconds": 1.0}]})");
    const std::string command = std::string(briefly) +
                                "--threads 1 --batch 4 --engine=interpreter --python ./python "
                                "--against=pyrddlgym,jax ";
    const json bench = run_json(command + "--json");
    ASSERT_EQ(bench["peers"].size(), 2);
    const json& peer = bench["peers"][0];
    EXPECT_EQ(peer["name"], "slow");
    EXPECT_EQ(peer["version"], "1.2");
    EXPECT_EQ(peer["import_seconds"], 0.5);
    EXPECT_EQ(peer["first_step_seconds"], 2.0);
    EXPECT_EQ(peer["measurements"][0]["steps_per_second"], 50);
    EXPECT_NE(asked().find("pyrddlgym_steps.py domain.rddl instance.rddl --seconds 0.01 --cores 1"),
              std::string::npos)
        << asked();
    EXPECT_NE(asked().find("jax_steps.py"), std::string::npos);

    const std::string table = run(command).out;
    EXPECT_NE(table.find("slow 1.2, best"), std::string::npos) << table;
    EXPECT_NE(table.find("first step 2.00 s after the files"), std::string::npos) << table;
}

TEST_F(Bench, MeasuresOthersWithOneCoreAndWithAll) {
    pretend_python(
        R"({"name": "n", "version": "1", "import_seconds": 1, "first_step_seconds": 1, )"
        R"("measurements": [{"environments": 1, "threads": 1, "steps": 50, "seconds": 1.0}]})");
    const std::string command =
        std::string(briefly) + "--threads 2 --batch 4 --engine=interpreter --python ./python ";
    EXPECT_EQ(run_json(command + "--against jax --json")["peers"][0]["measurements"].size(), 2);
    EXPECT_NE(asked().find("--cores 2"), std::string::npos);
}

TEST_F(Bench, TellsWhyOthersCannotBeMeasured) {
    const std::string command =
        std::string(briefly) + "--engine=interpreter --threads 1 --against=jax --python ";
    const Outcome missing = run(command + "/nowhere/python");
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.err.find("cannot run '/nowhere/python'"), std::string::npos) << missing.err;

    pretend_python(R"({"error": "no module", "missing": true})", 1);
    const Outcome bare = run(command + "./python");
    EXPECT_EQ(bare.status, 1);
    EXPECT_NE(bare.err.find("./python has no pyRDDLGym-jax"), std::string::npos) << bare.err;
    EXPECT_NE(bare.err.find("pip install pyRDDLGym-jax"), std::string::npos) << bare.err;

    pretend_python(R"({"error": "Poisson?", "missing": false})", 1);
    const Outcome refused = run(command + "./python");
    EXPECT_NE(refused.err.find("pyRDDLGym-jax cannot run this problem: Poisson?"),
              std::string::npos)
        << refused.err;

    EXPECT_EQ(run(std::string(briefly) + "--against=nobody").status, 2);
}

}  // namespace
}  // namespace rddlc::cli
