#include "studio/stepped_episode.hpp"

#include "formats/trace.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace rddlc::studio {

using namespace workbench;

namespace {

// An episode that is kept with all its snapshots.
constexpr std::size_t most_bytes = std::size_t{1} << 28;

Record default_action_of(const rddl_problem& problem) {
    const auto* const defaults = static_cast<const std::byte*>(problem.default_action);
    return {defaults, defaults + problem.action_size};
}

void write_first_values(std::string& out, const RecordLayout& layout, const std::byte* record) {
    const std::vector<RecordEntry>& entries = layout.entries();
    for (std::size_t k = 0; k < std::min(entries.size(), most_values); ++k) {
        out += k == 0 ? '{' : ',';
        write_string(out, entries[k].name);
        out += ':';
        write_value(out, entries[k], record);
    }
    out += entries.empty() ? "{}" : "}";
}

std::size_t bytes_of(const Moment& moment) {
    return moment.state.size() + moment.observation.size() + moment.snapshot.size() +
           moment.action.size() + sizeof moment;
}

}  // namespace

SteppedEpisode::SteppedEpisode(Simulator simulator, std::uint64_t seed, std::int64_t episode,
                               std::int64_t horizon)
    : simulator_(std::move(simulator)),
      seed_(seed),
      number_(episode),
      horizon_(horizon),
      states_(problem(), RDDL_STATE),
      actions_(problem(), RDDL_ACTION),
      observations_(problem(), RDDL_OBSERVATION),
      batch_(beginning()),
      moments_{present()} {}

solvers::BatchHandle SteppedEpisode::beginning() const {
    return solvers::create_environment(*simulator_, number_, seed_, horizon_);
}

Moment SteppedEpisode::present() const {
    const rddl_simulator& s = *simulator_;
    Moment moment;
    moment.state.resize(states_.size());
    solvers::require_done(s, s.get_state(batch_.get(), 0, 1, moment.state.data()));
    if (problem().partially_observed) {
        moment.observation.resize(observations_.size());
        solvers::require_done(s, s.get_observation(batch_.get(), 0, 1, moment.observation.data()));
    }
    solvers::require_done(s, s.get_causes(batch_.get(), 0, 1, &moment.causes));
    if (moment.causes & RDDL_FAULTED) moment.fault = solvers::fault_text(s, *batch_, 0);
    moment.snapshot.resize(static_cast<std::size_t>(s.snapshot_size(&s)));
    solvers::require_done(s, s.get_snapshots(batch_.get(), 0, 1, moment.snapshot.data()));
    return moment;
}

void SteppedEpisode::go_to(std::size_t moment) {
    if (moment >= moments_.size()) throw Failure(fmt::format("the episode has no step {}", moment));
    solvers::require_done(*simulator_, simulator_->set_snapshots(batch_.get(), 0, 1,
                                                                 moments_[moment].snapshot.data()));
    now_ = moment;
}

Record SteppedEpisode::read_action(const nlohmann::json& values) const {
    const Record defaults = default_action_of(problem());
    Record action = defaults;
    if (const auto error = actions_.read(values, action.data())) throw Failure(*error);
    const std::int64_t changes = actions_.count_changes(action.data(), defaults.data());
    if (problem().max_nondef_actions >= 0 && changes > problem().max_nondef_actions)
        throw Failure(fmt::format("{} action values differ from their default; at most {} may",
                                  changes, problem().max_nondef_actions));
    return action;
}

std::string SteppedEpisode::violation_of(const Record& action) const {
    if (problem().precondition_count == 0 || is_over()) return "";
    rddl_violation violation{};
    violation.struct_size = sizeof violation;
    solvers::require_done(
        *simulator_, simulator_->explain_violation(batch_.get(), 0, action.data(), &violation));
    if (violation.precondition < 0) return "";
    return violation.message;
}

MadeStep SteppedEpisode::make_step(const Record& action) {
    if (is_over()) throw Failure("the episode is over", "go back, or begin another one");
    if (now().bytes > most_bytes)
        throw Failure("an episode of so many bytes is not kept here",
                      "'rddl run --trace' writes longer ones into a file");
    MadeStep made{action, 0, violation_of(action), {}};
    rddl_transition out{};
    out.rewards = &made.reward;
    solvers::require_done(*simulator_, simulator_->step(batch_.get(), action.data(), &out));
    made.next = present();
    made.next.total = now().total + (made.next.causes & RDDL_FAULTED ? 0 : made.reward);
    return made;
}

void SteppedEpisode::keep(MadeStep step, std::string by) {
    branch_ += now_ + 1 < moments_.size() ? 1 : 0;
    moments_.resize(now_ + 1);
    Moment& taken = moments_.back();
    taken.action = std::move(step.action);
    taken.reward = step.reward;
    taken.by = std::move(by);
    taken.warning = std::move(step.warning);
    step.next.bytes = taken.bytes + bytes_of(taken);
    moments_.push_back(std::move(step.next));
    ++now_;
}

std::string SteppedEpisode::action_json(const Record& action) const {
    std::string out;
    actions_.write_changes(out, action.data(), default_action_of(problem()).data());
    return out;
}

std::string SteppedEpisode::moment_json(std::size_t number) const {
    const Moment& moment = moments_.at(number);
    std::string out = fmt::format(R"({{"step":{},"state":)", number);
    write_first_values(out, states_, moment.state.data());
    if (!moment.observation.empty()) {
        out += R"(,"observation":)";
        write_first_values(out, observations_, moment.observation.data());
    }
    out += R"(,"total":)";
    write_real(out, moment.total);
    if (!moment.action.empty()) {
        out += R"(,"action":)" + action_json(moment.action);
        out += R"(,"reward":)";
        write_real(out, moment.reward);
        out += R"(,"by":)";
        write_string(out, moment.by);
    }
    if (!moment.warning.empty()) {
        out += R"(,"warning":)";
        write_string(out, moment.warning);
    }
    if (moment.causes != RDDL_RUNNING) out += R"(,"ended":)" + causes_json(moment.causes);
    if (!moment.fault.empty()) {
        out += R"(,"fault":)";
        write_string(out, moment.fault);
    }
    return out + "}";
}

}  // namespace rddlc::studio
