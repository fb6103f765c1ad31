#include "passes/aggregations/value_counts.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <vector>

namespace rddlc::passes {
namespace {

constexpr int usable_bits = 63;  // the sign stays 0

ir::NodeId look_up(ir::Builder& builder, const ValueCounts& counts, ir::NodeId value,
                   std::int64_t entry_of_least, const std::string& name, Span span) {
    std::vector<ir::Value> entries;
    for (std::int64_t k = 0; k < counts.values; ++k)
        entries.push_back(entry_of_least << k * counts.width);
    const ir::BufferId table = builder.tables().list(name, ir::Scalar::Int, entries, span);
    const ir::NodeId least = builder.constant(counts.least_value);
    return builder.load(table, {builder.apply(Operator::Subtract, {value, least})});
}

// The bits of a field that a count may have.
std::int64_t field_of(const ValueCounts& counts) {
    return (std::int64_t{1} << (counts.width - 1)) - 1;
}
// Where the field of a value begins; nothing if no object has it.
std::optional<std::int64_t> place_of(const ValueCounts& counts, std::int64_t value) {
    const std::int64_t field = value - counts.least_value;
    return field < 0 || field >= counts.values ? std::nullopt : std::optional(field * counts.width);
}

}  // namespace

// No variable of the text is without a type.
ir::VariableId counted_objects(ir::Program& program, std::int64_t count) {
    const auto is_it = [&](const ir::Variable& variable) {
        return !variable.type && variable.name == "counted" && variable.size == count;
    };
    const auto found = std::ranges::find_if(program.variables, is_it);
    const auto place = static_cast<std::uint32_t>(found - program.variables.begin());
    if (found == program.variables.end())
        program.variables.push_back({"counted", std::nullopt, count});
    return ir::VariableId{place};
}

ir::NodeId value_of_counted(ir::Builder& builder, ir::Program& program, ir::NodeId value,
                            ir::VariableId object) {
    const ir::VariableId counted = counted_objects(program, program[object].size);
    std::map<ir::NodeId, ir::NodeId> known = {{builder.index(object), builder.index(counted)}};
    return ir::replace_in(builder, value, known);
}

bool is_countable(const ir::Builder& builder, ir::NodeId value) {
    const ir::Program& program = builder.program();
    return program[value].type == ir::Scalar::Int && !builder.properties(value).uniform &&
           !ir::contains<ir::Reduce>(program, value);
}

std::optional<ValueCounts> count_values(ir::Builder& builder, ir::VariableId object,
                                        ir::NodeId value, const CountedPlace& place) {
    const auto range = builder.properties(value).range;
    if (!range || range->upper - range->lower >= usable_bits) return std::nullopt;
    const std::int64_t objects = builder.program()[object].size;
    ValueCounts counts{
        .fields = {},
        .width = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(objects))) + 1,
        .values = static_cast<std::int64_t>(range->upper - range->lower) + 1,
        .least_value = static_cast<std::int64_t>(range->lower)};
    if (counts.values * counts.width > usable_bits) return std::nullopt;
    const ir::NodeId one = look_up(builder, counts, value, 1, place.name + "-field", place.span);
    counts.fields = builder.reduce(Reduction::Sum, object, one);
    return counts;
}

ir::NodeId at_least(ir::Builder& builder, const ValueCounts& counts, std::int64_t count) {
    const std::int64_t highest = field_of(counts) + 1;
    std::int64_t each = 0;
    for (std::int64_t k = 0; k < counts.values; ++k) each |= std::int64_t{1} << k * counts.width;
    const ir::NodeId raised =
        builder.apply(Operator::Add, {counts.fields, builder.constant((highest - count) * each)});
    return builder.apply(Operator::BitAnd, {raised, builder.constant(highest * each)});
}

ir::NodeId count_of(ir::Builder& builder, const ValueCounts& counts, std::int64_t value) {
    const auto place = place_of(counts, value);
    if (!place) return builder.constant(std::int64_t{0});
    const ir::NodeId moved = *place == 0 ? counts.fields
                                         : builder.apply(Operator::ShiftRight,
                                                         {counts.fields, builder.constant(*place)});
    return builder.apply(Operator::BitAnd, {moved, builder.constant(field_of(counts))});
}

ir::NodeId has_value(ir::Builder& builder, const ValueCounts& counts, std::int64_t value) {
    const auto place = place_of(counts, value);
    if (!place) return builder.constant(false);
    const ir::NodeId bits = builder.apply(
        Operator::BitAnd, {counts.fields, builder.constant(field_of(counts) << *place)});
    return builder.apply(Operator::NotEqual, {bits, builder.constant(std::int64_t{0})});
}

ir::NodeId bit_of(ir::Builder& builder, const ValueCounts& counts, ir::NodeId value,
                  const CountedPlace& place) {
    const std::int64_t highest = field_of(counts) + 1;
    return look_up(builder, counts, value, highest, place.name + "-bit", place.span);
}

}  // namespace rddlc::passes
