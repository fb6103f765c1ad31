#include "ir/table_properties.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rddlc::ir {
namespace {

bool is_too_large(const Value& value) {
    return std::holds_alternative<std::int64_t>(value) && std::abs(as_real(value)) >= exact_ints;
}

double longest_row_of(const Table& begins) {
    double longest = 0;
    for (std::int64_t k = 1; k < begins.size(); ++k)
        longest = std::max(longest, as_real(begins[k]) - as_real(begins[k - 1]));
    return longest;
}

double most_ones_of(const Table& words) {
    double most = 0;
    words.all_of([&](const Value& value) {
        const auto word = static_cast<std::uint64_t>(std::get<std::int64_t>(value));
        most = std::max(most, static_cast<double>(std::popcount(word)));
        return true;
    });
    return most;
}

// The known fact, or else the result of `find`.
template <class T, class Find>
T known(std::optional<T>& fact, const Find& find) {
    if (!fact) fact = find();
    return *fact;
}

}  // namespace

std::optional<Range> range_of(const Table& values) {
    if (values.empty()) return std::nullopt;
    Range range{HUGE_VAL, -HUGE_VAL};
    const bool without_nan = values.all_of([&](const Value& value) {
        const double v = as_real(value);
        range = join(range, {v, v});
        return !std::isnan(v) && !is_too_large(value);
    });
    return without_nan ? std::optional(range) : std::nullopt;
}

TableProperties::Properties& TableProperties::of(BufferId table) {
    if (properties_.size() <= table.index) properties_.resize(table.index + 1);
    return properties_[table.index];
}

std::optional<Range> TableProperties::range(const Program& program, BufferId table) {
    return known(of(table).range, [&] { return range_of(program[table].values); });
}

double TableProperties::longest_row(const Program& program, BufferId table) {
    return known(of(table).longest_row, [&] { return longest_row_of(program[table].values); });
}

double TableProperties::most_ones(const Program& program, BufferId table) {
    return known(of(table).most_ones, [&] { return most_ones_of(program[table].values); });
}

bool TableProperties::has_negative_zero(const Program& program, BufferId table) {
    return known(of(table).has_negative_zero, [&] {
        return !program[table].values.all_of(
            [](const Value& value) { return !is_negative_zero(value); });
    });
}

}  // namespace rddlc::ir
