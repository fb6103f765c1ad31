// Functions of the shared objects that benchmarks compare.
#pragma once

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace benchmarks {

// The function of a shared object, which stays loaded; an error says what is missing.
template <class Function>
Function* load(const char* file, const char* name) {
    void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) throw std::runtime_error(dlerror());
    const auto function = reinterpret_cast<Function*>(dlsym(library, name));
    if (!function) throw std::runtime_error(std::string(file) + " has no function " + name);
    return function;
}

}  // namespace benchmarks
