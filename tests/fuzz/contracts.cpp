#include "contracts.hpp"

#include "ir/analysis.hpp"
#include "ir/builder.hpp"
#include "ir/interpreter.hpp"
#include "ir/layout.hpp"
#include "ir/nest.hpp"
#include "ir/print.hpp"
#include "ir/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rddlc::fuzzing {
namespace {

constexpr double roughly = 1e-9;
constexpr double most_operations = 2e5;  // of all steps of one program

// A pass, and the program that it has made where that differs from the one before.
struct Made {
    std::string pass;
    ir::Program program;
    std::string text = ir::print(program);
};

// The text does not show all of a table.
bool same_program(const Made& a, const Made& b) {
    const auto same_buffer = [](const ir::Buffer& x, const ir::Buffer& y) {
        return identical(x.values, y.values);
    };
    return a.text == b.text &&
           std::ranges::equal(a.program.buffers, b.program.buffers, same_buffer);
}

std::optional<std::string> complaints_about(const ir::Program& program) {
    const std::vector<std::string> complaints = ir::verify(program);
    if (complaints.empty()) return std::nullopt;
    return fmt::format("the IR is not valid: {}", fmt::join(complaints, "; "));
}

// Fewer where they are expensive.
int affordable_steps(const ir::Program& program, int most) {
    const double steps = most_operations / std::max(1.0, step_cost(program));
    return std::clamp(static_cast<int>(std::min(steps, 1e3)), 3, std::max(3, most));
}

// With --fast-math a step starts only in states within the invariants, which are checked before it.
void drop_states_out_of_bounds(const ir::Program& program, std::vector<Situation>& tried) {
    const ir::Interpreter engine(program);
    std::erase_if(tried, [&](const Situation& at) {
        Context context;
        return engine.violates_invariant(at.state.data(), context);
    });
}

// The same actions, with false for all bools of some tables.
std::vector<Situation> with_nothing_chosen(const ir::Program& program, std::vector<Situation> tried,
                                           const std::vector<ir::BufferId>& choices) {
    for (const ir::Field& field : ir::record_layout(program, ir::Storage::Action).fields) {
        if (std::ranges::find(choices, field.buffer) == choices.end()) continue;
        for (Situation& at : tried)
            std::fill_n(at.action.begin() + static_cast<std::ptrdiff_t>(field.offset),
                        program[field.buffer].count(), std::byte{0});
    }
    return tried;
}

// A definition that keeps a table of the state copies it, and does nothing else.
ir::Program with_copy(ir::Program program, std::size_t number) {
    ir::Definition& definition = program.step[number];
    const ir::Nest nest = ir::nest_of(std::get<ir::Loop>(definition.body.back().form));
    ir::Store store = std::get<ir::Store>(nest.body->back().form);
    store.value = ir::Builder(program).load(*definition.unchosen->kept, store.indices);
    definition.body = ir::looped({{std::move(store)}}, nest.variables);
    definition.unchosen.reset();
    return program;
}

// All tables that a definition fills are zero.
void fill_with_zeros(ir::Program& program, ir::Block& block) {
    for (ir::Statement& statement : block) {
        if (auto* loop = std::get_if<ir::Loop>(&statement.form))
            fill_with_zeros(program, loop->body);
        if (auto* spread = std::get_if<ir::Spread>(&statement.form))
            spread->bits = ir::Builder(program).constant(std::int64_t{0});
        auto* store = std::get_if<ir::Store>(&statement.form);
        if (!store) continue;
        const ir::Scalar scalar = program[store->target].scalar;
        ir::Builder builder(program);
        store->value = scalar == ir::Scalar::Bool  ? builder.constant(false)
                       : scalar == ir::Scalar::Int ? builder.constant(std::int64_t{0})
                                                   : builder.constant(0.0);
    }
}
ir::Program with_zeros(ir::Program program, std::size_t number) {
    ir::Block body = std::move(program.step[number].body);
    fill_with_zeros(program, body);
    program.step[number].body = std::move(body);
    return program;
}

// Where an action chooses nothing, emitted code copies a table that the interpreter computes
// (passes/lanes/keep_unchosen.hpp), or leaves out what nothing reads
// (passes/lanes/skip_unread.hpp).
std::optional<std::string> difference_of_copies(const ir::Program& program,
                                                const std::vector<Situation>& tried,
                                                std::uint64_t seed) {
    for (std::size_t i = 0; i < program.step.size(); ++i) {
        const auto& unchosen = program.step[i].unchosen;
        if (!unchosen) continue;
        const std::vector<Situation> still = with_nothing_chosen(program, tried, unchosen->choices);
        if (auto text = difference(
                program, story(program, still, seed),
                story(unchosen->kept ? with_copy(program, i) : with_zeros(program, i), still, seed),
                {.relative = 0, .not_finite = program.assumes_finite}))
            return "where nothing is chosen: " + *text;
    }
    return std::nullopt;
}

}  // namespace

Tolerance tolerance_of(std::string_view pass) {
    if (pass == "fast_math" || pass == "straighten_rows" || pass == "prove_invariants")
        return {.relative = roughly, .not_finite = true};
    return {};
}

namespace {

// Checks a program by itself.
Contracts check_alone(const ir::Program& program, const PassOptions& options, Values values,
                      std::uint64_t seed, int steps) {
    Contracts result;
    std::vector<Made> history = {{"ground", program}};
    PassOptions watched = options;
    watched.observe = [&](const PassRun& run, const ir::Program& made) {
        const bool reports =
            std::ranges::any_of(run.report, [](const auto& row) { return row.second != 0; });
        Made now = {std::string(run.name), made};
        const bool differs = !same_program(history.back(), now);
        if (reports || differs) ++result.changed[std::string(run.name)];
        if (!is_finished(run.name, made))
            result.breaches.push_back({std::string(run.name), "a second run would change more"});
        if (!differs) return;
        history.push_back(std::move(now));
        if (const auto complaints = complaints_about(made)) {
            result.breaches.push_back({std::string(run.name), *complaints});
        }
    };
    result.optimised = optimise(program, watched);
    if (!result.breaches.empty() || steps == 0) return result;  // an invalid program is not run
    const bool only_moderate = program.only_moderate || options.fast_math;
    std::vector<Situation> tried =
        situations(program, values, only_moderate, seed, affordable_steps(program, steps));
    if (options.fast_math) drop_states_out_of_bounds(program, tried);
    Story before = story(program, tried, seed);
    for (std::size_t i = 1; i < history.size(); ++i) {
        Story after = story(history[i].program, tried, seed);
        Tolerance tolerance = tolerance_of(history[i].pass);
        tolerance.not_finite |= history[i].program.assumes_finite;
        if (const auto text = difference(program, before, after, tolerance)) {
            result.breaches.push_back({history[i].pass, *text});
        }
        if (history[i].pass == "keep_unchosen" || history[i].pass == "skip_unread")
            if (const auto text = difference_of_copies(history[i].program, tried, seed))
                result.breaches.push_back({history[i].pass, *text});
        before = std::move(after);
    }
    return result;
}

// Both programs must show the same in moderate situations.
std::optional<std::string> difference_of_moderate(const ir::Program& any,
                                                  const ir::Program& moderate, Values values,
                                                  std::uint64_t seed, int steps) {
    const std::vector<Situation> tried =
        situations(moderate, values, true, seed, affordable_steps(any, steps));
    return difference(any, story(any, tried, seed), story(moderate, tried, seed), {});
}

// In any situation, whichever step is made in it: it depends on a test whether that is the one for
// moderate values.
std::optional<std::string> difference_of_choice(const ir::Program& any, const ir::Program& both,
                                                Values values, std::uint64_t seed, int steps) {
    const std::vector<Situation> tried =
        situations(any, values, false, seed, affordable_steps(any, steps));
    return difference(any, story(any, tried, seed), story(both, tried, seed), {});
}

// Conditions of moderate states are not emitted: they are asked of the next state as well, which
// need not be moderate.
ir::Program without_conditions(ir::Program program) {
    program.preconditions.clear();
    program.invariants.clear();
    program.terminations.clear();
    return program;
}

}  // namespace

Contracts check_contracts(const ir::Program& program, const PassOptions& options, Values values,
                          std::uint64_t seed, int steps) {
    if (!program.moderate) return check_alone(program, options, values, seed, steps);
    if (options.fast_math) return check_alone(**program.moderate, options, values, seed, steps);
    ir::Program any = program;
    const ir::Program moderate = std::move(**std::exchange(any.moderate, std::nullopt));
    Contracts result = check_alone(any, options, values, seed, steps);
    Contracts other = check_alone(without_conditions(moderate), options, values, seed, steps);
    for (const auto& [pass, runs] : other.changed) result.changed[pass] += runs;
    std::ranges::move(other.breaches, std::back_inserter(result.breaches));
    if (result.breaches.empty() && steps > 0) {
        if (const auto text = difference_of_moderate(any, moderate, values, seed, steps))
            result.breaches.push_back({"ground", "for moderate values: " + *text});
        result.optimised = optimise(program, options);
        for (const ir::Program& both : {program, result.optimised})
            if (const auto text = difference_of_choice(any, both, values, seed, steps))
                result.breaches.push_back({"ground", "by the choice of a step: " + *text});
    }
    return result;
}

}  // namespace rddlc::fuzzing
