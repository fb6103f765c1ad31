#include "passes/analyses/equivalence.hpp"

#include "ir/analysis.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::passes {
namespace {

// Whether `x op y` is `y mirrored(op) x`.
bool may_be_mirrored(Operator op) {
    return is_comparison(op) || op == Operator::Add || op == Operator::Multiply;
}

// The first of the values to which each one is said to be equal.
class Classes {
  public:
    void join(ir::NodeId a, ir::NodeId b) {
        const ir::NodeId first = of(a), second = of(b);
        for (auto& [value, leader] : leaders_)
            if (leader == std::max(first, second)) leader = std::min(first, second);
    }
    bool operator==(const Classes&) const = default;

  private:
    ir::NodeId of(ir::NodeId value) { return leaders_.try_emplace(value, value).first->second; }

    std::map<ir::NodeId, ir::NodeId> leaders_;
};

class Equivalence {
  public:
    explicit Equivalence(const ir::Program& program) : program_(program) {}

    bool holds(ir::NodeId a, ir::NodeId b) {
        if (a == b) return true;
        const auto [known, is_new] = known_.try_emplace({a, b}, false);
        if (!is_new) return known->second;
        const bool result = have_equal_forms(a, b) || are_equal_applications(a, b);
        return known_[{a, b}] = result;
    }

  private:
    // They are equal except for operands, which are equivalent.
    bool have_equal_forms(ir::NodeId a, ir::NodeId b) {
        const std::vector<ir::NodeId> ours = ir::operands_of(program_[a]),
                                      theirs = ir::operands_of(program_[b]);
        if (ours.size() != theirs.size() || ours.empty()) return false;
        ir::Node node = program_[a];
        auto next = theirs.begin();
        ir::change_operands(node, [&](ir::NodeId& operand) { operand = *next++; });
        return node == program_[b] &&
               std::ranges::equal(ours, theirs,
                                  [&](ir::NodeId x, ir::NodeId y) { return holds(x, y); });
    }

    bool are_equal_applications(ir::NodeId a, ir::NodeId b) {
        const auto *first = std::get_if<ir::Apply>(&program_[a].form),
                   *second = std::get_if<ir::Apply>(&program_[b].form);
        if (!first || !second || first->operands.size() != second->operands.size()) return false;
        const Operator op = first->op;
        if (op == Operator::And || op == Operator::Or)
            return op == second->op && have_equal_parts(op, a, b);
        if (first->operands.size() != 2) return false;
        if (op == second->op && is_square(*first) && is_square(*second) &&
            differ_by_sign(first->operands.front(), second->operands.front()))
            return true;
        return may_be_mirrored(op) && mirrored(op) == second->op &&
               holds(first->operands.front(), second->operands.back()) &&
               holds(first->operands.back(), second->operands.front());
    }

    // The square of its first operand.
    bool is_square(const ir::Apply& apply) const {
        if (apply.op == Operator::Power)
            return ir::constant<double>(program_, apply.operands.back()) == 2.0;
        return apply.op == Operator::Multiply && apply.operands.front() == apply.operands.back();
    }

    // x - y and y - x: either one is 0.0 if the other one is, and never -0.0 then.
    bool differ_by_sign(ir::NodeId a, ir::NodeId b) {
        const auto *first = std::get_if<ir::Apply>(&program_[a].form),
                   *second = std::get_if<ir::Apply>(&program_[b].form);
        return first && second && first->op == Operator::Subtract &&
               second->op == Operator::Subtract && first->operands.size() == 2 &&
               second->operands.size() == 2 &&
               holds(first->operands.front(), second->operands.back()) &&
               holds(first->operands.back(), second->operands.front());
    }

    // Conditions may have any order. The equalities of a conjunction, or the inequalities of a
    // disjunction, say together which values are compared.
    bool have_equal_parts(Operator op, ir::NodeId a, ir::NodeId b) {
        Classes ours, theirs;
        const std::vector<ir::NodeId> first = other_parts(op, a, ours);
        std::vector<ir::NodeId> second = other_parts(op, b, theirs);
        if (ours != theirs || first.size() != second.size()) return false;
        return std::ranges::all_of(first, [&](ir::NodeId part) {
            const auto same =
                std::ranges::find_if(second, [&](ir::NodeId each) { return holds(part, each); });
            if (same == second.end()) return false;
            second.erase(same);
            return true;
        });
    }
    // The parts that are no such comparison. Those that are join the classes.
    std::vector<ir::NodeId> other_parts(Operator op, ir::NodeId id, Classes& classes) const {
        std::vector<ir::NodeId> others;
        const Operator equality = op == Operator::And ? Operator::Equal : Operator::NotEqual;
        for (const ir::NodeId part : ir::parts_of(program_, id, op)) {
            const auto* apply = std::get_if<ir::Apply>(&program_[part].form);
            if (apply && apply->op == equality)
                classes.join(apply->operands.front(), apply->operands.back());
            else
                others.push_back(part);
        }
        return others;
    }

    const ir::Program& program_;
    std::map<std::pair<ir::NodeId, ir::NodeId>, bool> known_;
};

}  // namespace

bool are_equivalent(const ir::Program& program, ir::NodeId a, ir::NodeId b) {
    return Equivalence(program).holds(a, b);
}

}  // namespace rddlc::passes
