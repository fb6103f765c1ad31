// The memory of Python's arrays, by the buffer protocol: several times as quick as nanobind's
// arrays.
#pragma once

#include "native/problem.hpp"

#include <fmt/format.h>
#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
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

// The entries of an array that lie one behind the other in memory, while this lives.
class Entries {
  public:
    explicit Entries(nanobind::handle array) {
        if (!PyObject_CheckBuffer(array.ptr())) return;
        is_open_ = PyObject_GetBuffer(array.ptr(), &view_, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) == 0;
        if (!is_open_) PyErr_Clear();
    }
    Entries(const Entries&) = delete;
    Entries& operator=(const Entries&) = delete;
    ~Entries() {
        if (is_open_) PyBuffer_Release(&view_);
    }

    // T: float, double or std::int64_t. Null if they are of another type, or not so many.
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

}  // namespace rddlc::python
