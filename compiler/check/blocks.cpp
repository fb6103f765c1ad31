// Over 400 lines: a choice and its warnings for each kind of block.
#include "check/blocks.hpp"

#include "check/check.hpp"
#include "support/match.hpp"

#include <fmt/format.h>

#include <algorithm>
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
void choose(Last<T>& last, const T& node, Span span, std::string_view what, Context& context,
            std::string hint = "") {
    if (last.node)
        context.report(diagnose(repeated_section, last.span,
                                fmt::format("this '{}' is ignored: a later one replaces it", what))
                           .note(span, "the one that counts")
                           .with_hint(std::move(hint)));
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

// The origin of objects and non-fluents: a block of their own, or an instance of the 2018 form.
using Origin = std::variant<const ast::NonFluents*, const ast::Instance*>;

struct TopLevel {
    Last<ast::Domain> domain;
    Last<ast::Instance> instance;
    Last<ast::Policy> policy;
    std::vector<Origin> origins;  // all that are written
    std::optional<Origin> origin;
};

std::string hint_for_instances(const Last<ast::Instance>& last, const ast::Instance& next) {
    if (!last.node || last.node->name.text == next.name.text) return "";
    return fmt::format("'--instance {}' picks it", last.node->name.text);
}

TopLevel choose_blocks_of(const ast::Program& program, Context& context) {
    TopLevel chosen;
    for (const ast::Block& block : program.blocks)
        match(
            block,
            [&](const ast::Domain& n) { choose(chosen.domain, n, n.span, "domain", context); },
            [&](const ast::Policy& n) { choose(chosen.policy, n, n.span, "policy", context); },
            [&](const ast::NonFluents& n) { chosen.origins.emplace_back(&n); },
            [&](const ast::Instance& n) {
                choose(chosen.instance, n, n.span, "instance", context,
                       hint_for_instances(chosen.instance, n));
                if (has_non_fluents(n)) chosen.origins.emplace_back(&n);
            });
    return chosen;
}

const ast::Name* name_given_by(const Last<ast::Instance>& instance) {
    return instance.node ? named_non_fluents(*instance.node) : nullptr;
}

bool is_block_named(const Origin& origin, const ast::Name* name) {
    const auto* block = std::get_if<const ast::NonFluents*>(&origin);
    return name && block && (*block)->name.text == name->text;
}

bool is_of_other_instance(const Origin& origin, const ast::Instance* instance) {
    const auto* other = std::get_if<const ast::Instance*>(&origin);
    return other && *other != instance;
}

// The origin that the instance names or holds itself, otherwise any; the last of several.
std::optional<Origin> choose_origin(const TopLevel& top) {
    const ast::Name* name = name_given_by(top.instance);
    const bool is_there = std::ranges::any_of(
        top.origins, [&](const Origin& origin) { return is_block_named(origin, name); });
    std::optional<Origin> any, chosen;
    for (const Origin& origin : top.origins) {
        any = origin;
        const bool is_other_block = std::holds_alternative<const ast::NonFluents*>(origin) &&
                                    is_there && !is_block_named(origin, name);
        if (!is_other_block && !is_of_other_instance(origin, top.instance.node)) chosen = origin;
    }
    return chosen ? chosen : any;
}

// pyRDDLGym takes the last of all, whatever the instance names.
void warn_of_ignored_non_fluents(const TopLevel& top, Context& context) {
    const ast::Name* name = name_given_by(top.instance);
    const Span counts = std::visit([](const auto* block) { return block->span; }, *top.origin);
    for (const Origin& origin : top.origins) {
        const auto* block = std::get_if<const ast::NonFluents*>(&origin);
        if (!block || origin == *top.origin) continue;
        const bool by_name = is_block_named(*top.origin, name) && !is_block_named(origin, name);
        const std::string why = by_name ? fmt::format("the instance names '{}'", name->text)
                                : std::holds_alternative<const ast::Instance*>(*top.origin)
                                    ? std::string("the instance has non-fluents of its own")
                                    : "a later one replaces it";
        const bool is_last = origin == top.origins.back();
        context.report(diagnose(repeated_section, (*block)->span,
                                fmt::format("this 'non-fluents' is ignored: {}", why))
                           .note(counts, "the one that counts")
                           .with_hint(is_last
                                          ? "pyRDDLGym takes this one, as it is the last: write "
                                            "the one that counts behind it"
                                          : ""));
    }
}

// True if there.
template <class T>
bool require_section(const Last<T>& last, std::string_view section, std::string_view block,
                     Span block_span, Hint hint, Context& context) {
    if (last.node) return true;
    context.report(
        diagnose(missing_section, block_span, fmt::format("the {} has no '{}'", block, section))
            .with_hint(std::move(hint)));
    return false;
}

// "add 'horizon = 40;'", on a line of its own before the end of the block.
Hint hint_to_add(std::string_view section, std::string_view why, Span block,
                 const Context& context) {
    const std::string_view text = context.sources.text(block);
    const std::size_t closing = text.rfind('}');
    const bool stands_alone =
        text.substr(0, closing).find_last_not_of(" \t") == text.substr(0, closing).rfind('\n');
    const auto at = static_cast<std::uint32_t>(block.begin + closing);
    return {fmt::format("add '{}'{}", section, why),
            {{{block.file, at, at}, fmt::format("{}    {}\n", stands_alone ? "" : "\n", section)}}};
}

void warn_of_other_domain(const Last<ast::DomainName>& named, const ast::Domain& domain,
                          Context& context) {
    if (!named.node || named.node->name.text == domain.name.text) return;
    context.report(diagnose(other_domain, named.node->name.span,
                            fmt::format("this is for domain '{}', but the domain is '{}'",
                                        named.node->name.text, domain.name.text))
                       .note(domain.name.span, "the domain")
                       .fixed_by(named.node->name.span, domain.name.text));
}

void warn_of_other_non_fluents(const Last<ast::NonFluentsName>& named, const ast::Name& taken,
                               Context& context) {
    if (!named.node || named.node->name.text == taken.text) return;
    context.report(diagnose(other_non_fluents, named.node->name.span,
                            fmt::format("this names the non-fluents '{}', but they are '{}'",
                                        named.node->name.text, taken.text))
                       .note(taken.span, "the non-fluents")
                       .fixed_by(named.node->name.span, taken.text));
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

// The objects of the non-fluents block, else those of the instance.
const ast::Objects* choose_objects(const ast::NonFluents& block, const Last<ast::Objects>& own,
                                   const Last<ast::Objects>& of_instance, Context& context) {
    if (!of_instance.node) return own.node;
    Diagnostic diagnostic =
        own.node ? diagnose(ignored_objects, of_instance.span,
                            "these objects are ignored: objects come from the non-fluents block")
                 : diagnose(assumed_non_fluents, of_instance.span,
                            "the non-fluents block has no 'objects': these are taken")
                       .with_hint("pyRDDLGym takes objects from the non-fluents block alone");
    context.report(std::move(diagnostic).note(block.name.span, "the non-fluents block"));
    return own.node ? own.node : of_instance.node;
}

void warn_of_no_non_fluents(const ast::Instance& instance, Context& context) {
    const ast::Name* name = named_non_fluents(instance);
    context.report(
        diagnose(assumed_non_fluents, name ? name->span : instance.name.span,
                 fmt::format("there is no non-fluents block{}: it is read as an empty one",
                             name ? fmt::format(" '{}'", name->text) : ""))
            .with_hint(fmt::format("pyRDDLGym needs one: 'non-fluents {} {{ domain = ...; objects "
                                   "{{ ... }}; }}'",
                                   name ? name->text : "NAME")));
}

// `sections` are the instance's own.
void take_non_fluents(const TopLevel& top, const InstanceSections& sections, Blocks& blocks,
                      Context& context) {
    if (!top.origin) {
        if (!blocks.instance) return;
        warn_of_no_non_fluents(*blocks.instance, context);
        blocks.objects = sections.objects.node;
        return;
    }
    warn_of_ignored_non_fluents(top, context);
    match(
        *top.origin,
        [&](const ast::NonFluents* block) {
            const InstanceSections own = choose_sections(block->sections, context);
            blocks.objects = choose_objects(*block, own.objects, sections.objects, context);
            blocks.non_fluents = own.non_fluents.node;
            warn_of_other_domain(own.domain, *blocks.domain, context);
            warn_of_other_non_fluents(sections.non_fluents_name, block->name, context);
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
                            hint_to_add(fmt::format("domain = {};", blocks.domain->name.text), "",
                                        instance->span, context),
                            context);
            blocks.objects = own.objects.node;
            blocks.non_fluents = own.non_fluents.node;
        });
}

void take_instance(const ast::Instance& instance, const TopLevel& top, Blocks& blocks,
                   Context& context) {
    const InstanceSections sections = choose_sections(instance.sections, context);
    require_section(
        sections.horizon, "horizon", "instance", instance.name.span,
        hint_to_add("horizon = 40;", ", the number of steps of an episode", instance.span, context),
        context);
    require_section(sections.discount, "discount", "instance", instance.name.span,
                    hint_to_add("discount = 1.0;", "", instance.span, context), context);
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

// ".0" behind the number of 'discount = 1;'.
std::vector<Replacement> added_point(Span section, const Context& context) {
    const std::string_view text = context.sources.text(section);
    const auto end =
        static_cast<std::uint32_t>(section.begin + text.find_last_of("0123456789") + 1);
    return {{{section.file, end, end}, ".0"}};
}

void check_discount(const ast::Discount& discount, Span span, Context& context) {
    const auto* whole = std::get_if<ast::Integer>(&discount.value);
    if (whole && context.standard == Standard::PyRddlGym)
        context.report(diagnose(extension_needed, span, "the discount is a number with a point")
                           .with_hint({fmt::format("write {}.0; {}", whole->value, extension_hint),
                                       added_point(span, context)}));
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
    TopLevel top = choose_blocks_of(program, context);
    top.origin = choose_origin(top);
    // Each of them, so that all are reported.
    const bool domain = require_block(top.domain.node != nullptr, "domain",
                                      "give the domain's file before the instance's", context);
    const bool is_enough = domain && !context.needs_instance;
    const bool instance = require_block(is_enough || top.instance.node != nullptr, "instance",
                                        "give the instance's file after the domain's", context);
    if (!domain || !instance) return std::nullopt;

    Blocks blocks;
    take_domain(*top.domain.node, blocks, context);
    if (top.policy.node) take_policy(*top.policy.node, blocks, context);
    blocks.has_objects = top.instance.node || top.origin;
    if (top.instance.node)
        take_instance(*top.instance.node, top, blocks, context);
    else
        take_non_fluents(top, {}, blocks, context);
    context.model.domain_name = blocks.domain->name.text;
    if (blocks.instance) context.model.instance_name = blocks.instance->name.text;
    if (!blocks.pvariables) return std::nullopt;
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
