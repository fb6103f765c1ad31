#include "passes/aggregations/draw_over_objects.hpp"

#include "ir/cost_model.hpp"
#include "ir/fill_table.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Shorter lists stay as they are.
constexpr std::size_t fewest_weights = 3;
// Operations (Properties::cost) of a part that is worth a table.
constexpr double worth_a_table = 2;

using Variables = std::vector<ir::VariableId>;

class DrawsOverObjects {
  public:
    DrawsOverObjects(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            ir::Block result;
            for (ir::Statement& statement : definition.body) {
                ir::Block single;
                single.push_back(std::move(statement));
                std::map<ir::NodeId, ir::NodeId> known;
                ir::change_roots(single, [&](ir::NodeId& root) {
                    root = ir::replace_in(builder_, root, known,
                                          [&](ir::NodeId id) { return over_objects(id, result); });
                });
                result.push_back(std::move(single.front()));
            }
            definition.body = std::move(result);
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    std::optional<ir::NodeId> over_objects(ir::NodeId id, ir::Block& before) {
        const auto* found = std::get_if<ir::Discrete>(&program_[id].form);
        if (!found || found->weights.size() < fewest_weights) return std::nullopt;
        const ir::Discrete discrete = *found;  // building nodes moves the pool
        object_ = objects_of(discrete.weights.size());
        known_.clear();
        const auto weight = generalised(discrete.weights);
        if (!weight || !depends_on(*weight, object_)) return std::nullopt;
        ++report_["draws over objects"];
        return builder_.discrete_over(discrete.normalise, discrete.place, object_,
                                      with_parts(*weight, before));
    }

    // A variable of its own for each length of lists.
    ir::VariableId objects_of(std::size_t count) {
        const auto size = static_cast<std::int64_t>(count);
        const auto [known, is_new] = variables_.try_emplace(size);
        if (is_new) {
            known->second = {static_cast<std::uint32_t>(program_.variables.size())};
            program_.variables.push_back({.name = "choice", .type = type_of(size), .size = size});
        }
        return known->second;
    }
    // The enumerated type that has so many objects, for the sake of its name.
    std::optional<std::uint32_t> type_of(std::int64_t size) const {
        for (std::uint32_t type = 0; type < program_.types.size(); ++type)
            if (program_.types[type].enumerated && std::ssize(program_.types[type].objects) == size)
                return type;
        return std::nullopt;
    }

    bool depends_on(ir::NodeId id, ir::VariableId variable) const {
        return ir::depends_on(builder_.properties(id), variable);
    }

    // ------------------------------------------------------------------------ generalising

    // The expression whose value for each object is the one in the list.
    std::optional<ir::NodeId> generalised(const std::vector<ir::NodeId>& ids) {
        if (std::ranges::all_of(ids, [&](ir::NodeId id) { return id == ids.front(); }))
            return ids.front();
        if (const auto known = known_.find(ids); known != known_.end()) return known->second;
        return known_[ids] = is_constant(ids.front()) ? of_constants(ids) : of_operands(ids);
    }

    bool is_constant(ir::NodeId id) const {
        return std::holds_alternative<ir::Constant>(program_[id].form);
    }

    std::optional<ir::NodeId> of_constants(const std::vector<ir::NodeId>& ids) {
        std::vector<ir::Value> values;
        bool are_objects = true;
        for (const ir::NodeId id : ids) {
            const auto* constant = std::get_if<ir::Constant>(&program_[id].form);
            if (!constant || program_[id].type != program_[ids.front()].type) return std::nullopt;
            are_objects &= constant->value == ir::Value(std::ssize(values));
            values.push_back(constant->value);
        }
        if (are_objects) return builder_.index(object_);
        ir::Buffer table{.name = name_ + "-weights",
                         .storage = ir::Storage::Constant,
                         .scalar = program_[ids.front()].type,
                         .values = std::move(values),
                         .span = span_};
        ir::set_dimensions(program_, table, {object_});
        return builder_.load(builder_.tables().constant(std::move(table)),
                             {builder_.index(object_)});
    }

    // Nodes that differ in their operands alone.
    std::optional<ir::NodeId> of_operands(const std::vector<ir::NodeId>& ids) {
        std::vector<std::vector<ir::NodeId>> operands;
        for (const ir::NodeId id : ids) operands.push_back(ir::operands_of(program_[id]));
        for (std::size_t k = 1; k < ids.size(); ++k) {
            if (operands[k].size() != operands[0].size()) return std::nullopt;
            ir::Node other = program_[ids[k]];
            std::size_t operand = 0;
            ir::change_operands(other, [&](ir::NodeId& each) { each = operands[0][operand++]; });
            if (!(other == program_[ids[0]])) return std::nullopt;
        }
        std::vector<ir::NodeId> all;
        for (std::size_t operand = 0; operand < operands[0].size(); ++operand) {
            std::vector<ir::NodeId> column;
            for (const auto& row : operands) column.push_back(row[operand]);
            const auto one = generalised(column);
            if (!one) return std::nullopt;
            all.push_back(*one);
        }
        ir::Node node = program_[ids[0]];
        std::size_t operand = 0;
        ir::change_operands(node, [&](ir::NodeId& each) { each = all[operand++]; });
        return builder_.rebuild(node);
    }

    // ------------------------------------------------------------------------------- parts

    // The weight with elements of tables in place of what it has in common with terms of its sums.
    ir::NodeId with_parts(ir::NodeId weight, ir::Block& before) {
        std::vector<ir::NodeId> inside;
        collect(weight, inside);
        std::map<ir::NodeId, ir::NodeId> elements;
        for (const ir::NodeId id : inside) {
            const auto* found = std::get_if<ir::Reduce>(&program_[id].form);
            if (!found || found->bounds || depends_on(id, object_) ||
                program_[found->variable].size != program_[object_].size)
                continue;
            const ir::Reduce reduce = *found;
            std::map<ir::NodeId, ir::NodeId> renamed{
                {builder_.index(reduce.variable), builder_.index(object_)}};
            const ir::NodeId part = ir::replace_in(builder_, reduce.body, renamed);
            const ir::Properties& properties = builder_.properties(part);
            if (std::ranges::find(inside, part) == inside.end() || !ir::is_droppable(properties) ||
                properties.cost < worth_a_table || elements_of(part) > ir::most_new_elements)
                continue;
            const ir::BufferId table = table_of(part, before);
            const auto element_for = [&](ir::VariableId variable) {
                std::vector<ir::NodeId> indices;
                for (const ir::VariableId each : dimensions_of(part))
                    indices.push_back(builder_.index(each == object_ ? variable : each));
                return builder_.load(table, std::move(indices));
            };
            elements[part] = element_for(object_);
            elements[id] =
                builder_.reduce(reduce.op, reduce.variable, element_for(reduce.variable));
        }
        return ir::replace_in(builder_, weight, elements);
    }

    void collect(ir::NodeId id, std::vector<ir::NodeId>& inside) const {
        if (std::ranges::find(inside, id) != inside.end()) return;
        inside.push_back(id);
        for (const ir::NodeId operand : ir::operands_of(program_[id])) collect(operand, inside);
    }

    // The objects first: what does not depend on the loops around the draw is computed once for
    // each.
    Variables dimensions_of(ir::NodeId part) const {
        Variables variables = {object_};
        for (const ir::VariableId variable : builder_.properties(part).free_variables)
            if (variable != object_) variables.push_back(variable);
        return variables;
    }

    double elements_of(ir::NodeId part) const {
        double elements = 1;
        for (const ir::VariableId variable : dimensions_of(part))
            elements *= static_cast<double>(program_[variable].size);
        return elements;
    }

    ir::BufferId table_of(ir::NodeId part, ir::Block& before) {
        const auto [known, is_new] = tables_.try_emplace(part);
        if (is_new) {
            const Variables variables = dimensions_of(part);
            known->second =
                builder_.tables().scratch(name_ + "-parts", program_[part].type,
                                          builder_.properties(part).range, variables, span_);
            ir::fill_table(builder_, before, known->second, variables, part);
        }
        return known->second;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
    std::map<std::int64_t, ir::VariableId> variables_;  // by number of objects
    ir::VariableId object_{};                           // of the draw at hand
    std::map<std::vector<ir::NodeId>, std::optional<ir::NodeId>> known_;
    std::map<ir::NodeId, ir::BufferId> tables_;
};

}  // namespace

ir::Program draw_over_objects(ir::Program program, Report& report) {
    return DrawsOverObjects(std::move(program), report).run();
}

}  // namespace rddlc::passes
