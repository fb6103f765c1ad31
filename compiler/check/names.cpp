#include "check/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rddlc::checking {
namespace {

bool is_value(const std::string& word, const Context& context) {
    const bool number =
        !word.empty() && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
    return number || context.names.fluents.contains(word) || context.names.objects.contains(word);
}

// "a - b" for "a-b" if both sides mean something; otherwise nothing.
std::string as_subtraction(const std::string& name, const Context& context) {
    std::string every = name.substr(0, name.find('-'));
    bool all_known = is_value(every, context) && every.size() < name.size();
    for (std::size_t minus = name.find('-'); minus != std::string::npos;) {
        const std::string left = name.substr(0, minus);
        const std::string right = name.substr(minus + 1);
        if (is_value(left, context) && is_value(right, context)) return left + " - " + right;
        const std::size_t next = name.find('-', minus + 1);
        const std::string word = name.substr(minus + 1, next - minus - 1);
        all_known = all_known && is_value(word, context);
        every += " - " + word;
        minus = next;
    }
    return all_known ? every : "";
}

// A call written with the wrong brackets, or a distribution in lower case.
Hint hint_for_call(const std::string& name, Span place, Span whole, const Context& context) {
    if (function_named(name))
        return {fmt::format("functions take square brackets: '{}[...]'", name),
                other_brackets(place, whole, "[]", context)};
    if (reduction_named(name))
        return fmt::format("an aggregation is written '{}_{{?x : type}} ...'", name);
    return {};
}

std::vector<std::string> candidates(const ast::Reference& reference, const Context& context) {
    std::vector<std::string> names = keys(context.names.fluents);
    if (reference.arguments.empty()) {
        const std::vector<std::string> members = enumerated_members(context);
        names.insert(names.end(), members.begin(), members.end());
        return names;
    }
    const std::vector<std::string> distributions = distribution_names();
    names.insert(names.end(), distributions.begin(), distributions.end());
    return names;
}

Hint hint_for_unknown_name(const ast::Reference& reference, Span whole, const Scope& scope) {
    const Context& context = scope.context;
    const std::string& name = reference.name.text;
    const Span place = without_prime(reference.name.span, reference.primed);
    if (Hint call = hint_for_call(name, place, whole, context); !call.text.empty()) return call;
    if (Hint truth = hint_for_bool(name, place); !truth.text.empty()) return truth;
    if (const std::string subtraction = as_subtraction(name, context); !subtraction.empty())
        return {fmt::format("write '{}' with blanks: '{}' is one name", subtraction, name),
                {{place, subtraction}}};
    if (name == "Gaussian" || name == "gaussian" || name == "gauss")
        return {"the distribution is 'Normal(mean, variance)'", {{place, "Normal"}}};
    if (context.names.types.contains(name))
        return fmt::format("'{}' is a type, and has no value", name);
    Hint near = suggestion(context, name, place, [&] { return candidates(reference, context); });
    if (!near.text.empty() || !scope.range || !reference.arguments.empty()) return near;
    return fmt::format("the values of '{}' are {}", context.type(*scope.range).name,
                       fmt::join(as_literals(context.type(*scope.range).objects), ", "));
}

}  // namespace

Hint hint_for_bool(std::string_view name, Span place) {
    if (name == "True" || name == "TRUE")
        return {fmt::format("'{}' is written 'true'", name), {{place, "true"}}};
    if (name == "False" || name == "FALSE")
        return {fmt::format("'{}' is written 'false'", name), {{place, "false"}}};
    return {};
}

void report_unknown_name(const ast::Reference& reference, Span whole, Scope& scope) {
    const std::string& name = reference.name.text;
    const bool is_call =
        !reference.arguments.empty() && (function_named(name) || reduction_named(name));
    scope.context.report(
        diagnose(is_call ? round_brackets : unknown_name, reference.name.span,
                 fmt::format("'{}' is not {}", name, is_call ? "a fluent" : "declared"))
            .with_hint(hint_for_unknown_name(reference, whole, scope)));
}

Hint suggestion_or_list(const Context& context, std::string_view name, Span place,
                        const std::vector<std::string>& names) {
    constexpr std::size_t most = 10;
    Hint meant = suggestion(context, name, place, [&] { return names; });
    if (!meant.text.empty() || names.empty()) return meant;
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most));
    return fmt::format("there {} {}{}", names.size() == 1 ? "is" : "are",
                       fmt::join(names.begin(), end, ", "),
                       names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

std::vector<std::string> as_literals(std::vector<std::string> names) {
    for (std::string& name : names) name.insert(0, "@");
    return names;
}

std::vector<std::string> enumerated_members(const Context& context) {
    std::vector<std::string> members;
    for (const model::Type& type : context.model.types)
        if (type.enumerated)
            members.insert(members.end(), type.objects.begin(), type.objects.end());
    return members;
}

}  // namespace rddlc::checking
