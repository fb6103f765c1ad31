// One tab of a browser: its texts as the language server sees them, its episodes and its jobs.
#pragma once

#include "engines/load_simulator.hpp"
#include "lsp/session.hpp"
#include "studio/edited_problem.hpp"
#include "studio/job.hpp"
#include "studio/player.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace rddlc::studio {

// The body of an answer. Other types than JSON are not errors.
struct Reply {
    int status = 200;
    std::string type = "application/json";
    std::string body = "{}";
};

// The state that all tabs share.
struct TabContext {
    OpenedProblem problem;
    workbench::LoadOptions load;
    std::shared_ptr<Workers> workers;
};

class Tab {
  public:
    explicit Tab(std::shared_ptr<const TabContext> context);
    // Stops its jobs and episodes, and does not wait for them.
    ~Tab();

    // Throws a Failure, or an exception of JSON, if the request is not right.
    Reply answer(const std::string& request, const nlohmann::json& wish);

  private:
    Reply open(const nlohmann::json& wish);
    Reply language(const nlohmann::json& wish);
    Reply save(const nlohmann::json& wish);
    Reply ping(const nlohmann::json& wish);
    Reply describe(const nlohmann::json& wish);
    Reply load(const nlohmann::json& wish);
    Reply step(const nlohmann::json& wish);
    Reply advice(const nlohmann::json& wish);
    Reply run(const nlohmann::json& wish);
    Reply stop(const nlohmann::json& wish);
    Reply go_to(const nlohmann::json& wish);
    Reply news(const nlohmann::json& wish);
    Reply picture(const nlohmann::json& wish);
    Reply compare(const nlohmann::json& wish);
    Reply train(const nlohmann::json& wish);
    Reply job(const nlohmann::json& wish);

    std::shared_ptr<Player> player(const nlohmann::json& wish);
    void put_job(const std::string& name, std::shared_ptr<Job> job);
    static Texts texts_of(const nlohmann::json& wish);

    const std::shared_ptr<const TabContext> context_;  // jobs may outlive the tab
    std::mutex language_mutex_;
    lsp::Session language_;
    std::mutex mutex_;  // of all below
    std::map<std::string, std::shared_ptr<Player>> players_;
    std::map<std::string, std::shared_ptr<Job>> jobs_;
    Texts saved_;  // what the files held when they were read or written last
};

}  // namespace rddlc::studio
