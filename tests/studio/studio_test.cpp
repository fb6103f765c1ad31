// Requests and their answers, without HTTP.
#include "studio/studio.hpp"

#include "studio/drawing.hpp"
#include "studio/training.hpp"
#include "support/failure.hpp"
#include "test_folder.hpp"
#include "texts.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rddlc::studio {
namespace {

using nlohmann::json;

// The working folder, until it ends.
class WorkingFolder {
  public:
    explicit WorkingFolder(const std::filesystem::path& folder) {
        std::filesystem::current_path(folder);
    }
    ~WorkingFolder() {
        std::error_code ignored;
        std::filesystem::current_path(before_, ignored);
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

  private:
    const std::filesystem::path before_ = std::filesystem::current_path();
};

// A policy block that raises the alarm at once.
const std::string alarming = R"(policy alarming {
    domain = tanks;
    cpfs { alarm = true; release(?t) = 0.0; };
}
)";

class StudioTest : public testing::Test {
  protected:
    json ask(const std::string& name, json request, int status = 200) {
        request.emplace("tab", "one");
        const Reply reply = studio.answer(name, request.dump());
        EXPECT_EQ(reply.status, status) << name << ": " << reply.body;
        return json::parse(reply.body);
    }
    // Opens texts in the language server, by the names of their files.
    json open_texts(const std::vector<std::pair<std::string, std::string>>& texts) {
        json messages = json::array();
        for (const auto& [name, text] : texts)
            messages.push_back(
                {{"jsonrpc", "2.0"},
                 {"method", "textDocument/didOpen"},
                 {"params",
                  {{"textDocument",
                    {{"uri", "studio:/" + name}, {"version", 1}, {"text", text}}}}}});
        return ask("language", {{"messages", messages}});
    }
    json load(const std::string& domain = tanks_domain) {
        return ask("load", {{"player", "p"}, {"domain", domain}, {"instance", tanks_instance}});
    }
    json updates(std::size_t since = 0, std::uint64_t branch = 0) {
        return ask("updates", {{"player", "p"}, {"since", since}, {"branch", branch}});
    }
    json finished_updates() {
        for (;;) {
            const json found = updates();
            if (found["run"].is_null() || found["run"]["state"] != "running") return found;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    json finished_job(const std::string& name) {
        for (;;) {
            const json found = ask("job", {{"job", name}});
            if (found["state"] != "running") return found;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }

    static StudioOptions options() {
        StudioOptions options;
        options.load.engine = workbench::Engine::Interpreter;
        return options;
    }

    Studio studio{tanks(), options()};
};

TEST_F(StudioTest, OpensTheProblem) {
    const json opened = ask("open", json::object());
    EXPECT_EQ(opened["domain"], tanks_domain);
    EXPECT_EQ(opened["domain_name"], "domain.rddl");
    EXPECT_EQ(opened["can_save"], false);
    EXPECT_GT(opened["planners"].size(), 1u);
}

TEST_F(StudioTest, FirstProblemHasNoDiagnostics) {
    const OpenedProblem first = first_problem();
    const json answer =
        open_texts({{"domain.rddl", first.domain}, {"instance.rddl", first.instance}});
    ASSERT_EQ(answer["messages"].size(), 2u);
    for (const json& message : answer["messages"])
        EXPECT_EQ(message["params"]["diagnostics"], json::array()) << message;
}

TEST_F(StudioTest, DiagnosticsAreTheLanguageServers) {
    std::string broken = tanks_domain;
    broken.replace(broken.find("water(?t) - release"), 5, "watr");
    const json answer = open_texts({{"domain.rddl", broken}});
    const json& diagnostic = answer["messages"][0]["params"]["diagnostics"][0];
    EXPECT_EQ(diagnostic["code"], "E0201");
    EXPECT_EQ(diagnostic["range"]["start"]["line"], 8);
    EXPECT_NE(diagnostic["message"].get<std::string>().find("did you mean 'water'"),
              std::string::npos);
}

TEST_F(StudioTest, LoadDescribesTheActions) {
    const json problem = load()["problem"];
    EXPECT_EQ(problem["horizon"], 20);
    EXPECT_EQ(problem["max_nondef_actions"], 2);
    EXPECT_EQ(problem["has_policy_block"], true);
    ASSERT_EQ(problem["actions"].size(), 3u);
    EXPECT_EQ(problem["actions"][0]["name"], "release___a");
    EXPECT_EQ(problem["actions"][2]["type"], "bool");
}

TEST_F(StudioTest, TextsWithErrorsAreRefusedWithTheirPlaces) {
    const json answer =
        ask("load", {{"player", "p"}, {"domain", "domain d {"}, {"instance", tanks_instance}}, 422);
    EXPECT_NE(answer["error"].get<std::string>().find("domain.rddl:1:"), std::string::npos);
    ask("updates", {{"player", "p"}}, 422);  // nothing was loaded
}

TEST_F(StudioTest, StepsByHandAndGoesBack) {
    load();
    EXPECT_EQ(ask("step", {{"player", "p"}, {"action", {{"release___a", 2.0}}}}), json::object());
    ask("step", {{"player", "p"}, {"action", json::object()}});
    const json before = updates();
    EXPECT_EQ(before["now"], 2);
    ask("go_to", {{"player", "p"}, {"step", 1}});
    EXPECT_EQ(updates()["now"], 1);
    EXPECT_EQ(updates()["count"], 3);  // until another action is taken
    ask("step", {{"player", "p"}, {"action", {{"alarm", true}}}});
    const json after = updates();
    EXPECT_NE(after["branch"], before["branch"]);
    EXPECT_EQ(after["moments"][1]["state"], before["moments"][1]["state"]);
    EXPECT_EQ(after["moments"][1]["by"], "you");
    // The same luck: the alarm costs 1 and changes nothing else.
    EXPECT_EQ(after["moments"][2]["state"], before["moments"][2]["state"]);
    EXPECT_EQ(after["moments"][1]["reward"].get<double>() + 1,
              before["moments"][1]["reward"].get<double>());
}

TEST_F(StudioTest, IllegalActionsAreTakenOnlyByThoseWhoInsist) {
    load();
    const json action = {{"release___a", 1000.0}};
    const json refused = ask("step", {{"player", "p"}, {"action", action}});
    EXPECT_NE(refused["violation"], "");
    EXPECT_EQ(updates()["now"], 0);
    EXPECT_EQ(ask("step", {{"player", "p"}, {"action", action}, {"force", true}}), json::object());
    EXPECT_NE(updates()["moments"][0]["warning"], "");
}

TEST_F(StudioTest, RunsPolicies) {
    load();
    ask("run", {{"player", "p"}, {"policy", "random"}, {"steps", 5}});
    EXPECT_EQ(finished_updates()["now"], 5);
    ask("run", {{"player", "p"}, {"policy", "rddl"}});
    const json all = finished_updates();
    EXPECT_EQ(all["count"], 21);
    EXPECT_EQ(all["moments"][20]["ended"], json::array({"horizon"}));
    EXPECT_EQ(all["moments"][4]["by"], "random");
    EXPECT_EQ(all["moments"][5]["by"], "rddl");
    // Only what is new is sent, and the last moment that is known.
    EXPECT_EQ(updates(20, all["branch"])["first"], 19);
    ask("run", {{"player", "p"}, {"policy", "random"}}, 422);  // the episode is over
    ask("go_to", {{"player", "p"}, {"step", 0}});
    ask("run", {{"player", "p"}, {"policy", "no_such_file.json"}});
    EXPECT_EQ(finished_updates()["run"]["state"], "failed");
    EXPECT_NE(ask("advice", {{"player", "p"}, {"policy", "rddl"}, {"step", 3}})["action"],
              json::object());
}

TEST_F(StudioTest, LongRunsCanBeStopped) {
    load();
    ask("run", {{"player", "p"}, {"policy", "plan:cem,seconds=100"}});
    const auto begin = std::chrono::steady_clock::now();
    ask("stop", {{"player", "p"}});
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_EQ(updates()["run"]["state"], "stopped");
}

TEST_F(StudioTest, PicturesArePngOrRefused) {
    const json problem = load()["problem"];
    const json request = {{"tab", "one"}, {"player", "p"}, {"step", 0}, {"visualizer", "auto"}};
    const Reply reply = studio.answer("picture", request.dump());
    const bool draws = !problem["visualizers"].empty();
    EXPECT_EQ(reply.status, draws ? 200 : 422);
    if (draws) {
        EXPECT_EQ(reply.body.substr(0, 4), "\x89PNG");
    }
    json wrong = request;
    wrong["step"] = 7;
    EXPECT_EQ(studio.answer("picture", wrong.dump()).status, 422);
    wrong = request;
    wrong["visualizer"] = "no such";
    EXPECT_EQ(studio.answer("picture", wrong.dump()).status, 422);
}

TEST_F(StudioTest, ComparesWithPairedLuck) {
    json request = {{"domain", tanks_domain}, {"instance", tanks_instance},
                    {"first", "noop"},        {"second", "rddl"},
                    {"episodes", 20},         {"seed", 3}};
    ask("compare", request);
    const json status = finished_job("compare");
    ASSERT_EQ(status["state"], "done") << status;
    // The policy block does nothing but raise the alarm from its fourth decision on, and the luck
    // is the same: each of the last 17 steps costs 1.
    EXPECT_NEAR(status["result"]["difference"]["mean"].get<double>(), -17, 1e-9);
    EXPECT_NEAR(status["result"]["difference"]["half_width_95"].get<double>(), 0, 1e-9);
    EXPECT_EQ(status["result"]["pairs"], 20);
    request["first"] = "nothing";
    ask("compare", request);
    EXPECT_EQ(finished_job("compare")["state"], "failed");
}

TEST_F(StudioTest, ComparesTwoPolicyBlocks) {
    const TestFolder folder;
    const std::string file = folder.write("alarming.rddl", alarming);
    json request = {{"domain", tanks_domain}, {"instance", tanks_instance},
                    {"first", file},          {"second", "rddl"},
                    {"episodes", 20},         {"seed", 3}};
    ask("compare", request);
    json status = finished_job("compare");
    ASSERT_EQ(status["state"], "done") << status;
    // The block of the texts raises it in 17 of 20 steps only.
    EXPECT_NEAR(status["result"]["difference"]["mean"].get<double>(), 3, 1e-9);
    request["second"] = "noop";
    ask("compare", request);
    status = finished_job("compare");
    ASSERT_EQ(status["state"], "done") << status;
    EXPECT_NEAR(status["result"]["difference"]["mean"].get<double>(), 20, 1e-9);
    EXPECT_EQ(status["result"]["policies"][0]["policy"], file);
}

TEST_F(StudioTest, EpisodesKeepTheirPolicyBlock) {
    const TestFolder folder;
    const std::string file = folder.write("alarming.rddl", alarming);
    const std::string other = folder.write("other.rddl", alarming);
    EXPECT_EQ(load()["problem"]["policy_block"], "");
    ask("run", {{"player", "p"}, {"policy", file}}, 422);
    const json loaded = ask("load", {{"player", "p"},
                                     {"domain", tanks_domain},
                                     {"instance", tanks_instance},
                                     {"policy", file}});
    EXPECT_EQ(loaded["problem"]["policy_block"], file);
    for (const std::string& policy : {std::string("rddl"), other}) {
        ask("run", {{"player", "p"}, {"policy", policy}}, 422);
        ask("advice", {{"player", "p"}, {"policy", policy}, {"step", 0}}, 422);
    }
    EXPECT_EQ(ask("advice", {{"player", "p"}, {"policy", file}, {"step", 0}})["action"]["alarm"],
              true);
    ask("run", {{"player", "p"}, {"policy", file}, {"steps", 1}});
    EXPECT_EQ(finished_updates()["moments"][0]["by"], file);
    ask("run", {{"player", "p"}, {"policy", "noop"}, {"steps", 1}});
    EXPECT_EQ(finished_updates()["now"], 2);
}

// The derivatives are those of the texts on the page, which are in no file.
TEST_F(StudioTest, PlansWithDerivatives) {
    load();
    const std::string planner = "plan:gradient,iterations=1";
    ask("run", {{"player", "p"}, {"policy", planner}, {"steps", 1}});
    const json run = finished_updates()["run"];
    EXPECT_EQ(run["state"], "done") << run;
    ask("compare", {{"domain", tanks_domain},
                    {"instance", tanks_instance},
                    {"first", "noop"},
                    {"second", planner},
                    {"horizon", 2},
                    {"episodes", 1}});
    const json status = finished_job("compare");
    EXPECT_EQ(status["state"], "done") << status;
}

TEST_F(StudioTest, TabsThatMakeRoomStopTheirJobs) {
    const TestFolder folder;
    const WorkingFolder working(folder.path);
    load();
    ask("run", {{"player", "p"}, {"policy", "plan:cem,seconds=100"}});
    ask("train", {{"domain", tanks_domain},
                  {"instance", tanks_instance},
                  {"solver", "cgp"},
                  {"seconds", 600}});
    for (int k = 0; k < 64; ++k) ask("ping", {{"tab", "tab " + std::to_string(k)}});
    EXPECT_EQ(ask("job", {{"job", "train"}})["state"], "absent");  // it is a new tab of this name
    EXPECT_TRUE(studio.jobs_end(std::chrono::seconds(20)));
}

TEST_F(StudioTest, TrainsAndStops) {
    const TestFolder folder;
    const WorkingFolder working(folder.path);
    json request = {{"domain", tanks_domain},
                    {"instance", tanks_instance},
                    {"solver", "cgp"},
                    {"seconds", 600},
                    {"options", {"gens=2", "episodes=1"}}};
    ask("train", request);
    const json status = finished_job("train");
    EXPECT_EQ(status["state"], "done") << status;
    EXPECT_GE(status["progress"]["steps"].size(), 2u);
    EXPECT_EQ(status["progress"]["steps"].size(), status["progress"]["evaluation"].size());
    EXPECT_EQ(status["result"]["folder"], "runs/i_cgp_0");
    load();
    ask("run", {{"player", "p"}, {"policy", "runs/i_cgp_0"}});
    EXPECT_EQ(finished_updates()["run"]["state"], "done");
    // The next run has a folder of its own; a stop ends it soon.
    request["options"] = json::array();
    ask("train", request);
    ask("stop", {{"job", "train"}});
    EXPECT_EQ(finished_job("train")["state"], "stopped");
    request["options"] = {"genz=2"};
    EXPECT_NE(ask("train", request, 422)["error"].get<std::string>().find("gens"),
              std::string::npos);
    request["solver"] = "dqn";
    ask("train", request, 422);
}

TEST_F(StudioTest, TabsAreIndependent) {
    load();
    ask("step", {{"player", "p"}, {"action", json::object()}});
    ask("updates", {{"player", "p"}, {"tab", "other"}}, 422);
    ask("load", {{"player", "p"},
                 {"tab", "other"},
                 {"domain", tanks_domain},
                 {"instance", tanks_instance}});
    EXPECT_EQ(updates()["now"], 1);
    EXPECT_EQ(ask("job", {{"job", "compare"}, {"tab", "other"}})["state"], "absent");
}

TEST_F(StudioTest, WrongRequestsAreRefusedAndHarmless) {
    for (const char* const body :
         {"", "{", "[]", "3", "{}", R"({"tab":3})", R"({"tab":""})", "\xff"})
        EXPECT_NE(studio.answer("open", body).status, 200) << body;
    load();
    const json player = {{"player", "p"}};
    const auto with = [&](const char* name, const json& value) {
        json request = player;
        request[name] = value;
        return request;
    };
    ask("no_such_request", player, 404);
    ask("step", player, 400);
    ask("step", with("action", 3), 422);
    ask("step", with("action", {{"release___a", "much"}}), 422);
    for (const json& step : {json(-1), json(0.5), json("0"), json(1e300), json(5)})
        ask("go_to", with("step", step), 422);
    ask("run", with("policy", "plan:nothing"), 422);
    ask("run", with("policy", 3), 400);
    ask("updates", with("since", -1), 422);
    ask("language", with("messages", json::array({3, nullptr, {{"method", "x"}}})), 200);
    EXPECT_EQ(updates()["now"], 0);
}

}  // namespace
}  // namespace rddlc::studio
