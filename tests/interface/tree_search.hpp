// Monte-Carlo tree search against the C interface alone, as a solver's author writes it.
//
// The tree branches over choices of single action values. A node is the sequence of decisions since
// the root; its state is sampled again each time, so that one tree serves all outcomes (open-loop
// search; L. Kocsis and C. Szepesvári, "Bandit based Monte-Carlo Planning", ECML 2006, with the
// random numbers of a rollout as its luck).
#pragma once

#include <rddl/simulator.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

class TreeSearch {
  public:
    // A root of the problem: a state after so many steps.
    TreeSearch(const rddl_simulator* simulator, const void* root, std::int64_t steps)
        : simulator_(*simulator),
          problem_(*simulator->problem),
          choices_(static_cast<std::size_t>(simulator->action_choice_count(simulator))),
          root_(create()),
          future_(create()),
          action_(static_cast<std::size_t>(problem_.action_size) + 1),
          mask_(choices_) {
        check(simulator_.set_state(root_, 0, 1, root, &steps));
        nodes_.push_back(Node(choices_));
    }
    TreeSearch(const TreeSearch&) = delete;
    ~TreeSearch() {
        simulator_.destroy(root_);
        simulator_.destroy(future_);
    }

    // Grows the tree by so many rollouts, each with random numbers of its own.
    void grow(std::uint64_t rollouts) {
        for (std::uint64_t seed = 0; seed < rollouts; ++seed) {
            check(simulator_.copy_environments(future_, 0, 1, root_, nullptr));
            check(simulator_.set_seeds(future_, 0, 1, &seed));
            random_ = seed;
            descend(0);
        }
    }

    // How often each choice was tried in the root, and what it was worth on average.
    struct Verdict {
        std::vector<std::int64_t> visits;
        std::vector<double> values;
    };
    Verdict verdict() const { return {nodes_[0].visits, nodes_[0].values}; }

  private:
    struct Node {
        explicit Node(std::size_t choices) : visits(choices), values(choices), children(choices) {}
        std::vector<std::int64_t> visits;
        std::vector<double> values;
        std::vector<std::size_t> children;  // 0: no child yet
    };

    rddl_batch* create() const {
        rddl_batch* const batch = simulator_.create(&simulator_, nullptr);
        if (batch == nullptr) check(RDDL_OUT_OF_MEMORY);
        return batch;
    }
    void check(rddl_error error) const {
        if (error == RDDL_OK) return;
        std::fprintf(stderr, "error: %s\n", simulator_.last_error(&simulator_));
        std::exit(1);
    }

    // The discounted return from the node's place in the episode under way.
    double descend(std::size_t node) {
        if (is_over()) return 0;
        const std::size_t choice = chosen(nodes_[node]);
        const bool is_known = nodes_[node].visits[choice] > 0;
        double value = step(choice);
        if (is_known && nodes_[node].children[choice] == 0) {
            nodes_[node].children[choice] = nodes_.size();
            nodes_.push_back(Node(choices_));
        }
        value +=
            problem_.discount * (is_known ? descend(nodes_[node].children[choice]) : rollout());
        const std::int64_t visits = ++nodes_[node].visits[choice];
        double& mean = nodes_[node].values[choice];
        mean += (value - mean) / static_cast<double>(visits);
        return value;
    }

    // Upper confidence bounds (UCB1) among the choices that are allowed; untried ones first.
    std::size_t chosen(const Node& node) {
        check(simulator_.action_mask(future_, nullptr, mask_.data()));
        std::int64_t all = 0;
        for (const std::int64_t visits : node.visits) all += visits;
        std::size_t best = 0;
        double best_bound = -INFINITY;
        for (std::size_t k = 0; k < choices_; ++k) {
            if (mask_[k] == 0) continue;
            if (node.visits[k] == 0) return k;
            const double spread =
                std::sqrt(std::log(static_cast<double>(all)) / static_cast<double>(node.visits[k]));
            const double bound = node.values[k] + exploration * spread;
            if (bound > best_bound) best_bound = bound, best = k;
        }
        return best;
    }

    double rollout() {
        double value = 0;
        for (double discount = 1; !is_over(); discount *= problem_.discount)
            value += discount * step(random_choice());
        return value;
    }
    std::size_t random_choice() {
        check(simulator_.action_mask(future_, nullptr, mask_.data()));
        for (int tries = 0; tries < 100; ++tries) {
            random_ = random_ * 6364136223846793005U + 1442695040888963407U;
            const std::size_t choice = (random_ >> 33) % choices_;
            if (mask_[choice] != 0) return choice;
        }
        return 0;
    }

    double step(std::size_t choice) {
        check(simulator_.action_choice(&simulator_, static_cast<std::int64_t>(choice),
                                       action_.data(), nullptr));
        double reward = 0;
        rddl_transition out{};
        out.rewards = &reward;
        check(simulator_.step(future_, action_.data(), &out));
        return reward;
    }
    bool is_over() const {
        std::uint8_t causes = RDDL_RUNNING;
        check(simulator_.get_causes(future_, 0, 1, &causes));
        return causes != RDDL_RUNNING;
    }

    static constexpr double exploration = 3;

    const rddl_simulator& simulator_;
    const rddl_problem& problem_;
    std::size_t choices_;
    rddl_batch *root_, *future_;
    std::vector<std::byte> action_;
    std::vector<std::uint8_t> mask_;
    std::vector<Node> nodes_;
    std::uint64_t random_ = 0;
};
