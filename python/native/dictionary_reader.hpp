// Values of a record as a dictionary.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace rddlc::python {

// Name, offset, "bool", "int" or "real", and whether its value is an array of shape ().
using NamedColumn = std::tuple<nanobind::str, std::size_t, std::string, bool>;

// Reads {"pos___c1": number, ...} from the first of the records that a numpy array holds. A
// dictionary that the program has dropped is filled again, and so is each array: that takes a
// fraction of the time of making them. What the program still holds stays as it is.
class DictionaryReader {
  public:
    DictionaryReader(nanobind::object records, std::vector<NamedColumn> columns);

    nanobind::dict read();

    // Python's collector of cycles: a program may put anything into a dictionary, the environment
    // also.
    int traverse(visitproc visit, void* arg) const;
    void clear();

  private:
    // A dictionary that was returned, and the arrays in it, in the order of the columns.
    struct Returned {
        nanobind::dict values;
        std::vector<nanobind::object> arrays;
    };

    Returned made() const;
    bool refill(Returned& returned) const;
    nanobind::object value_of(std::size_t column) const;

    nanobind::object owner_;  // of the record
    const std::byte* record_ = nullptr;
    std::vector<NamedColumn> columns_;
    nanobind::dict names_;  // without values
    // A program that steps in a loop still holds the last one while it asks for the next one.
    std::array<Returned, 2> returned_;
    std::size_t turn_ = 0;
};

void add_dictionary_reader(nanobind::module_& module);

}  // namespace rddlc::python
