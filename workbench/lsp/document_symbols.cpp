#include "lsp/capabilities.hpp"

namespace rddlc::lsp {

namespace {

// Numbers of the protocol's SymbolKind.
constexpr int of_block = 2, of_section = 3, of_type = 10, of_fluent = 8, of_definition = 12,
              of_value = 14;

int kind_of(std::string_view section) {
    if (section == "types") return of_type;
    if (section == "pvariables") return of_fluent;
    return section == "cpfs" || section == "cdfs" ? of_definition : of_value;
}

Json symbol(const File& file, std::string_view name, int kind, Place whole, Place place) {
    // The protocol asks for a name, and for its place within the whole.
    return {{"name", name},
            {"kind", kind},
            {"range", file.text.range(whole)},
            {"selectionRange", file.text.range(place)},
            {"children", Json::array()}};
}

Json of(const File& file, const Section& section) {
    Json json =
        symbol(file, section.keyword.text, of_section, section.whole, section.keyword.place);
    for (const Item& item : section.items)
        if (!item.name.text.empty())
            json["children"].push_back(symbol(file, item.name.text, kind_of(section.keyword.text),
                                              item.whole, item.name.place));
    return json;
}

}  // namespace

Json document_symbols(const File& file) {
    Json all = Json::array();
    for (const Block& block : file.outline.blocks) {
        const std::string name =
            std::string(block.keyword.text) + " " + std::string(block.name.text);
        Json json = symbol(file, name, of_block, block.whole, block.name.place);
        for (const Section& section : block.sections) json["children"].push_back(of(file, section));
        all.push_back(std::move(json));
    }
    return all;
}

}  // namespace rddlc::lsp
