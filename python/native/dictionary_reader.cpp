#include "native/dictionary_reader.hpp"

#include "native/numpy_numbers.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <cstring>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

template <class T>
T value_at(const std::byte* place) {
    T value;
    std::memcpy(&value, place, sizeof value);
    return value;
}

std::int64_t whole_at(const std::byte* place, char stored) {
    return stored == 'i' ? value_at<std::int64_t>(place) : value_at<std::int8_t>(place);
}

// Overwrites the number of an array, if it is still as it was made.
bool overwrite(PyObject* array, const std::byte* place, char stored) {
    if (stored == 'r') {
        double* const number = double_in(array);
        if (number) *number = value_at<double>(place);
        return number;
    }
    std::int64_t* const number = integer_in(array);
    if (number) *number = whole_at(place, stored);
    return number;
}

}  // namespace

DictionaryReader::DictionaryReader(nb::object records, std::vector<NamedColumn> columns)
    : owner_(std::move(records)), columns_(std::move(columns)) {
    Py_buffer view{};
    if (PyObject_GetBuffer(owner_.ptr(), &view, PyBUF_C_CONTIGUOUS) != 0) throw nb::python_error();
    record_ = static_cast<const std::byte*>(view.buf);
    PyBuffer_Release(&view);  // the memory stays where it is, as long as its owner
    for (const NamedColumn& column : columns_) names_[std::get<0>(column)] = nb::none();
}

nb::dict DictionaryReader::read() {
    turn_ = 1 - turn_;
    Returned& returned = returned_[turn_];
    if (!refill(returned)) returned = made();
    return returned.values;
}

DictionaryReader::Returned DictionaryReader::made() const {
    // A copy has room for all values.
    Returned returned{nb::steal<nb::dict>(PyDict_Copy(names_.ptr())), {}};
    if (!returned.values.is_valid()) throw nb::python_error();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const nb::object value = value_of(i);
        if (PyDict_SetItem(returned.values.ptr(), std::get<0>(columns_[i]).ptr(), value.ptr()) != 0)
            throw nb::python_error();
        returned.arrays.push_back(std::get<3>(columns_[i]) ? value : nb::object());
    }
    return returned;
}

// False where the program holds the dictionary, or has changed its names; a value that it holds or
// has changed is replaced.
bool DictionaryReader::refill(Returned& returned) const {
    PyObject* const values = returned.values.ptr();
    if (!values || Py_REFCNT(values) != 1 ||
        PyDict_Size(values) != static_cast<Py_ssize_t>(columns_.size()))
        return false;
    PyObject *name = nullptr, *value = nullptr;
    Py_ssize_t position = 0;
    for (std::size_t i = 0; PyDict_Next(values, &position, &name, &value); ++i) {
        const auto& [expected, offset, stored, is_array] = columns_[i];
        if (name != expected.ptr()) return false;
        // An array that is only here and in the dictionary.
        const bool is_dropped =
            is_array && value == returned.arrays[i].ptr() && Py_REFCNT(value) == 2;
        if (is_dropped && overwrite(value, record_ + offset, stored.front())) continue;
        const nb::object current = value_of(i);
        if (current.ptr() == value) continue;
        if (PyDict_SetItem(values, name, current.ptr()) != 0) throw nb::python_error();
        if (is_array) returned.arrays[i] = current;
    }
    return true;
}

nb::object DictionaryReader::value_of(std::size_t column) const {
    const auto& [name, offset, stored, is_array] = columns_[column];
    const std::byte* const place = record_ + offset;
    if (stored.front() == 'r') {
        const auto number = value_at<double>(place);
        return is_array ? array_of(number) : nb::steal(PyFloat_FromDouble(number));
    }
    const std::int64_t whole = whole_at(place, stored.front());
    return is_array ? array_of(whole) : nb::steal(PyLong_FromLongLong(whole));
}

int DictionaryReader::traverse(visitproc visit, void* arg) const {
    for (const Returned& returned : returned_) Py_VISIT(returned.values.ptr());
    return 0;
}

// A dictionary that is gone is made again by read().
void DictionaryReader::clear() {
    for (Returned& returned : returned_) {
        const nb::dict dropped = std::move(returned.values);
    }
}

namespace {

int traverse_reader(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    return nb::inst_ready(self) ? nb::inst_ptr<DictionaryReader>(self)->traverse(visit, arg) : 0;
}

int clear_reader(PyObject* self) {
    if (nb::inst_ready(self)) nb::inst_ptr<DictionaryReader>(self)->clear();
    return 0;
}

}  // namespace

void add_dictionary_reader(nb::module_& module) {
    PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse_reader)},
                           {Py_tp_clear, reinterpret_cast<void*>(clear_reader)},
                           {0, nullptr}};
    nb::class_<DictionaryReader>(
        module, "DictionaryReader", nb::type_slots(slots),
        "Reads the first record as a dictionary of numbers, or of arrays of shape ().")
        .def(nb::init<nb::object, std::vector<NamedColumn>>(), nb::arg("records"),
             nb::arg("columns"))
        .def("read", &DictionaryReader::read);
}

}  // namespace rddlc::python
