#include "passes/lanes/separate_counts.hpp"

#include "ir/fill_table.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/lanes/read_places.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// A loop over more objects that only counts has enough of them for its registers.
constexpr std::int64_t most_counted = 16 * bools_in_a_word;

class CountSeparation {
  public:
    CountSeparation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            ir::Block result;
            for (ir::Statement& statement : definition.body) {
                if (auto* store = std::get_if<ir::Store>(&statement.form))
                    store->value = with_counts(store->value, result);
                result.push_back(std::move(statement));
            }
            definition.body = std::move(result);
        }
        name_ = "reward";
        span_ = program_.reward.span;
        program_.reward.value = with_counts(program_.reward.value, program_.reward.body);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // A value outside of loops.
    ir::NodeId with_counts(ir::NodeId value, ir::Block& before) {
        return ir::replace_reductions_in(builder_, value,
                                         [&](ir::NodeId id) { return counted(id, before); });
    }

    std::optional<ir::NodeId> counted(ir::NodeId id, ir::Block& before) {
        // A weight of a draw over objects depends on the object, which `before` does not know.
        if (!builder_.properties(id).free_variables.empty()) return std::nullopt;
        const auto nest = ir::whole_reduction_nest(program_, id, Reduction::Sum);
        if (!nest) return std::nullopt;
        return sum(nest->body, {nest->variables, nullptr}, before);
    }

    // The sum of plus or minus bools; nothing if it is a sum of something else.
    std::optional<ir::NodeId> sum(ir::NodeId term, const ir::Nest& nest, ir::Block& before) {
        if (program_[term].type != ir::Scalar::Int) return std::nullopt;
        if (const auto* apply = std::get_if<ir::Apply>(&program_[term].form)) {
            if (apply->op != Operator::Negate) return std::nullopt;
            const auto positive = sum(apply->operands.front(), nest, before);
            if (!positive) return std::nullopt;
            return builder_.apply(Operator::Negate, {*positive});
        }
        const auto* convert = std::get_if<ir::Convert>(&program_[term].form);
        if (!convert || !can_fill_words(convert->operand, nest)) return std::nullopt;
        const ir::BufferId table = table_of(convert->operand, nest, before);
        ir::NodeId total = builder_.constant(std::int64_t{0});
        for (std::int64_t first = 0; first < program_[table].count(); first += bools_in_a_word) {
            const ir::NodeId bits = builder_.bits(table, first);
            total =
                builder_.apply(Operator::Add, {total, builder_.apply(Operator::CountOnes, {bits})});
        }
        ++report_["sums that count words of bools"];
        return total;
    }

    bool can_fill_words(ir::NodeId id, const ir::Nest& nest) const {
        return ir::combinations(program_, nest.variables) <= most_counted &&
               are_many(program_, nest) &&
               is_of_bools(program_, id, nest,
                           [&](ir::NodeId each) { return is_at_known_place(each); }) &&
               ir::is_droppable(builder_.properties(id));
    }
    // Constants choose the element (read_places.hpp).
    bool is_at_known_place(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && program_[id].type == ir::Scalar::Bool &&
               program_[load->buffer].count() <= most_looked_up_bools &&
               std::ranges::all_of(load->indices, [&](ir::NodeId index) {
                   return builder_.properties(index).uniform;
               });
    }

    ir::BufferId table_of(ir::NodeId id, const ir::Nest& nest, ir::Block& before) {
        const ir::BufferId table = builder_.tables().scratch(name_ + "-bools", ir::Scalar::Bool, {},
                                                             nest.variables, span_);
        ir::fill_table(builder_, before, table, nest.variables, id);
        auto& loop = std::get<ir::Loop>(before.back().form);
        loop.several_at_once = loop.as_words = true;
        return table;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
};

bool are_loops_of_words(const ir::Program& program, const ir::Block& block) {
    return std::ranges::all_of(block, [&](const ir::Statement& statement) {
        const auto* loop = std::get_if<ir::Loop>(&statement.form);
        return !loop || !loop->as_words || is_of_words(program, *loop);
    });
}

}  // namespace

// The bools are read by their places at once: without that the loops are not of words.
ir::Program separate_counts(ir::Program program, Report& report) {
    Report found;
    ir::Program separated = CountSeparation(program, found).run();
    if (found.empty()) return program;
    separated = read_places(std::move(separated), found);
    const bool all_are_words = are_loops_of_words(separated, separated.reward.body) &&
                               std::ranges::all_of(separated.step, [&](const ir::Definition& each) {
                                   return are_loops_of_words(separated, each.body);
                               });
    if (!all_are_words) return program;
    for (const auto& [what, count] : found) report[what] += count;
    return separated;
}

}  // namespace rddlc::passes
