// The options of deep reactive policies by gradients.
#pragma once

#include "solvers/gradients/step_derivatives.hpp"
#include "solvers/network/network.hpp"
#include "solvers/options/options.hpp"
#include "solvers/spaces/observations.hpp"
#include "support/memory.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rddlc::solvers {

struct DrpOptions {
    std::int64_t steps = 5'000'000;       // of all episodes together
    int episodes = 8;                     // of a gradient
    std::optional<std::int64_t> horizon;  // steps of an episode; absent: the instance's
    double learning_rate = 3e-3;
    double clip = 3;  // a gradient is at most so many times as long as the mean of those before
    Relaxation::Mode relaxation = Relaxation::Mode::Soft;
    double sharpness = 10;  // of sigmoids in place of comparisons
    std::vector<int> hidden = {64, 64};
    Activation activation = Activation::Tanh;
    ObservationOptions observations;  // one at a time
    std::uint64_t seed = 0;
    std::int64_t memory_limit = default_memory_limit;  // bytes
    // Called often: whether an update shall end early. May be empty.
    std::function<bool()> stops;
};

const OptionTable<DrpOptions>& drp_option_table();

}  // namespace rddlc::solvers
