#include "passes/aggregations/tabulate_sums.hpp"

#include "ir/analysis.hpp"
#include "ir/evaluator.hpp"
#include "ir/fill_table.hpp"
#include "ir/fold.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/row_words.hpp"
#include "passes/analyses/constant_values.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Fewer terms are added in the time that their bits take.
constexpr std::int64_t least_terms = 4;
// The table has an entry for each set of the first ones, and another table two for each other one.
constexpr std::int64_t most_in_table = 8;
constexpr std::int64_t most_terms = 16;

using Values = std::vector<ir::Value>;

class SumTabulation {
  public:
    SumTabulation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        program_.reward.value = ir::replace_reductions_in(
            builder_, program_.reward.value, [&](ir::NodeId id) { return looked_up(id); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        if (!is_sum_of_few(id)) return std::nullopt;
        const ir::Reduce sum = std::get<ir::Reduce>(program_[id].form);
        const auto condition = only_bool(sum.body);
        if (!condition ||
            !ir::depends_on_none_but(builder_.properties(*condition), {&sum.variable, 1}) ||
            (!reads_spread_row(*condition) && !is_in_short_row_of_state(*condition)))
            return std::nullopt;
        const auto if_true = values_where(sum, *condition, true),
                   if_false = values_where(sum, *condition, false);
        if (!if_true || !if_false) return std::nullopt;
        ++report_["sums of constants that bools choose looked up"];
        return sum_by(word_of(*condition, sum.variable), *if_true, *if_false);
    }

    // It neither draws nor faults, and is of reals.
    bool is_sum_of_few(ir::NodeId id) const {
        const auto& sum = std::get<ir::Reduce>(program_[id].form);
        const ir::Properties& properties = builder_.properties(id);
        const std::int64_t terms = program_[sum.variable].size;
        return sum.op == Reduction::Sum && !sum.bounds && program_[id].type == ir::Scalar::Real &&
               terms >= least_terms && terms <= most_terms && properties.free_variables.empty() &&
               ir::is_droppable(properties) && !are_rounded_as_floats(sum.body);
    }

    // ------------------------------------------------------------------------------- terms

    // The bool that alone decides a term, beside constants.
    std::optional<ir::NodeId> only_bool(ir::NodeId term) const {
        if (builder_.properties(term).uniform) return std::nullopt;
        if (program_[term].type == ir::Scalar::Bool) return term;
        std::optional<ir::NodeId> only;
        for (const ir::NodeId operand : ir::operands_of(program_[term])) {
            if (builder_.properties(operand).uniform || operand == only) continue;
            if (only) return std::nullopt;
            only = operand;
        }
        return only ? only_bool(*only) : std::nullopt;
    }

    // The evaluator knows doubles alone.
    bool are_rounded_as_floats(ir::NodeId terms) const {
        return program_.real == RealType::Float &&
               ir::any_node_of(program_, terms, [&](ir::NodeId id) { return may_round(id); });
    }
    bool may_round(ir::NodeId id) const {
        const ir::Node& node = program_[id];
        if (node.type != ir::Scalar::Real) return false;
        if (std::holds_alternative<ir::Reduce>(node.form)) return true;
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        return apply && (apply->op != Operator::Multiply ||
                         std::ranges::none_of(apply->operands, [&](ir::NodeId factor) {
                             return ir::converted_bool(program_, factor).has_value();
                         }));
    }

    // The term of each object where the bool has this value.
    std::optional<Values> values_where(const ir::Reduce& sum, ir::NodeId condition, bool value) {
        std::map<ir::NodeId, ir::NodeId> known{{condition, builder_.constant(value)}};
        const ir::NodeId term = ir::replace_in(builder_, sum.body, known);
        if (!builder_.properties(term).uniform) return std::nullopt;
        const ir::Evaluator evaluator(std::as_const(program_));
        return constant_values(evaluator, program_, term, {sum.variable});
    }

    // ------------------------------------------------------------------------------ tables

    ir::NodeId sum_by(ir::NodeId word, const Values& if_true, const Values& if_false) {
        const auto terms = std::ssize(if_true), first = std::min(terms, most_in_table);
        ir::NodeId sum = look_up("reward-sums", bits_of(word, 0, first, terms),
                                 sums_of_first(first, if_true, if_false));
        for (std::int64_t i = first; i < terms; ++i) {
            const Values either{if_false[i], if_true[i]};
            sum = builder_.apply(
                Operator::Add, {sum, look_up("reward-terms", bits_of(word, i, 1, terms), either)});
        }
        return sum;
    }
    ir::NodeId look_up(const std::string& name, ir::NodeId place, const Values& values) {
        const ir::BufferId table =
            builder_.tables().list(name, ir::Scalar::Real, values, program_.reward.span);
        return builder_.load(table, {place});
    }
    // So many bits of a word of `all` bits.
    ir::NodeId bits_of(ir::NodeId word, std::int64_t first, std::int64_t count, std::int64_t all) {
        if (first > 0)
            word = builder_.apply(Operator::ShiftRight, {word, builder_.constant(first)});
        if (first + count == all) return word;
        return builder_.apply(Operator::BitAnd, {word, builder_.constant(first_bits(count))});
    }

    // The sums of the first terms by the bits of their bools, added in their order.
    Values sums_of_first(std::int64_t count, const Values& if_true, const Values& if_false) const {
        Values sums{0.0};
        for (std::int64_t i = 0; i < count; ++i) {
            const Values with = added(sums, if_true[i]);
            sums = added(sums, if_false[i]);
            sums.insert(sums.end(), with.begin(), with.end());
        }
        return sums;
    }
    // As steps add: floats are rounded.
    Values added(Values sums, const ir::Value& term) const {
        const auto in_a_step = [&](const ir::Value& value) {
            return ir::as_in_a_step(value, program_.real);
        };
        for (ir::Value& sum : sums)
            sum = in_a_step(*ir::fold(Operator::Add, std::array{sum, in_a_step(term)}));
        return sums;
    }

    // -------------------------------------------------------------------------------- bools

    ir::NodeId word_of(ir::NodeId condition, ir::VariableId object) {
        RowWords words(builder_, object, [&](ir::NodeId id) -> std::optional<ir::NodeId> {
            const ir::BufferId table = builder_.tables().scratch("reward-bools", ir::Scalar::Bool,
                                                                 builder_.properties(id).range,
                                                                 {object}, program_.reward.span);
            ir::fill_table(builder_, program_.reward.body, table, {object}, id);
            return builder_.bits(table, 0);
        });
        std::map<ir::NodeId, ir::NodeId> known;
        return ir::replace_in(builder_, *words.word_of(condition), known,
                              [&](ir::NodeId id) -> std::optional<ir::NodeId> {
                                  const auto* bits = std::get_if<ir::Bits>(&program_[id].form);
                                  return bits ? spread_into(bits->buffer) : std::nullopt;
                              });
    }

    // The int that is spread into a row: one of registers needs no bits of bools, which would take
    // longer than adding the terms.
    std::optional<ir::NodeId> spread_into(ir::BufferId row) const {
        for (const ir::Statement& statement : program_.reward.body) {
            const auto* spread = std::get_if<ir::Spread>(&statement.form);
            if (spread && spread->target == row) return spread->bits;
        }
        return std::nullopt;
    }
    bool reads_spread_row(ir::NodeId id) const {
        return ir::any_node_of(program_, id, [&](ir::NodeId each) {
            const auto buffer = ir::buffer_read_by(program_[each]);
            return buffer && spread_into(*buffer);
        });
    }

    // An element of a row that is one load of the record, or its opposite: other bools of the step
    // would have to be joined first. Behind a table, terms are added as fast as they are looked up.
    bool is_in_short_row_of_state(ir::NodeId id) const {
        const auto* negation = std::get_if<ir::Apply>(&program_[id].form);
        if (negation && negation->op == Operator::Not) id = negation->operands.front();
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && program_[load->buffer].storage == ir::Storage::State &&
               load->indices.size() == 1 && program_[load->buffer].count() <= most_in_table &&
               std::holds_alternative<ir::Index>(program_[load->indices.front()].form);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program tabulate_sums(ir::Program program, Report& report) {
    return SumTabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
