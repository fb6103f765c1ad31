// The least time of an operation for one environment of a batch, on doubles and on floats: packs of
// 16 in the nearest cache, nothing else to do. Bounds from below what a step can take that needs so
// many of them (docs/benchmarks.md).
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
constexpr std::size_t packs = 32;  // operands and results fit into 32 KiB

template <class R>
using Packs = std::array<typename rddl::Pack<width, R>::Real, packs>;
template <class R>
Packs<R> a{};
template <class R>
Packs<R> b{};
template <class R>
Packs<R> results{};

double processor_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The compiler has to make all results, and to load the operands again: it drops what is stored
// where no one else knows the place.
template <class R>
void keep_all() {
    asm volatile("" ::"r"(&a<R>), "r"(&b<R>), "r"(&results<R>) : "memory");
}

// The best of some rounds.
template <class R, class Operation>
double time_of(Operation operation) {
    constexpr int rounds = 15, repetitions = 3000;
    double best = 1e9;
    for (int round = 0; round < rounds; ++round) {
        const double begin = processor_seconds();
        for (int k = 0; k < repetitions; ++k) {
            for (std::size_t i = 0; i < packs; ++i) results<R>[i] = operation(a<R>[i], b<R>[i]);
            keep_all<R>();
        }
        best = std::min(best, processor_seconds() - begin);
    }
    return best / repetitions / packs / width * 1e9;
}

// The same for draws, which belong to a step: `count` neighbours in each.
template <class R, class Draw>
double time_of_draws(Draw draw) {
    using L = rddl::Pack<width, R>;
    using Word = typename L::Word;
    Word keys;  // of other numbers in each lane: 15 of 100 are in the tails of normals
    for (int lane = 0; lane < width; ++lane) keys.set(lane, static_cast<std::uint64_t>(lane));
    constexpr rddl::Index count = 8;
    constexpr int rounds = 15, steps = 3000;
    double best = 1e9;
    for (int round = 0; round < rounds; ++round) {
        const double begin = processor_seconds();
        for (std::uint64_t step = 0; step < steps; ++step) {
            auto context = rddl::Context<L>::of(keys, Word{9}, Word{step}, true);
            for (rddl::Index i = 0; i < count; ++i)
                results<R>[static_cast<std::size_t>(i)] =
                    draw(context, rddl::PlaceAmong<count>{0, i});
            keep_all<R>();
        }
        best = std::min(best, processor_seconds() - begin);
    }
    return best / steps / count / width * 1e9;
}

void print(const char* name, double of_doubles, double of_floats) {
    std::printf("%-22s %6.2f ns %6.2f ns\n", name, of_doubles, of_floats);
}
template <class Operation>
void report(const char* name, Operation operation) {
    print(name, time_of<double>(operation), time_of<float>(operation));
}
template <class Draw>
void report_draws(const char* name, Draw draw) {
    print(name, time_of_draws<double>(draw), time_of_draws<float>(draw));
}

template <class R>
void fill() {
    for (std::size_t i = 0; i < packs; ++i)
        for (int lane = 0; lane < width; ++lane) {
            const double place = static_cast<double>(i);
            a<R>[i].set(lane, static_cast<R>(0.1 + 0.05 * place + 0.01 * lane));
            b<R>[i].set(lane, static_cast<R>(1.1 + 0.02 * place + 0.03 * lane));
        }
}

}  // namespace

int main() {
    fill<double>();
    fill<float>();
    std::printf("%-22s %9s %9s\n", "", "doubles", "floats");
    report("load, load, store", [](const auto& x, const auto& y) { return x + y; });
    report("eight products", [](auto x, const auto& y) {
        for (int k = 0; k < 8; ++k) x = x * y;
        return x;
    });
    report("division", [](const auto& x, const auto& y) { return x / y; });
    report("square root", [](const auto& x, const auto&) { return rddl::sqrt(x); });
    report("sin", [](const auto& x, const auto&) { return rddl::sin(x); });
    report("cos", [](const auto& x, const auto&) { return rddl::cos(x); });
    report("tan", [](const auto& x, const auto&) { return rddl::tan(x); });
    report("atan", [](const auto& x, const auto&) { return rddl::atan(x); });
    report("exp", [](const auto& x, const auto&) { return rddl::exp(x); });
    report("ln", [](const auto& x, const auto&) { return rddl::ln(x); });
    report("power", [](const auto& x, const auto& y) { return rddl::power(x, y); });
    report_draws("uniform number",
                 [](auto& context, rddl::Place place) { return rddl::uniform_at(context, place); });
    report_draws("normal draw", [](auto& context, auto place) {
        return rddl::sample::normal(context, place, 1, 2);
    });
}
