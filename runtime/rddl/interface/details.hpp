// Intermediate values of the last step, for callers that ask for them (simulator.h: get_interm,
// explain_violation). They are computed again, from the state, the action and the random numbers,
// so that other callers do not pay for them.
#pragma once

#include <rddl/interface/sites.hpp>
#include <rddl/lanes/lane.hpp>
#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rddl {

// The part of a record of details that says for which objects a precondition holds: a bool for each
// combination of the objects of the scope, row-major.
struct ConditionPlaces {
    std::int64_t offset;
    std::span<const SiteVariable> scope;
};

struct Details {
    // Sizes in bytes. A record begins with the interm- and derived-fluents, which callers get; the
    // tables of the preconditions lie behind them.
    std::size_t interm_size, record_size, scratch_size;
    std::span<const ConditionPlaces> preconditions;

    // Fills the record; state and action are records of the C interface, with plain bools. Values
    // that depend on a draw or operator at fault mean nothing.
    void (*compute)(const void* self, const std::byte* state, const std::byte* action,
                    std::byte* scratch, std::byte* record, Context<Scalar>& context);
    const void* self = nullptr;
};

// The details of emitted code: Step computes the record from states and actions of the Simulator.
template <class Simulator, class Step>
constexpr Details details_of(std::size_t interm_size,
                             std::span<const ConditionPlaces> preconditions) {
    using State = typename Simulator::template State<Scalar>;
    using Action = typename Simulator::template Action<Scalar>;
    using Scratch = typename Step::template Scratch<Scalar>;
    using Record = typename Step::template Observation<Scalar>;
    struct Room {
        Scratch scratch;
        State no_next_state;
    };
    return {.interm_size = interm_size,
            .record_size = sizeof(Record),
            .scratch_size = sizeof(Room),
            .preconditions = preconditions,
            .compute = [](const void*, const std::byte* state, const std::byte* action,
                          std::byte* scratch, std::byte* record, Context<Scalar>& context) {
                Room& room = *reinterpret_cast<Room*>(scratch);
                Step::step(*reinterpret_cast<const State*>(state),
                           *reinterpret_cast<const Action*>(action), room.scratch,
                           room.no_next_state, *reinterpret_cast<Record*>(record), context);
            }};
}

}  // namespace rddl
