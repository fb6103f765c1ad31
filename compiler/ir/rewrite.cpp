#include "ir/rewrite.hpp"

#include "ir/analysis.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rddlc::ir {
namespace {

void change_all(std::vector<NodeId>& ids, const Change& change) {
    for (NodeId& id : ids) change(id);
}

void change_roots(Computation& computation, const Change& change) {
    change_roots(computation.body, change);
    change(computation.value);
}

void change_tables(Block& block, const std::function<void(BufferId&)>& change) {
    for (Statement& statement : block) {
        match(
            statement.form, [](Let&) {}, [&](Store& store) { change(store.target); },
            [&](Spread& spread) { change(spread.target); },
            [&](Loop& loop) {
                change_tables(loop.body, change);
                if (loop.affected) {
                    change(loop.affected->few);
                    change(loop.affected->rows);
                    change(loop.affected->objects);
                    if (auto& moves = loop.affected->moves) {
                        for (BufferId& choice : moves->choices) change(choice);
                        change(moves->table);
                    }
                }
                if (loop.chosen) {
                    change(loop.chosen->few);
                    if (loop.chosen->kept) change(*loop.chosen->kept);
                }
                if (loop.clearances) {
                    change(loop.clearances->table);
                    for (BufferId& place : loop.clearances->places) change(place);
                    for (BufferId& move : loop.clearances->moves) change(move);
                }
            },
            [&](Visit& visit) {
                for (Mark& mark : visit.marks) change(mark.target);
                if (visit.entries) change(visit.entries->rows);
            },
            [&](Call& call) {
                for (TableView& input : call.inputs) change(input.buffer);
                change(call.output.buffer);
            });
    }
}

}  // namespace

void change_operands(Node& node, const Change& change) {
    match(
        node.form, [](Constant&) {}, [](Index&) {}, [](Local&) {},
        [&](Bits& bits) { change_all(bits.indices, change); },
        [&](Union& form) {
            change_all(form.row, change);
            change(form.bits);
        },
        [&](Load& load) { change_all(load.indices, change); },
        [&](Search& search) { change(search.value); },
        [&](Element& element) {
            change_all(element.indices, change);
            change(element.place);
        },
        [&](Convert& convert) { change(convert.operand); },
        [&](Apply& apply) {
            change_all(apply.operands, change);
            if (apply.place) change(apply.place->index);
        },
        [&](Select& select) {
            change(select.condition);
            change(select.then_value);
            change(select.else_value);
        },
        [&](Reduce& reduce) {
            change(reduce.body);
            if (!reduce.bounds) return;
            change(reduce.bounds->begin);
            change(reduce.bounds->end);
        },
        [&](Sample& sample) {
            change_all(sample.parameters, change);
            change(sample.place.index);
        },
        [&](Discrete& discrete) {
            change_all(discrete.weights, change);
            change(discrete.place.index);
        },
        [&](DiscreteOver& discrete) {
            change(discrete.weight);
            change(discrete.place.index);
        },
        [&](Interval& interval) {
            change_all(interval.row, change);
            change(interval.place.index);
        },
        [&](Fault& fault) { change(fault.place.index); });
}

void change_roots(Block& block, const Change& change) {
    for (Statement& statement : block) {
        match(
            statement.form, [&](Let& let) { change(let.value); },
            [&](Store& store) {
                change_all(store.indices, change);
                change(store.value);
            },
            [&](Spread& spread) {
                change_all(spread.indices, change);
                change(spread.bits);
            },
            [&](Loop& loop) { change_roots(loop.body, change); },
            [&](Visit& visit) {
                change(visit.condition);
                for (Mark& mark : visit.marks) {
                    change_all(mark.indices, change);
                    change(mark.condition);
                }
            },
            [&](Call& call) {
                for (TableView& input : call.inputs) change_all(input.indices, change);
                change_all(call.scalars, change);
                change_all(call.output.indices, change);
                if (call.place) change(call.place->index);
            });
    }
}

void change_roots(Program& program, const Change& change) {
    for (Definition* definition : definitions_of(program)) change_roots(definition->body, change);
    change_roots(program.reward, change);
    for (Computation& condition : program.preconditions) change_roots(condition, change);
    for (Computation& condition : program.invariants) change_roots(condition, change);
    for (Computation& condition : program.terminations) change_roots(condition, change);
}

void change_buffers(Program& program, const std::function<void(BufferId&)>& change) {
    for (Node& node : program.nodes) {
        if (auto* load = std::get_if<Load>(&node.form)) change(load->buffer);
        if (auto* search = std::get_if<Search>(&node.form)) change(search->table);
        if (auto* bits = std::get_if<Bits>(&node.form)) change(bits->buffer);
        if (auto* form = std::get_if<Union>(&node.form)) change(form->masks);
        if (auto* interval = std::get_if<Interval>(&node.form)) change(interval->table);
        if (auto* element = std::get_if<Element>(&node.form)) change(element->buffer);
    }
    for (Definition* definition : definitions_of(program)) {
        change(definition->target);
        if (definition->unchosen) {
            for (BufferId& choice : definition->unchosen->choices) change(choice);
            if (definition->unchosen->kept) change(*definition->unchosen->kept);
        }
        change_tables(definition->body, change);
    }
    change_tables(program.reward.body, change);
    for (auto* conditions : {&program.preconditions, &program.invariants, &program.terminations}) {
        for (Computation& condition : *conditions) change_tables(condition.body, change);
    }
}

Program rewrite(Program program, const Replace& replace) {
    const std::vector<bool> reachable = reachable_nodes(program);
    std::vector<Node> old_nodes = std::exchange(program.nodes, {});
    std::vector<NodeId> new_ids(old_nodes.size());
    const Change renew = [&](NodeId& id) {
        id = new_ids[id.index];
    };

    Builder builder(program);
    for (std::size_t index = 0; index < old_nodes.size(); ++index) {
        if (!reachable[index]) continue;
        Node& node = old_nodes[index];
        change_operands(node, renew);
        const auto replacement = replace(builder, NodeId{static_cast<std::uint32_t>(index)}, node);
        new_ids[index] = replacement ? *replacement : builder.rebuild(node);
    }
    change_roots(program, renew);
    return program;
}

NodeId replace_in(Builder& builder, NodeId id, std::map<NodeId, NodeId>& known) {
    return replace_in(builder, id, known, [](NodeId) { return std::optional<NodeId>(); });
}

NodeId replace_in(Builder& builder, NodeId id, std::map<NodeId, NodeId>& known, const Find& find) {
    if (const auto before = known.find(id); before != known.end()) return before->second;
    if (const auto found = find(id)) return known[id] = *found;
    Node node = builder.program()[id];
    change_operands(node,
                    [&](NodeId& operand) { operand = replace_in(builder, operand, known, find); });
    return known[id] = builder.rebuild(node);
}

void replace_in_step(Builder& builder, Program& program, std::map<NodeId, NodeId>& known) {
    const Change change = [&](NodeId& root) {
        root = replace_in(builder, root, known);
    };
    for (Definition& definition : program.step) change_roots(definition.body, change);
    change_roots(program.reward, change);
}

NodeId replace_reductions_in(Builder& builder, NodeId value, const Find& find) {
    std::map<NodeId, NodeId> known;
    return replace_in(builder, value, known, [&](NodeId id) -> std::optional<NodeId> {
        const auto& form = builder.program()[id].form;
        if (std::holds_alternative<Select>(form)) return id;
        if (!std::holds_alternative<Reduce>(form)) return std::nullopt;
        return find(id).value_or(id);
    });
}

std::map<NodeId, NodeId> combination(Builder& builder, std::span<const VariableId> variables,
                                     std::int64_t number) {
    std::map<NodeId, NodeId> values;
    for (auto each = variables.rbegin(); each != variables.rend(); ++each) {
        const std::int64_t count = builder.program()[*each].size;
        values[builder.index(*each)] = builder.constant(number % count);
        number /= count;
    }
    return values;
}

NodeId joined(Builder& builder, Operator op, std::span<const NodeId> parts) {
    if (parts.empty()) return builder.constant(op == Operator::And);
    NodeId all = parts.front();
    for (const NodeId part : parts.subspan(1)) all = builder.apply(op, {all, part});
    return all;
}

Program collect_garbage(Program program) {
    const auto is_clean = [&] {
        const std::vector<bool> reachable = reachable_nodes(program);
        return std::ranges::find(reachable, false) == reachable.end();
    };
    while (!is_clean()) {
        program = rewrite(std::move(program),
                          [](Builder&, NodeId, const Node&) { return std::optional<NodeId>(); });
    }
    return program;
}

}  // namespace rddlc::ir
