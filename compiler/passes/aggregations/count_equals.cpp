#include "passes/aggregations/count_equals.hpp"

#include "ir/analysis.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/value_counts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Compares of values for each object that is counted. Fewer are made as fast.
constexpr double worth_counting = 3;

// Objects that must be different, each with a value, and groups of them whose values are equal.
struct Wanted {
    std::vector<ir::VariableId> objects;  // those of the quantifier, then the one given by a loop
    std::size_t quantified;               // how many the quantifier has
    std::set<std::pair<std::size_t, std::size_t>> different = {};
    std::vector<std::size_t> group = {};   // of each object
    std::optional<ir::NodeId> value = {};  // of the variable of `counted_objects`
    std::optional<ir::NodeId> value_of_given = {};

    bool has_given() const { return objects.size() > quantified; }
    // The greatest one first.
    std::vector<std::int64_t> sizes_of_groups() const {
        std::map<std::size_t, std::int64_t> counts;
        for (const std::size_t each : group) ++counts[each];
        std::vector<std::int64_t> sizes;
        for (const auto& [each, size] : counts) sizes.push_back(size);
        std::ranges::sort(sizes, std::greater<>());
        return sizes;
    }
};

// The compares of all choices of these objects. Those of a group may change places.
double compares(const Wanted& wanted, std::int64_t objects) {
    double choices = 1, left = static_cast<double>(objects);
    for (const std::int64_t size : wanted.sizes_of_groups())
        for (std::int64_t k = 1; k <= size; ++k) choices *= left-- / static_cast<double>(k);
    const std::size_t groups = wanted.sizes_of_groups().size();
    return choices * static_cast<double>(wanted.objects.size() - groups);
}

class EqualCounting {
  public:
    EqualCounting(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_))
            change(program_[definition->target].name, definition->span,
                   [&](const auto& change) { ir::change_roots(definition->body, change); });
        for (const auto& [name, computation] : ir::computations_of(program_))
            change(*computation, name);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Computation& computation, const char* name) {
        change(name, computation.span, [&](const ir::Change& change) {
            ir::change_roots(computation.body, change);
            change(computation.value);
        });
    }
    // Quantifiers of one definition share their counts.
    template <class ChangeRoots>
    void change(const std::string& name, Span span, const ChangeRoots& change_roots) {
        place_ = {name, span};
        compares_.clear();
        std::map<ir::NodeId, ir::NodeId> seen, known;
        change_roots([&](ir::NodeId& root) {
            ir::replace_in(builder_, root, seen, [&](ir::NodeId each) { return noted(each); });
        });
        if (compares_.empty()) return;
        change_roots([&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known,
                                  [&](ir::NodeId each) { return counted(each); });
        });
    }

    std::optional<ir::NodeId> noted(ir::NodeId id) {
        const auto wanted = wanted_by(id);
        if (!wanted) return std::nullopt;
        compares_[*wanted->value] += compares(*wanted, objects_of(*wanted));
        return id;
    }
    std::optional<ir::NodeId> counted(ir::NodeId id) {
        const auto wanted = wanted_by(id);
        if (!wanted ||
            compares_[*wanted->value] < worth_counting * static_cast<double>(objects_of(*wanted)))
            return std::nullopt;
        const auto counts = count_values(builder_, counted_objects(program_, objects_of(*wanted)),
                                         *wanted->value, place_);
        if (!counts) return std::nullopt;
        ++report_["quantifiers over equal values that count"];
        const bool is_exists = std::get<ir::Reduce>(program_[id].form).op == Reduction::Exists;
        const ir::NodeId met = is_met(*wanted, *counts);
        return is_exists ? met : builder_.apply(Operator::Not, {met});
    }
    std::int64_t objects_of(const Wanted& wanted) const { return program_[wanted.objects[0]].size; }

    // ------------------------------------------------------------------------------ finding

    std::optional<Wanted> wanted_by(ir::NodeId id) {
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || !is_quantifier(nest->op) || !ir::is_droppable(builder_.properties(nest->body)))
            return std::nullopt;
        const auto wanted = parts_wanted_by(*nest);
        return wanted && can_be_counted(*wanted) ? wanted : std::nullopt;
    }
    std::optional<Wanted> parts_wanted_by(const ir::ReductionNest& nest) {
        const bool is_exists = nest.op == Reduction::Exists;
        const auto every_part = is_exists ? Operator::And : Operator::Or;
        const auto different = is_exists ? Operator::NotEqual : Operator::Equal;
        const auto same = is_exists ? Operator::Equal : Operator::NotEqual;
        Wanted wanted{nest.variables, nest.variables.size()};
        std::vector<std::pair<ir::NodeId, ir::NodeId>> equals;
        for (const ir::NodeId part : ir::parts_of(program_, nest.body, every_part)) {
            const auto* test = std::get_if<ir::Apply>(&program_[part].form);
            if (!test || (test->op != different && test->op != same)) return std::nullopt;
            const ir::NodeId a = test->operands.front(), b = test->operands.back();
            if (test->op == same)
                equals.emplace_back(a, b);
            else if (!add_different(a, b, wanted))
                return std::nullopt;
        }
        wanted.group.resize(wanted.objects.size());
        std::iota(wanted.group.begin(), wanted.group.end(), std::size_t{0});
        for (const auto& [a, b] : equals)
            if (!add_equal(a, b, wanted)) return std::nullopt;
        return wanted;
    }

    bool add_different(ir::NodeId a, ir::NodeId b, Wanted& wanted) const {
        const auto first = place_of(a, wanted), second = place_of(b, wanted);
        if (first && second && *first != *second)
            wanted.different.insert(std::minmax(*first, *second));
        return first && second && *first != *second;
    }
    // Among the objects, to which one of a loop around the quantifier is added.
    std::optional<std::size_t> place_of(ir::NodeId id, Wanted& wanted) const {
        const auto* index = std::get_if<ir::Index>(&program_[id].form);
        if (!index || !are_alike(index->variable, wanted.objects[0])) return std::nullopt;
        const auto found = std::ranges::find(wanted.objects, index->variable);
        const auto place = static_cast<std::size_t>(found - wanted.objects.begin());
        if (place < wanted.objects.size()) return place;
        if (place > wanted.quantified) return std::nullopt;
        wanted.objects.push_back(index->variable);
        return place;
    }
    bool are_alike(ir::VariableId a, ir::VariableId b) const {
        return program_[a].type == program_[b].type && program_[a].size == program_[b].size;
    }

    // Two objects have the same value: one expression of each of them.
    bool add_equal(ir::NodeId a, ir::NodeId b, Wanted& wanted) {
        const auto first = object_in(a, wanted), second = object_in(b, wanted);
        if (!first || !second || *first == *second) return false;
        for (const auto& [value, object] : {std::pair(a, *first), std::pair(b, *second)}) {
            const ir::NodeId general =
                value_of_counted(builder_, program_, value, wanted.objects[object]);
            if (wanted.value && *wanted.value != general) return false;
            wanted.value = general;
            if (object == wanted.quantified) wanted.value_of_given = value;
        }
        const std::size_t joined = wanted.group[*first], group = wanted.group[*second];
        std::ranges::replace(wanted.group, joined, group);
        return is_countable(builder_, *wanted.value) &&
               !ir::depends_on_any(builder_.properties(*wanted.value),
                                   {wanted.objects.data(), wanted.quantified});
    }
    std::optional<std::size_t> object_in(ir::NodeId value, const Wanted& wanted) {
        std::optional<std::size_t> object;
        for (std::size_t k = wanted.objects.size(); k-- > 0;) {
            if (!ir::depends_on(builder_.properties(value), wanted.objects[k])) continue;
            if (object && *object < wanted.quantified) return std::nullopt;
            object = k;
        }
        return object;
    }
    // All objects are different, each has another one of its value, and the values are two at most;
    // one if a loop gives one of the objects.
    bool can_be_counted(const Wanted& wanted) const {
        const std::size_t count = wanted.objects.size();
        const std::vector<std::int64_t> sizes = wanted.sizes_of_groups();
        return wanted.value && wanted.different.size() == count * (count - 1) / 2 &&
               sizes.back() > 1 && sizes.size() <= (wanted.has_given() ? 1 : 2) &&
               static_cast<std::int64_t>(count) <= objects_of(wanted);
    }

    // ----------------------------------------------------------------------------- counting

    ir::NodeId is_met(const Wanted& wanted, const ValueCounts& counts) {
        const std::vector<std::int64_t> sizes = wanted.sizes_of_groups();
        const auto count = static_cast<std::int64_t>(wanted.objects.size());
        const ir::NodeId all = at_least(builder_, counts, count);
        if (wanted.has_given())
            return is_any(builder_.apply(
                Operator::BitAnd, {all, bit_of(builder_, counts, *wanted.value_of_given, place_)}));
        if (sizes.size() == 1) return is_any(all);
        ir::NodeId alone = are_two(at_least(builder_, counts, sizes[1]));
        if (sizes[0] > sizes[1])
            alone = builder_.apply(Operator::And,
                                   {alone, is_any(at_least(builder_, counts, sizes[0]))});
        return builder_.apply(Operator::Or, {alone, is_any(all)});
    }
    ir::NodeId is_any(ir::NodeId bits) {
        return builder_.apply(Operator::NotEqual, {bits, builder_.constant(std::int64_t{0})});
    }
    // Whether at least two bits are 1.
    ir::NodeId are_two(ir::NodeId bits) {
        const ir::NodeId less =
            builder_.apply(Operator::Subtract, {bits, builder_.constant(std::int64_t{1})});
        return is_any(builder_.apply(Operator::BitAnd, {bits, less}));
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    CountedPlace place_;
    std::map<ir::NodeId, double> compares_;  // by the value that is compared
};

}  // namespace

ir::Program count_equals(ir::Program program, Report& report) {
    return EqualCounting(std::move(program), report).run();
}

}  // namespace rddlc::passes
