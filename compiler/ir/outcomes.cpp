#include "ir/outcomes.hpp"

#include "support/failure.hpp"

#include <rddl/random/distributions/saddle_point.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rddlc::ir {

namespace {

constexpr std::int64_t most_trials = 1'000'000;

// The first one with a positive probability from `begin` on; the size if all are 0.
std::size_t next_possible(const std::vector<double>& probabilities, std::size_t begin) {
    const auto found = std::find_if(probabilities.begin() + static_cast<std::ptrdiff_t>(begin),
                                    probabilities.end(), [](double p) { return p > 0; });
    return static_cast<std::size_t>(found - probabilities.begin());
}

}  // namespace

std::vector<double> binomial_probabilities(std::int64_t trials, double p) {
    if (trials > most_trials)
        throw Failure(fmt::format("the outcomes of {} trials are not listed one by one", trials),
                      fmt::format("those of {} are", most_trials));
    std::vector<double> probabilities(static_cast<std::size_t>(trials) + 1);
    if (p <= 0 || p >= 1 || trials == 0) {
        (p >= 1 ? probabilities.back() : probabilities.front()) = 1;
        return probabilities;
    }
    const auto n = static_cast<double>(trials);
    for (std::size_t k = 0; k < probabilities.size(); ++k)
        probabilities[k] = std::exp(rddl::ln_binomial_probability(static_cast<double>(k), n, p));
    return probabilities;
}

std::int64_t Outcomes::choose(rddl::Place place, std::vector<double> probabilities,
                              std::size_t part) {
    const auto is_same = [&](const Draw& draw) {
        return draw.place.series == place.series && draw.place.index == place.index &&
               draw.part == part;
    };
    for (std::size_t i = 0; i < made_; ++i)
        if (is_same(draws_[i])) return static_cast<std::int64_t>(draws_[i].chosen);
    if (made_ == draws_.size()) {
        const std::size_t first = next_possible(probabilities, 0);
        draws_.push_back({place, part, std::move(probabilities), first});
    }
    return static_cast<std::int64_t>(draws_[made_++].chosen);
}

// Each count is binomial given those before it; the last possible category gets what is left.
void Outcomes::choose_multinomial(rddl::Place place, std::int64_t trials,
                                  std::span<const double> probabilities,
                                  std::span<std::int64_t> counts) {
    double left = 0;
    for (const double p : probabilities) left += std::max(p, 0.0);
    std::fill(counts.begin(), counts.end(), 0);
    std::size_t last = probabilities.size();
    while (last > 1 && probabilities[last - 1] <= 0) --last;
    for (std::size_t i = 0; i + 1 < last; ++i) {
        const double p = std::max(probabilities[i], 0.0);
        counts[i] = choose(place, binomial_probabilities(trials, p < left ? p / left : 1.0), i);
        trials -= counts[i];
        left -= p;
    }
    counts[last - 1] = trials;
}

double Outcomes::probability() const {
    double product = 1;
    for (std::size_t i = 0; i < made_; ++i) product *= draws_[i].probabilities[draws_[i].chosen];
    return product;
}

bool Outcomes::next() {
    made_ = 0;
    while (!draws_.empty()) {
        Draw& last = draws_.back();
        last.chosen = next_possible(last.probabilities, last.chosen + 1);
        if (last.chosen < last.probabilities.size()) return true;
        draws_.pop_back();
    }
    return false;
}

}  // namespace rddlc::ir
