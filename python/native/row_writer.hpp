// Actions of many environments, checked and written in one pass.
#pragma once

#include "native/batch.hpp"

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

// Into the columns of action values from `first` on, one for each of `limits`: categories, which
// are int64, or numbers, which are float.
class RowWriter {
  public:
    RowWriter(Batch& batch, std::int64_t first, std::vector<RowLimits> limits, bool categories);

    // False, and nothing is changed, for rows of another kind or size, and those with an entry
    // outside its limits or that is nan.
    bool write(nanobind::handle rows);
    // The same, and a step by them, whether an episode has ended; nothing for what write() refuses.
    std::optional<bool> step(nanobind::handle rows, nanobind::handle into);

  private:
    template <class T>
    void copy(const T* entries);

    Batch& batch_;
    std::int64_t first_;
    std::vector<RowLimits> limits_;
    bool categories_;
};

void add_row_writer(nanobind::module_& module);

}  // namespace rddlc::python
