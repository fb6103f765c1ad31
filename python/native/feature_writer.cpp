#include "native/feature_writer.hpp"

#include "native/buffers.hpp"

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

FeatureWriter::FeatureWriter(std::vector<ColumnFeatures> columns)
    : columns_(std::move(columns)), width_(0) {
    for (const ColumnFeatures& column : columns_)
        width_ += static_cast<std::size_t>(std::max<std::int64_t>(column.objects, 1));
}

void FeatureWriter::write(nb::handle values, nb::handle features, std::size_t rows) const {
    const auto* from = memory_of<const float>(values, rows * columns_.size());
    auto* to = memory_of<float>(features, rows * width_);
    for (std::size_t row = 0; row < rows; ++row, from += columns_.size(), to += width_)
        write_row(from, to);
}

void FeatureWriter::write_row(const float* values, float* features) const {
    for (const ColumnFeatures& column : columns_) {
        const float value = *values++;
        const auto scaled = [&](float number) {
            return (number - column.middle) / column.half;
        };
        if (column.objects == 0) {
            const bool has_limits = value >= column.lower && value <= column.upper;
            const float feature = scaled(value);
            *features++ = has_limits ? std::clamp(feature, -1.0f, 1.0f) : feature;
            continue;
        }
        std::fill_n(features, column.objects, scaled(0));
        if (value >= 0 && value < static_cast<float>(column.objects))
            features[static_cast<std::ptrdiff_t>(value)] = scaled(1);
        features += column.objects;
    }
}

void add_feature_writer(nb::module_& module) {
    nb::class_<FeatureWriter>(module, "FeatureWriter", "Writes values as the features of learners.")
        .def(
            "__init__",
            [](FeatureWriter* self,
               const std::vector<std::tuple<std::int64_t, float, float, float, float>>& columns) {
                std::vector<ColumnFeatures> all;
                for (const auto& [objects, middle, half, lower, upper] : columns)
                    all.push_back({objects, middle, half, lower, upper});
                new (self) FeatureWriter(std::move(all));
            },
            nb::arg("columns"), "(objects or 0, middle, half, lower, upper) of each column")
        .def_prop_ro("width", &FeatureWriter::width)
        .def("write", &FeatureWriter::write, nb::arg("values"), nb::arg("features"),
             nb::arg("rows"), "values: (rows, columns) float32; features: (rows, width) float32");
}

}  // namespace rddlc::python
