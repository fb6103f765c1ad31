#include "passes/lanes/turn_tables.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/object_lanes.hpp"
#include "passes/analyses/plain_definition.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

class Turning {
  public:
    Turning(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        if (program_.policy) return std::move(program_);
        for (const ir::Definition& definition : program_.step) note_reads(definition.body);
        note_others(ir::roots_of(program_.reward));
        for (ir::Definition& definition : program_.step) {
            const auto column = columns_.find(definition.target);
            if (column != columns_.end() && !read_otherwise_.contains(definition.target))
                turn(definition, column->second);
        }
        if (turned_.empty()) return std::move(program_);
        ir::replace_in_step(builder_, program_, turned_);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // ------------------------------------------------------------------------------ finding

    void note_reads(const ir::Block& block) {
        for (const ir::Statement& statement : block) {
            const auto* loop = std::get_if<ir::Loop>(&statement.form);
            const ir::Nest nest = loop ? ir::nest_of(*loop) : ir::Nest{{}, nullptr};
            const auto* store = loop ? ir::only_statement<ir::Store>(*nest.body) : nullptr;
            if (store && program_[store->target].scalar == ir::Scalar::Bool)
                note_columns(store->value, nest.variables.back());
            else
                note_others(loop ? ir::roots_of(loop->body) : ir::roots_of({statement}));
        }
    }
    void note_others(const std::vector<ir::NodeId>& roots) {
        for (const ir::NodeId root : roots)
            ir::any_node_of(program_, root, [&](ir::NodeId id) {
                if (const auto buffer = ir::buffer_read_by(program_[id]))
                    read_otherwise_.insert(*buffer);
                return false;
            });
    }
    // In the body of a loop over this variable.
    void note_columns(ir::NodeId value, ir::VariableId variable) {
        ir::any_node_of(program_, value, [&](ir::NodeId id) {
            const auto buffer = ir::buffer_read_by(program_[id]);
            if (!buffer) return false;
            const auto* load = std::get_if<ir::Load>(&program_[id].form);
            const auto axis = load ? axis_of(*load, variable) : std::nullopt;
            const auto known = columns_.find(*buffer);
            if (!axis || (known != columns_.end() && known->second != *axis))
                read_otherwise_.insert(*buffer);
            else
                columns_[*buffer] = *axis;
            loads_[*buffer].insert(id);
            return false;
        });
    }
    // The axis along which a column has the objects of the loop. The last one is that of a row.
    std::optional<std::size_t> axis_of(const ir::Load& load, ir::VariableId variable) const {
        const ir::Buffer& buffer = program_[load.buffer];
        if (buffer.storage != ir::Storage::Scratch || buffer.scalar != ir::Scalar::Bool ||
            load.indices.size() < 2)
            return std::nullopt;
        std::optional<std::size_t> axis;
        for (std::size_t i = 0; i < load.indices.size(); ++i) {
            if (!ir::depends_on(builder_.properties(load.indices[i]), variable)) continue;
            if (axis || !ir::is_index_of(program_, load.indices[i], variable)) return std::nullopt;
            axis = i;
        }
        return axis && *axis + 1 < load.indices.size() ? axis : std::nullopt;
    }

    // ------------------------------------------------------------------------------- making

    static void move_to_end(auto& items, std::size_t axis) {
        const auto item = items.begin() + static_cast<std::ptrdiff_t>(axis);
        std::rotate(item, item + 1, items.end());
    }

    void turn(ir::Definition& definition, std::size_t axis) {
        const auto is_there = [](const auto& variable) {
            return variable.has_value();
        };
        const auto plain = plain_definition(program_, definition);
        if (!plain || !std::ranges::all_of(plain->variables, is_there)) return;
        std::vector<ir::VariableId> variables;
        for (const auto& variable : plain->variables) variables.push_back(*variable);
        move_to_end(variables, axis);
        const ir::Properties properties = builder_.properties(plain->value);
        const ir::Nest innermost{{variables.back()}, nullptr};
        const ObjectLanes several(builder_, innermost);
        if (properties.random || properties.may_fault || !several.are_enough(ir::Scalar::Bool) ||
            !several.can_evaluate(plain->value))
            return;

        const ir::BufferId former = definition.target;
        const ir::BufferId turned = builder_.tables().scratch(
            program_[former].name + "-turned", ir::Scalar::Bool, {}, variables, definition.span);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        ir::Loop inner{.variable = variables.back(),
                       .body = {{ir::Store{turned, std::move(indices), plain->value}}},
                       .several_at_once = true};
        definition.target = turned;
        variables.pop_back();
        definition.body = ir::looped({{std::move(inner)}}, variables);
        for (const ir::NodeId id : loads_.at(former)) {
            std::vector<ir::NodeId> places = std::get<ir::Load>(program_[id].form).indices;
            move_to_end(places, axis);
            turned_[id] = builder_.load(turned, std::move(places));
        }
        ++report_["tables stored by columns"];
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::BufferId, std::size_t> columns_;  // the axis along which it is read
    std::map<ir::BufferId, std::set<ir::NodeId>> loads_;
    std::set<ir::BufferId> read_otherwise_;
    std::map<ir::NodeId, ir::NodeId> turned_;  // loads
};

}  // namespace

ir::Program turn_tables(ir::Program program, Report& report) {
    return Turning(std::move(program), report).run();
}

}  // namespace rddlc::passes
