// A reward for seeing more of the problem, where returns do not distinguish episodes.
//
// In a problem that pays at its goal alone there is nothing to learn from until an episode gets
// there. So as long as nearly all episodes have the same return, each step is rewarded by how much
// it widens the range of the episode's observations. The reward fades as other returns come.
#pragma once

#include "solvers/ppo/model.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

// The observations of each environment's episode so far.
class Seen {
  public:
    Seen() = default;
    Seen(const PpoModel& model, std::size_t environments)
        : row_(static_cast<std::size_t>(model.features())),
          looked_at_(static_cast<std::size_t>(model.observations.frame_size())),
          least_(environments * row_),
          most_(least_.size()) {}

    void begin_episode(std::size_t environment, const float* features) {
        std::copy_n(features, row_, least_.data() + environment * row_);
        std::copy_n(features, row_, most_.data() + environment * row_);
    }

    // The growth of the ranges, in deviations of each feature, as a mean over features. The newest
    // observation counts; the time and older observations do not.
    float widen(std::size_t environment, const float* features, const float* factors) {
        float* const least = least_.data() + environment * row_;
        float* const most = most_.data() + environment * row_;
        float sum = 0;
        for (std::size_t f = 0; f < looked_at_; ++f) {
            const float below = std::max(least[f] - features[f], 0.0f);
            const float above = std::max(features[f] - most[f], 0.0f);
            sum += (below + above) * factors[f];
            least[f] = std::min(least[f], features[f]);
            most[f] = std::max(most[f], features[f]);
        }
        return looked_at_ > 0 ? std::min(sum / static_cast<float>(looked_at_), 10.0f) : 0;
    }

    template <class Archive>
    void archive(Archive& archive) {
        archive.fixed(least_);
        archive.fixed(most_);
    }

  private:
    std::size_t row_ = 0, looked_at_ = 0;
    std::vector<float> least_, most_;  // rows of features
};

// The weight of seeing more, from 0 to 1, by the returns of the last episodes: 1 if all are the
// same, 0 if one in ten differs from the least.
inline double curiosity(std::span<const double> returns) {
    constexpr std::size_t fewest = 20;  // that carry information
    if (returns.size() < fewest) return 0;
    const double least = *std::min_element(returns.begin(), returns.end());
    const auto others = std::count_if(returns.begin(), returns.end(),
                                      [least](double each) { return each != least; });
    return std::max(0.0,
                    1 - 10 * static_cast<double>(others) / static_cast<double>(returns.size()));
}

}  // namespace rddlc::solvers
