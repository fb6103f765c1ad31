// Parse and check a text, as the tests of this folder want it.
#pragma once

#include "check/check.hpp"
#include "model/model.hpp"
#include "parse/parse.hpp"
#include "support/diagnostic.hpp"
#include "support/render.hpp"
#include "support/source.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::testing {

struct Checked {
    Sources sources;
    Diagnostics diagnostics;
    std::optional<model::Model> model;

    // "E0203 W0202", in the order of positions.
    std::string codes() const {
        std::string text;
        for (const Diagnostic& diagnostic : diagnostics.all())
            text += (text.empty() ? "" : " ") + to_string(diagnostic.code);
        return text;
    }
    std::string rendered() const { return render(diagnostics, sources, {}); }
};

inline Checked check_text(std::string text, DiagnosticOptions options = {}) {
    Checked checked{{}, Diagnostics(std::move(options)), {}};
    const std::vector<FileId> files{checked.sources.add("problem.rddl", std::move(text))};
    const ast::Program program = parse(checked.sources, files, checked.diagnostics);
    if (!checked.diagnostics.has_errors())
        checked.model = check(program, checked.sources, checked.diagnostics);
    checked.diagnostics.sort_by_position();
    return checked;
}

}  // namespace rddlc::testing
