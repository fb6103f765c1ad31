#include "passes/aggregations/tabulate_thresholds.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/count_steps.hpp"
#include "passes/analyses/parameter_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

constexpr std::size_t most_weights = 64;
template <class Real>
constexpr double greatest_uniform = 1.0 - std::numeric_limits<Real>::epsilon();  // of draws
constexpr double sum_tolerance = 1.001e-5;  // that of rddl::sample::discrete_over

// The rows of thresholds by the objects of loops and the values of keys, row-major.
struct Rows {
    std::vector<std::vector<double>> thresholds;

    std::size_t length() const { return thresholds.front().size(); }

    // Adds thresholds that no number reaches.
    void lengthen(std::size_t length) {
        for (std::vector<double>& row : thresholds) row.resize(length, 1.0);
    }
    // Leaves out thresholds at the end that no number reaches.
    void trim(RealType real) {
        const double greatest =
            real == RealType::Float ? greatest_uniform<float> : greatest_uniform<double>;
        const auto is_never_reached = [greatest](const std::vector<double>& row) {
            return row.back() > greatest;
        };
        while (length() > 0 && std::ranges::all_of(thresholds, is_never_reached))
            for (std::vector<double>& row : thresholds) row.pop_back();
    }
};

// The sums of weights so far, as a step adds them; nothing if a draw from them faults.
template <class Real>
std::optional<std::vector<double>> thresholds_of(const std::vector<double>& weights) {
    std::vector<double> sums;
    Real total = 0;
    for (const double weight : weights) {
        if (!(weight >= 0)) return std::nullopt;
        sums.push_back(total += static_cast<Real>(weight));
    }
    if (!(std::abs(total - 1) <= static_cast<Real>(sum_tolerance))) return std::nullopt;
    return sums;
}

class ThresholdTabulation {
  public:
    ThresholdTabulation(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          parameters_(program_, builder_) {}

    ir::Program run() && {
        for (ir::Definition* definition : ir::definitions_of(program_)) {
            name_ = program_[definition->target].name;
            span_ = definition->span;
            change(definition->body);
        }
        name_ = "reward";
        span_ = program_.reward.span;
        change(program_.reward.body);
        program_.reward.value = rewritten(program_.reward.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    void change(ir::Block& block) {
        ir::change_roots(block, [&](ir::NodeId& root) { root = rewritten(root); });
    }

    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, done_, [&](ir::NodeId part) -> Replacement {
            const auto form = program_[part].form;
            if (const auto* discrete = std::get_if<ir::Discrete>(&form))
                return discrete->normalise ? std::nullopt
                                           : interval_of(discrete->place, discrete->weights);
            if (const auto* discrete = std::get_if<ir::DiscreteOver>(&form))
                return discrete->normalise ? std::nullopt
                                           : interval_of(discrete->place, weights_of(*discrete));
            if (const auto* sample = std::get_if<ir::Sample>(&form)) return interval_of(*sample);
            if (const auto* select = std::get_if<ir::Select>(&form)) return merged(*select);
            return std::nullopt;
        });
    }

    // ------------------------------------------------------------------------ thresholds

    using Replacement = std::optional<ir::NodeId>;

    // Draws among them may become ints of small ranges.
    std::vector<ir::NodeId> all_rewritten(std::vector<ir::NodeId> ids) {
        for (ir::NodeId& id : ids) id = rewritten(id);
        return ids;
    }

    // One for each object; none if these are too many.
    std::vector<ir::NodeId> weights_of(const ir::DiscreteOver& discrete) {
        const std::int64_t size = program_[discrete.variable].size;
        std::vector<ir::NodeId> weights;
        if (size > static_cast<std::int64_t>(most_weights)) return weights;
        for (std::int64_t object = 0; object < size; ++object) {
            std::map<ir::NodeId, ir::NodeId> known = {
                {builder_.index(discrete.variable), builder_.constant(object)}};
            weights.push_back(ir::replace_in(builder_, discrete.weight, known));
        }
        return weights;
    }

    Replacement interval_of(ir::Place place, const std::vector<ir::NodeId>& given) {
        if (given.empty() || given.size() > most_weights) return std::nullopt;
        const std::vector<ir::NodeId> weights = all_rewritten(given);
        return parameters_.tabulated(
            weights, weights.size(), [&](const ParameterRows& of_weights) -> Replacement {
                Rows rows;
                for (const std::vector<double>& row : of_weights.values) {
                    auto thresholds = program_.real == RealType::Float ? thresholds_of<float>(row)
                                                                       : thresholds_of<double>(row);
                    if (!thresholds) return std::nullopt;
                    rows.thresholds.push_back(std::move(*thresholds));
                }
                rows.trim(program_.real);
                // Index 0 gets what is missing to 1.
                const bool may_reach_all = rows.length() == weights.size();
                return search(place, rows, of_weights, may_reach_all ? 0 : end_of(rows));
            });
    }

    // Counts that are found by inversion. Those of programs of 32 bits draw numbers of 64.
    Replacement interval_of(const ir::Sample& sample) {
        if (program_.real == RealType::Float || !has_count_steps(sample.distribution))
            return std::nullopt;
        const std::vector<ir::NodeId> parameters = all_rewritten(sample.parameters);
        return parameters_.tabulated(
            parameters, most_count_steps, [&](const ParameterRows& rows) -> Replacement {
                const auto counts = counts_by_inversion(sample.distribution, rows.values);
                if (!counts) return std::nullopt;
                // The last step of a walk that rounding keeps from ending may lead to a greater
                // count.
                const ir::NodeId count =
                    search(sample.place, Rows{counts->thresholds}, rows, counts->last);
                if (!counts->are_failures) return count;
                return builder_.apply(Operator::Subtract, {parameters.front(), count});
            });
    }

    static std::int64_t end_of(const Rows& rows) {
        return static_cast<std::int64_t>(rows.length());
    }
    // The number of thresholds that are reached, with `last` in place of all.
    ir::NodeId search(ir::Place place, const Rows& rows, const ParameterRows& keys,
                      std::int64_t last) {
        ++report_["draws made searches among thresholds"];
        if (rows.length() == 0) return builder_.constant(std::int64_t{0});
        std::vector<std::int64_t> shape;
        std::vector<ir::NodeId> row;
        for (const ir::VariableId variable : keys.variables) {
            shape.push_back(program_[variable].size);
            row.push_back(builder_.index(variable));
        }
        for (const ParameterKey& key : keys.ints) {
            shape.push_back(key.count);
            const ir::NodeId value = builder_.convert(rewritten(key.id), ir::Scalar::Int);
            row.push_back(
                builder_.apply(Operator::Subtract, {value, builder_.constant(key.least)}));
        }
        place.index = rewritten(place.index);
        const ir::NodeId interval =
            builder_.interval(place, new_table(rows, std::move(shape)), std::move(row));
        if (last == end_of(rows)) return interval;
        const ir::NodeId end = builder_.constant(end_of(rows));
        return builder_.select(builder_.apply(Operator::Less, {interval, end}), interval,
                               builder_.constant(last));
    }

    ir::BufferId new_table(const Rows& rows, std::vector<std::int64_t> shape) {
        shape.push_back(static_cast<std::int64_t>(rows.length()));
        std::vector<ir::Value> values;
        for (const auto& row : rows.thresholds) values.insert(values.end(), row.begin(), row.end());
        ir::Buffer table{.name = name_ + "-thresholds",
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Real,
                         .shape = std::move(shape),
                         .span = span_};
        table.values = std::move(values);
        return builder_.tables().constant(std::move(table));
    }

    // -------------------------------------------------------------------------- branches

    // A draw as one of several rows.
    struct RowDraw {
        ir::Place place;
        Rows rows;
        ir::NodeId row;
    };

    Replacement merged(const ir::Select& select) {
        auto a = row_draw(rewritten(select.then_value));
        auto b = row_draw(rewritten(select.else_value));
        if (!a || !b || !have_same_numbers(a->place, b->place)) return std::nullopt;
        const std::size_t length = std::max(a->rows.length(), b->rows.length());
        a->rows.lengthen(length);
        b->rows.lengthen(length);
        ++report_["pairs of draws made one"];
        const auto first_of_b = static_cast<std::int64_t>(a->rows.thresholds.size());
        const ir::NodeId row =
            builder_.select(rewritten(select.condition), a->row, added(first_of_b, b->row));
        Rows both = a->rows;
        both.thresholds.insert(both.thresholds.end(), b->rows.thresholds.begin(),
                               b->rows.thresholds.end());
        const auto count = static_cast<std::int64_t>(both.thresholds.size());
        return builder_.interval(a->place, new_table(both, {count}), {row});
    }

    ir::NodeId added(std::int64_t number, ir::NodeId row) {
        const auto form = program_[row].form;
        if (const auto* select = std::get_if<ir::Select>(&form))
            return builder_.select(select->condition, added(number, select->then_value),
                                   added(number, select->else_value));
        return builder_.apply(Operator::Add, {row, builder_.constant(number)});
    }

    bool have_same_numbers(const ir::Place& a, const ir::Place& b) const {
        return program_.series_of(a.site) == program_.series_of(b.site) && a.index == b.index;
    }

    // A draw from a row that no loop chooses.
    std::optional<RowDraw> row_draw(ir::NodeId id) {
        const auto* found = std::get_if<ir::Interval>(&program_[id].form);
        if (!found || found->row.size() > 1) return std::nullopt;
        const ir::Interval interval = *found;  // building nodes moves the pool
        const ir::NodeId row =
            interval.row.empty() ? builder_.constant(std::int64_t{0}) : interval.row.front();
        const ir::Properties& properties = builder_.properties(row);
        if (properties.uniform && !properties.free_variables.empty()) return std::nullopt;
        const ir::Buffer& table = program_[interval.table];
        const std::int64_t length = table.shape.back();
        Rows rows;
        for (std::int64_t first = 0; first < table.count(); first += length) {
            rows.thresholds.emplace_back();
            for (std::int64_t i = first; i < first + length; ++i)
                rows.thresholds.back().push_back(std::get<double>(table.values[i]));
        }
        return RowDraw{interval.place, std::move(rows), row};
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ParameterTabulation parameters_;
    std::string name_;  // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program tabulate_thresholds(ir::Program program, Report& report) {
    return ThresholdTabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
