#include "passes/aggregations/tabulate_comparisons.hpp"

#include "ir/fill_table.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/count_bits.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Fills the tables of one definition of the step.
class ComparisonTables {
  public:
    explicit ComparisonTables(ir::Program program)
        : program_(std::move(program)), builder_(program_) {}

    void change(std::size_t definition) {
        span_ = program_.step[definition].span;
        ir::Block body = std::move(program_.step[definition].body);
        ir::Block result;
        std::map<ir::NodeId, ir::NodeId> done;
        ir::change_roots(body, [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, done,
                                  [&](ir::NodeId id) { return with_tables_in_rows(id, result); });
        });
        std::ranges::move(body, std::back_inserter(result));
        program_.step[definition].body = std::move(result);
    }

    const std::set<ir::BufferId>& tables() const { return made_; }
    ir::Program program() && { return ir::collect_garbage(std::move(program_)); }

  private:
    // The outermost aggregations, of bools in rows that loops choose: so several rows read an
    // element.
    std::optional<ir::NodeId> with_tables_in_rows(ir::NodeId id, ir::Block& before) {
        const auto* reduce = std::get_if<ir::Reduce>(&program_[id].form);
        if (!reduce) return std::nullopt;
        const bool is_row =
            is_quantifier(reduce->op) && !builder_.properties(id).free_variables.empty();
        return is_row ? with_tables(id, before) : id;
    }

    ir::NodeId with_tables(ir::NodeId id, ir::Block& before) {
        std::map<ir::NodeId, ir::NodeId> done;
        return ir::replace_in(builder_, id, done,
                              [&](ir::NodeId each) { return element(each, before); });
    }

    // The element of a table of bools for a comparison of an int, whose place constants choose.
    std::optional<ir::NodeId> element(ir::NodeId id, ir::Block& before) {
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (!apply || apply->operands.size() != 2 || program_[id].type != ir::Scalar::Bool)
            return std::nullopt;
        const ir::Apply comparison = *apply;
        const auto* load = std::get_if<ir::Load>(&program_[comparison.operands.front()].form);
        const auto* limit = std::get_if<ir::Constant>(&program_[comparison.operands.back()].form);
        if (!load || !limit || !is_int_of_state(*load)) return std::nullopt;
        const ir::Load number = *load;
        const auto key =
            std::tuple(number.buffer, comparison.op, std::get<std::int64_t>(limit->value));
        const auto known = known_.find(key);
        const ir::BufferId table =
            known != known_.end() ? known->second : filled(number.buffer, comparison, before);
        known_.emplace(key, table);
        return builder_.load(table, number.indices);
    }
    bool is_int_of_state(const ir::Load& load) const {
        const ir::Buffer& buffer = program_[load.buffer];
        return buffer.storage == ir::Storage::State && buffer.scalar == ir::Scalar::Int &&
               !load.indices.empty() && std::ranges::all_of(load.indices, [&](ir::NodeId index) {
                   return builder_.properties(index).uniform &&
                          !builder_.properties(index).may_fault;
               });
    }

    ir::BufferId filled(ir::BufferId numbers, const ir::Apply& comparison, ir::Block& before) {
        const std::vector<ir::VariableId> variables = variables_of(numbers);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        const ir::NodeId value = builder_.apply(
            comparison.op, {builder_.load(numbers, indices), comparison.operands.back()});
        const ir::BufferId table = builder_.tables().scratch(
            program_[numbers].name + "-bools", ir::Scalar::Bool, {}, variables, span_);
        ir::fill_table(builder_, before, table, variables, value);
        made_.insert(table);
        return table;
    }
    // Loop indices over the objects of a table.
    std::vector<ir::VariableId> variables_of(ir::BufferId table) {
        std::vector<ir::VariableId> variables;
        for (const std::uint32_t type : std::vector(program_[table].types)) {
            variables.push_back({static_cast<std::uint32_t>(program_.variables.size())});
            const ir::ObjectType& objects = program_.types[type];
            program_.variables.push_back({objects.name, type, std::ssize(objects.objects)});
        }
        return variables;
    }

    ir::Program program_;
    ir::Builder builder_;
    Span span_;
    std::map<std::tuple<ir::BufferId, Operator, std::int64_t>, ir::BufferId> known_;
    std::set<ir::BufferId> made_;
};

// Whether only words of these tables are read.
bool are_read_in_words(const ir::Program& program, const std::set<ir::BufferId>& tables) {
    return std::ranges::none_of(program.nodes, [&](const ir::Node& node) {
        const auto buffer = ir::buffer_read_by(node);
        return buffer && tables.contains(*buffer) && !std::holds_alternative<ir::Bits>(node.form);
    });
}

}  // namespace

ir::Program tabulate_comparisons(ir::Program program, Report& report) {
    for (std::size_t k = 0; k < program.step.size(); ++k) {
        ComparisonTables changing(program);
        changing.change(k);
        const std::set<ir::BufferId> tables = changing.tables();
        if (tables.empty()) continue;
        Report found;
        ir::Program changed = count_bits(std::move(changing).program(), found);
        if (!are_read_in_words(changed, tables)) continue;
        program = std::move(changed);
        report["comparisons that become tables"] += std::ssize(tables);
        for (const auto& [what, count] : found) report[what] += count;
    }
    return program;
}

}  // namespace rddlc::passes
