#include "native/paths.hpp"

#include "native/problem.hpp"

#include <fmt/format.h>

namespace nb = nanobind;

namespace rddlc::python {

std::string path_of(nb::handle given) {
    const auto refused = [&](const char* why) {
        PyErr_Clear();
        return Refused(fmt::format("the path {} {}", nb::repr(given).c_str(), why));
    };
    PyObject* decoded = nullptr;
    if (!PyUnicode_FSDecoder(given.ptr(), &decoded)) {
        if (PyErr_ExceptionMatches(PyExc_ValueError))
            throw refused("holds a NUL character, which no file's name has");
        throw nb::python_error();
    }
    const nb::object text = nb::steal(decoded);
    Py_ssize_t size = 0;
    const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (!bytes) throw refused("is not UTF-8: give the file another name");
    return {bytes, static_cast<std::size_t>(size)};
}

std::vector<std::string> paths_of(nb::handle list) {
    std::vector<std::string> paths;
    for (const nb::handle path : list) paths.push_back(path_of(path));
    return paths;
}

}  // namespace rddlc::python
