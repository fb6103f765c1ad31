#include "parse/parse.hpp"

#include "parse/codes.hpp"
#include "parse/convert.hpp"
#include "parse/limits.hpp"
#include "parse/recovery.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rddlc {

namespace {

constexpr std::size_t max_errors_per_file = 25;

// NUL bytes never occur in text: one message instead of one for each garbled word.
bool is_text(FileId file, const Source& source, Diagnostics& diagnostics) {
    const std::size_t nul = source.text().find('\0');
    if (nul == std::string::npos) return true;
    const auto at = static_cast<std::uint32_t>(nul);
    const bool is_utf16 =
        source.text().starts_with("\xff\xfe") || source.text().starts_with("\xfe\xff");
    diagnostics.report(Diagnostic{not_utf8_text, Span{file, at, at + 1},
                                  "this is not a text file: it has a NUL byte"}
                           .with_hint(is_utf16 ? "it seems to be UTF-16; save it as UTF-8"
                                               : "RDDL is text, saved as UTF-8"));
    return false;
}

bool has_content(FileId file, TokenizedFile& tokens, Diagnostics& diagnostics) {
    if (tokens.tokens().size() > 1) return true;
    diagnostics.report(
        Diagnostic{empty_file, Span{file, 0, 0}, "the file has no RDDL block"}.with_hint(
            "a problem consists of a domain, non-fluents and an "
            "instance block"));
    return false;
}

void use_prediction(Parser& parser, antlr4::atn::PredictionMode mode) {
    parser.getInterpreter<antlr4::atn::ParserATNSimulator>()->setPredictionMode(mode);
}

// SLL prediction is fast and, where it succeeds, right.
template <class Rule>
auto parse_fast(Parser& parser, Rule&& rule) -> decltype(rule()) {
    use_prediction(parser, antlr4::atn::PredictionMode::SLL);
    parser.setErrorHandler(std::make_shared<antlr4::BailErrorStrategy>());
    try {
        return rule();
    } catch (const antlr4::ParseCancellationException&) {
        return nullptr;
    }
}

// LL prediction decides whether the text is wrong, and reports why.
template <class Rule>
auto parse_thoroughly(Parser& parser, FileId file, TokenizedFile& tokens, Diagnostics& diagnostics,
                      Rule&& rule) -> decltype(rule()) {
    parser.reset();
    use_prediction(parser, antlr4::atn::PredictionMode::LL);
    parser.setErrorHandler(
        std::make_shared<ErrorStrategy>(file, tokens.tokens(), max_errors_per_file, diagnostics));
    try {
        return rule();
    } catch (const antlr4::ParseCancellationException&) {
        return nullptr;
    }
}

ast::Block to_block(const Conversion& conversion, Parser::BlockContext& context) {
    if (context.domain()) return to_domain(conversion, *context.domain());
    if (context.instance()) return to_instance(conversion, *context.instance());
    if (context.nonFluents()) return to_non_fluents(conversion, *context.nonFluents());
    return to_policy(conversion, *context.policy());
}

void parse_file(FileId file, const Source& source, Standard standard, ast::Program& program,
                Diagnostics& diagnostics) {
    if (!is_text(file, source, diagnostics)) return;
    if (!within_limits(file, source, diagnostics)) return;
    const std::size_t errors_before = diagnostics.error_count();
    TokenizedFile tokens(file, source, standard, diagnostics);
    if (!has_content(file, tokens, diagnostics)) return;

    Parser parser(&tokens.stream());
    parser.removeErrorListeners();
    const auto whole_text = [&] {
        return parser.text();
    };
    Parser::TextContext* text = parse_fast(parser, whole_text);
    if (text == nullptr) text = parse_thoroughly(parser, file, tokens, diagnostics, whole_text);
    if (diagnostics.error_count() > errors_before) return;

    const Conversion conversion{file, diagnostics};
    for (Parser::BlockContext* block : text->block())
        program.blocks.push_back(to_block(conversion, *block));
}

}  // namespace

ast::Program parse(const Sources& sources, std::span<const FileId> files, Diagnostics& diagnostics,
                   Standard standard) {
    ast::Program program;
    for (const FileId file : files) parse_file(file, sources[file], standard, program, diagnostics);
    return program;
}

std::optional<ast::Expr> parse_expression(const Source& source, Span span, Diagnostics& diagnostics,
                                          Standard standard) {
    // All else is blank, so that places are those of the file.
    std::string text(span.end, ' ');
    std::copy(source.text().begin() + span.begin, source.text().begin() + span.end,
              text.begin() + span.begin);
    const Source blank(source.path(), std::move(text));
    if (!within_limits(span.file, blank, diagnostics)) return std::nullopt;
    const std::size_t errors_before = diagnostics.error_count();
    TokenizedFile tokens(span.file, blank, standard, diagnostics);
    Parser parser(&tokens.stream());
    parser.removeErrorListeners();
    // Nothing surrounds the expression in which the parser could continue after an error.
    const auto expression = [&]() -> Parser::ExprContext* {
        try {
            return parser.expr();
        } catch (const antlr4::RecognitionException&) {
            return nullptr;
        }
    };
    const auto is_all = [&] {
        return parser.getCurrentToken()->getType() == Token::EOF;
    };
    Parser::ExprContext* tree = parse_fast(parser, expression);
    if (tree == nullptr || !is_all())
        tree = parse_thoroughly(parser, span.file, tokens, diagnostics, expression);
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    if (tree == nullptr || !is_all()) {
        const Token& found = *parser.getCurrentToken();
        diagnostics.report(
            {unexpected_token, span_of(span.file, found),
             fmt::format("expected an operator or the end of the expression, found '{}'",
                         found.getText())});
        return std::nullopt;
    }
    ast::Expr result = to_expr(Conversion{span.file, diagnostics}, *tree);
    if (diagnostics.error_count() > errors_before) return std::nullopt;
    return result;
}

}  // namespace rddlc
