#include "passes/aggregations/set_bits.hpp"

#include "ir/analysis.hpp"
#include "ir/call.hpp"
#include "ir/nest.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/row_words.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Fewer elements are computed one by one in the time that their bits take.
constexpr std::int64_t least_bits = 8;
// The sum over a row in the reward may be looked up by them (tabulate_sums.hpp).
constexpr std::int64_t least_bits_in_reward = 4;
// More ints than this set no bits, since the text has a term for each of them.
constexpr std::int64_t most_ints = 8;

class BitSetting {
  public:
    BitSetting(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) change(definition);
        separate_rows(program_.reward);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // ------------------------------------------------------------- rows that are computed whole

    void change(ir::Definition& definition) {
        auto* const outermost = ir::only_statement<ir::Loop>(definition.body);
        if (!outermost) return;
        std::vector<ir::VariableId> rows = ir::nest_of(*outermost).variables;
        const auto* found = ir::only_statement<ir::Store>(ir::innermost_body(*outermost));
        if (!found) return;
        const ir::Store store = *found;
        const ir::Buffer& target = program_[store.target];
        const bool may_be = target.scalar == ir::Scalar::Bool && target.is_computed_in_step() &&
                            ir::are_variables_of(program_, store.indices, {rows, nullptr}) &&
                            ir::is_droppable(builder_.properties(store.value)) &&
                            ir::is_known_before(program_, store.value, {store.target});
        if (!may_be) return;
        name_ = program_[store.target].name;
        span_ = definition.span;
        element_ = rows.back();
        rows.pop_back();
        if (size() < least_bits || size() > bits_of_an_int) return;
        sets_bits_ = false;
        const auto word = words().word_of(store.value);
        if (!word || !sets_bits_) return;
        definition.body = ir::looped(
            {{ir::Spread{store.target, {store.indices.begin(), store.indices.end() - 1}, *word}}},
            rows);
        ++report_["rows of bools whose bits are set"];
    }

    // ------------------------------------------------------------------ rows inside expressions

    // An exists of each element gets a row of its own, filled before.
    void separate_rows(ir::Computation& reward) {
        name_ = "reward";
        span_ = reward.span;
        ir::Block before;
        std::map<ir::NodeId, ir::NodeId> done;
        reward.value = ir::replace_in(builder_, reward.value, done,
                                      [&](ir::NodeId id) { return element_of_row(id, before); });
        reward.body.insert(reward.body.end(), std::make_move_iterator(before.begin()),
                           std::make_move_iterator(before.end()));
    }
    std::optional<ir::NodeId> element_of_row(ir::NodeId id, ir::Block& before) {
        const ir::Properties properties = builder_.properties(id);
        if (!std::holds_alternative<ir::Reduce>(program_[id].form) ||
            properties.free_variables.size() != 1 || !ir::is_droppable(properties))
            return std::nullopt;
        element_ = properties.free_variables.front();
        if (size() < least_bits_in_reward || size() > bits_of_an_int) return std::nullopt;
        const auto word = word_of_exists(id);
        if (!word) return std::nullopt;
        const ir::BufferId row = builder_.tables().scratch(name_ + "-row", ir::Scalar::Bool,
                                                           properties.range, {element_}, span_);
        before.push_back({ir::Spread{row, {}, *word}});
        ++report_["rows of bools whose bits are set"];
        return builder_.load(row, {builder_.index(element_)});
    }

    // ------------------------------------------------------------------------- ints of objects

    // exists[d](condition[d] && value[d] == element): the bit of each value whose condition holds.
    std::optional<ir::NodeId> word_of_exists(ir::NodeId id) {
        const auto nest = ir::whole_reduction_nest(program_, id, Reduction::Exists);
        if (!nest || ir::combinations(program_, nest->variables) > most_ints) return std::nullopt;
        std::vector<ir::NodeId> conditions = ir::parts_of(program_, nest->body, Operator::And);
        const auto equality = std::ranges::find_if(
            conditions, [&](ir::NodeId part) { return depends_on_element(part); });
        if (equality == conditions.end()) return std::nullopt;
        const auto value = value_that_is_element(*equality);
        conditions.erase(equality);
        const bool is_only_one = std::ranges::none_of(
            conditions, [&](ir::NodeId part) { return depends_on_element(part); });
        if (!value || !is_only_one) return std::nullopt;
        const auto bit = bit_of(*value);
        if (!bit) return std::nullopt;
        sets_bits_ = true;
        const ir::NodeId term =
            builder_.select(ir::joined(builder_, Operator::And, conditions), *bit, words().none());
        return united(term, nest->variables);
    }

    // `value == element`, in either order.
    std::optional<ir::NodeId> value_that_is_element(ir::NodeId part) {
        const auto* apply = std::get_if<ir::Apply>(&program_[part].form);
        if (!apply || apply->op != Operator::Equal) return std::nullopt;
        ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (a == builder_.index(element_)) std::swap(a, b);
        return b == builder_.index(element_) && !depends_on_element(a) ? std::optional(a)
                                                                       : std::nullopt;
    }

    // The bit of an int, looked up: 0 for ints that are the place of no element.
    std::optional<ir::NodeId> bit_of(ir::NodeId value) {
        const auto range = builder_.properties(value).range;
        if (!range || range->lower < 0 || range->upper >= bits_of_an_int) return std::nullopt;
        std::vector<ir::Value> bits;
        for (std::int64_t i = 0; i <= static_cast<std::int64_t>(range->upper); ++i)
            bits.emplace_back(
                static_cast<std::int64_t>(i < size() ? std::uint64_t{1} << i : std::uint64_t{0}));
        const ir::BufferId table =
            builder_.tables().list(name_ + "-bit", ir::Scalar::Int, bits, span_);
        return builder_.load(table, {value});
    }

    // The bits of a term for all objects.
    ir::NodeId united(ir::NodeId term, const std::vector<ir::VariableId>& variables) {
        ir::NodeId bits = words().none();
        for (std::int64_t i = 0; i < ir::combinations(program_, variables); ++i) {
            std::map<ir::NodeId, ir::NodeId> known = ir::combination(builder_, variables, i);
            bits = words().either(bits, ir::replace_in(builder_, term, known));
        }
        return bits;
    }

    RowWords words() {
        return {builder_, element_, [this](ir::NodeId id) {
                    return word_of_exists(id);
                }};
    }
    std::int64_t size() const { return program_[element_].size; }
    bool depends_on_element(ir::NodeId id) const {
        return ir::depends_on_any(builder_.properties(id), {&element_, 1});
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;

    // Members of the row at hand.
    std::string name_;
    Span span_;
    ir::VariableId element_ = {};  // the innermost one: its objects are the bits
    bool sets_bits_ = false;       // an int of an object does
};

}  // namespace

ir::Program set_bits(ir::Program program, Report& report) {
    return BitSetting(std::move(program), report).run();
}

}  // namespace rddlc::passes
