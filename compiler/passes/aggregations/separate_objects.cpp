#include "passes/aggregations/separate_objects.hpp"

#include "ir/analysis.hpp"
#include "ir/reduction_nest.hpp"
#include "ir/rewrite.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace rddlc::passes {
namespace {

// The operators of an exists, and those of a forall, which is the same of what is not true.
struct Operators {
    Operator every_part, any_case, different, same;
};
Operators operators_of(Reduction op) {
    return op == Reduction::Exists
               ? Operators{Operator::And, Operator::Or, Operator::NotEqual, Operator::Equal}
               : Operators{Operator::Or, Operator::And, Operator::Equal, Operator::NotEqual};
}

using Parts = std::vector<ir::NodeId>;

class Separation {
  public:
    Separation(ir::Program program, Report& report)
        : program_(std::move(program)), report_(report), builder_(program_) {}

    ir::Program run() && {
        std::map<ir::NodeId, ir::NodeId> known;
        ir::change_roots(program_, [&](ir::NodeId& root) {
            root = ir::replace_in(builder_, root, known,
                                  [&](ir::NodeId each) { return separated(each); });
        });
        return ir::collect_garbage(std::move(program_));
    }

  private:
    // The parts of a case by the object of the nest that each of them asks for, if it is one.
    struct Wanted {
        std::vector<Parts> of_objects;
        Parts of_none;
        std::vector<std::pair<std::size_t, std::size_t>> different;
    };

    std::optional<ir::NodeId> separated(ir::NodeId id) {
        const auto nest = ir::reduction_nest(program_, id);
        if (!nest || !is_quantifier(nest->op) || !ir::is_droppable(builder_.properties(nest->body)))
            return std::nullopt;
        const Operators operators = operators_of(nest->op);
        Parts results;
        for (const Parts& parts : cases_of(nest->body, operators)) {
            const auto wanted = wanted_by(parts, *nest, operators);
            if (!wanted || !is_told_apart(*wanted, *nest, operators)) return std::nullopt;
            results.push_back(each_alone(*wanted, *nest, operators));
        }
        ++report_["quantifiers over objects that differ"];
        return ir::joined(builder_, operators.any_case, results);
    }

    // The parts of each case; one part may have several.
    std::vector<Parts> cases_of(ir::NodeId body, const Operators& operators) const {
        Parts parts = ir::parts_of(program_, body, operators.every_part);
        const auto has_cases = [&](ir::NodeId part) {
            return ir::parts_of(program_, part, operators.any_case).size() > 1;
        };
        const auto found = std::ranges::find_if(parts, has_cases);
        if (found == parts.end()) return {parts};
        const ir::NodeId part = *found;
        parts.erase(found);
        std::vector<Parts> cases;
        for (const ir::NodeId each : ir::parts_of(program_, part, operators.any_case)) {
            cases.push_back(parts);
            std::ranges::copy(ir::parts_of(program_, each, operators.every_part),
                              std::back_inserter(cases.back()));
        }
        return cases;
    }

    std::optional<Wanted> wanted_by(const Parts& parts, const ir::ReductionNest& nest,
                                    const Operators& operators) {
        Wanted wanted{std::vector<Parts>(nest.variables.size()), {}, {}};
        for (const ir::NodeId part : parts) {
            std::vector<std::size_t> objects;
            for (std::size_t k = 0; k < nest.variables.size(); ++k)
                if (ir::depends_on_any(builder_.properties(part), {&nest.variables[k], 1}))
                    objects.push_back(k);
            if (objects.empty())
                wanted.of_none.push_back(part);
            else if (objects.size() == 1)
                wanted.of_objects[objects[0]].push_back(part);
            else if (objects.size() == 2 && compares(part, nest, objects, operators.different))
                wanted.different.emplace_back(objects[0], objects[1]);
            else
                return std::nullopt;
        }
        return wanted;
    }
    bool compares(ir::NodeId part, const ir::ReductionNest& nest,
                  const std::vector<std::size_t>& objects, Operator op) {
        const ir::NodeId a = builder_.index(nest.variables[objects[0]]),
                         b = builder_.index(nest.variables[objects[1]]);
        return part == builder_.apply(op, {a, b}) || part == builder_.apply(op, {b, a});
    }

    // Something is wanted of each object, and of no two that must differ can the same one have it.
    bool is_told_apart(const Wanted& wanted, const ir::ReductionNest& nest,
                       const Operators& operators) {
        const auto differs = [&](const auto& pair) {
            const auto [a, b] = pair;
            return differ(wanted.of_objects[a], wanted.of_objects[b], nest.variables[a],
                          nest.variables[b], operators.same);
        };
        return !wanted.different.empty() &&
               std::ranges::none_of(wanted.of_objects, &Parts::empty) &&
               std::ranges::all_of(wanted.different, differs);
    }
    // One expression is to have two values.
    bool differ(const Parts& of_a, const Parts& of_b, ir::VariableId a, ir::VariableId b,
                Operator same) {
        std::map<ir::NodeId, ir::NodeId> renamed = {{builder_.index(a), builder_.index(b)}};
        return std::ranges::any_of(of_a, [&](ir::NodeId first) {
            const auto one = value_in(first, same);
            if (!one) return false;
            const ir::NodeId expression = ir::replace_in(builder_, one->expression, renamed);
            return std::ranges::any_of(of_b, [&](ir::NodeId second) {
                const auto other = value_in(second, same);
                return other && other->expression == expression && other->value != one->value;
            });
        });
    }
    struct Value {
        ir::NodeId expression;
        std::int64_t value;
    };
    std::optional<Value> value_in(ir::NodeId part, Operator same) const {
        const auto* apply = std::get_if<ir::Apply>(&program_[part].form);
        if (!apply || apply->op != same) return std::nullopt;
        for (const std::size_t place : {std::size_t{0}, std::size_t{1}})
            if (const auto value = ir::constant<std::int64_t>(program_, apply->operands[1 - place]))
                return Value{apply->operands[place], *value};
        return std::nullopt;
    }

    // Objects of one type have one variable, so that equal quantifiers are computed once.
    ir::NodeId each_alone(const Wanted& wanted, const ir::ReductionNest& nest,
                          const Operators& operators) {
        Parts all = wanted.of_none;
        for (std::size_t k = 0; k < nest.variables.size(); ++k) {
            const ir::VariableId variable = first_alike(nest, nest.variables[k]);
            std::map<ir::NodeId, ir::NodeId> renamed = {
                {builder_.index(nest.variables[k]), builder_.index(variable)}};
            const ir::NodeId part =
                ir::joined(builder_, operators.every_part, wanted.of_objects[k]);
            all.push_back(
                builder_.reduce(nest.op, variable, ir::replace_in(builder_, part, renamed)));
        }
        return ir::joined(builder_, operators.every_part, all);
    }
    ir::VariableId first_alike(const ir::ReductionNest& nest, ir::VariableId variable) const {
        const auto is_alike = [&](ir::VariableId other) {
            return program_[other].type == program_[variable].type &&
                   program_[other].size == program_[variable].size;
        };
        return *std::ranges::find_if(nest.variables, is_alike);
    }

    ir::Program program_;
    Report& report_;
    ir::Builder builder_;
};

}  // namespace

ir::Program separate_objects(ir::Program program, Report& report) {
    return Separation(std::move(program), report).run();
}

}  // namespace rddlc::passes
