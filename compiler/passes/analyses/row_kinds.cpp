#include "passes/analyses/row_kinds.hpp"

#include <algorithm>
#include <cstdint>

namespace rddlc::passes {
namespace {

// A table of several kinds of objects has this many times fewer rows, at least.
constexpr std::size_t objects_of_a_kind = 4;
constexpr std::size_t most_kinds = 64;

}  // namespace

std::optional<RowKinds> kinds_of(const Rows& rows) {
    const std::size_t most = std::min(rows.reached.size() / objects_of_a_kind, most_kinds);
    RowKinds kinds;
    for (std::size_t object = 0; object < rows.reached.size(); ++object) {
        const auto row = rows.reached_by(object);
        const auto known = std::ranges::find_if(kinds.examples, [&](std::size_t example) {
            const auto other = rows.reached_by(example);
            const std::size_t both = std::min(row.size(), other.size());
            return are_identical(row.first(both), other.first(both));
        });
        kinds.of_objects.push_back(std::int64_t{known - kinds.examples.begin()});
        if (known == kinds.examples.end())
            kinds.examples.push_back(object);
        else if (row.size() > rows.reached[*known])
            *known = object;
        if (kinds.examples.size() > 1 && kinds.examples.size() > most) return std::nullopt;
    }
    return kinds;
}

}  // namespace rddlc::passes
