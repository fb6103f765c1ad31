// The least time of an operation for one environment of a batch: packs of 16 in the nearest cache,
// nothing else to do. Bounds from below what a step can take that needs so many of them
// (docs/benchmarks.md).
//
//     g++ -std=c++20 -O3 -march=native -ffp-contract=off -Iruntime benchmarks/unit_costs.cpp -o
//     unit_costs
//     ./unit_costs
#include <rddl/simulator.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>

namespace {

constexpr int width = 16;
using L = rddl::Pack<width>;
using Real = L::Real;

constexpr std::size_t packs = 32;  // operands and results fit into 32 KiB
alignas(64) std::array<Real, packs> a, b, results;

// Compilers must not know what the operands are, nor that the results are never read.
void use_memory() {
    asm volatile("" ::"r"(a.data()), "r"(b.data()), "r"(results.data()) : "memory");
}

double processor_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The best of some rounds.
template <class Operation>
void report(const char* name, Operation operation) {
    constexpr int rounds = 15, repetitions = 3000;
    double best = 1e9;
    for (int round = 0; round < rounds; ++round) {
        const double begin = processor_seconds();
        for (int k = 0; k < repetitions; ++k) {
            for (std::size_t i = 0; i < packs; ++i) results[i] = operation(a[i], b[i]);
            use_memory();
        }
        best = std::min(best, processor_seconds() - begin);
    }
    std::printf("%-22s %6.2f ns\n", name, best / repetitions / packs / width * 1e9);
}

// The same for draws, which belong to a step: `count` neighbours in each.
template <class Draw>
void report_draws(const char* name, Draw draw) {
    constexpr rddl::Index count = 8;
    constexpr int rounds = 15, steps = 3000;
    double best = 1e9;
    for (int round = 0; round < rounds; ++round) {
        const double begin = processor_seconds();
        for (std::uint64_t step = 0; step < steps; ++step) {
            auto context = rddl::Context<L>::of(L::Word{7}, L::Word{9}, L::Word{step}, true);
            for (rddl::Index i = 0; i < count; ++i)
                results[static_cast<std::size_t>(i)] = draw(context, rddl::PlaceAmong<count>{0, i});
            use_memory();
        }
        best = std::min(best, processor_seconds() - begin);
    }
    std::printf("%-22s %6.2f ns\n", name, best / steps / count / width * 1e9);
}

}  // namespace

int main() {
    for (std::size_t i = 0; i < packs; ++i)
        for (int lane = 0; lane < width; ++lane) {
            a[i].set(lane, 0.1 + 0.05 * static_cast<double>(i) + 0.01 * lane);
            b[i].set(lane, 1.1 + 0.02 * static_cast<double>(i) + 0.03 * lane);
        }
    report("load, load, store", [](const Real& x, const Real& y) { return x + y; });
    report("eight products", [](Real x, const Real& y) {
        for (int k = 0; k < 8; ++k) x = x * y;
        return x;
    });
    report("division", [](const Real& x, const Real& y) { return x / y; });
    report("square root", [](const Real& x, const Real&) { return rddl::sqrt(x); });
    report("sin", [](const Real& x, const Real&) { return rddl::sin(x); });
    report("cos", [](const Real& x, const Real&) { return rddl::cos(x); });
    report("tan", [](const Real& x, const Real&) { return rddl::tan(x); });
    report("atan", [](const Real& x, const Real&) { return rddl::atan(x); });
    report("exp", [](const Real& x, const Real&) { return rddl::exp(x); });
    report("ln", [](const Real& x, const Real&) { return rddl::ln(x); });
    report("power", [](const Real& x, const Real& y) { return rddl::power(x, y); });
    report_draws("uniform number",
                 [](auto& context, rddl::Place place) { return rddl::uniform_at(context, place); });
    report_draws("normal draw", [](auto& context, auto place) {
        return rddl::sample::normal(context, place, 1.0, 2.0);
    });
}
