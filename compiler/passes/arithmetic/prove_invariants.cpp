#include "passes/arithmetic/prove_invariants.hpp"

#include "ir/rewrite.hpp"
#include "passes/analyses/step_bounds.hpp"

#include <utility>
#include <variant>

namespace rddlc::passes {
namespace {

class Proof {
  public:
    explicit Proof(ir::Program program)
        : program_(std::move(program)),
          builder_(program_),
          bounds_(builder_, StepBounds::Ranges::OfAll) {}

    ir::Program run(Report& report) && {
        for (ir::Computation& invariant : program_.invariants) {
            if (!invariant.body.empty() || !is_kept(invariant.value)) continue;
            invariant.value = builder_.constant(true);
            ++report["invariants proved"];
        }
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // Whether the condition holds in every state that a step makes.
    bool is_kept(ir::NodeId condition) {
        const auto form = program_[condition].form;  // the builder moves nodes
        if (const auto* all = std::get_if<ir::Reduce>(&form))
            return all->op == Reduction::ForAll && is_kept(all->body);
        const auto* apply = std::get_if<ir::Apply>(&form);
        if (!apply || apply->operands.size() != 2) return false;
        const ir::NodeId a = apply->operands[0], b = apply->operands[1];
        if (apply->op == Operator::And) return is_kept(a) && is_kept(b);
        if (apply->op == Operator::LessEqual) return bounds_.is_kept_at_most(a, b);
        if (apply->op == Operator::GreaterEqual) return bounds_.is_kept_at_most(b, a);
        return false;
    }

    ir::Program program_;
    ir::Builder builder_;
    StepBounds bounds_;
};

}  // namespace

ir::Program prove_invariants(ir::Program program, Report& report) {
    return Proof(std::move(program)).run(report);
}

}  // namespace rddlc::passes
