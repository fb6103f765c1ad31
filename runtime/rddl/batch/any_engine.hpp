// An engine whose functions are found at run time.
//
// The code that steps batches is generic over the engine. Made for this one it depends on nothing
// but the lane type, so it need not be compiled again for each simulator (batches.cpp). The price
// is an indirect call for a block of environments.
#pragma once

#include <rddl/step/advance.hpp>
#include <rddl/step/engine.hpp>
#include <rddl/step/episode.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace rddl {

template <class L>
class AnyEngine {
  public:
    using Lane = L;

    // The engine must outlive this one. With `for_batches` it steps many blocks in one call.
    template <Engine E, bool for_batches>
    AnyEngine(const E& engine, std::bool_constant<for_batches>)
        : engine_(&engine),
          state_size_(engine.state_size()),
          action_size_(engine.action_size()),
          observation_size_(engine.observation_size()),
          scratch_size_(engine.scratch_size()),
          sliding_buffers_size_(rddl::sliding_buffers_size(engine)),
          has_policy_(rddl::has_policy(engine)),
          memory_size_(rddl::memory_size(engine)) {
        reset_some_ = [](const void* self, const Columns& columns, Bool lanes,
                         const StateRecords& records, Context<L>& context) -> Bool {
            return rddl::reset_some(of<E>(self), columns, lanes, records, context);
        };
        // A simulator with packs sets one of them for each of its engines: with a third copy of the
        // step, compilers would no longer inline it.
        if constexpr (L::width == 1)
            advance_one_ = [](const void* self, const BatchView<L>& view, std::int64_t b,
                              Actions actions, const rddl_transition& out) RDDL_INLINE_LAMBDA {
                return rddl::advance_one(of<E>(self), view, b, actions, out);
            };
        if constexpr (for_batches)
            advance_ = [](const void* self, const Blocks<L>& blocks, Range range, Actions actions,
                          const StepBuffers& memory,
                          const rddl_transition& out) RDDL_INLINE_LAMBDA {
                return rddl::advance(of<E>(self), blocks, range, actions, memory, out);
            };
        initial_state_ = [](const void* self, std::byte* state) {
            rddl::initial_state(of<E>(self), state);
        };
        if (sliding_buffers_size_ > 0)
            settle_ = [](const void* self, std::byte* state) {
                rddl::settle(of<E>(self), state);
            };
        terminal_ = [](const void* self, const std::byte* state, Context<L>& context) -> Bool {
            return of<E>(self).terminal(state, context);
        };
        violated_precondition_ = [](const void* self, const std::byte* state,
                                    const std::byte* action, Context<L>& context) -> Int {
            return of<E>(self).violated_precondition(state, action, context);
        };
        if constexpr (PolicyEngine<E>) {
            reset_policy_ = [](const void* self, std::byte* memory) {
                of<E>(self).reset_policy(memory);
            };
            act_ = [](const void* self, const std::byte* observation, const std::byte* memory,
                      std::byte* scratch, std::byte* action, std::byte* next_memory,
                      Context<L>& context) {
                of<E>(self).act(observation, memory, scratch, action, next_memory, context);
            };
        }
    }

    std::size_t state_size() const { return state_size_; }
    std::size_t action_size() const { return action_size_; }
    std::size_t observation_size() const { return observation_size_; }
    std::size_t scratch_size() const { return scratch_size_; }
    std::size_t sliding_buffers_size() const { return sliding_buffers_size_; }

    // See rddl::settle.
    void settle(std::byte* state) const {
        if (settle_) settle_(engine_, state);
    }

    void initial_state(std::byte* state) const { initial_state_(engine_, state); }

    // See rddl::reset_some.
    typename L::Bool reset_some(const Columns& columns, typename L::Bool lanes,
                                const StateRecords& records, Context<L>& context) const {
        return reset_some_(engine_, columns, lanes, records, context);
    }
    typename L::Bool terminal(const std::byte* state, Context<L>& context) const {
        return terminal_(engine_, state, context);
    }
    typename L::Int violated_precondition(const std::byte* state, const std::byte* action,
                                          Context<L>& context) const {
        return violated_precondition_(engine_, state, action, context);
    }

    // See rddl::advance, for engines for batches.
    bool advances_many() const { return advance_ != nullptr; }
    Stop<L> advance(const Blocks<L>& blocks, Range range, Actions actions,
                    const StepBuffers& memory, const rddl_transition& out) const {
        return advance_(engine_, blocks, range, actions, memory, out);
    }

    // See rddl::advance_one, for blocks of one environment.
    rddl_error advance_one(const BatchView<L>& view, std::int64_t b, Actions actions,
                           const rddl_transition& out) const {
        return advance_one_(engine_, view, b, actions, out);
    }

    bool has_policy() const { return has_policy_; }
    std::size_t memory_size() const { return memory_size_; }
    void reset_policy(std::byte* memory) const { reset_policy_(engine_, memory); }
    void act(const std::byte* observation, const std::byte* memory, std::byte* scratch,
             std::byte* action, std::byte* next_memory, Context<L>& context) const {
        act_(engine_, observation, memory, scratch, action, next_memory, context);
    }

  private:
    using Bool = typename L::Bool;
    using Int = typename L::Int;

    template <class E>
    static const E& of(const void* self) {
        return *static_cast<const E*>(self);
    }

    const void* engine_;
    std::size_t state_size_, action_size_, observation_size_, scratch_size_, sliding_buffers_size_;
    bool has_policy_;
    std::size_t memory_size_;

    Bool (*reset_some_)(const void*, const Columns&, Bool, const StateRecords&, Context<L>&);
    Stop<L> (*advance_)(const void*, const Blocks<L>&, Range, Actions, const StepBuffers&,
                        const rddl_transition&) = nullptr;
    rddl_error (*advance_one_)(const void*, const BatchView<L>&, std::int64_t, Actions,
                               const rddl_transition&) = nullptr;
    void (*initial_state_)(const void*, std::byte*);
    void (*settle_)(const void*, std::byte*) = nullptr;
    Bool (*terminal_)(const void*, const std::byte*, Context<L>&);
    Int (*violated_precondition_)(const void*, const std::byte*, const std::byte*, Context<L>&);
    void (*reset_policy_)(const void*, std::byte*) = nullptr;
    void (*act_)(const void*, const std::byte*, const std::byte*, std::byte*, std::byte*,
                 std::byte*, Context<L>&) = nullptr;
};

// Compiled with the simulator.
template <class L>
typename L::Bool reset_some(const AnyEngine<L>& engine, const Columns& columns,
                            typename L::Bool lanes, const StateRecords& records,
                            Context<L>& context) {
    return engine.reset_some(columns, lanes, records, context);
}
template <class L>
Stop<L> advance(const AnyEngine<L>& engine, const Blocks<L>& blocks, Range range, Actions actions,
                const StepBuffers& memory, const rddl_transition& out) {
    return engine.advance(blocks, range, actions, memory, out);
}
template <class L>
bool advances_many(const AnyEngine<L>& engine) {
    return engine.advances_many();
}
template <class L>
rddl_error advance_one(const AnyEngine<L>& engine, const BatchView<L>& view, std::int64_t b,
                       Actions actions, const rddl_transition& out) {
    return engine.advance_one(view, b, actions, out);
}

}  // namespace rddl
