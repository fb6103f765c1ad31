#include "engines/constant_tables.hpp"

#include <variant>

namespace rddlc::workbench {

std::span<const std::int64_t> ConstantTables::places_of(const Table& table) {
    std::vector<std::int64_t>& places = places_.emplace_back();
    for (const auto& [place, value] : table.exceptions()) places.push_back(place);
    return places;
}

template <class T>
rddl::ConstantValues<T> ConstantTables::values_of(const Table& table,
                                                  std::deque<std::vector<T>>& all) {
    std::vector<T>& others = all.emplace_back();
    for (const auto& [place, value] : table.exceptions()) others.push_back(std::get<T>(value));
    const T common = table.has_common() ? std::get<T>(table.common()) : T{};
    return {common, places_of(table), others};
}

void ConstantTables::add(std::int32_t fluent, ir::Scalar scalar, const Table& table) {
    if (table.empty()) return;
    switch (scalar) {
        case ir::Scalar::Bool:
            list_.push_back({fluent, rddl::ConstantValues<bool>{
                                         std::get<bool>(table.common()), places_of(table), {}}});
            break;
        case ir::Scalar::Int:
            list_.push_back({fluent, values_of<std::int64_t>(table, ints_)});
            break;
        case ir::Scalar::Real:
            list_.push_back({fluent, values_of<double>(table, reals_)});
            break;
    }
}

}  // namespace rddlc::workbench
