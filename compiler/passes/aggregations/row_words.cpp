#include "passes/aggregations/row_words.hpp"

#include "ir/analysis.hpp"
#include "ir/evaluator.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {

std::optional<std::vector<ir::NodeId>> uniform_row_of(const ir::Builder& builder,
                                                      const ir::Load& element) {
    if (element.indices.empty() ||
        builder.program()[element.buffer].storage == ir::Storage::Constant)
        return std::nullopt;
    std::vector<ir::NodeId> row(element.indices.begin(), element.indices.end() - 1);
    const bool is_one_row = std::ranges::all_of(
        row, [&](ir::NodeId index) { return builder.properties(index).uniform; });
    return is_one_row ? std::optional(std::move(row)) : std::nullopt;
}

RowWords::RowWords(ir::Builder& builder, ir::VariableId object, WordOfOther word_of_other)
    : builder_(builder), object_(object), word_of_other_(std::move(word_of_other)) {}

std::optional<ir::NodeId> RowWords::word_of(ir::NodeId id) {
    const ir::Properties properties = builder_.properties(id);
    if (!depends_on_object(id)) return builder_.select(id, all(), none());
    if (properties.uniform && properties.free_variables.size() == 1) return known_word(id);
    const ir::Node node = builder_.program()[id];
    std::optional<ir::NodeId> word;
    if (const auto* load = std::get_if<ir::Load>(&node.form)) word = bits_of(*load);
    if (const auto* select = std::get_if<ir::Select>(&node.form)) word = word_of(*select);
    if (const auto* apply = std::get_if<ir::Apply>(&node.form)) word = word_of(*apply);
    return word ? word : word_of_other_(id);
}

std::optional<ir::NodeId> RowWords::known_word(ir::NodeId id) {
    const ir::Evaluator evaluator(builder_.program());
    const auto values = constant_values(evaluator, builder_.program(), id, {object_});
    if (!values) return std::nullopt;
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < values->size(); ++i)
        word |= std::uint64_t{std::get<bool>((*values)[i])} << i;
    return builder_.constant(static_cast<std::int64_t>(word));
}

// The elements of a row, in their order.
std::optional<ir::NodeId> RowWords::bits_of(const ir::Load& load) {
    const auto row = uniform_row_of(builder_, load);
    const bool is_of_objects =
        row && load.indices.back() == builder_.index(object_) &&
        builder_.program()[load.buffer].shape.back() == size() &&
        std::ranges::none_of(*row, [&](ir::NodeId index) { return depends_on_object(index); });
    return is_of_objects ? std::optional(builder_.bits(load.buffer, 0, *row)) : std::nullopt;
}

std::optional<ir::NodeId> RowWords::word_of(const ir::Select& select) {
    const auto a = word_of(select.then_value), b = word_of(select.else_value);
    if (!a || !b) return std::nullopt;
    if (!depends_on_object(select.condition)) return builder_.select(select.condition, *a, *b);
    const auto where = word_of(select.condition);
    if (!where) return std::nullopt;
    if (*a == all()) return either(*where, *b);
    return either(both(*where, *a), both(inverted(*where), *b));
}

std::optional<ir::NodeId> RowWords::word_of(const ir::Apply& apply) {
    if (!is_one_of(apply.op, {Operator::And, Operator::Or, Operator::Not})) return std::nullopt;
    const auto a = word_of(apply.operands.front());
    if (!a) return std::nullopt;
    if (apply.op == Operator::Not) return inverted(*a);
    const auto b = word_of(apply.operands.back());
    if (!b) return std::nullopt;
    return apply.op == Operator::And ? both(*a, *b) : either(*a, *b);
}

std::int64_t RowWords::size() const {
    return builder_.program()[object_].size;
}
bool RowWords::depends_on_object(ir::NodeId id) const {
    return ir::depends_on_any(builder_.properties(id), {&object_, 1});
}

ir::NodeId RowWords::none() {
    return builder_.constant(std::int64_t{0});
}
ir::NodeId RowWords::all() {
    return builder_.constant(first_bits(size()));
}
ir::NodeId RowWords::inverted(ir::NodeId word) {
    return builder_.apply(Operator::BitXor, {word, all()});
}
ir::NodeId RowWords::either(ir::NodeId a, ir::NodeId b) {
    return builder_.apply(Operator::BitOr, {a, b});
}
ir::NodeId RowWords::both(ir::NodeId a, ir::NodeId b) {
    if (a == all()) return b;
    if (b == all()) return a;
    return builder_.apply(Operator::BitAnd, {a, b});
}

}  // namespace rddlc::passes
