#include "passes/aggregations/compare_cases.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/int_order.hpp"
#include "passes/analyses/plain_definition.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// An int that takes more operations, with those of the fluents that it may be, is not computed
// again by each comparison.
constexpr double cheap_to_compare_again = 10;

class Comparing {
  public:
    Comparing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        find_cases();
        while (drop_those_read_otherwise()) {
        }
        if (cases_.empty()) return std::move(program_);
        report_["ints that are conditions"] += static_cast<std::int64_t>(cases_.size());
        std::erase_if(program_.step, [&](const ir::Definition& definition) {
            return cases_.contains(definition.target);
        });
        const ir::Change compare = [&](ir::NodeId& root) {
            root = compared(root);
        };
        for (ir::Definition& definition : program_.step) ir::change_roots(definition.body, compare);
        ir::change_roots(program_.reward.body, compare);
        compare(program_.reward.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void find_cases() {
        const std::vector<Readers> readers = readers_of_step(program_);
        for (const ir::Definition& definition : program_.step) {
            const ir::Buffer& buffer = program_[definition.target];
            const Readers& of_buffer = readers[definition.target.index];
            if (buffer.storage != ir::Storage::Scratch || buffer.scalar != ir::Scalar::Int ||
                of_buffer.functions || of_buffer.reads == 0)
                continue;
            auto plain = plain_definition(program_, definition);
            if (!plain || !std::holds_alternative<ir::Select>(program_[plain->value].form) ||
                !is_choice(plain->value))
                continue;
            const double cost = cost_of(plain->value);
            if (cost > cheap_to_compare_again) continue;
            costs_[definition.target] = cost;
            cases_[definition.target] = *std::move(plain);
        }
    }
    // Cheap conditions choose one of several constants or elements.
    bool is_choice(ir::NodeId id) const {
        if (!ir::is_droppable(builder_.properties(id)) || !bound_variables(program_, id).empty())
            return false;
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        if (select) return is_choice(select->then_value) && is_choice(select->else_value);
        return ir::constant<std::int64_t>(program_, id) || is_load(id);
    }
    bool is_load(ir::NodeId id) const {
        return std::holds_alternative<ir::Load>(program_[id].form);
    }
    double cost_of(ir::NodeId id) const {
        double cost = builder_.properties(id).cost;
        for_each_load(id, [&](ir::BufferId buffer) {
            const auto known = costs_.find(buffer);
            if (known != costs_.end()) cost += known->second;
        });
        return cost;
    }
    // Visits the elements that a choice may be.
    template <class Visit>
    void for_each_load(ir::NodeId id, const Visit& visit) const {
        if (const auto* load = std::get_if<ir::Load>(&program_[id].form)) visit(load->buffer);
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        if (!select) return;
        for_each_load(select->then_value, visit);
        for_each_load(select->else_value, visit);
    }

    // Whether there was one.
    bool drop_those_read_otherwise() {
        visited_.clear();
        read_otherwise_.clear();
        for (const ir::Definition& definition : program_.step) {
            const auto known = cases_.find(definition.target);
            if (known != cases_.end())
                visit_choice(known->second.value);
            else
                visit_all(ir::roots_of(definition.body));
        }
        visit_all(ir::roots_of(program_.reward));
        for (ir::BufferId buffer : read_otherwise_) cases_.erase(buffer);
        return !read_otherwise_.empty();
    }
    void visit_all(const std::vector<ir::NodeId>& ids) {
        for (ir::NodeId id : ids) visit(id);
    }
    void visit(ir::NodeId id) {
        if (!visited_.insert(id).second) return;
        const ir::Node& node = program_[id];
        if (const auto* load = std::get_if<ir::Load>(&node.form); load && is_case(*load))
            read_otherwise_.insert(load->buffer);
        if (const auto comparison = comparison_of(id))
            visit_choice(comparison->choice);
        else
            visit_all(ir::operands_of(node));
    }
    void visit_choice(ir::NodeId id) {
        const ir::Node& node = program_[id];
        if (const auto* select = std::get_if<ir::Select>(&node.form)) {
            visit(select->condition);
            visit_choice(select->then_value);
            visit_choice(select->else_value);
        } else {
            visit_all(ir::operands_of(node));
        }
    }
    bool is_case(const ir::Load& load) const { return cases_.contains(load.buffer); }

    // An element of a case beside a constant.
    struct Comparison {
        Operator op;
        ir::NodeId choice, constant;
        bool constant_first;
    };
    std::optional<Comparison> comparison_of(ir::NodeId id) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (!apply || !is_comparison(apply->op)) return std::nullopt;
        const ir::NodeId first = apply->operands[0], last = apply->operands[1];
        const auto is_pair = [&](ir::NodeId choice, ir::NodeId constant) {
            const auto* load = std::get_if<ir::Load>(&program_[choice].form);
            return load && is_case(*load) && ir::constant<std::int64_t>(program_, constant);
        };
        if (is_pair(first, last)) return Comparison{apply->op, first, last, false};
        if (is_pair(last, first)) return Comparison{apply->op, last, first, true};
        return std::nullopt;
    }

    ir::NodeId compared(ir::NodeId root) {
        return ir::replace_in(builder_, root, known_,
                              [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                                  const auto comparison = comparison_of(id);
                                  if (!comparison) return std::nullopt;
                                  return condition_of(*comparison, comparison->choice);
                              });
    }
    // The bool that the comparison with this value, in place of its choice, gives.
    ir::NodeId condition_of(const Comparison& comparison, ir::NodeId value) {
        const ir::Node node = program_[value];
        if (const auto* select = std::get_if<ir::Select>(&node.form)) {
            const ir::NodeId condition = compared(select->condition);
            const ir::NodeId if_true = condition_of(comparison, select->then_value);
            return chosen(condition, if_true, condition_of(comparison, select->else_value));
        }
        const auto* load = std::get_if<ir::Load>(&node.form);
        if (load && is_case(*load)) return condition_of(comparison, element(*load));
        const ir::NodeId rest = compared(value);
        if (comparison.constant_first)
            return builder_.apply(comparison.op, {comparison.constant, rest});
        return builder_.apply(comparison.op, {rest, comparison.constant});
    }
    ir::NodeId element(const ir::Load& load) {
        const PlainDefinition& fluent = cases_.at(load.buffer);
        std::map<ir::NodeId, ir::NodeId> known;
        for (std::size_t axis = 0; axis < load.indices.size(); ++axis)
            if (fluent.variables[axis])
                known[builder_.index(*fluent.variables[axis])] = load.indices[axis];
        return ir::replace_in(builder_, fluent.value, known);
    }
    // select(condition, a, b) of bools, by connectives where one of them is known.
    ir::NodeId chosen(ir::NodeId condition, ir::NodeId a, ir::NodeId b) {
        const auto if_true = ir::constant<bool>(program_, a),
                   if_false = ir::constant<bool>(program_, b);
        if (!if_true && !if_false) return builder_.select(condition, a, b);
        const ir::NodeId opposite = builder_.apply(Operator::Not, {condition});
        if (if_true) return *if_true ? either(condition, b) : both(opposite, b);
        return *if_false ? either(opposite, a) : both(condition, a);
    }
    ir::NodeId both(ir::NodeId a, ir::NodeId b) {
        if (implies(program_, a, b)) return a;
        return implies(program_, b, a) ? b : builder_.apply(Operator::And, {a, b});
    }
    ir::NodeId either(ir::NodeId a, ir::NodeId b) {
        if (implies(program_, a, b)) return b;
        return implies(program_, b, a) ? a : builder_.apply(Operator::Or, {a, b});
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::BufferId, PlainDefinition> cases_;
    std::map<ir::BufferId, double> costs_;
    std::set<ir::NodeId> visited_;
    std::set<ir::BufferId> read_otherwise_;
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program compare_cases(ir::Program program, Report& report) {
    return Comparing(std::move(program), report).run();
}

}  // namespace rddlc::passes
