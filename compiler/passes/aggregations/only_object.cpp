#include "passes/aggregations/only_object.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace rddlc::passes {
namespace {

// A table from values to objects has at most this many entries for each object.
constexpr std::int64_t most_entries_an_object = 4;
// Tables in which the entries that count are not the exceptions are looked through up to this size.
constexpr std::int64_t most_searched_elements = 1'000'000;

// The elements of a table in groups that differ in the index of one axis only.
struct Lines {
    Lines(const ir::Buffer& table, std::size_t axis) : length(table.shape[axis]), stride(1) {
        for (std::size_t d = axis + 1; d < table.shape.size(); ++d) stride *= table.shape[d];
        count = length == 0 ? 0 : table.count() / length;
    }
    std::int64_t place_of(std::int64_t element) const { return element / stride % length; }
    std::int64_t line_of(std::int64_t element) const {
        return element / stride / length * stride + element % stride;
    }

    std::int64_t length, stride, count;
};

// The place of that entry in each line that has one; nothing if a line has several.
std::optional<std::map<std::int64_t, std::int64_t>> only_places(const Table& table,
                                                                const Lines& lines, bool entry) {
    std::map<std::int64_t, std::int64_t> places;
    const auto is_only = [&](std::int64_t element) {
        return places.emplace(lines.line_of(element), lines.place_of(element)).second;
    };
    if (table.common() != ir::Value(entry)) {
        for (const auto& [element, value] : table.exceptions()) {
            if (value == ir::Value(entry) && !is_only(element)) return std::nullopt;
        }
        return places;
    }
    if (table.size() > most_searched_elements) return std::nullopt;
    for (std::int64_t element = 0; element < table.size(); ++element) {
        if (table[element] == ir::Value(entry) && !is_only(element)) return std::nullopt;
    }
    return places;
}

}  // namespace

std::optional<OnlyObject> OnlyObjects::fulfilling(const Condition& condition,
                                                  ir::VariableId variable) {
    if (!depends_on(condition.id, variable)) return std::nullopt;
    if (const auto found = column(condition.id, variable))
        return with_entry(*found, condition.needed);

    const ir::Node node = program_[condition.id];
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (!apply || apply->op != (condition.needed ? Operator::Equal : Operator::NotEqual))
        return std::nullopt;
    const ir::NodeId a = apply->operands[0], b = apply->operands[1];
    if (program_[a].type != ir::Scalar::Int) return std::nullopt;
    if (const auto found = equal_to(a, b, variable)) return found;
    return equal_to(b, a, variable);
}

// The object for which `side`, made of the variable alone, equals the other side.
std::optional<OnlyObject> OnlyObjects::equal_to(ir::NodeId side, ir::NodeId other,
                                                ir::VariableId variable) {
    if (depends_on(other, variable) || builder_.properties(other).may_fault) return std::nullopt;
    const auto* index = std::get_if<ir::Index>(&program_[side].form);
    if (index && index->variable == variable) {
        const std::int64_t last = program_[variable].size - 1;
        return OnlyObject{clamped(other, 0, last), test(other, 0, last)};
    }
    const auto found = column(side, variable);
    return found && found->indices.size() == 1 ? with_value(*found, other) : std::nullopt;
}

// ---------------------------------------------------------------------------------- tables

std::optional<OnlyObjects::Column> OnlyObjects::column(ir::NodeId id,
                                                       ir::VariableId variable) const {
    const auto* load = std::get_if<ir::Load>(&program_[id].form);
    if (!load || program_[load->buffer].storage != ir::Storage::Constant) return std::nullopt;
    std::optional<std::size_t> axis;
    for (std::size_t d = 0; d < load->indices.size(); ++d) {
        if (!depends_on(load->indices[d], variable)) continue;
        const auto* index = std::get_if<ir::Index>(&program_[load->indices[d]].form);
        if (!index || axis) return std::nullopt;
        axis = d;
    }
    if (!axis || program_[load->buffer].shape[*axis] != program_[variable].size)
        return std::nullopt;
    return Column{load->buffer, *axis, load->indices};
}

// Looks the object up in a table from values to objects.
std::optional<OnlyObject> OnlyObjects::with_value(const Column& column, ir::NodeId value) {
    const ir::Buffer& table = program_[column.table];
    std::vector<std::int64_t> entries;
    for (const ir::Value& entry : table.values.dense())
        entries.push_back(std::get<std::int64_t>(entry));
    const std::set<std::int64_t> different(entries.begin(), entries.end());
    if (different.size() != entries.size()) return std::nullopt;
    const std::int64_t first = *different.begin(), last = *different.rbegin();
    const auto count = static_cast<std::int64_t>(entries.size());
    std::int64_t distance = 0;
    if (__builtin_sub_overflow(last, first, &distance) ||
        distance >= most_entries_an_object * count)
        return std::nullopt;

    const auto extent = static_cast<std::size_t>(distance + 1);
    std::vector<ir::Value> objects(extent, std::int64_t{0}), exists(extent, false);
    for (std::int64_t object = 0; object < count; ++object) {
        const auto place =
            static_cast<std::size_t>(entries[static_cast<std::size_t>(object)] - first);
        objects[place] = object;
        exists[place] = true;
    }
    const ir::Buffer like{.name = table.name,
                          .storage = ir::Storage::Constant,
                          .scalar = ir::Scalar::Int,
                          .shape = {distance + 1},
                          .span = table.span};
    const ir::NodeId place =
        builder_.apply(Operator::Subtract, {clamped(value, first, last), number(first)});
    const Column entry{column.table, 1, {place}};
    const ir::NodeId object = load(like, "-object", ir::Scalar::Int, std::move(objects), entry);
    const ir::NodeId is_there = load(like, "-is-there", ir::Scalar::Bool, std::move(exists), entry);
    return OnlyObject{object, builder_.apply(Operator::And, {test(value, first, last), is_there})};
}

// Looks the object up in tables of the other axes.
std::optional<OnlyObject> OnlyObjects::with_entry(const Column& column, bool entry) {
    const ir::Buffer& table = program_[column.table];
    const Lines lines(table, column.axis);
    const auto places = only_places(table.values, lines, entry);
    if (!places) return std::nullopt;
    Table objects(lines.count, std::int64_t{0}), exists(lines.count, false);
    for (const auto& [line, place] : *places) {
        objects.set(line, place);
        exists.set(line, true);
    }
    ir::Buffer like = table;
    like.shape.erase(like.shape.begin() + static_cast<std::ptrdiff_t>(column.axis));
    if (!like.types.empty())
        like.types.erase(like.types.begin() + static_cast<std::ptrdiff_t>(column.axis));
    like.fluent.reset();
    return OnlyObject{load(like, "-object", ir::Scalar::Int, std::move(objects), column),
                      load(like, "-is-there", ir::Scalar::Bool, std::move(exists), column)};
}

// Loads from a table of these values, unless they are all equal. It is indexed as the column is,
// without its axis.
ir::NodeId OnlyObjects::load(const ir::Buffer& like, const std::string& suffix, ir::Scalar scalar,
                             Table values, const Column& column) {
    if (values.is_uniform()) return builder_.constant(values[0]);
    // The most frequent value is the common one, so a large table stays as sparse as it was
    // written.
    if (values.size() <= most_searched_elements) values = Table(values.dense());
    ir::Buffer table = like;
    table.name += suffix;
    table.scalar = scalar;
    table.values = std::move(values);
    std::vector<ir::NodeId> indices = column.indices;
    if (column.axis < indices.size())
        indices.erase(indices.begin() + static_cast<std::ptrdiff_t>(column.axis));
    return builder_.load(builder_.tables().constant(std::move(table)), std::move(indices));
}

// ---------------------------------------------------------------------------------- ranges

bool OnlyObjects::depends_on(ir::NodeId id, ir::VariableId variable) const {
    return ir::depends_on(builder_.properties(id), variable);
}

bool OnlyObjects::is_within(ir::NodeId id, std::int64_t first, std::int64_t last) const {
    const auto& range = builder_.properties(id).range;
    return range && range->lower >= static_cast<double>(first) &&
           range->upper <= static_cast<double>(last);
}

ir::NodeId OnlyObjects::test(ir::NodeId id, std::int64_t first, std::int64_t last) {
    if (is_within(id, first, last)) return builder_.constant(true);
    return builder_.apply(Operator::And,
                          {builder_.apply(Operator::GreaterEqual, {id, number(first)}),
                           builder_.apply(Operator::LessEqual, {id, number(last)})});
}

ir::NodeId OnlyObjects::clamped(ir::NodeId id, std::int64_t first, std::int64_t last) {
    if (is_within(id, first, last)) return id;
    return builder_.apply(Operator::Minimum,
                          {builder_.apply(Operator::Maximum, {id, number(first)}), number(last)});
}

}  // namespace rddlc::passes
