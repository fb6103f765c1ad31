#include "planners/rollout/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rddlc::planners {

namespace {

constexpr std::int64_t longest_rollout = 1000;

// No fewer lanes than a policy and one other action need.
std::int64_t lanes_of(const RolloutOptions& options) {
    const std::int64_t affordable = options.budget.steps.value_or(most_steps);
    return std::clamp<std::int64_t>(affordable / 4, 2, std::max(options.lanes, 2));
}

}  // namespace

double Rollout::Candidate::error() const {
    if (draws < 2) return 0;
    const auto n = static_cast<double>(draws);
    return std::sqrt(std::max(0.0, squares / n - mean() * mean()) / (n - 1));
}

Rollout::Rollout(const PlannerContext& context, const RolloutOptions& options)
    : simulator_(context.simulator),
      options_(options),
      space_(solvers::action_space(simulator_)),
      records_(simulator_),
      action_size_(static_cast<std::size_t>(simulator_.problem->action_size)),
      actions_(FiniteActions::of(simulator_, space_, static_cast<std::size_t>(options.actions))),
      continuations_(simulator_, lanes_of(options), context.horizon, false),
      policy_(simulator_, *context.base, static_cast<std::int64_t>(continuations_.lanes())),
      random_(simulator_, solvers::random_policy(simulator_, options.seed), options.actions) {}

void Rollout::find_candidates(const DecisionPoint& point, RandomStream& stream) {
    candidates_.clear();
    known_.clear();
    const auto add = [&](const std::byte* action) {
        const std::string_view bytes(reinterpret_cast<const char*>(action), action_size_);
        if (known_.insert(bytes).second) candidates_.push_back({action});
    };
    add(point.base_action);
    if (actions_) {
        actions_->find_legal(point.origin, legal_);
        for (std::size_t a = 0; a < actions_->count(); ++a)
            if (legal_[a]) add(actions_->record(a));
    } else {
        draw_actions(point, stream);
        for (std::size_t a = 0; a * action_size_ < drawn_.size(); ++a)
            if (candidates_.size() < static_cast<std::size_t>(options_.actions))
                add(drawn_.data() + a * action_size_);
    }
    left_.resize(candidates_.size());
    for (std::size_t c = 0; c < left_.size(); ++c) left_[c] = c;
}

// No-op, random actions, and mixtures of these with the policy's.
void Rollout::draw_actions(const DecisionPoint& point, RandomStream& stream) {
    const auto count = static_cast<std::size_t>(options_.actions);
    if (!sampling_) {
        sampling_.emplace(simulator_, options_.actions, point.horizon);
        repair_ = solvers::RepairBuffers(simulator_, space_, options_.actions);
        drawn_.resize(count * action_size_);
        rows_.resize(count * static_cast<std::size_t>(space_.column_count));
        base_row_.resize(static_cast<std::size_t>(space_.column_count));
    }
    streams_.clear();
    for (std::size_t k = 0; k < count; ++k) streams_.push_back(stream.bits());
    sampling_->begin(point.origin, streams_);
    random_.begin(point.episode, point.step, point.horizon, streams_);
    const std::vector<std::uint8_t> all(count, 1);
    random_.act(*sampling_, all, drawn_.data(), point.stops);
    records_.read(point.base_action, base_row_.data());
    constexpr float shares[] = {1, 0.5f, 0.2f, 0.05f};  // of what is random
    for (std::size_t k = 0; k < count; ++k) {
        float* const row = rows_.data() + k * base_row_.size();
        records_.read(drawn_.data() + k * action_size_, row);
        if (k == 0) std::ranges::copy(space_.defaults, row);
        const float share = k == 0 ? 1 : shares[k % 4];
        for (const solvers::RealHead& head : space_.reals) {
            float& value = row[head.column];
            value = base_row_[static_cast<std::size_t>(head.column)] * (1 - share) + value * share;
        }
        if (share < 1 && space_.max_sub_actions == 0)
            for (const solvers::CategoryHead& head : space_.categories)
                if (head.group.empty() && stream.unit() >= static_cast<double>(share))
                    row[head.column] = base_row_[static_cast<std::size_t>(head.column)];
        records_.write(row, drawn_.data() + k * action_size_);
    }
    if (space_.may_be_illegal)
        solvers::repair_actions(simulator_, space_, records_, sampling_->batch(), rows_.data(),
                                drawn_.data(), repair_);
}

// All that are left, each with the same random streams, as many as there are lanes for.
bool Rollout::try_all(const DecisionPoint& point, RandomStream& stream, BudgetMeter& meter) {
    const std::int64_t wanted = std::min(point.left, options_.horizon.value_or(longest_rollout));
    const auto left = static_cast<std::int64_t>(left_.size());
    const std::size_t lanes = continuations_.lanes();
    // Where there are more actions than lanes, one draw takes several batches.
    const auto draws = static_cast<std::size_t>(std::max<std::int64_t>(
        1, std::min(static_cast<std::int64_t>(lanes) / left, meter.steps_left() / left / wanted)));
    const std::int64_t depth =
        std::min(wanted, meter.steps_left() / (left * static_cast<std::int64_t>(draws)));
    if (depth == 0) return false;
    starts_.clear();
    for (std::size_t d = 0; d < draws; ++d) {
        const std::uint64_t draw = stream.bits();
        for (const std::size_t c : left_)
            starts_.push_back({nullptr, point.step, candidates_[c].action, depth, draw});
    }
    values_.resize(starts_.size());
    for (std::size_t first = 0; first < starts_.size(); first += lanes) {
        const auto some =
            std::span(starts_).subspan(first, std::min(lanes, starts_.size() - first));
        // The first values are better than no values, though they are of fewer steps.
        const bool is_first = candidates_.front().draws == 0 && starts_.size() <= lanes;
        if (!continuations_.run(point, some, policy_, meter) &&
            !(is_first && continuations_.depth() > 0))
            return false;
        for (std::size_t k = 0; k < some.size(); ++k) values_[first + k] = continuations_.value(k);
    }
    depth_ = depth;
    for (std::size_t d = 0; d < draws; ++d) {
        const double* const row = values_.data() + d * left_.size();
        for (std::size_t k = 0; k < left_.size(); ++k) {
            Candidate& candidate = candidates_[left_[k]];
            // Both may be -inf, if the policy also faults.
            const double difference =
                row[k] == row[0] ? 0 : std::clamp(row[k] - row[0], -1e300, 1e300);
            candidate.sum += row[k];
            candidate.difference += difference;
            candidate.squares += difference * difference;
            candidate.draws += 1;
        }
    }
    return true;
}

// The better half stays, and the policy's action. Half of a batch of candidates, each with two
// draws, is a batch again.
void Rollout::halve() {
    if (left_.size() <= 2) return;
    std::stable_sort(left_.begin() + 1, left_.end(), [&](std::size_t a, std::size_t b) {
        return candidates_[a].mean() > candidates_[b].mean();
    });
    left_.resize((left_.size() + 1) / 2);
}

std::size_t Rollout::best() const {
    std::size_t best = 0;
    for (const std::size_t c : left_) {
        const Candidate& candidate = candidates_[c];
        if (candidate.draws == 0) continue;
        const bool is_sure = candidate.mean() > options_.confidence * candidate.error();
        if (is_sure && candidate.mean() > (best == 0 ? 0 : candidates_[best].mean())) best = c;
    }
    return best;
}

void Rollout::decide(const DecisionPoint& point, std::byte* action, Explanation* explanation) {
    RandomStream stream(options_.seed, point.episode, point.step);
    BudgetMeter meter(options_.budget, point.stops);
    find_candidates(point, stream);
    depth_ = 0;
    const double rounds = std::ceil(std::log2(static_cast<double>(candidates_.size())));
    for (double round = 1; candidates_.size() > 1; ++round) {
        bool is_done = true;
        do {
            is_done = try_all(point, stream, meter);
            meter.add_iterations();
        } while (is_done && meter.has_room(1, 0) && meter.used() * rounds < round);
        if (!is_done || !meter.has_room(1, 0)) break;
        if (!simulator_.problem->stochastic && left_.size() <= 2) break;
        halve();
    }
    const std::size_t chosen = best();
    std::copy_n(candidates_[chosen].action, action_size_, action);
    if (explanation) note_explanation(*explanation, chosen, meter);
}

void Rollout::note_explanation(Explanation& explanation, std::size_t chosen,
                               const BudgetMeter& meter) const {
    explanation.depth = depth_;
    explanation.iterations = meter.iterations();
    explanation.steps = meter.steps();
    explanation.chosen = chosen;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
        const Candidate& candidate = candidates_[c];
        const auto draws = static_cast<double>(std::max<std::int64_t>(candidate.draws, 1));
        explanation.candidates.push_back({c == 0 ? "policy" : "action",
                                          {candidate.action, candidate.action + action_size_},
                                          candidate.sum / draws,
                                          candidate.error(),
                                          candidate.draws});
    }
}

}  // namespace rddlc::planners
