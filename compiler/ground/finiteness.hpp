// Which real values stay finite as long as no sum or product overflows (ir::keeps_finite).
//
// RDDL's `0 * x` is 0 even where x is inf or nan (docs/semantics: multiplication), so a product
// needs a test for zero only where its other factor may be neither.
#pragma once

#include "ir/range.hpp"
#include "model/model.hpp"

#include <optional>
#include <vector>

namespace rddlc::grounding {

class Finiteness {
  public:
    // Finds the fluents that may become inf or nan. Action-fluents are taken to be finite, unless
    // the policy block may make them something else.
    explicit Finiteness(const model::Model& model);

    bool is_finite(const model::Expr& expr) const;
    bool is_finite(model::FluentId fluent) const { return fluent_is_finite_[fluent]; }

  private:
    // Marks fluents whose CPF may make them inf or nan; false if there are no more.
    bool find_non_finite(const std::vector<model::Cpf>& cpfs);
    bool is_finite(const model::Apply& form) const;
    bool is_finite(const model::Aggregate& form) const;
    std::vector<std::optional<ir::Range>> ranges_of(const std::vector<model::Expr>& operands) const;
    std::optional<ir::Range> range_of_value(const model::Expr& expr) const;
    bool all_finite(const model::Expr& expr) const;

    const model::Model& model_;
    // By model::FluentId.
    std::vector<bool> fluent_is_finite_;
    std::vector<std::optional<ir::Range>> ranges_;  // of non-fluents
};

}  // namespace rddlc::grounding
