// Conditional probability functions: one for each fluent that has no value of its own.
#include "check/definitions.hpp"
#include "check/expressions.hpp"
#include "check/types.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace rddlc::checking {
namespace {

Definition definition_of(Role role) {
    switch (role) {
        case Role::Derived:
            return Definition::Derived;
        case Role::Interm:
            return Definition::Interm;
        case Role::Observ:
            return Definition::Observ;
        case Role::State:
        case Role::NonFluent:
        case Role::Action:
            break;
    }
    return Definition::NextState;
}

Definition policy_definition_of(Role role) {
    if (role == Role::Action) return Definition::PolicyAction;
    return role == Role::Derived ? Definition::PolicyDerived : Definition::PolicyState;
}

std::string name_of_cpf(const ast::Cpf& cpf) {
    return cpf.name.text + (cpf.primed ? "'" : "");
}

// Checks the CPFs of the domain, or of the policy.
class CpfChecker {
  public:
    // `keyword` is that of the section.
    CpfChecker(Context& context, std::vector<model::Cpf>& cpfs, bool of_policy, Span keyword)
        : context_(context), cpfs_(cpfs), of_policy_(of_policy), keyword_(keyword) {}

    void check(const ast::Cpf& cpf) {
        const model::FluentId* id = find(context_.names.fluents, cpf.name.text);
        if (!id) return report_undeclared(cpf);
        const model::Fluent& fluent = context_.fluent(*id);
        const bool first = defined_.try_emplace(*id, cpf.name.span).second;
        if (context_.names.broken_fluents.contains(*id)) return;
        bool sound = check_written(cpf, *id);
        if (sound && !first) {
            context_.report(diagnose(repeated_cpf, cpf.name.span,
                                     fmt::format("'{}' has a CPF already", name_of_cpf(cpf)))
                                .note(defined_[*id], "defined here"));
            sound = false;
        }
        if (check_parameter_count(cpf, fluent)) check_definition(cpf, *id, sound);
    }

    void report_missing() const {
        for (model::FluentId id = 0; id < context_.model.fluents.size(); ++id) {
            const model::Fluent& fluent = context_.fluent(id);
            const bool broken = context_.names.broken_fluents.contains(id);
            if (broken || !needs_cpf(id)) continue;
            if (defined_.contains(id) || meant_.contains(id)) continue;
            const std::string name = written_name(fluent, fluent.role == Role::State);
            const bool is_for_others = of_policy_ && !context_.model.is_of_policy(id);
            context_.report(
                diagnose(missing_cpf, is_for_others ? context_.model.policy->span : fluent.span,
                         fmt::format("{} '{}' has no CPF{}", name_of(fluent.role), fluent.name,
                                     of_policy_ ? " in the policy" : ""))
                    .with_hint({fmt::format("define it in 'cpfs {{ ... }};': {} = ...", name),
                                added_cpf(fluent)}));
        }
    }

    std::vector<CpfUses> uses() && { return std::move(uses_); }

  private:
    bool needs_cpf(model::FluentId id) const {
        const Role role = context_.fluent(id).role;
        if (!of_policy_) return role != Role::NonFluent && role != Role::Action;
        return context_.model.is_of_policy(id) ? role != Role::NonFluent : role == Role::Action;
    }

    // A state-fluent that keeps its value, at the beginning of the cpfs.
    std::vector<Replacement> added_cpf(const model::Fluent& fluent) const {
        if (fluent.role != Role::State || keyword_.end == 0) return {};
        const auto open = mark_behind(keyword_, '{', context_);
        if (!open) return {};
        std::string variables;
        for (std::size_t i = 0; i < fluent.parameters.size(); ++i)
            variables += fmt::format("{}?x{}", i == 0 ? "" : ", ", i + 1);
        if (!variables.empty()) variables = fmt::format("({})", variables);
        return {{point_behind(*open),
                 fmt::format("\n        {0}'{1} = {0}{1};", fluent.name, variables)}};
    }

    std::string_view why_no_cpf(model::FluentId id) const {
        const Role role = context_.fluent(id).role;
        if (context_.model.is_of_policy(id)) return "its default is its value";
        if (role == Role::NonFluent) return "the instance gives its value";
        return of_policy_ ? "the domain gives it one" : "the agent chooses its value";
    }

    void report_undeclared(const ast::Cpf& cpf) {
        const auto meant =
            name_meant(context_, cpf.name.text, [&] { return keys(context_.names.fluents); });
        if (meant) meant_.insert(context_.names.fluents.at(*meant));
        context_.report(
            diagnose(undeclared_cpf, cpf.name.span,
                     fmt::format("'{}' is not declared in 'pvariables'", cpf.name.text))
                .with_hint(hint_of_name(meant, without_prime(cpf.name.span, cpf.primed))));
    }

    // Whether a CPF may be written like this for this fluent.
    bool check_written(const ast::Cpf& cpf, model::FluentId id) {
        const model::Fluent& fluent = context_.fluent(id);
        if (!needs_cpf(id)) {
            context_.report(
                diagnose(cpf_not_allowed, cpf.name.span,
                         fmt::format("{} '{}' cannot have a CPF{}: {}", name_of(fluent.role),
                                     fluent.name, of_policy_ ? " in a policy" : "", why_no_cpf(id)))
                    .note(fluent.span, "declared here"));
            return false;
        }
        if (fluent.role == Role::State && !cpf.primed) {
            context_.report(
                diagnose(forgotten_prime, cpf.name.span,
                         fmt::format("the CPF of state-fluent '{0}' defines its next "
                                     "value '{0}''",
                                     fluent.name))
                    .note(fluent.span, "declared here")
                    .with_hint({fmt::format("you forgot a prime: {}'{} = ...", fluent.name,
                                            cpf.parameters.empty() ? "" : "(...)"),
                                {{point_behind(cpf.name.span), "'"}}}));
            return false;
        }
        if (fluent.role != Role::State && cpf.primed) {
            context_.report(
                diagnose(misplaced_prime, cpf.name.span,
                         fmt::format("'{}' is {}: only state-fluents have a next value",
                                     fluent.name, with_article(fluent.role)))
                    .note(fluent.span, "declared here")
                    .with_hint({fmt::format("write '{}' without the prime", fluent.name),
                                {{cpf.name.span, fluent.name}}}));
            return false;
        }
        return true;
    }

    bool check_parameter_count(const ast::Cpf& cpf, const model::Fluent& fluent) {
        const std::size_t expected = fluent.parameters.size();
        if (cpf.parameters.size() == expected) return true;
        std::vector<std::string> types;
        for (const model::TypeId type : fluent.parameters)
            types.push_back(context_.type(type).name);
        const std::string list = types.empty() ? "" : fmt::format(" ({})", fmt::join(types, ", "));
        context_.report(
            diagnose(wrong_cpf_arity, cpf.name.span,
                     fmt::format("'{}' has {}{}, found {}", name_of_cpf(cpf),
                                 counted(expected, "parameter"), list, cpf.parameters.size()))
                .note(fluent.span, "declared here"));
        return false;
    }

    // The body is checked for errors of its own even if the CPF does not count.
    void check_definition(const ast::Cpf& cpf, model::FluentId id, bool counts) {
        Scope scope{context_};
        const model::ValueType range = context_.fluent(id).range;
        if (is_object(range) && context_.type(range.type).enumerated) scope.range = range.type;
        std::vector<model::VariableId> parameters;
        for (std::size_t i = 0; i < cpf.parameters.size(); ++i) {
            const auto variable = bind(cpf.parameters[i], context_.fluent(id).parameters[i], scope);
            if (variable) parameters.push_back(*variable);
        }
        Typed body = check_body(cpf, id, scope);
        if (!counts) return;
        const Role role = context_.fluent(id).role;
        check_dependencies(of_policy_ ? policy_definition_of(role) : definition_of(role),
                           fmt::format("'{}'", name_of_cpf(cpf)), scope.fluent_uses, context_);
        if (!body || parameters.size() < cpf.parameters.size())
            body = model::Expr{context_.fluent(id).range, cpf.span, model::Constant{false}};
        uses_.push_back({cpfs_.size(), std::move(scope.fluent_uses)});
        cpfs_.push_back({id, std::move(parameters), std::move(*body), cpf.span});
    }

    Typed check_body(const ast::Cpf& cpf, model::FluentId id, Scope& scope) {
        const auto* vector = std::get_if<ast::RandomVector>(&cpf.body.node);
        Typed body = vector ? check_random_vector(*vector, cpf.body.span, scope)
                            : check_expression(cpf.body, scope);
        const model::Fluent& fluent = context_.fluent(id);
        return require(std::move(body),
                       {fluent.range, fmt::format("the value of '{}'", name_of_cpf(cpf)),
                        wrong_cpf_type, Note{fluent.span, "declared here"}},
                       scope);
    }

    Context& context_;
    std::vector<model::Cpf>& cpfs_;
    bool of_policy_;
    Span keyword_;
    std::unordered_map<model::FluentId, Span> defined_;  // where
    std::unordered_set<model::FluentId> meant_;          // by misspelled names
    std::vector<CpfUses> uses_;
};

}  // namespace

std::vector<CpfUses> check_cpfs(const Blocks& blocks, Context& context) {
    if (!blocks.cpfs) return {};
    CpfChecker checker(context, context.model.cpfs, false, blocks.cpfs->keyword.span);
    for (const ast::Cpf& cpf : blocks.cpfs->definitions) checker.check(cpf);
    checker.report_missing();
    return std::move(checker).uses();
}

std::vector<CpfUses> check_policy_cpfs(const Blocks& blocks, Context& context) {
    const Span keyword = blocks.policy_cpfs ? blocks.policy_cpfs->keyword.span : Span{};
    CpfChecker checker(context, context.model.policy->cpfs, true, keyword);
    if (blocks.policy_cpfs)
        for (const ast::Cpf& cpf : blocks.policy_cpfs->definitions) checker.check(cpf);
    checker.report_missing();
    return std::move(checker).uses();
}

}  // namespace rddlc::checking
