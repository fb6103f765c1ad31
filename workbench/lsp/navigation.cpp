// Where a name is declared and used.
#include "lsp/capabilities.hpp"

namespace rddlc::lsp {

namespace {

Json location(const Site& site) {
    return {{"uri", site.file->uri}, {"range", site.file->text.range(site.place)}};
}

Json locations(const std::vector<Site>& sites) {
    Json all = Json::array();
    for (const Site& site : sites) all.push_back(location(site));
    return all;
}

}  // namespace

Json definition(const Lookup& lookup, std::uint32_t offset) {
    const auto symbol = lookup.symbol_at(offset);
    return symbol ? locations(lookup.sites_of(*symbol, true)) : Json();
}

Json references(const Lookup& lookup, std::uint32_t offset, bool with_declaration) {
    const auto symbol = lookup.symbol_at(offset);
    if (!symbol) return Json();
    std::vector<Site> sites = lookup.sites_of(*symbol, false);
    if (!with_declaration)
        for (const Site& declared : lookup.sites_of(*symbol, true))
            std::erase_if(sites, [&](const Site& site) {
                return site.file == declared.file && site.place == declared.place;
            });
    return locations(sites);
}

Json highlights(const Lookup& lookup, std::uint32_t offset) {
    const auto symbol = lookup.symbol_at(offset);
    if (!symbol) return Json();
    Json all = Json::array();
    for (const Site& site : lookup.sites_of(*symbol, false))
        if (site.file == lookup.file())
            all.push_back({{"range", site.file->text.range(site.place)}});
    return all;
}

}  // namespace rddlc::lsp
