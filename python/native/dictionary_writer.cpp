#include "native/dictionary_writer.hpp"

#include "native/numpy_numbers.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

constexpr double least_inexact = 9007199254740992.0;  // 2^53: the next int rounds to it

// A number of Python or numpy, or the one in an array of one entry.
std::optional<double> number_of(PyObject* given) {
    if (PyFloat_Check(given)) return PyFloat_AsDouble(given);
    if (!PyLong_Check(given)) return numpy_number(given);
    int overflow = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(given, &overflow);
    if (overflow != 0) return std::nullopt;
    return static_cast<double>(whole);
}

template <class T>
double element(const void* data, std::size_t index) {
    T value;
    std::memcpy(&value, static_cast<const char*>(data) + index * sizeof(T), sizeof value);
    return static_cast<double>(value);
}

// Bytes have a buffer too, but a program that gives them does not mean numbers.
bool is_bytes(PyObject* given) {
    return PyBytes_Check(given) || PyByteArray_Check(given) || PyMemoryView_Check(given);
}

using Element = double (*)(const void*, std::size_t);

// Reads an element of a buffer of that format; null for formats that are not common.
Element element_of(const char* format) {
    const std::string_view name = format ? format : "B";
    if (name == "d") return element<double>;
    if (name == "l" || name == "q") return element<std::int64_t>;
    if (name == "?" || name == "b") return element<std::int8_t>;
    if (name == "f") return element<float>;
    if (name == "i") return element<std::int32_t>;
    if (name == "B") return element<std::uint8_t>;
    return nullptr;
}

void put(std::byte* place, Stored stored, double value) {
    const auto whole = static_cast<std::int64_t>(stored == Stored::Real ? 0 : value);
    const auto flag = static_cast<std::int8_t>(whole);
    switch (stored) {
        case Stored::Bool:
            std::memcpy(place, &flag, sizeof flag);
            return;
        case Stored::Int:
            std::memcpy(place, &whole, sizeof whole);
            return;
        case Stored::Real:
            std::memcpy(place, &value, sizeof value);
            return;
    }
}

double get(const std::byte* place, Stored stored) {
    if (stored == Stored::Real) return element<double>(place, 0);
    return stored == Stored::Int ? element<std::int64_t>(place, 0) : element<std::int8_t>(place, 0);
}

}  // namespace

DictionaryWriter::DictionaryWriter(nb::object records, std::vector<ActionColumn> columns,
                                   std::vector<ActionEntry> entries, std::int64_t limit)
    : owner_(std::move(records)),
      columns_(std::move(columns)),
      entries_(std::move(entries)),
      limit_(limit) {
    Py_buffer view{};
    const int flags = PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS;
    if (PyObject_GetBuffer(owner_.ptr(), &view, flags) != 0) throw nb::python_error();
    records_ = static_cast<std::byte*>(view.buf);
    if (view.ndim == 2) {
        rows_ = static_cast<std::size_t>(view.shape[0]);
        size_ = static_cast<std::size_t>(view.shape[1]);
    }
    PyBuffer_Release(&view);  // the memory stays where it is, as long as its owner
    for (std::size_t i = 0; i < entries_.size(); ++i) places_[entries_[i].name] = i;
    defaults_.assign(records_, records_ + rows_ * size_);
}

bool DictionaryWriter::write(nb::handle action) {
    if (!PyDict_Check(action.ptr())) return false;
    staged_ = defaults_;
    PyObject *name = nullptr, *value = nullptr;
    Py_ssize_t position = 0;
    for (std::size_t place = 0; PyDict_Next(action.ptr(), &position, &name, &value); ++place) {
        const ActionEntry* const entry = entry_of(name, place);
        if (!entry || !write_entry(*entry, value)) return false;
    }
    if (limit_ >= 0 && !are_few_changed()) return false;
    std::memcpy(records_, staged_.data(), staged_.size());
    return true;
}

// A complete dictionary has its names in the order of the columns.
const ActionEntry* DictionaryWriter::entry_of(PyObject* name, std::size_t guess) const {
    if (guess < entries_.size() && entries_[guess].name.ptr() == name) return &entries_[guess];
    if (!PyUnicode_CheckExact(name)) return nullptr;
    PyObject* const place = PyDict_GetItemWithError(places_.ptr(), name);
    return place ? &entries_[PyLong_AsSize_t(place)] : nullptr;
}

bool DictionaryWriter::write_entry(const ActionEntry& entry, PyObject* given) {
    if (const auto number = number_of(given))
        return entry.count * rows_ == 1 && store(0, columns_[entry.first], *number);
    if (!PyObject_CheckBuffer(given) || is_bytes(given)) return false;
    Py_buffer view{};
    if (PyObject_GetBuffer(given, &view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) {
        PyErr_Clear();
        return false;
    }
    const bool is_written = write_array(entry, view);
    PyBuffer_Release(&view);
    return is_written;
}

bool DictionaryWriter::write_array(const ActionEntry& entry, const Py_buffer& view) {
    const Element read = element_of(view.format);
    const std::size_t size = entry.count * rows_;
    if (!read || view.len != static_cast<Py_ssize_t>(size) * view.itemsize) return false;
    const std::size_t dimensions = entry.shape.size();
    if (entry.count > 1 &&
        (view.ndim < static_cast<int>(dimensions) ||
         !std::equal(entry.shape.begin(), entry.shape.end(), view.shape + view.ndim - dimensions)))
        return false;
    for (std::size_t i = 0; i < size; ++i)
        if (!store(i / entry.count, columns_[entry.first + i % entry.count], read(view.buf, i)))
            return false;
    return true;
}

bool DictionaryWriter::store(std::size_t row, const ActionColumn& column, double value) {
    if (!(value >= column.lower && value <= column.upper)) return false;
    if (column.stored != Stored::Real &&
        (std::abs(value) >= least_inexact || value != std::floor(value)))
        return false;
    put(staged_.data() + row * size_ + column.offset, column.stored, value);
    return true;
}

bool DictionaryWriter::are_few_changed() const {
    for (std::size_t row = 0; row < rows_; ++row) {
        const auto changes = std::ranges::count_if(columns_, [&](const ActionColumn& column) {
            const std::size_t place = row * size_ + column.offset;
            return column.is_counted && get(staged_.data() + place, column.stored) !=
                                            get(defaults_.data() + place, column.stored);
        });
        if (changes > limit_) return false;
    }
    return true;
}

void add_dictionary_writer(nb::module_& module) {
    using Column = std::tuple<std::size_t, std::string, double, double, bool>;
    using Entry = std::tuple<nb::str, std::size_t, std::vector<std::int64_t>, std::size_t>;
    nb::class_<DictionaryWriter>(module, "DictionaryWriter",
                                 "Writes dictionaries into action records; gives False for those "
                                 "that it does not take.")
        .def(
            "__init__",
            [](DictionaryWriter* self, nb::object records, const std::vector<Column>& columns,
               const std::vector<Entry>& entries, std::int64_t limit) {
                std::vector<ActionColumn> all;
                for (const auto& [offset, stored, lower, upper, is_counted] : columns)
                    all.push_back({offset,
                                   stored == "bool"  ? Stored::Bool
                                   : stored == "int" ? Stored::Int
                                                     : Stored::Real,
                                   lower, upper, is_counted});
                std::vector<ActionEntry> named;
                for (const auto& [name, first, shape, count] : entries)
                    named.push_back({name, first, shape, count});
                new (self)
                    DictionaryWriter(std::move(records), std::move(all), std::move(named), limit);
            },
            nb::arg("records"), nb::arg("columns"), nb::arg("entries"), nb::arg("limit"))
        .def("write", &DictionaryWriter::write, nb::arg("action").none());
}

}  // namespace rddlc::python
