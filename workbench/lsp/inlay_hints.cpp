// How many groundings and objects declarations have in the instance.
#include "lsp/capabilities.hpp"

#include <fmt/format.h>

namespace rddlc::lsp {

namespace {

Json hint(const File& file, std::uint32_t offset, double count, std::string_view what) {
    return {{"position", file.text.position(offset)},
            {"label", fmt::format("{:.0f} {}{}", count, what, count == 1 ? "" : "s")},
            {"paddingLeft", true}};
}

}  // namespace

Json inlay_hints(const Lookup& lookup, Place place) {
    const File& file = *lookup.file();
    Json hints = Json::array();
    for (const TypeDeclaration& type : file.outline.types) {
        if (type.members || !place.overlaps(type.whole)) continue;
        if (const auto objects = lookup.objects_of(type.name.text))
            hints.push_back(
                hint(file, type.whole.end, static_cast<double>(objects->size()), "object"));
    }
    for (const FluentDeclaration& fluent : file.outline.fluents) {
        if (fluent.parameters.empty() || !place.overlaps(fluent.whole)) continue;
        if (const auto count = lookup.groundings_of(fluent))
            hints.push_back(hint(file, fluent.whole.end, *count, "grounding"));
    }
    return hints;
}

}  // namespace rddlc::lsp
