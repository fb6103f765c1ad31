// Over 400 lines: one pass, which finds conditions on few bools and makes the visits for them.
#include "passes/aggregations/visit_true.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/fill_table.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/entry_tables.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/few_true.hpp"
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
        for (const ir::NodeId id : all_nodes())
            if (const auto pairs = pairs_of(id)) visited_.insert(table_of(pairs->few));
        if (visited_.empty()) return std::move(program_);
        for (ir::Definition& definition : std::exchange(program_.step, {})) change(definition);
        for (const Together& together : together_) {
            ir::Definition& definition = program_.step[together.place];
            definition.body = together.fills;
            for (const ir::Visit& visit : together.visits) definition.body.push_back({visit});
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // An aggregation over pairs, of which the bools of `few` choose the first ones; or, without
    // pairs, a condition on one object.
    struct Pairs {
        Factors factors = {};       // without `few`, and without constant ones of pairs
        ir::NodeId few = {};        // an element at the first variable
        ir::VariableId first = {};  // of the aggregation, or of a loop around
        std::optional<ir::VariableId> second = {};  // the same
        std::vector<ir::VariableId> around = {};    // those of loops
        Relation relation = {};                     // the pairs whose constant factors hold
        std::string table = {};                     // the name of the first constant factor
    };
    // Marks an element of the table at hand with the value where there is such a pair.
    struct Choice {
        Pairs pairs;
        bool value;
    };
    // The visits of the true bools of one table, and the tables that they mark, as they are before.
    struct Together {
        ir::BufferId few;
        std::size_t place;  // of the definition in the step
        ir::Block fills;
        std::vector<ir::Visit> visits;
    };

    std::vector<ir::NodeId> all_nodes() const {
        std::vector<ir::NodeId> nodes;
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index)
            nodes.push_back({index});
        return nodes;
    }
    ir::BufferId table_of(ir::NodeId element) const {
        return std::get<ir::Load>(program_[element].form).buffer;
    }

    void change(ir::Definition& definition) {
        name_ = program_[definition.target].name;
        span_ = definition.span;
        filled_ = ir::written_buffers(definition.body);
        if (marks_alone(definition)) return;
        std::map<ir::NodeId, ir::NodeId> known;
        ir::change_roots(definition.body, [&](ir::NodeId& root) {
            root =
                ir::replace_in(builder_, root, known, [&](ir::NodeId id) { return visited(id); });
        });
        program_.step.push_back(std::move(definition));
    }

    // The element of a table that stands for an aggregation, if that is worth it.
    std::optional<ir::NodeId> visited(ir::NodeId id) {
        std::optional<Pairs> pairs = pairs_of(id);
        if (!pairs) pairs = object_of(id);
        if (!pairs) return std::nullopt;
        const ir::BufferId target =
            builder_.tables().scratch(name_ + "-any", ir::Scalar::Bool, {}, pairs->around, span_);
        ir::Block fill;
        const ir::NodeId element =
            ir::fill_table(builder_, fill, target, pairs->around, builder_.constant(false));
        mark(target, std::move(fill), {{*pairs, true}});
        ++report_["aggregations over the few that are true"];
        return element;
    }

    // A table of which few elements change, or differ from a constant, is marked where they do.
    bool marks_alone(const ir::Definition& definition) {
        const auto* loop = ir::only_statement<ir::Loop>(definition.body);
        const auto* found = loop ? ir::only_statement<ir::Store>(loop->body) : nullptr;
        if (!found || found->indices != std::vector{builder_.index(loop->variable)}) return false;
        const ir::Store store = *found;
        object_ = loop->variable;
        std::vector<Choice> choices;
        const ir::NodeId rest = without_choices(store.value, choices);
        const bool is_observed = program_[store.target].storage == ir::Storage::Observation;
        if (choices.empty() || !is_rest(rest) || is_observed) return false;
        mark(store.target, {{ir::Loop{object_, {{ir::Store{store.target, store.indices, rest}}}}}},
             std::move(choices));
        ++report_["tables marked where few are true"];
        return true;
    }
    bool is_rest(ir::NodeId id) const {
        if (std::holds_alternative<ir::Constant>(program_[id].form)) return true;
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && program_[load->buffer].storage == ir::Storage::State &&
               load->indices.size() == 1 &&
               ir::is_index_of(program_, load->indices.front(), object_);
    }

    // Takes an expression of the object apart, the choice that decides first in front.
    ir::NodeId without_choices(ir::NodeId id, std::vector<Choice>& choices) {
        const auto chosen = [&](ir::NodeId condition, bool value) {
            std::optional<Pairs> pairs = pairs_of(condition);
            if (!pairs || pairs->around != std::vector{object_}) pairs = own_of(condition);
            if (!pairs) return false;
            choices.push_back({*std::move(pairs), value});
            return true;
        };
        if (const auto* select = std::get_if<ir::Select>(&program_[id].form)) {
            const auto [condition, then_value, else_value, evaluated] = *select;
            const auto value = ir::constant<bool>(program_, then_value);
            const bool takes_out = value && chosen(condition, *value);
            return takes_out ? without_choices(else_value, choices) : id;
        }
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (!apply || apply->operands.size() != 2) return id;
        const Operator op = apply->op;
        const std::vector<ir::NodeId> operands = apply->operands;
        for (std::size_t k = 0; k < 2; ++k) {
            const ir::NodeId other = operands[1 - k];
            const auto* negation = std::get_if<ir::Apply>(&program_[operands[k]].form);
            const bool is_negation = negation && negation->op == Operator::Not;
            if ((op == Operator::Or && chosen(operands[k], true)) ||
                (op == Operator::And && is_negation && chosen(negation->operands.front(), false)))
                return without_choices(other, choices);
        }
        return id;
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
        Factors factors = ir::parts_of(program_, nest->body, Operator::And);
        const auto few =
            std::ranges::find_if(factors, [&](ir::NodeId each) { return is_few(each); });
        if (few == factors.end() || !reads_large_table(nest->body)) return std::nullopt;
        const ir::VariableId first = builder_.properties(*few).free_variables.front();
        const ir::VariableId second = variables[0] == first ? variables[1] : variables[0];
        Pairs pairs;
        pairs.few = *few;
        pairs.first = first;
        pairs.second = second;
        pairs.around = properties.free_variables;
        const auto found = pattern_.of(nest->body, false);
        if (!found || !found->has(first) || !found->has(second)) return std::nullopt;
        pairs.relation =
            ordered(*found, {{first, program_[first].size}, {second, program_[second].size}});
        factors.erase(few);
        for (const ir::NodeId factor : factors)
            if (!is_constant(factor, pairs)) pairs.factors.push_back(factor);
        if (pairs.relation.tuples.empty()) return std::nullopt;
        // Factors that read few bytes decide first.
        std::stable_partition(pairs.factors.begin(), pairs.factors.end(),
                              [&](ir::NodeId each) { return !reads_large_table(each); });
        return pairs;
    }

    // An aggregation over the objects of a table that is visited anyway.
    std::optional<Pairs> object_of(ir::NodeId id) {
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || nest->op != Reduction::Exists || nest->variables.size() != 1 ||
            !builder_.properties(id).free_variables.empty())
            return std::nullopt;
        return condition_on(nest->variables.front(), nest->body);
    }
    // A condition on the object of the loop.
    std::optional<Pairs> own_of(ir::NodeId id) {
        std::optional<Pairs> own = condition_on(object_, id);
        if (own) own->around = {object_};
        return own;
    }
    std::optional<Pairs> condition_on(ir::VariableId object, ir::NodeId id) {
        if (!ir::is_droppable(builder_.properties(id)) || !is_known_before(id) ||
            program_[object].size <= bools_in_a_word)
            return std::nullopt;
        Factors factors = ir::parts_of(program_, id, Operator::And);
        const auto few = std::ranges::find_if(factors, [&](ir::NodeId each) {
            return is_few(each) && visited_.contains(table_of(each)) &&
                   builder_.properties(each).free_variables == std::vector{object};
        });
        if (few == factors.end()) return std::nullopt;
        Pairs own;
        own.few = *few;
        own.first = object;
        factors.erase(few);
        own.factors = std::move(factors);
        std::stable_partition(own.factors.begin(), own.factors.end(),
                              [&](ir::NodeId each) { return !reads_action(each); });
        return own;
    }

    bool is_few(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (!load || load->indices.size() != 1 ||
            !std::holds_alternative<ir::Index>(program_[load->indices[0]].form))
            return false;
        return begins_with_few_true(program_[load->buffer], least_per_visit);
    }

    // A table that loops over many bools do not look up.
    bool reads_large_table(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto* load = std::get_if<ir::Load>(&program_[each].form);
            return load && program_[load->buffer].storage != ir::Storage::Constant &&
                   program_[load->buffer].count() > most_looked_up_bools;
        });
    }

    // The records of actions are those of callers, and may not be in a cache.
    bool reads_action(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto buffer = ir::buffer_read_by(program_[each]);
            return buffer && program_[*buffer].storage == ir::Storage::Action;
        });
    }

    // Neither a value that the definition itself computes nor another aggregation is part of it.
    bool is_known_before(ir::NodeId id) const {
        return ir::is_known_before(program_, id, filled_) && !has_aggregation(id);
    }
    bool has_aggregation(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            return ir::bound_variable(program_[each]).has_value();
        });
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

    // The choice that decides first marks last. Visits that read nothing that the step computes are
    // made together with others of their kind.
    void mark(ir::BufferId target, ir::Block fill, std::vector<Choice> choices) {
        const ir::BufferId few = table_of(choices.front().pairs.few);
        const bool are_alike = std::ranges::all_of(choices, [&](const Choice& each) {
            return table_of(each.pairs.few) == few && reads_inputs_alone(each.pairs);
        });
        Together* together = nullptr;
        if (are_alike) {
            const auto known = std::ranges::find(together_, few, &Together::few);
            if (known != together_.end()) together = &*known;
        }
        if (!together) {
            together = &together_.emplace_back();
            together->few = few;
            together->place = program_.step.size();
            program_.step.push_back({target, {}, span_});
        }
        std::ranges::move(fill, std::back_inserter(together->fills));
        for (auto choice = choices.rbegin(); choice != choices.rend(); ++choice)
            add(*together, visit_of(target, *choice));
    }

    bool reads_inputs_alone(const Pairs& pairs) const {
        return std::ranges::all_of(pairs.factors,
                                   [&](ir::NodeId each) { return reads_inputs_alone(each); });
    }
    bool reads_inputs_alone(ir::NodeId id) const {
        const auto buffer = ir::buffer_read_by(program_[id]);
        return (!buffer || !program_[*buffer].is_computed_in_step()) &&
               std::ranges::all_of(ir::operands_of(program_[id]),
                                   [&](ir::NodeId operand) { return reads_inputs_alone(operand); });
    }

    // A visit has one mark. It joins the first one of the same table and the same entries behind
    // all that mark the same table otherwise.
    void add(Together& together, ir::Visit visit) {
        auto first = together.visits.begin();
        const auto contradicts = [&](const ir::Mark& mark) {
            return mark.target == visit.marks.front().target &&
                   mark.value != visit.marks.front().value;
        };
        for (auto each = first; each != together.visits.end(); ++each)
            if (std::ranges::any_of(each->marks, contradicts)) first = std::next(each);
        const auto rows_of = [](const ir::Visit& each) {
            return each.entries ? std::optional(each.entries->rows) : std::nullopt;
        };
        const auto same = std::find_if(first, together.visits.end(), [&](const ir::Visit& each) {
            return table_of(each.condition) == table_of(visit.condition) &&
                   rows_of(each) == rows_of(visit);
        });
        if (same == together.visits.end()) return together.visits.push_back(std::move(visit));
        std::map<ir::NodeId, ir::NodeId> renamed{
            {builder_.index(visit.visited), builder_.index(same->visited)}};
        if (visit.entries)
            renamed[builder_.index(visit.entries->variable)] =
                builder_.index(same->entries->variable);
        ir::Mark mark = std::move(visit.marks.front());
        for (ir::NodeId& index : mark.indices) index = ir::replace_in(builder_, index, renamed);
        mark.condition = ir::replace_in(builder_, mark.condition, renamed);
        same->marks.push_back(std::move(mark));
    }

    ir::Visit visit_of(ir::BufferId target, const Choice& choice) {
        const Pairs& pairs = choice.pairs;
        std::map<ir::NodeId, ir::NodeId> of_entry;
        std::optional<ir::Entries> entries;
        if (pairs.second) entries = entries_of(pairs, of_entry);
        const auto renewed = [&](ir::NodeId id) {
            return ir::replace_in(builder_, id, of_entry);
        };
        ir::NodeId condition = builder_.constant(true);
        for (const ir::NodeId factor : pairs.factors)
            condition = builder_.apply(Operator::And, {condition, renewed(factor)});
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : pairs.around)
            indices.push_back(renewed(builder_.index(variable)));
        return {pairs.first,
                pairs.few,
                entries,
                {{target, std::move(indices), condition, choice.value}}};
    }

    // `of_entry` gets what stands for the second object.
    ir::Entries entries_of(const Pairs& pairs, std::map<ir::NodeId, ir::NodeId>& of_entry) {
        const std::string name = pairs.table.empty() ? name_ : pairs.table;
        const std::int64_t row_size = program_[*pairs.second].size;
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
        const ir::BufferId objects = tables_.table(name + "-" + program_[*pairs.second].name,
                                                   ir::Scalar::Int, seconds, span_);
        of_entry[builder_.index(*pairs.second)] = builder_.load(objects, {builder_.index(entry)});
        return {entry, rows};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    SparsityPattern pattern_;
    EntryTables tables_;
    std::string name_;  // of what is being computed
    Span span_;
    std::set<ir::BufferId> filled_;   // by the current definition
    ir::VariableId object_;           // of its loop, where it may be marked
    std::set<ir::BufferId> visited_;  // tables whose true bools are visited for pairs
    std::vector<Together> together_;
};

}  // namespace

ir::Program visit_true(ir::Program program, Report& report) {
    return Visiting(std::move(program), report).run();
}

}  // namespace rddlc::passes
