#include "passes/lanes/separate_draws.hpp"

#include "ir/fill_table.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// More draws of a loop stay in it: each takes two loops more.
constexpr std::size_t most_draws = 2;
// Operations (Properties::cost) that are worth writing bools to tables and reading them again.
constexpr double worth_two_loops = 8;
// The part of what is left that the conditions of draws may cost.
constexpr double most_computed_again = 0.25;

class DrawSeparation {
  public:
    DrawSeparation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            ir::Block result;
            for (ir::Statement& statement : definition.body) {
                auto* const loop = std::get_if<ir::Loop>(&statement.form);
                if (loop && loop->several_at_once) separate(*loop, result);
                result.push_back(std::move(statement));
            }
            definition.body = std::move(result);
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void separate(ir::Loop& loop, ir::Block& before) {
        const ir::Nest nest = ir::nest_of(loop);
        auto* const store = ir::only_statement<ir::Store>(ir::innermost_body(loop));
        if (!store || !are_many(program_, nest) || is_of_bools(program_, store->value, nest))
            return;
        draws_.clear();
        collect_draws(store->value, builder_.constant(true));
        if (draws_.empty() || draws_.size() > most_draws || draws_.contains(store->value)) return;
        const auto is_draw = [&](ir::NodeId id) {
            return draws_.contains(id);
        };
        double rest = builder_.properties(store->value).cost, conditions = 0;
        for (const auto& [draw, condition] : draws_) {
            rest -= builder_.properties(draw).cost;
            conditions += builder_.properties(condition).cost;
        }
        if (rest < worth_two_loops || conditions > rest * most_computed_again ||
            !is_of_bools(program_, store->value, nest, is_draw))
            return;

        std::map<ir::NodeId, ir::NodeId> known;
        for (const auto& [draw, condition] : draws_) {
            ir::NodeId is_drawn = condition;
            if (!builder_.properties(condition).uniform)
                is_drawn = table_of(condition, "draws", nest.variables, true, before);
            const ir::NodeId drawn = builder_.select(is_drawn, draw, builder_.constant(false));
            known[draw] = table_of(drawn, "draw", nest.variables, false, before);
        }
        store->value = ir::replace_in(builder_, store->value, known);
        loop.as_words = true;
        ++report_["loops whose draws are made before"];
    }

    // Finds the draws, and for each the condition under which it is made.
    void collect_draws(ir::NodeId id, ir::NodeId condition) {
        const ir::Node node = program_[id];
        if (std::holds_alternative<ir::Sample>(node.form)) {
            const auto [known, is_new] = draws_.try_emplace(id, condition);
            if (!is_new) known->second = builder_.apply(Operator::Or, {known->second, condition});
            return;
        }
        if (const auto* select = std::get_if<ir::Select>(&node.form)) {
            collect_draws(select->condition, condition);
            collect_draws(select->then_value, both(condition, select->condition));
            collect_draws(select->else_value,
                          both(condition, builder_.apply(Operator::Not, {select->condition})));
            return;
        }
        for (const ir::NodeId operand : ir::operands_of(node)) collect_draws(operand, condition);
    }

    ir::NodeId both(ir::NodeId a, ir::NodeId b) { return builder_.apply(Operator::And, {a, b}); }

    // An element of a new table with the values of a node, which `before` fills.
    ir::NodeId table_of(ir::NodeId id, const std::string& what,
                        const std::vector<ir::VariableId>& variables, bool as_words,
                        ir::Block& before) {
        const ir::BufferId table =
            builder_.tables().scratch(name_ + "-" + what, ir::Scalar::Bool, {}, variables, span_);
        const ir::NodeId element = ir::fill_table(builder_, before, table, variables, id);
        auto& loop = std::get<ir::Loop>(before.back().form);
        loop.several_at_once = true;
        loop.as_words = as_words;
        return element;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> draws_;  // of the loop at hand: when each is made
};

}  // namespace

ir::Program separate_draws(ir::Program program, Report& report) {
    return DrawSeparation(std::move(program), report).run();
}

}  // namespace rddlc::passes
