// Converts ANTLR's tree to ours: free functions, one for each rule of grammar/RDDL.g4. The tree is
// free of syntax errors; the depth of recursion is bounded by parse/limits.hpp.
#pragma once

#include "ast/ast.hpp"
#include "parse/tokens.hpp"

namespace rddlc {

struct Conversion {
    FileId file;
    Diagnostics& diagnostics;
};

// convert.cpp: what everything is made of
Span span_of(const Conversion& conversion, const antlr4::ParserRuleContext& context);
// The name without the mark of "?x" and "@a".
ast::Name to_name(const Conversion& conversion, const Token& token);
ast::Name to_name(const Conversion& conversion, antlr4::tree::TerminalNode* node);
// An identifier as a fluent's name: the apostrophe is not part of it.
struct PrimedName {
    ast::Name name;
    bool primed;
};
PrimedName to_primed_name(const Conversion& conversion, antlr4::tree::TerminalNode* node);
std::vector<ast::Name> to_names(const Conversion& conversion,
                                const std::vector<antlr4::tree::TerminalNode*>& nodes);
// `text` may begin with "-". Numbers that do not fit are reported.
ast::Integer to_integer(const Conversion& conversion, std::string text, Span span);
ast::Real to_real(const Conversion& conversion, std::string text, Span span);
ast::Symbol to_symbol(Parser::SymbolContext& context);
ast::Constant to_constant(const Conversion& conversion, Parser::ConstantContext& context);

// convert_expression.cpp
ast::Expr to_expr(const Conversion& conversion, Parser::ExprContext& context);
ast::Expr to_expr(const Conversion& conversion, Parser::RandomVectorContext& context);
ast::Expr to_expr(const Conversion& conversion, Parser::DrawContext& context);

// convert_domain.cpp
ast::Domain to_domain(const Conversion& conversion, Parser::DomainContext& context);
ast::Policy to_policy(const Conversion& conversion, Parser::PolicyContext& context);

// convert_instance.cpp
ast::Instance to_instance(const Conversion& conversion, Parser::InstanceContext& context);
ast::NonFluents to_non_fluents(const Conversion& conversion, Parser::NonFluentsContext& context);

// The labelled alternative that a tree is, or null.
template <class Alternative>
Alternative* as(antlr4::tree::ParseTree& tree) {
    return dynamic_cast<Alternative*>(&tree);
}

}  // namespace rddlc
