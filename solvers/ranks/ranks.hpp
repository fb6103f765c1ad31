// Processes that learn together, each with a number: one alone, or those that mpirun has started.
//
// All of them run the same program, call these functions in the same order, and decide alike.
#pragma once

#include "solvers/ranks/module.hpp"
#include "support/failure.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::solvers {

struct Ranks {
    int number = 0;  // of this one, from 0 on
    int count = 1;
    const RanksModule* module = nullptr;             // of more than one
    std::atomic<std::uint64_t>* meetings = nullptr;  // odd while this one waits for the others

    bool is_first() const { return number == 0; }
    // Each number becomes the sum of those of all ranks.
    void add_up(std::span<float> numbers) const;
    void add_up(std::span<double> numbers) const;
    // The texts of all ranks, in the order of the ranks.
    std::vector<std::string> gather(std::string_view own) const;
    // Whether that holds for one of them.
    bool any(bool holds) const;
};

// Runs `work` on all ranks. An exception in one of them ends all, and is reported once if all throw
// it. `stops` (Ctrl-C; may be empty) ends ranks that wait for one that is gone. Throws a Failure if
// mpirun has started several processes and this program does not know MPI.
ExitStatus run_on_ranks(std::string_view program, const std::function<bool()>& stops,
                        const std::function<ExitStatus(const Ranks&)>& work);

}  // namespace rddlc::solvers
