// Reports syntax errors and continues after them, so that one run shows every error once.
#pragma once

#include "parse/syntax_error.hpp"

namespace rddlc {

// An error ends the item it is in (a definition, a declaration, a value): the parser continues
// after the item's ';', or at the '}' of its section. Errors that follow from an error are not
// reported: nothing is, until a token has matched again.
class ErrorStrategy final : public antlr4::ANTLRErrorStrategy {
  public:
    // `tokens` are those of the file. Gives up with ParseCancellationException at `limit` errors.
    ErrorStrategy(FileId file, std::vector<Token*> tokens, std::size_t limit,
                  Diagnostics& diagnostics);

    void reset(antlr4::Parser* parser) override;
    Token* recoverInline(antlr4::Parser* parser) override;
    void recover(antlr4::Parser* parser, std::exception_ptr error) override;
    void sync(antlr4::Parser* parser) override;
    bool inErrorRecoveryMode(antlr4::Parser* parser) override;
    void reportMatch(antlr4::Parser* parser) override;
    void reportError(antlr4::Parser* parser, const antlr4::RecognitionException& error) override;

  private:
    void report(antlr4::Parser& parser, std::size_t index, TokenTypes expected);
    bool follows_lexical_error(std::size_t index) const;
    bool may_insert(antlr4::Parser& parser, std::size_t missing) const;
    Token* conjure(std::size_t type, const Token& at);
    void skip_item(antlr4::Parser& parser, std::size_t begin, bool nested_semicolons_end);
    void skip_to_loop(antlr4::Parser& parser, const TokenTypes& next);

    FileId file_;
    std::vector<Token*> tokens_;
    std::size_t limit_;
    Diagnostics& diagnostics_;
    std::vector<Span> lexical_errors_;
    std::size_t reported_ = 0;
    bool recovering_ = false;
    std::vector<std::unique_ptr<Token>> conjured_;
};

}  // namespace rddlc
