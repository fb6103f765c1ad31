// Actions of many environments, checked and written in one pass.
#pragma once

#include "native/env_pool.hpp"

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rddlc::python {

// The limits of an entry of a row, and the offset that is added to it.
struct RowLimits {
    float lower, upper, offset;
};

// The changes of the default action that categories stand for, where they stand for changes.
struct RowChanges {
    std::vector<std::int64_t> columns;  // -1: nothing changes
    std::vector<float> values;
    std::vector<float> defaults;  // of all columns
};

// Into the columns of action values from `first` on, one for each of `limits`: categories, which
// are int64, or numbers, which are float or double. With `changes` each category is one of these.
class RowWriter {
  public:
    RowWriter(EnvPool& batch, std::int64_t first, std::vector<RowLimits> limits, bool categories,
              RowChanges changes);

    // False, and nothing is changed, for rows of another kind or size, and those with an entry
    // outside its limits or that is nan.
    bool write(nanobind::handle rows);
    // The same, and a step by them, whether an episode has ended; nothing for what write() refuses.
    std::optional<bool> step(nanobind::handle rows, nanobind::handle into);

  private:
    template <class T>
    bool write_entries(const T* entries);
    template <class T>
    void copy(const T* entries);
    void change(const std::int64_t* entries);

    EnvPool& batch_;
    std::int64_t first_;
    std::vector<RowLimits> limits_;
    bool categories_;
    RowChanges changes_;
};

void add_row_writer(nanobind::module_& module);

}  // namespace rddlc::python
