// Observation values as the features that learners take.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::python {

// The features of a column of observation values: (value - middle) / half, or for objects one
// feature for each, which says in the same scale whether the value is that object. Features of
// numbers from lower to upper are from -1 to 1, whatever rounding does; lower > upper: they have no
// limits.
struct ColumnFeatures {
    std::int64_t objects;  // 0: the value is a number
    float middle, half, lower, upper;
};

class FeatureWriter {
  public:
    explicit FeatureWriter(std::vector<ColumnFeatures> columns);

    // values: (rows, columns) float, features: (rows, width()) float, one row behind the other.
    // Throws Refused for arrays of other sizes.
    void write(nanobind::handle values, nanobind::handle features, std::size_t rows) const;
    std::size_t width() const { return width_; }

  private:
    void write_row(const float* values, float* features) const;

    std::vector<ColumnFeatures> columns_;
    std::size_t width_;
};

void add_feature_writer(nanobind::module_& module);

}  // namespace rddlc::python
