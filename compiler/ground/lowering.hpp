// Model expressions -> IR nodes, one CPF or condition at a time.
#pragma once

#include "ground/declare.hpp"
#include "ir/builder.hpp"
#include "ir/ir.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rddlc::grounding {

class Lowering {
  public:
    // All must outlive it. Variables and sites are added to the program, nodes through the builder.
    Lowering(const model::Model& model, const std::vector<FluentBuffers>& buffers,
             ir::Program& program, ir::Builder& builder, Diagnostics& diagnostics);

    ir::Definition definition_of(const model::Cpf& cpf);
    ir::Definition definition_of(const model::InitialDraw& draw);
    // The value of an expression outside of any CPF: reward and conditions.
    ir::Computation value_of(const model::Expr& expr);

    // Brings variables into scope, outermost first; the innermost ones leave it again.
    void enter(std::span<const model::VariableId> variables);
    void leave(std::size_t count);
    ir::VariableId variable_of(model::VariableId id);

    ir::NodeId lower(const model::Expr& expr);

  private:
    ir::NodeId lower(const model::Constant& form, const model::Expr& expr);
    ir::NodeId lower(const model::VariableValue& form, const model::Expr& expr);
    ir::NodeId lower(const model::Reference& form, const model::Expr& expr);
    ir::NodeId lower(const model::Convert& form, const model::Expr& expr);
    ir::NodeId lower(const model::TypeFault& form, const model::Expr& expr);
    ir::NodeId lower(const model::Apply& form, const model::Expr& expr);
    ir::NodeId lower(const model::If& form, const model::Expr& expr);
    ir::NodeId lower(const model::Switch& form, const model::Expr& expr);
    ir::NodeId lower(const model::Aggregate& form, const model::Expr& expr);
    ir::NodeId lower(const model::Sample& form, const model::Expr& expr);
    ir::NodeId lower(const model::Discrete& form, const model::Expr& expr);
    ir::NodeId lower(const model::DiscreteOver& form, const model::Expr& expr);
    ir::NodeId lower(const model::External& form, const model::Expr& expr);
    ir::NodeId lower(const model::Determinant& form, const model::Expr& expr);
    ir::NodeId lower(const model::MatrixFunction& form, const model::Expr& expr);
    ir::NodeId lower(const model::RandomVector& form, const model::Expr& expr);

    ir::NodeId lower_as(const model::Expr& expr, ir::Scalar type);
    std::optional<Range> range_of_reals(ir::NodeId value) const;
    std::vector<ir::NodeId> lower_all(const std::vector<model::Expr>& exprs);
    // Lowers an operand that is not evaluated in every case.
    ir::NodeId lower_lazily(const model::Expr& expr);
    ir::NodeId connective(const model::Apply& form);
    ir::NodeId product(const model::Apply& form);
    bool keeps_zeros(ir::NodeId factor) const;
    ir::NodeId product_unless_zero(ir::NodeId first, ir::NodeId other, bool right_first);
    bool may_be_named(ir::NodeId value) const;
    bool is_fixed_in_scope(ir::NodeId value) const;
    ir::NodeId named(ir::NodeId value);
    ir::NodeId choice(ir::NodeId subject, std::span<const ir::NodeId> labels,
                      std::span<const ir::NodeId> values, ir::NodeId rest);
    ir::NodeId loops_over(const model::Aggregate& form, Reduction op, ir::NodeId body);
    ir::NodeId row_major_index(std::span<const ir::VariableId> variables);
    ir::Place new_place(const model::Expr& expr, std::string what);
    ir::Place new_place(const model::Expr& expr, std::string what,
                        const std::vector<ir::VariableId>& scope);
    ir::Place new_draw(const model::Expr& expr, std::string what);
    // Lowers branches of which one is evaluated.
    std::vector<ir::NodeId> lower_branches(const std::vector<const model::Expr*>& branches);
    ir::NodeId integer(std::int64_t value) { return builder_.constant(value); }
    std::int64_t size_of(model::VariableId id) const;
    ir::Statement looped(ir::Statement statement, std::span<const ir::VariableId> variables) const;

    // lowering_tables.cpp
    struct Matrix {
        ir::NodeId element;
        ir::VariableId row, column;
        std::vector<ir::VariableId> outer;  // in scope, used by the element
    };
    void run_before(ir::Statement statement, std::span<const ir::VariableId> variables);
    ir::BufferId new_table(std::string_view name, ir::Scalar scalar,
                           std::span<const ir::VariableId> dimensions, const model::Expr& expr);
    ir::BufferId filled_table(std::string_view name, ir::NodeId value,
                              std::span<const ir::VariableId> variables, const model::Expr& expr);
    std::vector<ir::NodeId> indices_of(std::span<const ir::VariableId> variables);
    std::vector<ir::VariableId> variables_in(const std::vector<ir::NodeId>& nodes,
                                             const std::vector<ir::VariableId>& candidates) const;
    void call_matrix_operator(MatrixOperator op, const Matrix& matrix, ir::BufferId result,
                              const model::Expr& expr);
    ir::BufferId buffer_of(const model::VectorReference& reference) const;
    std::vector<ir::NodeId> indices_of(const model::VectorReference& reference,
                                       const std::vector<ir::VariableId>& axes);
    ir::NodeId element_of(const model::VectorReference& reference,
                          const std::vector<ir::VariableId>& axes);
    ir::TableView view_of(const model::VectorReference& reference,
                          const std::vector<ir::VariableId>& axes, ir::Scalar scalar,
                          std::string_view name, const model::Expr& expr);
    ir::TableView argument_of(const model::VectorReference& reference, const model::Expr& expr);
    ir::VariableId axis_variable(model::TypeId type, std::size_t position);
    ir::ExternalId external_named(const std::string& name, Span span);
    ir::TableView vector_of(const model::VectorReference& reference, ir::VariableId axis,
                            const model::Expr& expr);
    ir::TableView factor_of(const model::VectorReference& reference, ir::VariableId axis,
                            const model::Expr& expr);

    const model::Model& model_;
    const std::vector<FluentBuffers>& buffers_;
    ir::Program& program_;
    ir::Builder& builder_;
    Diagnostics& diagnostics_;
    std::vector<ir::VariableId> scope_;  // outermost first
    int branches_ = 0;                   // how many lazy branches there are around
    std::vector<ir::SiteId> series_;     // random numbers that draws of other branches have
    std::vector<ir::SiteId> drawing_;    // sites that draw numbers of their own
    ir::Block prelude_;                  // what the current CPF or condition computes first
    // Binders of equal name and type share a variable, so that equal expressions get equal ids.
    std::map<std::pair<std::string, model::TypeId>, ir::VariableId> variables_;
};

}  // namespace rddlc::grounding
