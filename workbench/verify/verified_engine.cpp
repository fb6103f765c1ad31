#include "verify/verified_engine.hpp"

#include "engines/faults.hpp"

#include <algorithm>
#include <stdexcept>

namespace rddlc::workbench {

namespace {

void expect_ok(rddl_error error, const char* what) {
    if (error != RDDL_OK) throw std::logic_error(std::string("a simulator refuses ") + what);
}

}  // namespace

VerifiedEnvironments::VerifiedEnvironments(const VerifiedEngine& engine, std::int64_t count,
                                           std::uint64_t seed, std::int64_t horizon)
    : simulator_(engine.simulator), count_(count) {
    rddl_batch_options options{};
    options.seed = seed;
    options.thread_count = 1;  // rounds are short, and threads would wait for each other
    options.autoreset = RDDL_AUTORESET_DISABLED;
    options.horizon = horizon;
    options.lane_count = engine.lanes;
    options.environment_count = engine.one_by_one ? 1 : count;
    for (std::int64_t first = 0; first < count; first += options.environment_count) {
        options.first_environment = first;
        batches_.push_back(solvers::create_batch(*simulator_, options));
    }
}

VerifiedEnvironments::Seat VerifiedEnvironments::seat(std::int64_t environment) const {
    if (batches_.size() == 1) return {batches_.front().get(), environment};
    return {batches_[static_cast<std::size_t>(environment)].get(), 0};
}

template <class Visit>
void VerifiedEnvironments::for_each_batch(const Visit& visit) const {
    for (std::size_t i = 0; i < batches_.size(); ++i)
        visit(batches_[i].get(), static_cast<std::int64_t>(i));
}

void VerifiedEnvironments::restart(const std::vector<std::uint8_t>& mask) {
    for_each_batch([&](rddl_batch* batch, std::int64_t first) {
        expect_ok(simulator_->reset(batch, mask.data() + first, nullptr), "to start an episode");
    });
}

void VerifiedEnvironments::set_state(std::int64_t environment, const Record& state) {
    if (state.empty()) return;
    const auto [batch, place] = seat(environment);
    expect_ok(simulator_->set_state(batch, place, 1, state.data(), nullptr), "a state");
}

const std::vector<std::byte>& VerifiedEnvironments::act() {
    const std::int64_t size = simulator_->problem->action_size;
    policy_actions_.resize(std::max<std::size_t>(record(count_, size), 1));
    for_each_batch([&](rddl_batch* batch, std::int64_t first) {
        expect_ok(simulator_->policy_act(batch, policy_actions_.data() + record(first, size)),
                  "to ask its policy");
    });
    return policy_actions_;
}

std::vector<StepOutcome> VerifiedEnvironments::step(const std::vector<std::byte>& actions) {
    const rddl_problem& problem = *simulator_->problem;
    std::vector<StepOutcome> outcomes = look();
    const auto count = static_cast<std::size_t>(count_);
    std::vector<std::int32_t> violated(count, -1);
    std::vector<double> rewards(count);
    std::vector<std::uint8_t> causes(count);
    for_each_batch([&](rddl_batch* batch, std::int64_t first) {
        const std::byte* const own = actions.data() + record(first, problem.action_size);
        expect_ok(simulator_->violated_preconditions(batch, own, violated.data() + first),
                  "an action");
        rddl_transition out{};
        out.rewards = rewards.data() + first;
        out.causes = causes.data() + first;
        expect_ok(simulator_->step(batch, own, &out), "an action");
    });
    for (std::size_t i = 0; i < count; ++i) {
        const auto environment = static_cast<std::int64_t>(i);
        StepOutcome& outcome = outcomes[i];
        if (!policy_actions_.empty()) {
            const std::byte* const own =
                policy_actions_.data() + record(environment, problem.action_size);
            outcome.action = Record(own, own + problem.action_size);
        }
        outcome.violated_precondition = violated[i];
        outcome.reward = rewards[i];
        outcome.causes = causes[i];
        describe(outcome, environment);
    }
    policy_actions_.clear();
    return outcomes;
}

std::vector<StepOutcome> VerifiedEnvironments::look() const {
    std::vector<StepOutcome> outcomes(static_cast<std::size_t>(count_));
    for (std::int64_t i = 0; i < count_; ++i) {
        StepOutcome& outcome = outcomes[static_cast<std::size_t>(i)];
        const auto [batch, place] = seat(i);
        simulator_->get_causes(batch, place, 1, &outcome.causes_before);
        outcome.state = state(i);
    }
    return outcomes;
}

void VerifiedEnvironments::describe(StepOutcome& outcome, std::int64_t environment) const {
    outcome.state = state(environment);
    if (simulator_->problem->partially_observed) outcome.observation = observation(environment);
    if (!(outcome.causes & RDDL_FAULTED)) return;
    const auto [batch, place] = seat(environment);
    outcome.fault = fault_text(*simulator_, *batch, place);
}

Record VerifiedEnvironments::state(std::int64_t environment) const {
    const auto [batch, place] = seat(environment);
    Record state(static_cast<std::size_t>(simulator_->problem->state_size));
    simulator_->get_state(batch, place, 1, state.data());
    return state;
}

Record VerifiedEnvironments::observation(std::int64_t environment) const {
    const auto [batch, place] = seat(environment);
    Record observation(static_cast<std::size_t>(simulator_->problem->observation_size));
    simulator_->get_observation(batch, place, 1, observation.data());
    return observation;
}

std::int64_t VerifiedEnvironments::steps(std::int64_t environment) const {
    const auto [batch, place] = seat(environment);
    std::int64_t steps = 0, episodes = 0;
    simulator_->get_progress(batch, place, 1, &steps, &episodes);
    return steps;
}

std::int64_t VerifiedEnvironments::episodes(std::int64_t environment) const {
    const auto [batch, place] = seat(environment);
    std::int64_t steps = 0, episodes = 0;
    simulator_->get_progress(batch, place, 1, &steps, &episodes);
    return episodes;
}

}  // namespace rddlc::workbench
