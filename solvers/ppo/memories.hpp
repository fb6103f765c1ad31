// The memory of a recurrent policy in the episode of each environment (network/gru.hpp).
#pragma once

#include "solvers/ppo/model.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::solvers {

// Does nothing where the model remembers nothing.
class Memories {
  public:
    // The model must outlive this.
    Memories(const PpoModel& model, std::int64_t environments)
        : model_(model),
          row_(static_cast<std::size_t>(model.memory.padded_units)),
          states_(static_cast<std::size_t>(environments) * row_),
          values_(static_cast<std::size_t>(tile * model.memory.values())) {}

    void begin_episode(std::int64_t environment) {
        std::fill_n(states_.data() + static_cast<std::size_t>(environment) * row_, row_, 0.0f);
    }

    // Rows of the networks' inputs (PpoModel::input_row) of so many environments, at most a tile:
    // behind the features comes what is remembered once they have been seen.
    void look(std::int64_t first, int count, float* rows) {
        if (row_ == 0) return;
        gru_functions().step(model_.memory, model_.memory_parameters(), count, rows,
                             model_.input_row(), of(first), values_.data(),
                             rows + model_.features(), model_.input_row());
    }
    // The same, and keeps it for the next step.
    void remember(std::int64_t first, int count, float* rows) {
        look(first, count, rows);
        for (int i = 0; i < count; ++i)
            std::copy_n(rows + i * model_.input_row() + model_.features(), row_,
                        states_.data() + static_cast<std::size_t>(first + i) * row_);
    }

    // Rows of padded_units numbers, from that environment on.
    const float* of(std::int64_t environment) const {
        return states_.data() + static_cast<std::size_t>(environment) * row_;
    }

    template <class Archive>
    void archive(Archive& archive) {
        if (row_ > 0) archive.fixed(states_);
    }

  private:
    const PpoModel& model_;
    std::size_t row_;
    std::vector<float> states_;
    std::vector<float> values_;  // what a step of a tile computes on its way
};

}  // namespace rddlc::solvers
