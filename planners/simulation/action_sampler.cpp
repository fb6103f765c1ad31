#include "planners/simulation/action_sampler.hpp"

#include <algorithm>
#include <cmath>

namespace rddlc::planners {

using solvers::RealHead;

ActionSampler::ActionSampler(const solvers::ActionSpace& space,
                             const solvers::ActionRecords& records)
    : space_(space),
      records_(records),
      numbers_(static_cast<std::size_t>(space.real_count())),
      row_(static_cast<std::size_t>(space.column_count)),
      indices_(static_cast<std::size_t>(space.index_count())) {}

// Uniform between bounds. Where there are none it is not known how large a number has to be.
void ActionSampler::draw(RandomStream& stream, std::byte* record) {
    for (std::size_t r = 0; r < numbers_.size(); ++r)
        numbers_[r] = space_.reals[r].range == RealHead::Range::Bounded
                          ? static_cast<float>(2 * stream.unit() - 1)
                          : stream.bell() * std::exp(std::abs(stream.bell()));
    for (std::size_t i = 0; i < indices_.size(); ++i) indices_[i] = any_index(i, stream);
    write(record);
}

void ActionSampler::draw_near(const std::byte* centre, double spread, RandomStream& stream,
                              std::byte* record) {
    records_.read(centre, row_.data());
    solvers::read_action(space_, row_.data(), numbers_.data(), indices_.data());
    for (float& number : numbers_) number += static_cast<float>(spread) * stream.bell();
    if (!indices_.empty()) {
        // One value alone: the others are as good as they were.
        const auto place = stream.below(static_cast<std::uint32_t>(indices_.size()));
        if (numbers_.empty() || stream.below(2) == 0) indices_[place] = any_index(place, stream);
    }
    write(record);
}

std::int32_t ActionSampler::any_index(std::size_t place, RandomStream& stream) const {
    const int count =
        space_.max_sub_actions > 0 ? space_.logit_count : space_.categories[place].count;
    return static_cast<std::int32_t>(stream.below(static_cast<std::uint32_t>(count)));
}

void ActionSampler::write(std::byte* record) {
    // The first sub-action that stops is the last one.
    if (space_.max_sub_actions > 0) std::fill(std::ranges::find(indices_, 0), indices_.end(), 0);
    solvers::write_action(space_, numbers_.data(), indices_.data(), row_.data());
    std::ranges::copy(records_.default_record(), record);
    records_.write(row_.data(), record);
}

}  // namespace rddlc::planners
