#include "passes/lanes/draw_for_chosen.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/fill_table.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/few_true.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <variant>

namespace rddlc::passes {
namespace {

class Drawing {
  public:
    Drawing(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step)
            if (!definition.unchosen) change(definition);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Definition& definition) {
        ir::Block body;
        for (ir::Statement& statement : definition.body) {
            if (auto* loop = std::get_if<ir::Loop>(&statement.form))
                change(*loop, definition.span, body);
            body.push_back(std::move(statement));
        }
        definition.body = std::move(body);
    }

    // Loops over words draw for several objects at once.
    void change(ir::Loop& loop, Span span, ir::Block& before) {
        if (!loop.several_at_once || !ir::takes_all_objects(loop)) return;
        const ir::Nest nest = ir::nest_of(loop);
        std::map<ir::NodeId, ir::NodeId> known;
        ir::change_roots(ir::innermost_body(loop), [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known, [&](ir::NodeId id) {
                return drawn_before(id, nest, span, before);
            });
        });
    }

    // The element of a table of draws that is filled before the loop.
    std::optional<ir::NodeId> drawn_before(ir::NodeId id, const ir::Nest& nest, Span span,
                                           ir::Block& before) {
        const auto few = choice_of_draw(id, nest);
        if (!few) return std::nullopt;
        const ir::BufferId table = builder_.tables().scratch(
            program_[*few].name + "-draws", ir::Scalar::Bool, {}, nest.variables, span);
        const ir::NodeId element = ir::fill_table(builder_, before, table, nest.variables, id);
        auto& loop = std::get<ir::Loop>(before.back().form);
        loop.several_at_once = true;
        loop.chosen = ir::Chosen{*few, {}};
        ++report_["draws made before a loop for the objects that an action chooses"];
        return element;
    }

    // The table of the action of `chosen && draw`, with its draw in a branch.
    std::optional<ir::BufferId> choice_of_draw(ir::NodeId id, const ir::Nest& nest) {
        const auto* select = std::get_if<ir::Select>(&program_[id].form);
        if (!select || ir::constant<bool>(program_, select->else_value) != false)
            return std::nullopt;
        const auto* load = std::get_if<ir::Load>(&program_[select->condition].form);
        const bool is_choice = load && ir::are_variables_of(program_, load->indices, nest) &&
                               acts_with_few_true(program_[load->buffer], least_per_draw);
        return is_choice && draws_bernoulli_alone(select->then_value, nest)
                   ? std::optional(load->buffer)
                   : std::nullopt;
    }
    // It is drawn where the loop may not get to it, so it must not fault.
    bool draws_bernoulli_alone(ir::NodeId id, const ir::Nest& nest) {
        const auto* sample = std::get_if<ir::Sample>(&program_[id].form);
        return sample && sample->distribution == Distribution::Bernoulli &&
               !builder_.properties(id).may_fault &&
               ir::is_place_in(program_, nest, sample->place.index) &&
               !ir::contains<ir::Local>(program_, id) && !ir::contains<ir::Reduce>(program_, id);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program draw_for_chosen(ir::Program program, Report& report) {
    return Drawing(std::move(program), report).run();
}

}  // namespace rddlc::passes
