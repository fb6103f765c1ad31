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
    Reply answer(const std::string& name, const nlohmann::json& request);

  private:
    Reply open(const nlohmann::json& request);
    Reply language(const nlohmann::json& request);
    Reply save(const nlohmann::json& request);
    Reply ping(const nlohmann::json& request);
    Reply describe(const nlohmann::json& request);
    Reply load(const nlohmann::json& request);
    Reply step(const nlohmann::json& request);
    Reply advice(const nlohmann::json& request);
    Reply run(const nlohmann::json& request);
    Reply stop(const nlohmann::json& request);
    Reply go_to(const nlohmann::json& request);
    Reply updates(const nlohmann::json& request);
    Reply picture(const nlohmann::json& request);
    Reply compare(const nlohmann::json& request);
    Reply train(const nlohmann::json& request);
    Reply job(const nlohmann::json& request);

    std::shared_ptr<Player> player(const nlohmann::json& request);
    void put_job(const std::string& name, std::shared_ptr<Job> job);
    static Texts texts_of(const nlohmann::json& request);

    const std::shared_ptr<const TabContext> context_;  // jobs may outlive the tab
    std::mutex language_mutex_;
    lsp::Session language_;
    std::mutex mutex_;  // of all below
    std::map<std::string, std::shared_ptr<Player>> players_;
    std::map<std::string, std::shared_ptr<Job>> jobs_;
    Texts saved_;  // what the files held when they were read or written last
};

}  // namespace rddlc::studio
