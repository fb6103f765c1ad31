#include "lsp/capabilities.hpp"

#include <tuple>

namespace rddlc::lsp {

namespace {

auto key(const Json& position) {
    return std::tuple(position.at("line").get<std::uint64_t>(),
                      position.at("character").get<std::uint64_t>());
}

bool overlap(const Json& a, const Json& b) {
    return key(a.at("start")) <= key(b.at("end")) && key(b.at("start")) <= key(a.at("end"));
}

bool overlaps_any(const Json& edits, const Json& edit) {
    for (const Json& each : edits)
        if (overlap(each.at("range"), edit.at("range"))) return true;
    return false;
}

// Whether two fixes change the same place, or one next to it.
bool collide(const Json& all, const Json& changes) {
    for (const auto& [uri, edits] : changes.items())
        for (const Json& edit : edits)
            if (all.contains(uri) && overlaps_any(all.at(uri), edit)) return true;
    return false;
}

// The fixes of the file that do not touch each other, as one.
Json all_fixes(const FileChecks& checks) {
    Json all = Json::object();
    for (const QuickFix& fix : checks.fixes) {
        if (collide(all, fix.changes)) continue;
        for (const auto& [uri, edits] : fix.changes.items())
            for (const Json& edit : edits) all[uri].push_back(edit);
    }
    return all;
}

}  // namespace

Json quick_fixes(const FileChecks& checks, const Json& range) {
    Json actions = Json::array();
    for (const QuickFix& fix : checks.fixes) {
        const Json& diagnostic = checks.diagnostics[fix.diagnostic];
        if (!overlap(diagnostic.at("range"), range)) continue;
        actions.push_back({{"title", fix.title},
                           {"kind", "quickfix"},
                           {"isPreferred", true},
                           {"diagnostics", Json::array({diagnostic})},
                           {"edit", {{"changes", fix.changes}}}});
    }
    if (checks.fixes.size() > 1)
        actions.push_back({{"title", "Repair all that is certain in this file"},
                           {"kind", "source.fixAll.rddl"},
                           {"edit", {{"changes", all_fixes(checks)}}}});
    return actions;
}

}  // namespace rddlc::lsp
