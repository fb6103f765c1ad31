#include "passes/aggregations/visit_true.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/entry_tables.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/sparsity_pattern.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Initially, at most one of so many is true.
constexpr std::int64_t least_per_true = 16;

using Factors = std::vector<ir::NodeId>;

class Visiting {
  public:
    Visiting(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(program_),
          pattern_(builder_, evaluator_),
          tables_(program_) {}

    ir::Program run() && {
        std::vector<ir::Definition> step;
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            filled_ = ir::written_buffers(definition.body);
            std::map<ir::NodeId, ir::NodeId> known;
            ir::change_roots(definition.body, [&](ir::NodeId& root) {
                root = ir::replace_in(builder_, root, known,
                                      [&](ir::NodeId id) { return visited(id); });
            });
            std::ranges::move(before_, std::back_inserter(step));
            before_.clear();
            step.push_back(std::move(definition));
        }
        program_.step = std::move(step);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // An aggregation over pairs, of which the bools of `few` choose the first ones.
    struct Pairs {
        Factors factors = {};                // of its body, without the constant ones
        ir::NodeId few;                      // among them: an element at the first variable
        ir::VariableId first, second;        // each of the aggregation or of a loop around
        std::vector<ir::VariableId> around;  // those of loops
        Relation relation = {};              // the pairs whose constant factors hold
        std::string table = {};              // the name of the first constant factor
    };

    // The element of a table that stands for an aggregation, if that is worth it.
    std::optional<ir::NodeId> visited(ir::NodeId id) {
        const std::optional<Pairs> pairs = pairs_of(id);
        if (!pairs) return std::nullopt;
        const ir::BufferId target =
            builder_.tables().scratch(name_ + "-any", ir::Scalar::Bool, {}, pairs->around, span_);
        before_.push_back({target, {{scatter_into(target, *pairs)}}, span_});
        ++report_["aggregations over the few that are true"];
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : pairs->around)
            indices.push_back(builder_.index(variable));
        return builder_.load(target, std::move(indices));
    }

    // ------------------------------------------------------------------------------ finding

    std::optional<Pairs> pairs_of(ir::NodeId id) {
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || nest->op != Reduction::Exists) return std::nullopt;
        const ir::Properties& properties = builder_.properties(id);
        std::vector<ir::VariableId> variables = nest->variables;
        std::ranges::copy(properties.free_variables, std::back_inserter(variables));
        if (variables.size() != 2 || properties.may_fault || properties.random ||
            !is_known_before(nest->body))
            return std::nullopt;
        Factors factors;
        collect_factors(nest->body, factors);
        const auto few =
            std::ranges::find_if(factors, [&](ir::NodeId each) { return is_few(each); });
        if (few == factors.end() || !reads_large_table(nest->body)) return std::nullopt;
        const ir::VariableId first = builder_.properties(*few).free_variables.front();
        const ir::VariableId second = variables[0] == first ? variables[1] : variables[0];
        Pairs pairs{
            .few = *few, .first = first, .second = second, .around = properties.free_variables};
        const auto found = pattern_.of(nest->body, false);
        if (!found || !found->has(first) || !found->has(second)) return std::nullopt;
        pairs.relation =
            ordered(*found, {{first, program_[first].size}, {second, program_[second].size}});
        for (const ir::NodeId factor : factors)
            if (!is_constant(factor, pairs)) pairs.factors.push_back(factor);
        if (pairs.relation.tuples.empty()) return std::nullopt;
        // Factors that read few bytes decide first.
        std::stable_partition(pairs.factors.begin(), pairs.factors.end(),
                              [&](ir::NodeId each) { return !reads_large_table(each); });
        return pairs;
    }

    void collect_factors(ir::NodeId id, Factors& factors) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (!apply || apply->op != Operator::And) return factors.push_back(id);
        for (const ir::NodeId operand : apply->operands) collect_factors(operand, factors);
    }

    bool is_few(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || load->indices.size() != 1 ||
            !std::holds_alternative<ir::Index>(program_[load->indices[0]].form))
            return false;
        const ir::Buffer& buffer = program_[load->buffer];
        if (buffer.storage != ir::Storage::State || buffer.scalar != ir::Scalar::Bool) return false;
        const std::vector<ir::Value> values = buffer.values.dense();
        const std::int64_t count = std::ranges::count(values, ir::Value(true));
        return count > 0 && count * least_per_true <= std::ssize(values);
    }

    // A table that loops over many bools do not look up.
    bool reads_large_table(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (load && program_[load->buffer].storage != ir::Storage::Constant &&
            program_[load->buffer].count() > most_looked_up_bools)
            return true;
        return std::ranges::any_of(ir::operands_of(program_[id]),
                                   [&](ir::NodeId operand) { return reads_large_table(operand); });
    }

    // Neither a value that the definition itself computes nor another aggregation is part of it.
    bool is_known_before(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        const auto buffer = ir::buffer_read_by(node);
        if (std::holds_alternative<ir::Local>(node.form) || ir::bound_variable(node) ||
            (buffer && filled_.contains(*buffer)))
            return false;
        return std::ranges::all_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return is_known_before(operand); });
    }

    // Then the pairs of which it does not hold are left out.
    bool is_constant(ir::NodeId factor, Pairs& pairs) {
        if (!builder_.properties(factor).uniform) return false;
        std::vector<std::int64_t> kept;
        for (const std::int64_t tuple : pairs.relation.tuples) {
            const auto value = pattern_.evaluate(factor, pairs.relation.axes, tuple);
            if (!value) return false;
            if (*value == ir::Value(true)) kept.push_back(tuple);
        }
        pairs.relation.tuples = std::move(kept);
        const auto* load = std::get_if<ir::Load>(&program_[factor].form);
        if (load && pairs.table.empty()) pairs.table = program_[load->buffer].name;
        return true;
    }

    // ------------------------------------------------------------------------------- making

    ir::Scatter scatter_into(ir::BufferId target, const Pairs& pairs) {
        const std::string name = pairs.table.empty() ? name_ : pairs.table;
        const std::int64_t row_size = program_[pairs.second].size;
        std::vector<ir::Value> begins, seconds;
        auto tuple = pairs.relation.tuples.begin();
        for (std::int64_t row = 0; row < program_[pairs.first].size; ++row) {
            begins.emplace_back(std::ssize(seconds));
            for (; tuple != pairs.relation.tuples.end() && *tuple / row_size == row; ++tuple)
                seconds.emplace_back(*tuple % row_size);
        }
        begins.emplace_back(std::ssize(seconds));
        const ir::VariableId entry = tables_.variable(std::ssize(seconds), 0);
        const ir::BufferId rows = tables_.table(name + "-rows", ir::Scalar::Int, begins, span_);
        const ir::BufferId objects = tables_.table(name + "-" + program_[pairs.second].name,
                                                   ir::Scalar::Int, seconds, span_);
        std::map<ir::NodeId, ir::NodeId> of_entry;
        of_entry[builder_.index(pairs.second)] = builder_.load(objects, {builder_.index(entry)});
        const auto renewed = [&](ir::NodeId id) {
            return ir::replace_in(builder_, id, of_entry);
        };
        ir::NodeId value = builder_.constant(true);
        for (const ir::NodeId factor : pairs.factors)
            if (factor != pairs.few)
                value = builder_.apply(Operator::And, {value, renewed(factor)});
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : pairs.around)
            indices.push_back(renewed(builder_.index(variable)));
        return {target, pairs.first, pairs.few, entry, rows, std::move(indices), value};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    SparsityPattern pattern_;
    EntryTables tables_;
    std::string name_;  // of what is being computed
    Span span_;
    std::set<ir::BufferId> filled_;       // by the current definition
    std::vector<ir::Definition> before_;  // what it needs
};

}  // namespace

ir::Program visit_true(ir::Program program, Report& report) {
    return Visiting(std::move(program), report).run();
}

}  // namespace rddlc::passes
