#include "native/numpy_numbers.hpp"

#define NPY_NO_DEPRECATED_API NPY_1_23_API_VERSION
#include <numpy/arrayobject.h>

#include <cstring>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

template <class T>
double read(const void* place) {
    T value;
    std::memcpy(&value, place, sizeof value);
    return static_cast<double>(value);
}

std::optional<double> number_at(const void* place, int type) {
    if (type == NPY_DOUBLE) return read<double>(place);
    if (type == NPY_FLOAT) return read<float>(place);
    if (type == NPY_LONG || type == NPY_LONGLONG) return read<std::int64_t>(place);
    if (type == NPY_INT) return read<std::int32_t>(place);
    if (type == NPY_BOOL || type == NPY_BYTE) return read<std::int8_t>(place);
    if (type == NPY_UBYTE) return read<std::uint8_t>(place);
    return std::nullopt;
}

// The types of whole scalars; np.float64 is a float of Python's.
bool is_whole_type(const PyTypeObject* type) {
    return type == &PyLongArrType_Type || type == &PyIntArrType_Type ||
           type == &PyByteArrType_Type || type == &PyUByteArrType_Type ||
           type == &PyLongLongArrType_Type;
}

template <class T>
nb::object new_array(int type, T number) {
    PyObject* const made = PyArray_SimpleNew(0, nullptr, type);
    if (!made) throw nb::python_error();
    std::memcpy(PyArray_DATA(reinterpret_cast<PyArrayObject*>(made)), &number, sizeof number);
    return nb::steal(made);
}

// Its memory, if it is a plain array of shape (), in the machine's order of bytes.
void* memory_of(PyObject* array, int type) {
    if (!PyArray_CheckExact(array)) return nullptr;
    auto* const found = reinterpret_cast<PyArrayObject*>(array);
    const bool is_plain = PyArray_NDIM(found) == 0 && PyArray_TYPE(found) == type &&
                          PyArray_ISNOTSWAPPED(found) &&
                          PyArray_CHKFLAGS(found, NPY_ARRAY_OWNDATA) && PyArray_ISWRITEABLE(found);
    return is_plain ? PyArray_DATA(found) : nullptr;
}

}  // namespace

void import_numpy() {
    if (_import_array() < 0) throw nb::python_error();
}

nb::object array_of(double number) {
    return new_array(NPY_DOUBLE, number);
}
nb::object array_of(std::int64_t number) {
    return new_array(NPY_INT64, number);
}

std::optional<double> numpy_number(PyObject* given) {
    if (PyArray_CheckExact(given)) {
        auto* const array = reinterpret_cast<PyArrayObject*>(given);
        if (PyArray_SIZE(array) != 1 || !PyArray_ISNOTSWAPPED(array)) return std::nullopt;
        return number_at(PyArray_DATA(array), PyArray_TYPE(array));
    }
    if (is_whole_type(Py_TYPE(given)))
        return static_cast<double>(PyNumber_AsSsize_t(given, nullptr));
    if (Py_TYPE(given) == &PyBoolArrType_Type) return PyObject_IsTrue(given);
    if (Py_TYPE(given) != &PyFloatArrType_Type) return std::nullopt;
    float value;
    PyArray_ScalarAsCtype(given, &value);
    return value;
}

double* double_in(PyObject* array) {
    return static_cast<double*>(memory_of(array, NPY_DOUBLE));
}
std::int64_t* integer_in(PyObject* array) {
    return static_cast<std::int64_t*>(memory_of(array, NPY_INT64));
}

}  // namespace rddlc::python
