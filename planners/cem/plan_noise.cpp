#include "planners/cem/plan_noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace rddlc::planners {
namespace {

// The sum of three numbers of 0 .. 1023 has the mean 1534.5 and the deviation 512.
float bell_of(std::uint32_t bits) {
    const std::uint32_t sum = (bits & 1023) + ((bits >> 10) & 1023) + ((bits >> 20) & 1023);
    return (static_cast<float>(static_cast<std::int32_t>(sum)) - 1534.5f) * (1.0f / 512);
}

// 2^x for -126 <= x <= 0, within 2e-7 of its value, and the same bits with any library.
float power_of_two(float x) {
    const auto whole = static_cast<std::int32_t>(x);
    const float r = x - static_cast<float>(whole), square = r * r;  // r in (-1, 0]
    const float low = (1.0f + 0.69314712f * r) + (0.24022487f + 0.05549252f * r) * square;
    const float high = (0.0095818322f + 0.0012765167f * r) + 0.00010944255f * square;
    return (low + high * (square * square)) * std::bit_cast<float>((whole + 127) << 23);
}

// Numbers that are drawn once, and read from random places: so do evolution strategies (Salimans
// and others, Evolution strategies as a scalable alternative to reinforcement learning, 2017).
struct NoiseTables {
    static constexpr std::size_t size = std::size_t{1} << 15;
    // At most so many numbers in turn are read from one place.
    static constexpr std::size_t run = 1024;
    static constexpr std::size_t line = 16;  // places begin at cache lines

    NoiseTables() {
        // Exponents are lowered by 7 and raised again, since power_of_two() takes none above 0.
        constexpr float octaves = 1.5f * 1.44269504f, most_octaves = 7, scale = 128;
        for (std::uint32_t k = 0; k < size; ++k) {
            bells[k] = bell_of(noise_bits(0, k));
            widths[k] = scale * power_of_two(octaves * bells[k] - most_octaves);
        }
    }
    alignas(64) float bells[size];
    alignas(64) float widths[size];  // exp(1.5 n), n being a number of `bells`
};

const NoiseTables& noise_tables() {
    static const NoiseTables tables;
    return tables;
}

// Calls body(first, count, place) for runs of a row: a run reads `count` numbers from `place` on.
// It holds whole periods, unless a period is longer than any run.
template <class Body>
void for_each_run(RandomStream& stream, std::size_t row, std::size_t period, Body body) {
    constexpr std::size_t places = (NoiseTables::size - NoiseTables::run) / NoiseTables::line;
    constexpr std::size_t most = NoiseTables::run;
    const std::size_t run = period < most ? most / period * period : most;
    for (std::size_t first = 0; first < row; first += run)
        body(first, std::min(run, row - first),
             NoiseTables::line * stream.below(static_cast<std::uint32_t>(places + 1)));
}

std::uint32_t key_of(RandomStream& stream) {
    return static_cast<std::uint32_t>(stream.bits() >> 32);
}

}  // namespace

PlanNoise::PlanNoise(std::size_t plans, const solvers::ActionSpace& space,
                     std::span<const double> correlations)
    : loops_(plan_loops()),
      plans_(plans),
      pairs_((plans + 1) / 2),
      nothing_(space.reals.size() * pairs_, 0.0f),
      all_(nothing_.size(), 1.0f),
      no_chance_(plans, 0),
      habits_(plans, 0),
      stretches_(plans, 1.0f),
      values_(nothing_.size()),
      ranks_(static_cast<std::size_t>(space.index_count()) * plans) {
    for (std::size_t p = 0; p < pairs_; ++p) {
        const double correlation = correlations[p % correlations.size()];
        old_.insert(old_.end(), space.reals.size(), static_cast<float>(correlation));
        fresh_.insert(fresh_.end(), space.reals.size(),
                      static_cast<float>(std::sqrt(1 - correlation * correlation)));
    }
    for (std::size_t p = 0; p < plans; ++p) {
        const double of_ranks = correlations[p / (2 * correlations.size()) % correlations.size()];
        keep_.push_back(static_cast<std::uint32_t>(std::lround(256 * of_ranks)));
    }
    if (!space.reals.empty()) draw_widths(space);
}

// Rows are in ascending order from the eleventh plan on. A search puts plans that are not drawn in
// the places of the first ones, which would else be the narrow ones.
void PlanNoise::draw_widths(const solvers::ActionSpace& space) {
    constexpr std::size_t least_rows = 4, most_rows = 32, most_values = std::size_t{1} << 16;
    constexpr std::size_t any = 10;
    using Range = solvers::RealHead::Range;
    const std::size_t values = values_.size(), reals = space.reals.size();
    rows_of_widths_ = std::clamp(most_values / values, least_rows, most_rows);
    widths_.resize(rows_of_widths_ * values);
    RandomStream stream(0, 0, 0);
    std::vector<float> drawn(values);
    std::vector<std::pair<float, std::size_t>> order(pairs_);  // by the greatest width of a pair
    for (float* row = widths_.data(); row < widths_.data() + widths_.size(); row += values) {
        for (std::size_t k = 0; k < values; ++k) {
            const bool has_bounds = space.reals[k % reals].range == Range::Bounded;
            drawn[k] = has_bounds ? 1 : noise_tables().widths[stream.below(NoiseTables::size)];
        }
        for (std::size_t p = 0; p < pairs_; ++p) {
            const float* const pair = drawn.data() + p * reals;
            order[p] = {*std::max_element(pair, pair + reals), p};
        }
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(std::min(any, pairs_)), order.end());
        for (std::size_t p = 0; p < pairs_; ++p)
            std::copy_n(drawn.data() + order[p].second * reals, reals, row + p * reals);
    }
}

void PlanNoise::restart(RandomStream& stream) {
    is_first_numbers_ = is_first_ranks_ = true;
    if (!widths_.empty())
        row_of_widths_ = stream.below(static_cast<std::uint32_t>(rows_of_widths_));
    if (ranks_.empty()) return;
    for (std::size_t p = 1; p < plans_; p += 2) {
        constexpr double rarest = 7;  // in powers of two
        const double departs = std::exp2(-rarest * stream.unit());
        habits_[p] = static_cast<std::int32_t>((1 - departs) * rank_count);
        stretches_[p] = static_cast<float>(1 / departs);
    }
}

void PlanNoise::next_numbers(RandomStream& stream, const NumberScales& scales, float* numbers) {
    const float* const old = is_first_numbers_ ? nothing_.data() : old_.data();
    const float* const fresh = is_first_numbers_ ? all_.data() : fresh_.data();
    const float* const bells = noise_tables().bells;
    float* const mirrored = numbers + values_.size();
    for_each_run(stream, values_.size(), scales.period,
                 [&](std::size_t first, std::size_t count, std::size_t place) {
                     loops_.draw_numbers(
                         {old + first, fresh + first, bells + place, widths() + first}, scales,
                         first, count, values_.data() + first, numbers + first, mirrored + first);
                 });
    is_first_numbers_ = false;
}

void PlanNoise::next_ranks(RandomStream& stream) {
    const std::uint32_t* const keep = is_first_ranks_ ? no_chance_.data() : keep_.data();
    for (std::int32_t* row = ranks_.data(); row < ranks_.data() + ranks_.size(); row += plans_)
        loops_.next_ranks({key_of(stream), keep}, plans_, row);
    is_first_ranks_ = false;
}

}  // namespace rddlc::planners
