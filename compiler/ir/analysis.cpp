// Over 400 lines: one traversal and the questions about its results.
#include "ir/analysis.hpp"

#include "ir/cost_model.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace rddlc::ir {
namespace {

// Joins what is known of operands into what is known of their user.
class Collector {
  public:
    Collector(const Program& program, std::span<const Properties> known, TableProperties& tables)
        : program_(program), known_(known), tables_(tables) {}

    Properties properties_of(const Node& node) {
        const std::vector<NodeId> operands = operands_of(node);
        for (NodeId operand : operands) add(known_[operand.index]);
        if (const auto variable = bound_variable(node))
            bind(*variable, operands.front(), repetitions(program_, node));
        properties_.cost += own_cost(program_, node);
        match(node.form, [&](const auto& form) { describe(node.type, form); });
        properties_.finite = node.type != Scalar::Real ||
                             (properties_.range && is_finite(*properties_.range)) ||
                             (program_.assumes_finite && !is_fixed(node));
        properties_.never_negative_zero =
            node.type != Scalar::Real || excludes_zero(properties_.range) ||
            match(node.form, [&](const auto& form) { return is_never_negative_zero(form); });
        return std::move(properties_);
    }

  private:
    void add(const Properties& operand) {
        properties_.may_fault |= operand.may_fault;
        properties_.random |= operand.random;
        properties_.uniform &= operand.uniform;
        properties_.elementary |= operand.elementary;
        properties_.cost += operand.cost;
        std::vector<VariableId> merged;
        std::set_union(properties_.free_variables.begin(), properties_.free_variables.end(),
                       operand.free_variables.begin(), operand.free_variables.end(),
                       std::back_inserter(merged));
        properties_.free_variables = std::move(merged);
    }

    // Its values are known, inf and nan among them.
    bool is_fixed(const Node& node) const {
        const auto* load = std::get_if<Load>(&node.form);
        return std::holds_alternative<Constant>(node.form) || (load && is_constant(load->buffer));
    }

    void describe(Scalar, const Constant& constant) {
        properties_.range = range_of(Table{constant.value});
    }

    void describe(Scalar, const Index& index) {
        properties_.free_variables = {index.variable};
        const auto last = static_cast<double>(program_[index.variable].size - 1);
        if (last >= 0) properties_.range = Range{0, last};
    }

    void describe(Scalar, const Load& load) {
        const Buffer& buffer = program_[load.buffer];
        properties_.uniform &= is_constant(load.buffer);
        properties_.range = is_constant(load.buffer) ? tables_.range(program_, load.buffer)
                            : buffer.range           ? buffer.range
                                                     : object_range(buffer);
    }

    // The range of a fluent whose values are objects.
    std::optional<Range> object_range(const Buffer& buffer) const {
        if (!buffer.fluent) return std::nullopt;
        const auto type = program_.fluents[*buffer.fluent].object_type;
        if (!type) return std::nullopt;
        return Range{0, static_cast<double>(program_.types[*type].objects.size()) - 1};
    }

    void describe(Scalar, const Search& search) {
        const auto size = static_cast<double>(program_[search.table].count());
        properties_.range = Range{0, size};
    }

    void describe(Scalar, const Bits&) { properties_.uniform = false; }

    void describe(Scalar, const Union&) {}

    void describe(Scalar, const Element&) {
        properties_.uniform = false;
        properties_.range = Range{0, 1};
    }

    void describe(Scalar type, const Local&) {
        properties_.uniform = false;
        if (type == Scalar::Bool) properties_.range = Range{0, 1};
    }

    void describe(Scalar type, const Convert& convert) {
        const bool is_bool = program_[convert.operand].type == Scalar::Bool;
        properties_.range = is_bool ? Range{0, 1} : range(convert.operand);
        if (!properties_.range && type == Scalar::Real)
            properties_.range = range_of_product(convert.operand).value_or(any_int);
    }

    // A product of ints as a real. The int itself has no range, or it would be taken for a count.
    std::optional<Range> range_of_product(NodeId id) const {
        const auto* product = std::get_if<Apply>(&program_[id].form);
        if (!product || product->op != Operator::Multiply) return std::nullopt;
        const auto range = exact_range(*product, std::array{this->range(product->operands[0]),
                                                            this->range(product->operands[1])});
        if (!range) return std::nullopt;
        return Range{std::ceil(range->lower), std::floor(range->upper)};
    }

    void describe(Scalar type, const Apply& apply) {
        properties_.elementary |= apply.op == Operator::Sqrt || is_elementary(apply.op);
        std::vector<std::optional<Range>> ranges;
        for (NodeId operand : apply.operands) ranges.push_back(range(operand));
        if (type == Scalar::Real) properties_.range = range_of(apply.op, ranges);
        if (properties_.range && is_square(apply))
            properties_.range->lower = std::max(properties_.range->lower, 0.0);
        if (type == Scalar::Bool) properties_.range = Range{0, 1};
        if (type == Scalar::Int) properties_.range = range_of_ints(apply, ranges);
        if (apply.place) properties_.may_fault |= !always_defined(apply.op, ranges);
    }

    bool is_square(const Apply& apply) const {
        return apply.op == Operator::Multiply && apply.operands[0] == apply.operands[1];
    }

    std::optional<Range> range_of_ints(const Apply& apply,
                                       std::span<const std::optional<Range>> operands) const {
        if (apply.op == Operator::CountOnes) return Range{0, most_ones(apply.operands.front())};
        const bool has_range =
            is_one_of(apply.op, {Operator::Add, Operator::Subtract, Operator::Negate,
                                 Operator::Minimum, Operator::Maximum});
        return has_range ? exact_range(apply, operands) : std::nullopt;
    }
    // Where no result wraps around.
    static std::optional<Range> exact_range(const Apply& apply,
                                            std::span<const std::optional<Range>> operands) {
        const auto range = range_of(apply.op, operands);
        const bool is_exact = range && range->lower > -exact_ints && range->upper < exact_ints;
        return is_exact ? range : std::nullopt;
    }

    // The most bits that may be 1.
    double most_ones(NodeId id) const {
        const auto ones = [](const Value& value) {
            return static_cast<double>(
                std::popcount(static_cast<std::uint64_t>(std::get<std::int64_t>(value))));
        };
        return match(
            program_[id].form, [&](const Constant& constant) { return ones(constant.value); },
            [&](const Bits& bits) {
                return static_cast<double>(std::min<std::int64_t>(
                    64, program_[bits.buffer].row_size(bits.indices.size()) - bits.first));
            },
            [&](const Load& load) {
                return is_constant(load.buffer) ? tables_.most_ones(program_, load.buffer) : 64.0;
            },
            [&](const Apply& apply) {
                if (apply.op != Operator::BitAnd) return 64.0;
                return std::min(most_ones(apply.operands[0]), most_ones(apply.operands[1]));
            },
            [](const auto&) { return 64.0; });
    }

    void describe(Scalar, const Select& select) {
        const auto a =
            is_guarded_product(program_, select) ? Range{0, 0} : range(select.then_value);
        const auto b = range(select.else_value);
        if (a && b) properties_.range = join(*a, *b);
    }

    void describe(Scalar, const Reduce& reduce) {
        const std::int64_t size = program_[reduce.variable].size;
        if (reduce.op == Reduction::ArgMin || reduce.op == Reduction::ArgMax)
            properties_.range = Range{0, static_cast<double>(size - 1)};
        if (reduce.op == Reduction::Sum && program_[reduce.body].type == Scalar::Int)
            properties_.range = range_of_sum(reduce);
        const auto& body = range(reduce.body);
        if (reduce.op == Reduction::Minimum || reduce.op == Reduction::Maximum)
            properties_.range = body;
        if (program_[reduce.body].type != Scalar::Real || !body) return;
        const auto count = static_cast<double>(size);
        if (reduce.op == Reduction::Sum) properties_.range = rddlc::range_of_sum(*body, count);
        if (reduce.op == Reduction::Product)
            properties_.range = rddlc::range_of_product(*body, count);
    }

    std::optional<Range> range_of_sum(const Reduce& sum) const {
        const auto term = range(sum.body);
        const auto count = static_cast<double>(program_[sum.variable].size);
        if (!term || count * std::max(-term->lower, term->upper) >= exact_ints) return std::nullopt;
        const double most = sum.bounds ? std::min(longest(*sum.bounds), count) : count;
        return Range{std::min(0.0, term->lower * most), std::max(0.0, term->upper * most)};
    }

    // The length of the longest row.
    double longest(const Bounds& bounds) const {
        const Load* row = row_of(program_, bounds);
        return row ? tables_.longest_row(program_, row->buffer)
                   : std::numeric_limits<double>::infinity();
    }

    void describe(Scalar, const Sample& sample) {
        std::vector<std::optional<Range>> ranges;
        for (NodeId parameter : sample.parameters) ranges.push_back(range(parameter));
        draw(!always_in_domain(sample.distribution, ranges));
        properties_.range = range_of(sample.distribution, ranges);
    }

    void describe(Scalar, const Discrete& discrete) {
        draw(true);
        properties_.range = Range{0, static_cast<double>(discrete.weights.size() - 1)};
    }

    void describe(Scalar, const DiscreteOver& discrete) {
        properties_.range = Range{0, static_cast<double>(program_[discrete.variable].size - 1)};
        draw(true);
    }

    void describe(Scalar, const Interval& interval) {
        draw(false);
        properties_.range = Range{0, static_cast<double>(program_[interval.table].shape.back())};
    }

    void describe(Scalar, const Fault&) {
        properties_.may_fault = true;
        properties_.uniform = false;
    }

    // The cost of the body is in there already, once.
    void bind(VariableId variable, NodeId body, double times) {
        std::erase(properties_.free_variables, variable);
        properties_.cost += known_[body.index].cost * (times - 1);
    }

    void draw(bool may_fault) {
        properties_.random = true;
        properties_.uniform = false;
        properties_.may_fault |= may_fault;
    }

    // ------------------------------------------------------------------- zeros and their signs

    // The sign of real zeros: an underflow gives a zero with the sign of the number that was
    // rounded.
    bool is_never_negative_zero(const Constant& constant) const {
        return !is_negative_zero(constant.value);
    }
    bool is_never_negative_zero(const Load& load) const {
        return is_constant(load.buffer) && !tables_.has_negative_zero(program_, load.buffer);
    }
    bool is_never_negative_zero(const Convert&) const { return true; }
    bool is_never_negative_zero(const Select& select) const {
        return never_negative_zero(select.then_value) && never_negative_zero(select.else_value);
    }
    // A sum begins with 0.0, and two numbers make -0.0 only if both are.
    bool is_never_negative_zero(const Reduce& reduce) const {
        if (reduce.op == Reduction::Sum) return true;
        return reduce.op == Reduction::Product ? has_no_sign(reduce.body)
                                               : never_negative_zero(reduce.body);
    }
    bool is_never_negative_zero(const Apply& apply) const {
        const NodeId a = apply.operands.front(), b = apply.operands.back();
        const Operator op = apply.op;
        if (op == Operator::Add) return never_negative_zero(a) || never_negative_zero(b);
        if (op == Operator::Subtract)  // only -0.0 - 0.0 is
            return a == b || never_negative_zero(a) || excludes_zero(range(b));
        if (op == Operator::Multiply) return a == b || (has_no_sign(a) && has_no_sign(b));
        if (op == Operator::Divide) return has_no_sign(a) && has_no_sign(b);
        if (op == Operator::Power) return has_no_sign(a);
        if (op == Operator::Sqrt) return never_negative_zero(a);
        // Equal operands give the first one.
        if (op == Operator::Minimum)
            return never_negative_zero(a) &&
                   (never_negative_zero(b) || (range(a) && range(a)->upper <= 0));
        if (op == Operator::Maximum)
            return never_negative_zero(a) &&
                   (never_negative_zero(b) || is_never_negative(range(a)));
        return is_one_of(op, {Operator::Abs, Operator::Exp, Operator::Cosh, Operator::Hypot});
    }
    template <class Form>
    bool is_never_negative_zero(const Form&) const {
        return false;
    }

    bool never_negative_zero(NodeId id) const { return known_[id.index].never_negative_zero; }
    bool has_no_sign(NodeId id) const {
        return never_negative_zero(id) && is_never_negative(range(id));
    }
    static bool is_never_negative(const std::optional<Range>& range) {
        return range && range->lower >= 0;
    }

    // Whether an operator that may fault is defined for these operands.
    static bool always_defined(Operator op, std::span<const std::optional<Range>> operands) {
        if (op == Operator::Power) return operands[1] && operands[1]->lower >= 0;
        if (op == Operator::Defined) return operands[0].has_value();
        return operands[0] && operands[0]->lower > 0;
    }

    static constexpr Range any_int{-0x1p63, 0x1p63};

    std::optional<Range> range(NodeId id) const { return known_[id.index].range; }

    bool is_constant(BufferId id) const { return program_[id].storage == Storage::Constant; }

    const Program& program_;
    std::span<const Properties> known_;
    TableProperties& tables_;
    Properties properties_;
};

void append_roots(const Block& block, std::vector<NodeId>& roots);

void append_roots(const Statement& statement, std::vector<NodeId>& roots) {
    match(
        statement.form, [&](const Let& let) { roots.push_back(let.value); },
        [&](const Store& store) {
            roots.insert(roots.end(), store.indices.begin(), store.indices.end());
            roots.push_back(store.value);
        },
        [&](const Spread& spread) {
            roots.insert(roots.end(), spread.indices.begin(), spread.indices.end());
            roots.push_back(spread.bits);
        },
        [&](const Loop& loop) { append_roots(loop.body, roots); },
        [&](const Visit& visit) {
            roots.push_back(visit.condition);
            for (const Mark& mark : visit.marks) {
                roots.insert(roots.end(), mark.indices.begin(), mark.indices.end());
                roots.push_back(mark.condition);
            }
        },
        [&](const Call& call) {
            const std::vector<NodeId> operands = operands_of(call);
            roots.insert(roots.end(), operands.begin(), operands.end());
        });
}

void append_roots(const Block& block, std::vector<NodeId>& roots) {
    for (const Statement& statement : block) append_roots(statement, roots);
}

void append_roots(const Computation& computation, std::vector<NodeId>& roots) {
    append_roots(computation.body, roots);
    roots.push_back(computation.value);
}

// Program and Definition both const, or neither.
template <class AnyDefinition, class AnyProgram>
std::vector<AnyDefinition*> definitions_in(AnyProgram& program) {
    std::vector<AnyDefinition*> definitions;
    for (auto& definition : program.reset) definitions.push_back(&definition);
    for (auto& definition : program.step) definitions.push_back(&definition);
    if (program.policy)
        for (auto& definition : program.policy->act) definitions.push_back(&definition);
    return definitions;
}

// The reward, then the conditions. Program and Computation both const, or neither.
template <class AnyComputation, class AnyProgram>
std::vector<Named<AnyComputation>> computations_in(AnyProgram& program) {
    std::vector<Named<AnyComputation>> computations{{"reward", &program.reward}};
    const auto append = [&](const char* name, auto& conditions) {
        for (auto& condition : conditions) computations.push_back({name, &condition});
    };
    append("precondition", program.preconditions);
    append("invariant", program.invariants);
    append("termination", program.terminations);
    return computations;
}

bool draws(const Block& block, const std::vector<Properties>& properties) {
    bool draws = std::ranges::any_of(roots_of(block),
                                     [&](NodeId root) { return properties[root.index].random; });
    for_each_statement<Call>(block, [&](const Call& call) { draws |= call.place.has_value(); });
    return draws;
}

bool draws(const std::vector<Definition>& definitions, const std::vector<Properties>& properties) {
    return std::ranges::any_of(definitions, [&](const Definition& definition) {
        return draws(definition.body, properties);
    });
}

}  // namespace

Properties properties_of(const Program& program, const Node& node,
                         std::span<const Properties> known, TableProperties& tables) {
    return Collector(program, known, tables).properties_of(node);
}

std::vector<Properties> all_properties(const Program& program) {
    TableProperties tables;
    std::vector<Properties> properties;
    properties.reserve(program.nodes.size());
    for (const Node& node : program.nodes)
        properties.push_back(properties_of(program, node, properties, tables));
    return properties;
}

bool is_cheap(const Properties& properties) {
    return is_droppable(properties) && properties.cost <= cheap_cost;
}

bool is_guarded_product(const Program& program, const Select& select) {
    const auto is_zero = [&](NodeId id) {
        return constant<double>(program, id) == 0.0 || constant<std::int64_t>(program, id) == 0;
    };
    const auto* test = std::get_if<Apply>(&program[select.condition].form);
    const auto* product = std::get_if<Apply>(&program[select.else_value].form);
    return test && product && test->op == Operator::Equal && product->op == Operator::Multiply &&
           std::ranges::any_of(test->operands, is_zero) &&
           std::ranges::find(test->operands, select.then_value) != test->operands.end() &&
           std::ranges::find(product->operands, select.then_value) != product->operands.end();
}

bool is_lazy(const Program& program, const Select& select, const Properties& then_properties,
             const Properties& else_properties) {
    if (is_cheap(then_properties) && is_cheap(else_properties)) return false;
    return !is_droppable(else_properties) || !is_guarded_product(program, select);
}

bool is_index_of(const Program& program, NodeId id, VariableId variable) {
    const auto* index = std::get_if<Index>(&program[id].form);
    return index && index->variable == variable;
}

bool depends_on(const Properties& properties, VariableId variable) {
    return std::ranges::binary_search(properties.free_variables, variable);
}

bool depends_on_any(const Properties& properties, std::span<const VariableId> variables) {
    return std::ranges::any_of(
        variables, [&](VariableId variable) { return depends_on(properties, variable); });
}

bool depends_on_none_but(const Properties& properties, std::span<const VariableId> variables) {
    return std::ranges::all_of(properties.free_variables, [&](VariableId variable) {
        return std::ranges::find(variables, variable) != variables.end();
    });
}

std::vector<NodeId> parts_of(const Program& program, NodeId id, Operator op) {
    const auto* apply = std::get_if<Apply>(&program[id].form);
    if (!apply || apply->op != op) return {id};
    std::vector<NodeId> all;
    for (const NodeId operand : apply->operands)
        std::ranges::copy(parts_of(program, operand, op), std::back_inserter(all));
    return all;
}

std::vector<NodeId> operands_of(const Node& node) {
    const auto with_place = [](const std::optional<Place>& place, std::vector<NodeId> operands) {
        if (place) operands.push_back(place->index);
        return operands;
    };
    return match(
        node.form, [](const Constant&) { return std::vector<NodeId>{}; },
        [](const Index&) { return std::vector<NodeId>{}; },
        [](const Local&) { return std::vector<NodeId>{}; },
        [](const Bits& bits) { return bits.indices; },
        [](const Union& form) {
            std::vector operands = form.row;
            operands.push_back(form.bits);
            return operands;
        },
        [](const Load& load) { return load.indices; },
        [](const Search& search) { return std::vector{search.value}; },
        [](const Element& element) {
            std::vector operands = element.indices;
            operands.push_back(element.place);
            return operands;
        },
        [](const Convert& convert) { return std::vector{convert.operand}; },
        [&](const Apply& apply) { return with_place(apply.place, apply.operands); },
        [](const Select& select) {
            return std::vector{select.condition, select.then_value, select.else_value};
        },
        [](const Reduce& reduce) {
            std::vector operands{reduce.body};
            if (reduce.bounds)
                operands.insert(operands.end(), {reduce.bounds->begin, reduce.bounds->end});
            return operands;
        },
        [&](const Sample& sample) { return with_place(sample.place, sample.parameters); },
        [&](const Discrete& discrete) { return with_place(discrete.place, discrete.weights); },
        [&](const DiscreteOver& discrete) { return with_place(discrete.place, {discrete.weight}); },
        [&](const Interval& interval) { return with_place(interval.place, interval.row); },
        [](const Fault& fault) { return std::vector{fault.place.index}; });
}

std::vector<const Definition*> definitions_of(const Program& program) {
    return definitions_in<const Definition>(program);
}
std::vector<Definition*> definitions_of(Program& program) {
    return definitions_in<Definition>(program);
}

std::vector<Named<const Computation>> computations_of(const Program& program) {
    return computations_in<const Computation>(program);
}
std::vector<Named<Computation>> computations_of(Program& program) {
    return computations_in<Computation>(program);
}

std::vector<const Block*> blocks_of(const Program& program) {
    std::vector<const Block*> blocks;
    for (const Definition* definition : definitions_of(program))
        blocks.push_back(&definition->body);
    for (const auto& [name, computation] : computations_of(program))
        blocks.push_back(&computation->body);
    return blocks;
}

bool fills_tables(const Block& block) {
    return !buffers_filled_by(block).empty();
}

std::set<BufferId> buffers_filled_by(const Block& block) {
    std::set<BufferId> filled;
    for_each_statement<Store>(block, [&](const Store& store) { filled.insert(store.target); });
    for_each_statement<Spread>(block, [&](const Spread& spread) { filled.insert(spread.target); });
    for_each_statement<Visit>(block, [&](const Visit& visit) {
        for (const Mark& mark : visit.marks) filled.insert(mark.target);
    });
    for_each_statement<Call>(block, [&](const Call& call) { filled.insert(call.output.buffer); });
    return filled;
}

std::set<BufferId> buffers_read_by(const Program& program, const std::vector<NodeId>& roots) {
    std::set<BufferId> read;
    std::set<NodeId> seen;
    std::vector<NodeId> open = roots;
    while (!open.empty()) {
        const NodeId id = open.back();
        open.pop_back();
        if (!seen.insert(id).second) continue;
        if (const auto buffer = buffer_read_by(program[id])) read.insert(*buffer);
        const std::vector<NodeId> operands = operands_of(program[id]);
        open.insert(open.end(), operands.begin(), operands.end());
    }
    return read;
}

bool calls_functions(const Block& block) {
    bool calls = false;
    for_each_statement<Call>(
        block, [&](const Call& call) { calls |= !std::holds_alternative<Together>(call.callee); });
    return calls;
}

std::vector<NodeId> operands_of(const Call& call) {
    std::vector<NodeId> operands;
    const auto add = [&](const std::vector<NodeId>& ids) {
        operands.insert(operands.end(), ids.begin(), ids.end());
    };
    for (const TableView& input : call.inputs) add(input.indices);
    add(call.scalars);
    add(call.output.indices);
    if (call.place) operands.push_back(call.place->index);
    return operands;
}

std::optional<BufferId> buffer_read_by(const Node& node) {
    return match(
        node.form, [](const Load& load) { return std::optional(load.buffer); },
        [](const Search& search) { return std::optional(search.table); },
        [](const Bits& bits) { return std::optional(bits.buffer); },
        [](const Union& form) { return std::optional(form.masks); },
        [](const Interval& interval) { return std::optional(interval.table); },
        [](const Element& element) { return std::optional(element.buffer); },
        [](const auto&) { return std::optional<BufferId>(); });
}

bool reads(const Program& program, NodeId id, BufferId buffer) {
    return any_node_of(program, id,
                       [&](NodeId each) { return buffer_read_by(program[each]) == buffer; });
}

std::optional<NodeId> only_bernoulli(const Program& program, NodeId id) {
    std::optional<NodeId> only;
    const bool has_others = any_node_of(program, id, [&](NodeId each) {
        const Node& node = program[each];
        if (std::holds_alternative<Apply>(node.form) || !place_of(node)) return false;
        const auto* sample = std::get_if<Sample>(&node.form);
        return !sample || sample->distribution != Distribution::Bernoulli ||
               std::exchange(only, each).value_or(each) != each;
    });
    return has_others ? std::nullopt : only;
}

std::optional<NodeId> converted_bool(const Program& program, NodeId id) {
    const auto* convert = std::get_if<Convert>(&program[id].form);
    if (!convert || program[convert->operand].type != Scalar::Bool) return std::nullopt;
    return convert->operand;
}

std::optional<Place> place_of(const Node& node) {
    return match(
        node.form, [](const Apply& apply) { return apply.place; },
        [](const Sample& sample) { return std::optional(sample.place); },
        [](const Discrete& discrete) { return std::optional(discrete.place); },
        [](const DiscreteOver& discrete) { return std::optional(discrete.place); },
        [](const Interval& interval) { return std::optional(interval.place); },
        [](const Fault& fault) { return std::optional(fault.place); },
        [](const auto&) { return std::optional<Place>(); });
}

const Load* row_of(const Program& program, const Bounds& bounds) {
    const auto* begin = std::get_if<Load>(&program[bounds.begin].form);
    const auto* end = std::get_if<Load>(&program[bounds.end].form);
    if (!begin || !end || begin->buffer != end->buffer || begin->indices.size() != 1)
        return nullptr;
    const auto* next = std::get_if<Apply>(&program[end->indices.front()].form);
    if (!next || next->op != Operator::Add || next->operands.front() != begin->indices.front())
        return nullptr;
    const auto* one = std::get_if<Constant>(&program[next->operands.back()].form);
    return one && one->value == Value(std::int64_t{1}) ? begin : nullptr;
}

std::optional<VariableId> bound_variable(const Node& node) {
    if (const auto* reduce = std::get_if<Reduce>(&node.form)) return reduce->variable;
    if (const auto* discrete = std::get_if<DiscreteOver>(&node.form)) return discrete->variable;
    return std::nullopt;
}

std::vector<NodeId> roots_of(const Statement& statement) {
    std::vector<NodeId> roots;
    append_roots(statement, roots);
    return roots;
}

std::vector<NodeId> roots_of(const Block& block) {
    std::vector<NodeId> roots;
    append_roots(block, roots);
    return roots;
}

std::vector<NodeId> roots_of(const Computation& computation) {
    std::vector<NodeId> roots;
    append_roots(computation, roots);
    return roots;
}

std::vector<NodeId> roots_of(const Program& program) {
    std::vector<NodeId> roots;
    for (const Definition* definition : definitions_of(program))
        append_roots(definition->body, roots);
    for (const auto& [name, computation] : computations_of(program))
        append_roots(*computation, roots);
    return roots;
}

std::vector<bool> reachable_nodes(const Program& program) {
    std::vector<bool> reachable(program.nodes.size(), false);
    for (NodeId root : roots_of(program)) reachable[root.index] = true;
    for (std::size_t index = program.nodes.size(); index-- > 0;) {
        if (!reachable[index]) continue;
        for (NodeId operand : operands_of(program.nodes[index])) reachable[operand.index] = true;
    }
    return reachable;
}

std::vector<BufferId> reals_taken_for_moderate(const Program& program) {
    std::vector<BufferId> found;
    for (std::uint32_t index = 0; index < program.buffers.size(); ++index) {
        const Buffer& buffer = program.buffers[index];
        const bool is_from_outside =
            buffer.storage == Storage::State || buffer.storage == Storage::Action;
        if (is_from_outside && buffer.range) found.push_back({index});
    }
    return found;
}

bool is_stochastic(const Program& program) {
    const std::vector<Properties> properties = all_properties(program);
    const auto is_random = [&](const Computation& computation) {
        return draws(computation.body, properties) || properties[computation.value.index].random;
    };
    return draws(program.reset, properties) || draws(program.step, properties) ||
           is_random(program.reward) || std::ranges::any_of(program.preconditions, is_random) ||
           std::ranges::any_of(program.invariants, is_random) ||
           std::ranges::any_of(program.terminations, is_random);
}

bool is_policy_stochastic(const Program& program) {
    return program.policy && draws(program.policy->act, all_properties(program));
}

}  // namespace rddlc::ir
