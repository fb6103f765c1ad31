// Names and variables of expressions.
#include "lsp/outline_reader.hpp"

#include <algorithm>

namespace rddlc::lsp {

void OutlineReader::read_expression(std::size_t at, std::size_t end) {
    // Binders first, so that every variable finds its own.
    for (std::size_t i = at; i < end; ++i)
        if (word(i) == "_" && word(i + 1) == "{") read_binder(i + 1, end);
    for (std::size_t i = at; i < end; ++i) {
        if (word(i).starts_with('?') && word(i).size() > 1)
            read_variable(i);
        else if (word(i).starts_with('@'))
            note(Meaning::Object, i);
        else if (is_name_at(i))
            read_name(i, end);
    }
}

void OutlineReader::read_name(std::size_t at, std::size_t end) {
    const std::string_view before = at > 0 ? word(at - 1) : "";
    const std::string_view next = at + 1 < end ? word(at + 1) : "";
    const bool is_type = (before == ":" && at > 1 && word(at - 2).starts_with('?')) ||
                         (before == "(" && at > 1 && word(at - 2).ends_with("Discrete"));
    if (is_type) return note(Meaning::Type, at);
    const bool is_function = next == "[" || (next == "_" && word(at + 2) == "{") || before == "$";
    if (is_function) return;
    const bool is_fluent = next == "(" || word(at).ends_with('\'');
    note(is_fluent ? Meaning::Fluent : Meaning::FluentOrObject, at);
}

// _{?x : t, ?y : u}; the bindings reach to the end of what follows.
std::size_t OutlineReader::read_binder(std::size_t open, std::size_t end) {
    const std::size_t close = closing(open, end);
    const std::size_t body_end = end_of_body(close + 1, end);
    const Place scope = {place(open).begin, body_end > 0 ? place(body_end - 1).end : 0};
    for (std::size_t i = open + 1; i < close; ++i) {
        if (!word(i).starts_with('?')) continue;
        const bool has_type = word(i + 1) == ":" && is_name_at(i + 2);
        outline_.bindings.push_back({name(i), has_type ? word(i + 2) : std::string_view(), scope});
    }
    return close;
}

// A construct with an open right end takes all that follows, as far as the brackets, the list or
// the 'if' around it.
std::size_t OutlineReader::end_of_body(std::size_t at, std::size_t end) const {
    std::size_t depth = 0;
    std::size_t ifs = 0;
    for (; at < end; ++at) {
        const std::string_view mark = word(at);
        if (mark == "(" || mark == "[" || mark == "{") ++depth;
        if ((mark == ")" || mark == "]" || mark == "}") && depth-- == 0) return at;
        if (depth > 0) continue;
        if (mark == "," || mark == ";") return at;
        if (mark == "if") ++ifs;
        if (mark == "else" && ifs-- == 0) return at;
    }
    return end;
}

void OutlineReader::read_variable(std::size_t at) {
    const Name variable = name(at);
    std::size_t innermost = outline_.bindings.size();
    for (std::size_t i = first_binding_; i < outline_.bindings.size(); ++i) {
        const Binding& binding = outline_.bindings[i];
        const bool is_bound =
            binding.variable.text == variable.text && binding.scope.contains(variable.place);
        if (!is_bound) continue;
        const bool is_inner = innermost == outline_.bindings.size() ||
                              outline_.bindings[innermost].scope.contains(binding.scope);
        if (is_inner) innermost = i;
    }
    const bool declares = innermost < outline_.bindings.size() &&
                          outline_.bindings[innermost].variable.place == variable.place;
    outline_.occurrences.push_back({Meaning::Variable, variable, declares, innermost});
}

}  // namespace rddlc::lsp
