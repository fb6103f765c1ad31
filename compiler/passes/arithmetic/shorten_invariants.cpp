#include "passes/arithmetic/shorten_invariants.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"
#include "passes/analyses/step_bounds.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

class Shortening {
  public:
    Shortening(ir::Program program, Report& report)
        : program_(std::move(program)),
          report_(report),
          builder_(program_),
          bounds_(builder_, StepBounds::Ranges::OfConstants) {}

    ir::Program run() && {
        for (ir::Computation& invariant : program_.invariants)
            if (invariant.body.empty()) invariant.value = shortened(invariant.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    ir::NodeId shortened(ir::NodeId condition) {
        const auto form = program_[condition].form;  // the builder moves nodes
        if (const auto* all = std::get_if<ir::Reduce>(&form))
            return all->op == Reduction::ForAll
                       ? builder_.reduce(all->op, all->variable, shortened(all->body), all->bounds)
                       : condition;
        std::vector<ir::NodeId> parts = ir::parts_of(program_, condition, Operator::And);
        const std::size_t before = parts.size();
        for (std::size_t k = 0; k < parts.size();) {
            if (is_found_by_others(parts, k))
                parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
            else
                ++k;
        }
        if (parts.size() == before) return condition;
        report_["bounds of invariants that steps keep"] +=
            static_cast<std::int64_t>(before - parts.size());
        return ir::joined(builder_, Operator::And, parts);
    }

    // A bound that a step violates by nan alone, which another comparison of the number finds.
    bool is_found_by_others(const std::vector<ir::NodeId>& parts, std::size_t k) {
        const auto number = compared_number(parts[k]);
        if (!number || !is_kept(parts[k])) return false;
        for (std::size_t other = 0; other < parts.size(); ++other)
            if (other != k && compared_number(parts[other]) == number) return true;
        return false;
    }
    bool is_kept(ir::NodeId comparison) {
        const auto apply = std::get<ir::Apply>(program_[comparison].form);
        const ir::NodeId a = apply.operands.front(), b = apply.operands.back();
        if (apply.op == Operator::LessEqual) return bounds_.is_kept_at_most(a, b);
        return apply.op == Operator::GreaterEqual && bounds_.is_kept_at_most(b, a);
    }

    // The real of the state that is compared with a constant; where it is nan, the comparison does
    // not hold.
    std::optional<ir::NodeId> compared_number(ir::NodeId condition) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[condition].form);
        if (!apply || !is_one_of(apply->op, {Operator::Less, Operator::LessEqual, Operator::Greater,
                                             Operator::GreaterEqual, Operator::Equal}))
            return std::nullopt;
        const ir::NodeId a = apply->operands.front(), b = apply->operands.back();
        if (is_real_of_state(a) && builder_.properties(b).uniform) return a;
        if (is_real_of_state(b) && builder_.properties(a).uniform) return b;
        return std::nullopt;
    }
    bool is_real_of_state(ir::NodeId id) const {
        const auto* load = std::get_if<ir::Load>(&program_[id].form);
        return load && program_[load->buffer].storage == ir::Storage::State &&
               program_[id].type == ir::Scalar::Real;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    StepBounds bounds_;
};

}  // namespace

ir::Program shorten_invariants(ir::Program program, Report& report) {
    return Shortening(std::move(program), report).run();
}

}  // namespace rddlc::passes
