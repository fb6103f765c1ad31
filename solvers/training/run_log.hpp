// The course of a training: progress.csv and TensorBoard's events.
#pragma once

#include "solvers/training/training.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

class RunLog {
  public:
    // Columns are those of the first row. Each row begins with steps and seconds.
    void add(std::int64_t steps, double seconds, double wall_time, const Row& row);

    std::string csv() const;
    // TFRecords of tensorboard.Event messages, without the values that are nan.
    std::string events() const;

    template <class Archive>
    void archive(Archive& archive) {
        archive(columns_);
        archive(numbers_);
        if constexpr (Archive::is_loading) check_loaded();
    }

  private:
    std::size_t width() const;
    // Throws a Failure where what was loaded can be no log.
    void check_loaded() const;
    std::string columns_;          // names, each with a line break
    std::vector<double> numbers_;  // row by row: wall time, steps, seconds, the row
};

}  // namespace rddlc::solvers
