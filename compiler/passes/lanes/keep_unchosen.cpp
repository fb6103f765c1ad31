#include "passes/lanes/keep_unchosen.hpp"

#include "ir/action_bools.hpp"
#include "ir/builder.hpp"
#include "ir/cost_model.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Operations (Properties::cost) of all loops that the same tables of the action skip. They have to
// pay for jumps that the processor does not foresee, for the tests and for the copies, also in
// steps whose action chooses something. So they are more than test_cheap_first.cpp counts for one
// such jump. The number is fitted (docs/decisions.md).
constexpr double worth_skipping = 180;
// More objects fill a register of one environment.
constexpr std::int64_t most_few_draws = 7;

class Keeping {
  public:
    Keeping(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) look_at(definition);
        for (const auto& [choices, loops] : found_) {
            double cost = 0;
            for (const Found& loop : loops) cost += loop.cost;
            if (cost < worth_skipping) continue;
            for (const Found& loop : loops)
                loop.definition->unchosen =
                    ir::Unchosen{{choices.begin(), choices.end()}, loop.kept};
            report_["definitions that keep the state where nothing is chosen"] += loops.size();
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    using Choices = std::set<ir::BufferId>;
    // A definition that keeps a table of the state if all bools of some choices are false, and the
    // cost of its loop.
    struct Found {
        ir::Definition* definition;
        ir::BufferId kept;
        double cost;
    };

    void look_at(ir::Definition& definition) {
        values_.clear();
        const ir::Loop* const loop = loop_after_lets(definition.body);
        if (definition.unchosen || !loop || loop->chosen) return;
        const ir::Nest nest = ir::nest_of(*loop);
        const ir::Store* const store = store_after_lets(*nest.body);
        if (!store || store->target != definition.target ||
            !ir::are_variables_of(program_, store->indices, nest))
            return;
        const Choices all = tables_of_action(store->value);
        const auto kept = kept_without(all, store->value, nest);
        if (all.empty() || !kept || program_[*kept].shape != program_[store->target].shape) return;
        found_[needed(all, store->value, nest)].push_back(
            {&definition, *kept, cost_of(*loop, nest, store->value)});
    }

    // Leaves out tables that decide nothing where the others choose nothing.
    Choices needed(Choices choices, ir::NodeId value, const ir::Nest& nest) {
        for (const ir::BufferId choice : Choices(choices)) {
            Choices others = choices;
            others.erase(choice);
            if (kept_without(others, value, nest)) choices = std::move(others);
        }
        return choices;
    }

    // The operations of the loop as one environment runs it (ir/cost_model.hpp). Few objects that
    // draw ints or reals in one register count one by one, as in packs: their draws take as long as
    // several of one object.
    double cost_of(const ir::Loop& loop, const ir::Nest& nest, ir::NodeId value) {
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId whole = replace_reads(value, known, [](ir::BufferId) { return false; });
        const std::int64_t objects = ir::combinations(program_, nest.variables);
        const ir::Properties& properties = builder_.properties(whole);
        const bool are_few_draws = properties.random && objects <= most_few_draws &&
                                   program_[value].type != ir::Scalar::Bool;
        double at_once = are_few_draws ? 1 : ir::iterations_at_once(loop);
        // Words of each term of an aggregation are loads, which take longer than connectives.
        if (loop.as_words && ir::contains<ir::Reduce>(program_, value))
            at_once = ir::objects_at_once;
        return std::ceil(static_cast<double>(objects) / at_once) * properties.cost;
    }

    // Remembers the values of the Lets. A fault of one must not disappear with the loop.
    const ir::Statement* after_lets(const ir::Block& block) {
        for (const ir::Statement& statement : block) {
            const auto* let = std::get_if<ir::Let>(&statement.form);
            if (!let) return &statement == &block.back() ? &statement : nullptr;
            if (builder_.properties(let->value).may_fault) return nullptr;
            values_[let->local] = let->value;
        }
        return nullptr;
    }
    const ir::Loop* loop_after_lets(const ir::Block& block) {
        const ir::Statement* const last = after_lets(block);
        return last ? std::get_if<ir::Loop>(&last->form) : nullptr;
    }
    const ir::Store* store_after_lets(const ir::Block& block) {
        const ir::Statement* const last = after_lets(block);
        return last ? std::get_if<ir::Store>(&last->form) : nullptr;
    }

    Choices tables_of_action(ir::NodeId value) {
        Choices tables;
        std::map<ir::NodeId, ir::NodeId> known;
        replace_reads(value, known, [&](ir::BufferId table) {
            tables.insert(table);
            return false;
        });
        return tables;
    }
    // The table of the state whose element is left of the value with false for all bools of the
    // choices.
    std::optional<ir::BufferId> kept_without(const Choices& choices, ir::NodeId value,
                                             const ir::Nest& nest) {
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId rest = replace_reads(
            value, known, [&](ir::BufferId table) { return choices.contains(table); });
        const auto* load = std::get_if<ir::Load>(&program_[rest].form);
        const bool is_kept = load && program_[load->buffer].storage == ir::Storage::State &&
                             ir::are_variables_of(program_, load->indices, nest);
        return is_kept ? std::optional(load->buffer) : std::nullopt;
    }
    // The value without the Lets' names, and with false for bools of those tables of the action for
    // which is_false holds. An object that is drawn by invalid weights faults whatever the action
    // chooses, so reads at such an object stay.
    template <class IsFalse>
    ir::NodeId replace_reads(ir::NodeId value, std::map<ir::NodeId, ir::NodeId>& known,
                             const IsFalse& is_false) {
        return ir::replace_in(
            builder_, value, known, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                const ir::Node node = program_[id];
                if (const auto* local = std::get_if<ir::Local>(&node.form))
                    return replace_reads(values_.at(local->local), known, is_false);
                const auto table = ir::buffer_read_by(node);
                if (!table || !ir::is_action_bools(program_[*table]) || !is_false(*table) ||
                    builder_.properties(id).may_fault)
                    return std::nullopt;
                if (node.type == ir::Scalar::Bool) return builder_.constant(false);
                return builder_.constant(std::int64_t{0});
            });
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::LocalId, ir::NodeId> values_;
    std::map<Choices, std::vector<Found>> found_;
};

}  // namespace

ir::Program keep_unchosen(ir::Program program, Report& report) {
    return Keeping(std::move(program), report).run();
}

}  // namespace rddlc::passes
