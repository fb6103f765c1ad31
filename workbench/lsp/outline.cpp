#include "lsp/outline.hpp"

#include "lsp/outline_reader.hpp"

#include <algorithm>

namespace rddlc::lsp {

const Block* Outline::find_block(Meaning kind, std::string_view name) const {
    const auto found = std::ranges::find_if(
        blocks, [&](const Block& block) { return block.kind == kind && block.name.text == name; });
    return found == blocks.end() ? nullptr : &*found;
}

bool Outline::has(Meaning kind) const {
    return std::ranges::any_of(blocks, [&](const Block& block) { return block.kind == kind; });
}

Outline outline_of(std::string_view text) {
    Outline outline;
    outline.tokens = format::tokens_with_comments(text);
    OutlineReader(text, outline).read();
    std::ranges::stable_sort(outline.occurrences, {},
                             [](const Occurrence& each) { return each.name.place.begin; });
    return outline;
}

}  // namespace rddlc::lsp
