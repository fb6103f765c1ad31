#include "passes/aggregations/decide_draws.hpp"

#include "ir/rewrite.hpp"

#include <utility>

namespace rddlc::passes {
namespace {

// Finds the conditions under which numbers are 1 that are 0 otherwise.
class Truth {
  public:
    explicit Truth(ir::Builder& builder) : builder_(builder) {}

    // The condition, or nothing if the number may be another one. Copies: new nodes move the
    // others.
    std::optional<ir::NodeId> of(ir::NodeId id) {
        const ir::Node node = program()[id];
        if (const auto holds = ir::converted_bool(program(), id)) return holds;
        if (const auto* convert = std::get_if<ir::Convert>(&node.form)) return of(convert->operand);
        if (const auto* select = std::get_if<ir::Select>(&node.form)) return of_choice(*select);
        if (const auto* reduce = std::get_if<ir::Reduce>(&node.form)) return of_product(*reduce);
        if (const auto* apply = std::get_if<ir::Apply>(&node.form)) return of_operator(*apply);
        if (is_zero_or_one(node)) return builder_.apply(Operator::Equal, {id, one(node.type)});
        return std::nullopt;
    }

  private:
    std::optional<ir::NodeId> of_choice(const ir::Select& select) {
        const auto yes = of(select.then_value), no = of(select.else_value);
        if (!yes || !no) return std::nullopt;
        return builder_.select(select.condition, *yes, *no);
    }

    std::optional<ir::NodeId> of_product(const ir::Reduce& reduce) {
        if (reduce.op != Reduction::Product) return std::nullopt;
        const auto factor = of(reduce.body);
        if (!factor) return std::nullopt;
        return builder_.reduce(Reduction::ForAll, reduce.variable, *factor, reduce.bounds);
    }

    std::optional<ir::NodeId> of_operator(const ir::Apply& apply) {
        if (apply.op == Operator::Subtract) {
            const auto subtracted =
                is_one(apply.operands[0]) ? of(apply.operands[1]) : std::nullopt;
            if (!subtracted) return std::nullopt;
            return builder_.apply(Operator::Not, {*subtracted});
        }
        if (apply.op != Operator::Multiply) return std::nullopt;
        const auto a = of(apply.operands[0]), b = of(apply.operands[1]);
        if (!a || !b) return std::nullopt;
        return builder_.apply(Operator::And, {*a, *b});
    }

    // A constant, or an element of a table of them.
    bool is_zero_or_one(const ir::Node& node) const {
        const auto is_either = [](const ir::Value& value) {
            return as_real(value) == 0 || as_real(value) == 1;
        };
        if (const auto* constant = std::get_if<ir::Constant>(&node.form))
            return is_either(constant->value);
        const auto* load = std::get_if<ir::Load>(&node.form);
        return load && program()[load->buffer].storage == ir::Storage::Constant &&
               program()[load->buffer].values.all_of(is_either);
    }

    bool is_one(ir::NodeId id) const {
        const auto* constant = std::get_if<ir::Constant>(&program()[id].form);
        return constant && as_real(constant->value) == 1;
    }

    ir::NodeId one(ir::Scalar type) {
        return builder_.constant(type == ir::Scalar::Int ? ir::Value{std::int64_t{1}}
                                                         : ir::Value{1.0});
    }

    const ir::Program& program() const { return builder_.program(); }

    ir::Builder& builder_;
};

}  // namespace

ir::Program decide_draws(ir::Program program, Report& report) {
    return ir::rewrite(
        std::move(program),
        [&](ir::Builder& builder, ir::NodeId, const ir::Node& node) -> std::optional<ir::NodeId> {
            const auto* sample = std::get_if<ir::Sample>(&node.form);
            if (!sample || sample->distribution != Distribution::Bernoulli) return std::nullopt;
            // A condition need not evaluate all that a number does.
            const ir::NodeId p = sample->parameters.front();
            if (!ir::is_droppable(builder.properties(p))) return std::nullopt;
            const auto condition = Truth(builder).of(p);
            if (condition) ++report["draws that are certain"];
            return condition;
        });
}

}  // namespace rddlc::passes
