#include "passes/analyses/piecewise_constant.hpp"

#include "passes/analyses/constant_values.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace rddlc::passes {
namespace {

constexpr std::size_t most_breaks = 10'000;

// The nearest number that a simulator computes with.
ir::Value rounded(const ir::Value& value, RealType real) {
    const auto* number = std::get_if<double>(&value);
    return number && real == RealType::Float ? double{static_cast<float>(*number)} : value;
}

// The next one, if there is one.
std::optional<ir::Value> next(const ir::Value& value, RealType real) {
    return match(
        value, [](bool) { return std::optional<ir::Value>(); },
        [](std::int64_t v) -> std::optional<ir::Value> {
            if (v == std::numeric_limits<std::int64_t>::max()) return std::nullopt;
            return v + 1;
        },
        [real](double v) -> std::optional<ir::Value> {
            if (v == HUGE_VAL) return std::nullopt;
            if (real == RealType::Float) return std::nextafter(static_cast<float>(v), HUGE_VALF);
            return std::nextafter(v, HUGE_VAL);
        });
}

// Below it there is another number.
bool is_possible_break(const ir::Value& value) {
    return match(
        value, [](bool) { return false; },
        [](std::int64_t v) { return v > std::numeric_limits<std::int64_t>::min(); },
        [](double v) { return v > -HUGE_VAL; });
}

class Collector {
  public:
    // It collects no breaks if there is no evaluator.
    Collector(const ir::Builder& builder, const ir::Evaluator* evaluator)
        : builder_(builder), evaluator_(evaluator) {}

    bool has_number() const { return number_.has_value(); }

    // False if there is something else that is not constant.
    bool visit(ir::NodeId id) {
        if (builder_.properties(id).uniform) return !builder_.properties(id).may_fault;
        if (!visited_.insert(id).second) return true;
        const ir::Node& node = program()[id];
        if (const auto* apply = std::get_if<ir::Apply>(&node.form)) {
            if (is_comparison(apply->op) && program()[apply->operands[0]].type != ir::Scalar::Bool)
                return compare(apply->op, apply->operands[0], apply->operands[1]);
        }
        const bool is_operation = std::holds_alternative<ir::Apply>(node.form) ||
                                  std::holds_alternative<ir::Convert>(node.form) ||
                                  std::holds_alternative<ir::Select>(node.form) ||
                                  std::holds_alternative<ir::Reduce>(node.form);
        if (!is_operation || ir::place_of(node)) return false;
        return std::ranges::all_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return visit(operand); });
    }

    std::optional<PiecewiseConstant> result() const {
        if (!number_ || breaks_.empty() || breaks_.size() > most_breaks) return std::nullopt;
        PiecewiseConstant pieces{*number_, {}, {}};
        for (const auto& [value, entry] : breaks_) {
            pieces.breaks.push_back(value);
            pieces.entries.push_back(entry);
        }
        if (!std::ranges::is_sorted(pieces.entries)) return std::nullopt;
        return pieces;
    }

  private:
    bool compare(Operator op, ir::NodeId a, ir::NodeId b) {
        if (builder_.properties(a).uniform) return compare(mirrored(op), b, a);
        const ir::Properties& properties = builder_.properties(a);
        if (!properties.free_variables.empty() || properties.may_fault) return false;
        if (number_ && *number_ != a) return false;
        number_ = a;
        return builder_.properties(b).uniform && add_breaks(op, b);
    }

    bool add_breaks(Operator op, ir::NodeId bound) {
        if (!evaluator_) return true;
        const auto values = constant_values(*evaluator_, program(), bound,
                                            builder_.properties(bound).free_variables);
        if (!values || values->size() > most_breaks) return false;
        const bool before = op != Operator::LessEqual && op != Operator::Greater;
        const bool behind = op != Operator::Less && op != Operator::GreaterEqual;
        return std::ranges::all_of(*values, [&](const ir::Value& value) {
            if (value != value) return true;  // nan: all comparisons have one result
            const ir::Value entry = rounded(value, program().real);
            return (!before || add(value, entry)) &&
                   (!behind || add(next(value, RealType::Double), next(entry, program().real)));
        });
    }

    bool add(const std::optional<ir::Value>& value, const std::optional<ir::Value>& entry) {
        if (!value) return true;
        if (!entry || !is_possible_break(*value) || !is_possible_break(*entry)) return false;
        return breaks_.emplace(*value, *entry).first->second == *entry;
    }

    const ir::Program& program() const { return builder_.program(); }

    const ir::Builder& builder_;
    const ir::Evaluator* evaluator_;
    std::optional<ir::NodeId> number_;
    std::map<ir::Value, ir::Value> breaks_;  // and the entries
    std::set<ir::NodeId> visited_;
};

ir::Value below(const ir::Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole - 1;
    return std::nextafter(std::get<double>(value), -HUGE_VAL);
}

}  // namespace

std::vector<ir::Value> PiecewiseConstant::representatives() const {
    std::vector<ir::Value> values = {below(breaks.front())};
    values.insert(values.end(), breaks.begin(), breaks.end());
    return values;
}

bool compares_one_number(const ir::Builder& builder, ir::NodeId id) {
    Collector collector(builder, nullptr);
    return collector.visit(id) && collector.has_number();
}

std::optional<PiecewiseConstant> piecewise_constant_of(const ir::Builder& builder,
                                                       const ir::Evaluator& evaluator,
                                                       ir::NodeId id) {
    Collector collector(builder, &evaluator);
    if (!collector.visit(id)) return std::nullopt;
    return collector.result();
}

}  // namespace rddlc::passes
