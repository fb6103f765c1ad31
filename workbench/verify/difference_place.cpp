#include "verify/difference_place.hpp"

#include "ir/analysis.hpp"
#include "support/utf8.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

namespace {

bool covers(Span outer, Span inner) {
    return outer.file == inner.file && outer.begin <= inner.begin && inner.end <= outer.end;
}

std::optional<Span> definition_of(const ir::Program& program, std::uint32_t fluent,
                                  ir::Storage storage) {
    for (const ir::Definition* definition : ir::definitions_of(program)) {
        const ir::Buffer& target = program[definition->target];
        if (target.fluent == fluent && target.storage == storage) return definition->span;
    }
    return std::nullopt;
}

// Everything that says what a value or an answer is.
std::vector<Span> all_spans(const ir::Program& program) {
    std::vector<Span> spans;
    for (const ir::Definition* definition : ir::definitions_of(program))
        spans.push_back(definition->span);
    spans.push_back(program.reward.span);
    for (const auto* conditions :
         {&program.preconditions, &program.invariants, &program.terminations})
        for (const ir::Computation& condition : *conditions) spans.push_back(condition.span);
    return spans;
}

std::optional<int> read_number(std::string_view& text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.starts_with(':')) text.remove_prefix(1);
    return number;
}

// The place at the beginning of a fault's message: "file:line:column: ...".
std::optional<Span> place_in_message(std::string_view message, const Sources& sources) {
    for (FileId file = 0; file < sources.size(); ++file) {
        const std::string prefix = sources[file].path() + ":";
        if (!message.starts_with(prefix)) continue;
        std::string_view rest = message.substr(prefix.size());
        const auto line = read_number(rest);
        const auto column = line ? read_number(rest) : std::nullopt;
        if (!column) return std::nullopt;
        const std::string_view text = sources[file].line(*line);
        std::size_t offset = 0;
        for (int left = *column - 1; left > 0 && offset < text.size(); --left) {
            ++offset;  // to the next code point
            while (offset < text.size() && !begins_character(text[offset])) ++offset;
        }
        const auto begin = sources[file].line_begin(*line) + static_cast<std::uint32_t>(offset);
        return Span{file, begin, begin + 1};
    }
    return std::nullopt;
}

std::optional<Span> place_of_fault(const Difference& difference, const ir::Program& program,
                                   const Sources& sources) {
    auto place = place_in_message(difference.expected, sources);
    if (!place) place = place_in_message(difference.found, sources);
    if (!place) return std::nullopt;
    for (const Span span : all_spans(program))
        if (covers(span, *place)) return span;
    return place;
}

// The first of the conditions that ends the episode of the plain program, else the first of all.
std::optional<Span> first_that_ends(const VerifiedProblem& problem, const StepStart& start,
                                    std::uint64_t seed,
                                    std::vector<ir::Computation> ir::Program::*conditions) {
    ir::Program program = problem.plain;
    program.invariants.clear();
    program.terminations.clear();
    const std::vector<ir::Computation>& all = problem.plain.*conditions;
    for (const ir::Computation& condition : all) {
        program.*conditions = {condition};
        const StepOutcome outcome = interpret_step(program, problem.library.functions, start, seed);
        if ((outcome.causes | outcome.causes_before) != RDDL_RUNNING) return condition.span;
    }
    if (all.empty()) return std::nullopt;
    return all.front().span;
}

std::optional<Span> place_of_ending(const VerifiedProblem& problem, const Difference& difference,
                                    const StepStart& start, std::uint64_t seed) {
    const auto differs = [&](std::string_view cause) {
        return (difference.expected.find(cause) == std::string::npos) !=
               (difference.found.find(cause) == std::string::npos);
    };
    if (differs("terminated"))
        return first_that_ends(problem, start, seed, &ir::Program::terminations);
    if (differs("invariant"))
        return first_that_ends(problem, start, seed, &ir::Program::invariants);
    return std::nullopt;
}

}  // namespace

std::optional<Span> place_of(const Difference& difference, const StepStart& start,
                             const VerifiedProblem& problem, std::uint64_t seed) {
    const ir::Program& plain = problem.plain;
    switch (difference.what) {
        case Shown::State:
            if (start.initial) return definition_of(plain, *difference.fluent, ir::Storage::State);
            return definition_of(plain, *difference.fluent, ir::Storage::Next);
        case Shown::Observation:
            return definition_of(plain, *difference.fluent, ir::Storage::Observation);
        case Shown::Action:
            return definition_of(plain, *difference.fluent, ir::Storage::Action);
        case Shown::Reward:
            return plain.reward.span;
        case Shown::Precondition:
            return plain.preconditions[static_cast<std::size_t>(*difference.condition)].span;
        case Shown::Fault:
            return place_of_fault(difference, plain, problem.sources);
        case Shown::Start:
        case Shown::Ending:
            return place_of_ending(problem, difference, start, seed);
    }
    return std::nullopt;
}

}  // namespace rddlc::workbench
