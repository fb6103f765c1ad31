// Steps the same environments one by one, in packs, and in packs by two threads, and compares
// all bits of what they tell.
//
//     compare_lanes SIMULATOR.so STEPS ENVIRONMENTS
//
// Every second environment takes a choice (one value that is not the default), the others any
// action: every value drawn within its bounds. Preconditions are not heeded, so that faults are
// compared, too. Prints what was compared. Exit status: 0 if all agree, 1 if not, 2 if nothing
// could be compared.
#include <rddl/simulator.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void give_up(const std::string& why) {
    std::fprintf(stderr, "error: %s\n", why.c_str());
    std::exit(2);
}

const rddl_simulator& load(const char* path) {
    void* const object = dlopen(path, RTLD_NOW);
    if (!object) give_up(dlerror());
    void* const entry = dlsym(object, "rddl_simulator_entry");
    if (!entry) give_up(dlerror());
    return *reinterpret_cast<rddl_simulator_entry_function>(entry)();
}

// What a step tells, and the state after it.
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
const char* difference(const Told& one, const Told& other) {
    if (one.causes != other.causes) return "causes";
    if (one.terminated != other.terminated) return "terminated";
    if (one.truncated != other.truncated) return "truncated";
    if (one.states != other.states) return "states";
    if (one.observations != other.observations) return "observations";
    if (one.final_observations != other.final_observations) return "final observations";
    const std::size_t size = one.rewards.size() * sizeof(double);
    return std::memcmp(one.rewards.data(), other.rewards.data(), size) == 0 ? nullptr : "rewards";
}

class Batch {
  public:
    Batch(const rddl_simulator& simulator, std::int64_t count, int lanes, int threads)
        : told(*simulator.problem, static_cast<std::size_t>(count)),
          simulator_(simulator),
          count_(count) {
        const rddl_batch_options options{count, 3,    42, threads, RDDL_AUTORESET_SAME_STEP,
                                         -1,    lanes};
        batch_ = simulator.create(&simulator, &options);
        if (!batch_) give_up("no batch");
    }
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;
    ~Batch() { simulator_.destroy(batch_); }

    void step(const Bytes& actions) {
        const rddl_transition out{told.observations.data(), told.rewards.data(),
                                  told.terminated.data(),   told.truncated.data(),
                                  told.causes.data(),       told.final_observations.data()};
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

class Actions {
  public:
    Actions(const rddl_simulator& simulator, std::size_t count)
        : records(count * static_cast<std::size_t>(simulator.problem->action_size) + 1),
          simulator_(simulator),
          count_(count),
          choices_(simulator.action_choice_count(&simulator)) {}

    void draw() {
        const auto size = static_cast<std::size_t>(simulator_.problem->action_size);
        for (std::size_t i = 0; i < count_; ++i) {
            std::uint8_t* const record = records.data() + i * size;
            simulator_.action_choice(&simulator_, i % 2 ? 0 : within(0, choices_ - 1), record);
            if (i % 2) draw_all(record);
        }
    }

    Bytes records;

  private:
    std::int64_t within(std::int64_t lowest, std::int64_t highest) {
        return std::uniform_int_distribution<std::int64_t>(lowest, highest)(random_);
    }

    // Every third value stays at its default.
    void draw_all(std::uint8_t* record) {
        const rddl_problem& problem = *simulator_.problem;
        for (int f = 0; f < problem.fluent_count; ++f) {
            const rddl_fluent& fluent = problem.fluents[f];
            if (fluent.role != RDDL_ACTION) continue;
            const std::size_t size = fluent.scalar == RDDL_BOOL ? 1 : 8;
            for (std::int64_t i = 0; i < fluent.count; ++i)
                if (within(0, 2) != 0)
                    draw_value(fluent, i,
                               record + fluent.offset + static_cast<std::size_t>(i) * size);
        }
    }

    // Where nothing bounds a number, from -10 to 10.
    void draw_value(const rddl_fluent& fluent, std::int64_t i, std::uint8_t* at) {
        const double lower = fluent.lower ? std::max(fluent.lower[i], -10.0) : -10.0;
        const double upper = fluent.upper ? std::min(fluent.upper[i], 10.0) : 10.0;
        if (fluent.scalar == RDDL_BOOL) {
            *at = within(0, 1) != 0;
        } else if (fluent.range_type >= 0) {
            write(at, within(0, simulator_.problem->types[fluent.range_type].object_count - 1));
        } else if (fluent.scalar == RDDL_INT) {
            write(at, within(static_cast<std::int64_t>(lower),
                             static_cast<std::int64_t>(std::max(lower, upper))));
        } else {
            write(at, lower + (upper - lower) * static_cast<double>(within(0, 1000)) / 1000);
        }
    }

    template <class T>
    static void write(std::uint8_t* at, T value) {
        std::memcpy(at, &value, sizeof value);
    }

    const rddl_simulator& simulator_;
    std::size_t count_;
    std::int64_t choices_;
    std::mt19937_64 random_;
};

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 4) give_up("usage: compare_lanes SIMULATOR.so STEPS ENVIRONMENTS");
    const rddl_simulator& simulator = load(arguments[1]);
    const int steps = std::atoi(arguments[2]);
    const int count = std::atoi(arguments[3]);
    const int lanes = simulator.lane_count;
    Batch scalar(simulator, count, 1, 1);
    Batch packs(simulator, count, lanes, 1);
    Batch threads(simulator, count, lanes, 2);
    Actions actions(simulator, static_cast<std::size_t>(count));
    std::int64_t ends = 0, faults = 0;
    for (int step = 0; step < steps; ++step) {
        actions.draw();
        for (Batch* const batch : {&scalar, &packs, &threads}) batch->step(actions.records);
        for (const std::uint8_t causes : scalar.told.causes) {
            ends += causes != RDDL_RUNNING;
            faults += (causes & RDDL_FAULTED) != 0;
        }
        for (const Batch* const other : {&packs, &threads})
            if (const char* const what = difference(scalar.told, other->told)) {
                std::printf("%s differ in step %d%s\n", what, step,
                            other == &threads ? ", with two threads" : "");
                return 1;
            }
    }
    std::printf("%d lanes (%s), %lld ends, %lld of them faults\n", lanes, simulator.instruction_set,
                static_cast<long long>(ends), static_cast<long long>(faults));
}
