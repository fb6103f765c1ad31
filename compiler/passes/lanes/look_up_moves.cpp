#include "passes/lanes/look_up_moves.hpp"

#include "ir/action_bools.hpp"
#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/evaluator.hpp"
#include "ir/layout.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"

#include <rddl/values/move_codes.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Codes of a table, which an environment is to have near; and the evaluations that make them.
constexpr std::int64_t most_move_codes = 4096;
constexpr std::size_t most_move_choices = 8;

// A record that a program reads, with all bools false.
struct ReadRecord {
    ReadRecord(const ir::Program& program, ir::Storage of)
        : storage(of), layout(ir::record_layout(program, of)), bytes(layout.size) {}

    std::byte* at(ir::BufferId buffer) {
        for (const ir::Field& field : layout.fields)
            if (field.buffer == buffer) return bytes.data() + field.offset;
        return nullptr;
    }

    ir::Storage storage;
    ir::RecordLayout layout;
    std::vector<std::byte> bytes;
};

// The bool that a loop stores, for either value of its draw; and the probability, where it is a
// constant of each object.
struct Stored {
    ir::NodeId if_drawn, if_not;
    std::optional<ir::NodeId> chance;
};

class MoveTables {
  public:
    MoveTables(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        // Bools of actions are tested where expressions read them.
        if (ir::tests_action_bools(program_)) return std::move(program_);
        for (const ir::Definition& definition : program_.step)
            ir::for_each_statement<ir::Let>(
                definition.body, [&](const ir::Let& let) { named_[let.local] = let.value; });
        ir::for_each_loop(program_, [&](ir::Loop& loop, Span span) { change(loop, span); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Loop& loop, Span span) {
        if (!loop.affected || loop.affected->moves) return;
        const ir::Nest nest = ir::nest_of(loop);
        std::map<ir::NodeId, ir::NodeId> known;
        const ir::NodeId value =
            without_names(ir::only_statement<ir::Store>(*nest.body)->value, known);
        const std::optional<ir::NodeId> draw = ir::only_bernoulli(program_, value);
        if (!draw || !is_valid(*draw)) return;
        const ir::BufferId few = loop.affected->few;
        const Stored values{with_draw(value, *draw, true), with_draw(value, *draw, false),
                            chance_of(*draw, few)};
        std::vector<ir::BufferId> choices;
        if (!collect_choices(values.if_drawn, few, choices) ||
            !collect_choices(values.if_not, few, choices))
            return;
        if (choices.size() > most_move_choices ||
            program_[few].count() << choices.size() > most_move_codes)
            return;
        loop.affected->moves = moves(*loop.affected, nest, values, std::move(choices), span);
        report_["loops that look up where the only true bool goes"] +=
            loop.affected->moves.has_value();
    }

    // With the values of Lets in place of their names, which may hide bools that choose.
    ir::NodeId without_names(ir::NodeId value, std::map<ir::NodeId, ir::NodeId>& known) {
        return ir::replace_in(
            builder_, value, known, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                const auto* local = std::get_if<ir::Local>(&program_[id].form);
                if (!local || !named_.contains(local->local)) return std::nullopt;
                return without_names(named_.at(local->local), known);
            });
    }

    bool is_valid(ir::NodeId draw) const {
        return std::get<ir::Sample>(program_[draw].form).is_valid;
    }
    std::optional<ir::NodeId> chance_of(ir::NodeId draw, ir::BufferId few) const {
        const ir::NodeId chance = std::get<ir::Sample>(program_[draw].form).parameters.front();
        std::vector<ir::BufferId> choices;
        const bool is_constant = collect_choices(chance, few, choices) && choices.empty() &&
                                 !ir::reads(program_, chance, few);
        return is_constant ? std::optional(chance) : std::nullopt;
    }
    ir::NodeId with_draw(ir::NodeId value, ir::NodeId draw, bool drawn) {
        std::map<ir::NodeId, ir::NodeId> known{{draw, builder_.constant(drawn)}};
        return ir::replace_in(builder_, value, known);
    }

    // False if it depends on more than `few`, bools without parameters and constants.
    bool collect_choices(ir::NodeId id, ir::BufferId few,
                         std::vector<ir::BufferId>& choices) const {
        const ir::Node& node = program_[id];
        if (const auto* load = std::get_if<ir::Load>(&node.form)) {
            const ir::Buffer& buffer = program_[load->buffer];
            if (is_choice(buffer)) {
                if (std::ranges::find(choices, load->buffer) == choices.end())
                    choices.push_back(load->buffer);
            } else if (load->buffer != few && buffer.storage != ir::Storage::Constant) {
                return false;
            }
        } else if (const auto* element = std::get_if<ir::Element>(&node.form)) {
            if (element->buffer != few || !element->indices.empty()) return false;
        } else if (!std::holds_alternative<ir::Constant>(node.form) &&
                   !std::holds_alternative<ir::Index>(node.form) &&
                   !std::holds_alternative<ir::Apply>(node.form) &&
                   !std::holds_alternative<ir::Convert>(node.form) &&
                   !std::holds_alternative<ir::Select>(node.form)) {
            return false;
        }
        return std::ranges::all_of(ir::operands_of(node), [&](ir::NodeId operand) {
            return collect_choices(operand, few, choices);
        });
    }
    static bool is_choice(const ir::Buffer& buffer) {
        return buffer.shape.empty() && buffer.scalar == ir::Scalar::Bool &&
               (buffer.storage == ir::Storage::State || buffer.storage == ir::Storage::Action);
    }

    // Nothing if a value faults, or if the loop would run for half of the codes of actions that
    // choose one thing at most.
    std::optional<ir::Moves> moves(const ir::Affected& affected, const ir::Nest& nest,
                                   const Stored& values, std::vector<ir::BufferId> choices,
                                   Span span) {
        const std::int64_t count = program_[affected.few].count();
        const std::int64_t combinations = std::int64_t{1} << choices.size();
        const ir::Evaluator evaluator(program_);
        ReadRecord state(program_, ir::Storage::State), action(program_, ir::Storage::Action);
        ir::Records records;
        records.set(state.storage, state.bytes.data()).set(action.storage, action.bytes.data());
        Context context;
        ir::Evaluator::Frame frame(evaluator, records, context);
        std::byte* const few = state.at(affected.few);
        std::vector<ir::Value> codes;
        std::int64_t usual = 0, others = 0;
        for (std::int64_t place = 0; place < count; ++place) {
            few[place] = std::byte{1};
            for (std::int64_t bits = 0; bits < combinations; ++bits) {
                for (std::size_t k = 0; k < choices.size(); ++k) {
                    std::byte* const chosen = state.at(choices[k]);
                    *(chosen ? chosen : action.at(choices[k])) = std::byte(bits >> k & 1);
                }
                const auto code = code_of(affected, nest, values, place, evaluator, frame);
                if (!code) return std::nullopt;
                codes.emplace_back(*code);
                const bool is_usual = (bits & (bits - 1)) == 0;
                usual += is_usual;
                others += is_usual && *code == rddl::MoveCodes{count}.other();
            }
            few[place] = std::byte{0};
        }
        if (2 * others >= usual) return std::nullopt;
        ir::Buffer table{.name = program_[affected.few].name + "-moves",
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Int,
                         .shape = {count, combinations},
                         .span = span,
                         .holds_places = true};
        table.values = std::move(codes);
        return ir::Moves{std::move(choices), builder_.tables().constant(std::move(table))};
    }

    // The code for the records of the frame; nothing if a value faults.
    std::optional<std::int64_t> code_of(const ir::Affected& affected, const ir::Nest& nest,
                                        const Stored& values, std::int64_t place,
                                        const ir::Evaluator& evaluator,
                                        ir::Evaluator::Frame& frame) const {
        const rddl::MoveCodes codes{program_[affected.few].count()};
        std::int64_t code = codes.none();
        for (std::int64_t entry = constant_int(affected.rows, place);
             entry < constant_int(affected.rows, place + 1); ++entry) {
            const std::int64_t object = constant_int(affected.objects, entry);
            set_object(nest, object, frame);
            const auto if_drawn = evaluator.value_unless_fault(values.if_drawn, frame);
            const auto if_not = evaluator.value_unless_fault(values.if_not, frame);
            if (!if_drawn || !if_not) return std::nullopt;
            const double chance =
                values.chance ? evaluator.value<double>(*values.chance, frame) : 0.5;
            const bool yes = std::get<bool>(chance > 0 ? *if_drawn : *if_not);
            const bool no = std::get<bool>(chance < 1 ? *if_not : *if_drawn);
            if (!yes && !no) continue;
            if (!yes || code != codes.none()) return codes.other();
            code = no ? codes.certain(object) : codes.drawn(object);
        }
        return code;
    }
    std::int64_t constant_int(ir::BufferId table, std::int64_t place) const {
        return std::get<std::int64_t>(program_[table].values[static_cast<std::size_t>(place)]);
    }
    void set_object(const ir::Nest& nest, std::int64_t object, ir::Evaluator::Frame& frame) const {
        for (auto variable = nest.variables.rbegin(); variable != nest.variables.rend();
             ++variable) {
            frame.set(*variable, object % program_[*variable].size);
            object /= program_[*variable].size;
        }
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::LocalId, ir::NodeId> named_;  // the values of all Lets of a step
};

}  // namespace

ir::Program look_up_moves(ir::Program program, Report& report) {
    return MoveTables(std::move(program), report).run();
}

}  // namespace rddlc::passes
