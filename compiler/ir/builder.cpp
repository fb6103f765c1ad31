#include "ir/builder.hpp"

#include "ir/fold.hpp"
#include "ir/simplify.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace rddlc::ir {
namespace {

// A node as a sequence of words: equal words, equal node. Reals count by their bits.
class Key {
  public:
    explicit Key(const Node& node) {
        add(static_cast<std::uint64_t>(node.type));
        add(node.form.index());
        match(node.form, [&](const auto& form) { add(form); });
    }

    std::vector<std::uint64_t> words() && { return std::move(words_); }

  private:
    void add(std::uint64_t word) { words_.push_back(word); }
    template <class Tag>
    void add(Id<Tag> id) {
        add(std::uint64_t{id.index});
    }
    void add(const std::vector<NodeId>& ids) {
        for (NodeId id : ids) add(id);
    }
    void add(const Place& place) {
        add(place.site);
        add(place.index);
    }
    void add(const Constant& form) {
        match(
            form.value, [&](double v) { add(std::bit_cast<std::uint64_t>(v)); },
            [&](auto v) { add(static_cast<std::uint64_t>(v)); });
    }
    void add(const Index& form) { add(form.variable); }
    void add(const Search& form) {
        add(form.table);
        add(form.value);
    }
    void add(const Bits& form) {
        add(form.buffer);
        add(static_cast<std::uint64_t>(form.first));
        add(form.indices);
    }
    void add(const Union& form) {
        add(form.masks);
        add(form.row);
        add(form.bits);
    }
    void add(const Element& form) {
        add(form.buffer);
        add(form.place);
        add(form.indices);
    }
    void add(const Load& form) {
        add(form.buffer);
        add(form.indices);
        add(static_cast<std::uint64_t>(form.gather));
    }
    void add(const Local& form) { add(form.local); }
    void add(const Convert& form) {
        add(form.operand);
        add(std::uint64_t{form.skips_int});
    }
    void add(const Apply& form) {
        add(static_cast<std::uint64_t>(form.op));
        add(form.operands);
        if (form.place) add(*form.place);
    }
    void add(const Select& form) {
        add(std::vector{form.condition, form.then_value, form.else_value});
        add(static_cast<std::uint64_t>(form.evaluated));
    }
    void add(const Reduce& form) {
        add(static_cast<std::uint64_t>(form.op));
        add(form.variable);
        add(form.body);
        if (form.bounds) add(std::vector{form.bounds->begin, form.bounds->end});
        add(std::uint64_t{form.over_true});
        add(std::uint64_t{form.several_at_once});
    }
    void add(const Sample& form) {
        add(static_cast<std::uint64_t>(form.distribution));
        add(form.place);
        add(form.parameters);
        add(std::uint64_t{form.is_valid});
    }
    void add(const Discrete& form) {
        add(std::uint64_t{form.normalise});
        add(form.place);
        add(form.weights);
    }
    void add(const DiscreteOver& form) {
        add(std::uint64_t{form.normalise});
        add(form.place);
        add(form.variable);
        add(form.weight);
    }
    void add(const Interval& form) {
        add(form.place);
        add(form.table);
        add(form.row);
    }
    void add(const Fault& form) { add(form.place); }

    std::vector<std::uint64_t> words_;
};

// The constants behind the ids, if all are constants.
std::optional<std::vector<Value>> constants(const Program& program,
                                            const std::vector<NodeId>& ids) {
    std::vector<Value> values;
    for (NodeId id : ids) {
        const auto* constant = std::get_if<Constant>(&program[id].form);
        if (!constant) return std::nullopt;
        values.push_back(constant->value);
    }
    return values;
}

std::int64_t row_major(const Buffer& buffer, const std::vector<Value>& indices) {
    std::int64_t offset = 0;
    for (std::size_t axis = 0; axis < indices.size(); ++axis) {
        offset = offset * buffer.shape[axis] + std::get<std::int64_t>(indices[axis]);
    }
    return offset;
}

Scalar result_type(Operator op, Scalar operand) {
    if (op >= Operator::Equal && op <= Operator::Equivalent) return Scalar::Bool;
    if (op >= Operator::Sign && op <= Operator::Ceil) return Scalar::Int;
    return operand;
}

Scalar result_type(Reduction op, Scalar body) {
    return op == Reduction::ArgMin || op == Reduction::ArgMax ? Scalar::Int : body;
}

bool is_argument(Reduction op) {
    return op == Reduction::ArgMin || op == Reduction::ArgMax;
}

// The same value however often it is combined with itself.
bool is_idempotent(Reduction op) {
    return op != Reduction::Sum && op != Reduction::Product && !is_argument(op);
}

bool contains(const std::vector<VariableId>& sorted, VariableId variable) {
    return std::binary_search(sorted.begin(), sorted.end(), variable);
}

}  // namespace

std::size_t Builder::HashOfWords::operator()(const std::vector<std::uint64_t>& words) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : words) {
        hash = (hash ^ word) * 0x9e3779b97f4a7c15;  // of Fibonacci hashing
        hash ^= hash >> 32;
    }
    return hash;
}

Builder::Builder(Program& program)
    : program_(program), properties_(all_properties(program)), new_tables_(program) {
    known_.reserve(program.nodes.size());
    for (std::uint32_t index = 0; index < program.nodes.size(); ++index) {
        known_.emplace(Key(program.nodes[index]).words(), NodeId{index});
    }
}

NodeId Builder::intern(Node node) {
    const NodeId next{static_cast<std::uint32_t>(program_.nodes.size())};
    const auto [entry, is_new] = known_.emplace(Key(node).words(), next);
    if (is_new) {
        properties_.push_back(properties_of(program_, node, properties_, table_properties_));
        program_.nodes.push_back(std::move(node));
    }
    return entry->second;
}

NodeId Builder::constant(Value value) {
    const double* real = std::get_if<double>(&value);
    if (real && *real != *real) value = std::numeric_limits<double>::quiet_NaN();
    return intern({scalar_of(value), Constant{value}});
}

NodeId Builder::index(VariableId variable) {
    if (program_[variable].size == 1) return constant(std::int64_t{0});
    return intern({Scalar::Int, Index{variable}});
}

NodeId Builder::load(BufferId id, std::vector<NodeId> indices, Gather gather) {
    const Buffer& buffer = program_[id];
    if (buffer.storage == Storage::Constant) {
        const auto known = constants(program_, indices);
        if (known) return constant(buffer.values[row_major(buffer, *known)]);
    }
    return intern({buffer.scalar, Load{id, std::move(indices), gather}});
}

NodeId Builder::search(BufferId table, NodeId value) {
    if (const auto* known = std::get_if<Constant>(&program_[value].form)) {
        return constant(count_at_most(program_[table].values, known->value));
    }
    return intern({Scalar::Int, Search{table, value}});
}

NodeId Builder::bits(BufferId buffer, std::int64_t first, std::vector<NodeId> indices) {
    return intern({Scalar::Int, Bits{buffer, first, std::move(indices)}});
}

NodeId Builder::united(BufferId masks, std::vector<NodeId> row, NodeId bits) {
    return intern({Scalar::Int, Union{masks, std::move(row), bits}});
}

NodeId Builder::element(BufferId buffer, NodeId place, std::vector<NodeId> indices) {
    return intern({Scalar::Bool, Element{buffer, place, std::move(indices)}});
}

NodeId Builder::local(LocalId id, Scalar type) {
    return intern({type, Local{id}});
}

NodeId Builder::convert(NodeId operand, Scalar type, bool skips_int) {
    const Node& node = program_[operand];
    if (node.type == type) return operand;
    if (const auto* form = std::get_if<Constant>(&node.form)) {
        return constant(ir::convert(form->value, type));
    }
    // bool -> int -> real is bool -> real.
    if (const auto* inner = std::get_if<Convert>(&node.form)) {
        return intern({type, Convert{inner->operand}});
    }
    if (const auto* choice = std::get_if<Select>(&node.form)) {
        const auto [condition, then_value, else_value, evaluated] = *choice;
        if (constants(program_, {then_value, else_value}))
            return select(condition, convert(then_value, type), convert(else_value, type),
                          evaluated);
    }
    return intern({type, Convert{operand, skips_int}});
}

NodeId Builder::apply(Operator op, std::vector<NodeId> operands, std::optional<Place> place) {
    if (const auto values = constants(program_, operands)) {
        if (const auto value = fold(op, *values)) return constant(*value);
    }
    if (const auto simpler = simplify(*this, op, operands)) return *simpler;
    const Scalar type = result_type(op, program_[operands.front()].type);
    return intern({type, Apply{op, std::move(operands), place}});
}

NodeId Builder::select(NodeId condition, NodeId then_value, NodeId else_value,
                       Evaluated evaluated) {
    if (const auto simpler = simplify_select(*this, condition, then_value, else_value)) {
        return *simpler;
    }
    return intern(
        {program_[then_value].type, Select{condition, then_value, else_value, evaluated}});
}

NodeId Builder::reduce(Reduction op, VariableId variable, NodeId body, std::optional<Bounds> bounds,
                       bool over_true, bool several_at_once) {
    const Scalar type = result_type(op, program_[body].type);
    const std::int64_t size = program_[variable].size;
    if (op == Reduction::Sum) body = without_zero(program_, body);  // it begins with 0.0
    if (size == 0 || (bounds && bounds->begin == bounds->end)) {
        if (const auto value = fold_empty(op, type)) return constant(*value);
    }
    if (bounds) return intern({type, Reduce{op, variable, body, bounds}});
    if (const auto* form = std::get_if<Constant>(&program_[body].form)) {
        if (const auto value = fold(op, size, form->value)) return constant(*value);
    }
    const bool fixed = !contains(properties(body).free_variables, variable);
    if (fixed && is_idempotent(op)) return body;
    if (size == 1 && !is_argument(op)) return aggregated(op, body);
    if (fixed && is_argument(op) && is_droppable(properties(body)))
        return constant(std::int64_t{0});
    return intern({type, Reduce{op, variable, body, {}, over_true, several_at_once}});
}

NodeId Builder::aggregated(Reduction op, NodeId terms) {
    if (op != Reduction::Sum || program_[terms].type != Scalar::Real) return terms;
    return apply(Operator::Add, {constant(0.0), terms});
}

NodeId Builder::sample(Scalar type, Distribution distribution, Place place,
                       std::vector<NodeId> parameters, bool is_valid) {
    return intern({type, Sample{distribution, place, std::move(parameters), is_valid}});
}

NodeId Builder::discrete(bool normalise, Place place, std::vector<NodeId> weights) {
    return intern({Scalar::Int, Discrete{normalise, place, std::move(weights)}});
}

NodeId Builder::discrete_over(bool normalise, Place place, VariableId variable, NodeId weight) {
    return intern({Scalar::Int, DiscreteOver{normalise, place, variable, weight}});
}

NodeId Builder::interval(Place place, BufferId table, std::vector<NodeId> row) {
    return intern({Scalar::Int, Interval{place, table, std::move(row)}});
}

NodeId Builder::fault(Scalar type, Place place) {
    return intern({type, Fault{place}});
}

NodeId Builder::rebuild(const Node& node) {
    return match(
        node.form, [&](const Constant& form) { return constant(form.value); },
        [&](const Index& form) { return index(form.variable); },
        [&](const Load& form) { return load(form.buffer, form.indices, form.gather); },
        [&](const Search& form) { return search(form.table, form.value); },
        [&](const Bits& form) { return bits(form.buffer, form.first, form.indices); },
        [&](const Union& form) { return united(form.masks, form.row, form.bits); },
        [&](const Element& form) { return element(form.buffer, form.place, form.indices); },
        [&](const Local& form) { return local(form.local, node.type); },
        [&](const Convert& form) { return convert(form.operand, node.type, form.skips_int); },
        [&](const Apply& form) { return apply(form.op, form.operands, form.place); },
        [&](const Select& form) {
            return select(form.condition, form.then_value, form.else_value, form.evaluated);
        },
        [&](const Reduce& form) {
            return reduce(form.op, form.variable, form.body, form.bounds, form.over_true,
                          form.several_at_once);
        },
        [&](const Sample& form) {
            return sample(node.type, form.distribution, form.place, form.parameters, form.is_valid);
        },
        [&](const Discrete& form) { return discrete(form.normalise, form.place, form.weights); },
        [&](const DiscreteOver& form) {
            return discrete_over(form.normalise, form.place, form.variable, form.weight);
        },
        [&](const Interval& form) { return interval(form.place, form.table, form.row); },
        [&](const Fault& form) { return fault(node.type, form.place); });
}

}  // namespace rddlc::ir
