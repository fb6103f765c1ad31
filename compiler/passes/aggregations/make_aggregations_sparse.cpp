// Over 400 lines: finding the entries, writing their tables and rewriting the nest share one state.
#include "passes/aggregations/make_aggregations_sparse.hpp"

#include "ir/evaluation_budget.hpp"
#include "ir/fold.hpp"
#include "ir/new_tables.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/entry_tables.hpp"
#include "passes/analyses/sparsity_pattern.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace rddlc::passes {
namespace {

// Operations of looking up an entry.
constexpr double cost_of_entry = 3;
// A loop over all objects is fine if it costs no more than this.
constexpr double cheap_loop = 12;
// A test whether factors are finite, and sparse sums, must take less than this part of dense ones.
constexpr double worthwhile_tests = 0.5;
// Operations of testing a factor, besides its own.
constexpr double cost_of_test = 2;
// Rows beyond this number must have entries.
constexpr double most_empty_rows = 1e6;
// The entries of all aggregations: each takes a few numbers in the emitted text.
constexpr std::int64_t most_entries_in_all = std::int64_t{1} << 20;

// An int of this range chooses an element in the row of an entry, and the size of such tables.
constexpr double most_cases = 256;
constexpr std::int64_t most_elements_by_int = 4096;

// The aggregation that is being rewritten: its objects are those of an entry now.
struct Scope {
    Scope* outer = nullptr;  // null: not inside of any
    Relation relation = {};  // by axes that choose the row, then those of its columns
    std::size_t row_axes = 0;
    bool has_row_an_entry = false;  // the rows are the entries of `outer`; else all there may be
    std::vector<std::int64_t> padded = {};  // a tuple for each row, if rows of one entry are padded
    ir::NodeId entry = {};
    std::string name = {};  // of its tables
    Span span = {};
    std::map<ir::NodeId, ir::NodeId> done = {};

    std::span<const Axis> axes() const { return relation.axes; }
    // The tables have values for these.
    std::span<const std::int64_t> tuples() const {
        return padded.empty() ? relation.tuples : padded;
    }
    std::span<const Axis> rows() const { return axes().first(row_axes); }
    std::span<const Axis> columns() const { return axes().subspan(row_axes); }
};

class Rewriting {
  public:
    Rewriting(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(program_),
          pattern_(builder_, evaluator_),
          tables_(program_) {}

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_)) {
            rewrite(definition->body, program_[definition->target].name, definition->span);
        }
        for (const auto& [name, computation] : ir::computations_of(program_))
            rewrite(*computation, name);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void rewrite(ir::Block& block, const std::string& name, Span span) {
        name_ = name;
        span_ = span;
        ir::change_roots(block, [&](ir::NodeId& root) { root = rewritten(root, everything_); });
    }
    void rewrite(ir::Computation& computation, const std::string& name) {
        rewrite(computation.body, name, computation.span);
        computation.value = rewritten(computation.value, everything_);
    }

    ir::NodeId rewritten(ir::NodeId id, Scope& innermost) {
        Scope& scope = scope_of(id, innermost);
        if (const auto known = scope.done.find(id); known != scope.done.end()) return known->second;
        const ir::NodeId result = scope.outer ? of_entry(id, scope) : rebuilt(id, scope);
        return scope.done[id] = result;
    }

    // The innermost scope that replaces a variable of the node.
    Scope& scope_of(ir::NodeId id, Scope& innermost) const {
        const auto& variables = builder_.properties(id).free_variables;
        const auto is_used = [&](const Axis& axis) {
            return std::ranges::binary_search(variables, axis.variable);
        };
        Scope* scope = &innermost;
        while (scope->outer && std::ranges::none_of(scope->columns(), is_used)) {
            scope = scope->outer;
        }
        return *scope;
    }

    ir::NodeId rebuilt(ir::NodeId id, Scope& scope) {
        if (std::holds_alternative<ir::Reduce>(program_[id].form)) {
            if (const auto sparse = made_sparse(id, scope)) return *sparse;
        }
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        if (select && select->evaluated == ir::Evaluated::MostlyFirst && !scope.outer) {
            const auto [condition, then_value, else_value, evaluated] = *select;
            const ir::NodeId tested = rewritten(condition, scope);
            return builder_.select(tested, rewritten(then_value, scope), else_value, evaluated);
        }
        return dense(id, scope);
    }
    ir::NodeId dense(ir::NodeId id, Scope& scope) {
        ir::Node node = program_[id];
        ir::change_operands(node,
                            [&](ir::NodeId& operand) { operand = rewritten(operand, scope); });
        return builder_.rebuild(node);
    }

    // -------------------------------------------------------------------------- entries

    ir::NodeId of_entry(ir::NodeId id, Scope& scope) {
        if (const auto* index = std::get_if<ir::Index>(&program_[id].form)) {
            return column(index->variable, scope);
        }
        const std::optional<ir::NodeId> table =
            is_fixed(id, scope) ? tabulated(id, scope) : tabulated_by_int(id, scope);
        return table ? *table : rebuilt(id, scope);
    }

    // The object of an entry.
    ir::NodeId column(ir::VariableId variable, const Scope& scope) {
        const auto axis = std::ranges::find(scope.axes(), variable, &Axis::variable);
        const auto place = static_cast<std::size_t>(axis - scope.axes().begin());
        std::vector<ir::Value> values;
        for (const std::int64_t entry : scope.tuples()) {
            values.emplace_back(values_of(entry, scope.axes())[place]);
        }
        return load("-" + program_[variable].name, ir::Scalar::Int, std::move(values), scope);
    }

    // The same in all environments, and not just arithmetic of objects.
    bool is_fixed(ir::NodeId id, const Scope& scope) const {
        const ir::Properties& properties = builder_.properties(id);
        const auto is_known = [&](ir::VariableId variable) {
            return scope.relation.has(variable);
        };
        return properties.uniform && std::ranges::all_of(properties.free_variables, is_known) &&
               ir::EvaluationBudget::allows(properties.cost *
                                            static_cast<double>(scope.relation.count())) &&
               (program_[id].type != ir::Scalar::Int || reads_table(id));
    }

    bool reads_table(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            return std::holds_alternative<ir::Load>(program_[each].form);
        });
    }

    // The node's values for the entries, unless it faults for some.
    std::optional<ir::NodeId> tabulated(ir::NodeId id, const Scope& scope) {
        std::vector<ir::Value> values;
        values.reserve(scope.tuples().size());
        for (const std::int64_t entry : scope.tuples()) {
            const auto value = pattern_.evaluate(id, scope.axes(), entry);
            if (!value) return std::nullopt;
            values.push_back(*value);
        }
        const auto is_like_first = [&](const ir::Value& value) {
            return identical(value, values.front());
        };
        if (std::ranges::all_of(values, is_like_first)) return builder_.constant(values.front());
        return load("-entries", program_[id].type, std::move(values), scope);
    }

    // The values that an entry and one int of a small range decide: a row for each entry.
    std::optional<ir::NodeId> tabulated_by_int(ir::NodeId id, const Scope& scope) {
        std::optional<ir::NodeId> chooser;
        if (!finds_only_int(id, scope, chooser) || !chooser) return std::nullopt;
        const Range range = *builder_.properties(*chooser).range;
        const auto cases = static_cast<std::size_t>(range.upper - range.lower) + 1;
        std::vector<ir::Value> values(scope.tuples().size() * cases);
        if (static_cast<std::int64_t>(values.size()) >= most_by_int(id)) return std::nullopt;
        const auto least = static_cast<std::int64_t>(range.lower);
        for (std::size_t k = 0; k < cases; ++k) {
            const auto value_of_int = builder_.constant(least + static_cast<std::int64_t>(k));
            std::map<ir::NodeId, ir::NodeId> known = {{*chooser, value_of_int}};
            const ir::NodeId of_case = ir::replace_in(builder_, id, known);
            for (std::size_t entry = 0; entry < scope.tuples().size(); ++entry) {
                const auto value = pattern_.evaluate(of_case, scope.axes(), scope.tuples()[entry]);
                if (!value) return std::nullopt;
                values[entry * cases + k] = *value;
            }
        }
        ir::Buffer table{.name = scope.name + "-entries",
                         .storage = ir::Storage::Constant,
                         .scalar = program_[id].type,
                         .shape = {scope.relation.count(), static_cast<std::int64_t>(cases)},
                         .values = std::move(values),
                         .span = scope.span};
        const ir::NodeId place = builder_.apply(
            Operator::Subtract, {rewritten(*chooser, *scope.outer), builder_.constant(least)});
        return builder_.load(builder_.tables().constant(std::move(table)), {scope.entry, place});
    }

    // Whether a node depends on the objects of an entry and on one int alone, which has a small
    // range and does not depend on them.
    bool finds_only_int(ir::NodeId id, const Scope& scope,
                        std::optional<ir::NodeId>& chooser) const {
        const ir::Node& node = program_[id];
        const ir::Properties& properties = builder_.properties(id);
        const auto is_known = [&](ir::VariableId variable) {
            return scope.relation.has(variable);
        };
        if (properties.uniform) return std::ranges::all_of(properties.free_variables, is_known);
        const auto& range = properties.range;
        if (node.type == ir::Scalar::Int && !properties.may_fault && !properties.random && range &&
            range->upper - range->lower < most_cases &&
            std::ranges::none_of(properties.free_variables, is_known)) {
            if (!chooser) chooser = id;
            return *chooser == id;
        }
        const auto* load = std::get_if<ir::Load>(&node.form);
        const bool is_constant = load ? program_[load->buffer].storage == ir::Storage::Constant
                                      : std::holds_alternative<ir::Apply>(node.form) ||
                                            std::holds_alternative<ir::Convert>(node.form);
        return is_constant && std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
                   return finds_only_int(operand, scope, chooser);
               });
    }

    // A table of entries in place of another table is smaller.
    std::int64_t most_by_int(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load ? std::min(most_elements_by_int, program_[load->buffer].count())
                    : most_elements_by_int;
    }

    ir::NodeId load(const std::string& suffix, ir::Scalar scalar, std::vector<ir::Value> values,
                    const Scope& scope) {
        return builder_.load(
            tables_.table(scope.name + suffix, scalar, std::move(values), scope.span),
            {scope.entry});
    }

    // ---------------------------------------------------------------------- aggregations

    // Inner reductions belong to the nest if the order of terms does not matter.
    std::optional<ir::ReductionNest> nest_of(ir::NodeId id) const {
        const auto* const outermost = std::get_if<ir::Reduce>(&program_[id].form);
        return ir::reduction_nest(program_, id, [&](const ir::Reduce& reduce) {
            return &reduce == outermost || program_[id].type != ir::Scalar::Real;
        });
    }

    std::optional<ir::NodeId> made_sparse(ir::NodeId id, Scope& outer) {
        auto nest = nest_of(id);
        if (!nest) return std::nullopt;
        const ir::Reduce reduce = std::get<ir::Reduce>(program_[id].form);
        const auto neutral = ir::fold_empty(reduce.op, program_[reduce.body].type);
        if (!neutral) return std::nullopt;
        if (const auto decided = decided_by_constants(*nest, outer)) return decided;
        std::vector<ir::NodeId> doubtful;
        std::optional<Relation> found = pattern_.of(nest->body, *neutral);
        if (!found && reduce.op == Reduction::Sum) found = pattern_.of_term(reduce.body, doubtful);
        if (!found) return std::nullopt;
        if (pattern_.depend(doubtful, reduce.variable))
            return sparse_if_finite(id, *found, doubtful, outer);
        Scope scope = scope_for(*found, nest->variables, outer);
        if (!doubtful.empty() && !lacks_entries_in_each_row(scope)) return std::nullopt;
        if (scope.relation.tuples.empty())
            return with_terms_left_out(builder_.constant(*neutral), doubtful, outer);
        // Objects that no table tells apart are left to loops inside.
        std::erase_if(nest->variables, [&](ir::VariableId each) { return found->has(each); });
        const ir::NodeId body = ir::reduced(builder_, nest->op, nest->variables, nest->body);
        if (scope.relation.count() > entries_left_) return std::nullopt;
        if (!is_worthwhile(scope, body)) return std::nullopt;
        entries_left_ -= scope.relation.count();
        ++report_["aggregations made sparse"];
        name(scope, body);
        return with_terms_left_out(over_entries(nest->op, body, scope), doubtful, outer);
    }

    // A forall that constants make false for one object at least, whatever its row; an exists that
    // they make true.
    std::optional<ir::NodeId> decided_by_constants(const ir::ReductionNest& nest, Scope& outer) {
        if (!is_quantifier(nest.op)) return std::nullopt;
        if (!ir::is_droppable(builder_.properties(nest.body))) return std::nullopt;
        const bool decisive = nest.op == Reduction::Exists;
        const std::optional<Relation> undecided = pattern_.of(nest.body, decisive);
        if (!undecided) return std::nullopt;
        const Scope scope = scope_for(*undecided, nest.variables, outer);
        if (!lacks_entries_in_each_row(scope)) return std::nullopt;
        ++report_["aggregations decided by constants"];
        return builder_.constant(decisive);
    }

    // Factors that depend on the variable of a sum alone are tested once for all rows: if all of
    // them are finite, as they mostly are, the terms that are left out are zeros. In the program
    // for moderate values alone, since the other one need not be fast then.
    std::optional<ir::NodeId> sparse_if_finite(ir::NodeId id, const Relation& found,
                                               const std::vector<ir::NodeId>& doubtful,
                                               Scope& outer) {
        const ir::Reduce sum =
            std::get<ir::Reduce>(program_[id].form);  // new nodes move the others
        const ir::VariableId variable = sum.variable;
        const ir::NodeId body = sum.body;
        Scope scope = scope_for(found, {variable}, outer);
        const auto is_of_columns = [&](ir::NodeId factor) {
            const ir::Properties& properties = builder_.properties(factor);
            return properties.free_variables == std::vector{variable} && !properties.random;
        };
        if (!program_.only_moderate || outer.outer || found.tuples.empty() ||
            scope.relation.count() > entries_left_ ||
            !std::ranges::all_of(doubtful, is_of_columns) || !is_worthwhile(scope, body) ||
            !are_tests_worthwhile(scope, body, doubtful))
            return std::nullopt;
        entries_left_ -= scope.relation.count();
        ++report_["aggregations made sparse for finite factors"];
        name(scope, body);
        std::vector<ir::NodeId> are_finite;
        for (const ir::NodeId factor : doubtful) {
            const ir::NodeId zero = builder_.constant(0.0);
            const ir::NodeId term = builder_.apply(Operator::Multiply, {zero, factor});
            const ir::NodeId is_zero = builder_.apply(Operator::Equal, {term, zero});
            are_finite.push_back(builder_.reduce(Reduction::ForAll, variable, is_zero));
        }
        const ir::NodeId all = ir::joined(builder_, Operator::And, are_finite);
        const ir::NodeId sparse = over_entries(sum.op, body, scope);
        return builder_.select(all, sparse, dense(id, outer), ir::Evaluated::MostlyFirst);
    }

    bool are_tests_worthwhile(const Scope& scope, ir::NodeId body,
                              const std::vector<ir::NodeId>& doubtful) const {
        const double cost = builder_.properties(body).cost + 1;
        const auto columns = static_cast<double>(*volume(scope.columns()));
        double tests = 0;
        for (const ir::NodeId factor : doubtful)
            tests += columns * (builder_.properties(factor).cost + cost_of_test);
        const double sparse = static_cast<double>(scope.relation.count()) * (cost + cost_of_entry);
        const double dense = static_cast<double>(*rows_of(scope)) * columns * cost;
        return tests + sparse < worthwhile_tests * dense;
    }

    // A term that is left out is zero times each of these: it is nan where one is not finite. Else
    // it is a zero, which does not change a sum, since a sum is never -0.0.
    ir::NodeId with_terms_left_out(ir::NodeId sum, const std::vector<ir::NodeId>& doubtful,
                                   Scope& outer) {
        for (const ir::NodeId factor : doubtful) {
            const ir::NodeId zero = builder_.constant(0.0);
            const ir::NodeId term =
                builder_.apply(Operator::Multiply, {zero, rewritten(factor, outer)});
            sum = builder_.apply(Operator::Add, {sum, term});
        }
        return sum;
    }

    static bool lacks_entries_in_each_row(const Scope& scope) {
        const auto columns = volume(scope.columns());
        if (!columns || *columns == 0) return false;
        std::int64_t row = -1, count = 0;
        return std::ranges::none_of(scope.relation.tuples, [&](std::int64_t tuple) {
            count = tuple / *columns == row ? count + 1 : 1;
            row = tuple / *columns;
            return count == *columns;
        });
    }

    Scope scope_for(const Relation& found, const std::vector<ir::VariableId>& variables,
                    Scope& outer) {
        Scope scope{.outer = &outer};
        std::vector<Axis> axes;
        std::ranges::remove_copy_if(found.axes, std::back_inserter(axes), [&](const Axis& axis) {
            return std::ranges::find(variables, axis.variable) != variables.end();
        });
        scope.row_axes = axes.size();
        scope.has_row_an_entry = outer.outer && std::ranges::is_permutation(axes, outer.axes());
        if (scope.has_row_an_entry) axes.assign(outer.axes().begin(), outer.axes().end());
        for (const ir::VariableId variable : variables) {
            if (found.has(variable)) axes.push_back({variable, program_[variable].size});
        }
        scope.relation = ordered(found, std::move(axes));
        if (scope.has_row_an_entry) keep_rows_of_entries(scope);
        return scope;
    }

    // The others are not evaluated.
    static void keep_rows_of_entries(Scope& scope) {
        const std::int64_t columns = *volume(scope.columns());
        std::erase_if(scope.relation.tuples, [&](std::int64_t tuple) {
            return !std::ranges::binary_search(scope.outer->relation.tuples, tuple / columns);
        });
    }

    bool is_worthwhile(const Scope& scope, ir::NodeId body) const {
        const auto rows = rows_of(scope), columns = volume(scope.columns());
        if (!rows || !columns || scope.columns().empty()) return false;
        const auto count = static_cast<double>(scope.relation.count());
        const auto row_count = static_cast<double>(*rows);
        if (row_count > std::max(most_empty_rows, 4 * count)) return false;
        const double cost = builder_.properties(body).cost + 1;
        const double all = static_cast<double>(*columns) * cost;
        return all > cheap_loop && all > count / row_count * (cost + cost_of_entry);
    }

    ir::NodeId over_entries(Reduction op, ir::NodeId body, Scope& scope) {
        const std::vector<ir::Value> begins = row_begins(scope);
        if (has_one_entry_a_row(begins)) {
            scope.entry = row_of(scope);
            return builder_.aggregated(op, rewritten(body, scope));
        }
        if (has_at_most_one_entry_a_row(begins) && !scope.columns().empty() &&
            ir::is_droppable(builder_.properties(body)))
            return of_only_entries(op, body, scope, begins);
        const ir::VariableId variable = tables_.variable(scope.relation.count(), height_of(body));
        scope.entry = builder_.index(variable);
        if (scope.row_axes == 0) return builder_.reduce(op, variable, rewritten(body, scope));
        const ir::Bounds bounds = bounds_of_row(scope, begins);
        const ir::NodeId term = rewritten(body, scope);
        if (const auto whole = of_equal_terms(op, term, bounds, variable)) return *whole;
        return builder_.reduce(op, variable, term, bounds);
    }

    // Where all entries of a row have the same term, it matters only how many there are.
    std::optional<ir::NodeId> of_equal_terms(Reduction op, ir::NodeId term, ir::Bounds row,
                                             ir::VariableId entry) {
        const ir::Properties& properties = builder_.properties(term);
        if (ir::depends_on(properties, entry)) return std::nullopt;
        const std::vector ends = {row.begin, row.end};
        if (op == Reduction::Exists) {
            return builder_.apply(Operator::And, {builder_.apply(Operator::Less, ends), term});
        }
        if (op == Reduction::ForAll) {
            return builder_.apply(Operator::Or, {builder_.apply(Operator::Equal, ends), term});
        }
        const bool is_int_sum = op == Reduction::Sum && program_[term].type == ir::Scalar::Int;
        if (!is_int_sum || properties.may_fault) return std::nullopt;
        const ir::NodeId count = builder_.apply(Operator::Subtract, {row.end, row.begin});
        return builder_.apply(Operator::Multiply, {count, term});
    }

    // Then the row is the entry.
    static bool has_one_entry_a_row(const std::vector<ir::Value>& begins) {
        for (std::size_t row = 0; row < begins.size(); ++row) {
            if (begins[row] != ir::Value(static_cast<std::int64_t>(row))) return false;
        }
        return true;
    }

    // Few rows are empty.
    static bool has_at_most_one_entry_a_row(const std::vector<ir::Value>& begins) {
        const auto begin = [&](std::size_t row) {
            return std::get<std::int64_t>(begins[row]);
        };
        const std::size_t rows = begins.size() - 1;
        for (std::size_t row = 0; row < rows; ++row) {
            if (begin(row + 1) - begin(row) > 1) return false;
        }
        return rows > 0 && 2 * begin(rows) >= static_cast<std::int64_t>(rows);
    }

    // Rows that are empty get an entry of any objects, which a test leaves out: so the rows are the
    // entries. Tables repeat their neighbours there, since values that are the same for all others
    // need no table.
    ir::NodeId of_only_entries(Reduction op, ir::NodeId body, Scope& scope,
                               const std::vector<ir::Value>& begins) {
        const std::vector<std::int64_t> entries = std::move(scope.relation.tuples);
        std::vector<ir::Value> are_there;
        scope.relation.tuples.clear();
        for (std::size_t row = 0; row + 1 < begins.size(); ++row) {
            const auto entry = static_cast<std::size_t>(std::get<std::int64_t>(begins[row]));
            const bool is_there = begins[row] != begins[row + 1];
            are_there.emplace_back(is_there);
            scope.padded.push_back(entries[std::min(entry, entries.size() - 1)]);
            scope.relation.tuples.push_back(
                is_there ? entries[entry] : tuple_of_row(scope, row) * *volume(scope.columns()));
        }
        scope.entry = row_of(scope);
        const ir::NodeId is_there =
            load("-is-there", ir::Scalar::Bool, std::move(are_there), scope);
        const ir::NodeId value = builder_.aggregated(op, rewritten(body, scope));
        const ir::Value neutral = *ir::fold_empty(op, program_[value].type);
        return builder_.select(is_there, value, builder_.constant(neutral));
    }
    static std::int64_t tuple_of_row(const Scope& scope, std::size_t row) {
        return scope.has_row_an_entry ? scope.outer->relation.tuples[row]
                                      : static_cast<std::int64_t>(row);
    }

    ir::Bounds bounds_of_row(const Scope& scope, const std::vector<ir::Value>& row_begins) {
        const ir::BufferId begins =
            tables_.table(scope.name + "-rows", ir::Scalar::Int, row_begins, scope.span);
        const ir::NodeId row = row_of(scope);
        const ir::NodeId one = builder_.constant(std::int64_t{1});
        const ir::NodeId next = builder_.apply(Operator::Add, {row, one});
        return {builder_.load(begins, {row}), builder_.load(begins, {next})};
    }

    ir::NodeId row_of(const Scope& scope) {
        if (scope.has_row_an_entry) return scope.outer->entry;
        ir::NodeId row = builder_.constant(std::int64_t{0});
        for (const Axis& axis : scope.rows()) {
            const ir::NodeId size = builder_.constant(axis.size);
            const ir::NodeId object = rewritten(builder_.index(axis.variable), *scope.outer);
            row = builder_.apply(Operator::Multiply, {row, size});
            row = builder_.apply(Operator::Add, {row, object});
        }
        return row;
    }

    static std::optional<std::int64_t> rows_of(const Scope& scope) {
        return scope.has_row_an_entry ? scope.outer->relation.count() : volume(scope.rows());
    }

    // Where the entries of each row begin; at the end, how many there are.
    static std::vector<ir::Value> row_begins(const Scope& scope) {
        const std::vector<std::int64_t>& entries = scope.relation.tuples;
        const std::int64_t rows = *rows_of(scope), columns = *volume(scope.columns());
        std::vector<ir::Value> begins;
        begins.reserve(static_cast<std::size_t>(rows) + 1);
        auto entry = entries.begin();
        for (std::int64_t k = 0; k < rows; ++k) {
            const std::int64_t row = tuple_of_row(scope, static_cast<std::size_t>(k));
            while (entry != entries.end() && *entry / columns < row) ++entry;
            begins.emplace_back(std::int64_t{entry - entries.begin()});
        }
        begins.emplace_back(std::int64_t{std::ssize(entries)});
        return begins;
    }

    // How many aggregations are inside each other: their indices must differ.
    std::size_t height_of(ir::NodeId id) const {
        std::size_t height = 0;
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            height = std::max(height, height_of(operand));
        }
        return height + (std::holds_alternative<ir::Reduce>(program_[id].form) ? 1 : 0);
    }

    // The name comes from the table of bools that tells entries apart, or from the only table that
    // does, or else from the fluent that is computed.
    void name(Scope& scope, ir::NodeId body) const {
        std::set<ir::BufferId> tables;
        collect_tables(body, scope, tables);
        scope.name = name_;
        scope.span = span_;
        for (ir::BufferId table : tables) {
            if (tables.size() > 1 && program_[table].scalar != ir::Scalar::Bool) continue;
            scope.name = program_[table].name;
            scope.span = program_[table].span;
            return;
        }
    }

    void collect_tables(ir::NodeId id, const Scope& scope, std::set<ir::BufferId>& tables) const {
        const auto& variables = builder_.properties(id).free_variables;
        const bool varies = std::ranges::any_of(scope.axes(), [&](const Axis& axis) {
            return std::ranges::binary_search(variables, axis.variable);
        });
        if (!varies) return;
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (load && program_[load->buffer].storage == ir::Storage::Constant) {
            tables.insert(load->buffer);
        }
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            collect_tables(operand, scope, tables);
        }
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    SparsityPattern pattern_;
    EntryTables tables_;
    Scope everything_;
    std::int64_t entries_left_ = most_entries_in_all;
    std::string name_;  // of what is being rewritten
    Span span_;
};

}  // namespace

ir::Program make_aggregations_sparse(ir::Program program, Report& report) {
    return Rewriting(std::move(program), report).run();
}

}  // namespace rddlc::passes
