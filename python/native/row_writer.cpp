#include "native/row_writer.hpp"

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// Without a branch for each entry: the compiler puts several into a vector register.
template <class T>
bool are_within(const T* entries, std::int64_t count, std::span<const RowLimits> limits) {
    const std::size_t width = limits.size();
    bool within = true;
    for (std::size_t k = 0; k < width; ++k) {
        const T lower = static_cast<T>(limits[k].lower), upper = static_cast<T>(limits[k].upper);
        for (std::int64_t row = 0; row < count; ++row) {
            const T entry = entries[static_cast<std::size_t>(row) * width + k];
            within &= static_cast<bool>(static_cast<int>(entry >= lower) & (entry <= upper));
        }
    }
    return within;
}

}  // namespace

RowWriter::RowWriter(Batch& batch, std::int64_t first, std::vector<RowLimits> limits,
                     bool categories)
    : batch_(batch), first_(first), limits_(std::move(limits)), categories_(categories) {
    if (first < 0 || first + static_cast<std::int64_t>(limits_.size()) > batch.action_columns() ||
        batch.settings().doubles)
        throw Refused("there are no such columns of action values");
}

template <class T>
bool RowWriter::write(const Rows<T>& rows) {
    const std::int64_t count = batch_.settings().environments;
    const std::size_t width = limits_.size();
    if (categories_ != std::is_integral_v<T> ||
        rows.size() != static_cast<std::size_t>(count) * width)
        return false;
    const T* const entries = rows.data();
    if (!are_within(entries, count, limits_)) return false;
    float* const values = reinterpret_cast<float*>(batch_.arrays().action_values.data()) + first_;
    const std::int64_t stride = batch_.action_columns();
    for (std::size_t k = 0; k < width; ++k)
        for (std::int64_t row = 0; row < count; ++row)
            values[row * stride + static_cast<std::int64_t>(k)] =
                static_cast<float>(entries[static_cast<std::size_t>(row) * width + k]) +
                limits_[k].offset;
    return true;
}

void add_row_writer(nb::module_& module) {
    nb::class_<RowWriter>(module, "RowWriter",
                          "Writes rows of categories or numbers; gives False for those that it "
                          "does not take.")
        .def(
            "__init__",
            [](RowWriter* self, Batch& batch, std::int64_t first,
               const std::vector<std::tuple<float, float, float>>& limits, bool categories) {
                std::vector<RowLimits> all;
                for (const auto& [lower, upper, offset] : limits)
                    all.push_back({lower, upper, offset});
                new (self) RowWriter(batch, first, std::move(all), categories);
            },
            nb::arg("batch"), nb::arg("first"), nb::arg("limits"), nb::arg("categories"),
            nb::keep_alive<1, 2>())
        .def("write", &RowWriter::write<float>, nb::arg("rows").noconvert())
        .def("write", &RowWriter::write<std::int64_t>, nb::arg("rows").noconvert())
        .def("write", [](RowWriter&, const nb::object&) { return false; });
}

}  // namespace rddlc::python
