#include "passes/analyses/parameter_rows.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <variant>

namespace rddlc::passes {
namespace {

constexpr double most_combinations = 256;  // of the ints
constexpr double most_elements = 1 << 14;  // of a table

void add(const ParameterKey& key, ParameterRows& keys) {
    if (std::ranges::find(keys.ints, key.id, &ParameterKey::id) == keys.ints.end())
        keys.ints.push_back(key);
}

double number_of(const ir::Value& value) {
    return std::visit([](auto number) { return static_cast<double>(number); }, value);
}

}  // namespace

// Bools tell ints apart that they depend on. As keys they are fewer than these, but not all of
// their combinations need exist.
ParameterTabulation::Result ParameterTabulation::tabulated(
    const std::vector<ir::NodeId>& parameters, std::size_t elements_of_row, const Use& use) {
    for (const Kind kind : {Kind::Outermost, Kind::Innermost}) {
        auto rows = keys_of(parameters, elements_of_row, kind);
        if (!rows || !add_values(parameters, *rows)) continue;
        if (const Result result = use(*rows)) return result;
    }
    return std::nullopt;
}

std::optional<ParameterRows> ParameterTabulation::keys_of(const std::vector<ir::NodeId>& parameters,
                                                          std::size_t elements_of_row, Kind kind) {
    ParameterRows keys;
    for (const ir::NodeId parameter : parameters)
        if (!find_keys(parameter, kind, keys)) return std::nullopt;
    double rows = 1;
    for (const ParameterKey& key : keys.ints) rows *= static_cast<double>(key.count);
    if (rows > most_combinations) return std::nullopt;
    for (const ir::VariableId variable : keys.variables)
        rows *= static_cast<double>(program_[variable].size);
    const double elements = rows * static_cast<double>(elements_of_row);
    if (elements > std::min(most_elements, left_)) return std::nullopt;
    left_ -= elements;
    return keys;
}

// Adds the keys that the expression depends on; false if it depends on more.
bool ParameterTabulation::find_keys(ir::NodeId id, Kind kind, ParameterRows& keys) const {
    const ir::Properties& properties = builder_.properties(id);
    if (properties.uniform) {
        keys.variables.insert(properties.free_variables.begin(), properties.free_variables.end());
        return true;
    }
    const auto key = key_of(id);
    if (!key || kind == Kind::Innermost) {
        const ParameterRows before = keys;
        if (find_keys_below(id, kind, keys)) return true;
        keys = before;
    }
    if (key) add(*key, keys);
    return key.has_value();
}
bool ParameterTabulation::find_keys_below(ir::NodeId id, Kind kind, ParameterRows& keys) const {
    const ir::Node& node = program_[id];
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    const auto* load = std::get_if<ir::Load>(&node.form);
    const bool is_decided_by_operands =
        (apply && !apply->place) || std::holds_alternative<ir::Select>(node.form) ||
        std::holds_alternative<ir::Convert>(node.form) || (load && is_within_constant_table(*load));
    return is_decided_by_operands &&
           std::ranges::all_of(ir::operands_of(node),
                               [&](ir::NodeId operand) { return find_keys(operand, kind, keys); });
}
// For all values of the keys, of which not all combinations need exist.
bool ParameterTabulation::is_within_constant_table(const ir::Load& load) const {
    const ir::Buffer& table = program_[load.buffer];
    if (table.storage != ir::Storage::Constant) return false;
    for (std::size_t axis = 0; axis < load.indices.size(); ++axis) {
        const auto& range = builder_.properties(load.indices[axis]).range;
        if (!range || range->lower < 0 || range->upper >= static_cast<double>(table.shape[axis]))
            return false;
    }
    return true;
}

std::optional<ParameterKey> ParameterTabulation::key_of(ir::NodeId id) const {
    const ir::Properties& properties = builder_.properties(id);
    if (properties.may_fault) return std::nullopt;
    const ir::Scalar type = program_[id].type;
    if (type == ir::Scalar::Bool) return ParameterKey{id, 0, 2};
    const auto& range = properties.range;
    if (type != ir::Scalar::Int || !range || range->upper - range->lower >= most_combinations)
        return std::nullopt;
    const auto least = static_cast<std::int64_t>(range->lower);
    return ParameterKey{id, least, static_cast<std::int64_t>(range->upper) - least + 1};
}

ir::NodeId ParameterTabulation::value_of(const ParameterKey& key, std::int64_t value) {
    if (program_[key.id].type == ir::Scalar::Bool) return builder_.constant(value != 0);
    return builder_.constant(key.least + value);
}

// False if a parameter has no value for some row. Variables whose objects all have the same rows
// are left out of the keys.
bool ParameterTabulation::add_values(const std::vector<ir::NodeId>& parameters,
                                     ParameterRows& keys) {
    std::int64_t combinations = 1;
    for (const ParameterKey& key : keys.ints) combinations *= key.count;
    std::vector<OfObjects> values;  // by combination
    for (std::int64_t combination = 0; combination < combinations; ++combination) {
        auto of_objects = values_of(parameters, keys, combination);
        if (!of_objects) return false;
        values.push_back(std::move(*of_objects));
    }
    const auto are_same_for_all_objects = [](const OfObjects& all) {
        return std::ranges::all_of(all, [](const std::vector<ir::Value>& of_objects) {
            return std::ranges::adjacent_find(of_objects, std::not_equal_to{}) == of_objects.end();
        });
    };
    std::size_t objects = values.front().front().size();
    if (std::ranges::all_of(values, are_same_for_all_objects)) {
        keys.variables.clear();
        objects = 1;
    }
    for (std::size_t object = 0; object < objects; ++object) {
        for (const OfObjects& of_combination : values) {
            std::vector<double>& row = keys.values.emplace_back();
            for (const auto& of_objects : of_combination)
                row.push_back(number_of(of_objects[object]));
        }
    }
    return true;
}

std::optional<ParameterTabulation::OfObjects> ParameterTabulation::values_of(
    const std::vector<ir::NodeId>& parameters, const ParameterRows& keys,
    std::int64_t combination) {
    std::map<ir::NodeId, ir::NodeId> known;
    for (auto key = keys.ints.rbegin(); key != keys.ints.rend(); ++key) {
        known.emplace(key->id, value_of(*key, combination % key->count));
        combination /= key->count;
    }
    const std::vector<ir::VariableId> variables(keys.variables.begin(), keys.variables.end());
    OfObjects values;
    for (const ir::NodeId parameter : parameters) {
        const ir::NodeId of_case = ir::replace_in(builder_, parameter, known);
        if (!builder_.properties(of_case).uniform) return std::nullopt;
        auto of_objects = constant_values(evaluator_, program_, of_case, variables);
        if (!of_objects) return std::nullopt;
        values.push_back(std::move(*of_objects));
    }
    return values;
}

}  // namespace rddlc::passes
