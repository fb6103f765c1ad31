#include "exercise.hpp"

#include "ast/equal.hpp"
#include "ast/print.hpp"
#include "check/check.hpp"
#include "driver/large_tables.hpp"
#include "emit/emit.hpp"
#include "ground/ground.hpp"
#include "ir/print.hpp"
#include "ir/verify.hpp"
#include "model/print.hpp"
#include "parse/parse.hpp"
#include "passes/passes.hpp"
#include "support/render.hpp"
#include "twins.hpp"

#include <array>
#include <optional>
#include <utility>

namespace rddlc::fuzzing {
namespace {

ast::Program parsed(std::string text, Sources& sources, Diagnostics& diagnostics) {
    const std::array files = {sources.add("problem.rddl", std::move(text))};
    return parse(sources, files, diagnostics, Standard::Rddlc);
}

void expect_same_when_printed(const ast::Program& tree) {
    Sources sources;
    Diagnostics diagnostics;
    const std::string text = ast::print(tree);
    const ast::Program again = parsed(text, sources, diagnostics);
    if (diagnostics.has_errors()) {
        throw Contradiction("the printed syntax tree has errors:\n" +
                            render(diagnostics, sources, {}));
    }
    if (!equal(tree, again)) {
        throw Contradiction("the printed syntax tree reads as another one:\n" + text);
    }
}

void require_valid(const ir::Program& program, const std::string& stage) {
    std::string complaints;
    for (const std::string& complaint : ir::verify(program)) complaints += "\n  " + complaint;
    if (!complaints.empty()) throw Contradiction("invalid IR after " + stage + ":" + complaints);
}

// Nothing after an error, which has a message.
std::optional<ir::Program> grounded(std::string_view text, Sources& sources,
                                    Diagnostics& diagnostics) {
    const ast::Program tree = parsed(std::string(text), sources, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    expect_same_when_printed(tree);
    const std::optional<model::Model> model = check(tree, sources, diagnostics, Standard::Rddlc);
    if (diagnostics.has_errors()) return std::nullopt;
    if (!model) throw Contradiction("no model and no error");
    model::print(*model);
    std::optional<ir::Program> program = ground(*model, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    if (!program) throw Contradiction("no IR and no error");
    return program;
}

}  // namespace

Outcome exercise(std::string_view text, std::uint64_t seed, int steps) {
    Sources sources;
    Diagnostics diagnostics;
    std::optional<ir::Program> program = grounded(text, sources, diagnostics);
    render(diagnostics, sources, {});
    if (!program) return Outcome::Rejected;
    require_valid(*program, "ground");
    report_large_constant_tables(*program, diagnostics);
    if (diagnostics.has_errors()) return Outcome::TooLarge;
    ir::print(*program);
    ir::Program optimised = optimise(*program);
    require_valid(optimised, "optimise");
    emit(optimised, sources, {});
    if (!program->externals.empty()) return Outcome::Accepted;  // nobody has the functions
    if (step_cost(*program) > 1e5) return Outcome::TooLarge;
    if (const auto difference = compare(*std::move(program), std::move(optimised), seed, steps)) {
        throw Contradiction("optimising changes " + *difference);
    }
    return Outcome::Accepted;
}

}  // namespace rddlc::fuzzing
