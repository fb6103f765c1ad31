// Rules of dependence, cycles, and the order of evaluation.
#include "check/definitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>
#include <utility>

namespace rddlc::checking {
namespace {

// ------------------------------------------------------------------------------ the rules

// The fluents that a definition may mention besides non-fluents; for a policy's, those of the
// domain, where state stands for what it observes.
struct Rule {
    Definition definition;
    std::string_view title;  // "a derived-fluent"
    bool state, action, interm, derived, next;
};

constexpr std::array rules = {
    Rule{Definition::Derived, "a derived-fluent", true, false, false, true, false},
    Rule{Definition::Interm, "an interm-fluent", true, true, true, true, false},
    Rule{Definition::NextState, "the next state", true, true, true, true, true},
    Rule{Definition::Observ, "an observ-fluent", false, true, true, true, true},
    Rule{Definition::Reward, "the reward", true, true, true, true, true},
    Rule{Definition::ActionPrecondition, "a precondition of the action", true, true, false, false,
         false},
    Rule{Definition::StateInvariant, "a state-invariant", true, false, false, false, false},
    Rule{Definition::Termination, "a termination condition", true, false, false, false, false},
    Rule{Definition::InitialValue, "an initial value", false, false, false, false, false},
    Rule{Definition::PolicyAction, "an action of the policy", true, true, false, false, false},
    Rule{Definition::PolicyDerived, "a derived-fluent of the policy", true, false, false, false,
         false},
    Rule{Definition::PolicyState, "the policy's next state", true, true, false, false, false},
};

const Rule& rule_of(Definition definition) {
    return rules[static_cast<std::size_t>(definition)];
}

bool is_of_policy(Definition definition) {
    return definition >= Definition::PolicyAction;
}

bool is_partially_observed(const model::Model& model) {
    return std::ranges::any_of(
        model.fluents, [](const model::Fluent& fluent) { return fluent.role == Role::Observ; });
}

// A policy sees the observation if there is one, and nothing of the step that follows.
bool policy_allows(const Rule& rule, const FluentUse& use, const model::Model& model) {
    const Role role = model.fluents[use.fluent].role;
    if (role == Role::NonFluent) return true;
    if (model.is_of_policy(use.fluent))
        return !use.next || rule.definition == Definition::PolicyState;
    if (role == Role::Action) return rule.action;
    const Role seen = is_partially_observed(model) ? Role::Observ : Role::State;
    return role == seen && !use.next;
}

bool allows(const Rule& rule, const FluentUse& use, const model::Model& model) {
    if (is_of_policy(rule.definition)) return policy_allows(rule, use, model);
    const bool next = use.next;
    switch (model.fluents[use.fluent].role) {
        case Role::NonFluent:
            return true;
        case Role::State:
            return next ? rule.next : rule.state;
        case Role::Action:
            return rule.action;
        case Role::Interm:
            return rule.interm;
        case Role::Derived:
            return rule.derived;
        case Role::Observ:
            break;
    }
    return false;
}

std::string allowed_to_policy(const Rule& rule, const model::Model& model) {
    std::vector<std::string> words{"non-fluents"};
    words.emplace_back(is_partially_observed(model) ? "observ-fluents" : "state-fluents");
    if (rule.action) words.emplace_back("action-fluents");
    words.emplace_back("what the policy declares");
    return joined(words);
}

std::string allowed_list(const Rule& rule, const model::Model& model) {
    if (is_of_policy(rule.definition)) return allowed_to_policy(rule, model);
    std::vector<std::string> words{"non-fluents"};
    if (rule.state) words.emplace_back("state-fluents");
    if (rule.action) words.emplace_back("action-fluents");
    if (rule.derived) words.emplace_back("derived-fluents");
    if (rule.interm) words.emplace_back("interm-fluents");
    if (rule.next) words.emplace_back("next-state fluents");
    return joined(words);
}

std::string role_of(const model::Fluent& fluent, bool next) {
    return next ? "a next-state fluent" : with_article(fluent.role);
}

std::string hint_for(const Rule& rule, const FluentUse& use, const model::Model& model) {
    const model::Fluent& fluent = model.fluents[use.fluent];
    const bool next = use.next;
    const std::string allowed =
        fmt::format("{} may depend on {}", rule.title, allowed_list(rule, model));
    if (rule.definition == Definition::StateInvariant && fluent.role == Role::Action)
        return fmt::format("move it to 'action-preconditions', which may depend on actions: {}",
                           allowed);
    if (rule.definition == Definition::Termination && fluent.role == Role::Action)
        return fmt::format("store in a state-fluent what the action does, and test that: {}",
                           allowed);
    if (rule.definition == Definition::Observ && fluent.role == Role::State && !next)
        return fmt::format("write '{}'': {}", fluent.name, allowed);
    if (next && rule.state && !is_of_policy(rule.definition))
        return fmt::format("write '{}' without the prime: {}", fluent.name, allowed);
    return allowed;
}

// --------------------------------------------------------------------------------- cycles

struct Edge {
    std::size_t to;  // a CPF
    Span span;       // where it is mentioned
};
// The CPFs that each CPF mentions, each once.
using Graph = std::vector<std::vector<Edge>>;

Graph build_graph(const std::vector<model::Cpf>& cpfs, const std::vector<CpfUses>& all_uses,
                  const Context& context) {
    std::unordered_map<model::FluentId, std::size_t> cpf_of;
    for (std::size_t i = 0; i < cpfs.size(); ++i) cpf_of[cpfs[i].fluent] = i;
    Graph graph(cpfs.size());
    for (const CpfUses& entry : all_uses) {
        std::set<std::size_t> seen;
        for (const FluentUse& use : entry.uses) {
            const auto target = cpf_of.find(use.fluent);
            // The CPF of a state-fluent defines its next value only.
            const bool computed = use.next || context.fluent(use.fluent).role != Role::State;
            const bool edge = target != cpf_of.end() && computed;
            if (edge && seen.insert(target->second).second)
                graph[entry.cpf].push_back({target->second, use.span});
        }
    }
    return graph;
}

constexpr int no_level = -1;

// 0 without dependencies, else 1 + the largest level below; no_level on cycles and behind them.
std::vector<int> levels_of(const Graph& graph) {
    std::vector<std::vector<std::size_t>> users(graph.size());
    std::vector<std::size_t> open(graph.size());  // dependencies without a level yet
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        open[i] = graph[i].size();
        for (const Edge& edge : graph[i]) users[edge.to].push_back(i);
        if (graph[i].empty()) ready.push_back(i);
    }
    std::vector<int> levels(graph.size(), no_level);
    while (!ready.empty()) {
        const std::size_t cpf = ready.back();
        ready.pop_back();
        int level = 0;
        for (const Edge& edge : graph[cpf]) level = std::max(level, levels[edge.to] + 1);
        levels[cpf] = level;
        for (const std::size_t user : users[cpf])
            if (--open[user] == 0) ready.push_back(user);
    }
    return levels;
}

std::string cpf_name(const model::Cpf& cpf, const Context& context) {
    const model::Fluent& fluent = context.fluent(cpf.fluent);
    return written_name(fluent, fluent.role == Role::State);
}

// Steps of a cycle: each CPF mentions the next one's fluent, the last the first's.
void report_cycle(const std::vector<model::Cpf>& cpfs, const std::vector<Span>& mentions,
                  Context& context) {
    std::string path = cpf_name(cpfs.front(), context);
    for (std::size_t i = 1; i < cpfs.size(); ++i) path += " -> " + cpf_name(cpfs[i], context);
    path += " -> " + cpf_name(cpfs.front(), context);
    // The span of the whole CPF would underline its body.
    Diagnostic diagnostic{
        cyclic_cpfs, mentions.back(),
        fmt::format("'{}' depends on itself: {}", cpf_name(cpfs.front(), context), path)};
    for (std::size_t i = 0; i < cpfs.size(); ++i)
        diagnostic.notes.push_back(
            {mentions[i], fmt::format("'{}' needs '{}'", cpf_name(cpfs[i], context),
                                      cpf_name(cpfs[(i + 1) % cpfs.size()], context))});
    const bool has_arguments = std::ranges::any_of(cpfs, [&](const model::Cpf& cpf) {
        return !context.fluent(cpf.fluent).parameters.empty();
    });
    if (has_arguments)
        diagnostic.hint = "dependencies are between fluents, whatever their arguments";
    context.report(std::move(diagnostic));
}

// Walks along dependencies without a level until a CPF comes again: that is a cycle.
void report_cycles(const std::vector<model::Cpf>& cpfs, const Graph& graph,
                   const std::vector<int>& levels, Context& context) {
    std::vector<bool> visited(graph.size(), false);
    for (std::size_t start = 0; start < graph.size(); ++start) {
        std::vector<std::size_t> path;
        std::vector<Span> mentions;
        std::size_t cpf = start;
        while (levels[cpf] == no_level && !visited[cpf]) {
            visited[cpf] = true;
            path.push_back(cpf);
            const Edge& next = *std::ranges::find_if(
                graph[cpf], [&](const Edge& edge) { return levels[edge.to] == no_level; });
            mentions.push_back(next.span);
            cpf = next.to;
        }
        const auto first = std::ranges::find(path, cpf);
        if (first == path.end()) continue;
        const auto skipped = first - path.begin();
        std::vector<model::Cpf> cycle;
        for (auto step = first; step != path.end(); ++step) cycle.push_back(cpfs[*step]);
        report_cycle(cycle, {mentions.begin() + skipped, mentions.end()}, context);
    }
}

}  // namespace

void check_dependencies(Definition definition, const std::string& what,
                        const std::vector<FluentUse>& uses, Context& context) {
    const Rule& rule = rule_of(definition);
    std::set<std::pair<model::FluentId, bool>> reported;
    for (const FluentUse& use : uses) {
        const model::Fluent& fluent = context.fluent(use.fluent);
        if (allows(rule, use, context.model)) continue;
        if (!reported.insert({use.fluent, use.next}).second) continue;
        context.report(
            diagnose(illegal_dependency, use.span,
                     fmt::format("{} may not depend on '{}', {}", what,
                                 written_name(fluent, use.next), role_of(fluent, use.next)))
                .note(fluent.span, "declared here")
                .with_hint(hint_for(rule, use, context.model)));
    }
}

void order_cpfs(std::vector<model::Cpf>& cpfs, const std::vector<CpfUses>& uses, Context& context) {
    const Graph graph = build_graph(cpfs, uses, context);
    const std::vector<int> levels = levels_of(graph);
    report_cycles(cpfs, graph, levels, context);

    std::vector<std::size_t> order(graph.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t cpf) {
        return std::pair(levels[cpf], cpf_name(cpfs[cpf], context));
    });
    std::vector<model::Cpf> sorted;
    sorted.reserve(order.size());
    for (const std::size_t cpf : order) sorted.push_back(std::move(cpfs[cpf]));
    cpfs = std::move(sorted);
}

}  // namespace rddlc::checking
