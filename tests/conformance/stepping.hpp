// Batches of a simulator that take the same random actions, and their results.
#pragma once

#include <rddl/simulator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace stepping {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] inline void give_up(const std::string& why) {
    std::fprintf(stderr, "error: %s\n", why.c_str());
    std::exit(2);
}

// The results of a step, and the state after it.
struct Told {
    Bytes observations, final_observations, states, terminated, truncated, causes;
    std::vector<double> rewards;

    Told(const rddl_problem& problem, std::size_t count)
        : observations(count * static_cast<std::size_t>(problem.observation_size)),
          final_observations(observations.size()),
          states(count * static_cast<std::size_t>(problem.state_size)),
          terminated(count),
          truncated(count),
          causes(count),
          rewards(count) {}
};

// The name of what differs first, or nothing. Rewards are compared as bits.
inline const char* difference(const Told& one, const Told& other) {
    if (one.causes != other.causes) return "causes";
    if (one.terminated != other.terminated) return "terminated";
    if (one.truncated != other.truncated) return "truncated";
    if (one.states != other.states) return "states";
    if (one.observations != other.observations) return "observations";
    if (one.final_observations != other.final_observations) return "final observations";
    const std::size_t size = one.rewards.size() * sizeof(double);
    return std::memcmp(one.rewards.data(), other.rewards.data(), size) == 0 ? nullptr : "rewards";
}

class ObservedBatch {
  public:
    ObservedBatch(const rddl_simulator& simulator, std::int64_t count, int lanes, int threads)
        : told(*simulator.problem, static_cast<std::size_t>(count)),
          simulator_(simulator),
          count_(count) {
        rddl_batch_options options{};
        options.environment_count = count;
        options.first_environment = 3;
        options.seed = 42;
        options.thread_count = threads;
        options.autoreset = RDDL_AUTORESET_SAME_STEP;
        options.lane_count = lanes;
        batch_ = simulator.create(&simulator, &options);
        if (!batch_) give_up("no batch");
    }
    ObservedBatch(const ObservedBatch&) = delete;
    ObservedBatch& operator=(const ObservedBatch&) = delete;
    ~ObservedBatch() { simulator_.destroy(batch_); }

    rddl_batch* get() { return batch_; }
    const rddl_simulator& simulator() const { return simulator_; }

    void step(const Bytes& actions) {
        rddl_transition out{};
        out.observations = told.observations.data();
        out.rewards = told.rewards.data();
        out.terminated = told.terminated.data();
        out.truncated = told.truncated.data();
        out.causes = told.causes.data();
        out.final_observations = told.final_observations.data();
        if (simulator_.step(batch_, actions.data(), &out) != RDDL_OK) give_up("refused actions");
        if (simulator_.get_state(batch_, 0, count_, told.states.data()) != RDDL_OK)
            give_up("refused to tell states");
    }

    Told told;

  private:
    const rddl_simulator& simulator_;
    std::int64_t count_;
    rddl_batch* batch_;
};

// Records hold usual values, or whatever callers may give: nan, the greatest ints and other bytes
// than 1 for true.
enum class Given { Usual, Anything };

// Random records of actions or states.
class Records {
  public:
    Records(const rddl_simulator& simulator, std::size_t count, rddl_role role,
            Given given = Given::Usual)
        : size_(static_cast<std::size_t>(role == RDDL_ACTION ? simulator.problem->action_size
                                                             : simulator.problem->state_size)),
          records(count * size_ + 1),
          simulator_(simulator),
          count_(count),
          role_(role),
          given_(given),
          choices_(simulator.action_choice_count(&simulator)) {}

    // Every second action is a choice: one value that is not the default.
    void draw() {
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint8_t* const record = records.data() + i * size_;
            if (role_ == RDDL_ACTION)
                simulator_.action_choice(&simulator_, i % 2 ? 0 : within(0, choices_ - 1), record,
                                         nullptr);
            if (i % 2 || role_ != RDDL_ACTION) draw_all(record);
        }
    }

  private:
    const std::size_t size_;

  public:
    Bytes records;

  private:
    std::int64_t within(std::int64_t lowest, std::int64_t highest) {
        return std::uniform_int_distribution<std::int64_t>(lowest, highest)(random_);
    }

    // Every third value stays as it is. Of some tables of bools of the state, few are true.
    void draw_all(std::uint8_t* record) {
        const rddl_problem& problem = *simulator_.problem;
        for (int f = 0; f < problem.fluent_count; ++f) {
            const rddl_fluent& fluent = problem.fluents[f];
            if (fluent.role != role_) continue;
            const std::size_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
            if (role_ == RDDL_STATE && fluent.scalar == RDDL_BOOL && fluent.count > 1 &&
                within(0, 2) != 0) {
                draw_few_true(record + fluent.offset, fluent.count);
                continue;
            }
            for (std::int64_t i = 0; i < fluent.count; ++i)
                if (within(0, 2) != 0)
                    draw_value(fluent, i,
                               record + fluent.offset + static_cast<std::size_t>(i) * size);
        }
    }

    void draw_few_true(std::uint8_t* bools, std::int64_t count) {
        std::fill_n(bools, count, std::uint8_t{0});
        for (std::int64_t k = within(0, 5) / 2; k > 0; --k)
            bools[within(0, count - 1)] = some_true();
    }
    std::uint8_t some_true() {
        return given_ == Given::Anything && within(0, 3) == 0
                   ? static_cast<std::uint8_t>(within(1, 255))
                   : std::uint8_t{1};
    }

    // A number without bounds is drawn from -10 to 10.
    void draw_value(const rddl_fluent& fluent, std::int64_t i, std::uint8_t* at) {
        const double lower = fluent.lower ? std::max(fluent.lower[i], -10.0) : -10.0;
        const double upper = fluent.upper ? std::min(fluent.upper[i], 10.0) : 10.0;
        if (fluent.scalar == RDDL_BOOL) {
            *at = within(0, 1) != 0 ? some_true() : std::uint8_t{0};
        } else if (fluent.range_type >= 0) {
            write(at, within(0, simulator_.problem->types[fluent.range_type].object_count - 1));
        } else if (given_ == Given::Anything && within(0, 7) == 0) {
            draw_extreme(fluent.scalar, at);
        } else if (fluent.scalar == RDDL_INT) {
            write(at, within(static_cast<std::int64_t>(lower),
                             static_cast<std::int64_t>(std::max(lower, upper))));
        } else {
            write(at, lower + (upper - lower) * static_cast<double>(within(0, 1000)) / 1000);
        }
    }

    void draw_extreme(rddl_scalar scalar, std::uint8_t* at) {
        using Ints = std::numeric_limits<std::int64_t>;
        using Reals = std::numeric_limits<double>;
        constexpr std::array ints{
            Ints::max(),      Ints::min(),           (std::int64_t{1} << 53) + 1,
            std::int64_t{-1}, std::int64_t{1} << 31, std::int64_t{65536}};
        constexpr std::array reals{Reals::quiet_NaN(),
                                   Reals::infinity(),
                                   -Reals::infinity(),
                                   -0.0,
                                   Reals::max(),
                                   Reals::denorm_min(),
                                   -1e300,
                                   0.0};
        if (scalar == RDDL_INT)
            write(at, ints[static_cast<std::size_t>(within(0, std::ssize(ints) - 1))]);
        else
            write(at, reals[static_cast<std::size_t>(within(0, std::ssize(reals) - 1))]);
    }

    template <class T>
    static void write(std::uint8_t* at, T value) {
        std::memcpy(at, &value, sizeof value);
    }

    const rddl_simulator& simulator_;
    std::size_t count_;
    rddl_role role_;
    Given given_;
    std::int64_t choices_;
    std::mt19937_64 random_;
};

}  // namespace stepping
