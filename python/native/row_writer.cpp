#include "native/row_writer.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// The loop has no branch for each entry: the compiler puts several into a vector register.
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

// The entries of an array that lie one behind the other in memory.
class Entries {
  public:
    explicit Entries(nb::handle array) {
        if (!PyObject_CheckBuffer(array.ptr())) return;
        is_open_ = PyObject_GetBuffer(array.ptr(), &view_, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) == 0;
        if (!is_open_) PyErr_Clear();
    }
    Entries(const Entries&) = delete;
    ~Entries() {
        if (is_open_) PyBuffer_Release(&view_);
    }

    // Null if they are of another type, or not so many.
    template <class T>
    const T* as(std::size_t count) const {
        if (!is_open_ || view_.len != static_cast<Py_ssize_t>(count * sizeof(T))) return nullptr;
        const std::string_view format = view_.format ? view_.format : "B";
        const bool is_right = std::is_same_v<T, float>    ? format == "f"
                              : std::is_same_v<T, double> ? format == "d"
                                                          : format == "l" || format == "q";
        return is_right && view_.itemsize == sizeof(T) ? static_cast<const T*>(view_.buf) : nullptr;
    }

  private:
    Py_buffer view_{};
    bool is_open_ = false;
};

// The only category, where it is a whole number of Python's or numpy's.
std::optional<std::int64_t> whole_of(nb::handle given) {
    if (!PyIndex_Check(given.ptr())) return std::nullopt;
    const std::int64_t whole = PyNumber_AsSsize_t(given.ptr(), PyExc_OverflowError);
    if (whole != -1 || !PyErr_Occurred()) return whole;
    PyErr_Clear();
    return std::nullopt;
}

}  // namespace

RowWriter::RowWriter(EnvPool& batch, std::int64_t first, std::vector<RowLimits> limits,
                     bool categories, RowChanges changes)
    : batch_(batch),
      first_(first),
      limits_(std::move(limits)),
      categories_(categories),
      changes_(std::move(changes)) {
    const std::int64_t columns = batch.action_columns();
    const bool has_columns =
        changes_.columns.empty()
            ? first >= 0 && first + static_cast<std::int64_t>(limits_.size()) <= columns
            : static_cast<std::int64_t>(changes_.defaults.size()) == columns &&
                  std::ranges::all_of(changes_.columns, [&](std::int64_t column) {
                      return column >= -1 && column < columns;
                  });
    if (!has_columns || batch.settings().doubles)
        throw Refused("there are no such columns of action values");
}

template <class T>
void RowWriter::copy(const T* entries) {
    const std::int64_t count = batch_.settings().environments;
    const std::size_t width = limits_.size();
    float* const values = reinterpret_cast<float*>(batch_.arrays().action_values.data()) + first_;
    const std::int64_t stride = batch_.action_columns();
    for (std::size_t k = 0; k < width; ++k)
        for (std::int64_t row = 0; row < count; ++row)
            values[row * stride + static_cast<std::int64_t>(k)] =
                static_cast<float>(entries[static_cast<std::size_t>(row) * width + k]) +
                limits_[k].offset;
}

void RowWriter::change(const std::int64_t* entries) {
    const std::int64_t count = batch_.settings().environments, columns = batch_.action_columns();
    float* values = reinterpret_cast<float*>(batch_.arrays().action_values.data());
    for (std::int64_t row = 0; row < count; ++row, values += columns) {
        std::ranges::copy(changes_.defaults, values);
        for (std::size_t k = 0; k < limits_.size(); ++k) {
            const auto category = static_cast<std::size_t>(*entries++);
            if (changes_.columns[category] >= 0)
                values[changes_.columns[category]] = changes_.values[category];
        }
    }
}

template <class T>
bool RowWriter::write_entries(const T* entries) {
    if (!entries || !are_within(entries, batch_.settings().environments, limits_)) return false;
    if constexpr (std::is_same_v<T, std::int64_t>)
        if (!changes_.columns.empty()) {
            change(entries);
            return true;
        }
    copy(entries);
    return true;
}

bool RowWriter::write(nb::handle rows) {
    batch_.finish();
    const auto size = static_cast<std::size_t>(batch_.settings().environments) * limits_.size();
    if (categories_ && size == 1)
        if (const auto whole = whole_of(rows)) return write_entries(&*whole);
    const Entries given(rows);
    if (categories_) return write_entries(given.as<std::int64_t>(size));
    return write_entries(given.as<float>(size)) || write_entries(given.as<double>(size));
}

// Numbers that are all action values are read where they are.
std::optional<bool> RowWriter::step(nb::handle rows, nb::handle into) {
    const Outputs outputs = batch_.outputs_in(into);
    const std::int64_t count = batch_.settings().environments;
    const bool is_all = static_cast<std::int64_t>(limits_.size()) == batch_.action_columns();
    if (!categories_ && is_all) {
        const Entries given(rows);
        const auto* const numbers =
            given.as<float>(static_cast<std::size_t>(count) * limits_.size());
        if (!numbers || !are_within(numbers, count, limits_)) return std::nullopt;
        return batch_.step_values(outputs, numbers,
                                  nb::make_tuple(nb::borrow(rows), nb::borrow(into)));
    }
    if (!write(rows)) return std::nullopt;
    return batch_.step_values(outputs);
}

void add_row_writer(nb::module_& module) {
    nb::class_<RowWriter>(module, "RowWriter",
                          "Writes rows of categories or numbers; gives False for those that it "
                          "does not take.")
        .def(
            "__init__",
            [](RowWriter* self, EnvPool& batch, std::int64_t first,
               const std::vector<std::tuple<float, float, float>>& limits, bool categories,
               std::tuple<std::vector<std::int64_t>, std::vector<float>, std::vector<float>>
                   changes) {
                std::vector<RowLimits> all;
                for (const auto& [lower, upper, offset] : limits)
                    all.push_back({lower, upper, offset});
                auto& [columns, values, defaults] = changes;
                new (self) RowWriter(batch, first, std::move(all), categories,
                                     {std::move(columns), std::move(values), std::move(defaults)});
            },
            nb::arg("batch"), nb::arg("first"), nb::arg("limits"), nb::arg("categories"),
            nb::arg("changes"), nb::keep_alive<1, 2>())
        .def("write", &RowWriter::write, nb::arg("rows").none())
        .def("step", &RowWriter::step, nb::arg("rows").none(), nb::arg("into").none());
}

}  // namespace rddlc::python
