#include "passes/arithmetic/byte_ints.hpp"

#include "ir/analysis.hpp"
#include "ir/lane_count.hpp"
#include "ir/table_properties.hpp"
#include "passes/arithmetic/find_ranges.hpp"
#include "support/match.hpp"
#include "vocabulary/range.hpp"
#include "vocabulary/vocabulary.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

constexpr Range byte{-128, 127};
constexpr std::int64_t most_bools = 7;  // of a word that is a byte

bool is_within(const Range& inner, const Range& outer) {
    return inner.lower >= outer.lower && inner.upper <= outer.upper;
}

bool is_number(const ir::Fluent& fluent, Role role) {
    return fluent.role == role && fluent.scalar == ir::Scalar::Int && !fluent.object_type;
}

// The bounds of all elements.
Range bounds_of(const ir::Fluent& fluent) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (fluent.lower->empty()) return {-infinity, infinity};
    return {std::ranges::min(*fluent.lower), std::ranges::max(*fluent.upper)};
}

// Gives the ints of the state their bounds, and what the step computes its ranges, if the bounds
// are those of bytes and hold in the initial state.
bool enter_bounds(ir::Program& program) {
    for (const ir::Fluent& fluent : program.fluents) {
        if (!is_number(fluent, Role::State)) continue;
        const Range bounds = bounds_of(fluent);
        if (!is_within(bounds, byte)) return false;
        if (!fluent.buffer) continue;
        ir::Buffer& buffer = program.buffers[fluent.buffer->index];
        const auto initial = ir::range_of(buffer.values);
        if (!initial || !is_within(*initial, bounds)) return false;
        buffer.range = bounds;
    }
    Report unused;
    program = find_ranges(std::move(program), unused);
    return true;
}

// Conditions are also evaluated where the state has left its bounds, so that the episode ends.
bool enter_next_states(ir::Program& program) {
    for (const ir::Buffer& next : program.buffers) {
        if (next.storage != ir::Storage::Next || next.scalar != ir::Scalar::Int) continue;
        for (ir::Buffer& state : program.buffers) {
            if (state.storage != ir::Storage::State || state.fluent != next.fluent) continue;
            if (!next.range) return false;
            if (state.range) state.range = join(*state.range, *next.range);
        }
    }
    return true;
}

// The powers of two that bound both also bound what bit operations make of them.
Range range_of_bits(const Range& a, const Range& b) {
    const double least = std::min(a.lower, b.lower), greatest = std::max(a.upper, b.upper);
    double limit = 1;
    while (least < -limit || greatest >= limit) limit *= 2;
    return {least < 0 ? -limit : 0, limit - 1};
}
std::optional<Range> range_of_bits(const ir::Program& program, const ir::Bits& bits) {
    const std::int64_t count = program[bits.buffer].row_size(bits.indices.size()) - bits.first;
    if (count > most_bools) return std::nullopt;
    return Range{0, static_cast<double>((1 << count) - 1)};
}
std::optional<Range> range_of_bits(const std::vector<ir::Properties>& properties,
                                   const ir::Apply& apply) {
    if (!is_one_of(apply.op, {Operator::BitAnd, Operator::BitOr, Operator::BitXor}))
        return std::nullopt;
    const auto& a = properties[apply.operands[0].index].range;
    const auto& b = properties[apply.operands[1].index].range;
    if (a && b && is_within(*a, byte) && is_within(*b, byte)) return range_of_bits(*a, *b);
    return std::nullopt;
}

// Nothing if the value of a name comes later than where it is read.
std::optional<Range> range_of(const std::vector<ir::Properties>& properties,
                              const std::map<ir::LocalId, ir::NodeId>& values, ir::LocalId local) {
    const auto value = values.find(local);
    if (value == values.end() || value->second.index >= properties.size()) return std::nullopt;
    return properties[value->second.index].range;
}

// As all_properties, with ranges of words of few bools and of names too.
std::vector<ir::Properties> properties_with_bits(const ir::Program& program) {
    std::map<ir::LocalId, ir::NodeId> values;
    for (const ir::Block* block : ir::blocks_of(program))
        ir::for_each_statement<ir::Let>(
            *block, [&](const ir::Let& let) { values.emplace(let.local, let.value); });
    ir::TableProperties tables;
    std::vector<ir::Properties> all;
    all.reserve(program.nodes.size());
    for (const ir::Node& node : program.nodes) {
        ir::Properties own = ir::properties_of(program, node, all, tables);
        if (node.type == ir::Scalar::Int && !own.range)
            own.range = match(
                node.form, [&](const ir::Bits& bits) { return range_of_bits(program, bits); },
                [&](const ir::Apply& apply) { return range_of_bits(all, apply); },
                [&](const ir::Local& local) { return range_of(all, values, local.local); },
                [](const auto&) { return std::optional<Range>(); });
        all.push_back(std::move(own));
    }
    return all;
}

// Whether what is evaluated below some nodes can be evaluated with byte ints.
class ByteInts {
  public:
    explicit ByteInts(const ir::Program& program)
        : program_(program),
          properties_(properties_with_bits(program)),
          words_gain_(ir::suitable_lane_count(program) == ir::suitable_lane_counts.back()) {}

    bool are_enough_for(const std::vector<ir::NodeId>& roots) {
        return std::ranges::all_of(roots, [&](ir::NodeId root) { return are_enough_below(root); });
    }
    bool has_ints() const { return has_ints_; }

  private:
    bool are_enough_below(ir::NodeId id) {
        if (!visited_.insert(id).second) return true;
        const ir::Node& node = program_[id];
        return (is_uniform(id) || are_enough(id, node)) && are_enough_for(ir::operands_of(node));
    }

    // For a value that differs between environments; the ints of which it is made are as small.
    bool are_enough(ir::NodeId id, const ir::Node& node) {
        has_ints_ |= is_int(id);
        const std::vector<ir::NodeId> operands = ir::operands_of(node);
        const auto has_int = std::ranges::any_of(operands, [&](auto k) { return is_int(k); });
        if (!is_int(id) && !has_int) return true;
        if (is_int(id) && !fits(id)) return false;
        const auto all_fit = [&] {
            return std::ranges::all_of(operands, [&](auto k) { return !is_int(k) || fits(k); });
        };
        return match(
            node.form,
            [&](const ir::Load& load) {
                return std::ranges::all_of(load.indices, [&](auto k) {
                    return is_uniform(k) || (fits(k) && has_bytes_as_indices(load));
                });
            },
            [&](const ir::Bits&) { return words_gain_; },
            [&](const ir::Element& element) {
                return is_uniform(element.place) &&
                       std::ranges::all_of(element.indices, [&](auto k) { return is_uniform(k); });
            },
            [](const ir::Local&) { return true; }, [&](const ir::Convert&) { return all_fit(); },
            [&](const ir::Select&) { return all_fit(); },
            [&](const ir::Apply& apply) { return has_form_for_bytes(apply.op) && all_fit(); },
            [&](const ir::Reduce& reduce) {
                return is_one_of(reduce.op, {Reduction::Sum, Reduction::Minimum, Reduction::Maximum,
                                             Reduction::ForAll, Reduction::Exists});
            },
            [&](const ir::Sample& sample) {
                return sample.distribution == Distribution::Bernoulli;
            },
            [](const auto&) { return false; });
    }
    // Byte ints of tables that are not constant are not gathered.
    bool has_bytes_as_indices(const ir::Load& load) const {
        const ir::Buffer& buffer = program_[load.buffer];
        const bool is_gathered =
            buffer.storage == ir::Storage::Constant || buffer.scalar != ir::Scalar::Int;
        return words_gain_ && is_gathered;
    }
    static bool has_form_for_bytes(Operator op) {
        return is_one_of(
            op, {Operator::Add, Operator::Subtract, Operator::Negate, Operator::Minimum,
                 Operator::Maximum, Operator::Equal, Operator::NotEqual, Operator::Less,
                 Operator::LessEqual, Operator::Greater, Operator::GreaterEqual, Operator::BitAnd,
                 Operator::BitOr, Operator::BitXor, Operator::CountOnes});
    }

    bool is_int(ir::NodeId id) const { return program_[id].type == ir::Scalar::Int; }
    bool is_uniform(ir::NodeId id) const { return properties_[id.index].uniform; }
    bool fits(ir::NodeId id) const {
        const auto& range = properties_[id.index].range;
        return range && is_within(*range, byte);
    }

    const ir::Program& program_;
    std::vector<ir::Properties> properties_;
    // Smaller packs have words in narrow lanes (ir/narrow_bits.hpp), and skip more draws.
    bool words_gain_;
    std::set<ir::NodeId> visited_;
    bool has_ints_ = false;
};

template <class Items, class Roots>
void append_roots(const Items& items, Roots& roots) {
    for (const auto& item : items)
        for (const ir::NodeId root : ir::roots_of(item)) roots.push_back(root);
}

std::vector<ir::NodeId> roots_of_step(const ir::Program& program) {
    std::vector<ir::NodeId> roots = ir::roots_of(program.reward);
    for (const ir::Definition& definition : program.step) append_roots(definition.body, roots);
    return roots;
}
std::vector<ir::NodeId> roots_of_conditions(const ir::Program& program) {
    std::vector<ir::NodeId> roots;
    append_roots(program.preconditions, roots);
    append_roots(program.invariants, roots);
    append_roots(program.terminations, roots);
    return roots;
}

}  // namespace

bool has_byte_ints(const ir::Program& program) {
    const bool has_numbers_from_callers = std::ranges::any_of(
        program.fluents, [](const ir::Fluent& fluent) { return is_number(fluent, Role::Action); });
    // Packs count the preconditions too.
    const bool are_too_many = static_cast<double>(program.preconditions.size()) > byte.upper;
    if (has_numbers_from_callers || are_too_many || program.moderate || !program.reset.empty())
        return false;
    ir::Program bounded = program;
    if (!enter_bounds(bounded)) return false;
    ByteInts in_steps(bounded);
    if (!in_steps.are_enough_for(roots_of_step(bounded)) || !enter_next_states(bounded))
        return false;
    ByteInts in_conditions(bounded);
    return in_conditions.are_enough_for(roots_of_conditions(bounded)) &&
           (in_steps.has_ints() || in_conditions.has_ints());
}

}  // namespace rddlc::passes
