#include "emit/lower/constants.hpp"

#include "emit/cpp/literals.hpp"
#include "emit/lower/tables.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::cpp {
namespace {

using Values = std::vector<ir::Value>;

// A table that the simulator has anyway, as the instance gives it.
std::optional<std::string> emitted_table(const Unit& unit, std::size_t index) {
    const ir::Fluent& fluent = unit.program.fluents[index];
    const bool is_rounded =
        fluent.scalar == ir::Scalar::Real && unit.program.real == RealType::Float;
    if (!fluent.buffer || fluent.parameter_types.empty() || is_rounded ||
        unit.left_out.contains(*fluent.buffer))
        return std::nullopt;
    const ir::Buffer& buffer = unit.program[*fluent.buffer];
    const bool is_same = buffer.storage == ir::Storage::Constant &&
                         buffer.scalar == fluent.scalar && identical(buffer.values, fluent.values);
    if (!is_same) return std::nullopt;
    return unit.names.buffers[fluent.buffer->index];
}

tree::Statement array(ir::Scalar scalar, const std::string& name, const Values& values) {
    const auto count = static_cast<std::int64_t>(values.size());
    const std::string type =
        "std::array<" + table_type(scalar) + ", " + std::to_string(count) + ">";
    return table(type, name, std::span(&count, 1), values);
}

// Places and values are worth it where they are fewer numbers than there are elements.
bool is_sparse(const Table& table) {
    return 2 * std::ssize(table.exceptions()) < table.size();
}

tree::Expression sparse(const ir::Fluent& fluent, tree::Expressions arguments, Scope& scope,
                        tree::Block& tables) {
    Values places, others;
    for (const auto& [place, value] : fluent.values.exceptions()) {
        places.push_back(place);
        others.push_back(value);
    }
    const std::string places_name = scope.claim(fluent.name, marks::places);
    tables.push_back(array(ir::Scalar::Int, places_name, places));
    arguments.push_back(tree::word(literal(fluent.values.common())));
    arguments.push_back(tree::word(places_name));
    if (fluent.scalar == ir::Scalar::Bool)
        return tree::call("rddl::constants", std::move(arguments));
    const std::string name = scope.claim(fluent.name, marks::values);
    tables.push_back(array(fluent.scalar, name, others));
    arguments.push_back(tree::word(name));
    return tree::call("rddl::constants<" + table_type(fluent.scalar) + ">", std::move(arguments));
}

}  // namespace

tree::Expression constants_of(const Unit& unit, std::size_t index, Scope& scope,
                              tree::Block& tables) {
    const ir::Fluent& fluent = unit.program.fluents[index];
    const tree::Expression number = tree::number(index);
    const Table& values = fluent.values;
    if (values.empty() || values.is_uniform())
        return tree::call("rddl::constant<" + table_type(fluent.scalar) + ">",
                          {number, tree::word(values.empty() ? "{}" : literal(values[0]))});
    if (const auto name = emitted_table(unit, index))
        return tree::call("rddl::constants", {number, tree::word(*name)});
    if (is_sparse(values)) return sparse(fluent, {number}, scope, tables);
    const std::string name = scope.claim(fluent.name, marks::values);
    tables.push_back(array(fluent.scalar, name, values.dense()));
    return tree::call("rddl::constants", {number, tree::word(name)});
}

}  // namespace rddlc::cpp
