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
std::optional<ir::Program> grounded(std::string_view text, bool prints, Sources& sources,
                                    Diagnostics& diagnostics) {
    const ast::Program tree = parsed(std::string(text), sources, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    if (prints) expect_same_when_printed(tree);
    const std::optional<model::Model> model = check(tree, sources, diagnostics, Standard::Rddlc);
    if (diagnostics.has_errors()) return std::nullopt;
    if (!model) throw Contradiction("no model and no error");
    if (prints) model::print(*model);
    std::optional<ir::Program> program = ground(*model, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    if (!program) throw Contradiction("no IR and no error");
    return program;
}

[[noreturn]] void contradict(const std::vector<Breach>& breaches) {
    std::string text;
    for (const Breach& breach : breaches) text += breach.pass + ": " + breach.text + "\n";
    throw Contradiction(text);
}

}  // namespace

Exercised exercise(std::string_view text, const Exercise& how) {
    Sources sources;
    Diagnostics diagnostics;
    const std::optional<ir::Program> program = grounded(text, how.all_stages, sources, diagnostics);
    Exercised result{.outcome = Outcome::Rejected};
    result.complaints = render(diagnostics, sources, {});
    if (!program) return result;
    require_valid(*program, "ground");
    report_large_constant_tables(*program, diagnostics);
    result.outcome = Outcome::TooLarge;
    if (diagnostics.has_errors()) return result;
    result.operations = step_cost(*program);
    const bool has_functions = program->externals.empty();
    const bool is_small = result.operations <= how.most_operations;
    if (is_small) result.outcome = Outcome::Accepted;
    Contracts contracts = check_contracts(*program, how.passes, how.values, how.seed,
                                          is_small && has_functions ? how.steps : 0);
    result.changed = std::move(contracts.changed);
    result.breaches = std::move(contracts.breaches);
    if (how.all_stages && result.breaches.empty()) emit(contracts.optimised, sources, {});
    return result;
}

Outcome exercise(std::string_view text, std::uint64_t seed, int steps) {
    const Exercised result = exercise(text, Exercise{.seed = seed, .steps = steps});
    if (!result.breaches.empty()) contradict(result.breaches);
    return result.outcome;
}

}  // namespace rddlc::fuzzing
