// From tokens to an outline. Blocks, sections and items end where the next one begins, even if a
// bracket or semicolon is missing.
#pragma once

#include "lsp/outline.hpp"

namespace rddlc::lsp {

class OutlineReader {
  public:
    OutlineReader(std::string_view text, Outline& outline)
        : text_(text), tokens_(outline.tokens), outline_(outline) {}

    void read();

  private:
    // outline_blocks.cpp
    std::size_t read_block(std::size_t at);
    std::size_t read_section(std::size_t at, Block& block);
    void read_setting(std::size_t at, std::size_t end, Block& block, Section& section);
    void read_items(std::size_t at, std::size_t end, const Block& block, Section& section);
    std::size_t item_end(std::size_t at, std::size_t end, std::string_view separator) const;
    bool begins_block(std::size_t at) const;
    bool begins_section(std::size_t at) const;
    bool begins_item(std::size_t at, std::string_view separator) const;

    // outline_items.cpp: one item of [at, end)
    void read_item(std::size_t at, std::size_t end, const Block& block, Section& section);
    void read_type(std::size_t at, std::size_t end);
    void read_fluent(std::size_t at, std::size_t end);
    void read_cpf(std::size_t at, std::size_t end);
    void read_list(std::size_t at, std::size_t end);
    void read_assignment(std::size_t at, std::size_t end);

    // outline_expressions.cpp
    void read_expression(std::size_t at, std::size_t end);
    void read_name(std::size_t at, std::size_t end);
    std::size_t read_binder(std::size_t open, std::size_t end);
    std::size_t end_of_body(std::size_t at, std::size_t end) const;
    void read_variable(std::size_t at);

    // The kinds of tokens.
    std::string_view word(std::size_t at) const {
        return at < tokens_.size() ? tokens_[at].text : std::string_view();
    }
    Place place(std::size_t at) const;
    Name name(std::size_t at) const;
    bool is_name_at(std::size_t at) const;
    std::size_t closing(std::size_t open, std::size_t end) const;
    std::string comment(std::size_t at, std::size_t end) const;
    Place whole(std::size_t at, std::size_t end) const;
    void note(Meaning meaning, std::size_t at, bool declares = false);

    std::string_view text_;
    const std::vector<format::Token>& tokens_;
    Outline& outline_;
    std::size_t first_binding_ = 0;  // of the item
};

}  // namespace rddlc::lsp
