#include "passes/constants/fold_uniform_tables.hpp"

#include "ir/rewrite.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace rddlc::passes {
namespace {

bool is_uniform_table(const ir::Buffer& buffer) {
    return buffer.storage == ir::Storage::Constant && buffer.values.is_uniform();
}

}  // namespace

ir::Program fold_uniform_tables(ir::Program program, Report& report) {
    std::vector<bool> is_uniform;
    for (const ir::Buffer& buffer : program.buffers) is_uniform.push_back(is_uniform_table(buffer));

    std::set<ir::BufferId> replaced;
    program = ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* load = std::get_if<ir::Load>(&node.form);
            if (!load || !is_uniform[load->buffer.index]) return std::nullopt;
            const auto droppable = [&](ir::NodeId index) {
                return ir::is_droppable(builder.properties(index));
            };
            if (!std::ranges::all_of(load->indices, droppable)) return std::nullopt;
            replaced.insert(load->buffer);
            return builder.constant(builder.program()[load->buffer].values[0]);
        });
    report["tables made scalars"] += static_cast<std::int64_t>(replaced.size());
    return program;
}

}  // namespace rddlc::passes
