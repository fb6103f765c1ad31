// Prints a line for each library: nanoseconds of one environment's step, the median of many rounds
// in which the libraries take turns. They must compute the same bits.
#define HWY_COMPILE_ONLY_STATIC
#include <rddl/simulator.hpp>

#include <hwy/highway.h>
#include <xsimd/xsimd.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <experimental/simd>
#include <vector>

// Highway's functions are inlined only into such that are compiled for its own target.
HWY_BEFORE_NAMESPACE();
#include "kernel.hpp"
#include "libraries.hpp"
HWY_AFTER_NAMESPACE();

namespace {

constexpr int rounds = 31;
constexpr int steps = 2000;

struct Candidate {
    const char* name;
    void (*step)(Records&, std::uint64_t);
    Records records;
    std::vector<double> nanoseconds;
};

void measure(Candidate& candidate) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    for (std::uint64_t time = 0; time < steps; ++time) candidate.step(candidate.records, time);
    const std::chrono::duration<double, std::nano> passed = Clock::now() - begin;
    candidate.nanoseconds.push_back(passed.count() / (steps * environments));
}

}  // namespace

int main() {
    Candidate candidates[] = {{"rddl/lanes/simd.hpp", step<Ours>, {}, {}},
                              {"Highway", step<Highway>, {}, {}},
                              {"xsimd", step<Xsimd>, {}, {}},
                              {"std::experimental::simd", step<Experimental>, {}, {}}};
    for (int round = 0; round < rounds; ++round)
        for (Candidate& candidate : candidates) measure(candidate);
    for (Candidate& candidate : candidates) {
        std::ranges::nth_element(candidate.nanoseconds, candidate.nanoseconds.begin() + rounds / 2);
        std::printf("%-24s %6.2f ns\n", candidate.name, candidate.nanoseconds[rounds / 2]);
        if (candidate.records.place != candidates[0].records.place) {
            std::printf("  computes something else\n");
            return 1;
        }
    }
}
