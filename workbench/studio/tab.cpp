#include "studio/tab.hpp"

#include "learning/learned_policy.hpp"
#include "lsp/reference.hpp"
#include "planners/planner/planner_policy.hpp"
#include "studio/comparison.hpp"
#include "studio/policy_name.hpp"
#include "studio/training.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rddlc::studio {

using namespace workbench;
using Request = nlohmann::json;

namespace {

Reply reply(const Json& json) {
    return {.body = json_line(json)};
}

std::string text_in(const Request& request, const char* name, const std::string& otherwise) {
    return request.contains(name) ? request.at(name).get<std::string>() : otherwise;
}

template <class Number>
Number number_in(const Request& request, const char* name, Number otherwise, Number least,
                 Number most) {
    if (!request.contains(name)) return otherwise;
    const nlohmann::json& value = request.at(name);
    const bool is_whole = value.is_number_integer() || std::is_floating_point_v<Number>;
    if (!value.is_number() || !is_whole || value.get<double>() < static_cast<double>(least) ||
        value.get<double>() > static_cast<double>(most))
        throw Failure(fmt::format("'{}' is not a number from {} to {}", name, least, most));
    return value.get<Number>();
}

std::uint64_t seed_in(const Request& request) {
    constexpr std::uint64_t most = std::uint64_t{1} << 53;  // the largest that JavaScript counts
    return number_in<std::uint64_t>(request, "seed", 0, 0, most);
}

constexpr std::int64_t longest_episode = 10'000'000;

std::int64_t horizon_in(const Request& request) {
    return number_in<std::int64_t>(request, "horizon", 0, 0, longest_episode);
}

std::string policy_in(const Request& request, const char* name = "policy") {
    const std::string policy = request.at(name).get<std::string>();
    if (planners::is_planner(policy)) planners::require_planner(policy);
    return policy;
}

Json words() {
    Json all = Json::array();
    for (const std::string_view word : lsp::explained_keywords()) all.push_back(word);
    return all;
}

Json planner_names() {
    Json all = Json::array();
    for (const planners::PlannerText& each : planners::planner_texts()) {
        Json options = Json::array();
        for (const solvers::OptionText& option : each.options)
            options.push_back({{"name", option.name}, {"help", option.help}});
        all.push_back({{"name", planners::prefix + each.name},
                       {"summary", each.summary},
                       {"options", options}});
    }
    return all;
}

}  // namespace

Tab::Tab(std::shared_ptr<const TabContext> context)
    : context_(std::move(context)),
      language_(context_->problem.files.standard, true),
      saved_{context_->problem.domain, context_->problem.instance} {
    language_.handle({{"jsonrpc", "2.0"}, {"id", 0}, {"method", "initialize"}});
}

Tab::~Tab() {
    for (const auto& [name, player] : players_) player->stop_soon();
    for (const auto& [name, job] : jobs_) job->stop();
}

Texts Tab::texts_of(const Request& request) {
    return {request.at("domain").get<std::string>(), request.at("instance").get<std::string>()};
}

std::shared_ptr<Player> Tab::player(const Request& request) {
    const std::string name = request.at("player");
    const std::scoped_lock lock(mutex_);
    const auto found = players_.find(name);
    if (found == players_.end()) throw Failure("no episode has begun");
    return found->second;
}

Reply Tab::answer(const std::string& name, const Request& request) {
    using Answer = Reply (Tab::*)(const Request&);
    static const std::map<std::string, Answer> answers = {
        {"open", &Tab::open},       {"language", &Tab::language}, {"save", &Tab::save},
        {"ping", &Tab::ping},       {"describe", &Tab::describe}, {"load", &Tab::load},
        {"step", &Tab::step},       {"run", &Tab::run},           {"advice", &Tab::advice},
        {"stop", &Tab::stop},       {"go_to", &Tab::go_to},       {"updates", &Tab::updates},
        {"picture", &Tab::picture}, {"compare", &Tab::compare},   {"train", &Tab::train},
        {"job", &Tab::job}};
    const auto found = answers.find(name);
    if (found == answers.end()) return {404, "application/json", R"({"error":"no such request"})"};
    return (this->*found->second)(request);
}

// ------------------------------------------------------------------------------------- texts

Reply Tab::open(const Request&) {
    const OpenedProblem& problem = context_->problem;
    const std::scoped_lock lock(mutex_);
    return reply({{"name", problem.name},
                  {"domain_name", domain_name(problem)},
                  {"instance_name", instance_name(problem)},
                  {"domain", saved_.domain},
                  {"instance", saved_.instance},
                  {"can_save", problem.can_save},
                  {"words", words()},
                  {"planners", planner_names()}});
}

// Messages of the Language Server Protocol, and the diagnostics of texts that they have changed,
// unless "checks" is false.
Reply Tab::language(const Request& request) {
    std::vector<nlohmann::json> answers;
    std::optional<lsp::CheckRequest> checking;
    const auto take = [&](std::vector<nlohmann::json> messages) {
        std::ranges::move(messages, std::back_inserter(answers));
    };
    {
        const std::scoped_lock lock(language_mutex_);
        for (const nlohmann::json& message : request.at("messages"))
            take(language_.handle(message));
        if (request.value("checks", true) && language_.take_change())
            checking = language_.check_request();
    }
    if (checking) {  // may take long, and needs no lock
        lsp::Checks checks = lsp::run_checks(*checking);
        const std::scoped_lock lock(language_mutex_);
        take(language_.publish(std::move(checks)));
    }
    return {.body = fmt::format(R"({{"messages":{}}})", json_line(Json(answers)))};
}

// Tells the page that the program lives, and the program that the tab does: it is not the one that
// makes room for a new one.
Reply Tab::ping(const Request&) {
    return {};
}

Reply Tab::save(const Request& request) {
    const Texts texts = texts_of(request);
    const std::scoped_lock lock(mutex_);
    save_texts(context_->problem, texts, saved_, request.value("force", false));
    return {};
}

// ---------------------------------------------------------------------------------- episodes

Reply Tab::load(const Request& request) {
    const std::string name = request.at("player");
    const std::string block = block_of(text_in(request, "policy", "")).value_or("");
    const PlayerOptions options{block, seed_in(request),
                                number_in<std::int64_t>(request, "episode", 0, 0, longest_episode),
                                horizon_in(request)};
    const auto fresh = std::make_shared<Player>(
        load_texts(context_->problem, texts_of(request), context_->load, Purpose::Stepping, block),
        options);
    const Json description = fresh->description();
    std::shared_ptr<Player> before;
    {
        const std::scoped_lock lock(mutex_);
        constexpr std::size_t most_players = 8;
        if (!players_.contains(name) && players_.size() >= most_players)
            throw Failure("a tab has so many episodes at most");
        before = std::exchange(players_[name], fresh);
    }
    if (before) before->stop();
    return {.body = fmt::format(R"({{"problem":{},"updates":{}}})", json_line(description),
                                fresh->updates(0, 0))};
}

// {} where no episode has begun.
Reply Tab::describe(const Request& request) {
    const std::string name = request.at("player");
    std::shared_ptr<Player> found;
    {
        const std::scoped_lock lock(mutex_);
        if (const auto place = players_.find(name); place != players_.end()) found = place->second;
    }
    Json answer = Json::object();
    if (found) answer["problem"] = found->description();
    return reply(answer);
}

Reply Tab::step(const Request& request) {
    const std::string violation =
        player(request)->step(request.at("action"), request.value("force", false));
    Json answer = Json::object();
    if (!violation.empty()) answer["violation"] = violation;
    return reply(answer);
}

Reply Tab::advice(const Request& request) {
    const std::string action =
        player(request)->advice(*context_->workers, policy_in(request),
                                number_in<std::size_t>(request, "step", 0, 0, longest_episode));
    return {.body = fmt::format(R"({{"action":{}}})", action)};
}

Reply Tab::run(const Request& request) {
    player(request)->run(
        context_->workers, policy_in(request),
        number_in<std::int64_t>(request, "steps", longest_episode, 1, longest_episode));
    return {};
}

Reply Tab::stop(const Request& request) {
    if (request.contains("player")) player(request)->stop();
    const std::string name = text_in(request, "job", "");
    const std::scoped_lock lock(mutex_);
    if (const auto found = jobs_.find(name); found != jobs_.end()) found->second->stop();
    return {};
}

Reply Tab::go_to(const Request& request) {
    player(request)->go_to(number_in<std::size_t>(request, "step", 0, 0, longest_episode));
    return {};
}

Reply Tab::updates(const Request& request) {
    return {.body = player(request)->updates(
                number_in<std::uint64_t>(request, "branch", 0, 0, std::uint64_t{1} << 53),
                number_in<std::size_t>(request, "since", 0, 0, longest_episode))};
}

Reply Tab::picture(const Request& request) {
    const PictureSize size{number_in(request, "width", 600, 16, 4096),
                           number_in(request, "height", 400, 16, 4096)};
    return {.type = "image/png",
            .body = player(request)->picture(
                number_in<std::size_t>(request, "step", 0, 0, longest_episode),
                request.at("visualizer").get<std::string>(), size)};
}

// -------------------------------------------------------------------------------------- jobs

void Tab::put_job(const std::string& name, std::shared_ptr<Job> job) {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Job>& place = jobs_[name];
    if (place) place->stop();
    place = std::move(job);
}

Reply Tab::compare(const Request& request) {
    ComparisonOptions options;
    options.policies = {policy_in(request, "first"), policy_in(request, "second")};
    options.episodes = number_in<std::int64_t>(request, "episodes", 100, 1, 1'000'000);
    options.seed = seed_in(request);
    options.horizon = horizon_in(request);
    const auto first = block_of(options.policies[0]), second = block_of(options.policies[1]);
    const std::string block = first.value_or(second.value_or(""));
    put_job(
        "compare",
        Job::start(context_->workers, [context = context_, texts = texts_of(request), options,
                                       block, other = second.value_or(block)](Job& job) {
            const auto load = [&](const std::string& own) {
                return load_texts(context->problem, texts, context->load, Purpose::Episodes, own);
            };
            const LoadedProblem problem = load(block);
            return studio::compare(job, {problem, other == block ? problem : load(other)}, options);
        }));
    return {};
}

Reply Tab::train(const Request& request) {
    TrainingRequest training;
    training.solver = request.at("solver");
    for (const nlohmann::json& option : request.value("options", nlohmann::json::array()))
        training.options.push_back(option.get<std::string>());
    training.seconds = number_in(request, "seconds", 60.0, 0.1, 1e6);
    training.seed = seed_in(request);
    // As `rddl train` names them, so that it resumes the run.
    const bool is_float = context_->load.real == RealType::Float;
    training.settings = {{"--real", is_float ? "float" : "double"},
                         {"--fast-math", context_->load.passes.fast_math ? "true" : "false"}};
    require_options(training);
    put_job("train", Job::start(context_->workers, [context = context_, texts = texts_of(request),
                                                    training](Job& job) mutable {
                const LoadedProblem problem =
                    load_texts(context->problem, texts, context->load, Purpose::Episodes);
                training.folder = new_run_folder(problem.simulator->problem->instance,
                                                 training.solver, training.seed);
                return studio::train(job, problem, training);
            }));
    return {};
}

Reply Tab::job(const Request& request) {
    const std::string name = request.at("job");
    const std::scoped_lock lock(mutex_);
    const auto found = jobs_.find(name);
    return found == jobs_.end() ? reply({{"state", "absent"}}) : reply(found->second->status());
}

}  // namespace rddlc::studio
