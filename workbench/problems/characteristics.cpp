#include "problems/characteristics.hpp"

#include "support/match.hpp"

namespace rddlc::workbench {

namespace {

using namespace model;

template <class Visit>
void for_each_operand(const Expr& expression, Visit visit) {
    const auto visit_all = [&](const std::vector<Expr>& all) {
        for (const Expr& operand : all) visit(operand);
    };
    match(
        expression.node, [](const Constant&) {}, [](const VariableValue&) {},
        [&](const Reference& n) { visit_all(n.arguments); },
        [&](const Convert& n) { visit(*n.operand); }, [](const TypeFault&) {},
        [&](const Apply& n) { visit_all(n.operands); },
        [&](const If& n) { visit(*n.condition), visit(*n.then_branch), visit(*n.else_branch); },
        [&](const Switch& n) {
            visit(*n.subject);
            for (const auto& branch : n.cases)
                if (branch) visit(**branch);
            if (n.default_case) visit(**n.default_case);
        },
        [&](const Aggregate& n) { visit(*n.body); },
        [&](const Sample& n) { visit_all(n.parameters); },
        [&](const Discrete& n) { visit_all(n.weights); },
        [&](const DiscreteOver& n) { visit(*n.weight); },
        [&](const Determinant& n) { visit(*n.element); },
        [&](const MatrixFunction& n) { visit(*n.element); }, [](const External&) {},
        [](const RandomVector&) {});
}

// The kinds of terms that occur in an expression.
struct Occurrences {
    bool random = false;
    std::set<std::string> distributions;
    std::set<std::string> features;

    void draws(std::string distribution) {
        random = true;
        distributions.insert(std::move(distribution));
    }
};

bool is_variable_or_constant(const Expr& argument) {
    return std::holds_alternative<VariableValue>(argument.node) ||
           std::holds_alternative<Constant>(argument.node);
}

void collect(const Expr& expression, Occurrences& found) {
    const auto feature = [&](const char* name) {
        found.features.insert(name);
    };
    match(
        expression.node, [](const Constant&) {},
        [&](const VariableValue&) { feature("objects as values"); },
        [&](const Reference& n) {
            for (const Expr& argument : n.arguments)
                if (!is_variable_or_constant(argument)) feature("nested fluents");
        },
        [](const Convert&) {}, [](const TypeFault&) {}, [](const Apply&) {}, [](const If&) {},
        [&](const Switch&) { feature("switch"); },
        [&](const Aggregate& n) { found.features.insert(std::string(rddlc::name_of(n.op))); },
        [&](const Sample& n) {
            if (!is_delta(n.distribution)) found.draws(std::string(rddlc::name_of(n.distribution)));
        },
        [&](const Discrete& n) { found.draws(n.normalise ? "UnnormDiscrete" : "Discrete"); },
        [&](const DiscreteOver& n) { found.draws(n.normalise ? "UnnormDiscrete" : "Discrete"); },
        [&](const Determinant&) { feature("det"); },
        [&](const MatrixFunction&) { feature("matrix functions"); },
        [&](const External&) {
            feature("external functions");
            found.random = true;  // the function is unknown and may draw
        },
        [&](const RandomVector& n) { found.draws(std::string(rddlc::name_of(n.distribution))); });
    // An object as an argument is what RDDL is made of; only other places count.
    const bool is_reference = std::holds_alternative<Reference>(expression.node);
    for_each_operand(expression, [&](const Expr& operand) {
        if (!is_reference || !is_variable_or_constant(operand)) collect(operand, found);
    });
}

void add_declared_features(const Model& model, std::set<std::string>& features) {
    for (const Type& type : model.types)
        if (type.enumerated) features.insert("enumerated types");
    for (const Fluent& fluent : model.domain_fluents()) {
        if (fluent.role == Role::Interm) features.insert("interm-fluents");
        if (fluent.role == Role::Derived) features.insert("derived-fluents");
        if (fluent.range.kind == ValueType::Kind::Object)
            features.insert(model.types[fluent.range.type].enumerated ? "enumerated fluents"
                                                                      : "object fluents");
    }
}

void count_values(const Model& model, const Fluent& fluent, ValueKinds& kinds) {
    const std::int64_t count = model.grounding_count(fluent);
    switch (fluent.range.kind) {
        case ValueType::Kind::Bool:
            kinds.bools += count;
            break;
        case ValueType::Kind::Int:
            kinds.ints += count;
            break;
        case ValueType::Kind::Object:
            kinds.objects += count;
            break;
        case ValueType::Kind::Real:
            kinds.reals += count;
            break;
    }
}

}  // namespace

std::string ValueKinds::text() const {
    if (total() == 0) return "none";
    if (reals == 0) return "discrete";
    return reals == total() ? "continuous" : "mixed";
}

bool Characteristics::concurrent() const {
    return action.total() > 1 && (!max_nondef_actions || *max_nondef_actions > 1);
}

Characteristics characteristics_of(const Model& model) {
    Characteristics c;
    Occurrences everywhere;
    const auto is_random = [&](const Expr& expression) {
        Occurrences here;
        collect(expression, here);
        everywhere.distributions.merge(here.distributions);
        everywhere.features.merge(here.features);
        return here.random;
    };
    for (const Cpf& cpf : model.cpfs) {
        const Fluent& fluent = model.fluents[cpf.fluent];
        if (is_random(cpf.body))
            c.random_cpfs.push_back(fluent.name + (fluent.role == Role::State ? "'" : ""));
    }
    c.random_reward = is_random(model.reward);
    for (const InitialDraw& draw : model.initial_draws)
        c.random_initial_state = is_random(draw.value) || c.random_initial_state;
    for (const auto* conditions :
         {&model.action_preconditions, &model.state_invariants, &model.terminations})
        for (const Expr& condition : *conditions)
            c.random_conditions = is_random(condition) || c.random_conditions;

    for (const Fluent& fluent : model.domain_fluents()) {
        if (fluent.role == Role::State) count_values(model, fluent, c.state);
        if (fluent.role == Role::Action) count_values(model, fluent, c.action);
        if (fluent.role == Role::Observ) count_values(model, fluent, c.observation);
    }
    c.partially_observed = c.observation.total() > 0;
    if (model.max_nondef_actions && *model.max_nondef_actions < c.action.total())
        c.max_nondef_actions = model.max_nondef_actions;
    c.preconditions = static_cast<std::int64_t>(model.action_preconditions.size());
    c.invariants = static_cast<std::int64_t>(model.state_invariants.size());
    c.terminations = static_cast<std::int64_t>(model.terminations.size());
    c.distributions = std::move(everywhere.distributions);
    c.features = std::move(everywhere.features);
    add_declared_features(model, c.features);
    return c;
}

}  // namespace rddlc::workbench
