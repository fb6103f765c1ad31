#include "passes/aggregations/tabulate_thresholds.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/constant_values.hpp"
#include "support/match.hpp"

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

constexpr double most_combinations = 256;    // of the ints
constexpr double most_elements = 1 << 14;    // of a table
constexpr double most_of_program = 1 << 18;  // elements of all tables
constexpr std::size_t most_weights = 64;
template <class Real>
constexpr double greatest_uniform = 1.0 - std::numeric_limits<Real>::epsilon();  // of draws
constexpr double sum_tolerance = 1.001e-5;  // that of rddl::sample::discrete_over

// An int of a small range, or a bool, that weights depend on.
struct Key {
    ir::NodeId id;
    std::int64_t least;
    std::int64_t count;
};

// All that weights depend on.
struct Keys {
    // The parts of an int or a bool that is made of others: itself, or those.
    enum class Kind { Outermost, Innermost } kind;
    std::vector<Key> ints;
    std::set<ir::VariableId> variables;  // of the loops around
};

// The rows of thresholds by the objects of loops and the values of keys, row-major.
struct Rows {
    std::vector<std::vector<double>> thresholds;

    std::size_t length() const { return thresholds.front().size(); }

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
        : program_(std::move(program)), report_(report), builder_(program_), evaluator_(program_) {}

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
            if (const auto* select = std::get_if<ir::Select>(&form)) return merged(*select);
            return std::nullopt;
        });
    }

    // ------------------------------------------------------------------------ thresholds

    using Replacement = std::optional<ir::NodeId>;

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

    // Bools tell ints apart that they depend on. As keys they are fewer than these, but not all of
    // their combinations need exist.
    Replacement interval_of(ir::Place place, const std::vector<ir::NodeId>& weights) {
        if (weights.empty() || weights.size() > most_weights) return std::nullopt;
        for (const Keys::Kind kind : {Keys::Kind::Outermost, Keys::Kind::Innermost}) {
            auto keys = keys_of(weights, kind);
            if (!keys) continue;
            if (auto rows = rows_of(weights, *keys))
                return interval_among(place, std::move(*rows), *keys, weights.size());
        }
        return std::nullopt;
    }

    // Nothing if the weights depend on more, or if these have too many combinations.
    std::optional<Keys> keys_of(const std::vector<ir::NodeId>& weights, Keys::Kind kind) {
        Keys keys{.kind = kind, .ints = {}, .variables = {}};
        for (const ir::NodeId weight : weights)
            if (!find_keys(weight, keys)) return std::nullopt;
        double rows = 1;
        for (const Key& key : keys.ints) rows *= static_cast<double>(key.count);
        if (rows > most_combinations) return std::nullopt;
        for (const ir::VariableId variable : keys.variables)
            rows *= static_cast<double>(program_[variable].size);
        const double elements = rows * static_cast<double>(weights.size());
        if (elements > std::min(most_elements, left_)) return std::nullopt;
        left_ -= elements;
        return keys;
    }

    // Adds the keys that the expression depends on; false if it depends on more.
    bool find_keys(ir::NodeId id, Keys& keys) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.uniform) {
            keys.variables.insert(properties.free_variables.begin(),
                                  properties.free_variables.end());
            return true;
        }
        const auto key = key_of(id);
        if (key && keys.kind == Keys::Kind::Outermost) return add(*key, keys);
        const Keys before = keys;
        if (find_keys_below(id, keys)) return true;
        keys = before;
        return key && add(*key, keys);
    }
    bool find_keys_below(ir::NodeId id, Keys& keys) const {
        const ir::Node& node = program_[id];
        const auto* apply = std::get_if<ir::Apply>(&node.form);
        const auto* load = std::get_if<ir::Load>(&node.form);
        const bool is_decided_by_operands = (apply && !apply->place) ||
                                            std::holds_alternative<ir::Select>(node.form) ||
                                            std::holds_alternative<ir::Convert>(node.form) ||
                                            (load && is_within_constant_table(*load));
        return is_decided_by_operands &&
               std::ranges::all_of(ir::operands_of(node),
                                   [&](ir::NodeId operand) { return find_keys(operand, keys); });
    }
    // For all values of the keys, of which not all combinations need exist.
    bool is_within_constant_table(const ir::Load& load) const {
        const ir::Buffer& table = program_[load.buffer];
        if (table.storage != ir::Storage::Constant) return false;
        for (std::size_t axis = 0; axis < load.indices.size(); ++axis) {
            const auto& range = builder_.properties(load.indices[axis]).range;
            if (!range || range->lower < 0 ||
                range->upper >= static_cast<double>(table.shape[axis]))
                return false;
        }
        return true;
    }
    static bool add(const Key& key, Keys& keys) {
        const bool is_new = std::ranges::find(keys.ints, key.id, &Key::id) == keys.ints.end();
        if (is_new) keys.ints.push_back(key);
        return true;
    }

    std::optional<Key> key_of(ir::NodeId id) const {
        const ir::Properties& properties = builder_.properties(id);
        if (properties.may_fault) return std::nullopt;
        const ir::Scalar type = program_[id].type;
        if (type == ir::Scalar::Bool) return Key{id, 0, 2};
        const auto& range = properties.range;
        if (type != ir::Scalar::Int || !range || range->upper - range->lower >= most_combinations)
            return std::nullopt;
        const auto least = static_cast<std::int64_t>(range->lower);
        return Key{id, least, static_cast<std::int64_t>(range->upper) - least + 1};
    }

    ir::NodeId value_of(const Key& key, std::int64_t value) {
        if (program_[key.id].type == ir::Scalar::Bool) return builder_.constant(value != 0);
        return builder_.constant(key.least + value);
    }

    // Nothing if weights are wrong for some row. Variables whose objects all have the same rows are
    // left out of the keys.
    std::optional<Rows> rows_of(const std::vector<ir::NodeId>& weights, Keys& keys) {
        std::int64_t combinations = 1;
        for (const Key& key : keys.ints) combinations *= key.count;
        std::vector<OfWeights> values;  // by combination
        for (std::int64_t combination = 0; combination < combinations; ++combination) {
            auto of_weights = values_of(weights, keys, combination);
            if (!of_weights) return std::nullopt;
            values.push_back(std::move(*of_weights));
        }
        std::size_t objects = values.front().front().size();
        if (std::ranges::all_of(values, are_same_for_all_objects)) {
            keys.variables.clear();
            objects = 1;
        }
        Rows rows;
        for (std::size_t object = 0; object < objects; ++object) {
            for (const OfWeights& of_weights : values) {
                std::vector<double> row;
                for (const auto& of_objects : of_weights)
                    row.push_back(std::get<double>(of_objects[object]));
                auto thresholds = program_.real == RealType::Float ? thresholds_of<float>(row)
                                                                   : thresholds_of<double>(row);
                if (!thresholds) return std::nullopt;
                rows.thresholds.push_back(std::move(*thresholds));
            }
        }
        return rows;
    }

    // By weight, then by object.
    using OfWeights = std::vector<std::vector<ir::Value>>;

    static bool are_same_for_all_objects(const OfWeights& of_weights) {
        return std::ranges::all_of(of_weights, [](const std::vector<ir::Value>& of_objects) {
            return std::ranges::adjacent_find(of_objects, std::not_equal_to{}) == of_objects.end();
        });
    }

    std::optional<OfWeights> values_of(const std::vector<ir::NodeId>& weights, const Keys& keys,
                                       std::int64_t combination) {
        std::map<ir::NodeId, ir::NodeId> known;
        for (auto key = keys.ints.rbegin(); key != keys.ints.rend(); ++key) {
            known.emplace(key->id, value_of(*key, combination % key->count));
            combination /= key->count;
        }
        const std::vector<ir::VariableId> variables(keys.variables.begin(), keys.variables.end());
        OfWeights values;
        for (const ir::NodeId weight : weights) {
            const ir::NodeId of_case = ir::replace_in(builder_, weight, known);
            if (!builder_.properties(of_case).uniform) return std::nullopt;
            auto of_objects = constant_values(evaluator_, program_, of_case, variables);
            if (!of_objects) return std::nullopt;
            values.push_back(std::move(*of_objects));
        }
        return values;
    }

    ir::NodeId interval_among(ir::Place place, Rows rows, const Keys& keys, std::size_t weights) {
        ++report_["draws made searches among thresholds"];
        rows.trim(program_.real);
        const ir::NodeId zero = builder_.constant(std::int64_t{0});
        if (rows.length() == 0) return zero;
        std::vector<std::int64_t> shape;
        std::vector<ir::NodeId> row;
        for (const ir::VariableId variable : keys.variables) {
            shape.push_back(program_[variable].size);
            row.push_back(builder_.index(variable));
        }
        for (const Key& key : keys.ints) {
            shape.push_back(key.count);
            const ir::NodeId value = builder_.convert(rewritten(key.id), ir::Scalar::Int);
            row.push_back(
                builder_.apply(Operator::Subtract, {value, builder_.constant(key.least)}));
        }
        place.index = rewritten(place.index);
        const ir::BufferId table = new_table(rows, std::move(shape));
        const ir::NodeId interval = builder_.interval(place, table, std::move(row));
        if (rows.length() < weights) return interval;
        // Index 0 gets what is missing to 1.
        const auto length = builder_.constant(static_cast<std::int64_t>(rows.length()));
        return builder_.select(builder_.apply(Operator::Less, {interval, length}), interval, zero);
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
        const auto a = row_draw(rewritten(select.then_value));
        const auto b = row_draw(rewritten(select.else_value));
        if (!a || !b || !have_same_numbers(a->place, b->place) ||
            a->rows.length() != b->rows.length())
            return std::nullopt;
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
    ir::Evaluator evaluator_;
    double left_ = most_of_program;
    std::string name_;  // of what is computed
    Span span_;
    std::map<ir::NodeId, ir::NodeId> done_;
};

}  // namespace

ir::Program tabulate_thresholds(ir::Program program, Report& report) {
    return ThresholdTabulation(std::move(program), report).run();
}

}  // namespace rddlc::passes
