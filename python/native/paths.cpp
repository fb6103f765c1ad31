#include "native/paths.hpp"

#include "native/problem.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

// Nothing if it holds lone surrogates.
std::optional<std::string> utf8_of(nb::handle text) {
    Py_ssize_t size = 0;
    const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (bytes) return std::string(bytes, static_cast<std::size_t>(size));
    PyErr_Clear();
    return std::nullopt;
}

}  // namespace

std::string utf8_text(nb::handle text) {
    if (auto utf8 = utf8_of(text)) return *std::move(utf8);
    const nb::object escaped = nb::steal(PyObject_ASCII(text.ptr()));
    if (!escaped) throw nb::python_error();
    return utf8_of(escaped).value();
}

std::string path_of(nb::handle given) {
    const auto refused = [&](const char* why) {
        PyErr_Clear();
        return Refused(fmt::format("the path {} {}", utf8_text(nb::repr(given)), why));
    };
    PyObject* decoded = nullptr;
    if (!PyUnicode_FSDecoder(given.ptr(), &decoded)) {
        if (PyErr_ExceptionMatches(PyExc_ValueError))
            throw refused("holds a NUL character, which no file's name has");
        if (PyErr_ExceptionMatches(PyExc_TypeError))
            throw refused("is neither a str, nor bytes, nor an os.PathLike");
        throw nb::python_error();
    }
    const nb::object text = nb::steal(decoded);
    if (auto utf8 = utf8_of(text)) return *std::move(utf8);
    throw refused("is not UTF-8: give the file another name");
}

std::vector<std::string> paths_of(nb::handle list) {
    std::vector<std::string> paths;
    for (const nb::handle path : list) paths.push_back(path_of(path));
    return paths;
}

}  // namespace rddlc::python
