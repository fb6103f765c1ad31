// Some segments side by side, through which a gradient goes back in time.
#pragma once

#include "solvers/ppo/experience.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rddlc::solvers {

// Rows are samples in the order of their steps; within a step the longer segments come first.
class Unrolled {
  public:
    Unrolled() = default;
    // Holds at most so many segments of at most so many steps. The model must outlive this.
    Unrolled(const PpoModel& model, std::size_t segments, std::size_t longest);

    // Writes the samples, and takes down what of their steps matters here.
    void lay_out(const Experience& experience, std::span<const std::uint32_t> segments,
                 std::vector<std::uint32_t>& samples);
    // Inputs of the networks, row by row: behind the features comes what is remembered then.
    void remember(float* inputs);
    // The gradient by what is remembered in each row: zero at first, for the networks' gradients to
    // be added.
    float* d_memory() { return d_memory_.data(); }
    // Adds the gradient by the parameters of what remembers to `gradient`; `rows` are its
    // transposed weights.
    void add_gradient(const float* inputs, const float* rows, float* gradient);

  private:
    Sequence sequence() const { return {counts_, begins_.data()}; }

    const PpoModel* model_ = nullptr;
    std::vector<std::uint32_t> order_;  // of the segments
    std::vector<int> counts_;           // of each step
    std::vector<std::uint8_t> begins_;
    std::vector<float> initial_, before_, values_, d_memory_, scratch_;
};

}  // namespace rddlc::solvers
