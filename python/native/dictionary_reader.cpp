#include "native/dictionary_reader.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// Name, offset, "bool", "int" or "real", and whether its value is an array.
using NamedColumn = std::tuple<nb::str, std::size_t, std::string, bool>;

// Reads {"pos___c1": number, ...} from the first of the records that a numpy array holds.
class DictionaryReader {
  public:
    DictionaryReader(nb::object records, std::vector<NamedColumn> columns, nb::callable array)
        : owner_(std::move(records)), columns_(std::move(columns)), array_(std::move(array)) {
        Py_buffer view{};
        if (PyObject_GetBuffer(owner_.ptr(), &view, PyBUF_C_CONTIGUOUS) != 0)
            throw nb::python_error();
        record_ = static_cast<const std::byte*>(view.buf);
        PyBuffer_Release(&view);  // the memory stays where it is, as long as its owner
        for (const NamedColumn& column : columns_) names_[std::get<0>(column)] = nb::none();
    }

    nb::dict read() const {
        // A copy has room for all values.
        const auto values = nb::steal<nb::dict>(PyDict_Copy(names_.ptr()));
        if (!values.is_valid()) throw nb::python_error();
        for (const auto& [name, offset, stored, is_array] : columns_) {
            nb::object value = number(record_ + offset, stored.front());
            if (is_array) value = array_(value);
            if (PyDict_SetItem(values.ptr(), name.ptr(), value.ptr()) != 0)
                throw nb::python_error();
        }
        return values;
    }

  private:
    static nb::object number(const std::byte* place, char stored) {
        if (stored == 'r') {
            double value;
            std::memcpy(&value, place, sizeof value);
            return nb::steal(PyFloat_FromDouble(value));
        }
        std::int64_t value = static_cast<std::int8_t>(*place);
        if (stored == 'i') std::memcpy(&value, place, sizeof value);
        return nb::steal(PyLong_FromLongLong(value));
    }

    nb::object owner_;  // of the record
    const std::byte* record_ = nullptr;
    std::vector<NamedColumn> columns_;
    nb::dict names_;  // without values
    // numpy.array, which takes half the time without a type, and finds the same.
    nb::callable array_;
};

}  // namespace

void add_dictionary_reader(nb::module_& module) {
    nb::class_<DictionaryReader>(
        module, "DictionaryReader",
        "Reads the first record as a dictionary of numbers, or of arrays of "
        "shape () by `array`.")
        .def(nb::init<nb::object, std::vector<NamedColumn>, nb::callable>(), nb::arg("records"),
             nb::arg("columns"), nb::arg("array"))
        .def("read", &DictionaryReader::read);
}

}  // namespace rddlc::python
