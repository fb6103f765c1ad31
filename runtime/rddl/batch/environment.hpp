// Records in memory of their own, and one environment apart from a batch.
#pragma once

#include <rddl/simulator.h>
#include <rddl/step/episode.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <vector>

namespace rddl {

// Zeroed records of one size, one after the other, beginning at a cache line of their own.
class Records {
  public:
    Records(std::size_t count, std::size_t size) : size_(size), lines_(lines(count, size)) {}

    std::byte* operator[](std::int64_t i) {
        return reinterpret_cast<std::byte*>(lines_.data()) + offset(i);
    }
    const std::byte* operator[](std::int64_t i) const {
        return reinterpret_cast<const std::byte*>(lines_.data()) + offset(i);
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64]{};
    };

    // At least one, so that empty records have an address too.
    static std::size_t lines(std::size_t count, std::size_t size) {
        if (size > 0 && count > std::numeric_limits<std::size_t>::max() / 2 / size)
            throw std::bad_alloc();
        return count * size / sizeof(Line) + 1;
    }
    std::size_t offset(std::int64_t i) const { return static_cast<std::size_t>(i) * size_; }

    std::size_t size_;
    std::vector<Line> lines_;
};

// One environment, apart from a batch: records of the C interface, and its episode.
struct Environment {
    explicit Environment(const rddl_problem& problem, std::size_t memory_size)
        : state(1, static_cast<std::size_t>(problem.state_size)),
          observation(1, static_cast<std::size_t>(problem.observation_size)),
          memory(1, memory_size),
          last_state(1, static_cast<std::size_t>(problem.state_size)),
          last_action(1, static_cast<std::size_t>(problem.action_size)) {}

    Records state, observation, memory;
    Records last_state, last_action;
    std::optional<Context<Scalar>> last_step;  // empty: it has made no step, or does not keep it
    Episodes<Scalar> episode;
    Stream stream{};
};

// The last step of an environment: from where it went, by which action and with which random
// numbers. Records of the C interface, with plain bools.
struct LastStep {
    const std::byte* state;
    const std::byte* action;
    Context<Scalar> context;
};

}  // namespace rddl
