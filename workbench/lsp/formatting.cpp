#include "format/format.hpp"
#include "lsp/capabilities.hpp"

#include <algorithm>

namespace rddlc::lsp {

namespace {

// The lines that differ, so that the editor keeps its marks in the others.
Json smallest_edit(const Text& text, const std::string& after) {
    const std::string& before = text.string();
    const std::size_t shorter = std::min(before.size(), after.size());
    std::size_t same = 0;
    while (same < shorter && before[same] == after[same]) ++same;
    while (same > 0 && before[same - 1] != '\n') --same;
    std::size_t tail = 0;
    while (tail < shorter - same &&
           before[before.size() - 1 - tail] == after[after.size() - 1 - tail])
        ++tail;
    while (tail > 0 && before[before.size() - 1 - tail] != '\n') --tail;
    const Place place{static_cast<std::uint32_t>(same),
                      static_cast<std::uint32_t>(before.size() - tail)};
    return {{"range", text.range(place)},
            {"newText", after.substr(same, after.size() - tail - same)}};
}

}  // namespace

// A text with errors stays as it is: its diagnostics are shown already.
Json formatting(const File& file, Standard standard) {
    Sources sources;
    Diagnostics diagnostics;
    const FileId id = sources.add(file.path.string(), file.text.string());
    const auto after = format_file(sources, id, diagnostics, standard);
    Json edits = Json::array();
    if (after && *after != file.text.string()) edits.push_back(smallest_edit(file.text, *after));
    return edits;
}

}  // namespace rddlc::lsp
