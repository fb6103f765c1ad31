#include "passes/analyses/count_steps.hpp"

#include <rddl/random/distributions.hpp>

#include <algorithm>
#include <array>
#include <functional>

namespace rddlc::passes {
namespace {

// Uniform numbers are multiples of 1 / number_count.
constexpr std::int64_t number_count = std::int64_t{1} << 52;
constexpr double largest_exact_int = 0x1p53;
constexpr double real_of(std::int64_t number) {
    return static_cast<double>(number) / static_cast<double>(number_count);
}

using Draw = std::function<std::int64_t(rddl::Draws&)>;

// The count that the simulator draws with this uniform number.
std::int64_t count_of(const Draw& draw, std::int64_t number) {
    const std::array<double, rddl::Draws::first_count> numbers{real_of(number)};
    rddl::Draws draws(rddl::StreamKey{}, 0, rddl::Place{0, 0}, numbers);
    return draw(draws);
}

// The probability of what is counted.
double rarer(double probability) {
    return std::min(probability, 1 - probability);
}
bool are_failures(Distribution distribution, const std::vector<double>& parameters) {
    return distribution == Distribution::Binomial && parameters[1] > 0.5;
}

// Whether one uniform number decides the count, which grows with it.
bool walks_up(Distribution distribution, const std::vector<double>& parameters) {
    if (distribution == Distribution::Poisson)
        return parameters[0] >= 0 && parameters[0] < rddl::largest_walked_mean;
    return parameters[0] >= 0 && parameters[0] <= largest_exact_int && parameters[1] >= 0 &&
           parameters[1] <= 1 && parameters[0] * rarer(parameters[1]) < rddl::largest_walked_mean;
}
Draw draw_of(Distribution distribution, const std::vector<double>& parameters) {
    if (distribution == Distribution::Poisson)
        return [rate = parameters[0]](rddl::Draws& draws) {
            return rddl::standard_poisson(draws, rate);
        };
    return [trials = static_cast<std::int64_t>(parameters[0]),
            probability = parameters[1]](rddl::Draws& draws) {
        const std::int64_t successes = rddl::standard_binomial(draws, trials, probability);
        return probability > 0.5 ? trials - successes : successes;
    };
}

// A walk whose thresholds follow each other by one count, but the last one.
struct Walk {
    std::vector<double> thresholds;
    std::int64_t last;
    bool jumps() const { return last != static_cast<std::int64_t>(thresholds.size()); }
};
std::optional<Walk> walk_of(const Draw& draw) {
    Walk walk{{}, count_of(draw, number_count - 1)};
    std::int64_t reached = 0, count = count_of(draw, 0);
    if (count != 0) return std::nullopt;
    while (count < walk.last) {
        std::int64_t below = reached, from = number_count - 1;  // the count grows in between
        while (from - below > 1) {
            const std::int64_t middle = below + (from - below) / 2;
            (count_of(draw, middle) > count ? from : below) = middle;
        }
        const std::int64_t next = count_of(draw, from);
        if (next != count + 1 && next != walk.last) return std::nullopt;
        walk.thresholds.push_back(real_of(from));
        if (walk.thresholds.size() > most_count_steps) return std::nullopt;
        reached = from;
        count = next;
    }
    return walk;
}

}  // namespace

bool has_count_steps(Distribution distribution) {
    return distribution == Distribution::Poisson || distribution == Distribution::Binomial;
}

std::optional<CountSteps> counts_by_inversion(Distribution distribution,
                                              const std::vector<std::vector<double>>& parameters) {
    std::vector<Walk> walks;
    std::optional<std::int64_t> target;  // of jumps
    std::size_t length = 0;
    for (const std::vector<double>& row : parameters) {
        const bool is_alike =
            are_failures(distribution, row) == are_failures(distribution, parameters.front());
        if (!is_alike || !walks_up(distribution, row)) return std::nullopt;
        auto walk = walk_of(draw_of(distribution, row));
        if (!walk || (walk->jumps() && walk->last != target.value_or(walk->last)))
            return std::nullopt;
        if (walk->jumps()) target = walk->last;
        length = std::max(length, walk->thresholds.size());
        walks.push_back(std::move(*walk));
    }
    // A count of `length` means the target, so that no walk may end there.
    const auto ends_there = [&](const Walk& walk) {
        return !walk.jumps() && walk.thresholds.size() == length;
    };
    if (target && std::ranges::any_of(walks, ends_there)) ++length;
    CountSteps steps{{},
                     target.value_or(static_cast<std::int64_t>(length)),
                     are_failures(distribution, parameters.front())};
    for (Walk& walk : walks) {
        const double rest = walk.jumps() ? walk.thresholds.back() : 1;
        walk.thresholds.resize(length, rest);
        steps.thresholds.push_back(std::move(walk.thresholds));
    }
    return steps;
}

}  // namespace rddlc::passes
