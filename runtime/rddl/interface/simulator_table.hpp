// A simulator for C: description, sites and engines, and the table of functions over them.
//
// The functions themselves are in abi.hpp, and depend on the lane type alone.
#pragma once

#include <rddl/batch/any_engine.hpp>
#include <rddl/interface/constants.hpp>
#include <rddl/interface/details.hpp>
#include <rddl/interface/sites.hpp>
#include <rddl/lanes/lane.hpp>
#include <rddl/lanes/simd.hpp>
#include <rddl/simulator.h>

#include <span>
#include <type_traits>
#include <utility>

namespace rddl {

// The description of a simulator; all of it outlives it.
struct About {
    const rddl_problem& problem;
    std::span<const Site> sites;
    std::span<const Constants> constants;  // of each non-fluent
    const rddl_policy* policy = nullptr;   // of the engine; null without a policy
    const Details* details = nullptr;      // null if it was made without
};

// L is the lane type of the engine for larger batches: Scalar if there is only the first one.
template <class L>
struct SimulatorParts {
    const rddl_problem* problem;
    std::span<const Site> sites;
    std::span<const Constants> constants;
    AnyEngine<ScalarOf<typename L::Element>> engine;
    AnyEngine<L> packed_engine;
    const rddl_policy* policy;
    const Details* details;
    const char* instruction_set;  // that the engines are compiled for
};

// The table; the parts must outlive it.
template <class L>
rddl_simulator table_of(const SimulatorParts<L>& parts);

// It must outlive its batches. An emitted file ends in
//
//     extern "C" const rddl_simulator* rddl_simulator_entry() {
//         static const rddl::SimulatorTable<rddl::Compiled<Simulator, problem>> table(
//             {problem, sites, constants}, {});
//         return table.get();
//     }
//
// Packed is an engine of the same simulator for packs, where there is one: for larger batches.
template <Engine E, Engine Packed = E>
class SimulatorTable {
  public:
    SimulatorTable(const About& about, E engine)
        : engine_(std::move(engine)),
          parts_{&about.problem,  about.sites,  about.constants, one_by_one(),
                 packed_engine(), about.policy, about.details,   simd::level},
          table_(table_of(parts_)) {}
    SimulatorTable(const SimulatorTable&) = delete;
    SimulatorTable& operator=(const SimulatorTable&) = delete;

    const rddl_simulator* get() const { return &table_; }

  private:
    using L = typename Packed::Lane;

    static constexpr bool has_packs = !std::is_same_v<Packed, E>;

    // Without packs it also steps batches.
    AnyEngine<typename E::Lane> one_by_one() const {
        return {engine_, std::bool_constant<!has_packs>{}};
    }
    AnyEngine<L> packed_engine() const {
        if constexpr (has_packs)
            return {packed_engine_, std::true_type{}};
        else
            return one_by_one();
    }

    struct Nothing {};
    E engine_;
    [[no_unique_address]] std::conditional_t<has_packs, Packed, Nothing> packed_engine_;
    SimulatorParts<L> parts_;
    rddl_simulator table_;
};

}  // namespace rddl
