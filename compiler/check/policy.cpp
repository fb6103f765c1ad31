#include "check/policy.hpp"

#include "check/types.hpp"
#include "check/walk.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

namespace rddlc::checking {
namespace {

constexpr std::array allowed_kinds = {
    std::string_view{"non-fluent"},
    std::string_view{"param-fluent"},
    std::string_view{"derived-fluent"},
    std::string_view{"state-fluent"},
};

class PolicyChecker {
  public:
    explicit PolicyChecker(Context& context) : context_(context) {}

    void check(const ast::Policy& policy) {
        const ast::PVariables* variables = nullptr;
        const ast::Cpfs* cpfs = nullptr;
        for (const ast::DomainSection& section : policy.sections) {
            variables = keep_last(variables, std::get_if<ast::PVariables>(&section.node));
            cpfs = keep_last(cpfs, std::get_if<ast::Cpfs>(&section.node));
            if (const auto* types = std::get_if<ast::Types>(&section.node);
                types && !types->declarations.empty())
                report(section.span, "a policy cannot declare types");
        }
        if (variables)
            for (const ast::PVariable& declaration : variables->declarations) declare(declaration);
        if (cpfs)
            for (const ast::Cpf& cpf : cpfs->definitions) check_cpf(cpf);
        report_missing(policy.name.span);
    }

  private:
    template <class T>
    static const T* keep_last(const T* last, const T* next) {
        return next ? next : last;
    }

    void report(Span span, std::string message) {
        context_.report({bad_policy, span, std::move(message)});
    }

    void declare(const ast::PVariable& declaration) {
        const std::string& name = declaration.name.text;
        const std::string& kind = declaration.kind.text;
        if (context_.names.fluents.contains(name))
            report(declaration.name.span,
                   fmt::format("'{}' is declared in the domain already", name));
        if (!declared_.try_emplace(name, &declaration).second)
            report(declaration.name.span, fmt::format("'{}' is declared twice", name));
        if (std::ranges::find(allowed_kinds, kind) == allowed_kinds.end())
            report(declaration.kind.span, fmt::format("a policy cannot declare {}s", kind));
        else if (kind != "derived-fluent" && !declaration.default_value)
            report(declaration.name.span, fmt::format("'{}' needs a default", name));
        for (const ast::Name& parameter : declaration.parameters) resolve_type(parameter, context_);
    }

    // The number of parameters, if the policy may define it.
    std::optional<std::size_t> parameters_of(const ast::Cpf& cpf) const {
        const std::string& name = cpf.name.text;
        if (const auto own = declared_.find(name); own != declared_.end())
            return own->second->parameters.size();
        const model::FluentId* id = find(context_.names.fluents, name);
        if (id && context_.fluent(*id).role == Role::Action)
            return context_.fluent(*id).parameters.size();
        return std::nullopt;
    }

    void check_cpf(const ast::Cpf& cpf) {
        const std::string& name = cpf.name.text;
        const std::optional<std::size_t> parameters = parameters_of(cpf);
        if (!parameters)
            report(
                cpf.name.span,
                fmt::format("'{}' is neither an action-fluent nor declared in the policy", name));
        else if (*parameters != cpf.parameters.size())
            report(cpf.name.span,
                   fmt::format("'{}' has {}, found {}", name, counted(*parameters, "parameter"),
                               cpf.parameters.size()));
        if (!defined_.insert(written(name, cpf.primed)).second)
            report(cpf.name.span, fmt::format("'{}' has a CPF already", name));
        check_names(cpf.body);
    }

    void check_names(const ast::Expr& expression) {
        if (const auto* reference = std::get_if<ast::Reference>(&expression.node))
            if (!is_known(reference->name.text))
                context_.report({unknown_name, reference->name.span,
                                 fmt::format("'{}' is not declared", reference->name.text)});
        for_each_child(expression, [&](const ast::Expr& child) { check_names(child); });
    }

    bool is_known(const std::string& name) const {
        return declared_.contains(name) || context_.names.fluents.contains(name) ||
               context_.names.objects.contains(name);
    }

    void report_missing(Span policy) {
        for (const model::Fluent& fluent : context_.model.fluents)
            if (fluent.role == Role::Action && !defined_.contains(fluent.name))
                report(policy,
                       fmt::format("the policy has no CPF for action-fluent '{}'", fluent.name));
        for (const auto& [name, declaration] : declared_) {
            const bool state = declaration->kind.text == "state-fluent";
            const bool needs_cpf = state || declaration->kind.text == "derived-fluent";
            if (needs_cpf && !defined_.contains(written(name, state)))
                report(declaration->name.span,
                       fmt::format("'{}' has no CPF", written(name, state)));
        }
    }

    static std::string written(const std::string& name, bool primed) {
        return primed ? name + "'" : name;
    }

    Context& context_;
    std::unordered_map<std::string, const ast::PVariable*> declared_;
    std::unordered_set<std::string> defined_;
};

}  // namespace

void check_policy(const Blocks& blocks, Context& context) {
    if (blocks.policy) PolicyChecker(context).check(*blocks.policy);
}

}  // namespace rddlc::checking
