// Whole vectors and matrices: matrix functions, external functions, random vectors.
#include "check/expressions.hpp"
#include "check/names.hpp"
#include "check/types.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rddlc::checking {
namespace {

using model::VariableId;

// ------------------------------------------------------------------------ vector references

struct Vector {
    model::VectorReference reference;
    std::vector<model::TypeId> axes;  // the type of each underscore
    model::ValueType range;
};

std::optional<model::Slot> check_slot(const ast::Slot& slot, model::TypeId expected,
                                      const std::string& what, Scope& scope) {
    Context& context = scope.context;
    const auto fits = [&](model::TypeId found, std::string_view name) {
        if (found == expected) return true;
        context.report(
            {wrong_argument_type, slot.name.span,
             fmt::format("{} must be an object of type '{}', but '{}' is of type '{}'", what,
                         context.type(expected).name, name, context.type(found).name)});
        return false;
    };
    switch (slot.kind) {
        case ast::Slot::Kind::Underscore:
            return model::Slot{model::Axis{}};
        case ast::Slot::Kind::Variable: {
            const auto id = resolve_variable(slot.name.text, slot.name.span, scope);
            if (!id || !fits(context.model.variables[*id].type, "?" + slot.name.text))
                return std::nullopt;
            return model::Slot{*id};
        }
        case ast::Slot::Kind::Literal:
            break;
    }
    const Typed literal = check_literal({slot.name.text}, slot.name.span, scope);
    if (!literal || !fits(literal->type.type, "@" + slot.name.text)) return std::nullopt;
    return model::Slot{std::get<std::int64_t>(std::get<model::Constant>(literal->node).value)};
}

// The reference as if it were written with plain arguments, for the checks they share.
ast::Reference as_reference(const ast::VectorReference& vector) {
    ast::Reference reference{vector.name, false, {}};
    if (!reference.name.text.empty() && reference.name.text.back() == '\'') {
        reference.name.text.pop_back();
        reference.primed = true;
    }
    return reference;
}

std::optional<Vector> check_vector(const ast::VectorReference& written, Scope& scope) {
    Context& context = scope.context;
    const ast::Reference plain = as_reference(written);
    const auto fluent = check_fluent(plain, written.slots.size(), written.span, scope);
    if (!fluent) return std::nullopt;
    Vector vector{{*fluent, plain.primed, {}}, {}, context.fluent(*fluent).range};
    for (std::size_t i = 0; i < written.slots.size(); ++i) {
        const model::TypeId expected = context.fluent(*fluent).parameters[i];
        const auto slot =
            check_slot(written.slots[i], expected,
                       fmt::format("argument {} of '{}'", i + 1, plain.name.text), scope);
        if (!slot) return std::nullopt;
        if (std::holds_alternative<model::Axis>(*slot)) vector.axes.push_back(expected);
        vector.reference.slots.push_back(*slot);
    }
    if (!is_object(vector.range)) return vector;
    context.report({number_needed, written.span,
                    fmt::format("'{}' holds objects, where numbers are needed", plain.name.text)});
    return std::nullopt;
}

// A captured variable must not be an argument as well.
bool check_not_captured(const Vector& vector, const ast::VectorReference& written,
                        const std::vector<VariableId>& captured, std::string_view what,
                        Context& context) {
    for (std::size_t i = 0; i < vector.reference.slots.size(); ++i) {
        const auto* variable = std::get_if<VariableId>(&vector.reference.slots[i]);
        if (!variable || std::ranges::find(captured, *variable) == captured.end()) continue;
        context.report(diagnose(bad_vector, written.slots[i].name.span,
                                fmt::format("'?{}' is what '{}' ranges over; it cannot be an "
                                            "argument too",
                                            written.slots[i].name.text, what))
                           .with_hint("write '_' for the axis"));
        return false;
    }
    return true;
}

// ------------------------------------------------------------------------- random vectors

struct VectorRow {
    std::string_view name;
    VectorDistribution distribution;
    std::vector<std::size_t> axes;  // underscores in each argument
};

const VectorRow* vector_row(std::string_view name) {
    static const std::array rows = {
        VectorRow{"MultivariateNormal", VectorDistribution::MultivariateNormal, {1, 2}},
        VectorRow{"MultivariateStudent", VectorDistribution::MultivariateStudent, {1, 2, 0}},
        VectorRow{"Dirichlet", VectorDistribution::Dirichlet, {1}},
        VectorRow{"Multinomial", VectorDistribution::Multinomial, {0, 1}},
    };
    const auto found = std::ranges::find(rows, name, &VectorRow::name);
    return found == rows.end() ? nullptr : &*found;
}

std::optional<VariableId> check_axis(const ast::RandomVector& vector, Scope& scope) {
    if (vector.axis.kind == ast::Slot::Kind::Variable)
        return resolve_variable(vector.axis.name.text, vector.axis.name.span, scope);
    scope.context.report({bad_vector, vector.name.span,
                          fmt::format("'{}' ranges over a parameter of the CPF: '{}[?x](...)'",
                                      vector.name.text, vector.name.text)});
    return std::nullopt;
}

bool check_axes(const Vector& vector, const ast::VectorReference& written, std::size_t expected,
                VariableId axis, std::string_view name, Context& context) {
    if (vector.axes.size() != expected) {
        context.report({bad_vector, written.span,
                        fmt::format("this argument of '{}' needs {}, found {}", name,
                                    counted(expected, "'_'"), vector.axes.size())});
        return false;
    }
    const model::TypeId type = context.model.variables[axis].type;
    for (const model::TypeId found : vector.axes) {
        if (found == type) continue;
        context.report(
            {bad_vector, written.span,
             fmt::format("'_' ranges over '{}' here, but '?{}' over '{}'", context.type(found).name,
                         context.model.variables[axis].name, context.type(type).name)});
        return false;
    }
    return true;
}

bool check_trials(const Vector& trials, const ast::VectorReference& written, Context& context) {
    if (trials.range != model::real_type) return true;
    context.report({int_needed, written.span,
                    "the number of trials of 'Multinomial' must be int, found real"});
    return false;
}

// ------------------------------------------------------------------------ matrix functions

std::optional<MatrixOperator> matrix_operator(std::string_view name) {
    if (name == "inverse") return MatrixOperator::Inverse;
    if (name == "pinverse") return MatrixOperator::PseudoInverse;
    if (name == "cholesky") return MatrixOperator::Cholesky;
    return std::nullopt;
}

}  // namespace

bool check_square(std::string_view function, VariableId row, VariableId column, Span span,
                  Context& context) {
    const auto type_of = [&](VariableId id) -> const model::Type& {
        return context.model.type_of(context.model.variables[id]);
    };
    const auto is_open = [&](VariableId id) {
        return context.names.open_types.contains(context.model.variables[id].type);
    };
    if (is_open(row) || is_open(column)) return true;
    const model::Type& rows = type_of(row);
    const model::Type& columns = type_of(column);
    if (rows.objects.size() == columns.objects.size()) return true;
    context.report({bad_matrix, span,
                    fmt::format("'{}' needs a square matrix, but '{}' has {} and '{}' {}", function,
                                rows.name, counted(rows.objects.size(), "object"), columns.name,
                                columns.objects.size())});
    return false;
}

Typed check_matrix_function(const ast::MatrixFunction& function, Span span, Scope& scope) {
    Context& context = scope.context;
    const std::string& name = function.name.text;
    const auto op = matrix_operator(name);
    const auto row = resolve_variable(function.row.text, function.row.span, scope);
    const auto column = resolve_variable(function.column.text, function.column.span, scope);
    Typed element = require_real(check_expression(*function.element, scope),
                                 fmt::format("the matrix of '{}'", name), scope);
    if (!op || !row || !column || !element) return std::nullopt;
    if (*row == *column) {
        context.report({bad_matrix, function.column.span,
                        fmt::format("row and column of '{}' must be different variables", name)});
        return std::nullopt;
    }
    if (!check_square(name, *row, *column, span, context)) return std::nullopt;
    return model::Expr{model::real_type, span,
                       model::MatrixFunction{*op, *row, *column, std::move(*element)}};
}

Typed check_external(const ast::External& external, Span span, Scope& scope) {
    Context& context = scope.context;
    const std::string& name = external.function.text;
    model::External node{name, {}, {}};
    bool sound = true;
    for (const ast::Slot& slot : external.captured) {
        std::optional<VariableId> id;
        if (slot.kind == ast::Slot::Kind::Variable)
            id = resolve_variable(slot.name.text, slot.name.span, scope);
        else
            context.report({bad_vector, external.function.span,
                            fmt::format("the square brackets of '${}' take variables only", name)});
        sound = sound && id.has_value();
        if (!id) continue;
        if (std::ranges::find(node.captured, *id) != node.captured.end()) {
            context.report({repeated_variable, slot.name.span,
                            fmt::format("'?{}' occurs twice", slot.name.text)});
            sound = false;
        }
        node.captured.push_back(*id);
    }
    for (const ast::VectorReference& argument : external.arguments) {
        const auto vector = check_vector(argument, scope);
        sound = sound && vector &&
                check_not_captured(*vector, argument, node.captured, "$" + name, context);
        if (vector) node.arguments.push_back(vector->reference);
    }
    if (!sound) return std::nullopt;
    // The type of its result is known when it is called; casts.cpp lets it stand for any number.
    return model::Expr{model::real_type, span, std::move(node)};
}

Typed check_random_vector(const ast::RandomVector& vector, Span span, Scope& scope) {
    Context& context = scope.context;
    const std::string& name = vector.name.text;
    const VectorRow* row = vector_row(name);
    const auto axis = check_axis(vector, scope);
    if (row && row->axes.size() != vector.arguments.size()) {
        context.report(
            {wrong_call_arity, vector.name.span,
             fmt::format("'{}' takes {}, found {}", name, counted(row->axes.size(), "argument"),
                         vector.arguments.size())});
        return std::nullopt;
    }
    if (!row) return std::nullopt;
    const bool counts = row->distribution == VectorDistribution::Multinomial;
    model::RandomVector node{row->distribution, axis.value_or(0), {}};
    for (std::size_t i = 0; i < vector.arguments.size(); ++i) {
        const ast::VectorReference& written = vector.arguments[i];
        const auto argument = check_vector(written, scope);
        if (!argument || !axis) continue;
        const bool fits = check_not_captured(*argument, written, {*axis}, name, context) &&
                          check_axes(*argument, written, row->axes[i], *axis, name, context) &&
                          (!counts || i != 0 || check_trials(*argument, written, context));
        if (fits) node.arguments.push_back(argument->reference);
    }
    if (!axis || node.arguments.size() < vector.arguments.size()) return std::nullopt;
    return model::Expr{counts ? model::int_type : model::real_type, span, std::move(node)};
}

}  // namespace rddlc::checking
