#include "passes/arithmetic/find_ranges.hpp"

#include "ir/analysis.hpp"
#include "ir/evaluation_budget.hpp"
#include "passes/analyses/constant_values.hpp"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace rddlc::passes {
namespace {

double evaluations(const ir::Program& program, const ir::Properties& properties) {
    double count = 1;
    for (const ir::VariableId variable : properties.free_variables)
        count *= static_cast<double>(program[variable].size);
    return count;
}

// The properties of nodes, in the order in which the step computes the tables that they read.
class Ranges {
  public:
    explicit Ranges(ir::Program& program)
        : program_(program),
          evaluator_(program),
          properties_(program.nodes.size()),
          is_known_(program.nodes.size(), false) {}

    // The tables that the definition fills get the ranges of what is stored.
    void enter(const ir::Definition& definition) {
        for (const ir::NodeId root : ir::roots_of(definition.body)) find_below(root);
        std::map<ir::BufferId, std::optional<Range>> stored;
        ir::for_each_statement<ir::Store>(definition.body, [&](const ir::Store& store) {
            const auto& range = properties_[store.value.index].range;
            const auto [entry, is_first] = stored.try_emplace(store.target, range);
            if (!is_first) entry->second = joined(entry->second, range);
        });
        ir::for_each_statement<ir::Call>(definition.body, [&](const ir::Call& call) {
            stored[call.output.buffer] = std::nullopt;
        });
        for (const auto& [id, range] : stored) {
            ir::Buffer& buffer = program_.buffers[id.index];
            if (buffer.scalar == ir::Scalar::Bool || !buffer.is_computed_in_step() || !range)
                continue;
            if (!buffer.range || !is_finite(*buffer.range)) newly_finite_ += is_finite(*range);
            buffer.range = range;
        }
    }

    std::int64_t newly_finite() const { return newly_finite_; }

  private:
    static std::optional<Range> joined(const std::optional<Range>& a,
                                       const std::optional<Range>& b) {
        return a && b ? std::optional(join(*a, *b)) : std::nullopt;
    }

    // Operands first: their numbers are lower.
    void find_below(ir::NodeId root) {
        std::set<ir::NodeId> below = {root};
        for (auto id = below.rbegin(); id != below.rend(); ++id) {
            for (const ir::NodeId operand : ir::operands_of(program_[*id]))
                if (!is_known_[operand.index]) below.insert(operand);
        }
        for (const ir::NodeId id : below)
            if (!is_known_[id.index]) find(id);
    }

    void find(ir::NodeId id) {
        ir::Properties& properties = properties_[id.index] =
            ir::properties_of(program_, program_[id], properties_, tables_);
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (apply && apply->op == Operator::Divide && !properties.range)
            properties.range = range_by_values(apply->operands.front(), apply->operands.back());
        is_known_[id.index] = true;
    }

    // A quotient by what only the instance decides: by all values of the divisor.
    std::optional<Range> range_by_values(ir::NodeId dividend, ir::NodeId divisor) {
        const ir::Properties& properties = properties_[divisor.index];
        const double cost = properties.cost * evaluations(program_, properties);
        if (!properties.uniform || !budget_.pay(cost)) return std::nullopt;
        const auto values =
            constant_values(evaluator_, program_, divisor, properties.free_variables);
        if (!values || values->empty()) return std::nullopt;
        const auto quotient = [&](const ir::Value& value) {
            const double number = std::get<double>(value);
            const std::optional<Range> by{Range{number, number}};
            return std::isnan(number) ? std::nullopt
                                      : range_of(Operator::Divide,
                                                 std::array{properties_[dividend.index].range, by});
        };
        auto range = quotient(values->front());
        for (const ir::Value& value : *values) range = joined(range, quotient(value));
        return range;
    }

    ir::Program& program_;
    ir::Evaluator evaluator_;
    std::vector<ir::Properties> properties_;  // by NodeId
    std::vector<bool> is_known_;              // by NodeId
    ir::TableProperties tables_;
    ir::EvaluationBudget budget_;
    std::int64_t newly_finite_ = 0;
};

}  // namespace

ir::Program find_ranges(ir::Program program, Report& report) {
    Ranges ranges(program);
    for (const ir::Definition& definition : program.step) ranges.enter(definition);
    report["tables found finite"] += ranges.newly_finite();
    return program;
}

}  // namespace rddlc::passes
