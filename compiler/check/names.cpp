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
std::string hint_for_call(const std::string& name) {
    if (function_named(name)) return fmt::format("functions take square brackets: '{}[...]'", name);
    if (reduction_named(name))
        return fmt::format("an aggregation is written '{}_{{?x : type}} ...'", name);
    return "";
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

}  // namespace

std::string hint_for_bool(std::string_view name) {
    if (name == "True" || name == "TRUE") return fmt::format("'{}' is written 'true'", name);
    if (name == "False" || name == "FALSE") return fmt::format("'{}' is written 'false'", name);
    return "";
}

void report_unknown_name(const ast::Reference& reference, Scope& scope) {
    Context& context = scope.context;
    const std::string& name = reference.name.text;
    const std::string subtraction = as_subtraction(name, context);
    const std::string call = hint_for_call(name);
    const std::string truth = hint_for_bool(name);
    const bool is_call = !call.empty() && !reference.arguments.empty();
    Diagnostic diagnostic{is_call ? round_brackets : unknown_name, reference.name.span,
                          fmt::format("'{}' is not {}", name, is_call ? "a fluent" : "declared")};
    if (!call.empty())
        diagnostic.hint = call;
    else if (!truth.empty())
        diagnostic.hint = truth;
    else if (!subtraction.empty())
        diagnostic.hint =
            fmt::format("write '{}' with blanks: '{}' is one name", subtraction, name);
    else if (name == "Gaussian" || name == "gaussian" || name == "gauss")
        diagnostic.hint = "the distribution is 'Normal(mean, variance)'";
    else if (context.names.types.contains(name))
        diagnostic.hint = fmt::format("'{}' is a type, and has no value", name);
    else
        diagnostic.hint = suggestion(context, name, [&] { return candidates(reference, context); });
    if (diagnostic.hint.empty() && scope.range && reference.arguments.empty())
        diagnostic.hint =
            fmt::format("the values of '{}' are {}", context.type(*scope.range).name,
                        fmt::join(as_literals(context.type(*scope.range).objects), ", "));
    context.report(std::move(diagnostic));
}

std::string suggestion_or_list(const Context& context, std::string_view name,
                               const std::vector<std::string>& names) {
    constexpr std::size_t most = 10;
    std::string meant = suggestion(context, name, [&] { return names; });
    if (!meant.empty() || names.empty()) return meant;
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
