#include "passes/entry_tables.hpp"

#include "ir/fold.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::passes {

EntryTables::EntryTables(ir::Program& program) : program_(program) {
    for (const ir::Buffer& buffer : program.buffers) names_.insert(buffer.name);
}

ir::BufferId EntryTables::table(const std::string& name, ir::Scalar scalar,
                                std::vector<ir::Value> values, Span span) {
    const auto same = std::ranges::find_if(made_, [&](ir::BufferId id) {
        return program_[id].scalar == scalar &&
               std::ranges::equal(program_[id].values, values, ir::identical);
    });
    if (same != made_.end()) return *same;
    made_.push_back({static_cast<std::uint32_t>(program_.buffers.size())});
    program_.buffers.push_back({.name = unused_name(name),
                                .storage = ir::Storage::Constant,
                                .scalar = scalar,
                                .shape = {static_cast<std::int64_t>(values.size())},
                                .types = {},
                                .fluent = {},
                                .values = std::move(values),
                                .span = span});
    return made_.back();
}

ir::VariableId EntryTables::variable(std::int64_t count, std::size_t depth) {
    const std::string name = depth == 0 ? "entry" : "entry-" + std::to_string(depth + 1);
    for (ir::VariableId id : variables_) {
        if (program_[id].size == count && program_[id].name == name) return id;
    }
    variables_.push_back({static_cast<std::uint32_t>(program_.variables.size())});
    program_.variables.push_back({name, {}, count});
    return variables_.back();
}

std::string EntryTables::unused_name(const std::string& wish) {
    std::string name = wish;
    for (int number = 2; !names_.insert(name).second; ++number) {
        name = wish + "-" + std::to_string(number);
    }
    return name;
}

}  // namespace rddlc::passes
