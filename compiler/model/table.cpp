#include "model/table.hpp"

#include "support/match.hpp"

#include <algorithm>
#include <bit>

namespace rddlc {
namespace {

// The value that more than half of them have, if there is one (Boyer and Moore's vote).
Value majority_of(const std::vector<Value>& values) {
    Value candidate;
    std::size_t votes = 0;
    for (const Value& value : values) {
        if (votes == 0) candidate = value;
        identical(value, candidate) ? ++votes : --votes;
    }
    return candidate;
}

std::uint64_t hash_of(const Value& value) {
    const std::uint64_t bits = match(
        value, [](double v) { return std::bit_cast<std::uint64_t>(v); },
        [](auto v) { return static_cast<std::uint64_t>(v); });
    std::uint64_t hash = (bits + value.index()) * 0x9e3779b97f4a7c15;  // of Fibonacci hashing
    hash ^= hash >> 32;
    return hash * 0x9e3779b97f4a7c15;
}

std::uint64_t cube(std::uint64_t n) {
    return n * n * n;
}

// The sum of the cubes of the first n numbers, from 1 on.
std::uint64_t sum_of_cubes(std::uint64_t n) {
    const std::uint64_t sum = n % 2 == 0 ? n / 2 * (n + 1) : (n + 1) / 2 * n;
    return sum * sum;
}

}  // namespace

double as_real(const Value& value) {
    return match(value, [](auto v) { return static_cast<double>(v); });
}

bool is_negative_zero(const Value& value) {
    return identical(value, -0.0);
}

bool identical(const Value& a, const Value& b) {
    const auto* x = std::get_if<double>(&a);
    const auto* y = std::get_if<double>(&b);
    if (!x || !y) return a == b;
    return std::bit_cast<std::uint64_t>(*x) == std::bit_cast<std::uint64_t>(*y);
}

bool are_identical(std::span<const Value> a, std::span<const Value> b) {
    return std::ranges::equal(a, b, [](const Value& x, const Value& y) { return identical(x, y); });
}

Table::Table(const std::vector<Value>& values)
    : size_(std::ssize(values)), common_(majority_of(values)) {
    for (std::int64_t i = 0; i < size_; ++i) {
        const Value& value = values[static_cast<std::size_t>(i)];
        if (!identical(value, common_)) exceptions_->emplace_hint(exceptions_->end(), i, value);
    }
}

const Value& Table::operator[](std::int64_t index) const {
    const auto found = exceptions_->find(index);
    return found == exceptions_->end() ? common_ : found->second;
}

void Table::set(std::int64_t index, Value value) {
    if (exceptions_.use_count() > 1)
        exceptions_ = std::make_shared<std::map<std::int64_t, Value>>(*exceptions_);
    if (identical(value, common_)) {
        exceptions_->erase(index);
    } else {
        exceptions_->insert_or_assign(index, value);
    }
}

bool Table::is_uniform() const {
    if (exceptions_->empty()) return !empty();
    if (has_common()) return false;
    return all_of([&](const Value& value) { return identical(value, (*this)[0]); });
}

std::vector<Value> Table::dense() const {
    std::vector<Value> values(static_cast<std::size_t>(size_), common_);
    for (const auto& [index, value] : *exceptions_) values[static_cast<std::size_t>(index)] = value;
    return values;
}

bool identical(const Table& a, const Table& b) {
    if (a.size() != b.size()) return false;
    if (!identical(a.common(), b.common())) {
        const auto exceptions = std::ssize(a.exceptions()) + std::ssize(b.exceptions());
        if (exceptions < a.size()) return false;  // some element is common in both
        return std::ranges::equal(a.dense(), b.dense(),
                                  [](const Value& x, const Value& y) { return identical(x, y); });
    }
    return std::ranges::equal(a.exceptions(), b.exceptions(), [](const auto& x, const auto& y) {
        return x.first == y.first && identical(x.second, y.second);
    });
}

// The sum of the elements' hashes, each times the cube of its place: so it does not matter which
// value is the common one.
std::uint64_t hash_of(const Table& table) {
    const std::uint64_t common = hash_of(table.common());
    std::uint64_t hash = common * sum_of_cubes(static_cast<std::uint64_t>(table.size()));
    for (const auto& [index, value] : table.exceptions())
        hash += (hash_of(value) - common) * cube(static_cast<std::uint64_t>(index) + 1);
    return hash;
}

}  // namespace rddlc
