// Over 400 lines: a function for each form of the IR.
#include "emit/lower/expressions.hpp"

#include "emit/cpp/literals.hpp"
#include "emit/cpp/print.hpp"
#include "emit/lower/operators.hpp"
#include "emit/lower/tables.hpp"
#include "ir/action_bools.hpp"
#include "ir/call.hpp"
#include "ir/common_rows.hpp"
#include "ir/few_bits.hpp"
#include "ir/row_of_bools.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::cpp {
namespace {

using tree::braces;
using tree::element;
using tree::Expression;
using tree::list;
using tree::operation;
using tree::word;

bool is_int_constant(const ir::Node& node) {
    return node.type == ir::Scalar::Int && std::holds_alternative<ir::Constant>(node.form);
}

// The function that rounds a real without making an int of it.
std::string_view rounding_function(Operator op) {
    if (op == Operator::Round) return "round_as_real";
    return op == Operator::Floor ? "floor_as_real" : "ceil_as_real";
}

}  // namespace

void Uses::add(const Uses& others) {
    records.insert(others.records.begin(), others.records.end());
    stored.insert(others.stored.begin(), others.stored.end());
    types.insert(others.types.begin(), others.types.end());
    context |= others.context;
    numbers |= others.numbers;
    normals |= others.normals;
}

// -------------------------------------------------------------------------------- names

// Passes number indices of tables that are bound inside each other ("entry-2"). Scopes do it here.
std::string Expressions::enter(ir::VariableId id) {
    const ir::Variable& variable = unit_.program[id];
    const std::string name =
        variable.type ? variable.name : variable.name.substr(0, variable.name.find('-'));
    return variables_[id] = scope_.claim(name);
}

Expressions::ObjectNames Expressions::enter(ir::Nest nest) {
    std::string wish;
    for (const ir::VariableId variable : nest.variables)
        wish += (wish.empty() ? "" : "_") + unit_.program[variable].name;
    several_ = {std::move(nest), scope_.claim("several"), scope_.claim(wish)};
    return {several_->context, several_->objects};
}

Expression Expressions::context_parameter(bool is_used, const std::string& name) {
    return is_used ? Expression{tree::Declared{"auto&", name}} : word("auto&");
}

std::string Expressions::count_of(std::span<const ir::VariableId> variables) const {
    std::string count = unit_.size_of(unit_.program[variables.front()]);
    for (const ir::VariableId variable : variables.subspan(1))
        count += " * " + unit_.size_of(unit_.program[variable]);
    return count;
}

void Expressions::name(ir::NodeId id, const std::string& name) {
    const auto [known, is_new] = named_.try_emplace(id, name);
    namings_.push_back({id, is_new ? std::nullopt : std::optional(known->second)});
    known->second = name;
}

void Expressions::return_to(Mark mark) {
    scope_.release(mark.scope);
    forget(mark);
}

void Expressions::forget(Mark mark) {
    for (; namings_.size() > mark.naming; namings_.pop_back()) {
        Naming& last = namings_.back();
        if (last.before) {
            named_[last.id] = *std::move(last.before);
        } else {
            named_.erase(last.id);
        }
    }
}

std::string Expressions::type(ir::Scalar scalar) {
    if (several_) return table_type(scalar, unit_.program.real);
    uses_.types.insert(scalar);
    return lane_type(scalar);
}

// -------------------------------------------------------------------------- expressions

Expression Expressions::lower(ir::NodeId id) {
    if (nodes_left_ == 0) return word("");
    --nodes_left_;
    if (const auto named = named_.find(id); named != named_.end()) return word(named->second);
    const ir::Node& node = unit_.program[id];
    const auto* bits = std::get_if<ir::Bits>(&node.form);
    if (bits && unit_.narrow_bits[id.index]) return bits_of(*bits, "narrow_");
    return match(node.form, [&](const auto& form) { return lower(node, form); });
}

// Each node takes a character at least. What is measured need not be written in the end.
std::size_t Expressions::width_within(ir::NodeId id, std::size_t most) {
    nodes_left_ = most + 1;
    const Expression whole = measured([&] { return lower(id); });
    const bool is_whole = std::exchange(nodes_left_, all_nodes) > 0;
    return is_whole ? std::min(width(whole), most + 1) : most + 1;
}

Expression Expressions::result(ir::NodeId id) {
    const ir::Node& node = unit_.program[id];
    return is_int_constant(node) ? braces(type(node.type), {lower(id)}) : lower(id);
}

Expression Expressions::lower(const ir::Node&, const ir::Constant& constant) {
    const std::string text = literal(constant.value, unit_.program.real);
    return {tree::Word{text, text.front() == '-' ? tree::Level::Unary : tree::Level::Primary}};
}

Expression Expressions::lower(const ir::Node&, const ir::Index& index) {
    return word(variables_.at(index.variable));
}

Expression Expressions::lower(const ir::Node& node, const ir::Search& search) {
    const std::string table = unit_.names.buffers[search.table.index];
    return tree::call("rddl::search<" + table + ", " + type(node.type) + ">",
                      {lower(search.value)});
}

// "rddl::at_places<up_places>(state.up[c], x, j)": for several objects, whose places are in row j;
// else "rddl::element(state.up[c], i)".
Expression Expressions::lower(const ir::Node&, const ir::Element& element) {
    Expression table = elements(record(element.buffer), element.indices);
    if (!several_)
        return tested(element.buffer,
                      tree::call("rddl::element", {std::move(table), index(element.place)}));
    const auto& places = std::get<ir::Load>(unit_.program[element.place].form);
    const auto rows = places.indices.size() - several_->nest.variables.size();
    return tested(element.buffer,
                  of_objects("rddl::at_places<" + unit_.names.buffers[places.buffer.index] + ">",
                             std::move(table), std::span(places.indices).first(rows)));
}

Expression Expressions::lower(const ir::Node&, const ir::Bits& bits) {
    return bits_of(bits, unit_.has_byte_ints() ? "byte_" : "");
}
// "rddl::bits(state.on)", "rddl::narrow_action_bits(action.move[x])"
Expression Expressions::bits_of(const ir::Bits& bits, std::string_view kind) {
    const std::string first = bits.first == 0 ? "" : "<" + std::to_string(bits.first) + ">";
    const bool of_action = unit_.program[bits.buffer].storage == ir::Storage::Action;
    const std::string function = of_action ? "action_bits" : "bits";
    return tree::call("rddl::" + std::string(kind) + function + first,
                      {elements(record(bits.buffer), bits.indices)});
}

// "rddl::union_of<moves_>(rddl::bits(state.at[c]), action.move[c])"
Expression Expressions::lower(const ir::Node&, const ir::Union& form) {
    tree::Expressions arguments = {lower(form.bits)};
    append(arguments, all_of(form.row));
    return tree::call("rddl::union_of<" + unit_.names.buffers[form.masks.index] + ">",
                      std::move(arguments));
}

Expression Expressions::lower(const ir::Node&, const ir::Local& local) {
    return word(locals_.at(local.local));
}

Expression Expressions::lower(const ir::Node& node, const ir::Convert& convert) {
    if (node.type == ir::Scalar::Int)
        return call(unit_.has_byte_ints() ? "to_int<" + type(node.type) + ">" : "to_int",
                    {convert.operand});
    if (!convert.skips_int) {
        const bool to_float = unit_.program.real == RealType::Float;
        return call(to_float ? "to_float" : "to_real", {convert.operand});
    }
    const auto& rounded = std::get<ir::Apply>(unit_.program[convert.operand].form);
    return call(rounding_function(rounded.op), rounded.operands);
}

Expression Expressions::lower(const ir::Node& node, const ir::Apply& apply) {
    if (auto test = test_of_few_bits(apply)) return *std::move(test);
    const bool on_ints = unit_.program[apply.operands.front()].type == ir::Scalar::Int;
    const auto spelling = spelling_of(apply.op, on_ints);
    if (const auto* function = std::get_if<std::string>(&spelling))
        return call(*function, apply.place ? apply.operands : unit_.operands_of(node), apply.place);
    tree::Expressions operands = all_of(apply.operands);
    if (apply.op == Operator::Implies)
        operands[0] = operation(plain_operator(Operator::Not), list(std::move(operands[0])));
    return operation(std::get<tree::Operator>(spelling), std::move(operands));
}

// "!rddl::has_any_of<ROW_BITS_>(bits, x)", "rddl::count_of<ROW_BITS_>(bits, x) == 1"
std::optional<Expression> Expressions::test_of_few_bits(const ir::Apply& apply) {
    if (!is_one_of(apply.op, {Operator::Equal, Operator::NotEqual})) return std::nullopt;
    const ir::NodeId tested = apply.operands.front(), constant = apply.operands.back();
    if (is_named(tested) || !is_int_constant(unit_.program[constant])) return std::nullopt;
    const auto* count = std::get_if<ir::Apply>(&unit_.program[tested].form);
    if (count && count->op == Operator::CountOnes) {
        auto ones = of_few_bits("rddl::count_of<", count->operands.front());
        if (!ones) return std::nullopt;
        return operation(plain_operator(apply.op), list(*std::move(ones), lower(constant)));
    }
    const auto& limit = std::get<ir::Constant>(unit_.program[constant].form);
    if (limit.value != ir::Value(std::int64_t{0})) return std::nullopt;
    auto any = of_few_bits("rddl::has_any_of<", tested);
    if (!any || apply.op == Operator::NotEqual) return any;
    return operation(plain_operator(Operator::Not), list(*std::move(any)));
}
std::optional<Expression> Expressions::of_few_bits(const std::string& function, ir::NodeId joined) {
    const auto few =
        is_named(joined) ? std::nullopt : ir::few_bits(unit_.program, unit_.narrow_bits, joined);
    if (!few) return std::nullopt;
    const std::span<const ir::NodeId> row = few->ones->indices;
    tree::Expressions arguments = {lower(few->bits)};
    if (few->ones->gather == ir::Gather::Adjacent) {
        several_->looks_at_few_bits = true;
        arguments.push_back(word(several_->objects));
        append(arguments, all_of(row.subspan(several_->nest.variables.size())));
    } else {
        for (const ir::NodeId id : row) arguments.push_back(index(id));
    }
    return tree::call(function + unit_.names.buffers[few->ones->buffer.index] + ">",
                      std::move(arguments));
}

Expression Expressions::lower(const ir::Node&, const ir::Select& select) {
    const bool constants = is_int_constant(unit_.program[select.then_value]) &&
                           is_int_constant(unit_.program[select.else_value]);
    Expression condition = lower(select.condition);
    Expression first = constants ? result(select.then_value) : lower(select.then_value);
    Expression second = constants ? result(select.else_value) : lower(select.else_value);
    return tree::call("rddl::select",
                      list(std::move(condition), std::move(first), std::move(second)));
}

Expression Expressions::lower(const ir::Node& node, const ir::Reduce&) {
    return inline_binder(node);
}

Expression Expressions::lower(const ir::Node&, const ir::Sample& sample) {
    const std::string function =
        sample.is_valid ? "valid_bernoulli" : function_of(sample.distribution);
    tree::Expressions arguments = place_of_draw(sample.place, sample.distribution);
    append(arguments, all_of(sample.parameters));
    return tree::call("rddl::sample::" + function, std::move(arguments));
}

Expression Expressions::lower(const ir::Node& node, const ir::Discrete& discrete) {
    const ListedWeights listed = listed_weights(node);
    return discrete_call(discrete, listed, braces(weights_type(discrete), all_of(listed.weights)));
}

Expressions::ListedWeights Expressions::listed_weights(const ir::Node& draw) const {
    if (auto shares = shares_of(draw)) return {std::move(shares->weights), shares->total};
    return {std::get<ir::Discrete>(draw.form).weights, std::nullopt};
}

std::optional<ir::Shares> Expressions::shares_of(const ir::Node& draw) const {
    return ir::shares_of(unit_.program, unit_.properties, draw);
}

std::string Expressions::weights_type(const ir::Discrete& discrete) {
    return "std::array<" + type(ir::Scalar::Real) + ", " + std::to_string(discrete.weights.size()) +
           ">";
}

// "rddl::sample::discrete_of_shares(context, {0, p}, total, weights)"
Expression Expressions::discrete_call(const ir::Discrete& discrete, const ListedWeights& listed,
                                      Expression weights) {
    std::string function = discrete.normalise ? "unnormalised_discrete" : "discrete";
    tree::Expressions arguments = place_of_draw(discrete.place);
    if (listed.total) {
        function += "_of_shares";
        arguments.push_back(lower(*listed.total));
    }
    arguments.push_back(std::move(weights));
    return tree::call("rddl::sample::" + function, std::move(arguments));
}

Expression Expressions::lower(const ir::Node& node, const ir::DiscreteOver&) {
    return inline_binder(node);
}

// "rddl::sample::interval<weather_thresholds_>(context, {0, c}, state.weather[c])"
Expression Expressions::lower(const ir::Node&, const ir::Interval& interval) {
    tree::Expressions arguments = place_of_draw(interval.place);
    std::span<const ir::NodeId> row = interval.row;
    if (several_ && ir::begins_with(unit_.program, interval.row, several_->nest)) {
        arguments.push_back(word(several_->objects));
        row = row.subspan(several_->nest.variables.size());
    }
    append(arguments, all_of(row));
    return tree::call("rddl::sample::interval<" + unit_.names.buffers[interval.table.index] + ">",
                      std::move(arguments));
}

Expression Expressions::lower(const ir::Node& node, const ir::Fault& fault) {
    return tree::call("rddl::fault<" + type(node.type) + ">", place(fault.place));
}

// -------------------------------------------------------------------------------- calls

tree::Expressions Expressions::all_of(std::span<const ir::NodeId> operands) {
    tree::Expressions expressions;
    for (ir::NodeId operand : operands) expressions.push_back(lower(operand));
    return expressions;
}

Expression Expressions::call(std::string_view function, const std::vector<ir::NodeId>& operands,
                             const std::optional<ir::Place>& where) {
    tree::Expressions arguments = where ? place(*where) : tree::Expressions{};
    append(arguments, all_of(operands));
    return tree::call("rddl::" + std::string(function), std::move(arguments));
}

tree::Expressions Expressions::place_of_draw(const ir::Place& place,
                                             std::optional<Distribution> distribution) {
    const auto where = unit_.step_draws.find(place);
    if (where && where->over_several == several_.has_value()) {
        uses_.context = true;
        return {word(context()), place_in_step(place, *where)};
    }
    const bool takes_one_number = !distribution || is_by_inversion(*distribution);
    if (takes_one_number && !several_ && unit_.is_lone(place))
        return this->place(
            place, unit_.is_among_sites(place) ? "rddl::PlaceAmongSites" : "rddl::LonePlace");
    // Packs make the normals of neighbours together, and of other numbers no more than those of the
    // objects.
    const bool is_normal = distribution == Distribution::Normal;
    const bool is_bernoulli = distribution == Distribution::Bernoulli && !several_;
    const auto count = is_normal || is_bernoulli ? objects_among(place) : std::nullopt;
    const bool is_among = count && (is_normal || leaves_few_numbers(count->size));
    const std::string type = is_normal && unit_.is_chosen_by_table(place) ? "rddl::PlaceAmongSome<"
                                                                          : "rddl::PlaceAmong<";
    tree::Expressions arguments =
        this->place(place, is_among ? type + unit_.size_of(*count) + ">" : "");
    const auto loop = is_normal && several_ ? unit_.step_normals.find(place) : std::nullopt;
    if (loop) arguments.back() = place_of_normals(*loop, std::move(arguments.back()));
    return arguments;
}

Expression Expressions::place_of_normals(std::size_t loop, Expression place) {
    uses_.normals = true;
    return tree::call("rddl::place_of_normals<" + std::to_string(loop) + ">",
                      {word("normals"), std::move(place)});
}

Expression Expressions::place_in_step(const ir::Place& place, const StepDraws::Where& where) {
    uses_.numbers = true;
    std::string function = "rddl::place_in_row<" + std::to_string(where.row);
    if (where.lane)
        function =
            "rddl::place_in_lane<" + std::to_string(where.row) + ", " + std::to_string(*where.lane);
    tree::Expressions arguments = tree::list(word("numbers"));
    append(arguments, numbers_of(place));
    return tree::call(function + ">", std::move(arguments));
}

std::optional<ir::Variable> Expressions::objects_among(const ir::Place& place) const {
    const auto* index = std::get_if<ir::Index>(&unit_.program[place.index].form);
    const std::vector<ir::VariableId>& scope = unit_.program[place.site].scope;
    if (scope.size() != 1) return std::nullopt;
    const ir::Variable& object = unit_.program[scope.front()];
    const bool is_in_loop =
        several_ || (index && unit_.program[index->variable].size == object.size);
    return is_in_loop && object.size > 1 ? std::optional(object) : std::nullopt;
}

tree::Expressions Expressions::place(const ir::Place& place, const std::string& type) {
    uses_.context = true;
    return {word(context()), braces(type, numbers_of(place))};
}

tree::Expressions Expressions::numbers_of(const ir::Place& place) {
    const auto& series = unit_.program[place.site].series;
    tree::Expressions numbers = {tree::number(place.site.index),
                                 several_ ? word(several_->objects) : index(place.index)};
    if (series) numbers.push_back(tree::number(series->index));
    return numbers;
}

const ir::Reduce* Expressions::over_true(const ir::Node& binder) const {
    const auto* reduce = std::get_if<ir::Reduce>(&binder.form);
    return reduce && reduce->over_true && !several_ ? reduce : nullptr;
}

const ir::Reduce* Expressions::second_over_true(const ir::Node& binder) const {
    const ir::Reduce* sum = over_true(binder);
    return sum && ir::table_of_bools(unit_.program, *sum)
               ? &std::get<ir::Reduce>(unit_.program[sum->body].form)
               : nullptr;
}

// "state.p[c]"
Expression Expressions::bools_of(const ir::Reduce& reduce) {
    const ir::Load* const table = ir::table_of_bools(unit_.program, reduce);
    const ir::Load& load = table ? *table : *ir::row_of_bools(unit_.program, reduce);
    const std::size_t dimensions = table ? 2 : 1;
    return elements(record(load.buffer),
                    std::span(load.indices).first(load.indices.size() - dimensions));
}

// "rddl::count_true(state.p[c])"
std::optional<Expression> Expressions::count_of_true(const ir::Node& binder) {
    const ir::Reduce* sum = over_true(binder);
    if (!sum || !std::holds_alternative<ir::Convert>(unit_.program[sum->body].form))
        return std::nullopt;
    return tree::call("rddl::count_true", {bools_of(*sum)});
}

// "state.open[t] && rddl::is_any_in_all(action.drive[t], action.drive[u])"
std::optional<Expression> Expressions::any_in_common_rows(const ir::Node& binder) {
    const auto* exists = std::get_if<ir::Reduce>(&binder.form);
    const auto common = exists ? ir::common_rows(unit_.program, *exists) : std::nullopt;
    const auto is_bytes = [&](const ir::Load* row) {
        const bool may_be_any_byte =
            unit_.tests_action_bools && ir::is_action_bools(unit_.program[row->buffer]);
        return !may_be_any_byte &&
               std::ranges::all_of(std::span(row->indices).first(row->indices.size() - 1),
                                   [&](ir::NodeId index) { return unit_.is_uniform(index); });
    };
    if (!common || several_ || !std::ranges::all_of(common->rows, is_bytes)) return std::nullopt;
    tree::Expressions rows;
    for (const ir::Load* row : common->rows)
        rows.push_back(
            elements(record(row->buffer), std::span(row->indices).first(row->indices.size() - 1)));
    Expression all = tree::call("rddl::is_any_in_all", std::move(rows));
    for (auto other = common->others.rbegin(); other != common->others.rend(); ++other)
        all = operation(plain_operator(Operator::And), list(lower(*other), std::move(all)));
    return all;
}

const ir::Select& Expressions::term_over_true(const ir::Node& binder) const {
    const ir::Reduce* const second = second_over_true(binder);
    const ir::Reduce& innermost = second ? *second : *over_true(binder);
    return std::get<ir::Select>(unit_.program[innermost.body].form);
}

// "rddl::sum_where_true<Real>(state.p[c], GAIN_)"
std::optional<Expression> Expressions::sum_where_true(const ir::Node& binder) {
    const ir::Reduce* const sum = over_true(binder);
    const ir::Load* const terms = sum ? ir::constants_over_true(unit_.program, *sum) : nullptr;
    if (!terms) return std::nullopt;
    const std::size_t dimensions = second_over_true(binder) ? 2 : 1;
    const auto row = std::span(terms->indices).first(terms->indices.size() - dimensions);
    return tree::call("rddl::sum_where_true<" + type(binder.type) + ">",
                      tree::list(bools_of(*sum), elements(record(terms->buffer), row)));
}

// "rddl::sample::discrete_of_row(context, {0, p}, scratch.weights[p])"
std::optional<Expression> Expressions::draw_of_row(const ir::Node& binder) {
    const auto shares = ir::shares_of_elements(unit_.program, binder);
    if (!shares || !shares->is_row() || several_) return std::nullopt;
    tree::Expressions arguments = place_of_draw(std::get<ir::DiscreteOver>(binder.form).place);
    arguments.push_back(elements(record(shares->weight.buffer),
                                 std::span(shares->weight.indices).first(shares->axis)));
    return tree::call("rddl::sample::discrete_of_row", std::move(arguments));
}

std::optional<ir::ReductionNest> Expressions::several_at_once(const ir::Node& binder) const {
    const auto* outermost = std::get_if<ir::Reduce>(&binder.form);
    if (!outermost || !outermost->several_at_once) return std::nullopt;
    ir::ReductionNest nest{outermost->op, {outermost->variable}, outermost->body};
    if (const auto inner = ir::reduction_nest(unit_.program, nest.body);
        inner && inner->op == nest.op) {
        nest.variables.insert(nest.variables.end(), inner->variables.begin(),
                              inner->variables.end());
        nest.body = inner->body;
    }
    return nest;
}

// "rddl::for_all_objects<link_count * link_count>(context, [&](auto&, auto u_d) { ... })"
Expression Expressions::quantifier_of_objects(const ir::ReductionNest& nest,
                                              const ObjectNames& names, tree::Block test) {
    const bool has_context = std::exchange(uses_.context, true);
    const char* const function =
        nest.op == Reduction::Exists ? "rddl::exists_object<" : "rddl::for_all_objects<";
    tree::Expressions parameters = {context_parameter(has_context, names.context),
                                    {tree::Declared{"auto", names.objects}}};
    return tree::call(
        function + count_of(nest.variables) + ">",
        list(word("context"), Expression{tree::Lambda{std::move(parameters), std::move(test)}}));
}

ir::NodeId Expressions::bound_value(const ir::Node& binder) const {
    if (!over_true(binder)) return ir::operands_of(binder).front();
    return term_over_true(binder).then_value;
}

std::string Expressions::binder_function(const ir::Node& binder) {
    if (over_true(binder)) return "rddl::sum_over_true<" + type(binder.type) + ">";
    if (const auto* reduce = std::get_if<ir::Reduce>(&binder.form)) {
        const std::string function = "rddl::" + function_of(reduce->op);
        return several_ ? function : function + "<" + type(binder.type) + ">";
    }
    const bool normalises = std::get<ir::DiscreteOver>(binder.form).normalise;
    return normalises ? "rddl::sample::unnormalised_discrete_over" : "rddl::sample::discrete_over";
}

tree::Expressions Expressions::binder_arguments(const ir::Node& binder) {
    if (const ir::Reduce* sum = over_true(binder)) {
        if (term_over_true(binder).evaluated != ir::Evaluated::Branch) return {bools_of(*sum)};
        uses_.context = true;
        return {word(context()), bools_of(*sum)};
    }
    if (const auto* reduce = std::get_if<ir::Reduce>(&binder.form)) {
        if (!several_) return {range(*reduce)};
        uses_.context = true;
        return {word(several_->context), range(*reduce)};
    }
    const auto& discrete = std::get<ir::DiscreteOver>(binder.form);
    tree::Expressions arguments = place_of_draw(discrete.place);
    arguments.push_back(word(unit_.size_of(unit_.program[discrete.variable])));
    return arguments;
}

Expression Expressions::range(const ir::Reduce& reduce) {
    if (!reduce.bounds) return word(unit_.size_of(unit_.program[reduce.variable]));
    // "rddl::row(LINK_rows, c)": from one element of a table to the next one.
    if (const ir::Load* row = ir::row_of(unit_.program, *reduce.bounds))
        return tree::call("rddl::row", {record(row->buffer), index(row->indices.front())});
    const ir::Variable& variable = unit_.program[reduce.variable];
    Expression begin = index(reduce.bounds->begin);
    Expression end = ir::constant<std::int64_t>(unit_.program, reduce.bounds->end) == variable.size
                         ? word(unit_.size_of(variable))
                         : index(reduce.bounds->end);
    return tree::call("rddl::IndexRange", {std::move(begin), std::move(end)});
}

Expression Expressions::parameter(ir::VariableId variable, ir::NodeId body) const {
    const auto& used = unit_.properties_of(body).free_variables;
    if (!std::ranges::binary_search(used, variable)) return word("rddl::Index");
    return {tree::Declared{"rddl::Index", variables_.at(variable)}};
}

// "rddl::sum_of_row(state.q, u)"
std::optional<Expression> Expressions::sum_of_row(const ir::Node& node) {
    const auto* reduce = std::get_if<ir::Reduce>(&node.form);
    if (!several_ || !reduce || reduce->op != Reduction::Sum || reduce->bounds) return std::nullopt;
    const auto* load = std::get_if<ir::Load>(&unit_.program[reduce->body].form);
    const std::size_t own = several_->nest.variables.size();
    if (!load || load->gather != ir::Gather::Adjacent || load->indices.size() != own + 1 ||
        unit_.program[load->buffer].scalar != ir::Scalar::Real ||
        unit_.program[load->buffer].storage == ir::Storage::Constant ||
        unit_.program[load->buffer].shape.back() != unit_.program[reduce->variable].size ||
        !ir::is_index_of(unit_.program, load->indices.back(), reduce->variable))
        return std::nullopt;
    return tree::call("rddl::sum_of_row", {record(load->buffer), word(several_->objects)});
}

Expression Expressions::inline_binder(const ir::Node& node) {
    return lower_binder(node,
                        [&](ir::NodeId body) { return tree::Block{{tree::Return{result(body)}}}; });
}

// ------------------------------------------------------------------------------ elements

Expression Expressions::record(ir::BufferId id) {
    const std::string& name = unit_.names.buffers[id.index];
    const ir::Storage storage = unit_.program[id].storage;
    if (storage == ir::Storage::Constant) return word(name);
    uses_.records.insert(storage);
    Expression table = word(words_of(storage).parameter + "." + name);
    if (unit_.names.sliding_buffers[id.index].empty()) return table;
    return tree::call("rddl::window", list(std::move(table), sliding_buffer(id)));
}

Expression Expressions::sliding_buffer(ir::BufferId id) {
    if (unit_.names.sliding_buffers[id.index].empty()) return word("rddl::no_sliding_buffer");
    const std::string record = words_of(unit_.program[id].storage).parameter;
    return word(record + "." + unit_.names.sliding_buffers[id.index]);
}

tree::Expressions Expressions::with_sliding_buffer(ir::BufferId id) {
    const ir::Storage storage = unit_.program[id].storage;
    (storage == ir::Storage::Next ? uses_.stored : uses_.records).insert(storage);
    return {word(words_of(storage).parameter + "." + unit_.names.buffers[id.index]),
            sliding_buffer(id)};
}

Expression Expressions::elements(Expression table, std::span<const ir::NodeId> indices) {
    for (ir::NodeId id : indices) table = element(std::move(table), index(id));
    return table;
}

Expression Expressions::target(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) {
    uses_.stored.insert(unit_.program[buffer].storage);
    if (!several_) return elements(record(buffer), indices);
    const auto row = std::span(indices).first(indices.size() - several_->nest.variables.size());
    return tree::call("rddl::elements", {elements(record(buffer), row), word(several_->objects)});
}

Expression Expressions::view(const ir::TableView& view, bool is_written) {
    if (is_written) return target(view.buffer, view.indices);
    return elements(record(view.buffer), view.indices);
}

tree::Statement Expressions::lower(const ir::Call& call) {
    if (ir::is_external(call.callee)) return external_call(call);
    if (std::holds_alternative<ir::Together>(call.callee)) return together(call);
    const ir::Extent extent = ir::extent_of(unit_.program, call);
    const bool overwrites = ir::overwrites_inputs(call.callee);
    tree::Expressions arguments = call.place ? place(*call.place) : tree::Expressions{};
    arguments.push_back(word(unit_.count_of(extent.type, extent.size)));
    append(arguments, all_of(call.scalars));
    for (const ir::TableView& input : call.inputs) arguments.push_back(view(input, overwrites));
    arguments.push_back(view(call.output, true));
    return {tree::call(function_of(unit_.program, call.callee), std::move(arguments))};
}

// rddl::evaluate_together(scratch.angles, rddl::cosine_of(state.a), rddl::sine_of(state.b));
tree::Statement Expressions::together(const ir::Call& call) {
    tree::Expressions arguments = tree::list(view(call.output, true));
    for (const ir::NodeId id : call.scalars) {
        const auto& function = std::get<ir::Apply>(unit_.program[id].form);
        arguments.push_back(
            tree::call(function.op == Operator::Sin ? "rddl::sine_of" : "rddl::cosine_of",
                       all_of(function.operands)));
    }
    return {tree::call(function_of(unit_.program, call.callee), std::move(arguments))};
}

// Gives one value, or fills a table. Tables are passed as spans.
tree::Statement Expressions::external_call(const ir::Call& call) {
    const auto is_value = [&](const ir::TableView& view) {
        return ir::axes_of(unit_.program, view).empty();
    };
    const std::string function = function_of(unit_.program, call.callee);
    tree::Expressions arguments;
    for (const ir::TableView& input : call.inputs) {
        Expression table = view(input, false);
        arguments.push_back(is_value(input)
                                ? std::move(table)
                                : tree::call("rddl::external::input", {std::move(table)}));
    }
    Expression output = view(call.output, true);
    if (is_value(call.output))
        return {tree::Assign{std::move(output), tree::call(function, std::move(arguments))}};
    arguments.push_back(tree::call("rddl::external::output", {std::move(output)}));
    return {tree::call(function, std::move(arguments))};
}

// "rddl::is_true(action.p[x])" where bytes are tested one by one.
Expression Expressions::tested(ir::BufferId buffer, Expression element) const {
    if (!unit_.tests_action_bools || !ir::is_action_bools(unit_.program[buffer])) return element;
    return tree::call("rddl::is_true", list(std::move(element)));
}

Expression Expressions::lower(const ir::Node&, const ir::Load& load) {
    return tested(load.buffer, element_of(load));
}

Expression Expressions::element_of(const ir::Load& load) {
    const std::span<const ir::NodeId> indices = load.indices;
    switch (load.gather) {
        case ir::Gather::Adjacent:
            return of_objects("rddl::at", record(load.buffer),
                              indices.subspan(several_->nest.variables.size()));
        case ir::Gather::InRow: {
            const auto row = indices.first(indices.size() - several_->nest.variables.size());
            return of_objects("rddl::at", elements(record(load.buffer), row), {});
        }
        case ir::Gather::Rows:
            return element_of_row(load);
        case ir::Gather::Own:
            return of_objects("rddl::at_own", record(load.buffer), indices);
        case ir::Gather::Chances:
            return tree::call("rddl::chances<" + unit_.names.buffers[load.buffer.index] + ">",
                              {word(several_->objects)});
        case ir::Gather::None:
            break;
    }
    // Uniform indices stand in brackets; from the first other one on, the lanes differ.
    const auto next =
        std::ranges::find_if(indices, [&](ir::NodeId id) { return !unit_.is_uniform(id); });
    const auto uniform = static_cast<std::size_t>(next - indices.begin());
    Expression table = elements(record(load.buffer), indices.first(uniform));
    if (uniform == indices.size()) return table;
    tree::Expressions arguments = {std::move(table)};
    append(arguments, all_of(indices.subspan(uniform)));
    return tree::call("rddl::at", std::move(arguments));
}

Expression Expressions::of_objects(const std::string& function, Expression table,
                                   std::span<const ir::NodeId> indices) {
    tree::Expressions arguments = {std::move(table), word(several_->objects)};
    append(arguments, all_of(indices));
    return tree::call(function, std::move(arguments));
}

// "rddl::at_row<up_by_count, up_kind>(x, count)": the row of each object, or of its kind.
Expression Expressions::element_of_row(const ir::Load& load) {
    std::string tables = unit_.names.buffers[load.buffer.index];
    if (const auto* kind = std::get_if<ir::Load>(&unit_.program[load.indices[0]].form))
        tables += ", " + unit_.names.buffers[kind->buffer.index];
    return tree::call("rddl::at_row<" + tables + ">",
                      {word(several_->objects), lower(load.indices[1])});
}

// Arithmetic of objects cannot overflow, so it needs no wrapping functions.
bool Expressions::is_plain_index(ir::NodeId id) const {
    const ir::Node& node = unit_.program[id];
    if (named_.contains(id) || std::holds_alternative<ir::Index>(node.form)) return true;
    if (std::holds_alternative<ir::Constant>(node.form)) return true;
    if (std::holds_alternative<ir::Load>(node.form)) return unit_.is_uniform(id);
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    return apply && (apply->op == Operator::Add || apply->op == Operator::Multiply) &&
           std::ranges::all_of(apply->operands,
                               [&](ir::NodeId operand) { return is_plain_index(operand); });
}

Expression Expressions::index(ir::NodeId id) {
    const auto* apply = std::get_if<ir::Apply>(&unit_.program[id].form);
    if (!apply || is_named(id) || !is_plain_index(id)) return lower(id);
    Expression first = index(apply->operands[0]);
    return operation(plain_operator(apply->op), list(std::move(first), index(apply->operands[1])));
}

}  // namespace rddlc::cpp
