#include "solvers/cgp/evaluator.hpp"

#include "solvers/evaluation/episodes.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::solvers {

namespace {

rddl_batch_options batch_options(const rddl_simulator& simulator, std::int64_t count) {
    rddl_batch_options options{};
    options.environment_count = count;
    options.thread_count = 1;
    options.horizon = horizon_of_learners(*simulator.problem).value_or(0);
    return options;
}

}  // namespace

std::int64_t episodes_at_once(const ProgramScope& scope, std::int64_t episodes) {
    constexpr std::int64_t most_lanes = 4096;
    if (scope.skdecide) return episodes;  // its programs remember all of them
    const auto units = static_cast<std::int64_t>(scope.units.size());
    return std::clamp<std::int64_t>(most_lanes / units, 1, episodes);
}

ProgramActor::ProgramActor(const rddl_simulator& simulator, const ProgramScope& scope,
                           std::int64_t programs, std::int64_t episodes)
    : scope_(scope),
      programs_(programs),
      episodes_(episodes),
      distribution_(simulator, scope.actions, Noise::White, 0, programs * episodes) {
    const auto environments = static_cast<std::size_t>(programs * episodes);
    const auto rows = [&](int row) {
        return environments * static_cast<std::size_t>(row);
    };
    features_.resize(static_cast<std::size_t>(scope.observations.feature_count()));
    outputs_.resize(rows(scope.actions.output_count()));
    numbers_.resize(rows(scope.actions.real_count()));
    shifts_.resize(numbers_.size());
    spreads_.resize(environments);
    log_probabilities_.resize(environments);
    indices_.resize(rows(scope.actions.index_count()));
    masks_.resize(rows(scope.actions.mask_size()));
    together_ = episodes_at_once(scope, episodes);
    const std::size_t lanes = scope.units.size() * static_cast<std::size_t>(together_);
    sums_.resize(static_cast<std::size_t>(scope.sum_count()));
    inputs_.resize(scope.inputs.size() * lanes);
    results_.resize(scope.outputs.size() * lanes);
}

void ProgramActor::act(rddl_batch* batch, std::span<const Program* const> programs,
                       std::span<const std::uint8_t> running, const float* observations,
                       std::span<const std::int64_t> steps, float* actions) {
    for (std::int64_t p = 0; p < programs_; ++p) {
        const auto at = static_cast<std::size_t>(p);
        if (!running[at]) continue;
        for (std::int64_t e = 0; e < episodes_; e += together_)
            run(*programs[at], at, p * episodes_ + e, std::min(together_, episodes_ - e),
                observations, steps[at]);
    }
    const Chosen chosen{numbers_.data(), shifts_.data(), spreads_.data(),
                        indices_.data(), masks_.data(),  log_probabilities_.data()};
    distribution_.choose(
        batch, outputs_.data(), scope_.actions.output_count(), {},
        [](std::int64_t) {
            return ChoiceKey{0, 0, 0};
        },
        chosen, actions);
}

// Runs so many environments from `first` on.
void ProgramActor::run(const Program& program, std::size_t number, std::int64_t first,
                       std::int64_t count, const float* observations, std::int64_t steps) {
    const int columns = scope_.observations.column_count();
    const int outputs = scope_.actions.output_count();
    const auto lanes = static_cast<int>(static_cast<std::int64_t>(scope_.units.size()) * count);
    const bool copies = scope_.observations.has_objects || scope_.observations.time;
    for (std::int64_t e = 0; e < count; ++e) {
        const float* features = observations + (first + e) * columns;
        if (copies) {
            write_features(scope_.observations, features, steps, true, features_.data());
            features = features_.data();
        }
        read_inputs(scope_, features, program.used_inputs(), sums_.data(), inputs_.data() + e,
                    count);
    }
    program.run(lanes, inputs_.data(), lanes, room_for(program, number, lanes, steps),
                results_.data());
    for (std::int64_t e = 0; e < count; ++e)
        write_outputs(scope_, results_.data() + e, count, outputs_.data() + (first + e) * outputs);
}

double* ProgramActor::room_for(const Program& program, std::size_t number, int lanes,
                               std::int64_t steps) {
    const std::size_t size =
        static_cast<std::size_t>(program.slots()) * static_cast<std::size_t>(lanes);
    if (!program.delayed()) {
        values_.resize(std::max(values_.size(), size));
        return values_.data();
    }
    memories_.resize(static_cast<std::size_t>(programs_));
    std::vector<double>& memory = memories_[number];
    // A program that begins to watch in the middle of an episode also has an empty memory.
    if (steps == 0 || memory.size() != size) memory.assign(size, 0.0);
    return memory.data();
}

Evaluator::Evaluator(const rddl_simulator& simulator, const ProgramScope& scope,
                     std::int64_t programs, std::int64_t episodes, const Stops* stops)
    : simulator_(simulator),
      space_(scope.observations),
      room_(programs),
      episodes_(episodes),
      stops_(stops),
      batch_(create_batch(simulator, batch_options(simulator, programs * episodes))),
      actor_(simulator, scope, programs, episodes) {
    actor_.set_stops(stops_);
    const auto environments = static_cast<std::size_t>(programs * episodes);
    observations_.resize(environments *
                         static_cast<std::size_t>(scope.observations.column_count()));
    actions_.resize(environments * static_cast<std::size_t>(scope.actions.column_count));
    rewards_.resize(environments);
    for (auto* each : {&causes_, &ended_}) each->resize(environments);
    running_.resize(static_cast<std::size_t>(programs));
    steps_.resize(running_.size());
    seeds_.resize(environments);
}

void Evaluator::evaluate(std::span<const Program* const> programs,
                         std::span<const std::uint64_t> seeds, double* returns, double* lengths,
                         double* reach) {
    const auto count = static_cast<std::int64_t>(programs.size());
    const std::int64_t environments = count * episodes_;
    // Unused places repeat the first program; their results are ignored.
    programs_.assign(programs.begin(), programs.end());
    programs_.resize(static_cast<std::size_t>(room_), programs.front());
    for (std::size_t i = 0; i < seeds_.size(); ++i)
        seeds_[i] = seeds[i % static_cast<std::size_t>(episodes_)];
    const auto all = static_cast<std::int64_t>(seeds_.size());
    if (simulator_.problem->stochastic)
        require_done(simulator_, simulator_.set_seeds(batch_.get(), 0, all, seeds_.data()));
    require_done(simulator_, simulator_.reset(batch_.get(), nullptr, nullptr));
    require_done(simulator_,
                 simulator_.get_observation_values(batch_.get(), RDDL_FLOAT, observations_.data()));
    if (reach) begin_reach();
    std::fill_n(returns, environments, 0.0);
    std::fill_n(lengths, environments, 0.0);
    std::fill(ended_.begin(), ended_.end(), 0);
    require_done(simulator_, simulator_.get_causes(batch_.get(), 0, all, causes_.data()));
    for (std::int64_t i = 0; i < all; ++i)
        ended_[static_cast<std::size_t>(i)] =
            i >= environments || causes_[static_cast<std::size_t>(i)] != RDDL_RUNNING;
    rddl_transition out{};
    out.struct_size = sizeof out;
    out.rewards = rewards_.data();
    out.causes = causes_.data();
    for (std::int64_t step = 0;; ++step) {
        bool any = false;
        for (std::int64_t p = 0; p < room_; ++p) {
            const auto begin = ended_.begin() + p * episodes_;
            const bool runs = !std::all_of(begin, begin + episodes_, [](auto e) { return e; });
            running_[static_cast<std::size_t>(p)] = runs;
            any |= runs;
        }
        if (!any) break;
        std::fill(steps_.begin(), steps_.end(), step);
        actor_.act(batch_.get(), programs_, running_, observations_.data(), steps_,
                   actions_.data());
        if (is_stopped(stops_)) return;
        require_done(simulator_, simulator_.step_values(batch_.get(), RDDL_FLOAT, actions_.data(),
                                                        observations_.data(), &out));
        if (reach) follow_reach();
        for (std::int64_t i = 0; i < environments; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (ended_[at]) continue;
            ended_[at] = causes_[at] != RDDL_RUNNING;
            if (causes_[at] & RDDL_FAULTED) continue;  // a step that faults is not made
            returns[i] += std::isfinite(rewards_[at]) ? rewards_[at] : -1e300;
            lengths[i] += 1;
        }
    }
    if (reach) tell_reach(environments, reach);
}

void Evaluator::begin_reach() {
    first_ = least_ = most_ = observations_;
}

// Environments whose episodes are over stay as they are.
void Evaluator::follow_reach() {
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        least_[k] = std::min(least_[k], observations_[k]);
        most_[k] = std::max(most_[k], observations_[k]);
    }
}

void Evaluator::tell_reach(std::int64_t environments, double* reach) const {
    std::size_t k = 0;
    for (std::int64_t i = 0; i < environments; ++i) {
        reach[i] = 0;
        for (const ObservationSpace::Column& column : space_.columns) {
            const bool is_bounded = std::isfinite(column.lower) && std::isfinite(column.upper) &&
                                    column.lower < column.upper;
            const double unit = is_bounded ? (column.upper - column.lower) / 2
                                           : 1 + std::abs(static_cast<double>(first_[k]));
            const double width = static_cast<double>(most_[k]) - static_cast<double>(least_[k]);
            if (std::isfinite(width)) reach[i] += std::log1p(width / unit);
            ++k;
        }
    }
}

}  // namespace rddlc::solvers
