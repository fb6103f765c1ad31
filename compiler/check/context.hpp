// Shared data of the parts of the checker while the model grows.
#pragma once

#include "ast/ast.hpp"
#include "check/codes.hpp"
#include "model/model.hpp"
#include "support/diagnostic.hpp"
#include "support/source.hpp"
#include "support/standard.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace rddlc::checking {

// An object of the instance or a member of an enumerated type.
struct Object {
    model::TypeId type;
    std::int64_t index;
    Span span;
};

// Everything that has a name. Maps point into the model by number.
struct Names {
    std::unordered_map<std::string, model::TypeId> types;
    std::unordered_map<std::string, model::FluentId> fluents;
    std::unordered_map<std::string, Object> objects;
    // Declared with an error that was reported: what follows from it is not reported again.
    std::unordered_set<model::TypeId> broken_types;
    std::unordered_set<model::FluentId> broken_fluents;
    // Types without given objects: nothing that depends on the objects is checked.
    std::unordered_set<model::TypeId> open_types;
};

struct Context {
    const Sources& sources;
    Diagnostics& diagnostics;
    Standard standard = Standard::PyRddlGym;
    model::Model model = {};
    Names names = {};
    // Fluents that some expression mentions.
    std::unordered_set<model::FluentId> mentioned = {};
    // False where a domain is checked alone.
    bool needs_instance = true;

    void report(Diagnostic diagnostic) { diagnostics.report(std::move(diagnostic)); }

    const model::Fluent& fluent(model::FluentId id) const { return model.fluents[id]; }
    const model::Type& type(model::TypeId id) const { return model.types[id]; }
};

// The beginning of a report: notes and a hint may follow.
inline Diagnostic diagnose(Code code, std::optional<Span> span, std::string message) {
    return {code, span, std::move(message)};
}

// Lookup in one of the maps of Names; nullptr if absent.
template <class T>
const T* find(const std::unordered_map<std::string, T>& map, const std::string& name) {
    const auto found = map.find(name);
    return found == map.end() ? nullptr : &found->second;
}

template <class T>
std::vector<std::string> keys(const std::unordered_map<std::string, T>& map) {
    std::vector<std::string> result;
    result.reserve(map.size());
    for (const auto& [name, value] : map) result.push_back(name);
    return result;
}

// The name that was meant, if one of the candidates is near. They are only made while there are few
// errors: the search compares every one of them.
using Candidates = std::function<std::vector<std::string>()>;
std::optional<std::string> name_meant(const Context& context, std::string_view name,
                                      const Candidates& candidates);
// "did you mean 'rlevel'?", with the change of `place`, which holds the name; or nothing.
Hint suggestion(const Context& context, std::string_view name, Span place,
                const Candidates& candidates);

// "1 argument", "2 arguments"
std::string counted(std::size_t count, std::string_view noun);
// "a, b and c"
std::string joined(const std::vector<std::string>& words, std::string_view last = "and");
// "an action-fluent", "a state-fluent"
std::string with_article(Role role);
// The place of a name without the prime behind it.
inline Span without_prime(Span name, bool primed) {
    return {name.file, name.begin, name.end - (primed ? 1 : 0)};
}
// The mark behind a name, if nothing but blanks stands between.
std::optional<Span> mark_behind(Span name, char mark, const Context& context);
// Other brackets, such as "[]", for those of "name(...)", which end the place `whole`; nothing if they
// are not there.
std::vector<Replacement> other_brackets(Span name, Span whole, std::string_view brackets,
                                        const Context& context);
// The written name: a state-fluent's next value has a prime.
std::string written_name(const model::Fluent& fluent, bool next);

}  // namespace rddlc::checking
