#include "ir/visits.hpp"

#include "ir/analysis.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace rddlc::ir {
namespace {

bool reads_marked(const Program& program, const Visit& reader, const Visit& marker) {
    return std::ranges::any_of(reader.marks, [&](const Mark& reading) {
        return std::ranges::any_of(marker.marks, [&](const Mark& marked) {
            return reads(program, reading.condition, marked.target) ||
                   std::ranges::any_of(reading.indices, [&](NodeId index) {
                       return reads(program, index, marked.target);
                   });
        });
    });
}

// The constant table of which the mark's only index is the element for an entry of the visit.
const Buffer* table_of_entries(const Program& program, const Visit& visit, const Mark& mark) {
    if (mark.indices.size() != 1) return nullptr;
    const auto* load = std::get_if<Load>(&program[mark.indices.front()].form);
    const bool is_of_entry = load && load->indices.size() == 1 &&
                             is_index_of(program, load->indices.front(), visit.entries->variable) &&
                             program[load->buffer].storage == Storage::Constant;
    return is_of_entry ? &program[load->buffer] : nullptr;
}

bool marks_visited(const Program& program, const Visit& visit, const Mark& mark) {
    return mark.indices.size() == 1 && is_index_of(program, mark.indices.front(), visit.visited);
}

// Whether a mark of each object and one of its entries never are of the same element.
bool are_apart(const Program& program, const Visit& of_objects, const Mark& of_object,
               const Visit& of_entries, const Mark& of_entry) {
    const Buffer* const table = table_of_entries(program, of_entries, of_entry);
    if (!table || !marks_visited(program, of_objects, of_object)) return false;
    const Table& rows = program[of_entries.entries->rows].values;
    const auto row = [&](std::int64_t x) {
        return std::get<std::int64_t>(rows[static_cast<std::size_t>(x)]);
    };
    for (std::int64_t x = 0; x < program[of_objects.visited].size; ++x)
        for (std::int64_t entry = row(x); entry < row(x + 1); ++entry)
            if (std::get<std::int64_t>(table->values[static_cast<std::size_t>(entry)]) == x)
                return false;
    return true;
}

bool may_change_order(const Program& program, const Visit& first, const Mark& a,
                      const Visit& second, const Mark& b) {
    return a.target != b.target || a.value == b.value || are_apart(program, first, a, second, b) ||
           are_apart(program, second, b, first, a);
}

}  // namespace

bool may_take_turns(const Program& program, const Visit& first, const Visit& second) {
    const bool are_alike =
        buffer_read_by(program[first.condition]) == buffer_read_by(program[second.condition]) &&
        first.entries && second.entries && first.entries->rows == second.entries->rows;
    return are_alike && !reads_marked(program, first, second) &&
           !reads_marked(program, second, first) &&
           std::ranges::all_of(first.marks, [&](const Mark& a) {
               return std::ranges::all_of(second.marks, [&](const Mark& b) {
                   return may_change_order(program, first, a, second, b);
               });
           });
}

}  // namespace rddlc::ir
