// Options of learners that train networks.
#pragma once

#include "solvers/network/network.hpp"
#include "solvers/options/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

namespace rddlc::solvers {

template <class Options>
LearnerOption<Options> hidden_option() {
    LearnerOption<Options> option{{"--hidden",
                                   "hidden",
                                   "UNITS,...",
                                   "Layers of the networks (64,64)",
                                   {"net_arch", "fcnet_hiddens"},
                                   true,
                                   true},
                                  {},
                                  {}};
    option.set = [](Options& o, const std::vector<std::string>& words) {
        std::vector<int> hidden;
        for (const std::string& units : words)
            hidden.push_back(number_of_option<int>(units, 1, 1 << 16));
        if (hidden.empty()) throw OptionRefused("a network has one layer or more");
        o.hidden = std::move(hidden);
    };
    option.text = [](const Options& o) {
        return fmt::format("{}", fmt::join(o.hidden, ","));
    };
    return option;
}

template <class Options>
LearnerOption<Options> activation_option() {
    return choice_option<Options, Activation>(
        {"--activation",
         "activation",
         "FUNCTION",
         "Activation of hidden layers: tanh (default), or relu, which is faster",
         {"activation_fn", "fcnet_activation"}},
        [](auto& o) -> auto& { return o.activation; },
        {{"tanh", Activation::Tanh}, {"relu", Activation::Relu}});
}

}  // namespace rddlc::solvers
