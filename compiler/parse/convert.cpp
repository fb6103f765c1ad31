#include "parse/convert.hpp"

#include "parse/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace rddlc {

using antlr4::tree::TerminalNode;

Span span_of(const Conversion& conversion, const antlr4::ParserRuleContext& context) {
    auto& mutable_context = const_cast<antlr4::ParserRuleContext&>(context);
    return span_of(conversion.file, *mutable_context.getStart(), *mutable_context.getStop());
}

ast::Name to_name(const Conversion& conversion, const Token& token) {
    std::string text = token.getText();
    if (text[0] == '?' || text[0] == '@') text.erase(0, 1);
    return {std::move(text), span_of(conversion.file, token)};
}

ast::Name to_name(const Conversion& conversion, TerminalNode* node) {
    return to_name(conversion, *node->getSymbol());
}

PrimedName to_primed_name(const Conversion& conversion, TerminalNode* node) {
    ast::Name name = to_name(conversion, node);
    const bool primed = name.text.ends_with('\'');
    if (primed) name.text.pop_back();
    return {std::move(name), primed};
}

std::vector<ast::Name> to_names(const Conversion& conversion,
                                const std::vector<TerminalNode*>& nodes) {
    std::vector<ast::Name> names;
    names.reserve(nodes.size());
    for (TerminalNode* node : nodes) names.push_back(to_name(conversion, node));
    return names;
}

// ------------------------------------------------------------------------------------ numbers

ast::Integer to_integer(const Conversion& conversion, std::string text, Span span) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{})
        conversion.diagnostics.report(
            Diagnostic{number_out_of_range, span, "this integer does not fit into 64 bits"}
                .with_hint("integers range from -9223372036854775808 to 9223372036854775807; "
                           "larger numbers are reals, written with a point"));
    return {value};
}

// Whether a number that fits no double is too large, and not too small. strtod would know, but only
// in the locale of the application.
bool is_large(std::string_view text) {
    const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
    std::int64_t exponent = 0;
    if (mark < text.size()) {
        std::string_view written = text.substr(mark + 1);
        const bool is_negative = written.starts_with('-');
        if (written.starts_with('+') || is_negative) written.remove_prefix(1);
        const auto [end, error] =
            std::from_chars(written.data(), written.data() + written.size(), exponent);
        if (error != std::errc{}) return !is_negative;
        if (is_negative) exponent = -exponent;
    }
    const std::string_view digits = text.substr(0, mark);
    const auto first = static_cast<std::int64_t>(digits.find_first_of("123456789"));
    const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
    return point - first + exponent > 0;
}

ast::Real to_real(const Conversion& conversion, std::string text, Span span) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // A number that is too small is zero.
    if (error == std::errc::result_out_of_range && is_large(text))
        conversion.diagnostics.report(
            {number_out_of_range, span, "this number is too large for a real"});
    return {value, std::move(text)};
}

// ---------------------------------------------------------------------------------- constants

ast::Symbol to_symbol(Parser::SymbolContext& context) {
    if (context.ENUM()) return {context.ENUM()->getText().substr(1), true};
    return {context.ID()->getText(), false};
}

namespace {

decltype(ast::Constant::value) to_value(const Conversion& conversion,
                                        Parser::ConstantContext& context) {
    const Span span = span_of(conversion, context);
    if (auto* boolean = as<Parser::BooleanConstantContext>(context))
        return ast::Boolean{boolean->getText() == "true"};
    if (auto* integer = as<Parser::IntegerConstantContext>(context))
        return to_integer(conversion, integer->getText(), span);
    if (auto* real = as<Parser::RealConstantContext>(context))
        return to_real(conversion, real->getText(), span);
    if (as<Parser::PosInfContext>(context)) return ast::PosInf{};
    if (as<Parser::NegInfContext>(context)) return ast::NegInf{};
    return to_symbol(*as<Parser::SymbolConstantContext>(context)->symbol());
}

}  // namespace

ast::Constant to_constant(const Conversion& conversion, Parser::ConstantContext& context) {
    return {to_value(conversion, context), span_of(conversion, context)};
}

}  // namespace rddlc
