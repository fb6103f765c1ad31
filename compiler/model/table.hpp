// The values of a fluent, or a constant table: one value that most elements have, and the others.
// So a table over all pairs of 10,000 objects takes as much room as it has exceptions. Copies share
// them until one of the copies changes, so a program with large tables is cheap to copy.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace rddlc {

using Value = std::variant<bool, std::int64_t, double>;

// The same bits: zeros have a sign, and nan equals itself.
bool identical(const Value& a, const Value& b);
bool are_identical(std::span<const Value> a, std::span<const Value> b);

// 0 and 1 for bools.
double as_real(const Value& value);
bool is_negative_zero(const Value& value);

class Table {
  public:
    Table() = default;              // without elements
    Table(const Table&) = default;  // also where it is moved from, so that it stays a table
    Table& operator=(const Table&) = default;
    ~Table() = default;
    Table(std::int64_t size, Value common) : size_(size), common_(common) {}
    Table(const std::vector<Value>& values);
    Table(std::initializer_list<Value> values) : Table(std::vector<Value>(values)) {}

    std::int64_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const Value& operator[](std::int64_t index) const;
    void set(std::int64_t index, Value value);

    // The value of every element that is not among the exceptions, which are by index and all
    // differ from it.
    const Value& common() const { return common_; }
    const std::map<std::int64_t, Value>& exceptions() const { return *exceptions_; }
    bool has_common() const { return std::ssize(*exceptions_) < size_; }

    // All elements are the same, bit by bit.
    bool is_uniform() const;
    std::vector<Value> dense() const;

    // Whether it holds of each value that occurs.
    template <class Holds>
    bool all_of(const Holds& holds) const {
        if (has_common() && !holds(common_)) return false;
        for (const auto& [index, value] : *exceptions_) {
            if (!holds(value)) return false;
        }
        return true;
    }

    bool operator==(const Table& other) const { return dense() == other.dense(); }

  private:
    std::int64_t size_ = 0;
    Value common_;
    std::shared_ptr<std::map<std::int64_t, Value>> exceptions_ =
        std::make_shared<std::map<std::int64_t, Value>>();  // shared: not changed in place
};

// Whether both have the same size and elements, bit by bit.
bool identical(const Table& a, const Table& b);
// Equal for tables that are identical. Takes the time of the exceptions.
std::uint64_t hash_of(const Table& table);

}  // namespace rddlc
