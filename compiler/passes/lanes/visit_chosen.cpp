#include "passes/lanes/visit_chosen.hpp"

#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>

namespace rddlc::passes {
namespace {

class Choosing {
  public:
    Choosing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::for_each_loop(program_, [&](ir::Loop& loop, Span) { change(loop); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Loop& loop) {
        const ir::Nest nest = ir::nest_of(loop);
        const auto* store = ir::only_statement<ir::Store>(*nest.body);
        // Loops over words compute all objects in few instructions.
        const bool may_be = loop.several_at_once && !loop.as_words && !loop.chosen && store &&
                            program_[store->target].scalar == ir::Scalar::Bool &&
                            are_many(program_, nest) && draws_bernoulli_alone(store->value);
        if (!may_be || !ir::are_variables_of(program_, store->indices, nest)) return;
        std::set<ir::BufferId> choices;
        collect_choices(store->value, nest, choices);
        for (const ir::BufferId few : choices) {
            const auto others = kept_without(few, store->value, nest);
            if (!others) continue;
            loop.chosen = ir::Chosen{few, *others};
            ++report_["loops over the objects that an action chooses"];
            return;
        }
    }

    // Draws of one object alone exist of this distribution.
    bool draws_bernoulli_alone(ir::NodeId id) {
        return builder_.properties(id).random &&
               !ir::any_node_of(program_, id, [&](ir::NodeId each) {
                   const ir::Node& node = program_[each];
                   const auto* sample = std::get_if<ir::Sample>(&node.form);
                   const bool draws_otherwise =
                       ir::place_of(node) &&
                       !(sample && sample->distribution == Distribution::Bernoulli);
                   return draws_otherwise || std::holds_alternative<ir::Reduce>(node.form);
               });
    }

    // Tables of the action of which few bools are true.
    void collect_choices(ir::NodeId id, const ir::Nest& nest, std::set<ir::BufferId>& choices) {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        if (load && ir::are_variables_of(program_, load->indices, nest) &&
            acts_with_few_true(program_[load->buffer], least_per_chosen))
            choices.insert(load->buffer);
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            collect_choices(operand, nest, choices);
    }
    // The table whose elements objects keep that are not chosen.
    std::optional<ir::BufferId> kept_without(ir::BufferId few, ir::NodeId value,
                                             const ir::Nest& nest) {
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId rest =
            ir::replace_in(builder_, value, known, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                const auto* load = std::get_if<ir::Load>(&program_[id].form);
                if (!load || load->buffer != few ||
                    !ir::are_variables_of(program_, load->indices, nest))
                    return std::nullopt;
                return builder_.constant(false);
            });
        const auto* kept = std::get_if<ir::Load>(&program_[rest].form);
        if (!kept || program_[kept->buffer].storage != ir::Storage::State ||
            !ir::are_variables_of(program_, kept->indices, nest))
            return std::nullopt;
        return kept->buffer;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program visit_chosen(ir::Program program, Report& report) {
    return Choosing(std::move(program), report).run();
}

}  // namespace rddlc::passes
