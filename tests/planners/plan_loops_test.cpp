#include "planners/cem/plan_actions.hpp"
#include "planners/cem/plan_distribution.hpp"
#include "planners/cem/plan_noise.hpp"
#include "planning.hpp"
#include "solvers/spaces/actions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <span>

namespace rddlc::planners {
namespace {

// The loops of the instruction set of that name, or of the greatest one below it.
const PlanLoops& loops_of(const char* instruction_set) {
    setenv("RDDL_INSTRUCTION_SET", instruction_set, 1);
    const PlanLoops& loops = plan_loops();
    unsetenv("RDDL_INSTRUCTION_SET");
    return loops;
}

// A count that is no multiple of any vector's.
constexpr std::size_t plans = 77;

RealScale scale_of_range(solvers::RealHead::Range range, bool rounds, double exact_default) {
    return {range,        rounds, -2.5, 7.25, 3, 0.5, -2.5, 7.25, static_cast<float>(exact_default),
            exact_default};
}

TEST(PlanLoops, ComputeTheSameBitsOnAllInstructionSets) {
    const auto run = [](const char* instruction_set) {
        const PlanLoops& loops = loops_of(instruction_set);
        std::vector<float> old(plans, 0.8f), fresh(plans, 0.6f), noise(plans, 0.25f),
            widths(plans, 1.5f), numbers(plans), mirrored(plans), drawn(plans);
        std::vector<std::uint32_t> keep(plans, 100);
        std::vector<std::int32_t> ranks(plans, 5), reached(plans), thresholds;
        std::vector<double> values(plans);
        std::vector<std::byte> all;
        const auto note = [&all](const auto& vector) {
            const auto* const bytes = reinterpret_cast<const std::byte*>(vector.data());
            all.insert(all.end(), bytes, bytes + vector.size() * sizeof vector[0]);
        };
        for (std::uint32_t key = 1; key < 40; ++key) {
            for (std::size_t p = 0; p < plans; ++p)
                drawn[p] = static_cast<float>(static_cast<int>((p + 1) * key % 61) - 30) * 0.1f;
            loops.next_ranks({key, keep.data()}, plans, ranks.data());
            note(ranks);
        }
        for (const int count : {1, 3, 15, 31, 127}) {
            thresholds.clear();
            for (int k = 0; k < count; ++k) thresholds.push_back((k + 1) * (rank_count / 130));
            loops.count_reached(thresholds.data(), thresholds.size(), ranks.data(), plans,
                                reached.data());
            note(reached);
            for (std::size_t p = 0; p < plans; ++p)
                EXPECT_EQ(reached[p], std::ranges::count_if(thresholds, [&](std::int32_t t) {
                              return ranks[p] >= t;
                          }));
        }
        const std::vector<std::int32_t> habits(plans, rank_count / 3 * 2);
        const std::vector<float> stretches(plans, 3.0f);
        std::vector<std::int32_t> stretched(plans);
        loops.stretch(habits.data(), stretches.data(), ranks.data(), plans, stretched.data());
        note(stretched);
        for (std::size_t p = 0; p < plans; ++p) {
            EXPECT_GE(stretched[p], 0);
            EXPECT_LT(stretched[p], rank_count);
        }
        loops.keep_habits(habits.data(), ranks.data(), -7, plans, stretched.data());
        note(stretched);
        EXPECT_GT(std::ranges::count(stretched, -7), 0);
        for (std::size_t p = 0; p < plans; ++p) EXPECT_EQ(stretched[p] == -7, ranks[p] < habits[p]);
        using Range = solvers::RealHead::Range;
        for (const Range range :
             {Range::Bounded, Range::AboveLower, Range::BelowUpper, Range::Free}) {
            // Two reals, of which the other one is free.
            constexpr float infinity = std::numeric_limits<float>::infinity();
            const float means[] = {0.5f, 0}, deviations[] = {2, 1};
            const float least[] = {range == Range::Free ? -infinity : 0, -infinity};
            const float most[] = {range == Range::Bounded ? 2 : infinity, infinity};
            std::vector<float> all_means(2 * repetitions), all_deviations(2 * repetitions),
                all_least(2 * repetitions), all_most(2 * repetitions);
            repeat(means, 2, all_means.data());
            repeat(deviations, 2, all_deviations.data());
            repeat(least, 2, all_least.data());
            repeat(most, 2, all_most.data());
            for (std::size_t first : {0, 6}) {  // the second one is that of the seventh real
                const std::vector<float> before = noise;
                loops.draw_numbers({old.data(), fresh.data(), drawn.data(), widths.data()},
                                   {2 * repetitions, all_means.data(), all_deviations.data(),
                                    all_least.data(), all_most.data()},
                                   first, plans, noise.data(), numbers.data(), mirrored.data());
                note(noise);
                note(numbers);
                note(mirrored);
                for (std::size_t p = 0; p < plans; ++p) {
                    EXPECT_EQ(noise[p], 0.8f * before[p] + 0.6f * drawn[p]);
                    const std::size_t r = p % 2;
                    const float away = deviations[r] * 1.5f * noise[p];
                    EXPECT_EQ(numbers[p], std::clamp(means[r] + away, least[r], most[r]));
                    EXPECT_EQ(mirrored[p], std::clamp(means[r] - away, least[r], most[r]));
                }
            }
            for (const bool rounds : {false, true}) {
                for (const double exact_default : {0.1, 0.125}) {  // in doubles, and in floats
                    const RealScale reals[] = {scale_of_range(range, rounds, exact_default),
                                               scale_of_range(Range::Free, false, 0.125)};
                    loops.real_values(RealScales(reals), numbers.data(), plans, values.data());
                    note(values);
                }
            }
        }
        // The values are any, and some of them equal.
        EXPECT_EQ(loops.count_above(values.data(), plans, values[5]),
                  std::ranges::count_if(values, [&](double v) { return v > values[5]; }));
        std::vector<std::size_t> order(plans), before(plans);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) { return values[k]; });
        loops.count_before(values.data(), plans, before.data());
        for (std::size_t k = 0; k < plans; ++k) EXPECT_EQ(before[order[k]], k);
        // Rows of 11 numbers.
        numbers.resize(plans + slack);
        const std::size_t chosen[] = {6, 0, 3};
        const double weights[] = {0.5, 0.25, 0.25};
        std::vector<double> sums(11), squares(11);
        loops.add_moments({numbers.data(), 11, 3, chosen, weights}, fresh.data(), sums.data(),
                          squares.data());
        note(sums);
        note(squares);
        for (std::size_t r = 0; r < 11; ++r) {
            double sum = 0, square = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const double x = static_cast<double>(numbers[chosen[c] * 11 + r]) -
                                 static_cast<double>(fresh[r]);
                sum += weights[c] * x;
                square += weights[c] * x * x;
            }
            EXPECT_EQ(sums[r], sum);
            EXPECT_EQ(squares[r], square);
        }
        return all;
    };
    const auto portable = run("sse2");
    EXPECT_EQ(portable, run("avx2"));
    EXPECT_EQ(portable, run("avx512"));
}

std::vector<double> values_of(const RealScale& real, const std::vector<float>& numbers) {
    std::vector<double> values(numbers.size());
    plan_loops().real_values(RealScales({&real, 1}), numbers.data(), numbers.size(), values.data());
    return values;
}
double value_of(const RealScale& real, float number) {
    return values_of(real, {number}).front();
}

TEST(PlanLoops, GiveRealsTheirValues) {
    using Range = solvers::RealHead::Range;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Range range : {Range::Bounded, Range::AboveLower, Range::BelowUpper, Range::Free}) {
        solvers::RealHead head;
        head.range = range;
        head.lower = range == Range::BelowUpper || range == Range::Free ? -infinity : -2.5;
        head.upper = range == Range::AboveLower || range == Range::Free ? infinity : 7.25;
        head.scale = 3;
        head.centre = 0.5;
        const auto [least, most] = number_limits(head);
        const float middle = middle_number(range);
        std::vector<float> numbers;
        for (float u = -200; u < 200; u += 0.37f)
            numbers.push_back(std::clamp(u + middle, least, most));
        const std::vector<double> values =
            values_of({range, false, head.lower, head.upper, head.scale, head.centre, head.least(),
                       head.most(), 0.1f, 0.1},
                      numbers);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const double expected =
                solvers::real_value(head, static_cast<double>(numbers[k] - middle));
            const bool is_bent = range == Range::AboveLower || range == Range::BelowUpper;
            const double difference = is_bent ? 0.076 * head.scale : 0;
            EXPECT_NEAR(values[k], expected, difference + 1e-5 * (1 + std::abs(expected)))
                << numbers[k];
        }
    }
    // Rows are read as they were written, bounds among them.
    solvers::ActionSpace space;
    space.reals.resize(1);
    space.reals[0].range = Range::AboveLower;
    space.reals[0].lower = -2;
    space.reals[0].upper = infinity;
    for (const float written : {-2.0f, -1.875f, 0.0f, 0.5f, 1.0f, 100.0f}) {
        float number = 0;
        read_plan_action(space, &written, &number, nullptr);
        const double again =
            value_of({Range::AboveLower, false, -2, infinity, 1, 0, -2, 1e9, 0.1f, 0.1}, number);
        EXPECT_NEAR(again, static_cast<double>(written), 1e-4);
        EXPECT_EQ(again == -2, written == -2);
    }
    // 0.1f is beyond a bound of 0.1.
    EXPECT_EQ(value_of({Range::Bounded, false, -0.1, 0.1, 1, 0, -0.1, 0.1, 0.0f, 0.0}, 2), 0.1);
    // 0.05f, which lies above 0.05, is as near as floats get to that bound.
    EXPECT_EQ(value_of({Range::AboveLower, false, 0.05, infinity, 1, 0, 0.05, 1e9, 1.0f, 1}, 0),
              static_cast<double>(0.05f));
    // 0.7f lies below 0.7.
    EXPECT_EQ(value_of({Range::AboveLower, false, 0.7, infinity, 1, 0, 0.7, 1e9, 1.0f, 1}, 0),
              static_cast<double>(std::nextafter(0.7f, 1.0f)));
    // Ints are within 1e9 also where they have no bounds.
    const float huge = 1e30f;
    EXPECT_EQ(value_of({Range::Free, true, -infinity, infinity, 1, 0, -1e9, 1e9, 0.0f, 0.0}, huge),
              1e9);
    // A default beyond 1e9 is the middle of what plans draw.
    solvers::RealHead far;
    far.lower = -infinity;
    far.upper = infinity;
    far.centre = 3e9;
    far.scale = 1e6;
    const RealScale far_scale{Range::Free, false,       -infinity,  infinity, far.scale,
                              far.centre,  far.least(), far.most(), 3e9f,     3e9};
    EXPECT_EQ(value_of(far_scale, middle_number(far.range)), 3e9);
    EXPECT_NEAR(value_of(far_scale, number_limits(far).most), 6e9, 1e3);
    EXPECT_NEAR(value_of(far_scale, number_limits(far).least), -6e9, 1e3);
    // Bounds beyond the floats do not make actions infinite.
    EXPECT_EQ(
        value_of({Range::AboveLower, false, 1e308, infinity, 1, 0, 1e308, infinity, 0.0f, 0.0},
                 huge),
        1e308);
    const RealScale widest{Range::Bounded, false,   -1.7e308, 1.7e308, 1, 0,
                           -1.7e308,       1.7e308, 0.0f,     0.0};
    EXPECT_EQ(value_of(widest, 2), static_cast<double>(std::numeric_limits<float>::max()));
    EXPECT_EQ(value_of(widest, 1), 0);
    // A value that is the default as a float is the default itself.
    EXPECT_EQ(value_of({Range::Free, false, -infinity, infinity, 1, 0.1, -1e9, 1e9, 0.1f, 0.1}, 0),
              0.1);
}

// So many reals without bounds, and bools.
solvers::ActionSpace space_of(std::size_t reals, std::size_t bools) {
    solvers::ActionSpace space;
    space.reals.resize(reals);
    space.categories.resize(bools);
    return space;
}

TEST(PlanNoise, DrawsWidthsAboveAndBelowOne) {
    constexpr std::size_t many = 20'000;
    const double correlation = 0;
    PlanNoise noise(2 * many, space_of(1, 0), {&correlation, 1});
    double sum = 0, squares = 0;
    for (const float width : std::span(noise.widths(), many)) {
        const auto power = static_cast<double>(std::log(width));
        EXPECT_LE(std::abs(power), 4.5 + 1e-4);
        sum += power;
        squares += power * power;
    }
    EXPECT_NEAR(sum / many, 0, 0.05);
    EXPECT_NEAR(std::sqrt(squares / many), 1.5, 0.05);
}

TEST(PlanNoise, PutsPlansOfAboutTheSameWidthSideBySide) {
    constexpr std::size_t first = 10, many = 60;  // the first ones are any
    const double correlation = 0;
    PlanNoise noise(2 * many, space_of(2, 0), {&correlation, 1});
    RandomStream stream(1, 2, 3);
    std::set<float> drawn;
    for (int k = 0; k < 8; ++k) {
        noise.restart(stream);
        const auto greatest = [&](std::size_t p) {
            return std::max(noise.widths()[2 * p], noise.widths()[2 * p + 1]);
        };
        for (std::size_t p = first + 1; p < many; ++p) EXPECT_LE(greatest(p - 1), greatest(p));
        drawn.insert(greatest(many - 1));
    }
    EXPECT_GT(drawn.size(), 3);
}

TEST(PlanNoise, IsCorrelatedAndKeepsItsDistribution) {
    constexpr std::size_t many = 20'000;
    for (const double correlation : {0.0, 0.8}) {
        PlanNoise noise(2 * many, space_of(1, 1), {&correlation, 1});
        RandomStream stream(1, 2, 3);
        std::vector<float> numbers(2 * many);
        const std::vector<float> zeros(repetitions, 0), ones(repetitions, 1),
            least(repetitions, -1e9f), most(repetitions, 1e9f);
        const auto next_step = [&] {
            noise.next_numbers(stream,
                               {repetitions, zeros.data(), ones.data(), least.data(), most.data()},
                               numbers.data());
            for (std::size_t p = 0; p < many; ++p) {
                EXPECT_EQ(numbers[p], -numbers[many + p]);
                numbers[p] /= noise.widths()[p];
            }
            noise.next_ranks(stream);
        };
        for (int t = 0; t < 10; ++t) next_step();
        const std::vector<float> before = numbers;
        const std::vector<std::int32_t> ranks_before(noise.ranks(0), noise.ranks(0) + many);
        next_step();
        double sum = 0, squares = 0, products = 0, ranks = 0, same = 0;
        for (std::size_t p = 0; p < many; ++p) {
            const auto x = static_cast<double>(numbers[p]);
            sum += x;
            squares += x * x;
            products += x * static_cast<double>(before[p]);
            ranks += noise.ranks(0)[p];
            same += noise.ranks(0)[p] == ranks_before[p];
        }
        EXPECT_NEAR(sum / many, 0, 0.035);  // 5 standard errors
        EXPECT_NEAR(squares / many, 1, 0.05);
        EXPECT_NEAR(products / many, correlation, 0.035);
        EXPECT_NEAR(ranks / many / rank_count, 0.5, 0.011);
        EXPECT_NEAR(same / many, correlation, 0.02);
        // Plans that begin again know nothing of what was before.
        const std::vector<float> last = numbers;
        noise.restart(stream);
        next_step();
        products = 0;
        for (std::size_t p = 0; p < many; ++p)
            products += static_cast<double>(numbers[p]) * static_cast<double>(last[p]);
        EXPECT_NEAR(products / many, 0, 0.035);
        const float* const widths = noise.widths();
        const auto share = [&](auto condition) {
            return static_cast<double>(std::count_if(widths, widths + many, condition)) / many;
        };
        EXPECT_NEAR(share([](float w) { return w > 1; }), 0.5, 0.02);
        EXPECT_NEAR(share([](float w) { return w > 7; }), 0.097, 0.01);
    }
}

// Records of a population are those of write_action for each plan.
TEST(PlanActions, AreThoseOfSinglePlans) {
    for (const rddl_simulator* simulator :
         {&target(), &ladder(), &network(), &reservoir(), &car()}) {
        SCOPED_TRACE(simulator->problem->domain);
        const solvers::ActionSpace space = solvers::action_space(*simulator);
        const solvers::ActionRecords records(*simulator);
        Population population(plans, space.real_count(), space.index_count());
        population.set_steps(1);
        const double correlation = 0;
        PlanNoise noise(plans, space, {&correlation, 1});
        RandomStream stream(1, 2, 3);
        Distribution distribution(space, {});
        distribution.restart(1);
        distribution.draw(stream, noise, population);
        PlanActions actions(space, records, plans);
        const std::size_t size = records.record_size();
        std::vector<std::byte> all(plans * size), some(3 * size), expected(size);
        actions.write(population, 0, {}, all.data());
        const std::uint32_t chosen[] = {70, 0, 33};
        actions.write(population, 0, chosen, some.data());
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(std::memcmp(all.data() + chosen[k] * size, some.data() + k * size, size), 0);
        Plan plan;
        plan.numbers.resize(static_cast<std::size_t>(space.real_count()));
        plan.indices.resize(static_cast<std::size_t>(space.index_count()));
        std::vector<float> row(static_cast<std::size_t>(space.column_count)), written = row;
        std::vector<float> most_differences(row.size(), 0.0f);  // of what is bent
        for (const solvers::RealHead& head : space.reals)
            if (head.range == solvers::RealHead::Range::AboveLower ||
                head.range == solvers::RealHead::Range::BelowUpper)
                most_differences[static_cast<std::size_t>(head.column)] =
                    0.076f * static_cast<float>(head.scale);
        int different = 0;
        for (std::size_t p = 0; p < plans; ++p) {
            population.get(p, plan);
            for (std::size_t r = 0; r < space.reals.size(); ++r)
                plan.numbers[r] -= middle_number(space.reals[r].range);
            solvers::write_action(space, plan.numbers.data(), plan.indices.data(), row.data());
            records.read(all.data() + p * size, written.data());
            for (std::size_t c = 0; c < row.size(); ++c)
                EXPECT_NEAR(row[c], written[c],
                            most_differences[c] + 1e-5f * (1 + std::abs(row[c])));
            different += written != space.defaults;
        }
        EXPECT_GT(different, 10);
    }
}

}  // namespace
}  // namespace rddlc::planners
