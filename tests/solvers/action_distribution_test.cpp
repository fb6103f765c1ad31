// Probabilities of choices, and the loss of PPO: gradients by finite differences for every kind of
// head, sums over all choices, and actions that preconditions forbid.
#include "solvers/action_distribution/action_distribution.hpp"

#include "action_batch.hpp"
#include "simulators.hpp"
#include "solver_kite.h"
#include "solvers/action_distribution/probabilities.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/ppo/loss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace rddlc::solvers {
namespace {

struct Case {
    const char* name;
    ActionSpace space;
};

ActionSpace space_of(int reals, const std::vector<int>& categories, int sub_actions = 0,
                     int choices = 0, bool masked = false) {
    ActionSpace space;
    space.reals.resize(static_cast<std::size_t>(reals));
    for (const int count : categories) {
        CategoryHead head;
        head.first_logit = space.logit_count;
        head.count = count;
        space.categories.push_back(head);
        space.logit_count += count;
    }
    if (sub_actions > 0) {
        space.max_sub_actions = sub_actions;
        space.logit_count = choices;
        space.choices.resize(static_cast<std::size_t>(choices));
        for (int c = 1; c < choices; ++c) space.choices[static_cast<std::size_t>(c)].column = c - 1;
        for (int r = 0; r < reals; ++r) {
            space.reals[static_cast<std::size_t>(r)].choice = choices - reals + r;
            space.choices[static_cast<std::size_t>(choices - reals + r)].real = r;
        }
    }
    space.masked = masked || sub_actions > 0;
    return space;
}

std::vector<Case> cases() {
    ActionSpace squashed = space_of(2, {3});
    for (RealHead& head : squashed.reals) head.range = RealHead::Range::Squashed;
    return {{"squashed", squashed},
            {"reals", space_of(2, {})},
            {"one bool", space_of(0, {2})},
            {"categories", space_of(0, {2, 5, 3})},
            {"masked categories", space_of(0, {2, 5, 3}, 0, 0, true)},
            {"mixed", space_of(3, {2, 4})},
            {"one sub-action", space_of(0, {}, 1, 6)},
            {"three sub-actions", space_of(0, {}, 3, 7)},
            {"sub-actions with reals", space_of(2, {}, 3, 7)}};
}

// A sample of each kind; what was chosen is allowed.
struct Sample {
    std::vector<double> numbers, shifts;
    double spread = 1;
    std::vector<std::int32_t> indices;
    std::vector<std::uint8_t> masks;
};

Sample sample_of(const ActionSpace& space, std::mt19937& random) {
    std::normal_distribution<double> normal;
    Sample sample;
    for (int r = 0; r < space.real_count(); ++r) {
        sample.numbers.push_back(normal(random));
        sample.shifts.push_back(0.3 * normal(random));
    }
    sample.spread = random() % 2 ? 1 : 0.436;
    sample.masks.resize(static_cast<std::size_t>(space.mask_size()));
    for (auto& byte : sample.masks) byte = random() % 3 > 0;
    sample.indices.assign(static_cast<std::size_t>(space.index_count()), -1);
    for (std::size_t h = 0; h < space.categories.size(); ++h) {
        const CategoryHead& head = space.categories[h];
        sample.indices[h] = static_cast<int>(random() % static_cast<unsigned>(head.count));
        if (space.masked)
            sample.masks[static_cast<std::size_t>(head.first_logit + sample.indices[h])] = 1;
    }
    for (int p = 0; p < space.max_sub_actions; ++p) {
        const int index =
            p == 2 ? 0
                   : 1 + static_cast<int>(random() % static_cast<unsigned>(space.logit_count - 1));
        sample.indices[static_cast<std::size_t>(p)] = index;
        sample.masks[static_cast<std::size_t>(p * space.logit_count + index)] = 1;
        if (index == 0) break;
    }
    return sample;
}

TEST(Choosing, GradientsOfEveryHeadAgreeWithFiniteDifferences) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (const Case& each : cases())
        for (int round = 0; round < 20; ++round) {
            SCOPED_TRACE(each.name);
            const ActionSpace& space = each.space;
            const Sample sample = sample_of(space, random);
            std::vector<double> outputs(static_cast<std::size_t>(space.output_count()));
            std::vector<double> deviations(static_cast<std::size_t>(space.real_count()));
            for (double& x : outputs) x = normal(random);
            for (double& x : deviations) x = 0.3 * normal(random);
            const double by_log_probability = normal(random), by_entropy = normal(random);
            const auto value = [&] {
                const auto chosen =
                    look_at_choice(space, outputs.data(), deviations.data(), sample.numbers.data(),
                                   sample.shifts.data(), sample.spread, sample.indices.data(),
                                   space.masked ? sample.masks.data() : nullptr);
                return by_log_probability * chosen.log_probability + by_entropy * chosen.entropy;
            };
            std::vector<double> d_outputs(outputs.size()), d_deviations(deviations.size());
            choice_gradient(space, outputs.data(), deviations.data(), sample.numbers.data(),
                            sample.shifts.data(), sample.spread, sample.indices.data(),
                            space.masked ? sample.masks.data() : nullptr, by_log_probability,
                            by_entropy, d_outputs.data(), d_deviations.data());
            const auto check = [&](std::vector<double>& x, const std::vector<double>& d) {
                for (std::size_t i = 0; i < x.size(); ++i) {
                    const double before = x[i], step = 1e-6;
                    x[i] = before + step;
                    const double more = value();
                    x[i] = before - step;
                    const double less = value();
                    x[i] = before;
                    EXPECT_NEAR(d[i], (more - less) / (2 * step), 1e-6) << i;
                }
            };
            check(outputs, d_outputs);
            check(deviations, d_deviations);
        }
}

// The loss as a whole, with clipped ratios and values.
TEST(Choosing, GradientOfTheLossAgreesWithFiniteDifferences) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (const Case& each : cases())
        for (int round = 0; round < 20; ++round) {
            SCOPED_TRACE(each.name);
            const ActionSpace& space = each.space;
            const Sample sample = sample_of(space, random);
            std::vector<double> outputs(static_cast<std::size_t>(space.output_count()));
            std::vector<double> deviations(static_cast<std::size_t>(space.real_count()));
            for (double& x : outputs) x = normal(random);
            double estimate = normal(random);
            const double advantage = normal(random), old_value = normal(random),
                         target = normal(random);
            const double old =
                look_at_choice(space, outputs.data(), deviations.data(), sample.numbers.data(),
                               sample.shifts.data(), sample.spread, sample.indices.data(),
                               sample.masks.data())
                    .log_probability +
                0.3 * normal(random);
            const LossWeights weights{0.2, round % 2 ? 0.5 : 0, 0.5, 0.01, 0.1, 0.2, 1.5, 1};
            const Samples<double> rows{sample.numbers.data(),
                                       sample.shifts.data(),
                                       &sample.spread,
                                       sample.indices.data(),
                                       sample.masks.data(),
                                       &old,
                                       &advantage,
                                       &old_value,
                                       &target};
            std::vector<double> d_outputs(outputs.size()), d_deviations(deviations.size());
            double d_estimate = 0;
            LossSums ignored;
            const auto run = [&](LossSums& sums) {
                std::vector<double> d(outputs.size()), dd(deviations.size());
                double de = 0;
                add_loss(space, weights, rows, 1, outputs.data(), space.output_count(),
                         deviations.data(), 0, &estimate, 1, d.data(), &de, dd.data(), sums);
                d_outputs = d;
                d_deviations = dd;
                d_estimate = de;
            };
            const auto value = [&] {
                LossSums sums;
                run(sums);
                const double log_probability =
                    look_at_choice(space, outputs.data(), deviations.data(), sample.numbers.data(),
                                   sample.shifts.data(), sample.spread, sample.indices.data(),
                                   sample.masks.data())
                        .log_probability;
                return sums.policy + 0.5 * sums.value - 0.01 * sums.entropy - 0.1 * log_probability;
            };
            run(ignored);
            const auto gradient = d_outputs;
            const double by_estimate = d_estimate;
            const auto difference = [&](double& x) {
                const double before = x, step = 1e-6;
                x = before + step;
                const double more = value();
                x = before - step;
                const double less = value();
                x = before;
                return (more - less) / (2 * step);
            };
            for (std::size_t i = 0; i < outputs.size(); ++i)
                EXPECT_NEAR(gradient[i], difference(outputs[i]), 2e-6) << i;
            EXPECT_NEAR(by_estimate, difference(estimate), 2e-6);
        }
}

TEST(Choosing, ProbabilitiesOfAllChoicesAddUpToOne) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const ActionSpace categories = space_of(0, {2, 5, 3}, 0, 0, true);
    std::vector<double> logits(10);
    for (double& x : logits) x = normal(random);
    const std::vector<std::uint8_t> masks{1, 1, 0, 1, 1, 0, 1, 1, 0, 1};
    double sum = 0, entropy = 0;
    Category<double> last;
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 5; ++b)
            for (int c = 0; c < 3; ++c) {
                if (!masks[static_cast<std::size_t>(2 + b)] ||
                    !masks[static_cast<std::size_t>(7 + c)])
                    continue;
                const std::int32_t indices[] = {a, b, c};
                last = look_at_choice<double>(categories, logits.data(), nullptr, nullptr, nullptr,
                                              1, indices, masks.data());
                sum += std::exp(last.log_probability);
                entropy -= std::exp(last.log_probability) * last.log_probability;
            }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(entropy, last.entropy, 1e-12);

    // A real's density, with noise that is correlated in time, by the trapezoidal rule.
    const ActionSpace real = space_of(1, {});
    const double mean = 0.4, log_deviation = -0.3, shift = 0.25;
    sum = entropy = 0;
    for (double x = -10; x <= 10; x += 1e-3) {
        const auto at = look_at_choice<double>(real, &mean, &log_deviation, &x, &shift, 0.436,
                                               nullptr, nullptr);
        sum += std::exp(at.log_probability) * 1e-3;
        entropy -= std::exp(at.log_probability) * at.log_probability * 1e-3;
        last = at;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_NEAR(entropy, last.entropy, 1e-9);
}

// The density of tanh(u), over what it may be; and where tanh(u) is 1 to all digits.
TEST(Choosing, SquashedDensityAddsUpToOne) {
    ActionSpace real = space_of(1, {});
    real.reals[0].range = RealHead::Range::Squashed;
    const double mean = 0.4, log_deviation = -0.3, shift = 0.25;
    double sum = 0, entropy = 0, said = 0;
    for (double u = -8; u <= 8; u += 1e-3) {
        const auto at =
            look_at_choice<double>(real, &mean, &log_deviation, &u, &shift, 1, nullptr, nullptr);
        const double area = 1e-3 * (1 - std::tanh(u) * std::tanh(u));
        sum += std::exp(at.log_probability) * area;
        entropy -= std::exp(at.log_probability) * at.log_probability * area;
        said = at.entropy;
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_NEAR(entropy, said, 1e-3);
    EXPECT_NEAR(log_squash_slope(0.7), std::log(1 - std::pow(std::tanh(0.7), 2)), 1e-12);
    EXPECT_NEAR(log_squash_slope(300.0), 2 * std::log(2.0) - 600, 1e-9);
}

// Draws have the frequencies that the logits say, and the noise of reals its correlation.
TEST(Choosing, DrawsAsItSays) {
    const rddl_simulator& simulator = *rddl_simulator_mountain_car_mountain_car_1();
    const ActionSpace space = action_space(simulator);
    ASSERT_EQ(space.real_count(), 1);
    constexpr std::int64_t environments = 64, steps = 2000;
    ActionDistribution distribution(simulator, space, Noise::Ar1, 0.9, environments);
    rddl_batch_options options{};
    options.environment_count = environments;
    const BatchHandle batch = create_batch(simulator, options);
    std::vector<float> outputs(environments, 0.5f), numbers(environments), shifts(environments),
        spreads(environments), log_probabilities(environments), actions(environments);
    const float log_deviation = std::log(0.7f);
    double sum = 0, squares = 0, products = 0, count = 0;
    std::vector<float> before;
    for (std::int64_t t = 0; t < steps; ++t) {
        distribution.choose(
            batch.get(), outputs.data(), 1, Deviations{&log_deviation},
            [&](std::int64_t e) {
                return ChoiceKey{9, static_cast<std::uint64_t>(e), static_cast<std::uint64_t>(t)};
            },
            {numbers.data(), shifts.data(), spreads.data(), nullptr, nullptr,
             log_probabilities.data()},
            actions.data());
        for (std::size_t e = 0; e < numbers.size(); ++e) {
            const double noise = static_cast<double>(numbers[e]) - 0.5;
            sum += noise;
            squares += noise * noise;
            if (t > 0) products += noise * (static_cast<double>(before[e]) - 0.5);
            count += 1;
        }
        before = numbers;
    }
    EXPECT_NEAR(sum / count, 0, 0.02);
    EXPECT_NEAR(std::sqrt(squares / count), 0.7, 0.01);
    EXPECT_NEAR(products / squares, 0.9, 0.01);
}

// A repaired action is legal wherever doing nothing is, and a legal one stays as it is. Simulators
// refuse a step with an action that is nan.
TEST(Actions, AreTheDefaultWhereAPolicyHasNoNumber) {
    const float infinite = std::numeric_limits<float>::infinity();
    for (const rddl_simulator* const simulator : simulators()) {
        const ActionSpace space = action_space(*simulator);
        const std::vector<std::int32_t> indices(static_cast<std::size_t>(space.index_count()));
        std::vector<float> values(static_cast<std::size_t>(space.column_count));
        for (const float number : {std::nanf(""), infinite, -infinite}) {
            const std::vector<float> numbers(space.reals.size(), number);
            write_action(space, numbers.data(), indices.data(), values.data());
            for (const float value : values) EXPECT_TRUE(std::isfinite(value)) << number;
            if (std::isnan(number))
                for (const RealHead& head : space.reals) {
                    const auto column = static_cast<std::size_t>(head.column);
                    EXPECT_EQ(values[column], space.defaults[column]);
                }
        }
    }
}

// Rows hold floats, and the float next to a bound may lie beyond it.
TEST(Actions, KeepToBoundsThatFloatsDoNotHave) {
    const rddl_simulator& kite = *rddl_simulator_kite_kite_1();
    const ActionSpace space = action_space(kite);
    const ActionRecords records(kite);
    std::vector<std::byte> action(records.record_size());
    for (const double bound : {-100.3, 100.3}) {
        const float number = bound < 0 ? -2 : 2;
        float value = 0;
        write_action(space, &number, nullptr, &value);
        EXPECT_NE(static_cast<double>(value), bound);
        records.write(&value, action.data());
        double written = 0;
        std::memcpy(&written, action.data(), sizeof written);
        EXPECT_EQ(written, bound);
    }
}

TEST(Repair, MakesActionsLegal) {
    ActionBatch all(*rddl_simulator_reservoir_reservoir_1());
    ASSERT_TRUE(all.space.may_be_illegal);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 200);
    std::int64_t repaired = 0;
    for (int step = 0; step < 20; ++step) {
        for (float& value : all.values) value = random() % 3 ? uniform(random) : 0.0f;
        all.write();
        const std::vector<float> wanted = all.values;
        const std::vector<std::int32_t> before = all.violated();
        repaired += all.mend();
        EXPECT_EQ(all.violated(), all_legal);
        for (std::size_t e = 0; e < all.environments; ++e)
            for (std::size_t c = 0; c < all.columns && before[e] < 0; ++c)
                EXPECT_EQ(all.row(e)[c], wanted[e * all.columns + c]);
        all.simulator.step(all.batch.get(), all.bytes.data(), nullptr);
    }
    EXPECT_GT(repaired, 100);
}

}  // namespace
}  // namespace rddlc::solvers
