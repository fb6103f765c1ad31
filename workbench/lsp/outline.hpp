// What a text declares and mentions, whole or broken: found by its words and brackets alone, so
// that it is there while somebody types. It says nothing of mistakes; the compiler does.
#pragma once

#include "format/comments.hpp"
#include "lsp/positions.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::lsp {

// A name and its place. Neither holds the mark of "?x" or "@a", nor the prime of "p'".
struct Name {
    std::string_view text;
    Place place;
};

struct TypeDeclaration {
    Name name;
    std::optional<std::vector<Name>> members;  // of an enumerated type
    Place whole;
    std::string comment;
};

struct FluentDeclaration {
    Name name;
    std::vector<Name> parameters;  // types
    Name kind;                     // "state-fluent"
    Name range;                    // "bool", or a type
    Place whole;
    std::string comment;
};

struct ObjectList {
    Name type;
    std::vector<Name> objects;
};

// A variable with the text in which it is bound.
struct Binding {
    Name variable;
    std::string_view type;  // empty if it is not known
    Place scope;
};

enum class Meaning {
    Domain,
    NonFluents,
    Instance,
    Policy,
    Type,
    Fluent,
    Object,          // also a value of an enumerated type
    FluentOrObject,  // a bare name in an expression
    Variable,
};

struct Occurrence {
    Meaning meaning;
    Name name;
    bool declares = false;
    std::size_t binding = 0;  // of a variable: index into Outline::bindings, or their number
};

// A declaration, definition, condition, list of objects or assignment.
struct Item {
    Name name;  // empty for a condition
    Place whole;
};

struct Section {
    Name keyword;
    Place whole;
    std::vector<Item> items;
};

struct Block {
    Meaning kind;  // Domain, NonFluents, Instance or Policy
    Name keyword;
    Name name;
    Place whole;
    std::vector<Section> sections;
    std::string_view domain;       // named by 'domain = d;'
    std::string_view non_fluents;  // named by 'non-fluents = n;'
};

// Refers to the text that it was made of.
struct Outline {
    std::vector<format::Token> tokens;
    std::vector<Block> blocks;
    std::vector<TypeDeclaration> types;
    std::vector<FluentDeclaration> fluents;
    std::vector<ObjectList> lists;
    std::vector<Binding> bindings;
    std::vector<Occurrence> occurrences;  // in the order of the text

    const Block* find_block(Meaning kind, std::string_view name) const;
    bool has(Meaning kind) const;
};

Outline outline_of(std::string_view text);

}  // namespace rddlc::lsp
