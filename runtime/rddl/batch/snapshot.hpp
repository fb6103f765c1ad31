// One environment as bytes, which every simulator of the problem reads, compiled or interpreted:
// the episode, its random numbers, and the records of the C interface one behind the other, each at
// a multiple of 8 bytes.
#pragma once

#include <rddl/batch/environment.hpp>
#include <rddl/simulator.h>
#include <rddl/step/episode.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace rddl {

// All but the records.
struct SnapshotHead {
    std::uint64_t fingerprint;  // of the problem
    std::uint64_t size;         // bytes of the whole snapshot
    std::int64_t number;
    StepCounts<Scalar> steps;
    std::uint64_t key_low, key_high;
    Stream stream;
    Ends<Scalar> ends;
    bool has_fault, has_last_step;
    FaultRecord fault;
    std::int64_t fault_steps;
    StreamKey last_key;  // of the last step, if there is one
    std::uint32_t last_number;
};
static_assert(std::is_trivially_copyable_v<SnapshotHead>);

// Calls use(record, size) for the records of an environment, in their order.
template <class AnyEnvironment, class Use>
void for_each_snapshot_record(const rddl_problem& problem, std::size_t memory_size,
                              AnyEnvironment& environment, Use&& use) {
    const auto state_size = static_cast<std::size_t>(problem.state_size);
    use(environment.state[0], state_size);
    use(environment.observation[0], static_cast<std::size_t>(problem.observation_size));
    use(environment.memory[0], memory_size);
    use(environment.last_state[0], state_size);
    use(environment.last_action[0], static_cast<std::size_t>(problem.action_size));
}

// The same values of a head and of an environment, as references.
template <class Head>
auto values_in_head(Head& head) {
    return std::tie(head.number, head.steps, head.key_low, head.key_high, head.stream, head.ends,
                    head.has_fault);
}
template <class AnyEnvironment>
auto values_in_environment(AnyEnvironment& environment) {
    auto& episode = environment.episode;
    return std::tie(episode.number, episode.steps, episode.key_low, episode.key_high,
                    environment.stream, episode.ends, episode.has_fault);
}

constexpr std::size_t rounded_to_words(std::size_t size) {
    return (size + 7) / 8 * 8;
}

inline std::size_t snapshot_size(const rddl_problem& problem, std::size_t memory_size) {
    return sizeof(SnapshotHead) +
           2 * rounded_to_words(static_cast<std::size_t>(problem.state_size)) +
           rounded_to_words(static_cast<std::size_t>(problem.observation_size)) +
           rounded_to_words(memory_size) +
           rounded_to_words(static_cast<std::size_t>(problem.action_size));
}

inline void write_snapshot(const rddl_problem& problem, std::size_t memory_size,
                           const Environment& environment, std::byte* to) {
    std::memset(to, 0, snapshot_size(problem, memory_size));
    SnapshotHead head{};
    head.fingerprint = problem.fingerprint;
    head.size = snapshot_size(problem, memory_size);
    const Episodes<Scalar>& episode = environment.episode;
    values_in_head(head) = values_in_environment(environment);
    if (head.has_fault) {
        head.fault = episode.faults[0];
        head.fault_steps = episode.fault_steps[0];
    }
    head.has_last_step = environment.last_step.has_value();
    if (head.has_last_step) {
        head.last_key = environment.last_step->key;
        head.last_number = environment.last_step->step;
    }
    std::memcpy(to, &head, sizeof head);
    to += sizeof head;
    for_each_snapshot_record(problem, memory_size, environment,
                             [&](const std::byte* record, std::size_t size) {
                                 if (size > 0) std::memcpy(to, record, size);
                                 to += rounded_to_words(size);
                             });
}

// Whether it begins as a snapshot of this problem does.
inline bool is_snapshot_of(const rddl_problem& problem, std::size_t memory_size,
                           const std::byte* from) {
    SnapshotHead head;
    std::memcpy(&head, from, sizeof head);
    return head.fingerprint == problem.fingerprint &&
           head.size == snapshot_size(problem, memory_size);
}

inline void read_snapshot(const rddl_problem& problem, std::size_t memory_size,
                          const std::byte* from, Environment& environment) {
    SnapshotHead head;
    std::memcpy(&head, from, sizeof head);
    from += sizeof head;
    Episodes<Scalar>& episode = environment.episode;
    values_in_environment(environment) = values_in_head(head);
    episode.faults[0] = head.fault;
    episode.fault_steps[0] = head.fault_steps;
    environment.last_step.reset();
    if (head.has_last_step) {
        environment.last_step.emplace();
        environment.last_step->key = head.last_key;
        environment.last_step->step = head.last_number;
    }
    for_each_snapshot_record(problem, memory_size, environment,
                             [&](std::byte* record, std::size_t size) {
                                 if (size > 0) std::memcpy(record, from, size);
                                 from += rounded_to_words(size);
                             });
}

}  // namespace rddl
