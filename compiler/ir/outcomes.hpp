// The outcomes of a step's draws, one combination after the other, instead of random ones.
#pragma once

#include <rddl/values/context.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rddlc::ir {

// The probabilities of the counts from 0 to trials, for trials >= 0 and 0 <= p <= 1. Throws a
// Failure if the list would be too long.
std::vector<double> binomial_probabilities(std::int64_t trials, double p);

// Evaluations that are given it ask it at each finite draw. They are made again and again, each
// with other choices, until next() says that there are no more: depth first, in the order of the
// draws.
//
//     do { evaluate; use probability(); } while (outcomes.next());
class Outcomes {
  public:
    // An index into the probabilities, of which at least one is positive; the chosen one is
    // positive. A draw that is evaluated twice is one draw. part: of a vector that is drawn.
    std::int64_t choose(rddl::Place place, std::vector<double> probabilities, std::size_t part = 0);

    // Counts of the trials in each category, whose probabilities sum up to about 1.
    void choose_multinomial(rddl::Place place, std::int64_t trials,
                            std::span<const double> probabilities, std::span<std::int64_t> counts);

    // The probability of the choices made since the last next().
    double probability() const;

    // False if all combinations have been made.
    bool next();

  private:
    struct Draw {
        rddl::Place place;
        std::size_t part;
        std::vector<double> probabilities;
        std::size_t chosen;
    };
    std::vector<Draw> draws_;  // the first `made_` of this evaluation, the others still to come
    std::size_t made_ = 0;
};

}  // namespace rddlc::ir
