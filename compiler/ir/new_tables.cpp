#include "ir/new_tables.hpp"

#include <optional>
#include <utility>

namespace rddlc::ir {
namespace {

bool are_alike(const Buffer& a, const Buffer& b) {
    return a.storage == Storage::Constant && b.storage == Storage::Constant &&
           a.scalar == b.scalar && a.shape == b.shape && a.types == b.types &&
           a.holds_places == b.holds_places && identical(a.values, b.values);
}

}  // namespace

void set_dimensions(const Program& program, Buffer& table,
                    const std::vector<VariableId>& variables) {
    table.shape.clear();
    table.types.clear();
    for (const VariableId variable : variables) {
        table.shape.push_back(program[variable].size);
        if (program[variable].type) table.types.push_back(*program[variable].type);
    }
    // Types are known in all dimensions or dropped.
    if (table.types.size() != table.shape.size()) table.types.clear();
}

void NewTables::know_names() {
    for (; known_names_ < program_.buffers.size(); ++known_names_)
        names_.insert(program_.buffers[known_names_].name);
}

void NewTables::know_constants() {
    for (; known_constants_ < program_.buffers.size(); ++known_constants_) {
        const Buffer& buffer = program_.buffers[known_constants_];
        if (buffer.storage != Storage::Constant) continue;
        constants_.emplace(hash_of(buffer.values),
                           BufferId{static_cast<std::uint32_t>(known_constants_)});
    }
}

std::string NewTables::unused_name(const std::string& wish, std::string_view separator) {
    know_names();
    if (!names_.contains(wish)) return wish;
    int& number = next_number_.try_emplace(wish, 2).first->second;
    const auto numbered = [&] {
        return wish + std::string(separator) + std::to_string(number);
    };
    while (names_.contains(numbered())) ++number;
    return numbered();
}

BufferId NewTables::add(Buffer table) {
    program_.buffers.push_back(std::move(table));
    return {static_cast<std::uint32_t>(program_.buffers.size() - 1)};
}

BufferId NewTables::scratch(const std::string& wish, Scalar scalar, std::optional<Range> range,
                            const std::vector<VariableId>& variables, Span span) {
    Buffer table{.name = unused_name(wish),
                 .storage = Storage::Scratch,
                 .scalar = scalar,
                 .span = span,
                 .range = range};
    set_dimensions(program_, table, variables);
    return add(std::move(table));
}

BufferId NewTables::list(const std::string& name, Scalar scalar, const std::vector<Value>& values,
                         Span span) {
    return constant({.name = name,
                     .storage = Storage::Constant,
                     .scalar = scalar,
                     .shape = {std::ssize(values)},
                     .values = values,
                     .span = span});
}

BufferId NewTables::constant(Buffer table) {
    know_constants();
    std::optional<BufferId> first;
    const auto [begin, end] = constants_.equal_range(hash_of(table.values));
    for (auto each = begin; each != end; ++each) {
        const bool is_first = !first || each->second < *first;
        if (is_first && are_alike(program_[each->second], table)) first = each->second;
    }
    if (first) return *first;
    table.name = unused_name(table.name);
    return add(std::move(table));
}

}  // namespace rddlc::ir
