// The values of non-fluents, as an interpreted simulator reports them.
#pragma once

#include "ir/ir.hpp"

#include <rddl/interface/constants.hpp>

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace rddlc::workbench {

class ConstantTables {
  public:
    void add(std::int32_t fluent, ir::Scalar scalar, const Table& table);

    // Refers to the tables below, which stay where they are.
    std::span<const rddl::Constants> list() const { return list_; }

  private:
    std::span<const std::int64_t> places_of(const Table& table);
    template <class T>
    rddl::ConstantValues<T> values_of(const Table& table, std::deque<std::vector<T>>& all);

    std::vector<rddl::Constants> list_;
    std::deque<std::vector<std::int64_t>> places_, ints_;
    std::deque<std::vector<double>> reals_;
};

}  // namespace rddlc::workbench
