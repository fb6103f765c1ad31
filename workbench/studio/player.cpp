#include "studio/player.hpp"

#include "learning/learned_policy.hpp"
#include "planners/planner/planner_policy.hpp"
#include "studio/policy_name.hpp"
#include "support/failure.hpp"
#include "support/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace rddlc::studio {

using namespace workbench;

namespace {

constexpr std::size_t message_size = std::size_t{1} << 22;  // bytes of moments

Json bound_of(const double* bounds, std::int64_t grounding) {
    if (!bounds || !std::isfinite(bounds[grounding])) return nullptr;
    return bounds[grounding];
}

Json objects_of(const rddl_type& type) {
    Json names = Json::array();
    for (std::int64_t i = 0; i < type.object_count; ++i) names.push_back(type.objects[i]);
    return names;
}

const char* type_of(const rddl_fluent& fluent) {
    if (fluent.range_type >= 0) return "object";
    return fluent.scalar == RDDL_BOOL ? "bool" : fluent.scalar == RDDL_INT ? "int" : "real";
}

// Each value of an action, with its range and default.
Json action_values(const rddl_problem& problem) {
    const RecordLayout layout(problem, RDDL_ACTION);
    const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
    Json values = Json::array();
    for (const RecordEntry& entry : layout.entries()) {
        if (values.size() == most_values) break;
        std::string text;
        write_value(text, entry, defaults);
        Json value{{"name", entry.name},
                   {"type", type_of(*entry.fluent)},
                   {"default", parse_ordered_json(text)},
                   {"lower", bound_of(entry.fluent->lower, entry.grounding)},
                   {"upper", bound_of(entry.fluent->upper, entry.grounding)}};
        if (entry.objects) value["objects"] = objects_of(*entry.objects);
        values.push_back(std::move(value));
    }
    return values;
}

}  // namespace

Player::Player(LoadedProblem problem, const PlayerOptions& options)
    : problem_(std::move(problem)),
      policy_block_(options.policy_block),
      episode_(problem_.simulator, options.seed, options.episode, options.horizon) {}

Json Player::description() const {
    const rddl_problem& problem = *problem_.simulator->problem;
    return {{"domain", problem.domain},
            {"instance", problem.instance},
            {"horizon", problem.horizon},
            {"partially_observed", problem.partially_observed != 0},
            {"stochastic", problem.stochastic != 0},
            {"max_nondef_actions", problem.max_nondef_actions},
            {"preconditions", problem.precondition_count},
            {"has_policy_block", problem_.simulator->policy != nullptr},
            {"policy_block", policy_block_},
            {"actions", action_values(problem)},
            {"action_count", RecordLayout(problem, RDDL_ACTION).entries().size()},
            {"state_count", RecordLayout(problem, RDDL_STATE).entries().size()},
            {"visualizers", visualizers_for(*problem_.simulator)}};
}

void Player::go_to(std::size_t moment) {
    const std::scoped_lock run_lock(run_mutex_);
    halt();
    const std::scoped_lock lock(mutex_);
    episode_.go_to(moment);
}

std::string Player::step(const nlohmann::json& values, bool force) {
    const std::scoped_lock run_lock(run_mutex_);
    halt();
    const Record action = episode_.read_action(values);
    if (const std::string why = episode_.violation_of(action); !why.empty() && !force) return why;
    MadeStep made = episode_.make_step(action);
    const std::scoped_lock lock(mutex_);
    episode_.keep(std::move(made), "you");
    return "";
}

void Player::stop() {
    const std::scoped_lock run_lock(run_mutex_);
    halt();
}

void Player::halt() {
    if (!run_) return;
    run_->stop();
    while (run_->is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

void Player::stop_soon() {
    const std::scoped_lock lock(mutex_);
    if (run_) run_->stop();
}

void Player::require_block(const std::string& policy) const {
    if (block_of(policy).value_or(policy_block_) != policy_block_)
        throw Failure(fmt::format("this episode was begun without the policy block '{}'", policy),
                      "begin a new one");
}

PolicyActor& Player::actor_named(const std::string& name) {
    if (!actor_ || actor_->name() != name) {
        solvers::Policy policy =
            policy_named(*problem_.simulator, name_when_loaded(name), false, episode_.seed(),
                         problem_.files.memory_limit, {.derivatives = problem_.derivatives});
        policy.name = name;
        actor_ =
            std::make_unique<PolicyActor>(episode_, std::move(policy), planners::is_planner(name));
    }
    return *actor_;
}

std::string Player::advice(const Workers& workers, const std::string& policy, std::size_t moment) {
    require_block(policy);
    const std::scoped_lock run_lock(run_mutex_);
    halt();
    {
        const std::scoped_lock lock(mutex_);
        episode_.go_to(moment);
    }
    return episode_.action_json(actor_named(policy).act(episode_, [&] { return workers.stops(); }));
}

void Player::run(const std::shared_ptr<Workers>& workers, const std::string& policy,
                 std::int64_t steps) {
    require_block(policy);
    const std::scoped_lock run_lock(run_mutex_);
    halt();
    if (episode_.is_over()) throw Failure("the episode is over", "go back, or begin another one");
    const std::scoped_lock lock(mutex_);
    run_ = Job::start(workers, [player = shared_from_this(), policy, steps](Job& job) {
        return player->run_steps(job, policy, steps);
    });
}

Json Player::run_steps(Job& job, const std::string& policy, std::int64_t steps) {
    const solvers::Stops stops = [&job] {
        return job.stops();
    };
    PolicyActor& actor = actor_named(policy);
    for (std::int64_t left = steps; left > 0 && !episode_.is_over(); --left) {
        const Record action = actor.act(episode_, stops);
        if (job.stops()) break;
        MadeStep made = episode_.make_step(action);
        const std::scoped_lock lock(mutex_);
        episode_.keep(std::move(made), policy);
    }
    return nullptr;
}

std::string Player::updates(std::uint64_t branch, std::size_t since) const {
    const std::scoped_lock lock(mutex_);
    const std::size_t count = episode_.moments().size();
    // The last moment that the page has is sent again: an action may have been added to it.
    std::size_t k = branch == episode_.branch() && since > 0 ? std::min(since, count) - 1 : 0;
    std::string out = fmt::format(R"({{"branch":{},"first":{},"moments":[)", episode_.branch(), k);
    for (const std::size_t first = k; k < count && out.size() < message_size; ++k)
        out += (k == first ? "" : ",") + episode_.moment_json(k);
    return out + fmt::format(R"(],"count":{},"now":{},"run":{}}})", count, episode_.now_at(),
                             run_ ? json_line(run_->status()) : "null");
}

std::string Player::picture(std::size_t moment, const std::string& visualizer,
                            PictureSize size) const {
    DrawnMoments drawn;
    {
        const std::scoped_lock lock(mutex_);
        drawn = drawn_moments(episode_, moment);
    }
    return picture_of(episode_, drawn, visualizer, size);
}

}  // namespace rddlc::studio
