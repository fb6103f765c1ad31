// Actions by dictionary, checked and written in one pass.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rddlc::python {

enum class Stored { Bool, Int, Real };  // int8, int64, double

// One value of an action record.
struct ActionColumn {
    std::size_t offset;  // bytes into the record
    Stored stored;
    double lower, upper;
    bool is_counted;  // against the limit of changes
};

// The columns that a name stands for: those of a fluent, row-major, or one grounding.
struct ActionEntry {
    nanobind::object name;
    std::size_t first;
    std::vector<std::int64_t> shape;
    std::size_t count;
};

// Writes {"push": array or number, ...} into the action records of n environments. Names that are
// absent get their default.
class DictionaryWriter {
  public:
    // records: a numpy array (n, bytes), which holds the defaults now. limit: how many counted
    // values may differ from them; negative: all.
    DictionaryWriter(nanobind::object records, std::vector<ActionColumn> columns,
                     std::vector<ActionEntry> entries, std::int64_t limit);

    // False, and nothing is changed, for what is not a dictionary, and where a name, a type, a
    // shape or a value is not one of the common ones: slower code knows whether that is a mistake.
    bool write(nanobind::handle action);

  private:
    const ActionEntry* entry_of(PyObject* name, std::size_t guess) const;
    bool write_entry(const ActionEntry& entry, PyObject* given);
    bool write_array(const ActionEntry& entry, const Py_buffer& view);
    bool store(std::size_t row, const ActionColumn& column, double value);
    bool are_few_changed() const;

    nanobind::object owner_;  // of the records
    std::byte* records_ = nullptr;
    std::vector<ActionColumn> columns_;
    std::vector<ActionEntry> entries_;
    nanobind::dict places_;  // by name
    std::int64_t limit_;
    std::size_t rows_ = 0, size_ = 0;
    std::vector<std::byte> defaults_, staged_;  // all records
};

void add_dictionary_writer(nanobind::module_& module);

}  // namespace rddlc::python
