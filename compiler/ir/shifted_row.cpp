#include "ir/shifted_row.hpp"

#include "ir/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <variant>

namespace rddlc::ir {
namespace {

bool is_zero(const Program& program, NodeId id) {
    const auto value = constant<double>(program, id);
    return value && *value == 0 && !std::signbit(*value);
}

// The operands of `a + b`; null if it is something else.
const std::vector<NodeId>* added(const Program& program, NodeId id) {
    const auto* apply = std::get_if<Apply>(&program[id].form);
    return apply && apply->op == Operator::Add ? &apply->operands : nullptr;
}

// The values of a table of constants at a variable, its only index; null if it is something else.
const Buffer* table_at(const Program& program, NodeId id, VariableId variable) {
    const auto* load = std::get_if<Load>(&program[id].form);
    const bool is_table = load && program[load->buffer].storage == Storage::Constant &&
                          load->indices.size() == 1 &&
                          is_index_of(program, load->indices.front(), variable);
    return is_table ? &program[load->buffer] : nullptr;
}

// `first` where the value at each place is the place + `first`.
std::optional<std::int64_t> first_of_places(const Program& program, NodeId id,
                                            VariableId variable) {
    if (is_index_of(program, id, variable)) return 0;
    const Buffer* const table = table_at(program, id, variable);
    if (!table || table->scalar != Scalar::Int) return std::nullopt;
    const auto values = table->values.dense();
    const auto first = std::get<std::int64_t>(values.front());
    for (std::size_t place = 0; place < values.size(); ++place)
        if (std::get<std::int64_t>(values[place]) - static_cast<std::int64_t>(place) != first)
            return std::nullopt;
    return first;
}

// `select(IS-THERE[t], state.x[u, AFTER[t]], 0.0)`
const Load* moved_element(const Program& program, NodeId id, VariableId variable) {
    const auto* select = std::get_if<Select>(&program[id].form);
    if (!select || !is_zero(program, select->else_value)) return nullptr;
    const Buffer* const is_there = table_at(program, select->condition, variable);
    const auto* load = std::get_if<Load>(&program[select->then_value].form);
    if (!is_there || !load || load->indices.empty() ||
        program[load->buffer].storage != Storage::State)
        return nullptr;
    const Buffer* const behind = table_at(program, load->indices.back(), variable);
    if (!behind) return nullptr;
    const auto are_there = is_there->values.dense();
    const auto places = behind->values.dense();
    for (std::size_t place = 0; place < are_there.size(); ++place) {
        const bool has_next = place + 1 < are_there.size();
        if (std::get<bool>(are_there[place]) != has_next) return nullptr;
        if (has_next &&
            std::get<std::int64_t>(places[place]) != static_cast<std::int64_t>(place) + 1)
            return nullptr;
    }
    return load;
}

// `select(TIME[t] == value, term, 0.0)`
std::optional<PlacedTerm> placed_term(const Program& program, NodeId id, VariableId variable) {
    const auto* select = std::get_if<Select>(&program[id].form);
    if (!select || !is_zero(program, select->else_value)) return std::nullopt;
    const auto* equal = std::get_if<Apply>(&program[select->condition].form);
    if (!equal || equal->op != Operator::Equal ||
        program[equal->operands.front()].type != Scalar::Int)
        return std::nullopt;
    for (const bool is_behind : {false, true}) {
        const NodeId place = equal->operands[is_behind ? 1 : 0];
        const auto first = first_of_places(program, place, variable);
        if (first)
            return PlacedTerm{equal->operands[is_behind ? 0 : 1], *first, select->then_value};
    }
    return std::nullopt;
}

bool uses(const Program& program, NodeId id, VariableId variable) {
    return any_node_of(program, id,
                       [&](NodeId each) { return is_index_of(program, each, variable); });
}

const Store* only_store(const Loop& loop) {
    return loop.body.size() == 1 ? std::get_if<Store>(&loop.body.front().form) : nullptr;
}

bool may_fault(const Program& program) {
    const std::vector<Properties> properties = all_properties(program);
    return std::ranges::any_of(blocks_of(program),
                               [](const Block* block) { return calls_functions(*block); }) ||
           std::ranges::any_of(roots_of(program),
                               [&](NodeId root) { return properties[root.index].may_fault; });
}

}  // namespace

std::optional<ShiftedRow> shifted_row(const Program& program, const Loop& loop) {
    const VariableId variable = loop.variable;
    const Store* const store = only_store(loop);
    if (!store || store->indices.empty() || !is_index_of(program, store->indices.back(), variable))
        return std::nullopt;
    const std::vector<NodeId>* const whole = added(program, store->value);
    if (!whole || !is_zero(program, whole->front())) return std::nullopt;
    const std::vector<NodeId>* const parts = added(program, whole->back());
    if (!parts) return std::nullopt;
    const Load* const moved = moved_element(program, parts->back(), variable);
    if (!moved) return std::nullopt;
    ShiftedRow row{store->target, moved->buffer, store->indices, parts->back(), {}};
    row.indices.pop_back();
    for (std::size_t d = 0; d < row.indices.size(); ++d)
        if (moved->indices[d] != row.indices[d] || uses(program, row.indices[d], variable))
            return std::nullopt;

    NodeId rest = parts->front();
    for (bool is_last = false; !is_last;) {
        const std::vector<NodeId>* const chain = added(program, rest);
        is_last = chain == nullptr;
        const auto term = placed_term(program, is_last ? rest : chain->back(), variable);
        if (!term || uses(program, term->value, variable) || uses(program, term->term, variable))
            return std::nullopt;
        row.terms.insert(row.terms.begin(), *term);
        if (!is_last) rest = chain->front();
    }
    return row;
}

const Loop* shifting_loop(const Definition& definition) {
    const Block* block = &definition.body;
    while (!block->empty()) {
        const auto* loop = std::get_if<Loop>(&block->back().form);
        if (!loop || loop->shifts) return loop;
        block = &loop->body;
    }
    return nullptr;
}

std::set<BufferId> read_by_shifts_alone(const Program& program) {
    std::vector<NodeId> shifts, others;
    for (const Definition& definition : program.step)
        if (const Loop* const loop = shifting_loop(definition)) {
            shifts.push_back(only_store(*loop)->value);
            const ShiftedRow row = shifted_row(program, *loop).value();
            for (const PlacedTerm& each : row.terms)
                others.insert(others.end(), {each.value, each.term});
        }
    if (shifts.empty()) return {};
    std::ranges::copy_if(roots_of(program), std::back_inserter(others), [&](NodeId root) {
        return std::ranges::find(shifts, root) == shifts.end();
    });
    std::set<BufferId> alone = buffers_read_by(program, shifts);
    for (const BufferId read : buffers_read_by(program, others)) alone.erase(read);
    std::erase_if(alone, [&](BufferId id) { return program[id].storage != Storage::Constant; });
    return alone;
}

std::set<std::string> sliding_tables(const Program& program) {
    std::set<std::string> names;
    const Program& shifting = program.moderate ? **program.moderate : program;
    if (!shifting.only_moderate) return names;
    for (const Definition& definition : shifting.step)
        if (shifting_loop(definition)) names.insert(shifting[definition.target].name);
    if (!names.empty() && may_fault(program)) names.clear();
    return names;
}

}  // namespace rddlc::ir
