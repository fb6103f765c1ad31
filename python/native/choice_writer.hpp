// Actions of many environments as learners choose them (translation/choice_actions.py), checked
// and written in one pass.
#pragma once

#include "native/env_pool.hpp"

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::python {

// A category from 0 to count - 1 sets a column of action values to `least` and more.
struct Category {
    std::int64_t column, count, least;
};

// A number from -1 to 1 stands for a value between two bounds, or where one is infinite, for one
// that grows as sinh from `origin`, in steps of `unit` (Squash in translation/action_plan.py).
struct Squash {
    double lower, upper, origin, unit;

    double value_of(double number) const;
};

// A number that lies within limits sets a column of action values.
struct Number {
    std::int64_t column;
    float lower, upper;
    std::optional<Squash> squash;
};

// The changes of the default action that categories stand for, where they stand for changes.
struct Changes {
    std::vector<std::int64_t> columns;  // -1: nothing changes
    std::vector<float> values;          // unless the column is that of a number
    std::vector<float> defaults;        // of all columns
};

struct Choices {
    std::vector<Category> categories;
    std::vector<Number> numbers;
    Changes changes;
    bool box;  // categories are also numbers, and come first: equal parts of -1 to 1
};

// It takes rows of int64 categories, or of float or double numbers, or a dictionary with both,
// "discrete" and "continuous"; of one environment also a whole number.
class ChoiceWriter {
  public:
    ChoiceWriter(EnvPool& batch, Choices choices);

    // A step by these actions, and whether an episode has ended. Nothing, and nothing is changed,
    // for actions of another form or size, and those with an entry outside its limits or that is
    // nan.
    std::optional<bool> step(nanobind::handle actions, nanobind::handle into);

  private:
    // Into categories_ and numbers_; false for actions that it does not take.
    bool read(nanobind::handle actions);
    bool read_categories(nanobind::handle given);
    bool read_numbers(nanobind::handle given);
    bool read_box(nanobind::handle given);
    template <class T>
    bool read_box_of(const T* entries);
    bool are_categories() const;
    template <class T>
    bool take_numbers(const T* entries, std::size_t stride);

    void write_row(const std::int64_t* categories, const double* numbers, float* values) const;
    void change_row(const std::int64_t* categories, const double* numbers, float* values) const;

    EnvPool& batch_;
    Choices choices_;
    std::vector<std::int64_t> number_of_;  // of each column, -1: a category sets it
    bool are_values_;                      // rows of numbers are rows of action values, as they are
    std::size_t rows_;
    std::vector<std::int64_t> categories_;  // (rows, categories)
    std::vector<double> numbers_;           // (rows, numbers), as they are given
};

void add_choice_writer(nanobind::module_& module);

}  // namespace rddlc::python
