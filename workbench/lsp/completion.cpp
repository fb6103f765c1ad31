// The words that may stand at the cursor: by the block, the section and the words before it, so
// that the text need not be whole.
#include "lsp/capabilities.hpp"
#include "lsp/completion_place.hpp"
#include "lsp/reference.hpp"
#include "vocabulary/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rddlc::lsp {

namespace {

// Numbers of the protocol's CompletionItemKind.
constexpr int a_function = 3, a_fluent = 5, a_variable = 6, a_type = 7, a_block = 9, a_value = 12,
              a_keyword = 14, a_snippet = 15, a_constant = 21;
constexpr int snippet_format = 2;

struct Form {
    std::string_view label;
    std::string_view snippet;
};

constexpr Form blocks[] = {
    {"domain",
     "domain ${1:name} {\n    types { ${2:t} : object; };\n\n    pvariables {\n        $0\n    "
     "};\n\n    cpfs {\n    };\n\n    reward = 0.0;\n}"},
    {"non-fluents", "non-fluents ${1:name} {\n    domain = ${2:domain};\n    objects { $0 };\n}"},
    {"instance",
     "instance ${1:name} {\n    domain = ${2:domain};\n    non-fluents = ${3:non_fluents};\n    "
     "init-state { $0 };\n    horizon = 40;\n    discount = 1.0;\n}"},
    {"policy", "policy ${1:name} {\n    cpfs {\n        $0\n    };\n}"},
};
constexpr Form domain_sections[] = {
    {"types", "types {\n    $0\n};"},
    {"pvariables", "pvariables {\n    $0\n};"},
    {"cpfs", "cpfs {\n    $0\n};"},
    {"reward", "reward = $0;"},
    {"termination", "termination {\n    $0\n};"},
    {"action-preconditions", "action-preconditions {\n    $0\n};"},
    {"state-invariants", "state-invariants {\n    $0\n};"},
    {"requirements", "requirements = { $0 };"},
};
constexpr Form non_fluents_sections[] = {
    {"domain", "domain = $0;"},
    {"objects", "objects {\n    $0\n};"},
    {"non-fluents", "non-fluents {\n    $0\n};"},
};
constexpr Form instance_sections[] = {
    {"domain", "domain = $0;"},
    {"non-fluents", "non-fluents = $0;"},
    {"init-state", "init-state {\n    $0\n};"},
    {"max-nondef-actions", "max-nondef-actions = ${0:pos-inf};"},
    {"horizon", "horizon = ${0:40};"},
    {"discount", "discount = ${0:1.0};"},
    {"objects", "objects {\n    $0\n};"},
};
constexpr Form expressions[] = {
    {"if", "if ($1) then $2 else $0"},
    {"switch", "switch ($1) { case @$2 : $3, default : $0 }"},
    {"Discrete", "Discrete(${1:type}, @${2:a} : $0)"},
    {"true", "true"},
    {"false", "false"},
};

class Completion {
  public:
    Completion(const Lookup& lookup, const CompletionPlace& place, Standard standard)
        : lookup_(lookup),
          place_(place),
          standard_(standard),
          range_(lookup.file()->text.range(place.replaced)) {}

    Json items() {
        add_all();
        return {{"isIncomplete", items_.size() == most_items}, {"items", std::move(items_)}};
    }

  private:
    static constexpr std::size_t most_items = 500;

    void add_all() {
        switch (place_.kind) {
            case CompletionPlace::Kind::Nothing:
                return;
            case CompletionPlace::Kind::Variable:
                return add_variables();
            case CompletionPlace::Kind::Value:
                return add_values("@");
            case CompletionPlace::Kind::Block:
                return add_forms(blocks, a_block);
            case CompletionPlace::Kind::DomainSection:
                return add_forms(domain_sections, a_keyword);
            case CompletionPlace::Kind::NonFluentsSection:
                return add_forms(non_fluents_sections, a_keyword);
            case CompletionPlace::Kind::InstanceSection:
                return add_forms(instance_sections, a_keyword);
            case CompletionPlace::Kind::BlockName:
                return add_block_names();
            case CompletionPlace::Kind::TypeForm:
                return add("object", a_keyword, "", "");
            case CompletionPlace::Kind::Type:
                return add_types();
            case CompletionPlace::Kind::FluentKind:
                return add_kinds();
            case CompletionPlace::Kind::Range:
                for (const char* const word : {"bool", "int", "real"}) add(word, a_keyword, "", "");
                return add_types();
            case CompletionPlace::Kind::Attribute:
                add("default", a_keyword, "default = $0", "");
                return;
            case CompletionPlace::Kind::Definition:
                return add_definitions();
            case CompletionPlace::Kind::Assignment:
                return add_settable();
            case CompletionPlace::Kind::Argument:
                return add_objects(place_.word);
            case CompletionPlace::Kind::Constant:
                return add_constants();
            case CompletionPlace::Kind::Expression:
                return add_expressions();
        }
    }

    void add(std::string_view label, int kind, std::string_view snippet, std::string_view detail,
             std::string_view documentation = {}) {
        if (items_.size() == most_items || !may_match(label)) return;
        if (!labels_.insert(std::string(label)).second) return;
        const std::string text(snippet.empty() ? label : snippet);
        Json item = {{"label", label}, {"kind", kind}};
        // The edit says what is replaced: '-' is no part of a word for most editors.
        item["textEdit"] = {{"range", range_}, {"newText", text}};
        if (text.find('$') != text.npos) item["insertTextFormat"] = snippet_format;
        if (!detail.empty()) item["detail"] = detail;
        if (!documentation.empty())
            item["documentation"] = {{"kind", "markdown"}, {"value", documentation}};
        items_.push_back(std::move(item));
    }

    // Whether the letters typed so far occur in the label, in that order.
    bool may_match(std::string_view label) const {
        std::size_t at = 0;
        for (const char c : place_.text) {
            const auto same = [&](char other) {
                return std::tolower(static_cast<unsigned char>(other)) ==
                       std::tolower(static_cast<unsigned char>(c));
            };
            while (at < label.size() && !same(label[at])) ++at;
            if (at++ >= label.size()) return false;
        }
        return true;
    }

    template <std::size_t n>
    void add_forms(const Form (&forms)[n], int kind) {
        for (const Form& form : forms)
            add(form.label, kind, form.snippet, "", explanation_of(form.label));
    }

    // ------------------------------------------------------------------------ declared names

    void add_types() {
        for (const TypeSite& type : lookup_.types())
            add(type.declaration->name.text, a_type, "", "", type.declaration->comment);
    }

    void add_kinds() {
        for (const char* const kind : {"state-fluent", "action-fluent", "non-fluent",
                                       "interm-fluent", "observ-fluent", "derived-fluent"})
            add(kind, a_keyword, "", "", explanation_of(kind));
    }

    void add_block_names() {
        const bool wants_domain = place_.word == "domain";
        for (const FilePtr& file : wants_domain ? lookup_.domains_around() : lookup_.files())
            for (const Block& block : file->outline.blocks)
                if (block.kind == (wants_domain ? Meaning::Domain : Meaning::NonFluents))
                    add(block.name.text, a_block, "", file->path.filename().string());
    }

    static std::string detail_of(const FluentDeclaration& fluent) {
        return fmt::format("{}, {}", fluent.kind.text, fluent.range.text);
    }

    // "p(${1:?x}, ${2:?y})": variables of the right types where some are in scope.
    std::string call_of(const FluentDeclaration& fluent, std::string_view name) const {
        if (fluent.parameters.empty()) return std::string(name);
        std::string text = std::string(name) + "(";
        for (std::size_t i = 0; i < fluent.parameters.size(); ++i)
            text += fmt::format("{}${{{}:{}}}", i == 0 ? "" : ", ", i + 1,
                                argument_for(fluent.parameters[i].text));
        return text + ")";
    }

    std::string argument_for(std::string_view type) const {
        for (const Binding* binding : bindings_in_scope())
            if (lookup_.type_of_binding(*binding) == type)
                return fmt::format("?{}", binding->variable.text);
        return fmt::format("?{}", type.substr(0, 1));
    }

    void add_fluents() {
        for (const FluentSite& site : lookup_.fluents()) {
            const FluentDeclaration& fluent = *site.declaration;
            const std::string name(fluent.name.text);
            add(name, a_fluent, call_of(fluent, name), detail_of(fluent), fluent.comment);
            if (fluent.kind.text == "state-fluent")
                add(name + "'", a_fluent, call_of(fluent, name + "'"), "next value",
                    fluent.comment);
        }
    }

    // Fluents without a CPF come first.
    void add_definitions() {
        for (const FluentSite& site : lookup_.fluents()) {
            const FluentDeclaration& fluent = *site.declaration;
            const std::string_view kind = fluent.kind.text;
            const bool has_none = kind == "non-fluent" || kind == "action-fluent";
            if (has_none != place_.in_policy) continue;
            const std::string name =
                std::string(fluent.name.text) + (kind == "state-fluent" ? "'" : "");
            std::string parameters;
            for (std::size_t i = 0; i < fluent.parameters.size(); ++i)
                parameters +=
                    fmt::format("{}?{}", i == 0 ? "" : ", ", variable_for(fluent.parameters, i));
            if (!parameters.empty()) parameters = fmt::format("({})", parameters);
            add(name, a_fluent, fmt::format("{}{} = $0;", name, parameters), detail_of(fluent),
                fluent.comment);
        }
    }

    // The first letter of the type; with a number if several have it.
    static std::string variable_for(const std::vector<Name>& types, std::size_t index) {
        const std::string_view letter = types[index].text.substr(0, 1);
        const auto same = std::ranges::count_if(
            types, [&](const Name& type) { return type.text.substr(0, 1) == letter; });
        return same == 1 ? std::string(letter) : fmt::format("{}{}", letter, index + 1);
    }

    void add_settable() {
        const bool is_state = place_.word == "init-state";
        for (const FluentSite& site : lookup_.fluents()) {
            const FluentDeclaration& fluent = *site.declaration;
            if (fluent.kind.text != (is_state ? "state-fluent" : "non-fluent")) continue;
            std::string text(fluent.name.text);
            for (std::size_t i = 0; i < fluent.parameters.size(); ++i)
                text += fmt::format("{}${{{}:{}}}", i == 0 ? "(" : ", ", i + 1,
                                    fluent.parameters[i].text);
            if (!fluent.parameters.empty()) text += ")";
            text += fluent.range.text == "bool" ? ";" : " = $0;";
            add(fluent.name.text, a_fluent, text, detail_of(fluent), fluent.comment);
        }
    }

    void add_objects(std::string_view type) {
        const auto objects = lookup_.objects_of(type);
        if (!objects) return;
        for (const std::string_view object : *objects) add(object, a_value, "", type);
    }

    // Values of enumerated types.
    void add_values(std::string_view mark) {
        for (const TypeSite& type : lookup_.types()) {
            if (!type.declaration->members) continue;
            for (const Name& member : *type.declaration->members)
                add(fmt::format("{}{}", mark, member.text), a_value, "",
                    type.declaration->name.text);
        }
    }

    void add_constants() {
        if (place_.word == "bool") {
            add("true", a_constant, "", "");
            add("false", a_constant, "", "");
        }
        const auto type = lookup_.type(place_.word);
        if (!type) return;
        if (!type->declaration->members) return add_objects(place_.word);
        for (const Name& member : *type->declaration->members)
            add(fmt::format("@{}", member.text), a_value, "", place_.word);
    }

    // --------------------------------------------------------------------------- expressions

    std::vector<const Binding*> bindings_in_scope() const {
        std::vector<const Binding*> bindings;
        for (const Binding& binding : lookup_.file()->outline.bindings)
            if (binding.scope.touches(place_.replaced.begin)) bindings.push_back(&binding);
        return bindings;
    }

    void add_variables() {
        for (const Binding* binding : bindings_in_scope()) {
            const std::string_view type = lookup_.type_of_binding(*binding);
            add(fmt::format("?{}", binding->variable.text), a_variable, "", type);
        }
    }

    void add_expressions() {
        add_variables();
        add_fluents();
        add_values("@");
        add_forms(expressions, a_snippet);
        for (const std::string& name : reduction_names())
            add(name, a_function, fmt::format("{}_{{?${{1:x}} : ${{2:type}}}} $0", name), "",
                explanation_of(name));
        for (const std::string& name : function_names()) add_function(name);
        for (const std::string& name : distribution_names()) add_distribution(name);
    }

    // "log[x, base]" as a snippet.
    static std::string as_snippet(std::string form) {
        const std::size_t open = form.find_first_of("[(");
        if (open == form.npos) return form;
        std::string text = form.substr(0, open + 1);
        const std::string inside = form.substr(open + 1, form.size() - open - 2);
        int number = 0;
        for (std::size_t at = 0; at < inside.size();) {
            const std::size_t end = std::min(inside.find(", ", at), inside.size());
            text += fmt::format("{}${{{}:{}}}", number == 0 ? "" : ", ", number + 1,
                                inside.substr(at, end - at));
            ++number;
            at = end + 2;
        }
        return text + form.back();
    }

    void add_function(const std::string& name) {
        const Operator function = *function_named(name);
        if (is_extension(function) && standard_ == Standard::PyRddlGym) return;
        // "min" is also an aggregation.
        const std::string label = labels_.contains(name) ? name + "[]" : name;
        add(label, a_function, as_snippet(form_of(function)), form_of(function),
            explanation_of(name));
    }

    void add_distribution(const std::string& name) {
        const Distribution distribution = *distribution_named(name);
        if (is_extension(distribution) && standard_ == Standard::PyRddlGym) return;
        add(name, a_function, as_snippet(form_of(distribution)), form_of(distribution),
            explanation_of(name));
    }

    const Lookup& lookup_;
    const CompletionPlace& place_;
    Standard standard_;
    Json range_;
    Json items_ = Json::array();
    std::set<std::string> labels_;
};

}  // namespace

Json completion(const Lookup& lookup, std::uint32_t offset, Standard standard) {
    const CompletionPlace place = completion_place(lookup, offset);
    return Completion(lookup, place, standard).items();
}

}  // namespace rddlc::lsp
