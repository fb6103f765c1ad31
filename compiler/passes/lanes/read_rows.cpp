#include "passes/lanes/read_rows.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/object_lanes.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Registers look bools up in rows of at most so many.
constexpr std::int64_t longest_row = 64;
// Tables of more elements are not worth their memory.
constexpr std::int64_t most_elements = 1 << 12;

using Variables = std::vector<ir::VariableId>;

bool is_plain_quantifier(const ir::Reduce& reduce) {
    return is_quantifier(reduce.op) && !reduce.bounds && !reduce.over_true;
}

class RowReading {
  public:
    RowReading(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(std::as_const(program_)) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            span_ = definition.span;
            for (ir::Statement& statement : definition.body)
                if (auto* loop = std::get_if<ir::Loop>(&statement.form)) change(*loop);
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // The innermost loop alone: its objects lie in rows that the loops around it choose.
    void change(ir::Loop& outermost) {
        auto* const store = ir::only_statement<ir::Store>(ir::innermost_body(outermost));
        if (!store || program_[store->target].scalar != ir::Scalar::Bool ||
            ir::reads(program_, store->value, store->target) || is_possible(outermost, *store))
            return;
        const ir::Nest all = ir::nest_of(outermost);
        nest_ = {{all.variables.back()}, all.body};
        name_ = program_[store->target].name;
        terms_.clear();
        const ir::Properties& properties = builder_.properties(store->value);
        if (properties.random || properties.may_fault || !collect_terms(store->value) ||
            terms_.empty() || !can_be_rows(store->value) || !fill_a_row(program_, nest_))
            return;
        known_.clear();
        const ir::NodeId value = in_rows(store->value);
        if (value == store->value ||
            !several(nest_).can_store_in_row(ir::Store{store->target, store->indices, value}))
            return;
        store->value = value;
        ir::Loop& innermost = ir::innermost_loop(outermost);
        innermost.several_at_once = innermost.as_words = true;
        ++report_["loops that read bools in rows"];
    }
    static constexpr ir::Scalar bools = ir::Scalar::Bool;

    ObjectLanes several(const ir::Nest& nest) const { return {builder_, nest}; }
    // Several objects at once already, those of the innermost loops or of all.
    bool is_possible(const ir::Loop& loop, const ir::Store& store) const {
        const ObjectLanes objects = several(ir::nest_of(loop));
        if (objects.are_enough(bools) && objects.can_store_in_row(store)) return true;
        const auto* inner = ir::only_statement<ir::Loop>(loop.body);
        return inner && is_possible(*inner, store);
    }

    // The variables of the aggregations; false if there are others than quantifiers.
    bool collect_terms(ir::NodeId id) {
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (reduce && !is_plain_quantifier(*reduce)) return false;
        if (reduce) terms_.push_back(reduce->variable);
        return std::ranges::all_of(ir::operands_of(program_[id]),
                                   [&](ir::NodeId operand) { return collect_terms(operand); });
    }

    // ------------------------------------------------------------------------------ finding

    bool differs(ir::NodeId id) const {
        return ir::depends_on_any(builder_.properties(id), nest_.variables);
    }
    // The variables of terms that it depends on, and those of the loop; nothing if it depends on
    // more than these and constants.
    std::optional<Variables> variables_of(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        if (!properties.uniform || properties.may_fault) return std::nullopt;
        Variables variables;
        for (const ir::VariableId variable : properties.free_variables) {
            if (std::ranges::find(nest_.variables, variable) != nest_.variables.end()) continue;
            if (std::ranges::find(terms_, variable) == terms_.end()) return std::nullopt;
            variables.push_back(variable);
        }
        variables.insert(variables.end(), nest_.variables.begin(), nest_.variables.end());
        const bool is_small = ir::combinations(program_, variables) <= most_elements;
        return is_small ? std::optional(variables) : std::nullopt;
    }
    // So many leading indices are the same for all objects.
    std::size_t leading_of(const ir::Load& load) const {
        const auto first = std::ranges::find_if(load.indices, [&](auto id) { return differs(id); });
        return static_cast<std::size_t>(first - load.indices.begin());
    }
    bool is_in_row(const ir::Load& load) const {
        return ir::ends_with(program_, load.indices, nest_) &&
               leading_of(load) + nest_.variables.size() == load.indices.size();
    }
    bool is_known(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return program_[id].type == bools && variables_of(id) && !(load && is_in_row(*load));
    }

    bool can_be_rows(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        if (node.type != bools) return false;
        if (!differs(id) || is_known(id)) return true;
        if (const auto* load = std::get_if<ir::Load>(&node.form)) return can_be_row(*load);
        const bool combines = std::holds_alternative<ir::Apply>(node.form) ||
                              std::holds_alternative<ir::Select>(node.form) ||
                              std::holds_alternative<ir::Reduce>(node.form);
        return combines && std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
                   return can_be_rows(operand);
               });
    }
    bool can_be_row(const ir::Load& load) const {
        const std::size_t leading = leading_of(load);
        const auto is_uniform = [&](ir::NodeId id) {
            return builder_.properties(id).uniform;
        };
        const std::span<const ir::NodeId> indices = load.indices;
        return std::ranges::all_of(indices.first(leading), is_uniform) &&
               (is_in_row(load) ||
                (program_[load.buffer].row_size(leading) <= longest_row &&
                 std::ranges::all_of(indices.subspan(leading),
                                     [&](ir::NodeId id) { return variables_of(id).has_value(); })));
    }

    // ------------------------------------------------------------------------------- making

    ir::NodeId in_rows(ir::NodeId id) {
        return ir::replace_in(builder_, id, known_, [&](ir::NodeId each) { return in_row(each); });
    }
    std::optional<ir::NodeId> in_row(ir::NodeId id) {
        if (!differs(id)) return id;
        if (is_known(id)) return row("row", id);
        const auto* found = std::get_if<ir::Load>(&program_[id].form);
        if (!found) return std::nullopt;
        if (is_in_row(*found)) return id;
        const ir::Load load = *found;  // new nodes move the others
        const std::size_t leading = leading_of(load);
        ir::NodeId place = builder_.constant(std::int64_t{0});
        for (std::size_t axis = leading; axis < load.indices.size(); ++axis) {
            const ir::NodeId size = builder_.constant(program_[load.buffer].shape[axis]);
            place = builder_.apply(
                Operator::Add,
                {builder_.apply(Operator::Multiply, {place, size}), load.indices[axis]});
        }
        return builder_.element(load.buffer, row("places", place),
                                {load.indices.begin(), load.indices.begin() + leading});
    }

    // A table of what constants decide, a row for each term.
    ir::NodeId row(const std::string& what, ir::NodeId id) {
        const Variables variables = *variables_of(id);
        evaluator_.know_added_tables();
        auto values = constant_values(evaluator_, program_, id, variables);
        ir::Buffer buffer{.name = name_ + "-" + what,
                          .storage = ir::Storage::Constant,
                          .scalar = program_[id].type,
                          .values = std::move(*values),
                          .span = span_,
                          .holds_places = what == "places"};
        ir::set_dimensions(program_, buffer, variables);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        return builder_.load(builder_.tables().constant(std::move(buffer)), std::move(indices));
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;

    // Members of the loop at hand.
    ir::Nest nest_;     // of the innermost loop
    std::string name_;  // of what it fills
    Span span_;
    Variables terms_;  // of its aggregations
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program read_rows(ir::Program program, Report& report) {
    return RowReading(std::move(program), report).run();
}

}  // namespace rddlc::passes
