#include "passes/aggregations/count_values.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/nest.hpp"
#include "ir/rewrite.hpp"
#include "passes/aggregations/value_counts.hpp"
#include "passes/analyses/jumps.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace rddlc::passes {
namespace {

// Values that are asked for. Fewer are compared as fast.
constexpr int fewest_values = 3;

// Whether, or how many, objects have a value.
struct Asked {
    ir::NodeId value;  // of the variable of `counted_objects`
    std::int64_t constant;
    std::int64_t objects;
    Reduction how;
};

class ValueCounting {
  public:
    ValueCounting(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        for (ir::Definition& definition : program_.step) {
            place_ = {program_[definition.target].name, definition.span};
            if (auto* store = ir::only_statement<ir::Store>(definition.body))
                store->value = in_jumps(store->value);
        }
        place_ = {"reward", program_.reward.span};
        program_.reward.value = in_jumps(program_.reward.value);
        return ir::collect_garbage(std::move(program_));
    }

  private:
    ir::NodeId in_jumps(ir::NodeId value) {
        return replace_in_jumps(builder_, value, [&](const ir::Select& jump) {
            const ir::NodeId cases = jump.then_value;
            asked_for_.clear();
            std::map<ir::NodeId, ir::NodeId> seen, known;
            ir::replace_in(builder_, cases, seen, [&](ir::NodeId id) { return noted(id); });
            if (asked_for_.empty()) return cases;
            return ir::replace_in(builder_, cases, known,
                                  [&](ir::NodeId id) { return counted(id); });
        });
    }

    std::optional<ir::NodeId> noted(ir::NodeId id) {
        const auto asked = asked_by(id);
        if (!asked) return std::nullopt;
        ++asked_for_[asked->value];
        return id;
    }
    std::optional<ir::NodeId> counted(ir::NodeId id) {
        const auto asked = asked_by(id);
        if (!asked || asked_for_[asked->value] < fewest_values) return std::nullopt;
        const auto counts =
            count_values(builder_, counted_objects(program_, asked->objects), asked->value, place_);
        if (!counts) return std::nullopt;
        ++report_["counts of values that are shared"];
        if (asked->how == Reduction::Sum) return count_of(builder_, *counts, asked->constant);
        const ir::NodeId has = has_value(builder_, *counts, asked->constant);
        return asked->how == Reduction::Exists ? has : builder_.apply(Operator::Not, {has});
    }

    // sum[d](int(x[d] == 2)), exists[d](x[d] == 2), forall[d](x[d] != 2)
    std::optional<Asked> asked_by(ir::NodeId id) {
        const auto* form = std::get_if<ir::Reduce>(&program_[id].form);
        if (!form || form->bounds || form->over_true || !ir::is_droppable(builder_.properties(id)))
            return std::nullopt;
        const ir::Reduce reduce = *form;  // new nodes move the others
        const auto test = test_of(reduce);
        if (!test) return std::nullopt;
        const auto* apply = std::get_if<ir::Apply>(&program_[*test].form);
        const bool differs = reduce.op == Reduction::ForAll;
        if (!apply || apply->op != (differs ? Operator::NotEqual : Operator::Equal))
            return std::nullopt;
        const ir::NodeId value = apply->operands.front();
        const auto constant = ir::constant<std::int64_t>(program_, apply->operands.back());
        if (!constant || !is_countable(builder_, value) ||
            !ir::depends_on(builder_.properties(value), reduce.variable))
            return std::nullopt;
        const std::int64_t objects = program_[reduce.variable].size;
        return Asked{value_of_counted(builder_, program_, value, reduce.variable), *constant,
                     objects, reduce.op};
    }
    std::optional<ir::NodeId> test_of(const ir::Reduce& reduce) const {
        if (is_quantifier(reduce.op)) return reduce.body;
        if (reduce.op != Reduction::Sum || program_[reduce.body].type != ir::Scalar::Int)
            return std::nullopt;
        return ir::converted_bool(program_, reduce.body);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
    CountedPlace place_;
    std::map<ir::NodeId, int> asked_for_;  // how often, by the value
};

}  // namespace

ir::Program count_values(ir::Program program, Report& report) {
    return ValueCounting(std::move(program), report).run();
}

}  // namespace rddlc::passes
