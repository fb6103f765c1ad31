#include "passes/constants/tabulate_constants.hpp"

#include "ir/evaluation_budget.hpp"
#include "ir/new_tables.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace rddlc::passes {
namespace {

// An entry of a larger table must save as many operations as it has fellows, divided by this.
constexpr double entries_for_an_operation = 32;

// Finds the outermost expressions that are worth a table.
class ConstantTabulation {
  public:
    explicit ConstantTabulation(ir::Program& program)
        : program_(program),
          properties_(ir::all_properties(program)),
          seen_(program.nodes.size()),
          evaluator_(std::as_const(program)) {}

    // A table for the node that it replaces; the node's free variables are its dimensions.
    struct Table {
        std::vector<ir::VariableId> variables;
        ir::Buffer buffer;
    };

    std::map<ir::NodeId, Table> run() && {
        for (const ir::Definition* definition : ir::definitions_of(std::as_const(program_)))
            visit(definition->body, program_[definition->target].name, definition->span);
        for (const auto& [name, computation] : ir::computations_of(std::as_const(program_)))
            visit(*computation, name);
        return std::move(tables_);
    }

  private:
    void visit(const ir::Block& block, const std::string& name, Span span) {
        for (ir::NodeId root : ir::roots_of(block)) visit(root, name, span);
    }
    void visit(const ir::Computation& computation, const std::string& name) {
        for (ir::NodeId root : ir::roots_of(computation)) visit(root, name, computation.span);
    }

    void visit(ir::NodeId id, const std::string& name, Span span) {
        if (seen_[id.index]) return;
        seen_[id.index] = true;
        if (is_worth_it(id) && tabulate(id, name, span)) return;
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (reduce) return visit(reduce->body, name, span);  // its bounds stay next to each other
        for (ir::NodeId operand : ir::operands_of(program_[id])) visit(operand, name, span);
    }

    bool is_worth_it(ir::NodeId id) const {
        const ir::Properties& properties = properties_[id.index];
        if (!properties.uniform || properties.free_variables.empty() || properties.cost < 2)
            return false;
        if (is_element(id)) return false;
        const double entries = entries_over(properties.free_variables);
        if (!ir::EvaluationBudget::allows(entries * properties.cost)) return false;
        const std::int64_t largest = largest_table_in(id);
        return largest > 0 && entries <= std::max(static_cast<double>(largest),
                                                  (properties.cost - 2) * entries_for_an_operation);
    }

    // It is an element of a table already: the indices are no more than arithmetic.
    bool is_element(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && std::ranges::none_of(load->indices, [&](ir::NodeId index) {
                   return largest_table_in(index) > 0;
               });
    }

    double entries_over(const std::vector<ir::VariableId>& variables) const {
        double entries = 1;
        for (ir::VariableId variable : variables)
            entries *= static_cast<double>(program_[variable].size);
        return entries;
    }

    // The size in entries; 0 if the expression reads no table.
    std::int64_t largest_table_in(ir::NodeId id) const {
        std::int64_t largest = 0;
        if (const auto* load = std::get_if<ir::Load>(&program_[id].form))
            largest = program_[load->buffer].count();
        for (ir::NodeId operand : ir::operands_of(program_[id]))
            largest = std::max(largest, largest_table_in(operand));
        return largest;
    }

    bool tabulate(ir::NodeId id, const std::string& name, Span span) {
        std::vector<ir::VariableId> variables;
        collect_variables(id, variables);
        auto values = constant_values(evaluator_, program_, id, variables);
        if (!values) return false;
        ir::Buffer buffer{.name = name + "-table",
                          .storage = ir::Storage::Constant,
                          .scalar = program_[id].type,
                          .values = *std::move(values),
                          .span = span};
        set_dimensions(program_, buffer, variables);
        tables_.emplace(id, Table{std::move(variables), std::move(buffer)});
        return true;
    }

    // The free variables, in the order in which the text names them.
    void collect_variables(ir::NodeId id, std::vector<ir::VariableId>& variables) const {
        const auto* index = std::get_if<ir::Index>(&program_[id].form);
        if (index && std::ranges::find(variables, index->variable) == variables.end())
            variables.push_back(index->variable);
        for (ir::NodeId operand : ir::operands_of(program_[id]))
            collect_variables(operand, variables);
        if (const auto bound = ir::bound_variable(program_[id])) std::erase(variables, *bound);
    }

    ir::Program& program_;
    std::vector<ir::Properties> properties_;
    std::vector<bool> seen_;
    ir::Evaluator evaluator_;
    std::map<ir::NodeId, Table> tables_;
};

using Tables = std::map<ir::NodeId, ConstantTabulation::Table>;

ir::Program with_tables(ir::Program program, const Tables& tables) {
    std::map<ir::NodeId, ir::BufferId> buffers;
    ir::NewTables new_tables(program);
    for (const auto& [id, table] : tables)
        if (!table.buffer.values.is_uniform()) buffers[id] = new_tables.constant(table.buffer);
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId id, const ir::Node&) -> std::optional<ir::NodeId> {
            const auto table = tables.find(id);
            if (table == tables.end()) return std::nullopt;
            const auto& [variables, buffer] = table->second;
            if (buffer.values.is_uniform()) return builder.constant(buffer.values[0]);
            std::vector<ir::NodeId> indices;
            for (ir::VariableId variable : variables) indices.push_back(builder.index(variable));
            return builder.load(buffers.at(id), std::move(indices));
        });
}

}  // namespace

// Around constants there may be more to compute, so it goes on as long as it finds something.
ir::Program tabulate_constants(ir::Program program, Report& report) {
    for (;;) {
        const Tables tables = ConstantTabulation(program).run();
        if (tables.empty()) return program;
        report["tables computed"] += std::ssize(tables);
        program = with_tables(std::move(program), tables);
    }
}

}  // namespace rddlc::passes
