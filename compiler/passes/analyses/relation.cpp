#include "passes/analyses/relation.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::passes {
namespace {

// Larger relations are not worth their memory.
constexpr std::int64_t most_tuples = std::int64_t{1} << 23;

bool contains(std::span<const Axis> axes, const Axis& axis) {
    return std::ranges::find(axes, axis) != axes.end();
}

std::vector<Axis> union_of(std::span<const Axis> a, std::span<const Axis> b) {
    std::vector<Axis> axes(a.begin(), a.end());
    for (const Axis& axis : b) {
        if (!contains(a, axis)) axes.push_back(axis);
    }
    std::ranges::sort(axes);
    return axes;
}

std::vector<Axis> without(std::span<const Axis> axes, std::span<const Axis> others) {
    std::vector<Axis> rest;
    for (const Axis& axis : axes) {
        if (!contains(others, axis)) rest.push_back(axis);
    }
    return rest;
}

std::vector<Axis> chained(std::vector<Axis> first, const std::vector<Axis>& last) {
    first.insert(first.end(), last.begin(), last.end());
    return first;
}

void sort_tuples(Relation& relation) {
    auto& tuples = relation.tuples;
    std::ranges::sort(tuples);
    tuples.erase(std::unique(tuples.begin(), tuples.end()), tuples.end());
}

// Every tuple with all values of the axes that it lacks.
std::optional<Relation> extended(const Relation& relation, const std::vector<Axis>& axes) {
    const std::vector<Axis> missing = without(axes, relation.axes);
    if (missing.empty()) return ordered(relation, axes);
    const auto factor = volume(missing);
    if (!factor || *factor > most_tuples / std::max<std::int64_t>(relation.count(), 1)) {
        return std::nullopt;
    }
    Relation all{chained(relation.axes, missing), {}};
    all.tuples.reserve(relation.tuples.size() * static_cast<std::size_t>(*factor));
    for (const std::int64_t tuple : relation.tuples) {
        for (std::int64_t i = 0; i < *factor; ++i) all.tuples.push_back(tuple * *factor + i);
    }
    return ordered(all, axes);
}

}  // namespace

bool Relation::has(ir::VariableId variable) const {
    return std::ranges::find(axes, variable, &Axis::variable) != axes.end();
}

std::optional<std::int64_t> volume(std::span<const Axis> axes) {
    std::int64_t product = 1;
    for (const Axis& axis : axes) {
        if (__builtin_mul_overflow(product, axis.size, &product)) return std::nullopt;
    }
    return product;
}

std::vector<std::int64_t> values_of(std::int64_t tuple, std::span<const Axis> axes) {
    std::vector<std::int64_t> values(axes.size());
    for (std::size_t k = axes.size(); k-- > 0;) {
        values[k] = tuple % axes[k].size;
        tuple /= axes[k].size;
    }
    return values;
}

std::int64_t tuple_of(std::span<const std::int64_t> values, std::span<const Axis> axes) {
    std::int64_t tuple = 0;
    for (std::size_t k = 0; k < axes.size(); ++k) tuple = tuple * axes[k].size + values[k];
    return tuple;
}

Relation ordered(const Relation& relation, std::vector<Axis> axes) {
    if (axes == relation.axes) return relation;
    std::vector<std::size_t> origin;  // of each axis
    for (const Axis& axis : axes) {
        const auto found = std::ranges::find(relation.axes, axis);
        origin.push_back(static_cast<std::size_t>(found - relation.axes.begin()));
    }
    Relation result{std::move(axes), {}};
    result.tuples.reserve(relation.tuples.size());
    std::vector<std::int64_t> permuted(result.axes.size());
    for (const std::int64_t tuple : relation.tuples) {
        const std::vector<std::int64_t> values = values_of(tuple, relation.axes);
        for (std::size_t k = 0; k < origin.size(); ++k) permuted[k] = values[origin[k]];
        result.tuples.push_back(tuple_of(permuted, result.axes));
    }
    std::ranges::sort(result.tuples);
    return result;
}

Relation join(const Relation& a, const Relation& b) {
    const Relation& smaller = a.count() <= b.count() ? a : b;
    const std::vector<Axis> axes = union_of(a.axes, b.axes);
    if (!volume(axes)) return smaller;
    std::vector<Axis> shared;
    for (const Axis& axis : a.axes) {
        if (contains(b.axes, axis)) shared.push_back(axis);
    }
    // Both by what they share, so that equal parts are neighbours.
    const std::vector<Axis> rest_a = without(a.axes, shared), rest_b = without(b.axes, shared);
    const Relation left = ordered(a, chained(shared, rest_a));
    const Relation right = ordered(b, chained(shared, rest_b));
    const std::int64_t size_a = *volume(rest_a), size_b = *volume(rest_b);
    Relation result{chained(left.axes, rest_b), {}};
    auto row = right.tuples.begin();
    for (const std::int64_t tuple : left.tuples) {
        const std::int64_t key = size_a > 0 ? tuple / size_a : 0;
        while (row != right.tuples.end() && *row / size_b < key) ++row;
        for (auto each = row; each != right.tuples.end() && *each / size_b == key; ++each) {
            if (std::ssize(result.tuples) == most_tuples) return smaller;
            result.tuples.push_back(tuple * size_b + *each % size_b);
        }
    }
    return ordered(result, axes);
}

std::optional<Relation> unite(const Relation& a, const Relation& b) {
    const std::vector<Axis> axes = union_of(a.axes, b.axes);
    if (a.tuples.empty()) return extended(b, axes);
    if (b.tuples.empty()) return extended(a, axes);
    const std::optional<Relation> left = extended(a, axes), right = extended(b, axes);
    if (!left || !right) return std::nullopt;
    Relation result{axes, {}};
    std::ranges::set_union(left->tuples, right->tuples, std::back_inserter(result.tuples));
    return result;
}

Relation project(const Relation& relation, ir::VariableId variable) {
    const auto axis = std::ranges::find(relation.axes, variable, &Axis::variable);
    if (axis == relation.axes.end()) return relation;
    const std::vector<Axis> removed = {*axis};
    const std::vector<Axis> kept = without(relation.axes, removed);
    Relation result = ordered(relation, chained(kept, removed));
    for (std::int64_t& tuple : result.tuples) tuple /= removed.front().size;
    result.axes = kept;
    sort_tuples(result);
    return result;
}

}  // namespace rddlc::passes
