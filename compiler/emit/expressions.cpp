// Over 400 lines: a function for each kind of node.
#include "emit/expressions.hpp"

#include "emit/literals.hpp"
#include "emit/operators.hpp"
#include "emit/tables.hpp"
#include "ir/call.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rddlc::cpp {
namespace {

std::string operand_of(const OperatorSpelling& spelling, Level loosest, const Spelled& operand) {
    const bool bare =
        operand.level >= loosest || (spelling.associative && operand.level == spelling.level);
    return bare ? operand.text : "(" + operand.text + ")";
}

Spelled binary(const OperatorSpelling& spelling, const Spelled& left, const Spelled& right) {
    return {operand_of(spelling, spelling.left, left) + " " + spelling.word + " " +
                operand_of(spelling, spelling.right, right),
            spelling.level};
}

std::string comma_separated(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
    return text;
}

bool is_int_constant(const ir::Node& node) {
    return node.type == ir::Scalar::Int && std::holds_alternative<ir::Constant>(node.form);
}

// A real to an int.
bool rounds(const ir::Node& node) {
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    return apply && (apply->op == Operator::Round || apply->op == Operator::Floor ||
                     apply->op == Operator::Ceil);
}

}  // namespace

// -------------------------------------------------------------------------------- names

std::string Expressions::enter(ir::VariableId variable) {
    return variables_[variable] = scope_.claim(unit_.program[variable].name);
}

const Expressions::SeveralObjects& Expressions::enter(ir::Nest nest) {
    std::string wish;
    for (const ir::VariableId variable : nest.variables)
        wish += (wish.empty() ? "" : "_") + unit_.program[variable].name;
    several_ = {std::move(nest), scope_.claim("several"), scope_.claim(wish)};
    return *several_;
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
    switch (scalar) {
        case ir::Scalar::Bool:
            return "Bool";
        case ir::Scalar::Int:
            return "Int";
        case ir::Scalar::Real:
            break;
    }
    return "Real";
}

// -------------------------------------------------------------------------- expressions

Spelled Expressions::spell(ir::NodeId id) {
    if (nodes_left_ == 0) return {"", Level::Primary};
    --nodes_left_;
    if (const auto named = named_.find(id); named != named_.end()) {
        return {named->second, Level::Primary};
    }
    const ir::Node& node = unit_.program[id];
    return match(node.form, [&](const auto& form) { return spell(node, form); });
}

// Each node takes a character at least.
std::optional<std::string> Expressions::text_within(ir::NodeId id, std::size_t most) {
    nodes_left_ = most + 1;
    std::string whole = text(id);
    const bool is_whole = std::exchange(nodes_left_, all_nodes) > 0;
    return is_whole && whole.size() <= most ? std::optional(std::move(whole)) : std::nullopt;
}

std::string Expressions::result(ir::NodeId id) {
    return as_result(id, text(id));
}

std::optional<std::string> Expressions::result_within(ir::NodeId id, std::size_t most) {
    const std::optional<std::string> whole = text_within(id, most);
    return whole ? std::optional(as_result(id, *whole)) : std::nullopt;
}

std::string Expressions::as_result(ir::NodeId id, const std::string& text) {
    const ir::Node& node = unit_.program[id];
    return is_int_constant(node) ? type(node.type) + "{" + text + "}" : text;
}

Spelled Expressions::spell(const ir::Node&, const ir::Constant& constant) {
    const std::string text = literal(constant.value, unit_.program.real);
    return {text, text.starts_with('-') ? Level::Unary : Level::Primary};
}

Spelled Expressions::spell(const ir::Node&, const ir::Index& index) {
    return {variables_.at(index.variable), Level::Primary};
}

Spelled Expressions::spell(const ir::Node& node, const ir::Search& search) {
    return {"rddl::search<" + record(search.table) + ", " + type(node.type) + ">(" +
                text(search.value) + ")",
            Level::Primary};
}

Spelled Expressions::spell(const ir::Node&, const ir::Bits& bits) {
    const std::string first = bits.first == 0 ? "" : "<" + std::to_string(bits.first) + ">";
    const bool of_action = unit_.program[bits.buffer].storage == ir::Storage::Action;
    const std::string function = of_action ? "rddl::action_bits" : "rddl::bits";
    return {function + first + "(" + record(bits.buffer) + ")", Level::Primary};
}

Spelled Expressions::spell(const ir::Node&, const ir::Local& local) {
    return {locals_.at(local.local), Level::Primary};
}

Spelled Expressions::spell(const ir::Node& node, const ir::Convert& convert) {
    if (node.type == ir::Scalar::Int) return {call("to_int", {convert.operand}), Level::Primary};
    if (unit_.program.real == RealType::Float)
        return {call("to_float", {convert.operand}), Level::Primary};
    const ir::Node& operand = unit_.program[convert.operand];
    if (!rounds(operand)) return {call("to_real", {convert.operand}), Level::Primary};
    const auto& apply = std::get<ir::Apply>(operand.form);
    return {call(spelling_of(apply.op, false).word + "_as_real", apply.operands), Level::Primary};
}

Spelled Expressions::spell(const ir::Node&, const ir::Apply& apply) {
    const bool on_ints = unit_.program[apply.operands.front()].type == ir::Scalar::Int;
    const OperatorSpelling spelling = spelling_of(apply.op, on_ints);
    if (!spelling.is_infix)
        return {call(spelling.word, apply.operands, apply.place), Level::Primary};
    const Spelled first = spell(apply.operands[0]);
    if (apply.operands.size() == 1) {
        return {spelling.word + operand_of(spelling, spelling.left, first), spelling.level};
    }
    Spelled whole = binary(spelling, first, spell(apply.operands[1]));
    if (apply.op == Operator::Implies) whole.text.insert(0, "!");
    return whole;
}

Spelled Expressions::spell(const ir::Node&, const ir::Select& select) {
    const bool constants = is_int_constant(unit_.program[select.then_value]) &&
                           is_int_constant(unit_.program[select.else_value]);
    const std::string then_value = constants ? result(select.then_value) : text(select.then_value);
    return {"rddl::select(" + text(select.condition) + ", " + then_value + ", " +
                (constants ? result(select.else_value) : text(select.else_value)) + ")",
            Level::Primary};
}

Spelled Expressions::spell(const ir::Node& node, const ir::Reduce& reduce) {
    return {lambda_call(node, reduce.variable, reduce.body), Level::Primary};
}

Spelled Expressions::spell(const ir::Node&, const ir::Sample& sample) {
    const std::string valid = needs_no_check(sample) ? "valid_" : "";
    const std::string function = "sample::" + valid + function_of(sample.distribution);
    return {call(function, sample.parameters, sample.place), Level::Primary};
}

// The C++ compiler sees by itself that a number in the text is a probability.
bool Expressions::needs_no_check(const ir::Sample& sample) const {
    if (sample.distribution != Distribution::Bernoulli) return false;
    const ir::NodeId p = sample.parameters.front();
    if (std::holds_alternative<ir::Constant>(unit_.program[p].form)) return false;
    return ir::always_in_domain(sample.distribution, std::array{unit_.facts_of(p).range});
}

Spelled Expressions::spell(const ir::Node&, const ir::Discrete& discrete) {
    const std::string weights = "std::array<" + type(ir::Scalar::Real) + ", " +
                                std::to_string(discrete.weights.size()) + ">{" +
                                arguments(discrete.weights) + "}";
    return {discrete_call(discrete, weights), Level::Primary};
}

std::string Expressions::discrete_call(const ir::Discrete& discrete, const std::string& weights) {
    const std::string function = discrete.normalise ? "unnormalised_discrete" : "discrete";
    return "rddl::sample::" + function + "(" + place(discrete.place) + ", " + weights + ")";
}

Spelled Expressions::spell(const ir::Node& node, const ir::DiscreteOver& discrete) {
    return {lambda_call(node, discrete.variable, discrete.weight), Level::Primary};
}

Spelled Expressions::spell(const ir::Node& node, const ir::Fault& fault) {
    return {"rddl::fault<" + type(node.type) + ">(" + place(fault.place) + ")", Level::Primary};
}

// -------------------------------------------------------------------------------- calls

std::string Expressions::arguments(const std::vector<ir::NodeId>& operands) {
    std::vector<std::string> texts;
    for (ir::NodeId operand : operands) texts.push_back(text(operand));
    return comma_separated(texts);
}

std::string Expressions::call(const std::string& function, const std::vector<ir::NodeId>& operands,
                              const std::optional<ir::Place>& where) {
    return "rddl::" + function + "(" + (where ? place(*where) + ", " : "") + arguments(operands) +
           ")";
}

std::string Expressions::place(const ir::Place& place) {
    uses_.context = true;
    const auto& series = unit_.program[place.site].series;
    const std::string objects = several_ ? several_->objects : index(place.index).text;
    return context() + ", {" + std::to_string(place.site.index) + ", " + objects +
           (series ? ", " + std::to_string(series->index) : "") + "}";
}

std::string Expressions::call_head(const ir::Node& binder) {
    if (const auto* reduce = std::get_if<ir::Reduce>(&binder.form)) {
        return "rddl::" + function_of(reduce->op) + "<" + type(binder.type) + ">(" + range(*reduce);
    }
    const auto& discrete = std::get<ir::DiscreteOver>(binder.form);
    const std::string function =
        discrete.normalise ? "unnormalised_discrete_over" : "discrete_over";
    return "rddl::sample::" + function + "(" + place(discrete.place) + ", " +
           unit_.size_of(unit_.program[discrete.variable]);
}

std::string Expressions::range(const ir::Reduce& reduce) {
    if (!reduce.bounds) return unit_.size_of(unit_.program[reduce.variable]);
    if (const auto row = row_of(*reduce.bounds)) return *row;
    return "rddl::IndexRange(" + index(reduce.bounds->begin).text + ", " +
           index(reduce.bounds->end).text + ")";
}

// "rddl::row(LINK_rows, c)": from one element of a table to the next one.
std::optional<std::string> Expressions::row_of(const ir::Bounds& bounds) {
    const ir::Load* row = ir::row_of(unit_.program, bounds);
    if (!row) return std::nullopt;
    return "rddl::row(" + record(row->buffer) + ", " + index(row->indices.front()).text + ")";
}

std::string Expressions::lambda_head(ir::VariableId variable, ir::NodeId body) {
    const auto& used = unit_.facts_of(body).free_variables;
    const bool is_used = std::ranges::binary_search(used, variable);
    return "[&](rddl::Index" + (is_used ? " " + variables_.at(variable) : "") + ")";
}

std::string Expressions::lambda_call(const ir::Node& node, ir::VariableId variable,
                                     ir::NodeId body) {
    const std::string head = call_head(node);
    const Mark before = mark();
    enter(variable);
    const std::string lambda = lambda_head(variable, body) + " { return " + result(body) + "; }";
    return_to(before);
    return head + ", " + lambda + ")";
}

// ------------------------------------------------------------------------------ elements

std::string Expressions::record(ir::BufferId id) {
    const std::string& name = unit_.names.buffers[id.index];
    const ir::Storage storage = unit_.program[id].storage;
    if (storage == ir::Storage::Constant) return name;
    uses_.state |= storage == ir::Storage::State;
    uses_.action |= storage == ir::Storage::Action;
    uses_.scratch |= storage == ir::Storage::Scratch;
    uses_.next |= storage == ir::Storage::Next;
    uses_.observation |= storage == ir::Storage::Observation;
    uses_.memory |= storage == ir::Storage::Memory;
    uses_.next_memory |= storage == ir::Storage::NextMemory;
    return words_of(storage).parameter + "." + name;
}

std::string Expressions::target(ir::BufferId buffer, const std::vector<ir::NodeId>& indices) {
    std::string text = record(buffer);
    if (several_) text = "rddl::elements(" + text + ", " + several_->objects + ")";
    for (ir::NodeId id : indices)
        if (!several_) text += "[" + index(id).text + "]";
    const ir::Storage storage = unit_.program[buffer].storage;
    uses_.stores_state |= storage == ir::Storage::State;
    uses_.stores_scratch |= storage == ir::Storage::Scratch;
    uses_.stores_next |= storage == ir::Storage::Next;
    uses_.stores_observation |= storage == ir::Storage::Observation;
    uses_.stores_action |= storage == ir::Storage::Action;
    uses_.stores_next_memory |= storage == ir::Storage::NextMemory;
    return text;
}

std::string Expressions::view(const ir::TableView& view, bool is_written) {
    if (is_written) return target(view.buffer, view.indices);
    std::string text = record(view.buffer);
    for (ir::NodeId id : view.indices) text += "[" + index(id).text + "]";
    return text;
}

std::string Expressions::call_text(const ir::Call& call) {
    if (ir::is_external(call.callee)) return external_call_text(call);
    const ir::Extent extent = ir::extent_of(unit_.program, call);
    const bool overwrites = ir::overwrites_inputs(call.callee);
    std::vector<std::string> arguments;
    if (call.place) arguments.push_back(place(*call.place));
    arguments.push_back(unit_.count_of(extent.type, extent.size));
    for (ir::NodeId scalar : call.scalars) arguments.push_back(text(scalar));
    for (const ir::TableView& input : call.inputs) arguments.push_back(view(input, overwrites));
    arguments.push_back(view(call.output, true));
    return function_of(unit_.program, call.callee) + "(" + comma_separated(arguments) + ")";
}

// Gives one value, or fills a table. Tables are passed as spans.
std::string Expressions::external_call_text(const ir::Call& call) {
    const auto is_value = [&](const ir::TableView& view) {
        return ir::axes_of(unit_.program, view).empty();
    };
    std::vector<std::string> arguments;
    for (const ir::TableView& input : call.inputs) {
        const std::string table = view(input, false);
        arguments.push_back(is_value(input) ? table : "rddl::external::input(" + table + ")");
    }
    const std::string output = view(call.output, true);
    const bool gives_value = is_value(call.output);
    if (!gives_value) arguments.push_back("rddl::external::output(" + output + ")");
    return (gives_value ? output + " = " : "") + function_of(unit_.program, call.callee) + "(" +
           comma_separated(arguments) + ")";
}

// "rddl::at_row<up_by_count, up_kind>(x, count)": from a row of each of several objects, or of its
// kind.
std::optional<std::string> Expressions::element_of_row(const ir::Load& load) {
    const auto is_constant = [&](ir::BufferId id) {
        return unit_.program[id].storage == ir::Storage::Constant;
    };
    const bool is_row = several_ && load.indices.size() == 2 && is_constant(load.buffer) &&
                        unit_.program[load.buffer].scalar == ir::Scalar::Real;
    if (!is_row) return std::nullopt;
    const auto is_of_objects = [&](const std::vector<ir::NodeId>& indices) {
        return indices.size() == several_->nest.variables.size() &&
               ir::begins_with(unit_.program, indices, several_->nest);
    };
    std::string tables = record(load.buffer);
    if (!is_of_objects({load.indices[0]})) {
        const auto* kind = std::get_if<ir::Load>(&unit_.program[load.indices[0]].form);
        const bool is_kind = kind && !is_named(load.indices[0]) && is_constant(kind->buffer) &&
                             is_of_objects(kind->indices);
        if (!is_kind) return std::nullopt;
        tables += ", " + record(kind->buffer);
    }
    return "rddl::at_row<" + tables + ">(" + several_->objects + ", " + text(load.indices[1]) + ")";
}

// Uniform indices first in brackets; from the first other one on, the lanes differ.
Spelled Expressions::spell(const ir::Node&, const ir::Load& load) {
    if (const auto text = element_of_row(load)) return {*text, Level::Primary};
    std::string text = record(load.buffer);
    auto next = load.indices.begin();
    if (several_ && ir::begins_with(unit_.program, load.indices, several_->nest)) {
        next += static_cast<std::ptrdiff_t>(several_->nest.variables.size());
        const std::string rest =
            next == load.indices.end() ? "" : ", " + arguments({next, load.indices.end()});
        return {"rddl::at(" + text + ", " + several_->objects + rest + ")", Level::Primary};
    }
    if (several_ && !std::ranges::all_of(load.indices, [&](ir::NodeId id) {
            return ir::is_same_for_all(unit_.facts_of(id), several_->nest);
        }))
        return {"rddl::at_own(" + text + ", " + several_->objects + ", " + arguments(load.indices) +
                    ")",
                Level::Primary};
    for (; next != load.indices.end() && unit_.is_uniform(*next); ++next) {
        text += "[" + index(*next).text + "]";
    }
    if (next == load.indices.end()) return {text, Level::Primary};
    return {"rddl::at(" + text + ", " + arguments({next, load.indices.end()}) + ")",
            Level::Primary};
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

Spelled Expressions::index(ir::NodeId id) {
    const auto* apply = std::get_if<ir::Apply>(&unit_.program[id].form);
    if (!apply || is_named(id) || !is_plain_index(id)) return spell(id);
    return binary(spelling_of(apply->op, false), index(apply->operands[0]),
                  index(apply->operands[1]));
}

}  // namespace rddlc::cpp
