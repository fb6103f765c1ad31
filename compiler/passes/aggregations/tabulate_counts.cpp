#include "passes/aggregations/tabulate_counts.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/counters.hpp"
#include "passes/analyses/row_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace rddlc::passes {
namespace {

constexpr double largest_range = 256;
// Operations (Properties::cost) that are worth loading an element of a table instead, and how many
// elements each of them is worth.
constexpr double worth_a_count_table = 6;
constexpr double elements_for_an_operation = 64;
// The same where a test comes first whether the table has the element.
constexpr double worth_a_tested_table = 16;

// How an expression depends on what differs between environments.
struct Dependence {
    bool only_count = true;           // on nothing but `count`, beside constants
    std::optional<ir::NodeId> count;  // a small int; none: on nothing
    double cost = 0;                  // of what is computed beside the count
};

// Replaces the outermost expressions that depend on one count.
class CountTabulation {
  public:
    CountTabulation(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(program_),
          counters_(find_counters(builder_)) {
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index)
            dependences_.push_back(dependence_of({index}));
    }

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_))
            change(definition->body, program_[definition->target].name, definition->span);
        for (const auto& [name, computation] : ir::computations_of(program_))
            change(*computation, name);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // --------------------------------------------------------------------------- finding

    // For the users of a node. An int that a count chooses is no count of its own.
    Dependence dependence_of(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.uniform || !is_count(id)) return dependence_on_operands(id);
        if (!is_choice(id)) return {.count = id};
        const Dependence chosen = dependence_on_operands(id);
        return chosen.only_count ? chosen : Dependence{.count = id};
    }
    Dependence dependence_on_operands(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.uniform) return {.count = {}, .cost = properties.cost};
        Dependence dependence{.count = {}, .cost = properties.cost};
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            const Dependence& other = dependences_[operand.index];
            const bool agrees =
                !other.count || !dependence.count || other.count == dependence.count;
            dependence.only_count &= other.only_count && agrees;
            if (other.count) dependence.count = other.count;
            dependence.cost -= builder_.properties(operand).cost - other.cost;
        }
        dependence.only_count &= dependence.count.has_value();
        return dependence;
    }

    bool is_count(ir::NodeId id) const {
        if (is_counter(id)) return true;
        const ir::Properties& properties = builder_.properties(id);
        return program_[id].type == ir::Scalar::Int && !properties.may_fault && properties.range &&
               properties.range->upper - properties.range->lower < largest_range;
    }
    // A choice, a bool as a number, or one of them times a constant.
    bool is_choice(ir::NodeId id) const {
        if (std::holds_alternative<ir::Select>(program_[id].form)) return true;
        if (const auto* convert = std::get_if<ir::Convert>(&program_[id].form))
            return program_[convert->operand].type == ir::Scalar::Bool;
        const auto* product = std::get_if<ir::Apply>(&program_[id].form);
        if (!product || product->op != Operator::Multiply) return false;
        const ir::NodeId a = product->operands.front(), b = product->operands.back();
        return (builder_.properties(a).uniform && is_choice(b)) ||
               (builder_.properties(b).uniform && is_choice(a));
    }
    bool is_counter(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && counters_.contains(load->buffer);
    }
    // For certain, or, of a counter, as a rule.
    Range range_of(ir::NodeId count) const {
        if (!is_counter(count)) return *builder_.properties(count).range;
        return counters_.at(std::get<ir::Load>(program_[count].form).buffer);
    }

    // All that it depends on is bound outside of it.
    bool is_bound_inside(ir::NodeId count, ir::NodeId id) const {
        return !std::ranges::includes(builder_.properties(id).free_variables,
                                      builder_.properties(count).free_variables);
    }

    // ------------------------------------------------------------------------- replacing

    void change(ir::Block& block, const std::string& name, Span span) {
        name_ = name;
        span_ = span;
        ir::change_roots(block, [&](ir::NodeId& root) { root = rewritten(root); });
    }
    void change(ir::Computation& computation, const std::string& name) {
        change(computation.body, name, computation.span);
        computation.value = rewritten(computation.value);
    }

    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, done_,
                              [&](ir::NodeId part) { return looked_up(part); });
    }

    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        if (is_tested_already(id)) return id;
        const auto [only_count, count, cost] = dependence_on_operands(id);
        if (!only_count || !count) return std::nullopt;
        const bool is_tested = is_counter(*count);
        const bool is_worth_it = cost >= (is_tested ? worth_a_tested_table : worth_a_count_table);
        if (!is_worth_it || is_bound_inside(*count, id)) return std::nullopt;
        if (program_[id].type == ir::Scalar::Bool)
            return is_tested ? std::nullopt : compared(id, *count);
        const std::vector<ir::NodeId> cases = cases_of(id, *count);
        const std::vector<ir::VariableId> variables = variables_of(cases);
        const double elements = static_cast<double>(cases.size()) * objects_of(variables);
        if (elements > cost * elements_for_an_operation) return std::nullopt;
        auto values = values_of(cases, variables);
        if (!values) return std::nullopt;

        ++report_["expressions of a count made tables"];
        if (is_tested) return tested(id, *count, std::move(*values), variables);
        const Rows rows{.cases = cases.size(),
                        .values = std::move(*values),
                        .reached = reached_cases(*count, cases.size(), variables)};
        const std::string name = name_ + "-by-" + name_of(*count);
        const auto kinds = kinds_of(rows);
        auto [table, indices] = kinds ? table_of_kinds(name, rows, *kinds, variables)
                                      : table_of_objects(name, rows, variables);
        if (program_[table].values.is_uniform() && ir::is_droppable(builder_.properties(*count)))
            return builder_.constant(program_[table].values[0]);
        indices.push_back(builder_.apply(Operator::Subtract, {rewritten(*count), least(*count)}));
        return builder_.load(table, std::move(indices));
    }

    // A bool that is true for counts beside each other compares the count with their ends.
    std::optional<ir::NodeId> compared(ir::NodeId id, ir::NodeId count) {
        const std::vector<ir::NodeId> cases = cases_of(id, count);
        const auto is_true = [&](ir::NodeId value) {
            return ir::constant<bool>(program_, value) == true;
        };
        const auto is_false = [&](ir::NodeId value) {
            return ir::constant<bool>(program_, value) == false;
        };
        const auto begin = std::ranges::find_if_not(cases, is_false);
        const auto end = std::find_if_not(begin, cases.end(), is_true);
        if (begin == end || !std::all_of(end, cases.end(), is_false)) return std::nullopt;
        ++report_["expressions of a count made comparisons"];
        const double lower = builder_.properties(count).range->lower;
        const ir::NodeId first = integer(lower + static_cast<double>(begin - cases.begin())),
                         last = integer(lower + static_cast<double>(end - cases.begin()) - 1);
        const ir::NodeId known = rewritten(count);
        if (first == last) return builder_.apply(Operator::Equal, {known, first});
        std::vector<ir::NodeId> parts;
        if (begin != cases.begin())
            parts.push_back(builder_.apply(Operator::GreaterEqual, {known, first}));
        if (end != cases.end()) parts.push_back(builder_.apply(Operator::LessEqual, {known, last}));
        return ir::joined(builder_, Operator::And, parts);
    }

    bool is_tested_already(ir::NodeId id) const {
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        return select && select->evaluated == ir::Evaluated::MostlyFirst;
    }
    // Looks it up, or computes it for a counter that the table does not have. The counter chooses a
    // row, which is the same for all objects.
    ir::NodeId tested(ir::NodeId id, ir::NodeId counter, std::vector<ir::Value> values,
                      const std::vector<ir::VariableId>& variables) {
        const Range range = range_of(counter);
        const ir::NodeId least = integer(range.lower), most = integer(range.upper);
        std::vector<std::int64_t> shape{static_cast<std::int64_t>(range.upper - range.lower) + 1};
        for (ir::VariableId variable : variables) shape.push_back(program_[variable].size);
        ir::Buffer table{.name = name_ + "-by-" + name_of(counter),
                         .storage = ir::Storage::Constant,
                         .scalar = program_[id].type,
                         .shape = std::move(shape),
                         .values = by_case(std::move(values), range),
                         .span = span_};
        const ir::NodeId known = builder_.apply(
            Operator::Maximum, {builder_.apply(Operator::Minimum, {counter, most}), least});
        std::vector<ir::NodeId> indices{builder_.apply(Operator::Subtract, {known, least})};
        for (const ir::NodeId index : indices_of(variables)) indices.push_back(index);
        const ir::NodeId is_known =
            builder_.apply(Operator::And, {builder_.apply(Operator::GreaterEqual, {counter, least}),
                                           builder_.apply(Operator::LessEqual, {counter, most})});
        const ir::NodeId looked_up =
            builder_.load(builder_.tables().constant(std::move(table)), std::move(indices));
        return builder_.select(is_known, looked_up, id, ir::Evaluated::MostlyFirst);
    }
    // From rows of objects to rows of cases.
    static std::vector<ir::Value> by_case(std::vector<ir::Value> values, const Range& range) {
        const auto cases = static_cast<std::size_t>(range.upper - range.lower) + 1;
        const std::size_t objects = values.size() / cases;
        std::vector<ir::Value> transposed(values.size());
        for (std::size_t object = 0; object < objects; ++object)
            for (std::size_t k = 0; k < cases; ++k)
                transposed[k * objects + object] = values[object * cases + k];
        return transposed;
    }

    // The expression for each value of the count.
    std::vector<ir::NodeId> cases_of(ir::NodeId id, ir::NodeId count) {
        const Range range = range_of(count);
        std::vector<ir::NodeId> cases;
        for (double value = range.lower; value <= range.upper; ++value) {
            std::map<ir::NodeId, ir::NodeId> known = {{count, integer(value)}};
            cases.push_back(ir::replace_in(builder_, id, known));
        }
        return cases;
    }

    std::vector<ir::VariableId> variables_of(const std::vector<ir::NodeId>& cases) const {
        std::set<ir::VariableId> variables;
        for (ir::NodeId id : cases) {
            const auto& free = builder_.properties(id).free_variables;
            variables.insert(free.begin(), free.end());
        }
        return {variables.begin(), variables.end()};
    }

    // Row-major, the count innermost. None if it draws, reads more than constants, or faults.
    std::optional<std::vector<ir::Value>> values_of(
        const std::vector<ir::NodeId>& cases, const std::vector<ir::VariableId>& variables) const {
        const auto objects = static_cast<std::size_t>(objects_of(variables));
        std::vector<ir::Value> values(objects * cases.size());
        for (std::size_t k = 0; k < cases.size(); ++k) {
            if (!builder_.properties(cases[k]).uniform) return std::nullopt;
            const auto of_case = constant_values(evaluator_, program_, cases[k], variables);
            if (!of_case) return std::nullopt;
            for (std::size_t object = 0; object < objects; ++object)
                values[object * cases.size() + k] = (*of_case)[object];
        }
        return values;
    }

    // How many of its cases each object's count may reach.
    std::vector<std::size_t> reached_cases(ir::NodeId count, std::size_t cases,
                                           const std::vector<ir::VariableId>& variables) {
        std::vector<std::size_t> reached(static_cast<std::size_t>(objects_of(variables)), cases);
        const auto greatest =
            constant_values(evaluator_, program_, greatest_for(count, variables), variables);
        if (!greatest) return reached;
        const auto least = static_cast<std::int64_t>(builder_.properties(count).range->lower);
        for (std::size_t object = 0; object < reached.size(); ++object) {
            const std::int64_t last = std::get<std::int64_t>((*greatest)[object]) - least;
            reached[object] = static_cast<std::size_t>(
                std::clamp<std::int64_t>(last + 1, 1, static_cast<std::int64_t>(cases)));
        }
        return reached;
    }

    // An upper bound of a count, from constants and these variables.
    ir::NodeId greatest_for(ir::NodeId count, const std::vector<ir::VariableId>& variables) {
        const auto is_known = [&](ir::NodeId id) {
            const ir::Properties& properties = builder_.properties(id);
            return properties.uniform &&
                   std::ranges::includes(variables, properties.free_variables);
        };
        if (is_known(count)) return count;
        const Range range = *builder_.properties(count).range;
        const auto form = program_[count].form;
        if (const auto* apply = std::get_if<ir::Apply>(&form)) {
            const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
            if (apply->op == Operator::Add)
                return builder_.apply(Operator::Add,
                                      {greatest_for(a, variables), greatest_for(b, variables)});
            if (apply->op == Operator::Subtract && is_known(b))
                return builder_.apply(Operator::Subtract, {greatest_for(a, variables), b});
        }
        const auto* sum = std::get_if<ir::Reduce>(&form);
        if (sum && sum->op == Reduction::Sum && sum->bounds) {
            const auto length =
                builder_.apply(Operator::Subtract, {sum->bounds->end, sum->bounds->begin});
            const double term = std::max(0.0, builder_.properties(sum->body).range->upper);
            if (is_known(length))
                return builder_.apply(Operator::Multiply, {integer(term), length});
        }
        return integer(range.upper);
    }

    double objects_of(const std::vector<ir::VariableId>& variables) const {
        double objects = 1;
        for (ir::VariableId variable : variables)
            objects *= static_cast<double>(program_[variable].size);
        return objects;
    }

    // ---------------------------------------------------------------------------- tables

    struct Place {
        ir::BufferId table;
        std::vector<ir::NodeId> indices;  // except that of the count
    };

    Place table_of_kinds(const std::string& name, const Rows& rows, const RowKinds& kinds,
                         const std::vector<ir::VariableId>& variables) {
        if (kinds.examples.size() == 1) return {new_table(name, rows, kinds.examples, {}), {}};
        ir::Buffer of_objects{.name = name_ + "-kind",
                              .storage = ir::Storage::Constant,
                              .scalar = ir::Scalar::Int,
                              .values = kinds.of_objects,
                              .span = span_};
        ir::set_dimensions(program_, of_objects, variables);
        const ir::BufferId kind = builder_.tables().constant(std::move(of_objects));
        const auto count = static_cast<std::int64_t>(kinds.examples.size());
        return {new_table(name, rows, kinds.examples, {count}),
                {builder_.load(kind, indices_of(variables))}};
    }
    Place table_of_objects(const std::string& name, const Rows& rows,
                           const std::vector<ir::VariableId>& variables) {
        std::vector<std::size_t> all(rows.reached.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::vector<std::int64_t> shape;
        for (ir::VariableId variable : variables) shape.push_back(program_[variable].size);
        return {new_table(name, rows, all, std::move(shape)), indices_of(variables)};
    }

    // The rows of these objects. Elements that are not reached repeat the last one that is, so that
    // they do not widen the range of the table.
    ir::BufferId new_table(const std::string& name, const Rows& rows,
                           const std::vector<std::size_t>& objects,
                           std::vector<std::int64_t> shape) {
        shape.push_back(static_cast<std::int64_t>(rows.cases));
        std::vector<ir::Value> values;
        for (std::size_t object : objects) {
            const auto row = rows.reached_by(object);
            values.insert(values.end(), row.begin(), row.end());
            values.insert(values.end(), rows.cases - row.size(), row.back());
        }
        ir::Buffer table{.name = name,
                         .storage = ir::Storage::Constant,
                         .scalar = ir::scalar_of(values.front()),
                         .shape = std::move(shape),
                         .span = span_};
        table.values = std::move(values);
        return builder_.tables().constant(std::move(table));
    }

    std::vector<ir::NodeId> indices_of(const std::vector<ir::VariableId>& variables) {
        std::vector<ir::NodeId> indices;
        for (ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        return indices;
    }

    std::string name_of(ir::NodeId count) const {
        const auto* load = std::get_if<ir::Load>(&program_[count].form);
        return load ? program_[load->buffer].name : "count";
    }

    ir::NodeId least(ir::NodeId count) { return integer(builder_.properties(count).range->lower); }
    ir::NodeId integer(double value) { return builder_.constant(static_cast<std::int64_t>(value)); }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    std::map<ir::BufferId, Range> counters_;
    std::vector<Dependence> dependences_;  // by NodeId::index
    std::string name_;                     // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program tabulate_counts(ir::Program program, Report& report) {
    return CountTabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
