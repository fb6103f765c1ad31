#include "parse/tokens.hpp"

#include "parse/distribution_names.hpp"
#include "parse/spelling.hpp"

#include <algorithm>

namespace rddlc {

namespace {

// ANTLR counts characters, we count bytes. With every byte that is not ASCII replaced by a
// character that no token contains, both are the same; the messages read the source itself.
std::string masked(std::string_view text) {
    constexpr char stand_in = '\x01';
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    std::string ascii(text);
    std::replace_if(
        ascii.begin(), ascii.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; },
        stand_in);
    // Files that were joined or saved again have several marks at their beginning.
    for (std::size_t at = 0; text.substr(at).starts_with(byte_order_mark);
         at += byte_order_mark.size())
        ascii.replace(at, byte_order_mark.size(), byte_order_mark.size(), ' ');
    return ascii;
}

std::vector<std::unique_ptr<Token>> lex(antlr4::ANTLRInputStream& characters) {
    grammar::RDDLLexer lexer(&characters);
    std::vector<std::unique_ptr<Token>> tokens;
    do tokens.push_back(lexer.nextToken());
    while (tokens.back()->getType() != Token::EOF);
    return tokens;
}

TokenList words_of(FileId file, const Source& source, Standard standard,
                   antlr4::ANTLRInputStream& characters, Diagnostics& diagnostics) {
    TokenList tokens = repair_spelling(file, source, standard, lex(characters), diagnostics);
    if (standard == Standard::Rddlc) mark_distributions(tokens, is_distribution_of_ours);
    return tokens;
}

}  // namespace

TokenizedFile::TokenizedFile(FileId file, const Source& source, Standard standard,
                             Diagnostics& diagnostics)
    : characters_(masked(source.text())),
      source_(std::make_unique<antlr4::ListTokenSource>(
          words_of(file, source, standard, characters_, diagnostics))),
      stream_(std::make_unique<antlr4::CommonTokenStream>(source_.get())) {
    stream_->fill();
}

Span span_of(FileId file, const Token& token) {
    return span_of(file, token, token);
}

Span span_of(FileId file, const Token& first, const Token& last) {
    const auto begin = static_cast<std::uint32_t>(first.getStartIndex());
    const auto end = static_cast<std::uint32_t>(last.getStopIndex() + 1);
    return {file, begin, std::max(begin, end)};
}

}  // namespace rddlc
