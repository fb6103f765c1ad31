#include "passes/evaluate_together.hpp"

#include "ir/analysis.hpp"
#include "ir/nest.hpp"
#include "support/match.hpp"

#include <algorithm>

namespace rddlc::passes {
namespace {

constexpr std::int64_t fewest_iterations = 8;

// Drawn from one number, by functions that registers have.
bool is_by_inversion(Distribution distribution) {
    switch (distribution) {
        case Distribution::Bernoulli:
        case Distribution::Uniform:
        case Distribution::Normal:
        case Distribution::Exponential:
        case Distribution::Weibull:
        case Distribution::Geometric:
        case Distribution::Pareto:
        case Distribution::Gumbel:
        case Distribution::Laplace:
        case Distribution::Cauchy:
        case Distribution::Gompertz:
        case Distribution::Kumaraswamy:
            return true;
        default:
            return false;
    }
}

class Question {
  public:
    Question(const ir::Program& program, const std::vector<ir::Facts>& facts,
             const ir::Loop& outermost)
        : program_(program), facts_(facts), nest_(ir::nest_of(outermost)) {}

    bool is_worth_it() const {
        std::int64_t iterations = 1;
        for (const ir::VariableId variable : nest_.variables) iterations *= program_[variable].size;
        return iterations >= fewest_iterations &&
               std::ranges::all_of(*nest_.body, [&](const ir::Statement& statement) {
                   const auto* store = std::get_if<ir::Store>(&statement.form);
                   return !store || program_[store->target].scalar == ir::Scalar::Bool ||
                          facts_[store->value.index].random;
               });
    }

    bool is_possible() const {
        return std::ranges::all_of(*nest_.body, [&](const ir::Statement& statement) {
            return match(
                statement.form, [&](const ir::Let& let) { return is_possible(let.value); },
                [&](const ir::Store& store) {
                    return is_of_these_objects(store.indices) && is_possible(store.value);
                },
                [](const auto&) { return false; });
        });
    }

  private:
    bool is_possible(ir::NodeId id) const {
        return match(
            program_[id].form, [](const ir::Constant&) { return true; },
            [](const ir::Local&) { return true; }, [](const ir::Bits&) { return true; },
            [&](const ir::Load& load) { return is_possible(load); },
            [&](const ir::Convert& convert) { return is_possible(convert.operand); },
            [&](const ir::Apply& apply) { return !apply.place && all_possible(apply.operands); },
            [&](const ir::Select& select) {
                return all_possible({select.condition, select.then_value, select.else_value});
            },
            [&](const ir::Sample& sample) {
                return is_by_inversion(sample.distribution) &&
                       ir::is_place_in(program_, nest_, sample.place.index) &&
                       all_possible(sample.parameters);
            },
            [](const auto&) { return false; });
    }
    bool all_possible(const std::vector<ir::NodeId>& ids) const {
        return std::ranges::all_of(ids, [&](ir::NodeId id) { return is_possible(id); });
    }

    // An element of these objects, or one that is the same for all of them.
    bool is_possible(const ir::Load& load) const {
        if (ir::begins_with(program_, load.indices, nest_)) {
            const auto rest =
                load.indices.begin() + static_cast<std::ptrdiff_t>(nest_.variables.size());
            return all_possible({rest, load.indices.end()});
        }
        return std::ranges::all_of(load.indices, [&](ir::NodeId index) {
            const ir::Facts& facts = facts_[index.index];
            return facts.uniform && std::ranges::none_of(nest_.variables, [&](ir::VariableId v) {
                       return std::ranges::binary_search(facts.free_variables, v);
                   });
        });
    }

    bool is_of_these_objects(const std::vector<ir::NodeId>& indices) const {
        return indices.size() == nest_.variables.size() &&
               ir::begins_with(program_, indices, nest_);
    }

    const ir::Program& program_;
    const std::vector<ir::Facts>& facts_;
    ir::Nest nest_;
};

}  // namespace

ir::Program evaluate_together(ir::Program program, Report& report) {
    const std::vector<ir::Facts> facts = ir::all_facts(program);
    for (ir::Definition& definition : program.step) {
        for (ir::Statement& statement : definition.body) {
            auto* const loop = std::get_if<ir::Loop>(&statement.form);
            if (!loop) continue;
            const Question question(program, facts, *loop);
            loop->several_at_once = question.is_worth_it() && question.is_possible();
            report["loops over several objects at once"] += loop->several_at_once ? 1 : 0;
        }
    }
    return program;
}

}  // namespace rddlc::passes
