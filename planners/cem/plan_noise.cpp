#include "planners/cem/plan_noise.hpp"

#include <cmath>

namespace rddlc::planners {
namespace {

std::uint32_t key_of(RandomStream& stream) {
    return static_cast<std::uint32_t>(stream.bits() >> 32);
}

}  // namespace

PlanNoise::PlanNoise(std::size_t plans, int reals, int ranks, std::span<const double> correlations)
    : loops_(plan_loops()),
      plans_(plans),
      nothing_(plans, 0.0f),
      all_(plans, 1.0f),
      widths_(static_cast<std::size_t>(reals) * plans, 1.0f),
      no_chance_(plans, 0),
      habits_(plans, 0),
      stretches_(plans, 1.0f),
      numbers_(static_cast<std::size_t>(reals) * plans),
      ranks_(static_cast<std::size_t>(ranks) * plans) {
    for (std::size_t p = 0; p < plans; ++p) {
        const double correlation = correlations[p % correlations.size()];
        old_.push_back(static_cast<float>(correlation));
        fresh_.push_back(static_cast<float>(std::sqrt(1 - correlation * correlation)));
        const double of_ranks = correlations[p / (2 * correlations.size()) % correlations.size()];
        keep_.push_back(static_cast<std::uint32_t>(std::lround(256 * of_ranks)));
    }
}

void PlanNoise::restart(RandomStream& stream) {
    is_first_ = true;
    for (float* row = widths_.data(); row < widths_.data() + widths_.size(); row += plans_)
        loops_.draw_widths(key_of(stream), plans_, row);
    if (ranks_.empty()) return;
    for (std::size_t p = 1; p < plans_; p += 2) {
        constexpr double rarest = 7;  // in powers of two
        const double departs = std::exp2(-rarest * stream.unit());
        habits_[p] = static_cast<std::int32_t>((1 - departs) * rank_count);
        stretches_[p] = static_cast<float>(1 / departs);
    }
}

void PlanNoise::next_step(RandomStream& stream) {
    const float* const old = is_first_ ? nothing_.data() : old_.data();
    const float* const fresh = is_first_ ? all_.data() : fresh_.data();
    for (float* row = numbers_.data(); row < numbers_.data() + numbers_.size(); row += plans_)
        loops_.next_numbers({key_of(stream), old, fresh}, plans_, row);
    const std::uint32_t* const keep = is_first_ ? no_chance_.data() : keep_.data();
    for (std::int32_t* row = ranks_.data(); row < ranks_.data() + ranks_.size(); row += plans_)
        loops_.next_ranks({key_of(stream), keep}, plans_, row);
    is_first_ = false;
}

}  // namespace rddlc::planners
