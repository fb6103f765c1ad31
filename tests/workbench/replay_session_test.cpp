#include "rollouts/replay_session.hpp"

#include "../runtime/tiny_simulator.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace rddlc::workbench {
namespace {

using nlohmann::json;

class Replay : public testing::Test {
  protected:
    json answer(const std::string& line) {
        const std::string text = session_.answer(line);
        EXPECT_TRUE(text.ends_with('\n'));
        return json::parse(text);
    }
    std::string error(const std::string& line) { return answer(line).value("error", "no error"); }

    ReplaySession session_{*tiny::simulator(), {}};
};

TEST_F(Replay, StepsFromTheInitialStateWithDefaultActions) {
    const json first = answer("{}");
    const std::set<std::string> members{"observation", "reward", "state", "terminated",
                                        "truncated"};
    std::set<std::string> found;
    for (const auto& [name, value] : first.items()) found.insert(name);
    EXPECT_EQ(found, members);
    EXPECT_TRUE(first["observation"].is_null());
    EXPECT_EQ(first["state"]["mode"], "slow");
    EXPECT_EQ(first["state"]["repairs"], 0);
    EXPECT_FALSE(first["terminated"].get<bool>());
}

TEST_F(Replay, GoesOnFromTheLastState) {
    EXPECT_EQ(answer(R"({"action": {"repair___mill": true}})")["state"]["repairs"], 1);
    EXPECT_EQ(answer(R"({"action": {"repair___mill": true}})")["state"]["repairs"], 2);
    EXPECT_EQ(answer(R"({"action": {"set-mode": "@fast"}})")["state"]["mode"], "fast");
    EXPECT_EQ(answer("{}")["state"]["mode"], "slow") << "actions fall back to their default";
}

TEST_F(Replay, SetsTheStateBeforeTheStep) {
    const json after = answer(R"({"state": {"repairs": 10}, "action": {"repair___press": true}})");
    EXPECT_EQ(after["state"]["repairs"], 11);
}

TEST_F(Replay, RefusesALineAndGoesOn) {
    EXPECT_NE(error("{").find("parse error"), std::string::npos);
    EXPECT_EQ(error("3"), "the line is not a JSON object");
    EXPECT_EQ(error(R"({"action": {"repair___mill": true, "repair___mill": false}})"),
              "the member 'repair___mill' is given twice");
    EXPECT_EQ(error(R"({"action": {}, "action": {}})"), "the member 'action' is given twice");
    EXPECT_EQ(error(R"({"actoin": {}})"), "unknown member 'actoin'; did you mean 'action'?");
    EXPECT_EQ(error(R"({"action": {"repair__mill": true}})"),
              "no action-fluent is called 'repair__mill'; did you mean 'repair___mill'?");
    EXPECT_EQ(error(R"({"action": {"repair___mill": true, "repair___press": true}})"),
              "2 action values differ from their default; at most 1 may");
    EXPECT_EQ(error(R"({"repeat": 0})"), "'repeat' is not an int from 1 to 10000000");
    EXPECT_EQ(error(R"({"reset": 1})"), "'reset' is not true or false");
    EXPECT_EQ(error(R"({"episode": 18446744073709551615})"),
              "'episode' is not an int from 0 to 1099511627775");
    EXPECT_EQ(answer("{}")["state"]["repairs"], 0) << "nothing has changed";
}

TEST_F(Replay, RefusesHeadersWithWrongNumbers) {
    const auto error_of_first = [](const std::string& line) {
        ReplaySession session(*tiny::simulator(), {});
        return json::parse(session.answer(line)).value("error", "no error");
    };
    for (const char* number : {"9223372036854775808", "18446744073709551616", "-1", "1e20", "0.5"})
        EXPECT_EQ(error_of_first(fmt::format(R"({{"rddl_trace": 1, "horizon": {}}})", number)),
                  "'horizon' is not an int from 0 to 9223372036854775807");
    for (const char* number : {"18446744073709551616", "-1", "1e3", "\"0\""})
        EXPECT_EQ(error_of_first(fmt::format(R"({{"rddl_trace": 1, "seed": {}}})", number)),
                  "'seed' is not an int from 0 to 18446744073709551615");
}

TEST_F(Replay, TakesAHeaderOnTheFirstLineOnly) {
    const std::string header = R"({"rddl_trace": 1, "seed": 1})";
    ReplaySession traced(*tiny::simulator(), {}), seeded(*tiny::simulator(), {.seed = 1});
    EXPECT_EQ(traced.answer("  "), "");
    EXPECT_EQ(traced.answer(header), "");
    EXPECT_EQ(traced.answer("{}"), seeded.answer("{}"));
    for (const std::string& late : {header, std::string(R"({"rddl_trace": 2})")})
        EXPECT_EQ(json::parse(traced.answer(late))["error"],
                  "a trace's header stands before all other lines");
    EXPECT_EQ(traced.answer("{}"), seeded.answer("{}")) << "nothing has changed";
}

TEST_F(Replay, RefusesWhatCannotBeRead) {
    EXPECT_EQ(session_.refuse("too long"), "{\"error\":\"too long\",\"line\":1}\n");
    EXPECT_EQ(answer("x")["line"], 2);
}

TEST_F(Replay, SurvivesHostileLines) {
    const std::string deep(1'000'000, '[');
    EXPECT_NE(error(deep), "no error");
    EXPECT_EQ(error(R"({"state": {"repairs": )" + deep + std::string(1'000'000, ']') + "}}"),
              "more than 256 brackets lie within each other");
    EXPECT_EQ(error(R"({"state": {"repairs": [[]]}})"), "'repairs' takes an int, not an array");
    EXPECT_NE(error("\xff\xfe {"), "no error");
    EXPECT_NE(error(R"({"state": {"wear___mill": 1e999}})"), "no error");
    EXPECT_NE(error(R"({"episode": 99999999999999999999})"), "no error");
}

TEST_F(Replay, RefusedLinesChangeNothing) {
    ReplaySession untouched(*tiny::simulator(), {});
    answer(R"({"state": {"repairs": 5}, "action": {"hazard": "x"}})");
    answer(R"({"state": {"repairs": 5, "nothing": 1}})");
    EXPECT_EQ(session_.answer("{}"), untouched.answer("{}"));
}

TEST_F(Replay, ToleratesBlankLines) {
    EXPECT_EQ(session_.answer(""), "");
    EXPECT_EQ(session_.answer(" \t\r"), "");
}

TEST_F(Replay, SaysWhyAnEpisodeIsOver) {
    const std::string broken =
        R"({"state": {"running___lathe": false, "running___mill": false, "running___press": false}})";
    EXPECT_EQ(error(broken), "the episode is over: a termination condition holds");
    EXPECT_EQ(error("{}"), "the episode is over: a termination condition holds");
    EXPECT_FALSE(answer(R"({"state": {"running___mill": true}})").contains("error"));
}

TEST_F(Replay, TruncatesAtTheHorizonAndByInvariants) {
    ReplaySession session(*tiny::simulator(), {.horizon = 2});
    EXPECT_FALSE(json::parse(session.answer("{}"))["truncated"]);
    EXPECT_TRUE(json::parse(session.answer("{}"))["truncated"]);
    EXPECT_EQ(json::parse(session.answer("{}"))["error"],
              "the episode is over: the horizon is reached");

    EXPECT_TRUE(answer(R"({"state": {"wear___mill": 1000}})")["truncated"]);
    EXPECT_EQ(error("{}"), "the episode is over: a state invariant is violated");
}

TEST_F(Replay, TellsFaults) {
    const json faulted = answer(R"({"action": {"hazard": 7.5}})");
    EXPECT_TRUE(faulted["truncated"]);
    const auto message = faulted["fault"].get<std::string>();
    EXPECT_NE(message.find("tiny.rddl:22:24: Bernoulli"), std::string::npos) << message;
    EXPECT_NE(message.find("?m = mill"), std::string::npos) << message;
    EXPECT_EQ(error("{}"), "the episode is over: a step faulted");
}

TEST_F(Replay, ResetsWithNewRandomNumbers) {
    const json start = answer(R"({"reset": true})");
    EXPECT_EQ(start["state"]["wear___mill"], 0.0);
    EXPECT_EQ(start["reward"], 0.0);
    const json first = answer("{}");
    const json second = answer(R"({"reset": true, "action": {}})");
    EXPECT_NE(first["state"]["wear___mill"], second["state"]["wear___mill"]);
    EXPECT_EQ(
        answer(R"({"reset": true, "state": {"repairs": 3}, "action": {}})")["state"]["repairs"], 3);
}

TEST_F(Replay, AnotherEpisodeIsAnotherEnvironment) {
    const json zero = answer("{}");
    const json one = answer(R"({"episode": 1})");
    EXPECT_NE(zero["state"]["wear___mill"], one["state"]["wear___mill"]);
    EXPECT_EQ(answer(R"({"episode": 0})"), zero);
}

TEST_F(Replay, SeedsGiveOtherNumbers) {
    ReplaySession same(*tiny::simulator(), {.seed = 0}), other(*tiny::simulator(), {.seed = 1});
    const std::string line = session_.answer("{}");
    EXPECT_EQ(same.answer("{}"), line);
    EXPECT_NE(other.answer("{}"), line);
}

TEST_F(Replay, RepeatsAStepInIndependentEnvironments) {
    answer(R"({"action": {"repair___mill": true}})");
    const json samples = answer(R"({"repeat": 600, "state": {"wear___mill": 2.5}})")["samples"];
    ASSERT_EQ(samples.size(), 600u);
    std::set<double> distinct;
    for (const json& sample : samples) {
        distinct.insert(sample["state"]["wear___mill"].get<double>());
        EXPECT_EQ(sample["state"]["repairs"], 1);
        EXPECT_TRUE(sample.contains("reward"));
    }
    EXPECT_EQ(distinct.size(), 600u);
    // The next repetition draws again, and the environment has not moved.
    const json again = answer(R"({"repeat": 1})")["samples"];
    EXPECT_EQ(distinct.count(again[0]["state"]["wear___mill"].get<double>()), 0u);
    EXPECT_EQ(answer(R"({"action": {}})")["state"]["repairs"], 1);
}

TEST_F(Replay, RepetitionsKnowTheHorizon) {
    ReplaySession session(*tiny::simulator(), {.horizon = 2});
    EXPECT_FALSE(json::parse(session.answer(R"({"repeat": 1})"))["samples"][0]["truncated"]);
    session.answer("{}");
    EXPECT_TRUE(json::parse(session.answer(R"({"repeat": 1})"))["samples"][0]["truncated"]);
}

TEST_F(Replay, EnforcesPreconditionsOnRequest) {
    rddl_problem unlimited = tiny::problem;
    unlimited.max_nondef_actions = -1;
    const rddl::SimulatorTable table(rddl::About{unlimited, tiny::sites, {}},
                                     rddl::Compiled<tiny::Simulator, tiny::problem>());
    const std::string line = R"({"action": {"repair___mill": true, "repair___press": true}})";
    ReplaySession free(*table.get(), {});
    EXPECT_FALSE(json::parse(free.answer(line)).contains("error"));
    ReplaySession strict(*table.get(), {.preconditions = Preconditions::Error});
    EXPECT_EQ(json::parse(strict.answer(line))["error"],
              "tiny.rddl:30:9: precondition violated: sum_{?m : machine} repair(?m) <= 1");
    ReplaySession lenient(*table.get(), {.preconditions = Preconditions::Warn});
    const json warned = json::parse(lenient.answer(line));
    EXPECT_EQ(warned["state"]["repairs"], 2);
    EXPECT_TRUE(warned["warning"].get<std::string>().starts_with("tiny.rddl:30:9: "));
    EXPECT_FALSE(json::parse(lenient.answer("{}")).contains("warning"));
    ReplaySession careful(*table.get(), {.preconditions = Preconditions::Noop});
    EXPECT_EQ(json::parse(careful.answer(line))["state"]["repairs"], 0);
}

}  // namespace
}  // namespace rddlc::workbench
