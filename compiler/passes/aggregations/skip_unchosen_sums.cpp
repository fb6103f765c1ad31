#include "passes/aggregations/skip_unchosen_sums.hpp"

#include "ir/action_bools.hpp"
#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/cost_model.hpp"
#include "ir/evaluator.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/sparsity_pattern.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) that pay for a test. It is fitted (docs/decisions.md).
constexpr double worth_a_test = 10;
// An action of many tables chooses from one of them now and then.
constexpr std::int64_t least_tables_per_choice = 4;
// The same of conditions, which one table decides, though it may choose often; and of what is left
// where it does not.
constexpr double worth_a_test_of_cases = 100;
constexpr double cheap = 2;
constexpr std::int64_t most_bools_of_cases = 64;
// Bools of tables whose words are tested.
constexpr std::int64_t most_bools = 512;

class Skipping {
  public:
    Skipping(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(program_),
          pattern_(builder_, evaluator_) {}

    ir::Program run() && {
        program_.reward.value = ir::replace_reductions_in(
            builder_, program_.reward.value, [&](ir::NodeId id) { return tested(id); });
        std::map<ir::NodeId, ir::NodeId> known;
        program_.reward.value = ir::replace_in(builder_, program_.reward.value, known,
                                               [&](ir::NodeId id) { return tested_cases(id); });
        for (ir::Definition& definition : program_.step)
            if (auto* store = ir::only_statement<ir::Store>(definition.body))
                store->value = tested_cases(store->value).value_or(store->value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    using Tables = std::set<ir::BufferId>;

    std::optional<ir::NodeId> tested(ir::NodeId id) {
        const ir::Node& node = program_[id];
        const ir::Properties& properties = builder_.properties(id);
        if (std::get<ir::Reduce>(node.form).op != Reduction::Sum || node.type != ir::Scalar::Real ||
            properties.may_fault || properties.random)
            return std::nullopt;
        const double cost = properties.cost;  // new nodes move the properties
        const Tables all = tables_of_action(id);
        if (all.empty() || !is_zero_without(all, id)) return std::nullopt;
        const Tables needed = needed_of(all, id);
        if (!are_often_unchosen(needed) || gain(needed, cost) < worth_a_test) return std::nullopt;
        ++report_["sums that are skipped where nothing is chosen"];
        return builder_.select(is_chosen(needed), id, builder_.constant(0.0), ir::Evaluated::Jump);
    }

    // Cases that one table of the action decides, and of which little is left where it chooses
    // nothing. They stand where every step computes them.
    std::optional<ir::NodeId> tested_cases(ir::NodeId id) {
        const ir::Node& node = program_[id];
        if (std::holds_alternative<ir::Reduce>(node.form)) return id;
        const auto* select = std::get_if<ir::Select>(&node.form);
        if (!select) return std::nullopt;
        if (select->evaluated == ir::Evaluated::Jump) return id;
        const ir::Properties& properties = builder_.properties(id);
        if (properties.may_fault || properties.random) return id;
        const double cost = cost_of_conditions(id);
        if (cost < worth_a_test_of_cases) return id;
        for (const ir::BufferId table : tables_of_action(id)) {
            if (program_[table].count() > most_bools_of_cases) continue;
            const ir::NodeId rest = without({table}, id);
            if (builder_.properties(rest).cost > cheap || gain({table}, cost) < worth_a_test)
                continue;
            ++report_["cases that are skipped where nothing is chosen"];
            return builder_.select(is_chosen({table}), id, rest, ir::Evaluated::Jump);
        }
        return id;
    }

    // Operations where none of the cases is met, apart from those of what is left then.
    double cost_of_conditions(ir::NodeId id) const {
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        if (!select) return 0;
        return builder_.properties(select->condition).cost + cost_of_conditions(select->else_value);
    }

    // The share of all actions, in which one of the tables is chosen, if each element of the action
    // is chosen as often as another.
    double share_of(const Tables& tables) const {
        double all = 0, chosen = 0;
        for (std::uint32_t k = 0; k < program_.buffers.size(); ++k) {
            const ir::Buffer& buffer = program_.buffers[k];
            if (buffer.storage != ir::Storage::Action) continue;
            const auto count = static_cast<double>(buffer.count());
            all += count;
            if (tables.contains(ir::BufferId{k})) chosen += count;
        }
        return chosen / all;
    }
    // The operations that a test saves, on average. The processor foresees the choice that is made
    // more often.
    double gain(const Tables& tables, double cost) const {
        const double chosen = share_of(tables);
        return (1 - chosen) * (cost - 2 * chosen * ir::mispredicted_jump_cost);
    }

    Tables tables_of_action(ir::NodeId id) const {
        Tables tables;
        ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto table = ir::buffer_read_by(program_[each]);
            if (table && ir::is_action_bools(program_[*table])) tables.insert(*table);
            return false;
        });
        return tables;
    }
    // Leaves out tables that decide nothing where the others choose nothing.
    Tables needed_of(Tables tables, ir::NodeId id) {
        for (const ir::BufferId table : Tables(tables)) {
            Tables others = tables;
            others.erase(table);
            if (is_zero_without(others, id)) tables = std::move(others);
        }
        return tables;
    }
    // Whether the sum is 0.0 where all bools of the tables are false.
    bool is_zero_without(const Tables& tables, ir::NodeId id) {
        const auto where_not = pattern_.of(term_of(without(tables, id)), 0.0);
        return where_not && where_not->tuples.empty();
    }
    // The value with false for all bools of the tables.
    ir::NodeId without(const Tables& tables, ir::NodeId id) {
        std::map<ir::NodeId, ir::NodeId> known;
        return ir::replace_in(builder_, id, known,
                              [&](ir::NodeId each) -> std::optional<ir::NodeId> {
                                  const ir::Node& node = program_[each];
                                  const auto table = ir::buffer_read_by(node);
                                  if (!table || !tables.contains(*table)) return std::nullopt;
                                  if (node.type == ir::Scalar::Bool)
                                      return builder_.constant(false);
                                  return builder_.constant(std::int64_t{0});
                              });
    }
    // Nested sums have the term of the innermost one.
    ir::NodeId term_of(ir::NodeId id) const {
        const auto* sum = std::get_if<ir::Reduce>(&program_[id].form);
        return sum && sum->op == Reduction::Sum ? term_of(sum->body) : id;
    }
    bool are_often_unchosen(const Tables& tables) const {
        std::int64_t bools = 0;
        for (const ir::BufferId table : tables) bools += program_[table].count();
        const auto all = std::ranges::count_if(program_.buffers, [](const ir::Buffer& buffer) {
            return buffer.storage == ir::Storage::Action;
        });
        return bools <= most_bools && std::ssize(tables) * least_tables_per_choice <= all;
    }
    ir::NodeId is_chosen(const Tables& tables) {
        std::vector<ir::NodeId> tests;
        for (const ir::BufferId table : tables) {
            for (std::int64_t first = 0; first < program_[table].count(); first += 64) {
                const ir::NodeId bits = builder_.bits(table, first);
                const ir::NodeId none = builder_.constant(std::int64_t{0});
                tests.push_back(builder_.apply(Operator::NotEqual, {bits, none}));
            }
        }
        return ir::joined(builder_, Operator::Or, tests);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    SparsityPattern pattern_;
};

}  // namespace

ir::Program skip_unchosen_sums(ir::Program program, Report& report) {
    return Skipping(std::move(program), report).run();
}

}  // namespace rddlc::passes
