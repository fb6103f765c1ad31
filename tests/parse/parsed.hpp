// Texts, parsed, for the tests of this folder.
#pragma once

#include "ast/ast.hpp"
#include "parse/parse.hpp"
#include "support/render.hpp"

#include <string>
#include <vector>

namespace rddlc {

struct Parsed {
    Sources sources;
    Diagnostics diagnostics;
    ast::Program program;

    std::string report() const { return render(diagnostics, sources, {}); }

    // "E0101 E0102", in the order of their places.
    std::string codes() const {
        Diagnostics sorted = diagnostics;
        sorted.sort_by_position();
        std::string text;
        for (const Diagnostic& diagnostic : sorted.all())
            text += (text.empty() ? "" : " ") + to_string(diagnostic.code);
        return text;
    }
};

inline Parsed parse_files(const std::vector<std::string>& texts,
                          Standard standard = Standard::PyRddlGym) {
    Parsed parsed;
    std::vector<FileId> files;
    for (const std::string& text : texts) files.push_back(parsed.sources.add("test.rddl", text));
    parsed.program = parse(parsed.sources, files, parsed.diagnostics, standard);
    return parsed;
}

inline Parsed parse_text(const std::string& text, Standard standard = Standard::PyRddlGym) {
    return parse_files({text}, standard);
}

// "domain d { reward = <expression>; }"
inline Parsed parse_reward(const std::string& expression) {
    return parse_text("domain d { reward = " + expression + "; }");
}

// A domain and an instance with everything that RDDL has.
extern const std::string sample_domain;
extern const std::string sample_instance;

}  // namespace rddlc
