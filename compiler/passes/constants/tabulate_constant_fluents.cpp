#include "passes/constants/tabulate_constant_fluents.hpp"

#include "ir/evaluation_budget.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/plain_definition.hpp"
#include "passes/analyses/readers.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rddlc::passes {
namespace {

// Larger tables are left to the simulator: they make the emitted text long.
constexpr std::int64_t most_entries_of_fluent = 100'000;

// One after the other: what reads a constant fluent may be constant, too.
class FluentTabulation {
  public:
    FluentTabulation(ir::Program& program, Report& report)
        : program_(program),
          report_(report),
          builder_(program),
          evaluator_(program),
          readers_(readers_of_step(program)) {}

    // The tables, by the interm-fluents that they replace.
    std::map<ir::BufferId, ir::BufferId> run() && {
        for (const ir::Definition& definition : program_.step) {
            auto values = known_values(definition);
            if (values) make_table(definition.target, *std::move(values));
        }
        return std::move(tables_);
    }

  private:
    // Of a definition that fills an interm-fluent with what the instance fixes.
    std::optional<std::vector<ir::Value>> known_values(const ir::Definition& definition) {
        const ir::Buffer& buffer = program_[definition.target];
        if (buffer.storage != ir::Storage::Scratch || buffer.count() > most_entries_of_fluent)
            return std::nullopt;
        if (readers_[definition.target.index].places == 0) return std::nullopt;
        const auto plain = plain_definition(program_, definition);
        if (!plain) return std::nullopt;
        const ir::NodeId value = with_tables(plain->value);
        const ir::Properties& properties = builder_.properties(value);
        const double cost = properties.cost * static_cast<double>(buffer.count());
        if (!properties.uniform || !budget_.pay(cost)) return std::nullopt;

        std::vector<ir::VariableId> variables;
        for (const auto& variable : plain->variables) {
            if (variable) variables.push_back(*variable);
        }
        return constant_values(evaluator_, program_, value, variables);
    }

    // A fluent is read behind its definition only, so what is known once stays so.
    ir::NodeId with_tables(ir::NodeId id) {
        if (tables_.empty()) return id;
        return ir::replace_in(builder_, id, known_, [&](ir::NodeId each) {
            const auto* load = std::get_if<ir::Load>(&program_[each].form);
            const auto table = load ? tables_.find(load->buffer) : tables_.end();
            if (table == tables_.end()) return std::optional<ir::NodeId>();
            std::vector<ir::NodeId> indices = load->indices;
            for (ir::NodeId& index : indices) index = with_tables(index);
            return std::optional(builder_.load(table->second, std::move(indices)));
        });
    }

    void make_table(ir::BufferId old, std::vector<ir::Value> values) {
        const ir::BufferId table{static_cast<std::uint32_t>(program_.buffers.size())};
        ir::Buffer buffer = program_[old];
        buffer.storage = ir::Storage::Constant;
        buffer.values = std::move(values);
        program_.buffers.push_back(std::move(buffer));
        evaluator_.know_added_tables();
        tables_[old] = table;
        ++report_["interm-fluents made constant"];
    }

    ir::Program& program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    std::vector<Readers> readers_;
    std::map<ir::BufferId, ir::BufferId> tables_;
    std::map<ir::NodeId, ir::NodeId> known_;  // expressions with tables in place of fluents
    ir::EvaluationBudget budget_;
};

}  // namespace

ir::Program tabulate_constant_fluents(ir::Program program, Report& report) {
    const auto tables = FluentTabulation(program, report).run();
    if (tables.empty()) return program;
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* load = std::get_if<ir::Load>(&node.form);
            const auto table = load ? tables.find(load->buffer) : tables.end();
            if (table == tables.end()) return std::nullopt;
            return builder.load(table->second, load->indices);
        });
}

}  // namespace rddlc::passes
