// The conditions of a simulator together. Emitted functions add them one after the other:
//
//     if (conditions.go_on()) conditions.add(invariant_0(state));
#pragma once

#include <rddl/lanes/lane.hpp>
#include <rddl/values/context.hpp>
#include <rddl/values/pack_ops.hpp>

#include <cstdint>
#include <type_traits>

namespace rddl {

// All are evaluated: one of them may fault.
template <class L>
class Terminations {
  public:
    RDDL_INLINE void add(typename L::Bool holds) { hold_ = holds || hold_; }
    // Whether any of them does.
    typename L::Bool hold() const { return hold_; }

  private:
    typename L::Bool hold_{false};
};

// The same bools. Compilers make one chain of all comparisons, of which each waits for the mask of
// the one before; the comparisons of two conditions stay apart.
inline bool apart(bool holds) {
    return holds;
}
template <int n>
RDDL_INLINE Mask<n> apart(Mask<n> holds) {
    if (!__builtin_constant_p(holds.bits)) asm("" : "+r"(holds.bits));
    return holds;
}

// Invariants after one that does not hold, or that faults, are not evaluated: they cannot fault.
template <class L>
class Invariants {
  public:
    RDDL_INLINE explicit Invariants(Context<L>& context) : context_(context) {
        if constexpr (L::width > 1) active_ = context.active;
    }
    RDDL_INLINE bool go_on() {
        if constexpr (L::width > 1) {
            context_.active = active_ && !violated_;
            return true;
        } else {
            return !violated_;
        }
    }
    RDDL_INLINE void add(typename L::Bool holds) {
        violated_ = violated_ || !apart(holds) || context_.faulted();
    }
    RDDL_INLINE typename L::Bool violated() {
        if constexpr (L::width > 1) context_.active = active_;
        return violated_;
    }

  private:
    Context<L>& context_;
    typename L::Bool active_{true};  // before they were evaluated
    typename L::Bool violated_{false};
};

template <class L>
class Preconditions {
  public:
    RDDL_INLINE explicit Preconditions(const Context<L>& context) : context_(context) {}
    RDDL_INLINE bool go_on() const { return any(first_ < typename L::Int{0}); }
    RDDL_INLINE void add(std::int64_t k, typename L::Bool holds) {
        using Int = typename L::Int;
        first_ = select((!holds || context_.faulted()) && first_ < Int{0}, Int{k}, first_);
    }
    // The number of the first one that does not hold, or that faults; -1 where all hold.
    RDDL_INLINE typename L::Int first_violated() const { return first_; }

  private:
    const Context<L>& context_;
    typename L::Int first_{std::int64_t{-1}};
};

}  // namespace rddl
