#include "passes/lanes/quantify_together.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// How a node uses all bools of a table.
struct Quantifier {
    ir::NodeId node;
    Operator op;  // Or: one of them at least is true; And: all are
    bool is_negated = false;
};

// Where a program uses a table.
struct Uses {
    std::vector<ir::NodeId> reads, readers;  // nodes that read it, and those that they are part of
    int writers = 0;
    bool is_whole_value = false;  // of a statement, which a read is, or of a call
};

std::map<ir::BufferId, Uses> uses_of_tables(const ir::Program& program) {
    std::map<ir::BufferId, Uses> tables;
    const std::vector<bool> reachable = ir::reachable_nodes(program);
    for (std::uint32_t i = 0; i < reachable.size(); ++i) {
        const ir::NodeId id{i};
        if (!reachable[i]) continue;
        if (const auto table = ir::buffer_read_by(program[id])) tables[*table].reads.push_back(id);
        for (const ir::NodeId operand : ir::operands_of(program[id]))
            if (const auto table = ir::buffer_read_by(program[operand]))
                tables[*table].readers.push_back(id);
    }
    for (const ir::NodeId root : ir::roots_of(program))
        if (const auto table = ir::buffer_read_by(program[root]))
            tables[*table].is_whole_value = true;
    for (const ir::Block* block : ir::blocks_of(program))
        for (const ir::Statement& statement : *block) {
            const ir::Block alone = {statement};
            for (const ir::BufferId table : ir::written_buffers(alone)) ++tables[table].writers;
            ir::for_each_statement<ir::Call>(alone, [&](const ir::Call& call) {
                for (const ir::TableView& input : call.inputs)
                    tables[input.buffer].is_whole_value = true;
            });
        }
    return tables;
}

class Quantification {
  public:
    Quantification(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          uses_(uses_of_tables(program_)) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step)
            quantify(definition.body, definition.span, &definition.target);
        quantify(program_.reward.body, program_.reward.span, nullptr);
        ir::change_roots(
            program_, [&](ir::NodeId& root) { root = ir::replace_in(builder_, root, replaced_); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void quantify(ir::Block& block, Span span, ir::BufferId* target) {
        for (std::size_t k = 0; k < block.size(); ++k) {
            auto* const loop = std::get_if<ir::Loop>(&block[k].form);
            ir::Store* const store = loop ? only_bools(*loop) : nullptr;
            if (!store) continue;
            const auto quantifier = quantifier_of(store->target);
            if (!quantifier) continue;
            const ir::BufferId table = store->target;
            const bool is_or = quantifier->op == Operator::Or;
            const ir::BufferId found =
                builder_.tables().scratch(program_[table].name + (is_or ? "-exists" : "-forall"),
                                          ir::Scalar::Bool, {}, {}, span);
            const ir::NodeId so_far = builder_.load(found, {});
            *store = {found, {}, builder_.apply(quantifier->op, {so_far, store->value})};
            if (target && *target == table) *target = found;
            block.insert(block.begin() + static_cast<std::ptrdiff_t>(k++),
                         {ir::Store{found, {}, builder_.constant(!is_or)}});
            replaced_[quantifier->node] =
                quantifier->is_negated ? builder_.apply(Operator::Not, {so_far}) : so_far;
            ++report_["quantifiers over several objects at once"];
        }
    }

    // The store of a loop that gives the bools of its objects, and nothing else.
    ir::Store* only_bools(ir::Loop& loop) {
        if (!loop.several_at_once || loop.as_words || loop.affected || loop.chosen) return nullptr;
        ir::Block& body = ir::innermost_body(loop);
        auto* const store = std::get_if<ir::Store>(&body.back().form);
        const auto is_let = [](const ir::Statement& statement) {
            return std::holds_alternative<ir::Let>(statement.form);
        };
        if (!store || !std::all_of(body.begin(), body.end() - 1, is_let)) return nullptr;
        const ir::Buffer& table = program_[store->target];
        const ir::Nest nest = ir::nest_of(loop);
        const bool may_be = table.storage == ir::Storage::Scratch &&
                            table.scalar == ir::Scalar::Bool &&
                            ir::are_variables_of(program_, store->indices, nest) &&
                            table.count() == ir::combinations(program_, nest.variables) &&
                            ir::is_droppable(builder_.properties(store->value)) &&
                            !std::holds_alternative<ir::Constant>(program_[store->value].form);
        return may_be ? store : nullptr;
    }

    // The only use of a table that one loop fills. Visits and other statements fill tables also.
    std::optional<Quantifier> quantifier_of(ir::BufferId table) const {
        const auto found = uses_.find(table);
        if (found == uses_.end()) return std::nullopt;
        const Uses& uses = found->second;
        if (uses.reads.size() != 1 || uses.readers.size() != 1 || uses.writers != 1 ||
            uses.is_whole_value)
            return std::nullopt;
        return quantifier(uses.readers.front(), uses.reads.front());
    }

    std::optional<Quantifier> quantifier(ir::NodeId use, ir::NodeId read) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[use].form);
        const auto* bits = std::get_if<ir::Bits>(&program_[read].form);
        if (apply && bits) return of_bits(use, *apply, *bits);
        const auto* reduce = std::get_if<ir::Reduce>(&program_[use].form);
        const auto* load = std::get_if<ir::Load>(&program_[read].form);
        const bool is_over_all = reduce && load && !reduce->bounds && reduce->body == read &&
                                 load->indices.size() == 1 &&
                                 program_[load->indices.front()].form ==
                                     ir::Node{ir::Scalar::Int, ir::Index{reduce->variable}}.form;
        if (!is_over_all) return std::nullopt;
        if (reduce->op == Reduction::Exists) return Quantifier{use, Operator::Or};
        if (reduce->op == Reduction::ForAll) return Quantifier{use, Operator::And};
        return std::nullopt;
    }

    // bits(table, 0) != 0, or == 0.
    std::optional<Quantifier> of_bits(ir::NodeId use, const ir::Apply& apply,
                                      const ir::Bits& bits) const {
        const bool is_all =
            bits.first == 0 && bits.indices.empty() && program_[bits.buffer].count() <= 64;
        const bool is_compared = apply.op == Operator::NotEqual || apply.op == Operator::Equal;
        if (!is_all || !is_compared ||
            ir::constant<std::int64_t>(program_, apply.operands.back()) != 0)
            return std::nullopt;
        return Quantifier{use, Operator::Or, apply.op == Operator::Equal};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::BufferId, Uses> uses_;          // before the pass
    std::map<ir::NodeId, ir::NodeId> replaced_;  // quantifiers
};

}  // namespace

ir::Program quantify_together(ir::Program program, Report& report) {
    return Quantification(std::move(program), report).run();
}

}  // namespace rddlc::passes
