#include "check/blocks.hpp"

#include "support/match.hpp"

#include <fmt/format.h>

#include <iterator>
#include <variant>

namespace rddlc::checking {
namespace {

// A section or block of which only the last counts.
template <class T>
struct Last {
    const T* node = nullptr;
    Span span = {};
};

template <class T>
void choose(Last<T>& last, const T& node, Span span, std::string_view what, Context& context) {
    if (last.node)
        context.report(diagnose(repeated_section, last.span,
                                fmt::format("this '{}' is ignored: a later one replaces it", what))
                           .note(span, "the one that counts"));
    last = {&node, span};
}

struct DomainSections {
    Last<ast::DomainName> domain;
    Last<ast::Requirements> requirements;
    Last<ast::Types> types;
    Last<ast::PVariables> pvariables;
    Last<ast::Cpfs> cpfs;
    Last<ast::Reward> reward;
    Last<ast::Constraints> constraints[4];  // by ast::ConstraintKind
};

constexpr std::string_view constraint_names[] = {"termination", "action-preconditions",
                                                 "state-action-constraints", "state-invariants"};

DomainSections choose_sections(const std::vector<ast::DomainSection>& sections, Context& context) {
    DomainSections chosen;
    for (const ast::DomainSection& section : sections) {
        const Span span = section.span;
        match(
            section.node,
            [&](const ast::DomainName& n) { choose(chosen.domain, n, span, "domain", context); },
            [&](const ast::Requirements& n) {
                choose(chosen.requirements, n, span, "requirements", context);
            },
            [&](const ast::Types& n) { choose(chosen.types, n, span, "types", context); },
            [&](const ast::PVariables& n) {
                choose(chosen.pvariables, n, span, "pvariables", context);
            },
            [&](const ast::Cpfs& n) { choose(chosen.cpfs, n, span, "cpfs", context); },
            [&](const ast::Reward& n) { choose(chosen.reward, n, span, "reward", context); },
            [&](const ast::Constraints& n) {
                const auto kind = static_cast<std::size_t>(n.kind);
                choose(chosen.constraints[kind], n, span, constraint_names[kind], context);
            });
    }
    return chosen;
}

struct InstanceSections {
    Last<ast::DomainName> domain;
    Last<ast::NonFluentsName> non_fluents_name;
    Last<ast::Objects> objects;
    Last<ast::NonFluentValues> non_fluents;
    Last<ast::InitState> init_state;
    Last<ast::MaxNondefActions> max_nondef_actions;
    Last<ast::Horizon> horizon;
    Last<ast::Discount> discount;
};

InstanceSections choose_sections(const std::vector<ast::InstanceSection>& sections,
                                 Context& context) {
    InstanceSections chosen;
    for (const ast::InstanceSection& section : sections) {
        const Span span = section.span;
        match(
            section.node,
            [&](const ast::DomainName& n) { choose(chosen.domain, n, span, "domain", context); },
            [&](const ast::NonFluentsName& n) {
                choose(chosen.non_fluents_name, n, span, "non-fluents", context);
            },
            [&](const ast::Objects& n) { choose(chosen.objects, n, span, "objects", context); },
            [&](const ast::NonFluentValues& n) {
                choose(chosen.non_fluents, n, span, "non-fluents", context);
            },
            [&](const ast::InitState& n) {
                choose(chosen.init_state, n, span, "init-state", context);
            },
            [&](const ast::MaxNondefActions& n) {
                choose(chosen.max_nondef_actions, n, span, "max-nondef-actions", context);
            },
            [&](const ast::Horizon& n) { choose(chosen.horizon, n, span, "horizon", context); },
            [&](const ast::Discount& n) { choose(chosen.discount, n, span, "discount", context); });
    }
    return chosen;
}

bool has_non_fluents(const ast::Instance& instance) {
    for (const ast::InstanceSection& section : instance.sections)
        if (std::holds_alternative<ast::NonFluentValues>(section.node)) return true;
    return false;
}

struct TopLevel {
    Last<ast::Domain> domain;
    Last<ast::Instance> instance;
    Last<ast::Policy> policy;
    // Where objects and non-fluents come from: a block of its own, or an instance of the 2018
    // form. Whichever stands last.
    std::variant<std::monostate, const ast::NonFluents*, const ast::Instance*> non_fluents;
};

TopLevel choose_blocks_of(const ast::Program& program, Context& context) {
    TopLevel chosen;
    Last<ast::NonFluents> non_fluents;
    for (const ast::Block& block : program.blocks)
        match(
            block,
            [&](const ast::Domain& n) { choose(chosen.domain, n, n.span, "domain", context); },
            [&](const ast::Policy& n) { choose(chosen.policy, n, n.span, "policy", context); },
            [&](const ast::NonFluents& n) {
                choose(non_fluents, n, n.span, "non-fluents", context);
                chosen.non_fluents = &n;
            },
            [&](const ast::Instance& n) {
                choose(chosen.instance, n, n.span, "instance", context);
                if (has_non_fluents(n)) chosen.non_fluents = &n;
            });
    return chosen;
}

// True if there.
template <class T>
bool require_section(const Last<T>& last, std::string_view section, std::string_view block,
                     Span block_span, std::string_view hint, Context& context) {
    if (last.node) return true;
    context.report(
        diagnose(missing_section, block_span, fmt::format("the {} has no '{}'", block, section))
            .with_hint(std::string(hint)));
    return false;
}

void warn_of_other_domain(const Last<ast::DomainName>& named, const ast::Domain& domain,
                          Context& context) {
    if (!named.node || named.node->name.text == domain.name.text) return;
    context.report(diagnose(other_domain, named.node->name.span,
                            fmt::format("this is for domain '{}', but the domain is '{}'",
                                        named.node->name.text, domain.name.text))
                       .note(domain.name.span, "the domain"));
}

void warn_of_other_non_fluents(const Last<ast::NonFluentsName>& named, const ast::Name& taken,
                               Context& context) {
    if (!named.node || named.node->name.text == taken.text) return;
    context.report(diagnose(other_non_fluents, named.node->name.span,
                            fmt::format("this names the non-fluents '{}', but they are '{}'",
                                        named.node->name.text, taken.text))
                       .note(taken.span, "the non-fluents"));
}

void take_domain(const ast::Domain& domain, Blocks& blocks, Context& context) {
    const DomainSections sections = choose_sections(domain.sections, context);
    require_section(sections.pvariables, "pvariables", "domain", domain.name.span,
                    "declare its fluents in 'pvariables { ... };'", context);
    require_section(sections.cpfs, "cpfs", "domain", domain.name.span,
                    "define the next state in 'cpfs { ... };'", context);
    require_section(sections.reward, "reward", "domain", domain.name.span,
                    "add 'reward = ...;' after the cpfs", context);
    blocks.domain = &domain;
    blocks.types = sections.types.node;
    blocks.pvariables = sections.pvariables.node;
    blocks.cpfs = sections.cpfs.node;
    blocks.reward = sections.reward.node;
    blocks.terminations = sections.constraints[0].node;
    blocks.action_preconditions = sections.constraints[1].node;
    blocks.state_action_constraints = sections.constraints[2].node;
    blocks.state_action_constraints_span = sections.constraints[2].span;
    blocks.state_invariants = sections.constraints[3].node;
}

// A policy is a domain's pvariables and cpfs; an empty section of types does no harm.
void report_foreign_sections(const DomainSections& sections, Context& context) {
    const auto report = [&](const auto& last, std::string_view what) {
        if (last.node)
            context.report(
                diagnose(bad_policy, last.span, fmt::format("a policy has no '{}'", what))
                    .with_hint("it has 'pvariables' and 'cpfs'"));
    };
    report(sections.requirements, "requirements");
    report(sections.reward, "reward");
    for (std::size_t kind = 0; kind < std::size(constraint_names); ++kind)
        report(sections.constraints[kind], constraint_names[kind]);
    if (sections.types.node && !sections.types.node->declarations.empty())
        context.report({bad_policy, sections.types.span, "a policy cannot declare types"});
}

void take_policy(const ast::Policy& policy, Blocks& blocks, Context& context) {
    const DomainSections sections = choose_sections(policy.sections, context);
    report_foreign_sections(sections, context);
    warn_of_other_domain(sections.domain, *blocks.domain, context);
    blocks.policy = &policy;
    blocks.policy_pvariables = sections.pvariables.node;
    blocks.policy_cpfs = sections.cpfs.node;
}

// `sections` are the instance's own.
void take_non_fluents(const TopLevel& top, const InstanceSections& sections, Blocks& blocks,
                      Context& context) {
    match(
        top.non_fluents, [](std::monostate) {},
        [&](const ast::NonFluents* block) {
            const InstanceSections own = choose_sections(block->sections, context);
            blocks.objects = own.objects.node;
            blocks.non_fluents = own.non_fluents.node;
            warn_of_other_domain(own.domain, *blocks.domain, context);
            warn_of_other_non_fluents(sections.non_fluents_name, block->name, context);
            if (sections.objects.node)
                context.report(
                    diagnose(ignored_objects, sections.objects.span,
                             "these objects are ignored: objects come from the non-fluents block")
                        .note(block->name.span, "the non-fluents block"));
        },
        [&](const ast::Instance* instance) {
            const InstanceSections own = instance == blocks.instance
                                             ? sections
                                             : choose_sections(instance->sections, context);
            require_section(own.objects, "objects", "instance", instance->name.span,
                            "an instance with non-fluents of its own lists its objects too: "
                            "'objects { type : {a, b}; };'",
                            context);
            require_section(own.domain, "domain", "instance", instance->name.span,
                            fmt::format("add 'domain = {};'", blocks.domain->name.text), context);
            blocks.objects = own.objects.node;
            blocks.non_fluents = own.non_fluents.node;
        });
}

void take_instance(const ast::Instance& instance, const TopLevel& top, Blocks& blocks,
                   Context& context) {
    const InstanceSections sections = choose_sections(instance.sections, context);
    require_section(sections.horizon, "horizon", "instance", instance.name.span,
                    "add 'horizon = 40;', the number of steps of an episode", context);
    require_section(sections.discount, "discount", "instance", instance.name.span,
                    "add 'discount = 1.0;'", context);
    warn_of_other_domain(sections.domain, *blocks.domain, context);
    blocks.instance = &instance;
    blocks.init_state = sections.init_state.node;
    blocks.max_nondef_actions = sections.max_nondef_actions.node;
    blocks.max_nondef_actions_span = sections.max_nondef_actions.span;
    blocks.horizon = sections.horizon.node;
    blocks.horizon_span = sections.horizon.span;
    blocks.discount = sections.discount.node;
    blocks.discount_span = sections.discount.span;
    take_non_fluents(top, sections, blocks, context);
}

bool require_block(bool present, std::string_view block, std::string_view hint, Context& context) {
    if (present) return true;
    context.report(diagnose(missing_block, {}, fmt::format("there is no {} block", block))
                       .with_hint(std::string(hint)));
    return false;
}

void check_horizon(const ast::Horizon& horizon, Span span, Context& context) {
    constexpr std::string_view hint =
        "give the number of steps, and end episodes earlier with "
        "'termination { ... };' in the domain";
    match(
        horizon.value,
        [&](const ast::Integer& steps) {
            context.model.horizon = steps.value;
            if (steps.value < 0)
                context.report({unsupported_horizon, span, "the horizon must not be negative"});
        },
        [&](const ast::PosInf&) {
            context.model.horizon = 0;
            if (context.standard == Standard::Rddlc) return;
            context.report(diagnose(unsupported_horizon, span, "the horizon must be finite")
                               .with_hint(fmt::format("{}; {}", hint, extension_hint)));
        },
        [&](const ast::Expr&) {
            context.report(diagnose(unsupported_horizon, span, "'terminate-when' is not supported")
                               .with_hint(std::string(hint)));
        });
}

void check_discount(const ast::Discount& discount, Span span, Context& context) {
    const auto* whole = std::get_if<ast::Integer>(&discount.value);
    if (whole && context.standard == Standard::PyRddlGym)
        context.report(diagnose(extension_needed, span, "the discount is a number with a point")
                           .with_hint(fmt::format("write {}.0; {}", whole->value, extension_hint)));
    context.model.discount =
        whole ? static_cast<double>(whole->value) : std::get<ast::Real>(discount.value).value;
    if (context.model.discount > 1)
        context.report({large_discount, span,
                        "a discount above 1 makes later rewards count more than earlier ones"});
}

void check_action_limit(std::int64_t limit, Span span, Context& context) {
    context.model.max_nondef_actions = limit;
    std::int64_t actions = 0;
    for (const model::Fluent& fluent : context.model.fluents)
        if (fluent.role == Role::Action) actions += context.model.grounding_count(fluent);
    if (limit > actions)
        context.report(diagnose(idle_action_limit, span,
                                fmt::format("the limit of {} non-default actions has no effect: "
                                            "there are only {}",
                                            limit, actions))
                           .with_hint("'pos-inf' says that there is no limit"));
}

}  // namespace

std::optional<Blocks> choose_blocks(const ast::Program& program, Context& context) {
    const TopLevel top = choose_blocks_of(program, context);
    const bool has_non_fluents_block = top.non_fluents.index() != 0;
    // Each of them, so that all are reported.
    const bool domain = require_block(top.domain.node != nullptr, "domain",
                                      "give the domain's file before the instance's", context);
    const bool is_enough = domain && !context.needs_instance;
    const bool instance = require_block(is_enough || top.instance.node != nullptr, "instance",
                                        "give the instance's file after the domain's", context);
    const bool non_fluents = require_block(is_enough || !instance || has_non_fluents_block, "non-fluents",
                                           "write 'non-fluents NAME { domain = ...; objects { ... "
                                           "}; }', or put both 'objects { ... };'"
                                           " and 'non-fluents { ... };' into the instance",
                                           context);
    if (!domain || !instance) return std::nullopt;

    Blocks blocks;
    take_domain(*top.domain.node, blocks, context);
    if (top.policy.node) take_policy(*top.policy.node, blocks, context);
    blocks.has_objects = has_non_fluents_block;
    if (top.instance.node)
        take_instance(*top.instance.node, top, blocks, context);
    else
        take_non_fluents(top, {}, blocks, context);
    context.model.domain_name = blocks.domain->name.text;
    if (blocks.instance) context.model.instance_name = blocks.instance->name.text;
    // Without objects every fluent would be complained about.
    if (!non_fluents || !blocks.pvariables) return std::nullopt;
    return blocks;
}

void check_settings(const Blocks& blocks, Context& context) {
    if (blocks.horizon) check_horizon(*blocks.horizon, blocks.horizon_span, context);
    if (blocks.discount) check_discount(*blocks.discount, blocks.discount_span, context);
    if (blocks.max_nondef_actions && blocks.max_nondef_actions->value)
        check_action_limit(*blocks.max_nondef_actions->value, blocks.max_nondef_actions_span,
                           context);
}

}  // namespace rddlc::checking
