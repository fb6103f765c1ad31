// The outcomes of a step's draws, one combination after the other, instead of random ones.
#pragma once

#include <rddl/context.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rddlc::ir {

// Evaluations that are given it ask it at each finite draw. They are made again and again, each
// with other choices, until next() says that there are no more: depth first, in the order of the
// draws.
//
//     do { evaluate; use probability(); } while (outcomes.next());
class Outcomes {
  public:
    // An index into the probabilities, of which at least one is positive; what is chosen has a
    // positive one. A draw that is evaluated twice is one draw.
    std::int64_t choose(rddl::Place place, std::vector<double> probabilities);

    // Of the choices made since the last next().
    double probability() const;

    // False if all combinations have been made.
    bool next();

  private:
    struct Draw {
        rddl::Place place;
        std::vector<double> probabilities;
        std::size_t chosen;
    };
    std::vector<Draw> draws_;  // the first `made_` of this evaluation, the others still to come
    std::size_t made_ = 0;
};

}  // namespace rddlc::ir
