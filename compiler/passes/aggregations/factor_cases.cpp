#include "passes/aggregations/factor_cases.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// Fewer conditions are as cheap.
constexpr std::size_t fewest_factored = 3;

using Conjunction = std::vector<ir::NodeId>;  // its parts

struct IntCase {
    Conjunction condition;
    ir::NodeId value;
};

struct IntTest {
    ir::NodeId value;
    std::int64_t constant;
};

class CaseFactoring {
  public:
    CaseFactoring(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        ir::change_roots(program_, [&](ir::NodeId& root) { root = rewritten(root); });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    ir::NodeId rewritten(ir::NodeId id) {
        return ir::replace_in(builder_, id, known_,
                              [&](ir::NodeId each) { return factored(each); });
    }

    std::optional<ir::NodeId> factored(ir::NodeId id) {
        std::vector<IntCase> cases;
        std::optional<std::size_t> place;  // of the part that differs
        ir::NodeId rest = id;
        while (const auto* select = std::get_if<ir::Select>(&program_[rest].form)) {
            IntCase next{ir::parts_of(program_, select->condition, Operator::And),
                         select->then_value};
            if (!ir::is_droppable(builder_.properties(select->condition))) break;
            if (cases.size() == 1) place = only_difference(cases.front(), next);
            if (!cases.empty() && (!place || only_difference(cases.front(), next) != place)) break;
            cases.push_back(std::move(next));
            rest = select->else_value;
        }
        if (cases.size() < fewest_factored || !ir::is_cheap(builder_.properties(rest)))
            return std::nullopt;
        ++report_["conditions that all cases share"];
        const ir::NodeId otherwise = rewritten(rest);
        auto each = cases.rbegin();
        ir::NodeId chosen = has_all_values(cases, *place) ? rewritten((each++)->value) : otherwise;
        for (; each != cases.rend(); ++each)
            chosen = builder_.select(each->condition[*place], rewritten(each->value), chosen);
        Conjunction common = cases.front().condition;
        common.erase(common.begin() + static_cast<std::ptrdiff_t>(*place));
        return builder_.select(ir::joined(builder_, Operator::And, common), chosen, otherwise);
    }

    // Whether one of the cases is met for certain, as far as it goes by the int.
    bool has_all_values(const std::vector<IntCase>& cases, std::size_t place) {
        std::set<std::int64_t> constants;
        for (const IntCase& each : cases)
            constants.insert(test_of(each.condition[place])->constant);
        const auto range = builder_.properties(test_of(cases[0].condition[place])->value).range;
        return range && static_cast<double>(constants.size()) == range->upper - range->lower + 1 &&
               static_cast<double>(*constants.begin()) == range->lower &&
               static_cast<double>(*constants.rbegin()) == range->upper;
    }

    // The only part in which two conditions differ, if one int is compared with two constants
    // there; and they have others.
    std::optional<std::size_t> only_difference(const IntCase& a, const IntCase& b) const {
        if (a.condition.size() != b.condition.size() || a.condition.size() < 2) return std::nullopt;
        const auto [in_a, in_b] = std::ranges::mismatch(a.condition, b.condition);
        if (in_a == a.condition.end() || !std::equal(in_a + 1, a.condition.end(), in_b + 1))
            return std::nullopt;
        const auto test = test_of(*in_a), other = test_of(*in_b);
        if (!test || !other || test->value != other->value) return std::nullopt;
        return static_cast<std::size_t>(in_a - a.condition.begin());
    }
    std::optional<IntTest> test_of(ir::NodeId id) const {
        const auto* test = std::get_if<ir::Apply>(&program_[id].form);
        if (!test || test->op != Operator::Equal) return std::nullopt;
        const auto constant = ir::constant<std::int64_t>(program_, test->operands.back());
        return constant ? std::optional(IntTest{test->operands.front(), *constant}) : std::nullopt;
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    std::map<ir::NodeId, ir::NodeId> known_;
};

}  // namespace

ir::Program factor_cases(ir::Program program, Report& report) {
    return CaseFactoring(std::move(program), report).run();
}

}  // namespace rddlc::passes
