#include "passes/lanes/weigh_in_rows.hpp"

#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "ir/shares.hpp"
#include "passes/analyses/bool_words.hpp"
#include "passes/analyses/constant_values.hpp"
#include "passes/analyses/object_lanes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// As many draws have a lane each.
constexpr std::int64_t draws_of_register = 8;
constexpr std::size_t most_counted_bools = 3;  // since each one more is one more select

using Values = std::vector<ir::Value>;

class WeightRows {
  public:
    WeightRows(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          evaluator_(std::as_const(program_)) {}

    ir::Program run() && {
        if (program_.real != RealType::Double) return std::move(program_);
        for (ir::Definition& definition : program_.step) {
            name_ = program_[definition.target].name;
            span_ = definition.span;
            ir::Block result;
            for (ir::Statement& statement : definition.body) {
                auto rows = in_rows(statement, result.empty() ? nullptr : &result.back());
                if (!rows) {
                    result.push_back(std::move(statement));
                    continue;
                }
                ++report_["draws from rows of weights"];
                if (rows->replaces_filling) result.pop_back();
                std::ranges::move(rows->statements, std::back_inserter(result));
            }
            definition.body = std::move(result);
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    struct Rows {
        ir::Block statements;
        bool replaces_filling;  // the statement before has filled a table that is not read any more
    };

    // In place of a statement that draws, and of the one before it.
    std::optional<Rows> in_rows(const ir::Statement& drawing, const ir::Statement* before) {
        const auto [store, draws] = draw_of(drawing);
        if (!store) return std::nullopt;
        const ir::Node draw = program_[store->value];
        const auto* const over = std::get_if<ir::DiscreteOver>(&draw.form);
        if (!over || over->normalise || program_[over->variable].size != ir::weights_of_row ||
            ir::combinations(program_, draws) >= draws_of_register)
            return std::nullopt;
        choice_ = over->variable;
        outer_ = draws;
        const auto table = ir::shares_of_elements(program_, draw);
        if (table && table->is_row()) return std::nullopt;
        const auto weight = table ? filled_by(before, *table, draw) : share_of_own_sum(*over);
        if (!weight) return std::nullopt;
        known_.clear();
        const ir::NodeId in_registers =
            ir::replace_in(builder_, *weight, known_, [&](ir::NodeId id) { return in_lanes(id); });
        auto statements = with_rows(*store, *over, in_registers);
        if (!statements) return std::nullopt;
        return Rows{std::move(*statements), table.has_value()};
    }

    // The only statement, inside of loops over these variables.
    std::pair<const ir::Store*, std::vector<ir::VariableId>> draw_of(
        const ir::Statement& statement) const {
        if (const auto* store = std::get_if<ir::Store>(&statement.form)) return {store, {}};
        const auto* const loop = std::get_if<ir::Loop>(&statement.form);
        if (!loop) return {nullptr, {}};
        const ir::Nest nest = ir::nest_of(*loop);
        return {ir::only_statement<ir::Store>(*nest.body), nest.variables};
    }

    // The value that a loop stores in the table of weights, if nothing else reads it.
    std::optional<ir::NodeId> filled_by(const ir::Statement* filling,
                                        const ir::SharesOfElements& shares, const ir::Node& draw) {
        const auto* const loop = filling ? std::get_if<ir::Loop>(&filling->form) : nullptr;
        const auto* const fill =
            loop ? ir::only_statement<ir::Store>(*ir::nest_of(*loop).body) : nullptr;
        if (!fill || fill->target != shares.weight.buffer ||
            fill->indices != shares.weight.indices || !are_indices(fill->indices) ||
            is_read_elsewhere(shares, draw))
            return std::nullopt;
        term_ = std::get<ir::Reduce>(program_[shares.total].form).variable;
        range_ = program_[fill->target].range;
        return fill->value;
    }

    // The weight that is divided by the sum of all.
    std::optional<ir::NodeId> share_of_own_sum(const ir::DiscreteOver& over) {
        const auto* const share = std::get_if<ir::Apply>(&program_[over.weight].form);
        if (!share || share->op != Operator::Divide) return std::nullopt;
        const ir::NodeId weight = share->operands.front(), total = share->operands.back();
        const auto* const found = std::get_if<ir::Reduce>(&program_[total].form);
        if (!found || found->op != Reduction::Sum || found->bounds || depends_on(total, choice_) ||
            program_[found->variable].size != program_[choice_].size)
            return std::nullopt;
        const ir::Reduce sum = *found;  // building nodes moves the pool
        const ir::Properties properties = builder_.properties(weight);
        if (!properties.range || properties.range->lower < 0 || !ir::is_droppable(properties))
            return std::nullopt;
        std::map<ir::NodeId, ir::NodeId> renamed{
            {builder_.index(sum.variable), builder_.index(choice_)}};
        term_ = sum.variable;
        range_ = properties.range;
        return ir::replace_in(builder_, sum.body, renamed) == weight ? std::optional(weight)
                                                                     : std::nullopt;
    }

    bool is_read_elsewhere(const ir::SharesOfElements& shares, const ir::Node& draw) const {
        const ir::NodeId term = std::get<ir::Reduce>(program_[shares.total].form).body;
        const ir::NodeId share = std::get<ir::DiscreteOver>(draw.form).weight;
        const ir::NodeId weight = std::get<ir::Apply>(program_[share].form).operands.front();
        for (std::uint32_t k = 0; k < program_.nodes.size(); ++k) {
            const ir::NodeId id{k};
            if (id != term && id != weight &&
                ir::buffer_read_by(program_[id]) == shares.weight.buffer)
                return true;
        }
        return false;
    }

    // The choice and the variables of all draws, in any order.
    bool are_indices(const std::vector<ir::NodeId>& indices) const {
        return indices.size() == outer_.size() + 1 &&
               std::ranges::all_of(outer_, [&](ir::VariableId variable) {
                   return std::ranges::any_of(indices, [&](ir::NodeId id) {
                       return ir::is_index_of(program_, id, variable);
                   });
               });
    }

    std::optional<ir::Block> with_rows(const ir::Store& store, const ir::DiscreteOver& discrete,
                                       ir::NodeId weight) {
        std::vector<ir::VariableId> variables = outer_;
        variables.push_back(choice_);
        std::vector<ir::NodeId> indices;
        for (const ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
        ir::Store row{{}, indices, weight};
        if (!fits_lanes(row)) return std::nullopt;
        const ir::BufferId rows = builder_.tables().scratch(name_ + "-weights", ir::Scalar::Real,
                                                            range_, variables, span_);
        row.target = rows;

        const ir::NodeId element = builder_.load(rows, indices);
        indices.back() = builder_.index(term_);
        const ir::NodeId total =
            builder_.reduce(Reduction::Sum, term_, builder_.load(rows, indices));
        const ir::NodeId share = builder_.apply(Operator::Divide, {element, total});
        const ir::NodeId value = builder_.discrete_over(false, discrete.place, choice_, share);
        ir::Block filling = ir::looped({{row}}, {choice_});
        std::get<ir::Loop>(filling.front().form).several_at_once = true;
        ir::Block result = ir::looped(std::move(filling), outer_);
        ir::Block drawing = ir::looped({{ir::Store{store.target, store.indices, value}}}, outer_);
        std::ranges::move(drawing, std::back_inserter(result));
        return result;
    }

    bool fits_lanes(const ir::Store& row) const {
        const ObjectLanes several(builder_, ir::Nest{{choice_}, nullptr});
        return several.can_store_in_row(row);
    }

    // ---------------------------------------------------------------------------- weights

    // Registers have masks for bools by their places, and for selects in place of counts.
    std::optional<ir::NodeId> in_lanes(ir::NodeId id) {
        const auto* const found = std::get_if<ir::Load>(&program_[id].form);
        if (!found) return std::nullopt;
        const ir::Load load = *found;
        if (program_[load.buffer].storage == ir::Storage::Constant) return by_selects(load);
        return is_by_place(load) ? std::optional(by_place(load)) : std::nullopt;
    }

    // A bool of the row of a table of more dimensions that each object has.
    bool is_by_place(const ir::Load& load) const {
        const ir::Buffer& buffer = program_[load.buffer];
        if (buffer.scalar != ir::Scalar::Bool || buffer.count() > most_looked_up_bools ||
            load.indices.size() < 2)
            return false;
        const bool has_choice =
            std::ranges::any_of(load.indices, [&](ir::NodeId index) { return is_choice(index); });
        return has_choice && !is_choice(load.indices.back()) &&
               std::ranges::all_of(load.indices, [&](ir::NodeId index) {
                   return is_choice(index) ||
                          std::holds_alternative<ir::Constant>(program_[index].form);
               });
    }
    bool is_choice(ir::NodeId id) const { return ir::is_index_of(program_, id, choice_); }
    ir::NodeId by_place(const ir::Load& load) {
        Values places;
        for (std::int64_t k = 0; k < program_[choice_].size; ++k) {
            std::int64_t place = 0;
            for (std::size_t axis = 0; axis < load.indices.size(); ++axis) {
                const ir::NodeId index = load.indices[axis];
                place =
                    place * program_[load.buffer].shape[axis] +
                    (is_choice(index) ? k : ir::constant<std::int64_t>(program_, index).value());
            }
            places.emplace_back(place);
        }
        ir::Buffer table{.name = name_ + "-places",
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Int,
                         .values = std::move(places),
                         .span = span_,
                         .holds_places = true};
        ir::set_dimensions(program_, table, {choice_});
        return builder_.element(
            load.buffer,
            builder_.load(builder_.tables().constant(std::move(table)), {builder_.index(choice_)}));
    }

    // GAIN[p, c, int(x) + int(y)] is select(x && y, GAIN-2[p, c],
    //                                       select(x || y, GAIN-1[p, c], GAIN-0[p, c])).
    std::optional<ir::NodeId> by_selects(const ir::Load& load) {
        for (std::size_t axis = 0; axis < load.indices.size(); ++axis) {
            std::vector<ir::NodeId> bools;
            if (!counts(load.indices[axis], bools)) continue;
            const std::vector<ir::NodeId> reached = at_least(bools);
            std::optional<ir::NodeId> result;
            for (std::size_t count = 0; count <= reached.size(); ++count) {
                const auto element = slice(load, axis, count);
                if (!element) return std::nullopt;
                result = result ? builder_.select(reached[count - 1], *element, *result) : *element;
            }
            return result;
        }
        return std::nullopt;
    }

    // Whether it is the number of true ones among few bools.
    bool counts(ir::NodeId id, std::vector<ir::NodeId>& bools) {
        const ir::Node node = program_[id];
        if (const auto* convert = std::get_if<ir::Convert>(&node.form)) {
            if (program_[convert->operand].type != ir::Scalar::Bool) return false;
            bools.push_back(convert->operand);
            return bools.size() <= most_counted_bools;
        }
        if (const auto* apply = std::get_if<ir::Apply>(&node.form))
            return apply->op == Operator::Add && counts(apply->operands[0], bools) &&
                   counts(apply->operands[1], bools);
        const auto* const sum = std::get_if<ir::Reduce>(&node.form);
        if (!sum || sum->op != Reduction::Sum || sum->bounds ||
            program_[sum->variable].size > static_cast<std::int64_t>(most_counted_bools))
            return false;
        for (std::int64_t k = 0; k < program_[sum->variable].size; ++k) {
            std::map<ir::NodeId, ir::NodeId> entered{
                {builder_.index(sum->variable), builder_.constant(k)}};
            if (!counts(ir::replace_in(builder_, sum->body, entered), bools)) return false;
        }
        return true;
    }

    // Whether at least 1, 2, ... of the bools are true.
    std::vector<ir::NodeId> at_least(const std::vector<ir::NodeId>& bools) {
        std::vector<ir::NodeId> reached;
        for (const ir::NodeId each : bools) {
            const ir::NodeId next =
                ir::replace_in(builder_, each, known_, [&](ir::NodeId id) { return in_lanes(id); });
            std::vector<ir::NodeId> more;
            for (std::size_t k = 0; k <= reached.size(); ++k) {
                const ir::NodeId rises =
                    k == 0 ? next : builder_.apply(Operator::And, {reached[k - 1], next});
                more.push_back(k == reached.size()
                                   ? rises
                                   : builder_.apply(Operator::Or, {reached[k], rises}));
            }
            reached = std::move(more);
        }
        return reached;
    }

    // The elements of the table for this count, of all draws and objects.
    std::optional<ir::NodeId> slice(const ir::Load& load, std::size_t axis, std::size_t count) {
        std::vector<ir::NodeId> indices = load.indices;
        indices[axis] = builder_.constant(static_cast<std::int64_t>(count));
        const ir::NodeId element = builder_.load(load.buffer, std::move(indices));
        std::vector<ir::VariableId> variables;
        for (const ir::VariableId variable : outer_)
            if (depends_on(element, variable)) variables.push_back(variable);
        variables.push_back(choice_);
        evaluator_.know_added_tables();
        auto values = constant_values(evaluator_, program_, element, variables);
        if (!values) return std::nullopt;
        const bool are_equal = std::ranges::all_of(
            *values, [&](const ir::Value& value) { return identical(value, values->front()); });
        if (are_equal) return builder_.constant(values->front());
        ir::Buffer table{.name = program_[load.buffer].name + "-" + std::to_string(count),
                         .storage = ir::Storage::Constant,
                         .scalar = ir::Scalar::Real,
                         .values = std::move(*values),
                         .span = span_};
        ir::set_dimensions(program_, table, variables);
        std::vector<ir::NodeId> own;
        for (const ir::VariableId variable : variables) own.push_back(builder_.index(variable));
        return builder_.load(builder_.tables().constant(std::move(table)), std::move(own));
    }
    bool depends_on(ir::NodeId id, ir::VariableId variable) const {
        return ir::depends_on(builder_.properties(id), variable);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    ir::Evaluator evaluator_;

    // Members of the draw at hand.
    std::string name_;  // of what is drawn
    Span span_;
    ir::VariableId choice_{}, term_{};   // of the objects, and in the sum over them
    std::vector<ir::VariableId> outer_;  // of the draws
    std::optional<Range> range_;         // of the weights
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program weigh_in_rows(ir::Program program, Report& report) {
    return WeightRows(std::move(program), report).run();
}

}  // namespace rddlc::passes
