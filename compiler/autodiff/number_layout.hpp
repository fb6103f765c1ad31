// Records as rows of numbers, and back.
#pragma once

#include "ir/ir.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rddlc::autodiff {

class NumberLayout {
  public:
    NumberLayout(const ir::Program& program, ir::Storage storage);

    std::size_t count() const { return entries_.size(); }
    std::size_t record_size() const { return record_size_; }
    ir::Scalar scalar(std::size_t number) const { return entries_[number].scalar; }
    // The number, which is 0 or 1 for a bool.
    double read(const std::byte* record, std::size_t number) const;
    // Bools are true above 1/2, ints are rounded.
    void write(double value, std::byte* record, std::size_t number) const;

  private:
    struct Entry {
        ir::Scalar scalar;
        std::size_t offset;
    };
    std::vector<Entry> entries_;
    std::size_t record_size_;
};

}  // namespace rddlc::autodiff
