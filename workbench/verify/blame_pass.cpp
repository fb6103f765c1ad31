#include "verify/blame_pass.hpp"

#include "ir/interpreter.hpp"
#include "ir/verify.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>

#include <utility>

namespace rddlc::workbench {

namespace {

std::string fault_text(const ir::Program& program, const rddl::FaultRecord& fault) {
    if (!fault) return "";
    const Span span = program.sites[fault.place.site].span;
    return fmt::format("fault {} at {}:{}, element {}, by {}", static_cast<int>(fault.kind),
                       span.file, span.begin, fault.place.index, fault.value);
}

// The program without the one for moderate values beside it, which would make most steps.
ir::Program alone(ir::Program program) {
    program.moderate.reset();
    return program;
}

// The records of one environment.
class Repetition {
  public:
    Repetition(const ir::Program& program, const ir::ExternalFunctions& functions,
               const StepStart& start, std::uint64_t seed)
        : interpreter_(alone(program), functions),
          start_(start),
          key_(rddl::stream_key(seed, static_cast<std::uint64_t>(start.environment),
                                static_cast<std::uint64_t>(start.episode))),
          scratch_(interpreter_.scratch_size()) {}

    void round_by(ir::Rounding& rounding) { interpreter_.round_by(rounding); }

    StepOutcome initial() const {
        StepOutcome outcome;
        outcome.state.resize(interpreter_.state_size());
        Context context = context_of(0);
        interpreter_.reset(outcome.state.data(), context);
        outcome.causes_before =
            interpreter_.terminal(outcome.state.data(), context) ? RDDL_TERMINATED : RDDL_RUNNING;
        if (context.fault) outcome.causes_before = RDDL_FAULTED;
        return outcome;
    }

    bool may_step() const {
        return interpreter_.may_step_from(start_.state.data(), start_.action.data());
    }

    StepOutcome step() {
        StepOutcome outcome;
        outcome.action = decide();
        Context asked = context_of(start_.step + 1);
        outcome.violated_precondition =
            interpreter_.violated_precondition(start_.state.data(), start_.action.data(), asked);
        Context context = context_of(start_.step + 1);
        outcome.state.resize(interpreter_.state_size());
        outcome.observation.resize(interpreter_.observation_size());
        outcome.reward =
            interpreter_.step(start_.state.data(), start_.action.data(), scratch_.data(),
                              outcome.state.data(), outcome.observation.data(), context);
        const bool terminal = interpreter_.terminal(outcome.state.data(), context);
        const bool violated = interpreter_.violates_invariant(outcome.state.data(), context);
        outcome.causes = static_cast<std::uint8_t>((terminal ? RDDL_TERMINATED : 0) |
                                                   (violated ? RDDL_TRUNCATED_INVARIANT : 0));
        outcome.fault = fault_text(interpreter_.program(), context.fault);
        if (!interpreter_.program().partially_observed()) outcome.observation.clear();
        if (context.fault) {
            outcome.causes = RDDL_FAULTED;
            outcome.state = start_.state;
        }
        return outcome;
    }

  private:
    Context context_of(std::int64_t step) const {
        Context context{.key = key_, .step = static_cast<std::uint32_t>(step), .fault = {}};
        return context;
    }

    // The decision of the policy block after all its observations.
    std::optional<Record> decide() {
        if (start_.seen.empty()) return std::nullopt;
        Record memory(interpreter_.memory_size()), next(interpreter_.memory_size());
        Record action(interpreter_.action_size());
        interpreter_.reset_policy(memory.data());
        for (std::size_t step = 0; step < start_.seen.size(); ++step) {
            Context context = context_of(static_cast<std::int64_t>(step) + 1);
            interpreter_.act(start_.seen[step].data(), memory.data(), scratch_.data(),
                             action.data(), next.data(), context);
            memory.swap(next);
        }
        return action;
    }

    ir::Interpreter interpreter_;
    const StepStart& start_;
    rddl::StreamKey key_;
    Record scratch_;
};

}  // namespace

Pipeline pipeline_of(const PassOptions& options) {
    return [options](ir::Program program, const TellProgram& tell) {
        PassOptions observed = options;
        observed.observe = [&](const PassRun& run, const ir::Program& made) {
            tell(run.name, made);
        };
        optimise(std::move(program), observed);
    };
}

std::optional<std::string> pass_to_blame(const ir::Program& plain, const Pipeline& pipeline,
                                         const ir::ExternalFunctions& functions,
                                         const StepRepetition& repetition) {
    const auto outcome_of = [&](const ir::Program& program) {
        return interpret_step(program, functions, repetition.start, repetition.seed);
    };
    const auto is_concerned = [&](const ir::Program& program) {
        return Repetition(program, functions, repetition.start, repetition.seed).may_step();
    };
    const StepOutcome expected = outcome_of(plain);
    std::optional<std::string> found;
    pipeline(plain, [&](std::string_view pass, const ir::Program& program) {
        if (found || !is_concerned(program)) return;
        ValueCounts ignored;
        if (repetition.comparison.compare(expected, outcome_of(program), repetition.tolerance,
                                          ignored))
            found = pass;
    });
    return found;
}

std::optional<InvalidProgram> invalid_program(const ir::Program& plain, const Pipeline& pipeline) {
    std::optional<InvalidProgram> found;
    pipeline(plain, [&](std::string_view pass, const ir::Program& program) {
        if (found) return;
        const auto complaints = ir::verify(program);
        if (!complaints.empty()) found = InvalidProgram{std::string(pass), complaints.front()};
    });
    return found;
}

StepOutcome interpret_step(const ir::Program& program, const ir::ExternalFunctions& functions,
                           const StepStart& start, std::uint64_t seed) {
    Repetition repetition(program, functions, start, seed);
    return start.initial ? repetition.initial() : repetition.step();
}

std::vector<StepOutcome> interpret_step_otherwise(const ir::Program& program,
                                                  const ir::ExternalFunctions& functions,
                                                  const StepStart& start, std::uint64_t seed) {
    constexpr std::uint64_t repetitions = 16;
    std::vector<StepOutcome> outcomes;
    for (std::uint64_t k = 0; k < repetitions; ++k) {
        ir::Rounding rounding(k);
        Repetition repetition(program, functions, start, seed);
        repetition.round_by(rounding);
        outcomes.push_back(repetition.step());
    }
    return outcomes;
}

std::optional<StepOutcome> repeat_step(const VerifiedEngine& engine, std::int64_t count,
                                       const StepStart& start, std::uint64_t seed) {
    VerifiedEnvironments environments(engine, count, seed, RDDL_NO_HORIZON);
    const std::vector<std::uint8_t> all(static_cast<std::size_t>(count), 1);
    for (std::int64_t i = 0; i < start.episode; ++i) environments.restart(all);
    const auto outcome = [&](const std::vector<StepOutcome>& outcomes) {
        return outcomes[static_cast<std::size_t>(start.environment)];
    };
    if (start.initial) return outcome(environments.look());
    std::vector<std::byte> actions;
    for (std::int64_t i = 0; i < count; ++i)
        actions.insert(actions.end(), start.action.begin(), start.action.end());
    actions.resize(std::max<std::size_t>(actions.size(), 1));
    for (std::int64_t made = 0; made <= start.step; ++made) {
        if (environments.steps(start.environment) != made) return std::nullopt;
        for (std::int64_t i = 0; i < count; ++i) environments.set_state(i, start.state);
        const auto outcomes = environments.step(actions);
        if (made == start.step) return outcome(outcomes);
    }
    return std::nullopt;
}

}  // namespace rddlc::workbench
