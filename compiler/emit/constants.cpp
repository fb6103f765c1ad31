#include "emit/constants.hpp"

#include "emit/literals.hpp"
#include "emit/tables.hpp"

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
    if (!fluent.buffer || fluent.parameter_types.empty() || is_rounded) return std::nullopt;
    const ir::Buffer& buffer = unit.program[*fluent.buffer];
    const bool is_same = buffer.storage == ir::Storage::Constant &&
                         buffer.scalar == fluent.scalar && identical(buffer.values, fluent.values);
    if (!is_same) return std::nullopt;
    return unit.names.buffers[fluent.buffer->index];
}

std::string array(ir::Scalar scalar, const std::string& name, const Values& values) {
    const auto count = static_cast<std::int64_t>(values.size());
    const std::string type =
        "std::array<" + table_type(scalar, RealType::Double) + ", " + std::to_string(count) + ">";
    return table("inline constexpr " + type + " " + name, std::span(&count, 1), values,
                 RealType::Double);
}

// Places and values are worth it where they are fewer numbers than there are elements.
bool is_sparse(const Table& table) {
    return 2 * std::ssize(table.exceptions()) < table.size();
}

ConstantText sparse(const ir::Fluent& fluent, const std::string& number, Scope& scope) {
    Values places, others;
    for (const auto& [place, value] : fluent.values.exceptions()) {
        places.push_back(place);
        others.push_back(value);
    }
    const std::string places_name = scope.claim(fluent.name, marks::places);
    const std::string common = literal(fluent.values.common());
    const std::string tables = array(ir::Scalar::Int, places_name, places);
    if (fluent.scalar == ir::Scalar::Bool)
        return {tables, "rddl::constants(" + number + ", " + common + ", " + places_name + ")"};
    const std::string name = scope.claim(fluent.name, marks::values);
    const std::string type = table_type(fluent.scalar, RealType::Double);
    return {tables + array(fluent.scalar, name, others), "rddl::constants<" + type + ">(" + number +
                                                             ", " + common + ", " + places_name +
                                                             ", " + name + ")"};
}

}  // namespace

ConstantText constants_of(const Unit& unit, std::size_t index, Scope& scope) {
    const ir::Fluent& fluent = unit.program.fluents[index];
    const std::string number = std::to_string(index);
    const Table& values = fluent.values;
    if (values.empty() || values.is_uniform()) {
        const std::string type = table_type(fluent.scalar, RealType::Double);
        const std::string value = values.empty() ? "{}" : literal(values[0]);
        return {"", "rddl::constant<" + type + ">(" + number + ", " + value + ")"};
    }
    if (const auto name = emitted_table(unit, index))
        return {"", "rddl::constants(" + number + ", " + *name + ")"};
    if (is_sparse(values)) return sparse(fluent, number, scope);
    const std::string name = scope.claim(fluent.name, marks::values);
    return {array(fluent.scalar, name, values.dense()),
            "rddl::constants(" + number + ", " + name + ")"};
}

}  // namespace rddlc::cpp
