#include "exact/markov_model.hpp"

#include "exact/step_outcomes.hpp"
#include "support/failure.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/parallel.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace rddlc::workbench {

namespace {

constexpr std::size_t states_at_once = 2048;
constexpr std::size_t share_of_expansions = 4;  // of the memory, its reciprocal

// Where one action leads to from one state, equal states merged.
struct Choice {
    std::uint32_t action = 0;
    double reward = 0;
    std::vector<std::byte> next;  // records
    std::vector<double> probability;

    std::size_t memory() const {
        return next.capacity() + probability.capacity() * sizeof probability[0];
    }
};

std::size_t memory_of(const std::vector<Choice>& choices) {
    std::size_t bytes = 0;
    for (const Choice& choice : choices) bytes += choice.memory();
    return bytes;
}

// The choices of one state.
class Expansion {
  public:
    Expansion(const ir::Interpreter& interpreter, const std::vector<std::byte>& actions,
              const ModelLimits& limits)
        : outcomes_(interpreter),
          state_size_(interpreter.state_size()),
          action_size_(interpreter.action_size()),
          actions_(actions),
          limits_(limits) {}

    void expand(const std::byte* state, std::vector<Choice>& choices) {
        choices.clear();
        find_legal(state);
        // Where no action is legal, one of them is taken nevertheless.
        const bool asks = std::ranges::find(legal_, true) != legal_.end();
        std::size_t bytes = 0;
        for (std::uint32_t a = 0; a < legal_.size(); ++a) {
            if (asks && !legal_[a]) continue;
            choices.emplace_back();
            choices.back().action = a;
            if (!play(state, actions_.data() + a * action_size_, choices.back()))
                choices.pop_back();
            else
                require_memory(bytes += choices.back().memory());
        }
        if (choices.empty())
            throw Failure("in a state that can be reached each action may lead to a fault",
                          "rddl evaluate --policy random shows the fault");
    }

  private:
    void find_legal(const std::byte* state) {
        legal_.resize(action_size_ == 0 ? 1 : actions_.size() / action_size_);
        for (std::size_t a = 0; a < legal_.size(); ++a)
            legal_[a] = outcomes_.is_legal(state, actions_.data() + a * action_size_);
    }

    void require_memory(std::size_t bytes) const {
        if (limits_.memory > 0 && static_cast<std::int64_t>(bytes) > limits_.memory)
            throw Failure("what one step may lead to takes more bytes than it may",
                          "allow more by --memory-limit");
    }

    // False where an outcome faults.
    bool play(const std::byte* state, const std::byte* action, Choice& choice) {
        records_.clear();
        probabilities_.clear();
        bool is_sound = true;
        std::int64_t combinations = 0;
        outcomes_.visit(state, action, 0, [&](const ListedOutcome& outcome) {
            if (++combinations > limits_.outcomes)
                throw Failure(fmt::format("a step has more than {} combinations of what it draws",
                                          limits_.outcomes),
                              "allow more by --max-outcomes");
            if (combinations % 4096 == 0) {
                give_up_if_interrupted("solving");
                require_memory(records_.capacity());
            }
            is_sound = !(outcome.causes & RDDL_FAULTED) && std::isfinite(outcome.reward);
            choice.reward += outcome.probability * outcome.reward;
            if (outcome.causes == RDDL_RUNNING) {
                records_.insert(records_.end(), outcome.next, outcome.next + state_size_);
                probabilities_.push_back(outcome.probability);
            }
            return is_sound;
        });
        if (is_sound) merge(choice);
        return is_sound;
    }

    void merge(Choice& choice) {
        order_.resize(probabilities_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        const auto record = [this](std::uint32_t k) {
            return records_.data() + k * state_size_;
        };
        std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::memcmp(record(a), record(b), state_size_) < 0;
        });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const std::uint32_t k = order_[i];
            if (i > 0 && std::memcmp(record(order_[i - 1]), record(k), state_size_) == 0) {
                choice.probability.back() += probabilities_[k];
                continue;
            }
            choice.next.insert(choice.next.end(), record(k), record(k) + state_size_);
            choice.probability.push_back(probabilities_[k]);
        }
    }

    StepOutcomes outcomes_;
    std::size_t state_size_, action_size_;
    const std::vector<std::byte>& actions_;
    const ModelLimits& limits_;
    std::vector<bool> legal_;  // each action, in the state
    std::vector<std::byte> records_;
    std::vector<double> probabilities_;
    std::vector<std::uint32_t> order_;
};

class Builder {
  public:
    Builder(const ir::Interpreter& interpreter, std::vector<std::byte> actions,
            const ModelLimits& limits)
        : interpreter_(interpreter),
          limits_(limits),
          model_{StateTable(interpreter.state_size()),
                 {},
                 std::move(actions),
                 {0},
                 {},
                 {},
                 {0},
                 {},
                 {},
                 {}},
          expanded_(states_at_once) {}

    MarkovModel build() {
        add_starts();
        model_.within.push_back(model_.states.count());
        StateNumber first = 0;
        for (std::int64_t depth = 0; first < model_.states.count(); ++depth) {
            if (limits_.horizon > 0 && depth >= limits_.horizon) break;
            const StateNumber end = model_.states.count();
            for (; first < end; first += static_cast<StateNumber>(block_)) expand(first, end);
            first = end;
            model_.within.push_back(model_.states.count());
        }
        model_.first_choice.resize(model_.states.count() + std::size_t{1},
                                   model_.first_choice.back());
        return std::move(model_);
    }

  private:
    void add_starts() {
        StepOutcomes outcomes(interpreter_);
        std::int64_t combinations = 0;
        outcomes.visit_starts([&](const ListedOutcome& start) {
            if (++combinations > limits_.outcomes)
                throw Failure(fmt::format("episodes start in more than {} ways", limits_.outcomes),
                              "allow more by --max-outcomes");
            if (start.causes & RDDL_FAULTED) throw Failure("the start of an episode may fault");
            if (start.causes != RDDL_RUNNING) return true;  // over at once
            const StateNumber state = model_.states.add(start.next);
            if (state == model_.starts.size()) model_.starts.push_back({state, 0});
            model_.starts[state].probability += start.probability;
            return true;
        });
    }

    // The states from `first` on, at most `end`: computed side by side, and added one by one.
    void expand(StateNumber first, StateNumber end) {
        block_ = std::min<std::size_t>(room_, end - first);
        bar_.expect(model_.states.count());
        constexpr std::size_t together = 16;
        const std::size_t parts = (block_ + together - 1) / together;
        for_each_in_parallel(parts, limits_.threads, [&](std::size_t part) {
            Expansion expansion(interpreter_, model_.actions, limits_);
            for (std::size_t k = part * together; k < std::min(block_, (part + 1) * together);
                 ++k) {
                expansion.expand(model_.states.record(first + static_cast<StateNumber>(k)),
                                 expanded_[k]);
                bar_.advance();
            }
        });
        find_room();
        for (std::size_t k = 0; k < block_; ++k) add(expanded_[k]);
        require_limits();
    }

    // How many states the next block may have, so that what they lead to fits into memory before
    // it is added to the model. Nothing is known of the first state, and little of the next ones.
    void find_room() {
        for (std::size_t k = 0; k < block_; ++k)
            largest_ = std::max(largest_, memory_of(expanded_[k]));
        room_ = std::min(states_at_once, 2 * room_);
        if (limits_.memory <= 0) return;
        const std::size_t share = static_cast<std::size_t>(limits_.memory) / share_of_expansions;
        room_ = std::clamp<std::size_t>(share / largest_, 1, room_);
    }

    void add(const std::vector<Choice>& choices) {
        for (const Choice& choice : choices) {
            model_.action.push_back(choice.action);
            model_.reward.push_back(choice.reward);
            for (std::size_t k = 0; k < choice.probability.size(); ++k) {
                model_.to.push_back(
                    model_.states.add(choice.next.data() + k * interpreter_.state_size()));
                model_.probability.push_back(choice.probability[k]);
            }
            model_.first_transition.push_back(model_.to.size());
        }
        model_.first_choice.push_back(model_.action.size());
    }

    void require_limits() {
        give_up_if_interrupted("solving");
        const auto count = static_cast<std::int64_t>(model_.states.count());
        if (count > limits_.states)
            throw Failure(fmt::format("more than {} states can be reached", limits_.states),
                          "allow more by --max-states");
        if (limits_.memory > 0 && static_cast<std::int64_t>(model_.memory()) > limits_.memory)
            throw Failure(fmt::format("the {} states reached so far, with {} transitions, take "
                                      "more bytes than they may",
                                      count, model_.to.size()),
                          "allow more by --memory-limit");
    }

    const ir::Interpreter& interpreter_;
    const ModelLimits& limits_;
    MarkovModel model_;
    std::vector<std::vector<Choice>> expanded_;
    std::size_t block_ = 0;
    Progress bar_{"listing states", 1};   // of those that are known by now
    std::size_t room_ = 1, largest_ = 1;  // states of a block, and bytes of what one leads to
};

double values_of(const rddl_problem& problem, const rddl_fluent& fluent, std::int64_t grounding) {
    if (fluent.scalar == RDDL_BOOL) return 2;
    if (fluent.range_type >= 0)
        return static_cast<double>(rddl_type_at(&problem, fluent.range_type)->object_count);
    if (fluent.scalar == RDDL_REAL || !fluent.lower || !fluent.upper) return HUGE_VAL;
    return std::max(1.0, fluent.upper[grounding] - fluent.lower[grounding] + 1);
}

}  // namespace

std::size_t MarkovModel::memory() const {
    const auto bytes = [](const auto& values) {
        return values.capacity() * sizeof(values[0]);
    };
    return states.memory() + bytes(first_choice) + bytes(action) + bytes(reward) +
           bytes(first_transition) + bytes(to) + bytes(probability);
}

MarkovModel markov_model(const ir::Interpreter& interpreter, std::vector<std::byte> actions,
                         const ModelLimits& limits) {
    require_certain_conditions(interpreter.program());
    return Builder(interpreter, std::move(actions), limits).build();
}

double count_of_states(const rddl_problem& problem) {
    double count = 1;
    for (std::int32_t f = 0; f < problem.fluent_count; ++f) {
        const rddl_fluent& fluent = *rddl_fluent_at(&problem, f);
        if (fluent.role != RDDL_STATE) continue;
        for (std::int64_t g = 0; g < fluent.count; ++g) count *= values_of(problem, fluent, g);
    }
    return count;
}

}  // namespace rddlc::workbench
