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

using NamedColumn = std::tuple<nb::str, std::size_t, std::string>;  // offset, "bool", "int", "real"

// Reads {"pos___c1": number, ...} from the first of the records that a numpy array holds.
class DictionaryReader {
  public:
    DictionaryReader(nb::object records, std::vector<NamedColumn> columns)
        : owner_(std::move(records)), columns_(std::move(columns)) {
        Py_buffer view{};
        if (PyObject_GetBuffer(owner_.ptr(), &view, PyBUF_C_CONTIGUOUS) != 0)
            throw nb::python_error();
        record_ = static_cast<const std::byte*>(view.buf);
        PyBuffer_Release(&view);  // the memory stays where it is, as long as its owner
    }

    nb::dict read() const {
        nb::dict values;
        for (const auto& [name, offset, stored] : columns_) {
            const nb::object value = number(record_ + offset, stored.front());
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
};

}  // namespace

void add_dictionary_reader(nb::module_& module) {
    nb::class_<DictionaryReader>(module, "DictionaryReader",
                                 "Reads the first record as a dictionary of numbers.")
        .def(nb::init<nb::object, std::vector<NamedColumn>>(), nb::arg("records"),
             nb::arg("columns"))
        .def("read", &DictionaryReader::read);
}

}  // namespace rddlc::python
