// Matrix functions, random vectors and external functions: tables that are filled before the value
// is used.
//
//     for r                                              for k
//         for c                                              fill draw[k] = sample dirichlet(A[k])
//             matrix[r, c] = ...
//     fill inverse = inverse(matrix)
//
// The value is then a load. A table has a dimension for each variable in scope that it depends on.
#include "ground/codes.hpp"
#include "ground/lowering.hpp"
#include "ir/call.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rddlc::grounding {
namespace {

constexpr double most_elements = 1 << 27;  // 1 GB of reals

using Variables = std::vector<ir::VariableId>;

Variables without(const Variables& variables, std::initializer_list<ir::VariableId> dropped) {
    Variables kept;
    for (ir::VariableId variable : variables) {
        if (std::ranges::find(dropped, variable) == dropped.end()) kept.push_back(variable);
    }
    return kept;
}

Variables joined(Variables variables, std::initializer_list<ir::VariableId> more) {
    variables.insert(variables.end(), more.begin(), more.end());
    return variables;
}

std::string problem_with(MatrixOperator op) {
    switch (op) {
        case MatrixOperator::Determinant:
            break;
        case MatrixOperator::Inverse:
            return "the matrix of 'inverse' is singular, or has elements that are not numbers";
        case MatrixOperator::PseudoInverse:
            return "the matrix of 'pinverse' has elements that are not numbers";
        case MatrixOperator::Cholesky:
            return "the matrix of 'cholesky' is not positive definite";
    }
    return {};
}

}  // namespace

// ------------------------------------------------------------------------------------- tables

// Runs the statement before the next ones: they may read the values that have been lowered so far.
void Lowering::run_before(ir::Statement statement, std::span<const ir::VariableId> variables) {
    prelude_.push_back(looped(std::move(statement), variables));
}

ir::BufferId Lowering::new_table(std::string_view name, ir::Scalar scalar,
                                 std::span<const ir::VariableId> dimensions,
                                 const model::Expr& expr) {
    ir::Buffer buffer{.name = builder_.tables().unused_name(std::string(name), "_"),
                      .storage = ir::Storage::Scratch,
                      .scalar = scalar,
                      .span = expr.span};
    double count = 1;
    for (ir::VariableId variable : dimensions) {
        buffer.shape.push_back(program_[variable].size);
        buffer.types.push_back(*program_[variable].type);
        count *= static_cast<double>(program_[variable].size);
    }
    if (count > most_elements) {
        diagnostics_.report({too_many_groundings, expr.span,
                             fmt::format("this needs a table of {:.0f} numbers, more than {:.0f}",
                                         count, most_elements)});
    }
    return builder_.tables().add(std::move(buffer));
}

std::vector<ir::NodeId> Lowering::indices_of(std::span<const ir::VariableId> variables) {
    std::vector<ir::NodeId> indices;
    for (ir::VariableId variable : variables) indices.push_back(builder_.index(variable));
    return indices;
}

// A table of the value, for all the variables.
ir::BufferId Lowering::filled_table(std::string_view name, ir::NodeId value,
                                    std::span<const ir::VariableId> variables,
                                    const model::Expr& expr) {
    const ir::BufferId table = new_table(name, program_[value].type, variables, expr);
    run_before({ir::Store{table, indices_of(variables), value}}, variables);
    return table;
}

// ---------------------------------------------------------------------------- matrix functions

ir::NodeId Lowering::lower(const model::Determinant& form, const model::Expr& expr) {
    const ir::VariableId row = variable_of(form.row);
    const ir::VariableId column = variable_of(form.column);
    enter(std::array{form.row, form.column});
    const ir::NodeId element = lower_as(*form.element, ir::Scalar::Real);
    leave(2);
    const Variables outer = variables_in({element}, without(scope_, {row, column}));
    const ir::BufferId result = new_table("determinant", ir::Scalar::Real, outer, expr);
    call_matrix_operator(MatrixOperator::Determinant, {element, row, column, outer}, result, expr);
    return builder_.load(result, indices_of(outer));
}

ir::NodeId Lowering::lower(const model::MatrixFunction& form, const model::Expr& expr) {
    const ir::VariableId row = variable_of(form.row);
    const ir::VariableId column = variable_of(form.column);
    const ir::NodeId element = lower_as(*form.element, ir::Scalar::Real);
    const Variables outer = variables_in({element}, without(scope_, {row, column}));
    const Variables dimensions = joined(outer, {row, column});
    const ir::BufferId result = new_table(name_of(form.op), ir::Scalar::Real, dimensions, expr);
    call_matrix_operator(form.op, {element, row, column, outer}, result, expr);
    const ir::NodeId value = builder_.load(result, indices_of(dimensions));
    return builder_.apply(Operator::Defined, {value},
                          new_place(expr, problem_with(form.op), without(scope_, {row, column})));
}

void Lowering::call_matrix_operator(MatrixOperator op, const Matrix& matrix, ir::BufferId result,
                                    const model::Expr& expr) {
    const Variables dimensions = joined(matrix.outer, {matrix.row, matrix.column});
    const std::vector<ir::NodeId> outer = indices_of(matrix.outer);
    ir::Call call{.callee = op,
                  .inputs = {{filled_table("matrix", matrix.element, dimensions, expr), outer}},
                  .scalars = {},
                  .output = {result, outer},
                  .place = {}};
    if (op == MatrixOperator::PseudoInverse) {
        const Variables square = {matrix.column, matrix.column};
        call.inputs.push_back({new_table("rotation", ir::Scalar::Real, square, expr), {}});
    }
    run_before({std::move(call)}, matrix.outer);
}

// The candidates on which any of the nodes depends.
std::vector<ir::VariableId> Lowering::variables_in(const std::vector<ir::NodeId>& nodes,
                                                   const Variables& candidates) const {
    Variables used;
    for (ir::VariableId variable : candidates) {
        const auto depends = [&](ir::NodeId node) {
            return ir::depends_on(builder_.properties(node), variable);
        };
        if (std::ranges::any_of(nodes, depends)) used.push_back(variable);
    }
    return used;
}

// ------------------------------------------------------------------------------ random vectors

ir::NodeId Lowering::lower(const model::RandomVector& form, const model::Expr& expr) {
    const ir::VariableId axis = variable_of(form.axis);
    const Variables batch = without(scope_, {axis});
    const ir::CallSignature signature = ir::signature_of(form.distribution);
    const Variables dimensions = joined(batch, {axis});
    const ir::BufferId draw = new_table("draw", signature.output, dimensions, expr);
    ir::Call call{.callee = form.distribution,
                  .inputs = {},
                  .scalars = {},
                  .output = {draw, indices_of(batch)},
                  .place = new_place(expr, std::string(name_of(form.distribution)), batch)};
    for (const model::VectorReference& argument : form.arguments) {
        const auto axes = std::ranges::count_if(argument.slots, [](const model::Slot& slot) {
            return std::holds_alternative<model::Axis>(slot);
        });
        if (axes == 0) {
            call.scalars.push_back(builder_.convert(element_of(argument, {}), *signature.scalar));
        } else if (axes == 1) {
            call.inputs.push_back(vector_of(argument, axis, expr));
        } else {
            call.inputs.push_back(factor_of(argument, axis, expr));
        }
    }
    run_before({std::move(call)}, batch);
    return builder_.load(draw, indices_of(dimensions));
}

ir::BufferId Lowering::buffer_of(const model::VectorReference& reference) const {
    const FluentBuffers& buffers = buffers_[reference.fluent];
    return reference.next ? *buffers.next : buffers.current;
}

// The indices with the variables in place of the axes, in their order.
std::vector<ir::NodeId> Lowering::indices_of(const model::VectorReference& reference,
                                             const Variables& axes) {
    auto axis = axes.begin();
    std::vector<ir::NodeId> indices;
    for (const model::Slot& slot : reference.slots) {
        indices.push_back(match(
            slot, [&](const model::Axis&) { return builder_.index(*axis++); },
            [&](model::VariableId variable) { return builder_.index(variable_of(variable)); },
            [&](std::int64_t object) { return integer(object); }));
    }
    return indices;
}

ir::NodeId Lowering::element_of(const model::VectorReference& reference, const Variables& axes) {
    return builder_.load(buffer_of(reference), indices_of(reference, axes));
}

// The fluent itself if it is a table of that type whose last dimensions are the axes; else a copy.
ir::TableView Lowering::view_of(const model::VectorReference& reference, const Variables& axes,
                                ir::Scalar scalar, std::string_view name, const model::Expr& expr) {
    const auto leading = static_cast<std::ptrdiff_t>(reference.slots.size() - axes.size());
    const bool axes_are_last = std::all_of(
        reference.slots.begin() + leading, reference.slots.end(),
        [](const model::Slot& slot) { return std::holds_alternative<model::Axis>(slot); });
    if (axes_are_last && program_[buffer_of(reference)].scalar == scalar) {
        std::vector<ir::NodeId> indices = indices_of(reference, axes);
        indices.resize(static_cast<std::size_t>(leading));
        return {buffer_of(reference), std::move(indices)};
    }
    const ir::NodeId element = element_of(reference, axes);
    const Variables outer = variables_in({element}, without(scope_, {axes.front()}));
    Variables dimensions = outer;
    dimensions.insert(dimensions.end(), axes.begin(), axes.end());
    const ir::NodeId value = builder_.convert(element, scalar);
    return {filled_table(name, value, dimensions, expr), indices_of(outer)};
}

ir::TableView Lowering::vector_of(const model::VectorReference& reference, ir::VariableId axis,
                                  const model::Expr& expr) {
    return view_of(reference, {axis}, ir::Scalar::Real, "vector", expr);
}

// The Cholesky factor of a covariance, computed once for all draws that share it.
ir::TableView Lowering::factor_of(const model::VectorReference& reference, ir::VariableId axis,
                                  const model::Expr& expr) {
    const ir::VariableId column{static_cast<std::uint32_t>(program_.variables.size())};
    ir::Variable other = program_[axis];
    other.name += "2";
    program_.variables.push_back(std::move(other));
    ir::TableView covariance =
        view_of(reference, {axis, column}, ir::Scalar::Real, "covariance", expr);
    const Variables outer = variables_in(covariance.indices, without(scope_, {axis}));
    const ir::TableView factor{
        new_table("factor", ir::Scalar::Real, joined(outer, {axis, axis}), expr),
        indices_of(outer)};
    ir::Call call{.callee = MatrixOperator::Cholesky,
                  .inputs = {std::move(covariance)},
                  .scalars = {},
                  .output = factor,
                  .place = {}};
    run_before({std::move(call)}, outer);
    return factor;
}

// -------------------------------------------------------------------------- external functions

// One call for each combination of the variables that the arguments depend on: the result is the
// same for all values of the others.
ir::NodeId Lowering::lower(const model::External& form, const model::Expr& expr) {
    ir::Call call{.callee = external_named(form.function, expr.span),
                  .inputs = {},
                  .scalars = {},
                  .output = {},
                  .place = {}};
    std::vector<ir::NodeId> indices;
    for (const model::VectorReference& argument : form.arguments) {
        call.inputs.push_back(argument_of(argument, expr));
        const std::vector<ir::NodeId>& more = call.inputs.back().indices;
        indices.insert(indices.end(), more.begin(), more.end());
    }
    const Variables outer = variables_in(indices, scope_);
    Variables dimensions = outer;
    for (model::VariableId captured : form.captured) dimensions.push_back(variable_of(captured));
    const ir::BufferId result = new_table(form.function, scalar_of(expr.type), dimensions, expr);
    call.output = {result, indices_of(outer)};
    run_before({std::move(call)}, outer);
    return builder_.load(result, indices_of(dimensions));
}

// The argument keeps the fluent's own type.
ir::TableView Lowering::argument_of(const model::VectorReference& reference,
                                    const model::Expr& expr) {
    Variables axes;
    for (std::size_t i = 0; i < reference.slots.size(); ++i) {
        if (!std::holds_alternative<model::Axis>(reference.slots[i])) continue;
        const model::TypeId type = model_.fluents[reference.fluent].parameters[i];
        axes.push_back(axis_variable(type, axes.size()));
    }
    return view_of(reference, axes, program_[buffer_of(reference)].scalar, "argument", expr);
}

// A variable for an underscore; no name of RDDL is a number.
ir::VariableId Lowering::axis_variable(model::TypeId type, std::size_t position) {
    const ir::VariableId next{static_cast<std::uint32_t>(program_.variables.size())};
    const auto [entry, is_new] = variables_.try_emplace({std::to_string(position), type}, next);
    const auto size = static_cast<std::int64_t>(model_.types[type].objects.size());
    if (is_new) program_.variables.push_back({fmt::format("axis{}", position + 1), type, size});
    return entry->second;
}

ir::ExternalId Lowering::external_named(const std::string& name, Span span) {
    const auto found = std::ranges::find(program_.externals, name, &ir::External::name);
    const auto index = static_cast<std::uint32_t>(found - program_.externals.begin());
    if (found == program_.externals.end()) program_.externals.push_back({name, span});
    return {index};
}

}  // namespace rddlc::grounding
