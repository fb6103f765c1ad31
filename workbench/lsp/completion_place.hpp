// The kind of name that a cursor asks for.
#pragma once

#include "lsp/lookup.hpp"

#include <string_view>

namespace rddlc::lsp {

struct CompletionPlace {
    enum class Kind {
        Nothing,  // a new name, a number, a comment
        Block,
        DomainSection,  // also of a policy
        NonFluentsSection,
        InstanceSection,
        BlockName,  // behind 'domain =' or 'non-fluents ='; `word` is the keyword
        TypeForm,   // behind 't :'
        Type,
        FluentKind,
        Range,
        Attribute,
        Definition,  // the left-hand side of a CPF
        Assignment,  // a fluent; `word` is the section
        Argument,    // an object of the type `word`
        Constant,    // a value of the range `word`
        Variable,    // "?" was typed
        Value,       // "@" was typed
        Expression,
    };

    Kind kind = Kind::Nothing;
    std::string_view word = {};
    std::string_view text = {};  // typed so far, the mark included
    Place replaced = {};         // the word at the cursor
    bool in_policy = false;
};

CompletionPlace completion_place(const Lookup& lookup, std::uint32_t offset);

}  // namespace rddlc::lsp
