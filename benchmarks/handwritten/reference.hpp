// A simulator written by hand for one instance, behind the functions of rddl_simulator that
// stepping a batch needs. A problem P defines:
//
//     width, horizon                  environments stepped together in registers; steps
//     stochastic                      something is drawn at random
//     State<L>                        of one environment (L = rddl::Scalar) or of `width` of them
//     start(state)                    the initial state
//     Actions<L>, load(actions, records)   from the caller's records, one after the other
//     step(state, actions, draws)     makes a step, gives the reward
//     terminated(state), broken(state)     a termination holds; an invariant does not
//                                     (neither, in a problem that is a RunsToTheHorizon)
//     store(state, lane, record)      the state record
//
// Rules of the game: a step is computed from the state record and the action record, as in the
// simulators that we emit; the inputs and outputs of the caller are the same; the random numbers
// are also the same (docs/randomness.md). Anything else is allowed.
#pragma once

#include "registers.hpp"

#include <rddl/random/random.hpp>
#include <rddl/simulator.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

namespace handwritten {

// The source of random numbers: the coordinates of a draw except site and index.
template <class Word>
struct Draws {
    Word step;
    rddl::philox::Key<Word> key;

    // The numbers with indices 2 block and 2 block + 1, in [0, 1).
    auto two(Word site, Word block) const {
        const auto words = generate(site, block);
        const auto even = rddl::unit_real(words[0], words[1]);
        return rddl::TwoDraws<std::remove_const_t<decltype(even)>>{
            even, rddl::unit_real(words[2], words[3])};
    }
    // The same, times 2^52: integers, to be compared with threshold(p) in place of p.
    rddl::TwoDraws<Word> two_integers(Word site, Word block) const {
        const auto words = generate(site, block);
        return {rddl::join_lower_halves(words[0], words[1]) >> 12,
                rddl::join_lower_halves(words[2], words[3]) >> 12};
    }

  private:
    auto generate(Word site, Word block) const {
        return rddl::philox::generate<rddl::philox::draw_rounds>(
            rddl::philox::Block<Word>{step, site, block, Word{std::uint64_t{0}}}, key);
    }
};

// A problem whose episodes end at the horizon, or by the one of the two that it defines itself.
struct RunsToTheHorizon {
    static constexpr bool terminated(const auto&) { return false; }
    static constexpr bool broken(const auto&) { return false; }
};

template <class P>
class Reference {
  public:
    // The problem's description is that of the emitted simulator.
    static rddl_simulator simulator(const rddl_problem* problem) {
        rddl_simulator table{};
        table.problem = problem;
        table.create = create;
        table.destroy = destroy;
        table.step = step;
        table.get_state = get_state;
        return table;
    }

  private:
    using Word = std::uint64_t;

    // One environment, in plain doubles.
    struct Single {
        typename P::template State<rddl::Scalar> state;
        Word step = 0, environment = 0, episode = 0;
        rddl::StreamKey key;

        void restart(Word seed) {
            if constexpr (P::stochastic) key = rddl::stream_key(seed, environment, episode);
            step = 0;
            P::start(state);
        }
        void advance(Word seed, const std::byte* record, double* reward, std::uint8_t* terminated,
                     std::uint8_t* truncated) {
            typename P::template Actions<rddl::Scalar> actions;
            P::load(actions, record);
            const Draws<Word> draws{++step, {key.low, key.high}};
            *reward = P::step(state, actions, draws);
            const bool is_terminated = P::terminated(state);
            const bool is_truncated = step == P::horizon || P::broken(state);
            *terminated = is_terminated;
            *truncated = is_truncated;
            if (is_terminated || is_truncated) {
                ++episode;
                restart(seed);
            }
        }
    };

    // As many environments as registers hold.
    struct Several {
        static constexpr int n = P::width;
        using L = rddl::Pack<n>;

        typename P::template State<L> state;
        typename L::Word step, key_low, key_high;
        Word first_environment = 0;
        Word episode[n]{};

        void restart(Word seed, int lane) {
            step.set(lane, 0);
            if constexpr (!P::stochastic) return;
            const auto key = rddl::stream_key(seed, first_environment + lane, episode[lane]);
            key_low.set(lane, key.low);
            key_high.set(lane, key.high);
        }
        void advance(Word seed, const std::byte* records, double* rewards, std::uint8_t* terminated,
                     std::uint8_t* truncated) {
            typename P::template Actions<L> actions;
            P::load(actions, records);
            step += typename L::Word{Word{1}};
            const Draws<typename L::Word> draws{step, {key_low, key_high}};
            P::step(state, actions, draws).store(rewards);
            const typename L::Bool is_terminated = P::terminated(state);
            const auto is_truncated = same(step, typename L::Word{P::horizon}) || P::broken(state);
            store_bits(is_terminated.bits, terminated);
            store_bits(is_truncated.bits, truncated);
            const auto over = is_terminated || is_truncated;
            if (!rddl::any(over)) return;
            rddl::for_each_lane(over, [&](int lane) {
                ++episode[lane];
                restart(seed, lane);
            });
            P::start(state, over);
        }

        static void store_bits(Word bits, std::uint8_t* bytes) {
            for (int lane = 0; lane < n; ++lane) bytes[lane] = bits >> lane & 1;
        }
    };

    struct Environments {
        Word seed;
        std::int64_t count;
        std::size_t action_size, state_size;
        std::vector<Single> singles;    // of a batch that is too small for registers, or
        std::vector<Several> severals;  // of others; some may have unused lanes
    };

    static rddl_batch* create(const rddl_simulator* simulator, const rddl_batch_options* options) {
        auto batch = std::make_unique<Environments>();
        batch->seed = options->seed;
        batch->count = options->environment_count;
        batch->action_size = static_cast<std::size_t>(simulator->problem->action_size);
        batch->state_size = static_cast<std::size_t>(simulator->problem->state_size);
        const auto count = static_cast<Word>(batch->count), n = static_cast<Word>(P::width);
        if (count < n) {
            batch->singles.resize(count);
            for (Word i = 0; i < count; ++i) {
                batch->singles[i].environment = i;
                batch->singles[i].restart(batch->seed);
            }
        } else {
            batch->severals.resize((count + n - 1) / n);
            for (Word i = 0; i < batch->severals.size(); ++i) {
                batch->severals[i].first_environment = i * n;
                for (int lane = 0; lane < P::width; ++lane)
                    batch->severals[i].restart(batch->seed, lane);
                P::start(batch->severals[i].state, rddl::Mask<P::width>(true));
            }
        }
        return reinterpret_cast<rddl_batch*>(batch.release());
    }

    static void destroy(rddl_batch* batch) { delete &as(batch); }

    static rddl_error step(rddl_batch* handle, const void* actions, const rddl_transition* out) {
        Environments& batch = as(handle);
        const auto* const records = static_cast<const std::byte*>(actions);
        for (std::size_t i = 0; i < batch.singles.size(); ++i)
            batch.singles[i].advance(batch.seed, records + i * batch.action_size, out->rewards + i,
                                     out->terminated + i, out->truncated + i);
        constexpr std::size_t n = P::width;
        const std::size_t full =
            batch.severals.empty() ? 0 : static_cast<std::size_t>(batch.count) / n;
        for (std::size_t i = 0; i < full; ++i)
            batch.severals[i].advance(batch.seed, records + i * n * batch.action_size,
                                      out->rewards + i * n, out->terminated + i * n,
                                      out->truncated + i * n);
        if (full < batch.severals.size()) step_rest(batch, full, records, out);
        return RDDL_OK;
    }

    // The last registers, which are not full.
    static void step_rest(Environments& batch, std::size_t full, const std::byte* records,
                          const rddl_transition* out) {
        constexpr std::size_t n = P::width;
        const std::size_t done = full * n, rest = static_cast<std::size_t>(batch.count) - done;
        std::vector<std::byte> actions(n * batch.action_size);
        std::copy_n(records + done * batch.action_size, rest * batch.action_size, actions.data());
        double rewards[n];
        std::uint8_t terminated[n], truncated[n];
        batch.severals[full].advance(batch.seed, actions.data(), rewards, terminated, truncated);
        std::copy_n(rewards, rest, out->rewards + done);
        std::copy_n(terminated, rest, out->terminated + done);
        std::copy_n(truncated, rest, out->truncated + done);
    }

    static rddl_error get_state(const rddl_batch* handle, std::int64_t begin, std::int64_t count,
                                void* states) {
        const Environments& batch = as(const_cast<rddl_batch*>(handle));
        auto* record = static_cast<std::byte*>(states);
        for (std::int64_t i = begin; i < begin + count; ++i, record += batch.state_size) {
            const auto place = static_cast<std::size_t>(i);
            if (batch.severals.empty())
                P::store(batch.singles[place].state, 0, record);
            else
                P::store(batch.severals[place / P::width].state, i % P::width, record);
        }
        return RDDL_OK;
    }

    static Environments& as(rddl_batch* handle) { return *reinterpret_cast<Environments*>(handle); }
};

}  // namespace handwritten
