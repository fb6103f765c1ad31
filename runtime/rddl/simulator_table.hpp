// A simulator for C: description, sites and engines, and the table of functions over them.
//
// The functions themselves are in abi.hpp, and depend on the lane type alone.
#pragma once

#include <rddl/any_engine.hpp>
#include <rddl/lane.hpp>
#include <rddl/simd.hpp>
#include <rddl/simulator.h>
#include <rddl/sites.hpp>

#include <span>
#include <type_traits>
#include <utility>

namespace rddl {

// L is the lane type of the engine for larger batches: Scalar if there is none but the first one.
template <class L>
struct SimulatorParts {
    const rddl_problem* problem;
    std::span<const Site> sites;
    AnyEngine<ScalarOf<typename L::Element>> engine;
    AnyEngine<L> packed_engine;
    const rddl_policy* policy;
    const char* instruction_set;  // that the engines are compiled for
};

// The table; the parts must outlive it.
template <class L>
rddl_simulator table_of(const SimulatorParts<L>& parts);

// The description and the sites must outlive it; it must outlive its batches. An emitted file ends
// in
//
//     extern "C" const rddl_simulator* rddl_simulator_entry() {
//         static const rddl::SimulatorTable<rddl::Compiled<Simulator, problem>> table(problem,
//         sites, {}); return table.get();
//     }
//
// Packed is an engine of the same simulator for packs, where there is one: for larger batches.
template <Engine E, Engine Packed = E>
class SimulatorTable {
  public:
    // `policy` describes the engine's policy and must outlive it, too; null if it has none.
    SimulatorTable(const rddl_problem& problem, std::span<const Site> sites, E engine,
                   const rddl_policy* policy = nullptr)
        : engine_(std::move(engine)),
          parts_{&problem,        sites,  AnyEngine<typename E::Lane>(engine_),
                 packed_engine(), policy, simd::level},
          table_(table_of(parts_)) {}
    SimulatorTable(const SimulatorTable&) = delete;
    SimulatorTable& operator=(const SimulatorTable&) = delete;

    const rddl_simulator* get() const { return &table_; }

  private:
    using L = typename Packed::Lane;

    AnyEngine<L> packed_engine() const {
        if constexpr (std::is_same_v<Packed, E>)
            return AnyEngine<L>(engine_);
        else
            return AnyEngine<L>(packed_engine_);
    }

    struct Nothing {};
    E engine_;
    [[no_unique_address]] std::conditional_t<std::is_same_v<Packed, E>, Nothing, Packed>
        packed_engine_;
    SimulatorParts<L> parts_;
    rddl_simulator table_;
};

}  // namespace rddl
