#include "passes/aggregations/entry_tables.hpp"

#include <algorithm>

namespace rddlc::passes {
ir::BufferId EntryTables::table(const std::string& name, ir::Scalar scalar,
                                const std::vector<ir::Value>& values, Span span) {
    return tables_.list(name, scalar, values, span);
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

}  // namespace rddlc::passes
