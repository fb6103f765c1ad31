// Over 400 lines: a function for each kind of statement, and for each way to break a long
// expression.
#include "emit/function_body.hpp"

#include "emit/layout.hpp"
#include "emit/operators.hpp"
#include "support/match.hpp"

#include <algorithm>
#include <utility>

namespace rddlc::cpp {
namespace {

// Longer conditions get a name.
constexpr std::size_t longest_condition = 45;
// In operations (Facts::cost): what packs may compute for all lanes though no lane needs it.
constexpr double cost_without_jumps = 128;
// Longer operands of a chain get a name of their own instead of a line of their own.
constexpr std::size_t longest_operand = 75;
// Shorter texts are not worth a name.
constexpr std::size_t shortest_named = 12;
// Of parts that are longer, none is the longest.
constexpr std::size_t longest_compared = 2000;
// An expression with more calls with lambdas inside is taken to pieces first.
constexpr std::size_t most_lambda_calls = 64;

bool is_binder(const ir::Node& node) {
    return ir::bound_variable(node).has_value();
}

// Spelled by names alone; other elements than those at loop indices take a call.
bool is_leaf(const Unit& unit, ir::NodeId id) {
    const auto is_uniform = [&](ir::NodeId index) {
        return unit.is_uniform(index);
    };
    return match(
        unit.program[id].form, [](const ir::Constant&) { return true; },
        [](const ir::Index&) { return true; }, [](const ir::Local&) { return true; },
        [&](const ir::Load& load) { return std::ranges::all_of(load.indices, is_uniform); },
        [](const auto&) { return false; });
}

// The operators that may follow each other in one chain with `op`; empty if it makes no chains.
std::vector<std::string_view> chain_operators(const ir::Node& node) {
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (!apply || apply->operands.size() != 2 || node.type == ir::Scalar::Int) return {};
    switch (apply->op) {
        case Operator::Add:
        case Operator::Subtract:
            return {"+", "-"};
        case Operator::Multiply:
        case Operator::Divide:
            return {"*", "/"};
        case Operator::And:
            return {"&&"};
        case Operator::Or:
            return {"||"};
        case Operator::Equal:
            return {"=="};
        case Operator::NotEqual:
            return {"!="};
        default:
            return {};
    }
}

// What to call a value that needs a name.
std::string_view wish_for(const ir::Node& node) {
    if (const auto* reduce = std::get_if<ir::Reduce>(&node.form)) {
        switch (reduce->op) {
            case Reduction::Sum:
                return "total";
            case Reduction::Product:
                return "product";
            case Reduction::Minimum:
                return "least";
            case Reduction::Maximum:
                return "greatest";
            case Reduction::ForAll:
                return "all";
            case Reduction::Exists:
                return "any";
            default:
                return "best";
        }
    }
    if (std::holds_alternative<ir::Bits>(node.form)) return "bits";
    const auto* apply = std::get_if<ir::Apply>(&node.form);
    if (apply && apply->op == Operator::CountOnes) return "count";
    if (apply && apply->op >= Operator::BitAnd && apply->op <= Operator::BitXor) return "bits";
    const bool draws = std::holds_alternative<ir::Sample>(node.form) ||
                       std::holds_alternative<ir::Discrete>(node.form) ||
                       std::holds_alternative<ir::DiscreteOver>(node.form);
    if (draws) return "draw";
    switch (node.type) {
        case ir::Scalar::Bool:
            return "condition";
        case ir::Scalar::Int:
            return "number";
        case ir::Scalar::Real:
            break;
    }
    return "term";
}

}  // namespace

// --------------------------------------------------------------------------- statements

void FunctionBody::block(const ir::Block& block) {
    for (const ir::Statement& each : block) {
        match(each.form, [&](const auto& form) { statement(form); });
    }
}

void FunctionBody::return_value(ir::NodeId id) {
    value("return ", id);
}

void FunctionBody::statement(const ir::Let& let) {
    expressions_.name(let.local, declare(let.value));
}

void FunctionBody::statement(const ir::Store& store) {
    const auto before = expressions_.mark();
    value(expressions_.target(store.target, store.indices) + " = ", store.value);
    // Values that were named on the way may change with the next store; their names stay taken.
    expressions_.forget(before);
}

void FunctionBody::statement(const ir::Loop& loop) {
    if (loop.several_at_once) return over_several_objects(loop);
    const auto before = expressions_.mark();
    const std::string name = expressions_.enter(loop.variable);
    const std::string size = expressions_.unit().size_of(program()[loop.variable]);
    line("for (rddl::Index " + name + " = 0; " + name + " < " + size + "; ++" + name + ") {");
    ++level_;
    block(loop.body);
    --level_;
    line("}");
    expressions_.return_to(before);
}

// rddl::for_each_object(context, computer_count, [&](auto& several, auto x) { ... });
void FunctionBody::over_several_objects(const ir::Loop& loop) {
    const auto before = expressions_.mark();
    const auto [nest, context, objects] = expressions_.enter(ir::nest_of(loop));
    std::string count;
    for (const ir::VariableId variable : nest.variables)
        count += (count.empty() ? "" : " * ") + expressions_.unit().size_of(program()[variable]);

    const std::string function = "rddl::for_each_object(";
    const std::string arguments = "context, " + count + ", [&](auto&";
    const std::string parameters = ", auto " + objects + ") {";
    const bool on_one_line =
        fits(function.size() + arguments.size() + 1 + context.size() + parameters.size());
    const int deeper = on_one_line ? 1 : 2;

    // Whether the context has a name is known when the body is.
    std::vector<std::string> lines = std::exchange(lines_, {});
    expressions_.uses().context = false;
    level_ += deeper;
    block(*nest.body);
    level_ -= deeper;
    std::swap(lines, lines_);
    const std::string head =
        arguments + (expressions_.uses().context ? " " + context : "") + parameters;
    line(on_one_line ? function + head : function);
    level_ += deeper - 1;
    if (!on_one_line) line(head);
    lines_.insert(lines_.end(), lines.begin(), lines.end());
    line("});");
    level_ -= deeper - 1;

    expressions_.uses().context = true;
    expressions_.leave_nest();
    expressions_.return_to(before);
}

void FunctionBody::statement(const ir::Call& call) {
    const std::string text = expressions_.call_text(call) + ";";
    if (fits(text.size())) return line(text);
    // The value of an external function stands behind a break.
    const std::size_t sign = text.find(" = ");
    if (sign == text.npos) return write_call(text);
    line(text.substr(0, sign + 2));
    ++level_;
    write_call(text.substr(sign + 3));
    --level_;
}

void FunctionBody::write_call(const std::string& text) {
    if (fits(text.size())) return line(text);
    const auto column = static_cast<std::size_t>(level_ * indentation);
    for (const std::string& each : fill_call(text, 0, column)) line(each);
}

void FunctionBody::value(const std::string& lead, ir::NodeId id) {
    prepare(lead, id);
    write(lead, id);
}

// --------------------------------------------------------------------------- preparation

void FunctionBody::prepare(const std::string& lead, ir::NodeId id) {
    name_parts_in_order(id);
    if (const ir::Select* select = lazy_select(id)) return prepare_branch(*select);
    if (is_block(id)) return;
    const ir::Node& node = program()[id];
    do {
        const std::size_t length = length_within(id, line_width) + 1;
        const bool fits_behind_break = lead.ends_with("= ") && fits(length, 1);
        if (fits(lead.size() + length) || fits_behind_break || fits_as_chain(lead, id)) return;
        if (is_binder(node)) return;
        if (const auto* discrete = std::get_if<ir::Discrete>(&node.form)) {
            return prepare_discrete(*discrete);
        }
    } while (name_longest_part(id));
}

void FunctionBody::prepare_branch(const ir::Select& select) {
    const bool is_short = expressions_.text_within(select.condition, longest_condition).has_value();
    if (!is_short) name_value(select.condition);
}

void FunctionBody::prepare_discrete(const ir::Discrete& discrete) {
    for (ir::NodeId weight : discrete.weights) prepare("weights_99[999] = ", weight);
}

// Gives names to the parts of `id` that are blocks, from the outside in. C++ may evaluate operands
// in any order, but the first fault is the one that is told: of several operands that may fault,
// all but the last get names, too.
void FunctionBody::name_parts_in_order(ir::NodeId id) {
    const std::vector<ir::NodeId> parts = eager_parts(id);
    const auto may_fault = [&](ir::NodeId part) {
        return !expressions_.is_named(part) && expressions_.unit().facts_of(part).may_fault;
    };
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        const bool is_binder_block = is_block(*part) && is_binder(program()[*part]);
        const bool before_others =
            may_fault(*part) && std::any_of(part + 1, parts.end(), may_fault);
        if (before_others || is_binder_block || lazy_select(*part)) {
            name_value(*part);
        } else if (is_block(*part) || may_fault(*part)) {
            name_parts_in_order(*part);
        }
    }
}

// False if no part is worth a name.
bool FunctionBody::name_longest_part(ir::NodeId id) {
    const std::vector<ir::NodeId> parts = nameable_parts(id);
    std::vector<std::size_t> lengths;
    for (const ir::NodeId& part : parts) {
        const bool has_name = expressions_.is_named(part) || is_leaf(expressions_.unit(), part) ||
                              expressions_.unit().is_uniform(part);
        lengths.push_back(has_name ? 0 : length_within(part, longest_compared));
    }
    const std::size_t longest = lengths.empty() ? 0 : std::ranges::max(lengths);
    if (longest < shortest_named) return false;
    // The first of those that are about as long, so that names come in the order of the text.
    const auto first = std::ranges::find_if(
        lengths, [&](std::size_t length) { return 3 * length >= 2 * longest; });
    const ir::NodeId part = parts[static_cast<std::size_t>(first - lengths.begin())];
    // Where it has parts that need names itself, these may be enough.
    const std::size_t names_before = expressions_.named_count();
    prepare_declaration(part);
    if (expressions_.named_count() == names_before) name_value(part);
    return true;
}

void FunctionBody::name_value(ir::NodeId id) {
    if (!expressions_.is_named(id)) expressions_.name(id, declare(id));
}

// "const Real total = ...;"
std::string FunctionBody::declare(ir::NodeId id) {
    // The parts that need names get them first, so that numbers grow from top to bottom.
    prepare_declaration(id);
    const std::string name = expressions_.claim(wish_for(program()[id]));
    write(type_in_declaration(id) + name + " = ", id);
    return name;
}

void FunctionBody::prepare_declaration(ir::NodeId id) {
    prepare(type_in_declaration(id) + std::string(wish_for(program()[id])) + "_99 = ", id);
}

std::string FunctionBody::type_in_declaration(ir::NodeId id) {
    if (expressions_.is_over_several()) return "const auto ";
    const bool is_index = expressions_.unit().is_uniform(id);
    return "const " + (is_index ? "rddl::Index" : expressions_.type(program()[id].type)) + " ";
}

// -------------------------------------------------------------------------------- forms

void FunctionBody::write(const std::string& lead, ir::NodeId id) {
    const ir::Node& node = program()[id];
    if (const ir::Select* select = lazy_select(id)) return write_branch(lead, *select);
    if (is_block(id)) return write_lambda_call(lead, id);

    const std::string text = lead == "return " ? expressions_.result(id) : expressions_.text(id);
    if (fits(lead.size() + text.size() + 1)) return line(lead + text + ";");
    if (lead.ends_with("= ") && fits(text.size() + 1, 1)) {
        line(lead.substr(0, lead.size() - 1));
        ++level_;
        line(text + ";");
        --level_;
        return;
    }
    if (expressions_.is_named(id)) return line(lead + text + ";");
    if (is_binder(node)) return write_lambda_call(lead, id);
    if (const auto* discrete = std::get_if<ir::Discrete>(&node.form)) {
        return write_discrete(lead, *discrete);
    }
    const auto column = static_cast<std::size_t>(level_ * indentation);
    const std::vector<std::string_view> operators = chain_operators(node);
    const std::vector<std::string> lines = operators.empty()
                                               ? fill_call(lead + text + ";", lead.size(), column)
                                               : fill_chain(lead, text + ";", operators, column);
    for (const std::string& each : lines) line(each);
}

// In the order of clang-format's preferences.
void FunctionBody::write_lambda_call(const std::string& lead, ir::NodeId id) {
    const ir::Node& node = program()[id];
    const ir::NodeId body = ir::operands_of(node).front();
    const std::string head = expressions_.call_head(node) + ",";
    const std::size_t bracket = head.find('(') + 1;
    const std::string function = lead + head.substr(0, bracket);
    const std::string arguments = head.substr(bracket);

    const auto before = expressions_.mark();
    expressions_.enter(*ir::bound_variable(node));
    const std::string lambda = expressions_.lambda_head(*ir::bound_variable(node), body);
    const std::optional<std::string> result = short_result(body);
    const std::string whole = result ? lambda + " { return " + *result + "; });" : "";
    const bool has_whole = !whole.empty() && fits(whole.size(), 1);
    const std::string opening = function + arguments + " " + lambda + " {";
    if (has_whole && fits(function.size() + whole.size())) {
        line(function + arguments);
        line(std::string(function.size(), ' ') + whole);
    } else if (has_whole && fits(arguments.size() + 1 + whole.size(), 1)) {
        line(function);
        line(std::string(indentation, ' ') + arguments + " " + whole);
    } else if (fits(opening.size())) {
        line(opening);
        write_lambda_body(body);
        line("});");
    } else if (!has_whole && lead.ends_with("= ") && fits(opening.size() - lead.size(), 1)) {
        line(lead.substr(0, lead.size() - 1));
        ++level_;
        line(opening.substr(lead.size()));
        write_lambda_body(body);
        line("});");
        --level_;
    } else {
        line(function);
        ++level_;
        const bool on_one_line = fits(arguments.size() + lambda.size() + 3);
        if (has_whole || !on_one_line) line(arguments);
        if (has_whole) {
            line(whole);
        } else {
            line((on_one_line ? arguments + " " : "") + lambda + " {");
            write_lambda_body(body);
            line("});");
        }
        --level_;
    }
    expressions_.return_to(before);
}

// A chain of else-ifs is one call: its conditions after the first are lambdas, like its values.
// What packs may evaluate in all lanes, since it costs little and neither draws nor faults, needs
// no context. An elementary function costs more than a jump that lanes do not agree about.
void FunctionBody::write_branch(const std::string& lead, const ir::Select& select) {
    std::vector<ir::NodeId> lambdas = {select.then_value};
    ir::NodeId last = select.else_value;
    while (const ir::Select* next = lazy_select(last)) {
        lambdas.insert(lambdas.end(), {next->condition, next->then_value});
        last = next->else_value;
    }
    lambdas.push_back(last);

    const bool needs_context = !are_harmless(lambdas);
    expressions_.uses().context |= needs_context;

    line(lead + "rddl::branch(");
    ++level_;
    std::string current = (needs_context ? expressions_.context() + ", " : "") +
                          expressions_.text(select.condition) + ",";
    for (std::size_t k = 0; k < lambdas.size(); ++k) {
        const bool is_last = k + 1 == lambdas.size();
        add_lambda(current, lambdas[k], is_last ? ");" : ",");
    }
    line(current);
    --level_;
}

bool FunctionBody::are_harmless(const std::vector<ir::NodeId>& lambdas) const {
    double cost = 0;
    for (ir::NodeId lambda : lambdas) cost += expressions_.unit().facts_of(lambda).cost;
    return cost <= cost_without_jumps && std::ranges::all_of(lambdas, [&](ir::NodeId lambda) {
               const ir::Facts& facts = expressions_.unit().facts_of(lambda);
               return ir::is_droppable(facts) && !facts.elementary;
           });
}

// Behind what stands in the current line, or in lines of its own.
void FunctionBody::add_lambda(std::string& current, ir::NodeId body, const std::string& tail) {
    const std::optional<std::string> result = short_result(body);
    const std::string whole = result ? "[&] { return " + *result + "; }" + tail : "";
    // Of several lambdas, clang-format breaks one that has a braced list inside.
    const bool stays_whole =
        !whole.empty() && whole.find(", {") == std::string::npos && fits(whole.size());
    const bool has_room = fits(current.size() + 1 + whole.size());
    if (stays_whole && has_room && !current.starts_with('}')) {
        current += " " + whole;
        return;
    }
    line(current);
    current = whole;
    if (stays_whole) return;
    line("[&] {");
    write_lambda_body(body);
    current = "}" + tail;
}

// Too many weights for one line are set one by one.
void FunctionBody::write_discrete(const std::string& lead, const ir::Discrete& discrete) {
    const std::string name = expressions_.claim("weights");
    line("std::array<" + expressions_.type(ir::Scalar::Real) + ", " +
         std::to_string(discrete.weights.size()) + "> " + name + ";");
    for (std::size_t k = 0; k < discrete.weights.size(); ++k) {
        const std::string element = name + "[" + std::to_string(k) + "] = ";
        write(element, discrete.weights[k]);
    }
    line(lead + expressions_.discrete_call(discrete, name) + ";");
}

void FunctionBody::write_lambda_body(ir::NodeId body) {
    const auto before = expressions_.mark();
    ++level_;
    value("return ", body);
    --level_;
    expressions_.return_to(before);
}

// ------------------------------------------------------------------------------ questions

bool FunctionBody::fits(std::size_t length, int levels_deeper) const {
    return static_cast<std::size_t>((level_ + levels_deeper) * indentation) + length <= line_width;
}

bool FunctionBody::fits_as_chain(const std::string& lead, ir::NodeId id) {
    const std::vector<ir::NodeId> parts = chain_parts(id);
    if (parts.size() < 2) return false;
    const bool assigns = lead.ends_with("= ");
    // Of two operands, clang-format likes to break the second inside.
    if (assigns && parts.size() == 2 &&
        !fits(lead.size() + std::max(length_within(parts[0], line_width) + 2,
                                     length_within(parts[1], line_width) + 1))) {
        return false;
    }
    const std::size_t column = assigns ? indentation : lead.size();
    const std::string_view operator_and_brackets = "() &&";
    return std::ranges::all_of(parts, [&](ir::NodeId part) {
        const std::optional<std::string> text = expressions_.text_within(part, longest_operand);
        return text && text->find("[&]") == std::string::npos &&
               fits(column + text->size() + operator_and_brackets.size());
    });
}

// One more than `most` if it is longer.
std::size_t FunctionBody::length_within(ir::NodeId id, std::size_t most) {
    const std::optional<std::string> text = expressions_.text_within(id, most);
    return text ? text->size() : most + 1;
}

// What a lambda may return on one line.
std::optional<std::string> FunctionBody::short_result(ir::NodeId body) {
    return is_block(body) ? std::nullopt : expressions_.result_within(body, line_width);
}

bool FunctionBody::is_block(ir::NodeId id) const {
    if (expressions_.is_named(id) || !expressions_.unit().contains_branch[id.index]) return false;
    if (lazy_select(id)) return true;
    const auto operands = ir::operands_of(program()[id]);
    return std::ranges::any_of(operands, [&](ir::NodeId operand) { return is_block(operand); });
}

const ir::Select* FunctionBody::lazy_select(ir::NodeId id) const {
    if (expressions_.is_named(id)) return nullptr;
    const auto* select = std::get_if<ir::Select>(&program()[id].form);
    return select && expressions_.unit().is_lazy(*select) ? select : nullptr;
}

// a + b - c -> a, b, c
std::vector<ir::NodeId> FunctionBody::chain_parts(ir::NodeId id) const {
    const auto operators = chain_operators(program()[id]);
    if (operators.empty() || expressions_.is_named(id)) return {id};
    const auto& operands = std::get<ir::Apply>(program()[id].form).operands;
    std::vector<ir::NodeId> parts;
    if (chain_operators(program()[operands[0]]) == operators) {
        parts = chain_parts(operands[0]);
    } else {
        parts = {operands[0]};
    }
    parts.push_back(operands[1]);
    return parts;
}

// What is evaluated whenever `id` is, before it.
std::vector<ir::NodeId> FunctionBody::eager_parts(ir::NodeId id) const {
    if (expressions_.is_named(id) || is_binder(program()[id])) return {};
    if (const ir::Select* select = lazy_select(id)) return {select->condition};
    return ir::operands_of(program()[id]);
}

// Calls with lambdas inside of it first, since they take many lines, unless there are too many;
// else its operands.
std::vector<ir::NodeId> FunctionBody::nameable_parts(ir::NodeId id) const {
    std::vector<ir::NodeId> parts;
    for (ir::NodeId part : eager_parts(id)) collect_lambda_calls(part, parts);
    if (parts.empty() || parts.size() > most_lambda_calls) parts = chain_parts(id);
    const bool is_itself = parts.size() == 1 && parts.front() == id;
    return is_itself ? eager_parts(id) : parts;
}

// The outermost ones, and no more than it takes to see that there are too many.
void FunctionBody::collect_lambda_calls(ir::NodeId id, std::vector<ir::NodeId>& calls) const {
    if (expressions_.is_named(id) || calls.size() > most_lambda_calls) return;
    if (is_binder(program()[id])) {
        calls.push_back(id);
        return;
    }
    for (ir::NodeId part : eager_parts(id)) collect_lambda_calls(part, calls);
}

void FunctionBody::line(const std::string& text) {
    lines_.push_back(std::string(static_cast<std::size_t>(level_ * indentation), ' ') + text);
}

}  // namespace rddlc::cpp
