#include "ir/interpreter.hpp"

#include "ir/analysis.hpp"
#include "ir/layout.hpp"

#include <rddl/values/moderate.hpp>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace rddlc::ir {
namespace {

bool do_conditions_fill_tables(const Program& program) {
    const auto does = [](const Computation& condition) {
        return fills_tables(condition.body);
    };
    return std::ranges::any_of(program.preconditions, does) ||
           std::ranges::any_of(program.invariants, does) ||
           std::ranges::any_of(program.terminations, does);
}

bool does_reset_fill_tables(const Program& program) {
    return std::ranges::any_of(program.reset, [](const Definition& definition) {
        return calls_functions(definition.body);
    });
}

// The fields of a record that a program for moderate values relies on.
std::vector<Field> relied_on(const Program& program, Storage storage) {
    if (!program.only_moderate) return {};
    const std::vector<BufferId> reals = reals_taken_for_moderate(program);
    std::vector<Field> fields = record_layout(program, storage).fields;
    std::erase_if(fields, [&](const Field& field) {
        return std::ranges::find(reals, field.buffer) == reals.end();
    });
    return fields;
}

// Reals of a record, which are moderate.
bool are_moderate(const Program& program, const std::vector<Field>& fields,
                  const std::byte* record) {
    return std::ranges::all_of(fields, [&](const Field& field) {
        const auto count = static_cast<std::size_t>(program[field.buffer].count());
        const std::span reals(reinterpret_cast<const double*>(record + field.offset), count);
        return std::ranges::all_of(
            reals, [](double real) { return rddl::is_moderate<rddl::Scalar>(real); });
    });
}

}  // namespace

Interpreter::Interpreter(Program program, ExternalFunctions functions)
    : program_(std::make_unique<const Program>(std::move(program))),
      evaluator_(*program_, functions),
      moderate_(program_->moderate
                    ? std::make_unique<const Interpreter>(**program_->moderate, functions)
                    : nullptr),
      state_reals_(relied_on(*program_, Storage::State)),
      action_reals_(relied_on(*program_, Storage::Action)),
      state_size_(record_layout(*program_, Storage::State).size),
      action_size_(record_layout(*program_, Storage::Action).size),
      observation_size_(program_->partially_observed()
                            ? record_layout(*program_, Storage::Observation).size
                            : state_size_),
      scratch_size_(std::max(record_layout(*program_, Storage::Scratch).size,
                             moderate_ ? moderate_->scratch_size() : 0)),
      memory_size_(record_layout(*program_, Storage::Memory).size),
      conditions_fill_tables_(do_conditions_fill_tables(*program_)),
      reset_fills_tables_(does_reset_fill_tables(*program_)) {}

void Interpreter::reset(std::byte* state, Context& context) const {
    reset(state, context, nullptr);
}

void Interpreter::reset(std::byte* state, Context& context, Outcomes* outcomes) const {
    initial_state(state);
    if (program_->reset.empty()) return;
    std::vector<std::byte> scratch(reset_fills_tables_ ? scratch_size_ : 0);
    const Records records =
        Records().set(Storage::State, state).set(Storage::Scratch, scratch.data());
    Evaluator::Frame frame(evaluator_, records, context, outcomes);
    for (const Definition& definition : program_->reset) evaluator_.run(definition.body, frame);
}

void Interpreter::initial_state(std::byte* state) const {
    write_initial(Storage::State, state);
}

void Interpreter::default_action(std::byte* action) const {
    write_initial(Storage::Action, action);
}

void Interpreter::write_initial(Storage storage, std::byte* record) const {
    for (const Field& field : record_layout(*program_, storage).fields) {
        write_values((*program_)[field.buffer], record + field.offset);
    }
}

double Interpreter::step(const std::byte* state, const std::byte* action, std::byte* scratch,
                         std::byte* next, std::byte* observation, Context& context) const {
    return step(state, action, scratch, next, observation, context, nullptr);
}

double Interpreter::step(const std::byte* state, const std::byte* action, std::byte* scratch,
                         std::byte* next, std::byte* observation, Context& context,
                         Outcomes* outcomes) const {
    if (moderate_ && moderate_->may_step_from(state, action))
        return moderate_->step(state, action, scratch, next, observation, context, outcomes);
    Records records;
    records.set(Storage::State, state).set(Storage::Action, action).set(Storage::Scratch, scratch);
    records.set(Storage::Next, next).set(Storage::Observation, observation);
    Evaluator::Frame frame(evaluator_, records, context, outcomes);
    for (const Definition& definition : program_->step) evaluator_.run(definition.body, frame);
    evaluator_.run(program_->reward.body, frame);
    return evaluator_.value<double>(program_->reward.value, frame);
}

bool Interpreter::may_step_from(const std::byte* state, const std::byte* action) const {
    return are_moderate(*program_, state_reals_, state) &&
           are_moderate(*program_, action_reals_, action);
}

void Interpreter::reset_policy(std::byte* memory) const {
    write_initial(Storage::Memory, memory);
}

void Interpreter::act(const std::byte* observation, const std::byte* memory, std::byte* scratch,
                      std::byte* action, std::byte* next_memory, Context& context) const {
    Records records;
    const Storage seen = program_->partially_observed() ? Storage::Observation : Storage::State;
    records.set(seen, observation).set(Storage::Memory, memory).set(Storage::Scratch, scratch);
    records.set(Storage::Action, action).set(Storage::NextMemory, next_memory);
    Evaluator::Frame frame(evaluator_, records, context);
    for (const Definition& definition : program_->policy->act)
        evaluator_.run(definition.body, frame);
}

// All are evaluated, as in the compiled simulator: one of them may fault.
bool Interpreter::terminal(const std::byte* state, Context& context) const {
    const Records records = Records().set(Storage::State, state);
    bool any = false;
    for (const Computation& condition : program_->terminations) {
        any |= holds(condition, records, context);
    }
    return any;
}

bool Interpreter::violates_invariant(const std::byte* state, Context& context) const {
    return first_violated(program_->invariants, Records().set(Storage::State, state), context) >= 0;
}

int Interpreter::violated_precondition(const std::byte* state, const std::byte* action,
                                       Context& context) const {
    const Records records = Records().set(Storage::State, state).set(Storage::Action, action);
    return first_violated(program_->preconditions, records, context);
}

int Interpreter::first_violated(const std::vector<Computation>& conditions, Records records,
                                Context& context) const {
    for (std::size_t index = 0; index < conditions.size(); ++index) {
        const bool holds_here = holds(conditions[index], records, context);
        if (!holds_here || context.fault) return static_cast<int>(index);
    }
    return -1;
}

bool Interpreter::holds(const Computation& condition, Records records, Context& context) const {
    std::vector<std::byte> scratch(conditions_fill_tables_ ? scratch_size_ : 0);
    records.set(Storage::Scratch, scratch.data());
    Evaluator::Frame frame(evaluator_, records, context);
    evaluator_.run(condition.body, frame);
    return evaluator_.value<bool>(condition.value, frame);
}

}  // namespace rddlc::ir
