// Over 400 lines: a function for each kind of node and statement, as the IR's evaluator has.
#include "autodiff/evaluation.hpp"
#include "autodiff/straight_line.hpp"
#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/layout.hpp"
#include "support/failure.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace rddlc::autodiff {
namespace {

using ir::NodeId;

// A list says where its elements stand in `operands`.
struct List {
    std::uint32_t first, count;
};

// Two instructions with equal keys give equal values.
using Key = std::tuple<Code, Operator, Distribution, Slot, Slot, Slot, std::uint32_t, std::uint32_t,
                       Slot, std::uint32_t>;

std::string refusal_of(const ir::Program& program, const ir::Call& call) {
    return fmt::format("there are no derivatives of {}", name_of(program, call.callee));
}

class Unroller {
  public:
    explicit Unroller(const ir::Program& program)
        : program_(program),
          properties_(ir::all_properties(program)),
          buffers_(program.buffers.size()),
          variables_(program.variables.size()),
          locals_(program.local_count, no_slot) {
        find_nodes_with_locals();
    }

    StraightLine run() {
        result_.state_count = add_inputs(ir::Storage::State);
        result_.action_count = add_inputs(ir::Storage::Action);
        for (const ir::Definition& definition : program_.step) run(definition.body);
        result_.reward = value_of(program_.reward);
        for (const ir::Field& field : ir::record_layout(program_, ir::Storage::Next).fields)
            std::ranges::copy(buffers_[field.buffer.index], std::back_inserter(result_.next));
        go_to_next_state();
        result_.over = over();
        remove_unused();
        return std::move(result_);
    }

  private:
    // ------------------------------------------------------------------------ inputs and outputs

    std::size_t add_inputs(ir::Storage storage) {
        const Slot first = result_.slot_count;
        for (const ir::Field& field : ir::record_layout(program_, storage).fields) {
            std::vector<Slot>& slots = elements(field.buffer);
            for (Slot& slot : slots) slot = new_slot();
        }
        return result_.slot_count - first;
    }

    // Conditions of states read the next state from here on. They share no instruction with the
    // step, since they are computed exactly. A relaxed bool is then true if it is above one half.
    void go_to_next_state() {
        std::map<std::uint32_t, ir::BufferId> next;  // by fluent
        for (const ir::Field& field : ir::record_layout(program_, ir::Storage::Next).fields)
            next.emplace(*program_[field.buffer].fluent, field.buffer);
        reductions_.clear();
        parts_.clear();
        seen_.clear();
        result_.first_of_end = result_.instructions.size();
        for (const ir::Field& field : ir::record_layout(program_, ir::Storage::State).fields) {
            std::vector<Slot>& slots = buffers_[field.buffer.index];
            slots = buffers_[next.at(*program_[field.buffer].fluent).index];
            if (program_[field.buffer].scalar != ir::Scalar::Bool) continue;
            for (Slot& slot : slots)
                slot = add({.code = Code::Comparison,
                            .op = Operator::Greater,
                            .a = slot,
                            .b = constant(0.5)});
        }
    }

    Slot over() {
        std::vector<Slot> causes;
        for (const ir::Computation& condition : program_.terminations)
            causes.push_back(value_of(condition));
        for (const ir::Computation& condition : program_.invariants)
            causes.push_back(logic(Operator::Not, value_of(condition), no_slot));
        return any_or_all(Code::Exists, std::move(causes));
    }

    Slot value_of(const ir::Computation& computation) {
        run(computation.body);
        return value(computation.value);
    }

    // -------------------------------------------------------------------------------- statements

    void run(const ir::Block& block) {
        for (const ir::Statement& statement : block)
            match(
                statement.form,
                [&](const ir::Let& let) { locals_[let.local.index] = value(let.value); },
                [&](const ir::Store& store) {
                    elements(store.target)[known_place(store.target, store.indices)] =
                        value(store.value);
                },
                [&](const ir::Loop& loop) {
                    for (std::int64_t i = 0; i < program_[loop.variable].size; ++i) {
                        variables_[loop.variable.index] = i;
                        run(loop.body);
                    }
                },
                [](const ir::Spread&) {},  // passes make them, which have not run
                [](const ir::Visit&) {},
                [&](const ir::Call& call) {
                    throw Failure(refusal_of(program_, call),
                                  "planners that sample, such as plan:cem, need no derivatives");
                });
    }

    std::vector<Slot>& elements(ir::BufferId id) {
        std::vector<Slot>& slots = buffers_[id.index];
        if (slots.empty()) slots.assign(static_cast<std::size_t>(program_[id].count()), no_slot);
        return slots;
    }

    std::size_t known_place(ir::BufferId id, const std::vector<NodeId>& indices) {
        const ir::Buffer& buffer = program_[id];
        std::int64_t place = 0;
        for (std::size_t axis = 0; axis < indices.size(); ++axis)
            place = place * buffer.shape[axis] + known_int(indices[axis]);
        return static_cast<std::size_t>(place);
    }

    std::int64_t known_int(NodeId id) {
        const std::optional<double> known = known_[value(id)];
        if (!known) own_mistake("an index that only a step decides, where a constant is needed");
        return static_cast<std::int64_t>(*known);
    }

    Slot element(ir::BufferId id, std::size_t place) {
        const ir::Buffer& buffer = program_[id];
        if (buffer.storage != ir::Storage::Constant) return elements(id)[place];
        return constant(buffer.values[static_cast<std::int64_t>(place)]);
    }

    // ------------------------------------------------------------------------------- expressions

    Slot value(NodeId id) {
        const ir::Node& node = program_[id];
        return match(
            node.form, [&](const ir::Constant& form) { return constant(form.value); },
            [&](const ir::Index& form) {
                return constant(static_cast<double>(variables_[form.variable.index]));
            },
            [&](const ir::Load& form) { return load(form); },
            [&](const ir::Local& form) { return locals_[form.local.index]; },
            [&](const ir::Convert& form) { return value(form.operand); },
            [&](const ir::Apply& form) { return apply(node.type, form); },
            [&](const ir::Select& form) { return select(form); },
            [&](const ir::Reduce& form) { return remembered_reduction(id, form); },
            [&](const ir::Sample& form) { return sample(id, form); },
            [&](const ir::Discrete& form) {
                std::vector<Slot> weights;
                for (const NodeId weight : form.weights) weights.push_back(value(weight));
                return discrete(id, form.normalise, form.place, std::move(weights));
            },
            [&](const ir::DiscreteOver& form) {
                std::vector<Slot> weights;
                for (std::int64_t i = 0; i < program_[form.variable].size; ++i) {
                    variables_[form.variable.index] = i;
                    weights.push_back(value(form.weight));
                }
                return discrete(id, form.normalise, form.place, std::move(weights));
            },
            [&](const ir::Fault& form) {
                may_fault({.code = Code::Fault}, true, form.place);
                return constant(0.0);
            },
            [&](const auto&) -> Slot { own_mistake("a form that only passes make"); });
    }

    Slot constant(const ir::Value& value) {
        return match(
            value, [&](bool v) { return constant(v ? 1.0 : 0.0); },
            [&](double v) { return constant(v); },
            [&](std::int64_t v) { return constant(static_cast<double>(v)); });
    }
    Slot constant(double value) {
        const auto [found, is_new] =
            constants_.try_emplace(std::bit_cast<std::uint64_t>(value), no_slot);
        if (is_new) {
            found->second = new_slot();
            known_[found->second] = value;
            result_.constants.push_back({found->second, value});
        }
        return found->second;
    }

    Slot load(const ir::Load& form) {
        const ir::Buffer& buffer = program_[form.buffer];
        std::vector<Slot> indices;
        for (const NodeId index : form.indices) indices.push_back(value(index));
        // The part that the leading constant indices choose.
        std::size_t axis = 0;
        std::int64_t part = 0, size = 1;
        for (; axis < indices.size() && known_[indices[axis]]; ++axis)
            part = part * buffer.shape[axis] + static_cast<std::int64_t>(*known_[indices[axis]]);
        if (axis == indices.size()) return element(form.buffer, static_cast<std::size_t>(part));
        Slot place = indices[axis];
        size = buffer.shape[axis];
        for (++axis; axis < indices.size(); ++axis) {
            const Slot extent = constant(static_cast<double>(buffer.shape[axis]));
            place = int_operator(Operator::Multiply, place, extent);
            place = int_operator(Operator::Add, place, indices[axis]);
            size *= buffer.shape[axis];
        }
        if (known_[place])
            return element(
                form.buffer,
                static_cast<std::size_t>(part * size + static_cast<std::int64_t>(*known_[place])));
        const List list = part_of(form.buffer, part, size);
        return add({.code = Code::Gather, .a = place, .first = list.first, .count = list.count});
    }

    List part_of(ir::BufferId buffer, std::int64_t part, std::int64_t size) {
        const auto [found, is_new] = parts_.try_emplace({buffer, part, size});
        if (is_new) {
            std::vector<Slot> slots;
            for (std::int64_t i = 0; i < size; ++i)
                slots.push_back(element(buffer, static_cast<std::size_t>(part * size + i)));
            found->second = add_list(slots);
        }
        return found->second;
    }

    List add_list(const std::vector<Slot>& slots) {
        const auto [found, is_new] = lists_.try_emplace(slots);
        if (is_new) {
            if (slots.size() > most_instructions - result_.operands.size()) give_up_on_size();
            found->second = {static_cast<std::uint32_t>(result_.operands.size()),
                             static_cast<std::uint32_t>(slots.size())};
            result_.operands.insert(result_.operands.end(), slots.begin(), slots.end());
        }
        return found->second;
    }

    // ---------------------------------------------------------------------------------- operators

    Slot apply(ir::Scalar type, const ir::Apply& form) {
        const ir::Scalar operands = program_[form.operands.front()].type;
        const Slot a = value(form.operands.front());
        if (type == ir::Scalar::Bool && operands == ir::Scalar::Bool) {
            if (form.operands.size() == 1) return logic(form.op, a, no_slot);
            if (const auto decided = decided_by(form.op, a)) return *decided;
            return logic(form.op, a, value(form.operands.back()));
        }
        const Slot b = form.operands.size() == 1 ? no_slot : value(form.operands.back());
        Instruction instruction{.code = Code::RealOperator, .op = form.op, .a = a, .b = b};
        if (type == ir::Scalar::Bool) {
            instruction.code = Code::Comparison;
        } else if (type == ir::Scalar::Int) {
            instruction.code = operands == ir::Scalar::Real ? Code::ToInt : Code::IntOperator;
        }
        if (form.place) return may_fault(instruction, true, *form.place);
        if (instruction.code == Code::RealOperator && form.op == Operator::Multiply)
            return product(a, b);
        return add(instruction);
    }

    Slot int_operator(Operator op, Slot a, Slot b) {
        return add({.code = Code::IntOperator, .op = op, .a = a, .b = b});
    }

    Slot product(Slot a, Slot b) {
        if (known_[a] == 1.0) return b;
        if (known_[b] == 1.0) return a;
        return add({.code = Code::RealOperator, .op = Operator::Multiply, .a = a, .b = b});
    }

    // The value of a connective that its left operand decides.
    std::optional<Slot> decided_by(Operator op, Slot left) {
        if (op == Operator::And && known_[left] == 0.0) return left;
        if (op == Operator::Or && known_[left] == 1.0) return left;
        if (op == Operator::Implies && known_[left] == 0.0) return constant(1.0);
        return std::nullopt;
    }

    Slot logic(Operator op, Slot a, Slot b) {
        const bool is_neutral_left = (op == Operator::And && known_[a] == 1.0) ||
                                     (op == Operator::Or && known_[a] == 0.0) ||
                                     (op == Operator::Implies && known_[a] == 1.0);
        if (is_neutral_left) return b;
        if (op == Operator::And && known_[b]) return *known_[b] == 1.0 ? a : b;
        if (op == Operator::Or && known_[b]) return *known_[b] == 0.0 ? a : b;
        if (a == b && is_one_of(op, {Operator::And, Operator::Or})) return a;
        return add({.code = Code::Logic, .op = op, .a = a, .b = b});
    }

    Slot select(const ir::Select& form) {
        const Slot condition = value(form.condition);
        if (known_[condition])
            return value(*known_[condition] == 1.0 ? form.then_value : form.else_value);
        if (is_guarded_product(program_, form)) return guarded_product(condition, form);
        const Slot then_value = value_where(condition, true, form.then_value);
        const Slot else_value = value_where(condition, false, form.else_value);
        if (then_value == else_value) return then_value;
        return add({.code = Code::Select, .a = condition, .b = then_value, .c = else_value});
    }

    Slot guarded_product(Slot is_zero, const ir::Select& form) {
        const auto& operands = std::get<ir::Apply>(program_[form.else_value].form).operands;
        const NodeId other =
            operands.front() == form.then_value ? operands.back() : operands.front();
        const Slot a = value(form.then_value);
        const Slot b = value_where(is_zero, false, other);
        if (program_[form.then_value].type == ir::Scalar::Int)
            return int_operator(Operator::Multiply, a, b);
        if (known_[b] == 1.0) return a;
        return add({.code = Code::GuardedProduct, .a = a, .b = b});
    }

    // A value that is used only where the condition is so.
    Slot value_where(Slot condition, bool holds, NodeId id) {
        if (!properties_[id.index].may_fault) return value(id);
        const Slot before = guard_;
        const Slot here = holds ? condition : logic(Operator::Not, condition, no_slot);
        guard_ = before == no_slot ? here : logic(Operator::And, before, here);
        const Slot result = value(id);
        guard_ = before;
        return result;
    }

    // --------------------------------------------------------------------------------- reductions

    // Equal reductions are computed once: without this, nested sums take as many instructions as
    // they have terms.
    Slot remembered_reduction(NodeId id, const ir::Reduce& form) {
        if (has_local_[id.index]) return reduction(form);
        std::vector<std::int64_t> key{id.index, guard_};
        for (const ir::VariableId variable : properties_[id.index].free_variables)
            key.push_back(variables_[variable.index]);
        const auto found = reductions_.find(key);
        if (found != reductions_.end()) return found->second;
        const Slot result = reduction(form);
        reductions_.emplace(std::move(key), result);
        return result;
    }

    Slot reduction(const ir::Reduce& form) {
        std::int64_t begin = 0, end = program_[form.variable].size;
        if (form.bounds) {
            begin = known_int(form.bounds->begin);
            end = known_int(form.bounds->end);
        }
        std::vector<Slot> terms;
        for (std::int64_t i = begin; i < end; ++i) {
            variables_[form.variable.index] = i;
            terms.push_back(value(form.body));
        }
        return reduction_of(form.op, program_[form.body].type == ir::Scalar::Real,
                            std::move(terms));
    }

    Slot reduction_of(Reduction op, bool is_real, std::vector<Slot> terms) {
        switch (op) {
            case Reduction::Sum:
                return sum(is_real, std::move(terms));
            case Reduction::Product:
                return chain(Operator::Multiply, is_real, terms);
            case Reduction::Minimum:
                return chain(Operator::Minimum, is_real, terms);
            case Reduction::Maximum:
                return chain(Operator::Maximum, is_real, terms);
            case Reduction::ForAll:
                return any_or_all(Code::ForAll, std::move(terms));
            case Reduction::Exists:
                return any_or_all(Code::Exists, std::move(terms));
            case Reduction::ArgMin:
                return add_of(Code::ArgMin, terms);
            case Reduction::ArgMax:
                return add_of(Code::ArgMax, terms);
            case Reduction::Average:
                break;
        }
        own_mistake("an average in the IR");
    }

    // It begins with 0.0, so zeros of either sign change nothing.
    Slot sum(bool is_real, std::vector<Slot> terms) {
        std::erase_if(terms, [&](Slot term) { return known_[term] == 0.0; });
        if (terms.empty()) return constant(0.0);
        return add_of(is_real ? Code::Sum : Code::IntSum, terms);
    }

    // a op b op c ...
    Slot chain(Operator op, bool is_real, const std::vector<Slot>& terms) {
        if (terms.empty()) return constant(1.0);  // of products alone
        Slot result = terms.front();
        for (std::size_t i = 1; i < terms.size(); ++i) {
            if (op == Operator::Multiply && is_real)
                result = product(result, terms[i]);
            else
                result = add({.code = is_real ? Code::RealOperator : Code::IntOperator,
                              .op = op,
                              .a = result,
                              .b = terms[i]});
        }
        return result;
    }

    Slot any_or_all(Code code, std::vector<Slot> terms) {
        const double neutral = code == Code::ForAll ? 1.0 : 0.0;
        for (const Slot term : terms)
            if (known_[term] && *known_[term] != neutral) return term;
        std::erase_if(terms, [&](Slot term) { return known_[term].has_value(); });
        std::ranges::sort(terms);
        terms.erase(std::unique(terms.begin(), terms.end()), terms.end());
        if (terms.empty()) return constant(neutral);
        if (terms.size() == 1) return terms.front();
        return add_of(code, terms);
    }

    // ---------------------------------------------------------------------------------- draws

    Slot sample(NodeId id, const ir::Sample& form) {
        const Slot a = value(form.parameters.front());
        const Slot b = form.parameters.size() == 2 ? value(form.parameters[1]) : no_slot;
        const bool faults = properties_[id.index].may_fault;
        if (form.distribution == Distribution::Bernoulli) {
            if (known_[a] == 0.0 || known_[a] == 1.0) return a;
            return may_fault({.code = Code::Bernoulli, .a = a}, faults, form.place);
        }
        Instruction instruction{.code = Code::DrawReal, .distribution = form.distribution};
        instruction.a = a;
        instruction.b = b;
        if (form.distribution == Distribution::Binomial)
            instruction.code = Code::Binomial;
        else if (drawn_by(form.distribution) == Drawn::Int)
            instruction.code = Code::DrawInt;
        return may_fault(instruction, faults, form.place);
    }

    Slot discrete(NodeId id, bool normalise, const ir::Place& place, std::vector<Slot> weights) {
        const List list = add_list(weights);
        return may_fault({.code = Code::Discrete,
                          .normalise = normalise,
                          .first = list.first,
                          .count = list.count},
                         properties_[id.index].may_fault, place);
    }

    // ------------------------------------------------------------------------------- instructions

    Slot new_slot() {
        known_.emplace_back();
        return result_.slot_count++;
    }

    Slot add_of(Code code, const std::vector<Slot>& terms) {
        const List list = add_list(terms);
        return add({.code = code, .first = list.first, .count = list.count});
    }

    // An instruction that draws, or may fault.
    Slot may_fault(Instruction instruction, bool faults, const ir::Place& place) {
        const rddl::Place here(place.site.index, known_int(place.index),
                               program_.series_of(place.site).index);
        const auto [found, is_new] = places_.try_emplace(
            {here.site, here.index, here.series}, static_cast<std::uint32_t>(places_.size()));
        if (is_new) result_.places.push_back(here);
        instruction.place = found->second + 1;
        if (faults) instruction.guard = guard_;
        const Slot slot = add(instruction);
        if (faults) faulty_.push_back(slot);
        return slot;
    }

    Slot add(const Instruction& instruction) {
        const Key key{instruction.code,
                      instruction.op,
                      instruction.distribution,
                      instruction.a,
                      instruction.b,
                      instruction.c,
                      instruction.first,
                      instruction.count,
                      instruction.guard,
                      instruction.place * 2 + (instruction.normalise ? 1 : 0)};
        const auto [found, is_new] = seen_.try_emplace(key, no_slot);
        if (!is_new) return found->second;
        if (instruction.place == 0 && is_constant(instruction))
            return found->second = constant(constant_value(instruction));
        if (result_.instructions.size() == most_instructions) give_up_on_size();
        Instruction made = instruction;
        if (made.place > 0) --made.place;
        made.out = found->second = new_slot();
        result_.instructions.push_back(made);
        return made.out;
    }

    [[noreturn]] static void give_up_on_size() {
        throw Failure(fmt::format("a step of this instance takes more than {} instructions or "
                                  "operands of lists, which is too many for derivatives",
                                  most_instructions),
                      "planners that sample, such as plan:cem, need no derivatives");
    }

    template <class Visit>
    void for_each_operand(const Instruction& instruction, Visit&& visit) {
        for (const Slot slot : {instruction.a, instruction.b, instruction.c, instruction.guard})
            if (slot != no_slot) visit(slot);
        for (std::uint32_t i = 0; i < instruction.count; ++i)
            visit(result_.operands[instruction.first + i]);
    }

    bool is_constant(const Instruction& instruction) {
        bool all = true;
        for_each_operand(instruction, [&](Slot slot) { all = all && known_[slot]; });
        return all;
    }

    double constant_value(const Instruction& instruction) {
        return rddlc::autodiff::constant_value(result_, instruction,
                                               [&](Slot slot) { return *known_[slot]; });
    }

    // Drops instructions whose value is not used and that cannot fault, and numbers slots again.
    void remove_unused() {
        std::vector<bool> used(result_.slot_count);
        for (std::size_t i = 0; i < result_.state_count + result_.action_count; ++i) used[i] = true;
        for (const Slot slot : result_.next) used[slot] = true;
        for (const Slot slot : faulty_) used[slot] = true;
        used[result_.reward] = used[result_.over] = true;
        std::vector<Instruction> kept;
        std::size_t kept_of_end = 0;
        for (std::size_t i = result_.instructions.size(); i-- > 0;) {
            const Instruction& instruction = result_.instructions[i];
            if (!used[instruction.out]) continue;
            if (i >= result_.first_of_end) ++kept_of_end;
            for_each_operand(instruction, [&](Slot slot) { used[slot] = true; });
            kept.push_back(instruction);
        }
        result_.instructions.assign(kept.rbegin(), kept.rend());
        result_.first_of_end = kept.size() - kept_of_end;
        renumber(used);
    }

    void renumber(const std::vector<bool>& used) {
        std::vector<Slot> number(used.size(), no_slot);
        result_.slot_count = 0;
        for (std::size_t slot = 0; slot < used.size(); ++slot)
            if (used[slot]) number[slot] = result_.slot_count++;
        const auto set = [&](Slot& slot) {
            if (slot != no_slot) slot = number[slot];
        };
        for (Instruction& instruction : result_.instructions)
            for (Slot* const slot : {&instruction.out, &instruction.a, &instruction.b,
                                     &instruction.c, &instruction.guard})
                set(*slot);
        for (Slot& slot : result_.operands) set(slot);
        for (Slot& slot : result_.next) set(slot);
        set(result_.reward);
        set(result_.over);
        std::erase_if(result_.constants, [&](const Constant& each) { return !used[each.slot]; });
        for (Constant& each : result_.constants) set(each.slot);
    }

    void find_nodes_with_locals() {
        has_local_.resize(program_.nodes.size());
        for (std::size_t index = 0; index < program_.nodes.size(); ++index) {
            const ir::Node& node = program_.nodes[index];
            has_local_[index] = std::holds_alternative<ir::Local>(node.form);
            for (const NodeId operand : ir::operands_of(node))
                if (has_local_[operand.index]) has_local_[index] = true;
        }
    }

    const ir::Program& program_;
    std::vector<ir::Properties> properties_;
    StraightLine result_;
    std::vector<std::optional<double>> known_;  // values of constant slots, by slot
    std::vector<std::vector<Slot>> buffers_;    // the elements, by BufferId::index
    std::vector<std::int64_t> variables_;       // loop indices, by VariableId::index
    std::vector<Slot> locals_;
    std::vector<bool> has_local_;  // by NodeId::index: a local is read below
    Slot guard_ = no_slot;         // where what is computed now is used
    std::vector<Slot> faulty_;     // results of instructions that may fault
    std::map<std::uint64_t, Slot> constants_;
    std::map<Key, Slot> seen_;
    std::map<std::vector<Slot>, List> lists_;
    std::map<std::tuple<ir::BufferId, std::int64_t, std::int64_t>, List> parts_;
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> places_;
    std::map<std::vector<std::int64_t>, Slot> reductions_;
};

}  // namespace

bool can_be_relaxed(const StraightLine& program) {
    return std::ranges::any_of(program.instructions_of_step(), [](const Instruction& instruction) {
        return is_one_of(instruction.code, {Code::ToInt, Code::Comparison, Code::Bernoulli,
                                            Code::DrawInt, Code::Binomial, Code::Discrete});
    });
}

StraightLine unroll(const ir::Program& program) {
    return Unroller(program).run();
}

std::optional<std::string> refusal_of(const ir::Program& program) {
    std::optional<std::string> refusal;
    const auto look_at = [&](const ir::Block& block) {
        ir::for_each_statement<ir::Call>(block, [&](const ir::Call& call) {
            if (!refusal) refusal = refusal_of(program, call);
        });
    };
    for (const ir::Definition& definition : program.step) look_at(definition.body);
    look_at(program.reward.body);
    for (const auto* conditions : {&program.terminations, &program.invariants})
        for (const ir::Computation& condition : *conditions) look_at(condition.body);
    return refusal;
}

}  // namespace rddlc::autodiff
