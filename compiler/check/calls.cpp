// Functions f[...] and distributions with plain parameters.
#include "check/expressions.hpp"
#include "check/types.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace rddlc::checking {
namespace {

std::vector<Typed> check_all(const std::vector<ast::Expr>& expressions, Scope& scope) {
    std::vector<Typed> results;
    for (const ast::Expr& expression : expressions)
        results.push_back(check_expression(expression, scope));
    return results;
}

std::string argument_of(std::size_t index, std::size_t count, std::string_view name) {
    if (count == 1) return fmt::format("the argument of '{}'", name);
    return fmt::format("argument {} of '{}'", index + 1, name);
}

// ------------------------------------------------------------------------------ functions

// Names that other languages use, and what to write instead.
struct Substitute {
    std::string_view name, hint;
    std::string_view instead = {};  // a function with the same arguments
};
constexpr std::array substitutes = {
    Substitute{"atan2", "use 'atan[y / x]' and distinguish the quadrants; --std=rddlc allows it"},
    Substitute{"sign", "the sign is 'sgn[x]'", "sgn"},
    Substitute{"ceiling", "write 'ceil[x]'", "ceil"},
    Substitute{"trunc", "write 'sgn[x] * floor[abs[x]]'"},
    Substitute{"clip", "write 'min[max[x, low], high]'"},
    Substitute{"power", "write 'pow[x, y]'", "pow"},
    Substitute{"logarithm", "write 'ln[x]' or 'log[x, base]'"},
    Substitute{"log10", "write 'log[x, 10]'"},
    Substitute{"log2", "write 'log[x, 2]'"},
};

Hint hint_for(const Substitute& substitute, Span place) {
    if (substitute.instead.empty()) return std::string(substitute.hint);
    return {std::string(substitute.hint), {{place, std::string(substitute.instead)}}};
}

Hint hint_for_unknown(const ast::Name& function, Span whole, const Context& context) {
    const std::string& name = function.text;
    for (const Substitute& substitute : substitutes)
        if (substitute.name == name) return hint_for(substitute, function.span);
    if (reduction_named(name))
        return fmt::format("an aggregation is written '{}_{{?x : type}} ...'", name);
    if (context.names.fluents.contains(name))
        return {fmt::format("the fluent's arguments take round brackets: '{}(...)'", name),
                other_brackets(function.span, whole, "()", context)};
    return suggestion(context, name, function.span, [&] {
        std::vector<std::string> names = function_names();
        std::erase_if(names, [&](const std::string& known) {
            return context.standard == Standard::PyRddlGym && is_extension(*function_named(known));
        });
        return names;
    });
}

std::string hint_for_arity(Operator op, std::size_t found) {
    if (op == Operator::Log && found == 1)
        return "the natural logarithm is 'ln[x]'; 'log[x, base]' has a base";
    if ((op == Operator::Minimum || op == Operator::Maximum) && found > 2) {
        const std::string_view name = source_name_of(op);
        return fmt::format(
            "nest it: '{0}[a, {0}[b, c]]'; over objects it is '{0}_{{?x : type}} ...'", name);
    }
    return fmt::format("write '{}'", form_of(op));
}

bool check_call_arity(std::string_view name, std::size_t expected, const ast::Name& written,
                      std::size_t found, std::string hint, Context& context) {
    if (expected == found) return true;
    context.report(
        diagnose(wrong_call_arity, written.span,
                 fmt::format("'{}' takes {}, found {}", name, counted(expected, "argument"), found))
            .with_hint(std::move(hint)));
    return false;
}

// The common type of the operands.
model::ValueType operand_type(Operator op, const std::vector<Typed>& operands) {
    if (typing_of(op) == Typing::Ints) return model::int_type;
    if (typing_of(op) == Typing::Reals && !on_ints(op)) return model::real_type;
    model::ValueType type = model::int_type;
    for (const Typed& operand : operands) type = promoted(type, operand->type);
    return type;
}

model::ValueType result_type(Operator op, model::ValueType operand) {
    return is_one_of(typing_of(op), {Typing::Sign, Typing::Rounding}) ? model::int_type : operand;
}

// Each operand a number, for div and mod an int.
bool check_operands(Operator op, std::vector<Typed>& operands, Scope& scope) {
    bool sound = true;
    for (std::size_t i = 0; i < operands.size(); ++i) {
        const std::string what = argument_of(i, operands.size(), source_name_of(op));
        operands[i] = require_number(std::move(operands[i]), what, scope);
        if (typing_of(op) == Typing::Ints)
            operands[i] = require_int(std::move(operands[i]), what, scope);
        sound = sound && operands[i].has_value();
    }
    return sound;
}

Typed check_function(Operator op, std::vector<Typed> operands, Span span, Scope& scope) {
    if (!check_operands(op, operands, scope)) return std::nullopt;
    const model::ValueType type = operand_type(op, operands);
    if (typing_of(op) == Typing::Rounding && type == model::int_type)
        return convert(std::move(*operands[0]), type);
    if (type == model::int_type) op = on_ints(op).value_or(op);
    model::Apply node{op, {}};
    for (Typed& operand : operands) node.operands.push_back(convert(std::move(*operand), type));
    return model::Expr{result_type(op, type), span, std::move(node)};
}

// -------------------------------------------------------------------------- distributions

model::ValueType sample_type(Distribution distribution) {
    switch (drawn_by(distribution)) {
        case Drawn::Bool:
            return model::bool_type;
        case Drawn::Int:
            return model::int_type;
        case Drawn::Real:
        case Drawn::AsGiven:
            break;
    }
    return model::real_type;
}

// KronDelta takes bools and ints, DiracDelta any number; both give what they take.
Typed check_delta(Distribution distribution, Typed value, Span span, Scope& scope) {
    const std::string what = argument_of(0, 1, name_of(distribution));
    if (value && is_object(value->type)) {
        const Context& context = scope.context;
        scope.context.report(
            diagnose(number_needed, value->span,
                     fmt::format("{} must be a number or a bool, found {}", what,
                                 describe(context, value->type)))
                .with_hint(fmt::format("leave out '{}': write '{}' alone, which is as certain",
                                       name_of(distribution),
                                       context.sources.text_on_one_line(value->span))));
        return std::nullopt;
    }
    value = require_number(std::move(value), what, scope);
    if (value && distribution == Distribution::KronDelta && value->type == model::real_type)
        value = require_int(std::move(value), what, scope);
    if (!value) return std::nullopt;
    const model::ValueType type = value->type;
    return model::Expr{type, span, model::Sample{distribution, {std::move(*value)}}};
}

Typed check_sample(Distribution distribution, std::vector<Typed> parameters, Span span,
                   Scope& scope) {
    scope.draws.push_back(span);
    model::Sample node{distribution, {}};
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const std::string what = argument_of(i, parameters.size(), name_of(distribution));
        Typed parameter = require_number(std::move(parameters[i]), what, scope);
        parameter = takes_int(distribution, i) ? require_int(std::move(parameter), what, scope)
                                               : require_real(std::move(parameter), what, scope);
        if (parameter) node.parameters.push_back(std::move(*parameter));
    }
    if (node.parameters.size() < parameters.size()) return std::nullopt;
    return model::Expr{sample_type(distribution), span, std::move(node)};
}

}  // namespace

Typed check_call(const ast::Call& call, Span span, Scope& scope) {
    std::vector<Typed> arguments = check_all(call.arguments, scope);
    const std::string& name = call.function.text;
    const std::optional<Operator> op = function_named(name);
    const bool is_known = op && (!is_extension(*op) || scope.context.standard == Standard::Rddlc);
    if (!is_known) {
        scope.context.report(diagnose(unknown_function, call.function.span,
                                      fmt::format("there is no function '{}'", name))
                                 .with_hint(hint_for_unknown(call.function, span, scope.context)));
        return std::nullopt;
    }
    if (!check_call_arity(name, arity_of(*op), call.function, arguments.size(),
                          hint_for_arity(*op, arguments.size()), scope.context))
        return std::nullopt;
    return check_function(*op, std::move(arguments), span, scope);
}

Typed check_distribution(const ast::Distribution& call, Span span, Scope& scope) {
    std::vector<Typed> parameters = check_all(call.arguments, scope);
    const std::string& name = call.name.text;
    const std::optional<Distribution> distribution = distribution_named(name);
    if (!distribution) {
        scope.context.report(diagnose(unknown_function, call.name.span,
                                      fmt::format("'{}' cannot be used like this", name))
                                 .with_hint("random vectors are written 'NAME[?x](...)', discrete "
                                            "distributions 'Discrete(type, @a : p, ...)'"));
        return std::nullopt;
    }
    if (!check_call_arity(name, arity_of(*distribution), call.name, parameters.size(),
                          fmt::format("write '{}'", form_of(*distribution)), scope.context))
        return std::nullopt;
    if (is_delta(*distribution))
        return check_delta(*distribution, std::move(parameters[0]), span, scope);
    return check_sample(*distribution, std::move(parameters), span, scope);
}

}  // namespace rddlc::checking
