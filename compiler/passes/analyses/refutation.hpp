// Proves that a condition is false for all values of its numbers within bounds.
//
// First by interval arithmetic. Then by contradiction: the condition is taken to be true, which
// narrows the bounds of its operands, down to those of its numbers and up again (HC4, F. Benhamou,
// F. Goualard, L. Granvilliers and J.-F. Puget, Revising hull and box consistency, 1999). Where a
// disjunction is open, each of its parts has to lead to a contradiction.
#pragma once

#include "ir/ir.hpp"
#include "passes/analyses/line_bounds.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::passes {

// A condition of the objects of a loop, on numbers that are the same for all of them.
class ConditionOfObjects {
  public:
    // The statements before the store of a loop's body name values. Nothing if the condition has
    // operators or values that are not known here.
    static std::optional<ConditionOfObjects> of(const ir::Program& program,
                                                std::span<const ir::Statement> lets,
                                                ir::NodeId condition, ir::VariableId object);

    // The numbers: buffers of one real.
    const std::vector<ir::BufferId>& numbers() const { return numbers_; }
    // The least and the greatest constant that is compared with a number, or subtracted, or from
    // which it is subtracted. Nothing if there is none.
    std::optional<std::pair<double, double>> constants_near(std::size_t number) const;

    // By interval arithmetic alone.
    bool is_false(std::int64_t object, std::span<const LineBounds> numbers) const;
    bool is_refuted(std::int64_t object, std::span<const LineBounds> numbers) const;

  private:
    enum class Form : std::uint8_t { Constant, Number, Apply, Select };
    struct Term {
        Form form;
        Operator op = {};
        std::vector<std::size_t> operands = {};
        std::vector<double> constants = {};  // of each object; bools are 0 or 1
        std::size_t number = 0;
        int degree = 0;  // how many factors that are not constant a product has at most
        bool is_bool = false;
    };
    using Values = std::vector<LineBounds>;

    struct Making;
    LineBounds value(const Term& term, const Values& values) const;
    LineBounds selected(const Term& term, const Values& values) const;
    Values evaluated(std::int64_t object, std::span<const LineBounds> numbers) const;
    using Terms = std::vector<std::size_t>;
    Terms open_terms(const Values& values) const;
    bool leads_to_contradiction(const Terms& open, Values values, int depth) const;
    bool is_contradictory(const Terms& open, Values& values) const;
    std::optional<std::size_t> open_choice(const Terms& open, const Values& values) const;
    void narrow_operands(const Term& term, Values& values) const;
    void narrow_branches(const Term& term, const LineBounds& result, Values& values) const;

    std::vector<Term> terms_;  // operands first; the last one is the condition
    std::vector<ir::BufferId> numbers_;
};

}  // namespace rddlc::passes
