#include "lsp/capabilities.hpp"
#include "lsp/reference.hpp"
#include "lsp/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rddlc::lsp {

namespace {

// "4 objects: a, b, c, d"
std::string objects_text(const std::vector<std::string_view>& objects) {
    constexpr std::size_t most = 8;
    std::string text =
        fmt::format("{} {}", objects.size(), objects.size() == 1 ? "object: " : "objects: ");
    for (std::size_t i = 0; i < std::min(most, objects.size()); ++i)
        text += fmt::format("{}`{}`", i == 0 ? "" : ", ", objects[i]);
    return text + (objects.size() > most ? ", ..." : "");
}

std::string on_fluent(const Lookup& lookup, std::string_view name) {
    const auto site = lookup.fluent(name);
    if (!site) return "";
    const FluentDeclaration& fluent = *site->declaration;
    std::string text = in_code(site->file->text.of(fluent.whole));
    if (!fluent.comment.empty()) text += "\n\n" + fluent.comment;
    const auto count = lookup.groundings_of(fluent);
    if (count && !fluent.parameters.empty())
        text += fmt::format("\n\n{:.0f} grounding{}", *count, *count == 1 ? "" : "s");
    const std::string kind = explanation_of(fluent.kind.text);
    return kind.empty() ? text : text + "\n\n" + kind;
}

std::string on_type(const Lookup& lookup, std::string_view name) {
    const auto site = lookup.type(name);
    if (!site) return "";
    std::string text = in_code(site->file->text.of(site->declaration->whole));
    if (!site->declaration->comment.empty()) text += "\n\n" + site->declaration->comment;
    if (const auto objects = lookup.objects_of(name)) text += "\n\n" + objects_text(*objects);
    return text;
}

std::string on_variable(const Lookup& lookup, const Symbol& symbol) {
    const auto& bindings = lookup.file()->outline.bindings;
    if (symbol.binding >= bindings.size()) return "";
    const std::string_view type = lookup.type_of_binding(bindings[symbol.binding]);
    if (type.empty()) return in_code(fmt::format("?{}", symbol.name));
    const std::string declared = on_type(lookup, type);
    return in_code(fmt::format("?{} : {}", symbol.name, type)) +
           (declared.empty() ? "" : "\n\n" + declared);
}

std::string on_object(const Lookup& lookup, std::string_view name) {
    const std::string_view type = lookup.type_of_object(name);
    if (type.empty()) return "";
    return in_code(fmt::format("{} : {}", name, type)) + "\n\n" + on_type(lookup, type);
}

std::string on_symbol(const Lookup& lookup, const Symbol& symbol) {
    switch (symbol.meaning) {
        case Meaning::Fluent:
            return on_fluent(lookup, symbol.name);
        case Meaning::Type:
            return on_type(lookup, symbol.name);
        case Meaning::Variable:
            return on_variable(lookup, symbol);
        case Meaning::Object:
            return on_object(lookup, symbol.name);
        case Meaning::Domain:
            return in_code(fmt::format("domain {}", symbol.name));
        case Meaning::NonFluents:
            return in_code(fmt::format("non-fluents {}", symbol.name));
        case Meaning::Instance:
            return in_code(fmt::format("instance {}", symbol.name));
        case Meaning::Policy:
            return in_code(fmt::format("policy {}", symbol.name));
        case Meaning::FluentOrObject:
            break;
    }
    return "";
}

struct Word {
    std::string_view text;
    Place place;
};

std::optional<Word> word_at(const File& file, std::uint32_t offset) {
    const char* const begin = file.text.string().data();
    for (const format::Token& token : file.outline.tokens) {
        const auto at = static_cast<std::uint32_t>(token.text.data() - begin);
        const Place place{at, at + static_cast<std::uint32_t>(token.text.size())};
        if (place.touches(offset) && is_name(token.text)) return Word{token.text, place};
    }
    return std::nullopt;
}

// The pages of the diagnostics that are shown there, each once.
std::string on_diagnostics(const File& file, std::uint32_t offset, const FileChecks& checks) {
    std::string text;
    std::set<std::string> shown;
    if (checks.version != file.version) return text;
    for (const Json& diagnostic : checks.diagnostics) {
        const std::string code = diagnostic.value("code", "");
        const auto parsed = parse_code(code);
        if (!parsed || !file.text.place(diagnostic.at("range")).touches(offset)) continue;
        if (shown.insert(code).second) text += "\n\n---\n\n" + explanation_of(*parsed);
    }
    return text;
}

}  // namespace

Json hover(const Lookup& lookup, std::uint32_t offset, const FileChecks& checks) {
    const File& file = *lookup.file();
    std::string text;
    Json range;
    if (const auto symbol = lookup.symbol_at(offset)) {
        text = on_symbol(lookup, *symbol);
        range = file.text.range(symbol->place);
    }
    const auto word = word_at(file, offset);
    if (text.empty() && word) {
        text = explanation_of(word->text);
        range = file.text.range(word->place);
    }
    text += on_diagnostics(file, offset, checks);
    if (text.empty()) return nullptr;
    Json result = {{"contents", {{"kind", "markdown"}, {"value", text}}}};
    if (!range.is_null()) result["range"] = range;
    return result;
}

}  // namespace rddlc::lsp
