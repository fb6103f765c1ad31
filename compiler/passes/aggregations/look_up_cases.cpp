#include "passes/aggregations/look_up_cases.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Fewer ones jump sooner.
constexpr std::size_t fewest_cases = 3, fewest_counts = 2;
// The bits of counts up to here choose from a table of 256 elements.
constexpr double largest_count = 7;

// `condition && count == constant`, where the constants alone differ between cases.
struct Counted {
    std::vector<ir::NodeId> condition;  // parts of a conjunction
    ir::NodeId count;
    bool operator==(const Counted&) const = default;
};
struct Case {
    std::int64_t constant;
    ir::NodeId value;
};
struct Cases {
    std::vector<Counted> counts;  // the same in all cases: one of them at least is met
    std::vector<Case> cases;
    ir::NodeId otherwise;
};
// A value as a row of constants that one int, the same for all cases, chooses from.
struct Rows {
    ir::NodeId index;
    std::vector<std::vector<ir::Value>> rows;
};

class LookingUp {
  public:
    LookingUp(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_)) {
            begin(program_[definition->target].name, definition->span);
            ir::change_roots(definition->body, [&](ir::NodeId& root) { root = rewritten(root); });
        }
        begin("reward", program_.reward.span);
        program_.reward.value = rewritten(program_.reward.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void begin(const std::string& name, Span span) {
        name_ = name;
        span_ = span;
    }
    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, known_,
                              [&](ir::NodeId each) { return looked_up(each); });
    }

    std::optional<ir::NodeId> looked_up(ir::NodeId id) {
        const ir::Properties& properties = builder_.properties(id);
        if (program_[id].type != ir::Scalar::Int || !ir::is_droppable(properties))
            return std::nullopt;
        const auto cases = cases_of(id);
        if (!cases || cases->cases.size() < fewest_cases) return std::nullopt;
        const auto rows = rows_of(*cases);
        if (!rows) return std::nullopt;
        ++report_["cases that counts look up"];
        const ir::NodeId which = builder_.load(
            table_of_firsts(cases->cases, greatest_of(cases->counts)), {bits_of(cases->counts)});
        return builder_.load(table_of_rows(*rows), {which, rows->index});
    }

    // ------------------------------------------------------------------------------- cases

    // All leading cases of the chain that ask the same counts.
    std::optional<Cases> cases_of(ir::NodeId id) const {
        std::optional<Cases> cases;
        while (const auto* select = std::get_if<ir::Select>(&program_[id].form)) {
            const auto met = condition_of(select->condition);
            if (!met || (cases && met->counts != cases->counts)) break;
            if (!cases) cases = Cases{.counts = met->counts, .cases = {}, .otherwise = id};
            cases->cases.push_back({met->constant, select->then_value});
            cases->otherwise = id = select->else_value;
        }
        return cases;
    }

    struct Condition {
        std::vector<Counted> counts;
        std::int64_t constant;
    };
    std::optional<Condition> condition_of(ir::NodeId id) const {
        Condition condition{};
        const std::vector<ir::NodeId> parts = ir::parts_of(program_, id, Operator::Or);
        if (parts.size() < fewest_counts) return std::nullopt;
        for (const ir::NodeId part : parts) {
            const auto constant = add_counted(part, condition.counts);
            if (!constant || (part != parts.front() && *constant != condition.constant))
                return std::nullopt;
            condition.constant = *constant;
        }
        return condition;
    }
    // The constant with which the last part of a conjunction compares a count.
    std::optional<std::int64_t> add_counted(ir::NodeId id, std::vector<Counted>& counts) const {
        std::vector<ir::NodeId> parts = ir::parts_of(program_, id, Operator::And);
        const auto* test = std::get_if<ir::Apply>(&program_[parts.back()].form);
        if (parts.size() < 2 || !test || test->op != Operator::Equal) return std::nullopt;
        const ir::NodeId count = test->operands.front();
        const auto constant = ir::constant<std::int64_t>(program_, test->operands.back());
        if (!constant || !is_count(count)) return std::nullopt;
        parts.pop_back();
        counts.push_back({std::move(parts), count});
        return constant;
    }
    bool is_count(ir::NodeId id) const {
        const auto& range = builder_.properties(id).range;
        return std::holds_alternative<ir::Reduce>(program_[id].form) && range &&
               range->lower >= 0 && range->upper <= largest_count;
    }

    // -------------------------------------------------------------------------------- rows

    // The rows of all cases, and that of what is left where none is met.
    std::optional<Rows> rows_of(const Cases& cases) const {
        std::optional<ir::NodeId> index;
        std::int64_t length = 0;
        for (const Case& each : cases.cases) {
            const auto* load = row_of_constants(each.value);
            if (!load || (index && *index != load->indices.front())) return std::nullopt;
            index = load->indices.front();
            length = program_[load->buffer].count();
        }
        Rows rows{*index, {}};
        const auto add = [&](ir::NodeId value) {
            const auto* load = row_of_constants(value);
            if (value != *index && (!load || load->indices.front() != *index)) return false;
            if (load && program_[load->buffer].count() != length) return false;
            std::vector<ir::Value>& row = rows.rows.emplace_back();
            for (std::int64_t k = 0; k < length; ++k)
                row.push_back(load ? program_[load->buffer].values[static_cast<std::size_t>(k)]
                                   : ir::Value(k));
            return true;
        };
        for (const Case& each : cases.cases)
            if (!add(each.value)) return std::nullopt;
        return add(cases.otherwise) ? std::optional(rows) : std::nullopt;
    }
    const ir::Load* row_of_constants(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && load->indices.size() == 1 &&
                       program_[load->buffer].storage == ir::Storage::Constant
                   ? load
                   : nullptr;
    }

    // ----------------------------------------------------------------------------- look-ups

    // The bits of the values of all counts that take part.
    ir::NodeId bits_of(const std::vector<Counted>& counts) {
        std::vector<ir::Value> bits;
        for (std::int64_t value = 0; value <= greatest_of(counts); ++value)
            bits.push_back(std::int64_t{1} << value);
        const ir::BufferId bit =
            builder_.tables().list(name_ + "-bit", ir::Scalar::Int, bits, span_);
        std::optional<ir::NodeId> all;
        for (const Counted& each : counts) {
            const ir::NodeId count = rewritten(each.count);
            const ir::NodeId condition =
                rewritten(ir::joined(builder_, Operator::And, each.condition));
            const ir::NodeId its = builder_.select(condition, builder_.load(bit, {count}),
                                                   builder_.constant(std::int64_t{0}));
            all = all ? builder_.apply(Operator::BitOr, {*all, its}) : its;
        }
        return *all;
    }
    std::int64_t greatest_of(const std::vector<Counted>& counts) const {
        double greatest = 0;
        for (const Counted& each : counts)
            greatest = std::max(greatest, builder_.properties(each.count).range->upper);
        return static_cast<std::int64_t>(greatest);
    }
    // By the bits: the first case that is met, or how many cases there are.
    ir::BufferId table_of_firsts(const std::vector<Case>& cases, std::int64_t greatest) {
        std::vector<ir::Value> firsts;
        for (std::int64_t bits = 0; bits < std::int64_t{2} << greatest; ++bits) {
            const auto is_met = [&](const Case& each) {
                return each.constant >= 0 && each.constant <= greatest &&
                       (bits >> each.constant & 1) != 0;
            };
            firsts.push_back(std::ranges::find_if(cases, is_met) - cases.begin());
        }
        return builder_.tables().list(name_ + "-case", ir::Scalar::Int, firsts, span_);
    }
    ir::BufferId table_of_rows(const Rows& rows) {
        std::vector<ir::Value> values;
        for (const auto& row : rows.rows) values.insert(values.end(), row.begin(), row.end());
        return builder_.tables().constant(
            {.name = name_ + "-cases",
             .storage = ir::Storage::Constant,
             .scalar = ir::Scalar::Int,
             .shape = {std::ssize(rows.rows), std::ssize(rows.rows.front())},
             .values = std::move(values),
             .span = span_});
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::string name_;  // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program look_up_cases(ir::Program program, Report& report) {
    return LookingUp(std::move(program), report).run();
}

}  // namespace rddlc::passes
