#include "passes/aggregations/tabulate_draws.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that are worth more than those of one more index.
constexpr double worth_a_table = 3;
constexpr std::int64_t most_outcomes = 4096;

class DrawTables {
  public:
    DrawTables(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_))
            change(definition->body, program_[definition->target].name, definition->span);
        change(program_.reward.body, "reward", program_.reward.span);
        program_.reward.value = rewritten(program_.reward.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // The draw and the element that an expression depends on.
    struct Parts {
        std::optional<ir::NodeId> draw, element;
        double cost = 0;  // beside these
    };

    void change(ir::Block& block, const std::string& name, Span span) {
        name_ = name;
        span_ = span;
        ir::change_roots(block, [&](ir::NodeId& root) { root = rewritten(root); });
    }
    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, done_,
                              [&](ir::NodeId part) { return looked_up(part); });
    }

    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        Parts parts;
        const bool may_be = program_[id].type != ir::Scalar::Bool && add(id, parts) && parts.draw &&
                            parts.element && parts.cost >= worth_a_table;
        const auto element = may_be ? element_of(*parts.element) : std::nullopt;
        const auto table = element ? table_of(id, parts, *element) : std::nullopt;
        if (!table) return std::nullopt;
        ++report_["expressions of a draw made tables"];
        std::vector<ir::NodeId> indices = element->indices;
        indices.push_back(builder_.convert(*parts.draw, ir::Scalar::Int));
        const ir::NodeId known = builder_.load(*table, std::move(indices));
        const auto* const select = std::get_if<ir::Select>(&program_[*parts.element].form);
        if (!select) return known;
        const ir::Select tested = *select;
        std::map<ir::NodeId, ir::NodeId> computed{{*parts.element, tested.else_value}};
        const ir::NodeId other = ir::replace_in(builder_, id, computed);
        return builder_.select(tested.condition, known, other, tested.evaluated);
    }

    // False if it depends on more than one draw, one element and constants.
    bool add(ir::NodeId id, Parts& parts) const {
        if (is_draw(id)) return is_only(parts.draw, id);
        if (element_of(id)) return is_only(parts.element, id);
        const ir::Node& node = program_[id];
        if (std::holds_alternative<ir::Constant>(node.form)) return true;
        const auto* const select = std::get_if<ir::Select>(&node.form);
        const bool computes = std::holds_alternative<ir::Apply>(node.form) ||
                              std::holds_alternative<ir::Convert>(node.form) ||
                              (select && select->evaluated != ir::Evaluated::MostlyFirst);
        if (!computes) return false;
        parts.cost += builder_.properties(id).cost;
        for (const ir::NodeId operand : ir::operands_of(node)) {
            parts.cost -= builder_.properties(operand).cost;
            if (!add(operand, parts)) return false;
        }
        return true;
    }
    static bool is_only(std::optional<ir::NodeId>& part, ir::NodeId id) {
        return std::exchange(part, id).value_or(id) == id;
    }

    bool is_draw(ir::NodeId id) const {
        const auto* const sample = std::get_if<ir::Sample>(&program_[id].form);
        return sample && program_[id].type == ir::Scalar::Bool;
    }

    // The element of a constant table that the node is, if not for certain.
    std::optional<ir::Load> element_of(ir::NodeId id) const {
        const auto* const select = std::get_if<ir::Select>(&program_[id].form);
        if (select && select->evaluated == ir::Evaluated::MostlyFirst)
            return element_of(select->then_value);
        const auto* const load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || program_[load->buffer].storage != ir::Storage::Constant ||
            load->indices.empty() || load->gather != ir::Gather::None)
            return std::nullopt;
        return *load;
    }

    // The values for each element and either draw; nothing if one faults, or if they are too many.
    std::optional<ir::BufferId> table_of(ir::NodeId id, const Parts& parts,
                                         const ir::Load& element) {
        if (2 * program_[element.buffer].count() > most_outcomes) return std::nullopt;
        std::vector<ir::VariableId> variables;
        std::vector<ir::NodeId> indices;
        for (const std::int64_t size : program_[element.buffer].shape) {
            variables.push_back({static_cast<std::uint32_t>(program_.variables.size())});
            program_.variables.push_back({.name = "entry", .type = std::nullopt, .size = size});
            indices.push_back(builder_.index(variables.back()));
        }
        const ir::NodeId any = builder_.load(element.buffer, std::move(indices));
        const ir::Evaluator evaluator(program_);  // which has room for these variables
        const auto values_for = [&](bool draw) {
            std::map<ir::NodeId, ir::NodeId> known{{*parts.element, any},
                                                   {*parts.draw, builder_.constant(draw)}};
            return constant_values(evaluator, program_, ir::replace_in(builder_, id, known),
                                   variables);
        };
        const auto if_false = values_for(false), if_true = values_for(true);
        if (!if_false || !if_true) return std::nullopt;

        ir::Buffer table{.name = name_ + "-by-draw",
                         .storage = ir::Storage::Constant,
                         .scalar = program_[id].type,
                         .shape = program_[element.buffer].shape,
                         .span = span_};
        table.shape.push_back(2);
        std::vector<ir::Value> values;
        for (std::size_t i = 0; i < if_false->size(); ++i)
            values.insert(values.end(), {(*if_false)[i], (*if_true)[i]});
        table.values = std::move(values);
        return builder_.tables().constant(std::move(table));
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program tabulate_draws(ir::Program program, Report& report) {
    return DrawTables(std::move(program), report).run();
}

}  // namespace rddlc::passes
