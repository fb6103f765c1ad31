#include "twins.hpp"

#include "ir/analysis.hpp"
#include "ir/interpreter.hpp"
#include "ir/layout.hpp"

#include <rddl/random.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

namespace rddlc::fuzzing {
namespace {

using Record = std::vector<std::byte>;

double cost_of(const ir::Computation& computation, const std::vector<ir::Facts>& facts) {
    double cost = 0;
    for (const ir::NodeId root : ir::roots_of(computation)) cost += facts[root.index].cost;
    return cost;
}

// Calls visit(address, scalar, buffer) for every element of a record.
template <class Visit>
void for_each_element(const ir::Program& program, ir::Storage storage, Record& record,
                      const Visit& visit) {
    for (const ir::Field& field : ir::record_layout(program, storage).fields) {
        const ir::Buffer& buffer = program[field.buffer];
        const std::size_t size = ir::size_of(buffer.scalar);
        const auto count = static_cast<std::size_t>(buffer.count());
        for (std::size_t i = 0; i < count; ++i)
            visit(record.data() + field.offset + i * size, buffer);
    }
}

template <class T>
void write(std::byte* at, T value) {
    std::memcpy(at, &value, sizeof value);
}

// Objects stay within their type: the number of objects, or none for a number.
std::optional<std::int64_t> object_count(const ir::Program& program, const ir::Buffer& buffer) {
    if (!buffer.fluent) return std::nullopt;
    const auto type = program.fluents[*buffer.fluent].object_type;
    if (!type) return std::nullopt;
    return static_cast<std::int64_t>(program.types[*type].objects.size());
}

class Engine {
  public:
    Engine(ir::Program program, std::uint64_t seed)
        : interpreter_(std::move(program)),
          state_(interpreter_.state_size()),
          next_(interpreter_.state_size()),
          action_(interpreter_.action_size()),
          scratch_(interpreter_.scratch_size()),
          observation_(interpreter_.observation_size()),
          memory_(interpreter_.memory_size()),
          next_memory_(interpreter_.memory_size()),
          context_{.key = rddl::stream_key(seed, 0, 0), .step = 0, .fault = {}} {
        interpreter_.reset(state_.data(), context_);
        if (interpreter_.has_policy()) interpreter_.reset_policy(memory_.data());
    }

    // Every third value is not the default.
    void act(std::mt19937_64& random) {
        interpreter_.default_action(action_.data());
        const ir::Program& program = interpreter_.program();
        for_each_element(program, ir::Storage::Action, action_,
                         [&](std::byte* at, const ir::Buffer& buffer) {
                             const std::uint64_t draw = random();
                             if (draw % 3 == 0) write_value(at, buffer, draw / 3);
                         });
    }

    // The policy block instead, if there is one.
    void decide() {
        if (!interpreter_.has_policy()) return;
        const Record& seen = interpreter_.program().partially_observed() ? observation_ : state_;
        interpreter_.act(seen.data(), memory_.data(), scratch_.data(), action_.data(),
                         next_memory_.data(), context_);
        memory_.swap(next_memory_);
    }

    void step() {
        context_.go_to_next_step();
        reward_ = interpreter_.step(state_.data(), action_.data(), scratch_.data(), next_.data(),
                                    observation_.data(), context_);
        state_.swap(next_);
    }

    bool terminal() { return interpreter_.terminal(state_.data(), context_); }
    bool violates_invariant() { return interpreter_.violates_invariant(state_.data(), context_); }
    int violated_precondition() {
        return interpreter_.violated_precondition(state_.data(), action_.data(), context_);
    }
    bool faulty() const { return static_cast<bool>(context_.fault); }

    // Everything that the last step shows, in a form that can be compared.
    std::string seen() {
        const ir::Program& program = interpreter_.program();
        std::string text;
        const auto add = [&](std::byte* at, const ir::Buffer& buffer) {
            if (buffer.scalar == ir::Scalar::Real) make_nan_unique(at);
            text.append(reinterpret_cast<const char*>(at), ir::size_of(buffer.scalar));
        };
        for_each_element(program, ir::Storage::State, state_, add);
        if (program.partially_observed())
            for_each_element(program, ir::Storage::Observation, observation_, add);
        for_each_element(program, ir::Storage::Action, action_, add);
        for_each_element(program, ir::Storage::Memory, memory_, add);
        const double reward = std::isnan(reward_) ? std::nan("") : reward_;
        text.append(reinterpret_cast<const char*>(&reward), sizeof reward);
        return text;
    }

    std::string fault() const {
        const rddl::FaultRecord& fault = context_.fault;
        if (!fault) return "";
        const Span span = interpreter_.program().sites[fault.place.site].span;
        return "fault " + std::to_string(static_cast<int>(fault.kind)) + " at byte " +
               std::to_string(span.begin) + ", element " + std::to_string(fault.place.index);
    }

  private:
    void write_value(std::byte* at, const ir::Buffer& buffer, std::uint64_t draw) const {
        const auto whole = static_cast<std::int64_t>(draw % 21) - 10;
        if (buffer.scalar == ir::Scalar::Bool) return write(at, draw % 2 == 0);
        if (buffer.scalar == ir::Scalar::Real) return write(at, static_cast<double>(whole) / 4);
        const auto objects = object_count(interpreter_.program(), buffer);
        if (!objects) return write(at, whole);
        if (*objects > 0) write(at, static_cast<std::int64_t>(draw % 1009) % *objects);
    }

    static void make_nan_unique(std::byte* at) {
        double value;
        std::memcpy(&value, at, sizeof value);
        if (std::isnan(value)) write(at, std::nan(""));
    }

    ir::Interpreter interpreter_;
    Record state_, next_, action_, scratch_, observation_, memory_, next_memory_;
    ir::Context context_;
    double reward_ = 0;
};

}  // namespace

double step_cost(const ir::Program& program) {
    const std::vector<ir::Facts> facts = ir::all_facts(program);
    double cost = cost_of(program.reward, facts);
    for (const ir::Definition& definition : program.step) {
        double each = 1;
        for (const ir::NodeId root : ir::roots_of(definition.body)) each += facts[root.index].cost;
        cost += each * static_cast<double>(program[definition.target].count());
    }
    for (const auto* conditions :
         {&program.preconditions, &program.invariants, &program.terminations}) {
        for (const ir::Computation& condition : *conditions) cost += cost_of(condition, facts);
    }
    return cost;
}

std::optional<std::string> compare(ir::Program plain, ir::Program optimised, std::uint64_t seed,
                                   int steps) {
    Engine first(std::move(plain), seed), second(std::move(optimised), seed);
    std::mt19937_64 random(seed);
    for (int step = 0; step < steps; ++step) {
        const std::string when = " in step " + std::to_string(step);
        std::mt19937_64 same = random;
        first.act(random);
        second.act(same);
        first.decide();
        second.decide();
        if (first.violated_precondition() != second.violated_precondition())
            return "the preconditions" + when;
        first.step();
        second.step();
        if (first.fault() != second.fault())
            return "the fault" + when + ": '" + first.fault() + "', '" + second.fault() + "'";
        if (first.faulty()) return std::nullopt;
        if (first.seen() != second.seen()) return "the outcome" + when;
        if (first.violates_invariant() != second.violates_invariant())
            return "the invariants" + when;
        const bool terminal = first.terminal();
        if (terminal != second.terminal()) return "the terminations" + when;
        if (terminal || first.faulty()) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace rddlc::fuzzing
