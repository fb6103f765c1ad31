// The memory of Python's arrays, by the buffer protocol: several times as quick as nanobind's
// arrays.
#pragma once

#include "native/problem.hpp"

#include <fmt/format.h>
#include <nanobind/nanobind.h>

#include <cstddef>
#include <type_traits>

namespace rddlc::python {

// The memory of an array of `count` entries of `size` bytes, one behind the other. Without const
// the array must be writable. Throws Refused for another size.
template <class T>
T* memory_of(nanobind::handle array, std::size_t count, std::size_t size = sizeof(T)) {
    Py_buffer view;
    if (PyObject_GetBuffer(array.ptr(), &view, std::is_const_v<T> ? PyBUF_SIMPLE : PyBUF_WRITABLE))
        throw nanobind::python_error();
    void* const memory = view.buf;
    const auto bytes = static_cast<std::size_t>(view.len);
    PyBuffer_Release(&view);
    if (bytes != count * size)
        throw Refused(fmt::format("an array has {} bytes, not {}", bytes, count * size));
    return static_cast<T*>(memory);
}

}  // namespace rddlc::python
