// Over 400 lines: one pass, whose steps are of no use to others.
#include "passes/aggregations/count_bits.hpp"

#include "ir/evaluator.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/row_words.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// More words than this cost more than rows of the few entries that they have.
constexpr std::int64_t most_words = 8 * bits_of_an_int;
// Rows of each value of an int that chooses them: at most so many values.
constexpr std::int64_t most_chosen_rows = 16;
// The compiler looks at each of these entries.
constexpr double most_counted_entries = 1e6;

// Where one execution of the aggregation looks.
using Row = std::vector<std::int64_t>;

// Aggregations right inside each other by the same operator, also over rows (ir::ReductionNest has
// whole ranges alone): the outermost first, and what they aggregate.
struct Levels {
    std::vector<ir::Reduce> reduces;
    ir::NodeId term;
};

// Aggregations whose bits can be counted, and the bool that they are about.
struct CountedNest {
    Reduction op;
    std::vector<ir::Reduce> levels;  // outermost first
    ir::NodeId condition;
};

class BitCounting {
  public:
    BitCounting(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(std::as_const(program_)) {}

    ir::Program run() && {
        std::map<ir::NodeId, ir::NodeId> done;
        const auto find = [&](ir::NodeId id) {
            return counted(id);
        };
        ir::change_roots(
            program_, [&](ir::NodeId& root) { root = ir::replace_in(builder_, root, done, find); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    std::optional<ir::NodeId> counted(ir::NodeId id) {
        if (const auto found = counted_in_rows(id)) return found;
        if (const auto found = counted_in_chosen_rows(id)) return found;
        return test_of_rest(id);
    }

    // Where an int of the step is an index of constant tables, its values are one more variable
    // that chooses the row.
    std::optional<ir::NodeId> counted_in_chosen_rows(ir::NodeId id) {
        const Levels nest = levels_of(id);
        if (nest.reduces.empty()) return std::nullopt;
        const auto choice = choice_in(nest.term);
        if (!choice) return std::nullopt;
        const ir::NodeId value = builder_.index(variable_of(choice->values));
        std::map<ir::NodeId, ir::NodeId> known = {{choice->number, value}};
        ++choices_around_;
        const auto found = counted(ir::replace_in(builder_, id, known));
        --choices_around_;
        if (!found) return std::nullopt;
        known = {{value, choice->number}};
        return ir::replace_in(builder_, *found, known);
    }

    struct Choice {
        ir::NodeId number;
        std::int64_t values;
    };
    // The first index of a constant table that is an element at a place that does not change.
    std::optional<Choice> choice_in(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        const auto* load = std::get_if<ir::Load>(&node.form);
        if (load && program_[load->buffer].storage == ir::Storage::Constant)
            for (std::size_t axis = 0; axis < load->indices.size(); ++axis) {
                const ir::NodeId index = load->indices[axis];
                const ir::Properties& properties = builder_.properties(index);
                const std::int64_t values = program_[load->buffer].shape[axis];
                if (ir::buffer_read_by(program_[index]) && !properties.uniform &&
                    properties.free_variables.empty() && values > 1 && values <= most_chosen_rows)
                    return Choice{index, values};
            }
        for (const ir::NodeId operand : ir::operands_of(node))
            if (const auto found = choice_in(operand)) return found;
        return std::nullopt;
    }
    ir::VariableId variable_of(std::int64_t values) {
        const auto [variable, is_new] = choices_.try_emplace(
            std::pair(values, choices_around_),
            ir::VariableId{static_cast<std::uint32_t>(program_.variables.size())});
        if (is_new) program_.variables.push_back({"choice", std::nullopt, values});
        return variable->second;
    }

    std::optional<ir::NodeId> counted_in_rows(ir::NodeId id) {
        if (const auto parts = sum_of_parts(id)) return parts;
        const std::optional<CountedNest> nest = nest_of(id);
        if (!nest) return std::nullopt;
        places_.reset();
        variables_ = builder_.properties(id).free_variables;
        if (!find_places(*nest) || !is_worthwhile(*nest)) return test_of_parts(id);
        ++report_["aggregations that count bits"];
        return nest->op == Reduction::Sum ? sum(*nest) : tested(*nest);
    }

    // sum(int(a) - int(b)) = sum(int(a)) - sum(int(b)), if bits count both; ints wrap around.
    std::optional<ir::NodeId> sum_of_parts(ir::NodeId id) {
        const Levels nest = levels_of(id);
        const auto* apply = std::get_if<ir::Apply>(&program_[nest.term].form);
        const bool has_parts =
            !nest.reduces.empty() && nest.reduces.front().op == Reduction::Sum && apply &&
            program_[nest.term].type == ir::Scalar::Int &&
            is_one_of(apply->op, {Operator::Negate, Operator::Add, Operator::Subtract});
        if (!has_parts) return std::nullopt;
        const ir::Apply parts = *apply;
        std::vector<ir::NodeId> sums;
        for (ir::NodeId part : parts.operands) {
            const auto sum = counted(aggregated(nest, part));
            if (!sum) return std::nullopt;
            sums.push_back(*sum);
        }
        return builder_.apply(parts.op, std::move(sums));
    }

    // forall(a & b) = forall(a) & forall(b), and exists(a | b) = exists(a) | exists(b), if bits
    // count both, or one of them is the same for all objects.
    std::optional<ir::NodeId> test_of_parts(ir::NodeId id) {
        const Levels nest = levels_of(id);
        const Reduction op = nest.reduces.front().op;
        const auto* apply = std::get_if<ir::Apply>(&program_[nest.term].form);
        const Operator connective = op == Reduction::ForAll ? Operator::And : Operator::Or;
        const bool has_parts = op != Reduction::Sum && apply && apply->op == connective &&
                               !builder_.properties(nest.term).may_fault &&
                               std::ranges::all_of(nest.reduces, [&](const ir::Reduce& level) {
                                   return !level.bounds && program_[level.variable].size > 0;
                               });
        if (!has_parts) return std::nullopt;
        const ir::Apply parts = *apply;
        std::vector<ir::NodeId> tests;
        for (ir::NodeId part : parts.operands) {
            const auto test = is_same_in(nest, part) ? part : counted(aggregated(nest, part));
            if (!test) return std::nullopt;
            tests.push_back(*test);
        }
        return builder_.apply(connective, std::move(tests));
    }

    // forall(a | b) = a | forall(b), and exists(a & b) = a & exists(b), if a is the same for all
    // objects and b, of one table, is counted by bits. Rows of two tables have a test of their own
    // (ir/common_rows.hpp).
    std::optional<ir::NodeId> test_of_rest(ir::NodeId id) {
        const Levels nest = levels_of(id);
        if (nest.reduces.empty() || builder_.properties(nest.term).may_fault) return std::nullopt;
        const Reduction op = nest.reduces.front().op;
        if (!is_quantifier(op)) return std::nullopt;
        const Operator connective = op == Reduction::ForAll ? Operator::Or : Operator::And;
        std::vector<ir::NodeId> same, rest;
        for (const ir::NodeId part : ir::parts_of(program_, nest.term, connective))
            (is_same_in(nest, part) ? same : rest).push_back(part);
        if (same.empty() || rest.size() != 1) return std::nullopt;
        const auto test = counted(aggregated(nest, rest.front()));
        if (!test) return std::nullopt;
        same.push_back(*test);
        return ir::joined(builder_, connective, same);
    }

    bool is_same_in(const Levels& nest, ir::NodeId part) const {
        const auto& free = builder_.properties(part).free_variables;
        return std::ranges::none_of(nest.reduces, [&](const ir::Reduce& level) {
            return std::ranges::binary_search(free, level.variable);
        });
    }

    ir::NodeId aggregated(const Levels& nest, ir::NodeId part) {
        for (auto level = nest.reduces.rbegin(); level != nest.reduces.rend(); ++level)
            part = builder_.reduce(level->op, level->variable, part, level->bounds);
        return part;
    }

    // ------------------------------------------------------------------------------ finding

    Levels levels_of(ir::NodeId id) const {
        std::vector<ir::Reduce> levels;
        while (const auto* level = std::get_if<ir::Reduce>(&program_[id].form)) {
            if (!levels.empty() && level->op != levels.front().op) break;
            levels.push_back(*level);
            id = level->body;
        }
        return {std::move(levels), id};
    }

    std::optional<CountedNest> nest_of(ir::NodeId id) const {
        Levels found = levels_of(id);
        if (found.reduces.empty()) return std::nullopt;
        const Reduction op = found.reduces.front().op;
        CountedNest nest{op, std::move(found.reduces), found.term};
        if (nest.op == Reduction::Sum) {
            const auto* convert = std::get_if<ir::Convert>(&program_[nest.condition].form);
            if (!convert || program_[id].type != ir::Scalar::Int) return std::nullopt;
            nest.condition = convert->operand;
        }
        const bool is_of_bools = nest.op == Reduction::Sum || is_quantifier(nest.op);
        if (!is_of_bools || program_[nest.condition].type != ir::Scalar::Bool) return std::nullopt;
        return nest;
    }

    // Sets places_; false if the condition is not about elements at known places.
    bool find_places(const CountedNest& nest) {
        double entries = 1;
        for (const ir::VariableId variable : variables_) entries *= size_of(variable);
        for (const ir::Reduce& level : nest.levels) entries *= size_of(level.variable);
        if (entries > most_counted_entries || !is_about_bools(nest.condition)) return false;
        std::vector<ir::NodeId> loads;
        collect_loads(nest.condition, loads);
        if (loads.empty() || !have_one_size(loads)) return false;
        for (const ir::NodeId load : loads) {
            std::vector<Row> rows = rows_of(nest, std::get<ir::Load>(program_[load].form));
            if (places_ && rows != *places_) return false;
            places_ = std::move(rows);
        }
        if (are_different(*places_)) return true;
        return nest.op != Reduction::Sum && known_parts_agree(nest);
    }

    // Entries of a row that share a place share its bit, so each known part of the condition must
    // have one value for all of them.
    bool known_parts_agree(const CountedNest& nest) {
        std::vector<ir::NodeId> known;
        collect_known(nest.condition, known);
        return std::ranges::all_of(known, [&](ir::NodeId part) {
            const std::vector<Row> where = places_of(nest, part, true);
            const std::vector<Row> where_not = places_of(nest, part, false);
            return std::ranges::equal(where, where_not, are_disjoint);
        });
    }

    void collect_known(ir::NodeId id, std::vector<ir::NodeId>& known) const {
        if (builder_.properties(id).uniform) return known.push_back(id);
        if (std::holds_alternative<ir::Load>(program_[id].form)) return;
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            collect_known(operand, known);
    }

    // By row: the places, sorted, of the entries for which a known condition has the value.
    std::vector<Row> places_of(const CountedNest& nest, ir::NodeId condition, bool value) {
        std::vector<Row> places(row_count());
        for_each_place(nest, [&](ir::Evaluator::Frame& frame, std::size_t row, std::int64_t place) {
            if (evaluator_.value<bool>(condition, frame) == value) places[row].push_back(place);
        });
        for (Row& row : places) std::ranges::sort(row);
        return places;
    }

    static bool are_disjoint(const Row& a, const Row& b) {
        Row both;
        std::ranges::set_intersection(a, b, std::back_inserter(both));
        return both.empty();
    }

    double size_of(ir::VariableId variable) const {
        return static_cast<double>(program_[variable].size);
    }

    // Connectives of elements of tables of bools, and of what the compiler knows.
    bool is_about_bools(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.uniform) return !properties.may_fault;
        if (const auto* load = std::get_if<ir::Load>(&program_[id].form)) {
            return std::ranges::all_of(load->indices, [&](ir::NodeId index) {
                return builder_.properties(index).uniform && !builder_.properties(index).may_fault;
            });
        }
        const auto* apply = std::get_if<ir::Apply>(&program_[id].form);
        if (!apply || program_[apply->operands.front()].type != ir::Scalar::Bool) return false;
        return std::ranges::all_of(apply->operands,
                                   [&](ir::NodeId operand) { return is_about_bools(operand); });
    }

    void collect_loads(ir::NodeId id, std::vector<ir::NodeId>& loads) const {
        if (builder_.properties(id).uniform) return;
        if (std::holds_alternative<ir::Load>(program_[id].form)) return loads.push_back(id);
        for (const ir::NodeId operand : ir::operands_of(program_[id]))
            collect_loads(operand, loads);
    }

    bool have_one_size(const std::vector<ir::NodeId>& loads) const {
        const auto size_of_table = [&](ir::NodeId load) {
            return program_[std::get<ir::Load>(program_[load].form).buffer].count();
        };
        const std::int64_t size = size_of_table(loads.front());
        return size <= most_words && std::ranges::all_of(loads, [&](ir::NodeId load) {
                   return size_of_table(load) == size;
               });
    }

    // Calls visit(frame, row) for every entry of every row.
    template <class Visit>
    void for_each_entry(const CountedNest& nest, const Visit& visit) {
        Context context;
        ir::Evaluator::Frame frame(evaluator_, {}, context);
        std::int64_t row = 0;
        const auto over_entries = [&](const auto& self, std::size_t depth) -> void {
            if (depth == nest.levels.size()) return visit(frame, row);
            const ir::Reduce& level = nest.levels[depth];
            const auto& bounds = level.bounds;
            const std::int64_t begin = bounds ? int_of(bounds->begin, frame) : 0;
            const std::int64_t end =
                bounds ? int_of(bounds->end, frame) : program_[level.variable].size;
            for (std::int64_t i = begin; i < end; ++i) {
                frame.set(level.variable, i);
                self(self, depth + 1);
            }
        };
        const auto over_rows = [&](const auto& self, std::size_t depth) -> void {
            if (depth == variables_.size()) {
                over_entries(over_entries, 0);
                ++row;
                return;
            }
            for (std::int64_t i = 0; i < program_[variables_[depth]].size; ++i) {
                frame.set(variables_[depth], i);
                self(self, depth + 1);
            }
        };
        over_rows(over_rows, 0);
    }

    // Calls visit(frame, row, place) for every entry of every row, once places_ are known.
    template <class Visit>
    void for_each_place(const CountedNest& nest, const Visit& visit) {
        std::vector<std::size_t> entries(row_count());
        for_each_entry(nest, [&](ir::Evaluator::Frame& frame, std::int64_t index) {
            const auto row = static_cast<std::size_t>(index);
            visit(frame, row, (*places_)[row][entries[row]++]);
        });
    }

    std::int64_t int_of(ir::NodeId id, ir::Evaluator::Frame& frame) const {
        return evaluator_.value<std::int64_t>(id, frame);
    }

    std::size_t row_count() const {
        std::size_t count = 1;
        for (const ir::VariableId variable : variables_)
            count *= static_cast<std::size_t>(program_[variable].size);
        return count;
    }

    std::vector<Row> rows_of(const CountedNest& nest, const ir::Load& load) {
        const ir::Buffer& buffer = program_[load.buffer];
        size_ = buffer.count();
        std::vector<Row> rows(row_count());
        for_each_entry(nest, [&](ir::Evaluator::Frame& frame, std::int64_t row) {
            std::int64_t place = 0;
            for (std::size_t axis = 0; axis < load.indices.size(); ++axis)
                place = place * buffer.shape[axis] + int_of(load.indices[axis], frame);
            rows[static_cast<std::size_t>(row)].push_back(place);
        });
        return rows;
    }

    static bool are_different(std::vector<Row> rows) {
        return std::ranges::all_of(rows, [](Row& row) {
            std::ranges::sort(row);
            return std::ranges::adjacent_find(row) == row.end();
        });
    }

    // Bits are made once, which takes packs a while, then every row looks at some words in place of
    // entries.
    bool is_worthwhile(const CountedNest& nest) const {
        constexpr double cost_of_making = 8, cost_of_word = 3, cost_of_entry = 2;
        double entries = 0;
        for (const Row& row : *places_) entries += static_cast<double>(row.size());
        if (nest.op != Reduction::Sum && tests_new_bools_once(nest, entries)) return false;
        const auto rows = static_cast<double>(places_->size());
        const auto words = static_cast<double>(word_count());
        const double in_bits =
            static_cast<double>(size_) + words * (cost_of_making + rows * cost_of_word);
        return entries * (builder_.properties(nest.condition).cost + cost_of_entry) > in_bits;
    }

    // The step makes each element and tests it once, in a short row. Bits wait until all elements
    // have been stored, one by one. A loop over a short row may take them from registers.
    bool tests_new_bools_once(const CountedNest& nest, double entries) const {
        constexpr std::size_t longest = 4;
        if (entries > static_cast<double>(size_)) return false;
        std::vector<ir::NodeId> loads;
        collect_loads(nest.condition, loads);
        const auto is_short = [](const Row& row) {
            return row.size() <= longest;
        };
        const auto is_made_by_step = [&](ir::NodeId load) {
            const ir::BufferId buffer = std::get<ir::Load>(program_[load].form).buffer;
            return program_[buffer].storage == ir::Storage::Scratch;
        };
        return std::ranges::all_of(*places_, is_short) &&
               std::ranges::all_of(loads, is_made_by_step);
    }

    // ------------------------------------------------------------------------------- making

    std::int64_t word_count() const { return (size_ + bits_of_an_int - 1) / bits_of_an_int; }

    ir::NodeId sum(const CountedNest& nest) {
        ir::NodeId total = builder_.constant(std::int64_t{0});
        for (std::int64_t word = 0; word < word_count(); ++word) {
            const ir::NodeId bits = counted_word(nest, true, word);
            total =
                builder_.apply(Operator::Add, {total, builder_.apply(Operator::CountOnes, {bits})});
        }
        return total;
    }

    // Whether there is an entry where the condition holds, or none where it does not.
    ir::NodeId tested(const CountedNest& nest) {
        const bool looked_for = nest.op == Reduction::Exists;
        ir::NodeId found = builder_.constant(std::int64_t{0});
        for (std::int64_t word = 0; word < word_count(); ++word)
            found = joined(Operator::BitOr, found, counted_word(nest, looked_for, word));
        return builder_.apply(looked_for ? Operator::NotEqual : Operator::Equal,
                              {found, builder_.constant(std::int64_t{0})});
    }

    // Ones for the elements of a word that count and where the condition is `value`.
    ir::NodeId counted_word(const CountedNest& nest, bool value, std::int64_t word) {
        const ir::NodeId bits = word_of(nest, nest.condition, value, word);
        const ir::NodeId counting = known_word(nest, builder_.constant(true), true, word);
        const auto* all = std::get_if<ir::Constant>(&program_[counting].form);
        const bool all_count = all && all->value == ir::Value(whole_word(word));
        if (is_zero_where_none_counts(nest.condition, value) ||
            (all_count && is_zero_beyond_end(nest.condition, value)))
            return bits;
        return joined(Operator::BitAnd, bits, counting);
    }

    // Ones for the elements of a word where the condition is `value`, whether or not they count.
    ir::NodeId word_of(const CountedNest& nest, ir::NodeId id, bool value, std::int64_t word) {
        if (builder_.properties(id).uniform) return known_word(nest, id, value, word);
        if (const auto* load = std::get_if<ir::Load>(&program_[id].form)) {
            const ir::NodeId bits = builder_.bits(load->buffer, word * bits_of_an_int);
            return value ? bits : inverted(bits);
        }
        const Connective form = connective(id, value);
        const ir::NodeId a = word_of(nest, form.a.id, form.a.value, word);
        const ir::NodeId b = word_of(nest, form.b.id, form.b.value, word);
        return joined(form.op, a, b);
    }

    // Whether its words are 0 for elements that do not count, as those of known conditions are.
    bool is_zero_where_none_counts(ir::NodeId id, bool value) const {
        if (builder_.properties(id).uniform) return true;
        if (std::holds_alternative<ir::Load>(program_[id].form)) return false;
        const Connective form = connective(id, value);
        const bool a = is_zero_where_none_counts(form.a.id, form.a.value);
        const bool b = is_zero_where_none_counts(form.b.id, form.b.value);
        return form.op == Operator::BitAnd ? a || b : a && b;
    }
    // Whether its words are 0 where there are no elements.
    bool is_zero_beyond_end(ir::NodeId id, bool value) const {
        if (builder_.properties(id).uniform) return true;
        if (std::holds_alternative<ir::Load>(program_[id].form)) return value;
        const Connective form = connective(id, value);
        const bool a = is_zero_beyond_end(form.a.id, form.a.value);
        const bool b = is_zero_beyond_end(form.b.id, form.b.value);
        return form.op == Operator::BitAnd ? a || b : a && b;
    }

    // Where a condition has a value.
    struct Where {
        ir::NodeId id;
        bool value;
    };
    struct Connective {
        Operator op;
        Where a, b;
    };

    // Negations go down to the elements (De Morgan).
    Connective connective(ir::NodeId id, bool value) const {
        const auto& apply = std::get<ir::Apply>(program_[id].form);
        const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
        const auto either_or = [&](bool intersects) {
            return intersects ? Operator::BitAnd : Operator::BitOr;
        };
        if (apply.op == Operator::Not) return {Operator::BitAnd, {a, !value}, {a, !value}};
        if (apply.op == Operator::And) return {either_or(value), {a, value}, {b, value}};
        if (apply.op == Operator::Or) return {either_or(!value), {a, value}, {b, value}};
        if (apply.op == Operator::Implies) return {either_or(!value), {a, !value}, {b, value}};
        const bool is_equal = apply.op != Operator::NotEqual;
        return {Operator::BitXor, {a, true}, {b, value != is_equal}};
    }

    // Ones for the elements that there are.
    std::int64_t whole_word(std::int64_t word) const {
        return first_bits(std::min(size_ - word * bits_of_an_int, bits_of_an_int));
    }

    ir::NodeId inverted(ir::NodeId bits) {
        return joined(Operator::BitXor, bits, builder_.constant(std::int64_t{-1}));
    }

    ir::NodeId joined(Operator op, ir::NodeId a, ir::NodeId b) {
        return builder_.apply(op, {a, b});
    }

    // The word of a condition that the compiler knows: by row; 0 for elements that do not count.
    ir::NodeId known_word(const CountedNest& nest, ir::NodeId condition, bool value,
                          std::int64_t word) {
        std::vector<std::uint64_t> words(row_count());
        for_each_place(nest, [&](ir::Evaluator::Frame& frame, std::size_t row, std::int64_t place) {
            const std::int64_t bit = place - word * bits_of_an_int;
            if (bit < 0 || bit >= bits_of_an_int) return;
            if (evaluator_.value<bool>(condition, frame) == value)
                words[row] |= std::uint64_t{1} << bit;
        });
        return element(nest, words);
    }

    // The element of a table by row, if rows differ.
    ir::NodeId element(const CountedNest& nest, const std::vector<std::uint64_t>& words) {
        std::vector<ir::Value> values;
        for (const std::uint64_t bits : words) values.emplace_back(static_cast<std::int64_t>(bits));
        const bool are_equal = std::ranges::all_of(
            values, [&](const ir::Value& value) { return identical(value, values.front()); });
        if (are_equal) return builder_.constant(values.front());
        const ir::Buffer& origin = program_[origin_of(nest)];
        ir::Buffer table{.name = without_ending(origin.name, "-rows") + "-bits",
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Int,
                         .values = std::move(values),
                         .span = origin.span};
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables_)
            indices.push_back(builder_.index(variable));
        ir::set_dimensions(program_, table, variables_);
        return builder_.load(builder_.tables().constant(std::move(table)), std::move(indices));
    }

    // The sparse table whose rows these are, or else the first one that is read.
    ir::BufferId origin_of(const CountedNest& nest) const {
        for (const ir::Reduce& level : nest.levels) {
            const ir::Load* row = level.bounds ? ir::row_of(program_, *level.bounds) : nullptr;
            if (row) return row->buffer;
        }
        std::vector<ir::NodeId> loads;
        collect_loads(nest.condition, loads);
        return std::get<ir::Load>(program_[loads.front()].form).buffer;
    }

    static std::string without_ending(const std::string& name, std::string_view ending) {
        return name.ends_with(ending) ? name.substr(0, name.size() - ending.size()) : name;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;
    // By the number of values and of other choices around: two ints of a type have two variables.
    std::map<std::pair<std::int64_t, int>, ir::VariableId> choices_;
    int choices_around_ = 0;

    // Members of the aggregation at hand.
    std::vector<ir::VariableId> variables_;  // that choose the row
    std::optional<std::vector<Row>> places_;
    std::int64_t size_ = 0;  // elements of its tables
};

}  // namespace

ir::Program count_bits(ir::Program program, Report& report) {
    return BitCounting(std::move(program), report).run();
}

}  // namespace rddlc::passes
