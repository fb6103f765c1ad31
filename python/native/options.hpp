// Options that Python gives by their names.
#pragma once

#include "native/problem.hpp"

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace rddlc::python {

class Options {
  public:
    explicit Options(nanobind::dict given) : given_(std::move(given)) {}

    // Leaves the target as it is where the option is not given.
    template <class T>
    void take(const char* name, T& target) {
        if (!given_.contains(name)) return;
        const nanobind::object value = given_[name];
        if (!nanobind::try_cast(value, target))
            throw Refused(fmt::format("{} cannot be {}", name, nanobind::repr(value).c_str()));
        PyDict_DelItemString(given_.ptr(), name);
    }

    // One of these words.
    template <class T>
    void take(const char* name, T& target, const std::vector<std::pair<std::string, T>>& words) {
        std::string given;
        take(name, given);
        if (given.empty()) return;
        std::string known;
        for (const auto& [word, value] : words) {
            if (word == given) {
                target = value;
                return;
            }
            known += known.empty() ? word : ", " + word;
        }
        throw Refused(fmt::format("{} is '{}', which is none of {}", name, given, known));
    }

    // Refuses what nobody has taken.
    void finish() const {
        for (const auto [name, value] : given_)
            throw Refused(
                fmt::format("there is no option '{}'", nanobind::cast<std::string>(name)));
    }

  private:
    nanobind::dict given_;
};

}  // namespace rddlc::python
