#include "lsp/capabilities.hpp"
#include "lsp/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc::lsp {

namespace {

// Variables and values may begin with a digit behind their mark.
bool is_name_for(const Symbol& symbol, std::string_view name) {
    const bool has_mark = symbol.meaning == Meaning::Variable;
    return is_name(has_mark ? "x" + std::string(name) : name) && !name.empty();
}

bool has_binding(const Lookup& lookup, std::string_view name, Place scope) {
    return std::ranges::any_of(lookup.file()->outline.bindings, [&](const Binding& binding) {
        return binding.variable.text == name &&
               (scope.contains(binding.scope) || binding.scope.contains(scope));
    });
}

// A variable cannot have the name of another one around it or within; other names are of
// everything.
bool is_taken(const Lookup& lookup, const Symbol& symbol, const std::string& name) {
    if (symbol.meaning == Meaning::Variable) {
        const auto& bindings = lookup.file()->outline.bindings;
        return symbol.binding < bindings.size() &&
               has_binding(lookup, name, bindings[symbol.binding].scope);
    }
    const bool is_type = symbol.meaning == Meaning::Type;
    if (is_type) return lookup.type(name).has_value();
    const bool is_value = symbol.meaning == Meaning::Fluent || symbol.meaning == Meaning::Object;
    return is_value && (lookup.fluent(name) || !lookup.type_of_object(name).empty());
}

Symbol symbol_to_rename(const Lookup& lookup, std::uint32_t offset) {
    const auto symbol = lookup.symbol_at(offset);
    if (!symbol) throw Refusal("only names can be renamed");
    return *symbol;
}

}  // namespace

Json prepare_rename(const Lookup& lookup, std::uint32_t offset) {
    const auto symbol = lookup.symbol_at(offset);
    if (!symbol) return Json();
    return {{"range", lookup.file()->text.range(symbol->place)}, {"placeholder", symbol->name}};
}

Json rename(const Lookup& lookup, std::uint32_t offset, std::string name) {
    const Symbol symbol = symbol_to_rename(lookup, offset);
    // Users may type the mark.
    if (name.starts_with('?') || name.starts_with('@')) name.erase(0, 1);
    if (!is_name_for(symbol, name)) throw Refusal(fmt::format("'{}' is no name in RDDL", name));
    const bool has_mark = symbol.meaning == Meaning::Variable;
    if (!has_mark && is_reserved(name))
        throw Refusal(fmt::format("'{}' is a reserved word and cannot be a name", name));
    if (name == symbol.name) return {{"changes", Json::object()}};
    if (is_taken(lookup, symbol, name)) throw Refusal(fmt::format("'{}' is there already", name));
    Json changes = Json::object();
    for (const Site& site : lookup.sites_of(symbol, false))
        changes[site.file->uri].push_back(
            {{"range", site.file->text.range(site.place)}, {"newText", name}});
    return {{"changes", changes}};
}

}  // namespace rddlc::lsp
