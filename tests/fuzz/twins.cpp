#include "twins.hpp"

#include "ir/analysis.hpp"
#include "ir/interpreter.hpp"
#include "ir/layout.hpp"

#include <rddl/random/random.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

namespace rddlc::fuzzing {
namespace {

template <class T>
void write(std::byte* at, T value) {
    std::memcpy(at, &value, sizeof value);
}
template <class T>
T read(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

Context context_of(std::uint64_t seed, std::uint32_t step) {
    return {.key = rddl::stream_key(seed, 0, 0), .step = step, .fault = {}};
}

// ------------------------------------------------------------------------------ random values

class RandomValues {
  public:
    RandomValues(const ir::Program& program, Values values, bool only_moderate, std::uint64_t seed)
        : program_(program), values_(values), only_moderate_(only_moderate), random_(seed) {}

    // Leaves one value of `keep` as it is, if that is more than 0.
    void fill(ir::Storage storage, Record& record, std::uint64_t keep) {
        for (const ir::Field& field : ir::record_layout(program_, storage).fields) {
            const ir::Buffer& buffer = program_[field.buffer];
            const std::size_t size = ir::size_of(buffer.scalar);
            for (std::int64_t i = 0; i < buffer.count(); ++i) {
                std::byte* at = record.data() + field.offset + static_cast<std::size_t>(i) * size;
                if (keep == 0 || below(keep) == 0) write_value(at, buffer);
            }
        }
    }

    bool one_of(std::uint64_t count) { return below(count) == 0; }

  private:
    std::uint64_t below(std::uint64_t count) { return random_() % count; }

    void write_value(std::byte* at, const ir::Buffer& buffer) {
        if (buffer.scalar == ir::Scalar::Bool) return write(at, one_of(2));
        if (buffer.scalar == ir::Scalar::Real) return write(at, real());
        if (const auto type = object_type(buffer)) {
            const std::size_t objects = program_.types[*type].objects.size();
            if (objects > 0) write(at, static_cast<std::int64_t>(below(objects)));
            return;
        }
        write(at, integer());
    }

    std::optional<std::uint32_t> object_type(const ir::Buffer& buffer) const {
        return buffer.fluent ? program_.fluents[*buffer.fluent].object_type : std::nullopt;
    }

    std::int64_t integer() {
        constexpr std::array large = {
            std::int64_t{1} << 53, (std::int64_t{1} << 53) + 1, -(std::int64_t{1} << 53) - 1,
            std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
        if (values_ == Values::Wild && one_of(40)) return large[below(large.size())];
        return static_cast<std::int64_t>(below(21)) - 10;
    }

    // Multiples of a quarter, and now and then what they are not.
    double real() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        constexpr std::array other = {-0.0, 0.1, 0.30000000000000004, 1.0 / 3.0, -2.4, 1e9, 1e-12};
        constexpr std::array edges = {
            infinity, -infinity, 1e15, 1e200, -1e300, std::numeric_limits<double>::quiet_NaN()};
        if (values_ == Values::Wild && one_of(8)) return one_of(2) ? 0.0 : -0.0;
        const double quarters = static_cast<double>(below(81)) / 4 - 10;
        if (values_ == Values::Tame || one_of(2)) return quarters;
        if (!only_moderate_ && one_of(6)) return edges[below(edges.size())];
        return one_of(3) ? other[below(other.size())] : quarters * 0.1;
    }

    const ir::Program& program_;
    Values values_;
    bool only_moderate_;
    std::mt19937_64 random_;
};

// --------------------------------------------------------------------------------- programs

Record observed(const ir::Interpreter& engine, const Situation& at) {
    return engine.program().partially_observed() ? at.observation : at.state;
}

Shown shown(const ir::Interpreter& engine, const Situation& at, Record& scratch,
            std::uint64_t seed) {
    Shown result;
    result.next.resize(engine.state_size());
    result.observation.resize(engine.observation_size());
    result.action.resize(engine.action_size());
    result.memory.resize(engine.memory_size());
    if (engine.has_policy()) {
        Context context = context_of(seed, at.step);
        engine.act(observed(engine, at).data(), at.memory.data(), scratch.data(),
                   result.action.data(), result.memory.data(), context);
        result.of_policy = context.fault;
    }
    Context conditions = context_of(seed, at.step);
    const std::byte* state = at.state.data();
    result.violated_precondition =
        engine.violated_precondition(state, at.action.data(), conditions);
    Context ends = context_of(seed, at.step);
    result.terminal = engine.terminal(state, ends);
    result.is_over = result.terminal || ends.fault;
    if (ends.fault && !conditions.fault) conditions.fault = ends.fault;
    Context context = context_of(seed, at.step);
    result.reward = engine.step(state, at.action.data(), scratch.data(), result.next.data(),
                                result.observation.data(), context);
    result.of_step = context.fault;
    if (!result.of_step) {
        result.next_violates_invariant = engine.violates_invariant(result.next.data(), conditions);
        result.next_terminal = engine.terminal(result.next.data(), conditions);
    }
    result.of_conditions = conditions.fault;
    return result;
}

// ------------------------------------------------------------------------------ differences

// The first difference, in the order in which they are looked for.
class Comparison {
  public:
    Comparison(const ir::Program& program, const Tolerance& tolerance)
        : program_(program), tolerance_(tolerance) {}

    bool found_none() const { return text_.empty(); }
    const std::string& text() const { return text_; }

    void expect(const std::string& what, bool expected, bool found) {
        if (found_none() && expected != found) text_ = told(what, expected, found);
    }
    void expect(const std::string& what, int expected, int found) {
        if (found_none() && expected != found) text_ = told(what, expected, found);
    }
    void expect(const std::string& what, double expected, double found) {
        if (found_none() && !same(expected, found)) text_ = told(what, expected, found);
    }
    void expect(const std::string& what, ir::Storage storage, const Record& expected,
                const Record& found) {
        if (!found_none() || expected == found) return;
        if (expected.size() != found.size()) {
            text_ = told(what + " in bytes", expected.size(), found.size());
            return;
        }
        for (const ir::Field& field : ir::record_layout(program_, storage).fields) {
            const ir::Buffer& buffer = program_[field.buffer];
            for (std::int64_t i = 0; i < buffer.count() && found_none(); ++i) {
                const std::size_t at =
                    field.offset + static_cast<std::size_t>(i) * ir::size_of(buffer.scalar);
                const std::string name = fmt::format("{} of {}[{}]", what, buffer.name, i);
                expect_element(name, buffer.scalar, expected.data() + at, found.data() + at);
            }
        }
    }

  private:
    template <class T>
    static std::string told(const std::string& what, const T& expected, const T& found) {
        return fmt::format("{}: {} before, {} after", what, expected, found);
    }

    void expect_element(const std::string& what, ir::Scalar scalar, const std::byte* expected,
                        const std::byte* found) {
        if (scalar == ir::Scalar::Real)
            return expect(what, read<double>(expected), read<double>(found));
        if (scalar == ir::Scalar::Bool)
            return expect(what, read<bool>(expected), read<bool>(found));
        const auto first = read<std::int64_t>(expected), second = read<std::int64_t>(found);
        if (first != second) text_ = told(what, first, second);
    }

    bool same(double expected, double found) const {
        if (std::isnan(expected) && std::isnan(found)) return true;
        if (expected == found)  // zeros of both signs are
            return tolerance_.relative > 0 || std::signbit(expected) == std::signbit(found);
        if (!std::isfinite(expected) || !std::isfinite(found)) return tolerance_.not_finite;
        const double size = std::max({1.0, std::abs(expected), std::abs(found)});
        return std::abs(expected - found) <= tolerance_.relative * size;
    }

    const ir::Program& program_;
    const Tolerance& tolerance_;
    std::string text_;
};

void expect_step(Comparison& comparison, const Shown& expected, const Shown& found) {
    comparison.expect("whether the policy faults", expected.of_policy.kind != rddl::FaultKind::None,
                      static_cast<bool>(found.of_policy));
    if (!expected.of_policy) {
        comparison.expect("the action", ir::Storage::Action, expected.action, found.action);
        comparison.expect("the memory", ir::Storage::Memory, expected.memory, found.memory);
    }
    comparison.expect("the first precondition violated", expected.violated_precondition,
                      found.violated_precondition);
    comparison.expect("whether the state is terminal", expected.terminal, found.terminal);
    comparison.expect("whether the state is over", expected.is_over, found.is_over);
    if (expected.is_over) return;
    // A state that was rounded may lie on the other side of a bound.
    if (expected.next == found.next) {
        comparison.expect("whether the next state violates an invariant",
                          expected.next_violates_invariant, found.next_violates_invariant);
        comparison.expect("whether the next state is terminal", expected.next_terminal,
                          found.next_terminal);
    }
    comparison.expect("whether a condition faults", static_cast<bool>(expected.of_conditions),
                      static_cast<bool>(found.of_conditions));
    comparison.expect("whether the step faults", static_cast<bool>(expected.of_step),
                      static_cast<bool>(found.of_step));
    if (expected.of_step) return;
    comparison.expect("the next state", ir::Storage::State, expected.next, found.next);
    comparison.expect("the observation", ir::Storage::Observation, expected.observation,
                      found.observation);
    comparison.expect("the reward", expected.reward, found.reward);
}

double cost_of(const ir::Computation& computation, const std::vector<ir::Properties>& properties) {
    double cost = 0;
    for (const ir::NodeId root : ir::roots_of(computation)) cost += properties[root.index].cost;
    return cost;
}

}  // namespace

std::vector<Situation> situations(const ir::Program& program, Values values, bool only_moderate,
                                  std::uint64_t seed, int count) {
    const ir::Interpreter engine(program);
    RandomValues random(program, values, only_moderate, seed);
    Record scratch(engine.scratch_size());
    Situation now{.state = Record(engine.state_size()),
                  .observation = Record(engine.observation_size()),
                  .memory = Record(engine.memory_size()),
                  .action = Record(engine.action_size()),
                  .step = 0};
    Context reset = context_of(seed, 0);
    engine.reset(now.state.data(), reset);
    if (engine.has_policy()) engine.reset_policy(now.memory.data());
    std::vector<Situation> result;
    while (std::ssize(result) < count) {
        ++now.step;
        engine.default_action(now.action.data());
        random.fill(ir::Storage::Action, now.action, 3);
        if (!engine.may_step_from(now.state.data(), now.action.data()))
            engine.reset(now.state.data(), reset);
        Shown follows = shown(engine, now, scratch, seed);
        if (engine.has_policy() && !follows.of_policy && random.one_of(2)) {
            now.action = follows.action;
            follows = shown(engine, now, scratch, seed);
        }
        result.push_back(now);
        if (!follows.of_step && !follows.of_policy) {
            now.state = std::move(follows.next);
            now.observation = std::move(follows.observation);
            now.memory = std::move(follows.memory);
        }
        if (random.one_of(2)) random.fill(ir::Storage::State, now.state, random.one_of(2) ? 0 : 4);
    }
    return result;
}

Story story(const ir::Program& program, const std::vector<Situation>& situations,
            std::uint64_t seed) {
    const ir::Interpreter engine(program);
    Story result;
    result.initial.resize(engine.state_size());
    Context reset = context_of(seed, 0);
    engine.reset(result.initial.data(), reset);
    result.of_reset = reset.fault;
    Record scratch(engine.scratch_size());
    for (const Situation& at : situations) result.steps.push_back(shown(engine, at, scratch, seed));
    return result;
}

std::optional<std::string> difference(const ir::Program& program, const Story& expected,
                                      const Story& found, const Tolerance& tolerance) {
    Comparison comparison(program, tolerance);
    comparison.expect("whether the reset faults", static_cast<bool>(expected.of_reset),
                      static_cast<bool>(found.of_reset));
    if (!expected.of_reset) {
        comparison.expect("the initial state", ir::Storage::State, expected.initial, found.initial);
    }
    for (std::size_t i = 0; i < expected.steps.size(); ++i) {
        expect_step(comparison, expected.steps[i], found.steps[i]);
        if (!comparison.found_none()) return fmt::format("step {}: {}", i, comparison.text());
    }
    if (comparison.found_none()) return std::nullopt;
    return comparison.text();
}

double step_cost(const ir::Program& program) {
    const std::vector<ir::Properties> properties = ir::all_properties(program);
    double cost = cost_of(program.reward, properties);
    for (const ir::Definition& definition : program.step) {
        double each = 1;
        for (const ir::NodeId root : ir::roots_of(definition.body))
            each += properties[root.index].cost;
        cost += each * static_cast<double>(program[definition.target].count());
    }
    for (const auto* conditions :
         {&program.preconditions, &program.invariants, &program.terminations}) {
        for (const ir::Computation& condition : *conditions) cost += cost_of(condition, properties);
    }
    return cost;
}

}  // namespace rddlc::fuzzing
