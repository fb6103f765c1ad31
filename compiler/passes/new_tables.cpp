#include "passes/new_tables.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::passes {
namespace {

bool are_alike(const ir::Buffer& a, const ir::Buffer& b) {
    return a.storage == ir::Storage::Constant && b.storage == ir::Storage::Constant &&
           a.scalar == b.scalar && a.shape == b.shape && a.types == b.types &&
           identical(a.values, b.values);
}

}  // namespace

std::string unused_name(const ir::Program& program, const std::string& wish) {
    const auto is_taken = [&](const std::string& name) {
        return std::ranges::find(program.buffers, name, &ir::Buffer::name) != program.buffers.end();
    };
    std::string name = wish;
    for (int number = 2; is_taken(name); ++number) name = wish + "-" + std::to_string(number);
    return name;
}

void set_dimensions(const ir::Program& program, ir::Buffer& table,
                    const std::vector<ir::VariableId>& variables) {
    table.shape.clear();
    table.types.clear();
    for (const ir::VariableId variable : variables) {
        table.shape.push_back(program[variable].size);
        if (program[variable].type) table.types.push_back(*program[variable].type);
    }
    // Of objects in all dimensions, or in none.
    if (table.types.size() != table.shape.size()) table.types.clear();
}

ir::BufferId scratch_table(ir::Program& program, const std::string& wish, ir::Scalar scalar,
                           bool finite, const std::vector<ir::VariableId>& variables, Span span) {
    ir::Buffer table{.name = unused_name(program, wish),
                     .storage = ir::Storage::Scratch,
                     .scalar = scalar,
                     .span = span,
                     .finite = finite};
    set_dimensions(program, table, variables);
    program.buffers.push_back(std::move(table));
    return {static_cast<std::uint32_t>(program.buffers.size() - 1)};
}

ir::BufferId constant_table(ir::Program& program, ir::Buffer table) {
    for (std::uint32_t index = 0; index < program.buffers.size(); ++index) {
        if (are_alike(program.buffers[index], table)) return {index};
    }
    table.name = unused_name(program, table.name);
    program.buffers.push_back(std::move(table));
    return {static_cast<std::uint32_t>(program.buffers.size() - 1)};
}

}  // namespace rddlc::passes
