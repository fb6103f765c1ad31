// --stats and --without.
#include "passes/passes.hpp"
#include "run_rddlc.hpp"

#include <nlohmann/json.hpp>

namespace rddlc::testing {
namespace {

using nlohmann::json;

class Statistics : public RddlcTest {
  protected:
    // A table of equal entries, which two passes take away.
    Statistics() {
        write("domain.rddl",
              "domain lamp { types { lamp : object; };\n"
              "pvariables { W(lamp) : { non-fluent, real, default = 2.0 };\n"
              "    x(lamp) : { state-fluent, real, default = 0.0 }; };\n"
              "cpfs { x'(?l) = x(?l) + W(?l); }; reward = 0.0; }");
    }
    json statistics(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {"domain.rddl", "instance.rddl", "--stats=json"};
        words.insert(words.end(), more.begin(), more.end());
        return json::parse(rddlc(words).output);
    }
};

TEST_F(Statistics, TellWhatEachPassDid) {
    const std::string text = rddlc({"domain.rddl", "instance.rddl", "--stats"}).output;
    EXPECT_EQ(text.substr(0, text.find(' ')), "pass") << text;
    EXPECT_NE(text.find("tables made scalars: 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("constant tables removed: 1\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("struct Simulator"), std::string::npos) << "the C++ text is not asked for";
}

TEST_F(Statistics, AreJsonOnRequest) {
    const json runs = statistics();
    std::set<std::string> names;
    for (const json& run : runs) {
        names.insert(run["pass"]);
        EXPECT_GE(run["milliseconds"], 0.0);
        if (run["pass"] != "fold_uniform_tables") continue;
        EXPECT_EQ(run["did"], json({{"tables made scalars", 1}}));
        EXPECT_LE(run["nodes"]["after"], run["nodes"]["before"]);
        EXPECT_LT(run["operations"]["after"], run["operations"]["before"]);
    }
    for (const PassDescription& pass : all_passes()) {
        EXPECT_EQ(names.contains(std::string(pass.name)), !pass.only_fast_math) << pass.name;
    }
}

TEST_F(Statistics, ComeBesideTheOutput) {
    const auto result = rddlc({"domain.rddl", "instance.rddl", "--stats", "-o", "sim.cpp"});
    EXPECT_EQ(result.output.substr(0, 4), "pass");
    EXPECT_EQ(read("sim.cpp").substr(0, 2), "//");
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", "--stats=xml"}).status, 2);
}

TEST_F(Statistics, ShowWhichPassesRan) {
    for (const json& run : statistics({"--without=fold_uniform_tables,share_subexpressions"})) {
        EXPECT_NE(run["pass"], "fold_uniform_tables");
        EXPECT_NE(run["pass"], "share_subexpressions");
    }
    const std::string text =
        rddlc({"domain.rddl", "instance.rddl", "--print=ir-opt", "--without=fold_uniform_tables"})
            .output;
    EXPECT_NE(text.find("next.x[l] = state.x[l] + W[l]"), std::string::npos) << text;
}

// The emitter needs the results of one pass.
TEST_F(Statistics, WithoutAllPassesAreOfTheOneThatAlwaysRuns) {
    std::string all;
    for (const PassDescription& pass : all_passes()) all += "," + std::string(pass.name);
    const std::string without = "--without=" + all.substr(1);
    const json runs = statistics({without});
    ASSERT_EQ(runs.size(), 1u) << runs;
    EXPECT_EQ(runs[0]["pass"], "choose_evaluation");
    EXPECT_EQ(rddlc({"domain.rddl", "instance.rddl", without, "--print=ir-opt"}).output,
              rddlc({"domain.rddl", "instance.rddl", "--print=ir"}).output);
}

TEST_F(Statistics, NamesOfPassesAreChecked) {
    const auto result = rddlc({"domain.rddl", "instance.rddl", "--without=fold_uniform_table"});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.output.find("there is no pass 'fold_uniform_table'; did you mean "
                                 "'fold_uniform_tables'?"),
              std::string::npos)
        << result.output;
    const std::string help = rddlc({"--help"}).output;
    for (const PassDescription& pass : all_passes()) {
        EXPECT_NE(help.find(pass.name), std::string::npos) << pass.name;
    }
}

}  // namespace
}  // namespace rddlc::testing
