#include "format/format.hpp"

#include "ast/equal.hpp"
#include "format/comments.hpp"
#include "format/items.hpp"
#include "format/layout.hpp"
#include "parse/parse.hpp"

#include <array>
#include <stdexcept>

namespace rddlc {

namespace {

bool means(const std::string& text, const std::string& path, const ast::Program& program,
           Standard standard) {
    Sources sources;
    Diagnostics diagnostics;
    const FileId file = sources.add(path, text);
    const ast::Program again = parse(sources, std::array{file}, diagnostics, standard);
    return !diagnostics.has_errors() && ast::equal(program, again);
}

}  // namespace

std::optional<std::string> format_file(const Sources& sources, FileId file,
                                       Diagnostics& diagnostics, Standard standard) {
    const ast::Program program = parse(sources, std::array{file}, diagnostics, standard);
    if (diagnostics.has_errors()) return std::nullopt;
    const Source& source = sources[file];
    std::string text =
        format::join(format::layout(program, format::tokens_with_comments(source.text())));
    if (!means(text, source.path(), program, standard))
        throw std::logic_error("formatting would change the meaning of '" + source.path() + "'");
    return text;
}

}  // namespace rddlc
