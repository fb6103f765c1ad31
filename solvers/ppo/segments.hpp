// Segments, of which minibatches are made: steps that are learned from one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// The rollout of each environment in as few parts as their longest length allows, whose lengths
// differ by one step at most. Where nothing is remembered, each step is a segment.
//
// Segment k * environments + e is part k of environment e; samples are numbered as in Experience.
class Segments {
  public:
    Segments() = default;
    Segments(int environments, int rollout, int longest_length)
        : environments_(static_cast<std::uint32_t>(environments)) {
        const std::int64_t parts = (rollout + longest_length - 1) / longest_length;
        for (std::int64_t part = 1; part <= parts; ++part)
            begins_.push_back(static_cast<std::uint32_t>(rollout * part / parts));
        longest_ = static_cast<int>((rollout + parts - 1) / parts);
    }

    std::size_t count() const { return (begins_.size() - 1) * environments_; }
    // Whether a part begins with that step of the rollout.
    bool begins(int part, int step) const {
        return begins_[static_cast<std::size_t>(part)] == static_cast<std::uint32_t>(step);
    }
    int longest() const { return longest_; }
    int length(std::uint32_t segment) const {
        const std::size_t part = segment / environments_;
        return static_cast<int>(begins_[part + 1] - begins_[part]);
    }
    // The sample of its step t.
    std::uint32_t sample(std::uint32_t segment, int t) const {
        const std::uint32_t step = begins_[segment / environments_] + static_cast<std::uint32_t>(t);
        return step * environments_ + segment % environments_;
    }

  private:
    std::uint32_t environments_ = 1;
    std::vector<std::uint32_t> begins_ = {0};  // the step of each part, and the end of the last one
    int longest_ = 1;
};

}  // namespace rddlc::solvers
