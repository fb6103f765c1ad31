#include "rollouts/rollouts.hpp"

#include "../runtime/tiny_simulator.hpp"
#include "formats/trace.hpp"
#include "rollouts/replay_session.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace rddlc::workbench {
namespace {

using nlohmann::json;

Rollouts run(RolloutOptions options, std::string* trace = nullptr) {
    options.episodes = 37;
    options.seed = 11;
    TraceSink sink;
    if (trace)
        sink = [trace](const std::string& lines) {
            *trace += lines;
        };
    return run_episodes(*tiny::simulator(), options, sink, false);
}

TEST(Rollouts, DoNotDependOnBatchAndThreads) {
    const Rollouts alone = run({{.threads = 1, .batch = 1}});
    ASSERT_EQ(alone.episodes.size(), 37u);
    for (const auto& [threads, batch] : {std::pair{1, 37}, {2, 5}, {3, 64}, {8, 1}}) {
        const Rollouts others = run({{.threads = threads, .batch = batch}});
        EXPECT_EQ(others.steps, alone.steps);
        for (std::size_t i = 0; i < alone.episodes.size(); ++i) {
            EXPECT_EQ(others.episodes[i].undiscounted_return,
                      alone.episodes[i].undiscounted_return);
            EXPECT_EQ(others.episodes[i].length, alone.episodes[i].length);
            EXPECT_EQ(others.episodes[i].causes, alone.episodes[i].causes);
        }
        ASSERT_TRUE(others.first_fault);
        EXPECT_EQ(others.first_fault->message, alone.first_fault->message);
        EXPECT_EQ(others.first_fault->episode, alone.first_fault->episode);
    }
}

TEST(Rollouts, TracesDoNotDependOnBatchAndThreads) {
    std::string alone, together;
    run({{.threads = 1, .batch = 1}}, &alone);
    run({{.threads = 4, .batch = 7}}, &together);
    EXPECT_FALSE(alone.empty());
    EXPECT_EQ(alone, together);
}

TEST(Rollouts, StopAtTheHorizon) {
    const Rollouts rollouts = run({{.horizon = 3}, Policy::Noop});
    for (const Episode& episode : rollouts.episodes) {
        EXPECT_TRUE(episode.finished);
        EXPECT_LE(episode.length, 3);
        if (episode.length == 3 && !(episode.causes & RDDL_FAULTED)) {
            EXPECT_TRUE(episode.causes & RDDL_TRUNCATED_HORIZON);
        }
    }
}

TEST(Rollouts, DiscountReturns) {
    std::string trace;
    const Rollouts rollouts = run({{.batch = 64}, Policy::Noop}, &trace);
    std::vector<double> plain(37), discounted(37);
    std::istringstream lines(trace);
    for (std::string text; std::getline(lines, text);) {
        const json line = json::parse(text);
        const auto episode = line["episode"].get<std::size_t>();
        plain[episode] += line["reward"].get<double>();
        discounted[episode] +=
            line["reward"].get<double>() * std::pow(0.9, line["step"].get<double>());
    }
    for (std::size_t i = 0; i < plain.size(); ++i) {
        EXPECT_DOUBLE_EQ(rollouts.episodes[i].undiscounted_return, plain[i]);
        EXPECT_NEAR(rollouts.episodes[i].discounted_return, discounted[i], 1e-12);
    }
}

TEST(Rollouts, FaultsEndAnEpisodeAndAreCounted) {
    // A random hazard, added to a probability, is out of range half of the time.
    const Rollouts rollouts = run({{.threads = 1}});
    ASSERT_TRUE(rollouts.first_fault);
    EXPECT_NE(rollouts.first_fault->message.find("tiny.rddl:22:24: Bernoulli"), std::string::npos);
    const auto first = static_cast<std::size_t>(rollouts.first_fault->episode);
    for (std::size_t i = 0; i < first; ++i)
        EXPECT_FALSE(rollouts.episodes[i].causes & RDDL_FAULTED);
    EXPECT_EQ(rollouts.episodes[first].causes, RDDL_FAULTED);
    EXPECT_EQ(rollouts.episodes[first].length, rollouts.first_fault->step);
}

TEST(Trace, ReplaysBitForBit) {
    std::string trace;
    run({{.threads = 1, .batch = 4}}, &trace);
    TraceHeader header;
    header.seed = 11;
    header.horizon = tiny::problem.horizon;
    ReplaySession session(*tiny::simulator(), {});
    EXPECT_EQ(session.answer(trace_header_line(header, tiny::problem)), "");
    std::istringstream lines(trace);
    int steps = 0;
    for (std::string text; std::getline(lines, text); ++steps) {
        const json before = json::parse(text);
        const json after = json::parse(session.answer(text));
        ASSERT_FALSE(after.contains("error")) << after;
        EXPECT_EQ(after["state"], before["next_state"]);
        EXPECT_EQ(after["reward"], before["reward"]);
        EXPECT_EQ(after["terminated"], before["terminated"]);
        EXPECT_EQ(after["truncated"], before["truncated"]);
        EXPECT_EQ(after.contains("fault"), before.contains("fault"));
    }
    EXPECT_GT(steps, 37);
}

TEST(Trace, HeaderTellsWhereItComesFrom) {
    TraceHeader header;
    header.problem = "tiny 1";
    header.files = {"/dev/null"};
    header.seed = 18446744073709551615u;
    const json line = json::parse(trace_header_line(header, tiny::problem));
    EXPECT_EQ(line["rddl_trace"], 1);
    EXPECT_EQ(line["domain"], "tiny");
    EXPECT_EQ(line["seed"], 18446744073709551615u);
    EXPECT_EQ(line["files"][0]["sha256"],
              "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace rddlc::workbench
