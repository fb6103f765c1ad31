#include "planners/planner/planner_policy.hpp"

#include "planners/cem/cem.hpp"
#include "planners/cem/cem_options.hpp"
#include "planners/gradient/gradient.hpp"
#include "planners/gradient/gradient_options.hpp"
#include "planners/planner/beliefs.hpp"
#include "planners/planner/common_options.hpp"
#include "planners/rollout/rollout.hpp"
#include "planners/rollout/rollout_options.hpp"
#include "planners/uct/history_search.hpp"
#include "planners/uct/tree_and_plans.hpp"
#include "planners/uct/uct.hpp"
#include "planners/uct/uct_options.hpp"
#include "solvers/batches/batch.hpp"
#include "solvers/files/fingerprint.hpp"
#include "support/diagnostic.hpp"
#include "support/failure.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace rddlc::planners {

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;  // key and value

// A planner with the options that the user has given.
struct Chosen {
    std::string name;
    CommonOptions common;
    const char* option_for_values;  // NULL: it needs no policy with values
    bool takes_particles;
    std::function<std::unique_ptr<Planner>(const PlannerContext&)> make;
};

struct Entry {
    PlannerText text;
    bool needs_policy = false;
    bool takes_particles = false;  // in place of a state that is hidden
    std::function<Chosen(const Words&)> read;
};

Failure usage(const std::string& message) {
    return Failure(message, {}, usage_error);
}

template <class Options>
void set_option(const std::string& planner, const solvers::OptionTable<Options>& table,
                const std::string& key, const std::string& value, Options& options) {
    const auto found = std::ranges::find(table, key, &PlannerOption<Options>::name);
    if (found == table.end()) {
        const std::vector<solvers::OptionText> known(table.begin(), table.end());
        throw usage(fmt::format("plan:{}: {}", planner,
                                solvers::unknown_option(key, known, solvers::Face::CommandLine)));
    }
    try {
        found->set(options, {value});
    } catch (const solvers::OptionRefused& refused) {
        throw usage(fmt::format("plan:{}: {}: {}", planner, key, refused.what()));
    }
}

template <class ItsPlanner, class Options>
std::unique_ptr<Planner> make_planner(const PlannerContext& context, const Options& options) {
    return std::make_unique<ItsPlanner>(context, options);
}
// Lists of actions and states that are seen are searched by a tree of states, all else by one of
// histories.
template <>
std::unique_ptr<Planner> make_planner<Uct>(const PlannerContext& context,
                                           const UctOptions& options) {
    std::unique_ptr<TreeSearch> tree;
    if (context.sees_state && Uct::can_list_actions(context.simulator, options))
        tree = std::make_unique<Uct>(context, options);
    else
        tree = std::make_unique<HistorySearch>(context, options);
    if (!TreeAndPlans::is_of_use(options)) return tree;
    return std::make_unique<TreeAndPlans>(context, options, std::move(tree));
}

template <class Options, class ItsPlanner>
Entry entry(const std::string& name, const std::string& summary, bool needs_policy,
            bool takes_particles, const solvers::OptionTable<Options>& (*table)()) {
    Entry made{{name, summary, {}}, needs_policy, takes_particles, {}};
    for (const PlannerOption<Options>& option : table()) made.text.options.push_back(option);
    made.read = [name, takes_particles, table](const Words& words) {
        Options options;
        for (const auto& [key, value] : words) set_option(name, table(), key, value, options);
        return Chosen{name, options, options.option_for_values(), takes_particles,
                      [options](const PlannerContext& context) {
                          return make_planner<ItsPlanner>(context, options);
                      }};
    };
    return made;
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = {
        entry<CemOptions, Cem>("cem",
                               "the best of many plans, sampled again and again; for "
                               "reals, ints, bools and objects",
                               false, true, cem_option_table),
        entry<GradientOptions, Gradient>("gradient",
                                         "plans that go up the exact gradient of their return; "
                                         "for reals, ints between bounds and bools",
                                         false, false, gradient_option_table),
        entry<RolloutOptions, Rollout>("rollout",
                                       "each action of a policy improved: others are tried, and "
                                       "the policy plays on",
                                       true, true, rollout_option_table),
        entry<UctOptions, Uct>("uct", "a tree of actions and of what they lead to, built by trials",
                               false, true, uct_option_table),
    };
    return all;
}

// "cem,seconds=0.1" -> "cem", {{"seconds", "0.1"}}
std::pair<std::string, Words> words_of(const std::string& policy) {
    std::vector<std::string> parts =
        solvers::words_of_list(policy.substr(std::string_view(prefix).size()));
    Words words;
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::size_t sign = parts[i].find('=');
        if (sign == std::string::npos)
            throw usage(fmt::format("plan:{}: '{}' is no option: options have the form key=value",
                                    parts.front(), parts[i]));
        const std::string key = parts[i].substr(0, sign);
        if (std::ranges::count(words, key, &Words::value_type::first) > 0)
            throw usage(fmt::format("plan:{}: option '{}' is given twice", parts.front(), key));
        words.emplace_back(key, parts[i].substr(sign + 1));
    }
    return {std::move(parts.front()), std::move(words)};
}

const Entry& entry_named(const std::string& name) {
    std::vector<std::string> known;
    for (const Entry& entry : entries()) {
        if (entry.text.name == name) return entry;
        known.push_back(entry.text.name);
    }
    const auto near = did_you_mean(name, known);
    throw usage(fmt::format(
        "there is no planner '{}'{}", name,
        near ? ending_with_name(near) : fmt::format("; there are {}", fmt::join(known, ", "))));
}

Chosen read_planner(const std::string& name, const Words& words) {
    const Entry& entry = entry_named(name);
    Chosen chosen = entry.read(words);
    if (is_planner(chosen.common.policy))
        throw usage(fmt::format("plan:{}: policy: a planner cannot follow another one", name));
    if (entry.needs_policy && chosen.common.policy.empty())
        throw usage(
            fmt::format("plan:{0} improves a policy: say which one, as in "
                        "plan:{0},policy=random",
                        name));
    if (chosen.option_for_values && chosen.common.policy.empty())
        throw usage(fmt::format(
            "plan:{}: {} needs a policy that estimates values, as in policy=runs/a after 'rddl "
            "train ppo --out runs/a'",
            name, chosen.option_for_values));
    return chosen;
}

void require_values(const Chosen& chosen, const solvers::Policy& policy) {
    if (!chosen.option_for_values || policy.values) return;
    throw Failure(fmt::format("plan:{},{} needs a policy that estimates values, and '{}' does not",
                              chosen.name, chosen.option_for_values, policy.name),
                  "policies of 'rddl train ppo' without --recurrent do, where the problem is "
                  "observed in full");
}

bool sees_state(const rddl_problem& problem, const Chosen& chosen, const PolicySettings& settings) {
    return !problem.partially_observed || chosen.common.cheat || settings.cheat;
}

void require_sight(const rddl_problem& problem, const Chosen& chosen,
                   const PolicySettings& settings) {
    if (chosen.takes_particles || sees_state(problem, chosen, settings)) return;
    throw Failure(
        fmt::format("plan:{} needs the state, which {} ({}) hides from policies", chosen.name,
                    problem.instance, problem.domain),
        fmt::format("let it look at the state with --cheat or plan:{},cheat=yes; in Python, "
                    "with cheat=True",
                    chosen.name));
}

// Plans for the environments of a batch, one after the other.
class PlanningActor {
  public:
    PlanningActor(const rddl_simulator& simulator, const Chosen& chosen,
                  std::optional<solvers::Policy> base, const PolicySettings& settings,
                  std::int64_t environments)
        : simulator_(simulator),
          chosen_(chosen),
          base_(std::move(base)),
          settings_(settings),
          environments_(environments) {}

    void act(solvers::Decision& decision) {
        const rddl_problem& problem = *simulator_.problem;
        if (!planner_)
            planner_ = chosen_.make({simulator_, environments_, decision.horizon,
                                     settings_.memory_limit, base_, settings_.derivatives,
                                     sees_state(problem, chosen_, settings_)});
        const std::int64_t horizon = solvers::steps_of_horizon(problem, decision.horizon);
        if (!sees_state(problem, chosen_, settings_) && !beliefs_) {
            solvers::require_memory(simulator_,
                                    Particles::batches * chosen_.common.particles * environments_,
                                    settings_.memory_limit);
            beliefs_.emplace(simulator_, chosen_.common.particles, environments_, decision.horizon,
                             chosen_.common.seed);
        }
        if (base_) ask_base(decision);
        for (std::size_t i = 0; i < decision.running.size(); ++i) {
            if (!decision.running[i]) continue;
            if (solvers::is_stopped(decision.stops)) return;
            const auto place = static_cast<std::int64_t>(i);
            DecisionPoint point{{decision.batch, place}, place,  decision.episodes[i],
                                decision.steps[i],       no_end, decision.horizon,
                                decision.stops};
            if (horizon > 0) point.left = std::max<std::int64_t>(1, horizon - point.step);
            if (base_)
                point.base_action =
                    base_actions_.data() + i * static_cast<std::size_t>(problem.action_size);
            Explanation explanation{point.episode, point.step};
            if (beliefs_) {
                const Particles& particles = beliefs_->after(decision, i);
                point.origin = {particles.batch(), 0, particles.count()};
                point.history = beliefs_->history(i);
                if (settings_.explain) explanation.particles = particles.distinct();
            }
            std::byte* const action =
                decision.actions + i * static_cast<std::size_t>(problem.action_size);
            planner_->decide(point, action, settings_.explain ? &explanation : nullptr);
            if (beliefs_) beliefs_->note_action(i, action);
            if (settings_.explain) settings_.explain(explanation);
        }
    }

  private:
    // It sees every step, and remembers what it needs of the episode.
    void ask_base(const solvers::Decision& decision) {
        if (!base_actor_) {
            base_actor_ = base_->start(environments_);
            base_actions_.resize(
                static_cast<std::size_t>(environments_ * simulator_.problem->action_size));
            base_violated_.resize(static_cast<std::size_t>(environments_));
        }
        solvers::Decision asked = decision;
        asked.actions = base_actions_.data();
        asked.violated = base_violated_;
        base_actor_(asked);
    }

    const rddl_simulator& simulator_;
    Chosen chosen_;
    std::optional<solvers::Policy> base_;
    PolicySettings settings_;
    std::int64_t environments_;
    std::unique_ptr<Planner> planner_;
    std::optional<Beliefs> beliefs_;  // where the state is hidden
    solvers::Actor base_actor_;
    std::vector<std::byte> base_actions_;
    std::vector<std::int32_t> base_violated_;
};

}  // namespace

const std::vector<PlannerText>& planner_texts() {
    static const std::vector<PlannerText> texts = [] {
        std::vector<PlannerText> all;
        for (const Entry& entry : entries()) all.push_back(entry.text);
        return all;
    }();
    return texts;
}

void require_planner(const std::string& policy) {
    const auto [name, words] = words_of(policy);
    read_planner(name, words);
}

solvers::Policy planner_policy(const rddl_simulator& simulator, const std::string& policy,
                               const PolicySettings& settings) {
    auto [name, words] = words_of(policy);
    // Later options override the seed of the command.
    words.insert(words.begin(), {"seed", std::to_string(settings.seed)});
    const Chosen chosen = read_planner(name, words);
    require_sight(*simulator.problem, chosen, settings);
    std::optional<solvers::Policy> base;
    if (!chosen.common.policy.empty()) {
        base = settings.named(chosen.common.policy);
        require_values(chosen, *base);
    }
    const auto start = [&simulator, chosen, base,
                        settings](std::int64_t environments) -> solvers::Actor {
        const auto actor =
            std::make_shared<PlanningActor>(simulator, chosen, base, settings, environments);
        return [actor](solvers::Decision& decision) {
            actor->act(decision);
        };
    };
    return {policy, solvers::spaces_of(simulator), start, 0, true};
}

}  // namespace rddlc::planners
