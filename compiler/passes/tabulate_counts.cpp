#include "passes/tabulate_counts.hpp"

#include "ir/rewrite.hpp"
#include "passes/constant_values.hpp"
#include "passes/new_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace rddlc::passes {
namespace {

constexpr double largest_range = 256;
// In operations (Facts::cost): what is worth loading an element of a table instead, and how many
// elements each of them is worth.
constexpr double worth_a_table = 8;
constexpr double elements_for_an_operation = 64;

// How an expression depends on what differs between environments.
struct Dependence {
    bool only_count = true;           // on nothing but `count`, beside constants
    std::optional<ir::NodeId> count;  // a small int; none: on nothing
    double cost = 0;                  // of what is computed beside the count
};

// Replaces the outermost expressions that depend on one count.
class Tabulation {
  public:
    Tabulation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_), evaluator_(program_) {
        for (std::uint32_t index = 0; index < program_.nodes.size(); ++index)
            dependences_.push_back(dependence_of({index}));
    }

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_))
            change(definition->body, program_[definition->target].name, definition->span);
        change(program_.reward, "reward");
        for (auto& condition : program_.preconditions) change(condition, "precondition");
        for (auto& condition : program_.invariants) change(condition, "invariant");
        for (auto& condition : program_.terminations) change(condition, "termination");
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // --------------------------------------------------------------------------- finding

    Dependence dependence_of(ir::NodeId id) const {
        const ir::Facts& facts = builder_.facts(id);
        if (facts.uniform) return {.count = {}, .cost = facts.cost};
        if (is_count(id)) return {.count = id};
        Dependence dependence{.count = {}, .cost = facts.cost};
        for (ir::NodeId operand : ir::operands_of(program_[id])) {
            const Dependence& other = dependences_[operand.index];
            const bool agrees =
                !other.count || !dependence.count || other.count == dependence.count;
            dependence.only_count &= other.only_count && agrees;
            if (other.count) dependence.count = other.count;
            dependence.cost -= builder_.facts(operand).cost - other.cost;
        }
        dependence.only_count &= dependence.count.has_value();
        return dependence;
    }

    bool is_count(ir::NodeId id) const {
        const ir::Facts& facts = builder_.facts(id);
        return program_[id].type == ir::Scalar::Int && !facts.may_fault && facts.range &&
               facts.range->upper - facts.range->lower < largest_range;
    }

    // What it depends on is bound outside of it.
    bool is_bound_inside(ir::NodeId count, ir::NodeId id) const {
        return !std::ranges::includes(builder_.facts(id).free_variables,
                                      builder_.facts(count).free_variables);
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
        const auto [only_count, count, cost] = dependences_[id.index];
        const bool is_candidate =
            only_count && count && cost >= worth_a_table && program_[id].type == ir::Scalar::Real;
        if (!is_candidate || is_bound_inside(*count, id)) return std::nullopt;
        const std::vector<ir::NodeId> cases = cases_of(id, *count);
        const std::vector<ir::VariableId> variables = variables_of(cases);
        const double elements = static_cast<double>(cases.size()) * objects_of(variables);
        if (elements > cost * elements_for_an_operation) return std::nullopt;
        auto values = values_of(cases, variables);
        if (!values) return std::nullopt;
        repeat_last_reached(*values, std::ssize(cases), *count, variables);

        ++report_["expressions of a count made tables"];
        const ir::BufferId table = new_table(*count, variables, std::ssize(cases), *values);
        std::vector<ir::NodeId> indices;
        for (ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        indices.push_back(builder_.apply(Operator::Subtract, {rewritten(*count), least(*count)}));
        return builder_.load(table, std::move(indices));
    }

    // The expression for each value of the count.
    std::vector<ir::NodeId> cases_of(ir::NodeId id, ir::NodeId count) {
        const ir::Range range = *builder_.facts(count).range;
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
            const auto& free = builder_.facts(id).free_variables;
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
            if (!builder_.facts(cases[k]).uniform) return std::nullopt;
            const auto of_case = constant_values(evaluator_, program_, cases[k], variables);
            if (!of_case) return std::nullopt;
            for (std::size_t object = 0; object < objects; ++object)
                values[object * cases.size() + k] = (*of_case)[object];
        }
        return values;
    }

    // Elements that an object's count does not reach become the last one that it does, so that they
    // do not widen the range of the table.
    void repeat_last_reached(std::vector<ir::Value>& values, std::int64_t cases, ir::NodeId count,
                             const std::vector<ir::VariableId>& variables) {
        const auto greatest =
            constant_values(evaluator_, program_, greatest_for(count, variables), variables);
        if (!greatest) return;
        const double least = builder_.facts(count).range->lower;
        for (std::size_t object = 0; object < greatest->size(); ++object) {
            const auto reached = std::get<std::int64_t>((*greatest)[object]);
            ir::Value* const row = &values[object * static_cast<std::size_t>(cases)];
            for (std::int64_t k = 1; k < cases; ++k)
                if (least + static_cast<double>(k) > static_cast<double>(reached))
                    row[k] = row[k - 1];
        }
    }

    // An upper bound of a count, from constants and these variables.
    ir::NodeId greatest_for(ir::NodeId count, const std::vector<ir::VariableId>& variables) {
        const auto is_known = [&](ir::NodeId id) {
            const ir::Facts& facts = builder_.facts(id);
            return facts.uniform && std::ranges::includes(variables, facts.free_variables);
        };
        if (is_known(count)) return count;
        const ir::Range range = *builder_.facts(count).range;
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
            const double term = std::max(0.0, builder_.facts(sum->body).range->upper);
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

    ir::BufferId new_table(ir::NodeId count, const std::vector<ir::VariableId>& variables,
                           std::int64_t cases, const std::vector<ir::Value>& values) {
        ir::Buffer table{.name = name_ + "-by-" + name_of(count),
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Real,
                         .values = values,
                         .span = span_};
        for (ir::VariableId variable : variables) table.shape.push_back(program_[variable].size);
        table.shape.push_back(cases);
        table.finite = std::ranges::all_of(
            values, [](const ir::Value& value) { return std::isfinite(std::get<double>(value)); });
        return constant_table(program_, std::move(table));
    }

    std::string name_of(ir::NodeId count) const {
        const auto* load = std::get_if<ir::Load>(&program_[count].form);
        return load ? program_[load->buffer].name : "count";
    }

    ir::NodeId least(ir::NodeId count) { return integer(builder_.facts(count).range->lower); }
    ir::NodeId integer(double value) { return builder_.constant(static_cast<std::int64_t>(value)); }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    std::vector<Dependence> dependences_;  // by NodeId::index
    std::string name_;                     // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program tabulate_counts(ir::Program program, Report& report) {
    return Tabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
