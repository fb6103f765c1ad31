// Emitted C++ as a tree: what is written, not how it is laid out (print.hpp).
#pragma once

#include "support/box.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace rddlc::cpp::tree {

// How tightly an expression holds together, loosest first.
enum class Level : std::uint8_t {
    Or,
    And,
    Comparison,
    Not,  // binds tighter in C++, but readers and compilers want (!a) == b
    Additive,
    Multiplicative,
    Unary,
    Primary,
};

struct Expression;
struct Statement;
using Expressions = std::vector<Expression>;
using Block = std::vector<Statement>;

// ---------------------------------------------------------------------------- expressions

// A name, a type or a number.
struct Word {
    std::string text;
    Level level = Level::Primary;
};
// Many numbers, separated by commas.
struct Words {
    std::vector<std::string> texts;
};
// Between double quotes, in pieces if it is long.
struct Text {
    std::string characters;
};
// f(a, b), table[i], T<a>, T{a, b}, {a, b}
enum class Brackets : std::uint8_t { Round, Square, Angle, Curly };
struct Bracketed {
    Box<Expression> head;
    Brackets brackets;
    Expressions items;
    std::vector<std::string> comments = {};  // behind the items, where there are any
};
// The operator stands in front of its one operand, or between two.
struct Operator {
    std::string word;
    Level level;
    Level left, right;         // operands that are looser need parentheses
    bool associative = false;  // but not those of the same level
};
struct Operation {
    Operator op;
    Expressions operands;
};
struct Lambda {
    Expressions parameters;
    Block body;
    bool captures = true;
    bool is_called = false;  // at once, without arguments
};
// A type and the name that it gets: a variable, a member, a parameter.
struct Declared {
    std::string type;
    std::string name;
};

struct Expression {
    std::variant<Word, Words, Text, Bracketed, Operation, Lambda, Declared> form;
};

// ----------------------------------------------------------------------------- statements

struct Assign {
    Expression target, value;
};
struct Return {
    Expression value;
};
struct If {
    Expression condition;
    Box<Statement> then;
};
struct For {  // from 0
    std::string variable, size;
    Block body;
};
struct Function {  // of a struct or namespace
    std::string attributes, result, name;
    Expressions parameters;
    Block body;
};
struct Record {
    std::string name;
    Block members;
};

struct Statement {
    std::variant<Expression, Assign, Return, If, For, Function, Record> form;
    bool is_template = false;    // over the lane type L
    std::string comment = {};    // above
    std::string remark = {};     // a comment behind
    std::string directive = {};  // for the preprocessor, above each line
};

// -------------------------------------------------------------------------------- makers

inline Expression word(std::string text) {
    return {Word{std::move(text)}};
}
inline Expression text(std::string characters) {
    return {Text{std::move(characters)}};
}
inline Expression declared(std::string type, std::string name) {
    return {Declared{std::move(type), std::move(name)}};
}
inline Expression number(std::integral auto value) {
    return word(std::to_string(value));
}
// Moves them, as an initializer list does not.
template <class... Items>
Expressions list(Items&&... items) {
    Expressions result;
    result.reserve(sizeof...(items));
    (result.push_back(std::forward<Items>(items)), ...);
    return result;
}
template <class Item>
void append(std::vector<Item>& items, std::vector<Item> others) {
    std::ranges::move(others, std::back_inserter(items));
}
inline Expression operation(Operator op, Expressions operands) {
    return {Operation{std::move(op), std::move(operands)}};
}
inline Expression call(Expression function, Expressions arguments) {
    return {Bracketed{std::move(function), Brackets::Round, std::move(arguments)}};
}
inline Expression call(std::string function, Expressions arguments) {
    return call(word(std::move(function)), std::move(arguments));
}
inline Expression element(Expression table, Expression index) {
    return {Bracketed{std::move(table), Brackets::Square, list(std::move(index))}};
}
inline Expression braces(std::string type, Expressions items) {
    return {Bracketed{word(std::move(type)), Brackets::Curly, std::move(items)}};
}
// .member = value
inline Expression initialiser(const std::string& member, Expression value) {
    return operation({"=", Level::Or, Level::Or, Level::Or},
                     list(word("." + member), std::move(value)));
}
inline Statement assign(Expression target, Expression value) {
    return {Assign{std::move(target), std::move(value)}};
}
inline Statement assign(std::string target, Expression value) {
    return assign(word(std::move(target)), std::move(value));
}

}  // namespace rddlc::cpp::tree
