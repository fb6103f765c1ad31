// The kernel of one problem on reals of one type as a shared object, compiled with -include HEADER,
// -DPROBLEM=STRUCT and -DREAL=TYPE. A problem P defines
//
//     State<L>, Action<L>    with each(records), which visits the fluents in the order of records
//     step<L>(state, action, draws, next)    makes the next state, gives the reward
//
// for L = rddl::Pack<width, REAL>: the work that the values of a step and its reward need. Neither
// checks of actions nor ends of episodes nor resets are there.
#include "draws.hpp"
#include "interface.hpp"
#include "records.hpp"

#include <algorithm>
#include <ctime>
#include <memory>
#include <vector>

namespace least_steps {

namespace {

using L = rddl::Pack<width, REAL>;
using Word = L::Word;

struct Pack {
    PROBLEM::State<L> state;
    PROBLEM::Action<L> action;
    Word step, key_low, key_high;
    PROBLEM::State<L> next;
    L::Real reward;
};

// All of them, or as many as the nearest cache has room for.
std::vector<Pack> packs_of(const Environments& environments, std::size_t most) {
    std::vector<Pack> packs(std::min(environments.count / width, most));
    for (std::size_t i = 0; i < packs.size(); ++i) {
        const std::size_t first = i * width;
        Pack& pack = packs[i];
        auto state = Records::read(environments.states + first * environments.state_size,
                                   environments.state_size);
        pack.state.each(state);
        auto action = Records::read(environments.actions + first * environments.action_size,
                                    environments.action_size);
        pack.action.each(action);
        pack.step = Word::load(environments.steps + first);
        pack.key_low = Word::load(environments.keys_low + first);
        pack.key_high = Word::load(environments.keys_high + first);
    }
    return packs;
}

RDDL_INLINE void make_step(Pack& pack, std::uint64_t later) {
    const Draws<L> draws(pack.step + Word{later}, pack.key_low, pack.key_high);
    pack.reward = PROBLEM::step<L>(pack.state, pack.action, draws, pack.next);
}

void step(const Environments& environments, std::byte* next_states, double* rewards) {
    std::vector<Pack> packs = packs_of(environments, environments.count);
    for (std::size_t i = 0; i < packs.size(); ++i) {
        make_step(packs[i], 0);
        auto next = Records::write(next_states + i * width * environments.state_size,
                                   environments.state_size);
        packs[i].next.each(next);
        for (int lane = 0; lane < width; ++lane)
            rewards[i * width + static_cast<std::size_t>(lane)] = packs[i].reward[lane];
    }
}

double processor_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// From the same states again and again, but with random numbers of other steps. The compiler has to
// make all results, since it does not know who reads them.
double nanoseconds(const Environments& environments, double seconds) {
    constexpr std::size_t cache = 32 << 10, steps = 20000;
    std::vector<Pack> packs =
        packs_of(environments, std::clamp<std::size_t>(cache / sizeof(Pack), 1, 8));
    const std::size_t repetitions = steps / packs.size();
    const double end = processor_seconds() + seconds;
    double best = 1e9;
    while (processor_seconds() < end) {
        const double begin = processor_seconds();
        for (std::uint64_t later = 0; later < repetitions; ++later) {
            for (Pack& pack : packs) make_step(pack, later);
            asm volatile("" ::"r"(packs.data()) : "memory");
        }
        best = std::min(best, processor_seconds() - begin);
    }
    return best / static_cast<double>(repetitions * packs.size() * width) * 1e9;
}

}  // namespace

}  // namespace least_steps

extern "C" [[gnu::visibility("default")]] least_steps::Kernel least_step() {
    return {least_steps::step, least_steps::nanoseconds};
}
