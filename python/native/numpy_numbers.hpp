// Single numbers of numpy, read and made by its C interface, which is some times as quick as
// Python's buffers.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>
#include <optional>

namespace rddlc::python {

// The other functions need it called before; throws where numpy cannot be imported.
void import_numpy();

// A new array of the shape ().
nanobind::object array_of(double number);
nanobind::object array_of(std::int64_t number);

// The number in a scalar of numpy, or in an array of one entry; nothing for other objects and for
// types that are not common.
std::optional<double> numpy_number(PyObject* given);

// The number of an array as array_of() makes it, to be overwritten; null for other objects, and
// where an array has been given another type, shape or memory since, or may not be written.
double* double_in(PyObject* array);
std::int64_t* integer_in(PyObject* array);

}  // namespace rddlc::python
