#include "native/learners.hpp"

#include "learning/imitation.hpp"
#include "learning/learned_policy.hpp"
#include "native/env_pool.hpp"
#include "native/long_calls.hpp"
#include "native/options.hpp"
#include "native/paths.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/option_table.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/drp/trainee.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/ppo/option_table.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainee.hpp"
#include "support/files.hpp"

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

using workbench::LoadedProblem;
using workbench::Simulator;

// A policy, which acts in one batch at a time.
class Policy {
  public:
    // The policy as it acts in a simulator; throws where it is of other spaces.
    using Make = std::function<solvers::Policy(const rddl_simulator&)>;

    Policy(Simulator simulator, Make make)
        : simulator_(std::move(simulator)), make_(std::move(make)), policy_(make_(*simulator_)) {}

    // Writes the actions of all environments, which are at these steps of their episodes. Those of
    // a new batch, and those at step 0, begin.
    void act(EnvPool& batch, bool begins, const solvers::Stops* stops = nullptr) {
        start(batch, begins);
        for (std::size_t i = 0; i < running_.size(); ++i) {
            std::tie(steps_[i], episodes_[i]) = batch.progress(static_cast<std::int64_t>(i));
            running_[i] = batch.causes(static_cast<std::int64_t>(i)) == RDDL_RUNNING;
        }
        solvers::Decision decision{
            batch.handle(), running_, episodes_, steps_, batch.arrays().actions.data(), violated_};
        decision.horizon = batch.settings().horizon;
        decision.stops = stops;
        actor_(decision);
    }

    // The same, of a policy that takes its time: Ctrl-C ends it.
    void plan(EnvPool& batch, bool begins) {
        plans_.finish();
        const auto stop = std::make_shared<std::atomic<bool>>(false);
        const solvers::Stops stops = [stop] {
            return stop->load();
        };
        plans_.run([this, &batch, begins, stops] { act(batch, begins, &stops); }, {},
                   [stop] { *stop = true; });
    }

    // Actions of the random policy, where the environments stand: others for each number.
    void draw(EnvPool& batch, std::uint32_t number, std::span<std::byte> actions) {
        start(batch, false);
        running_.assign(running_.size(), 1);
        std::iota(episodes_.begin(), episodes_.end(), std::int64_t{0});
        steps_.assign(steps_.size(), number);
        solvers::Decision decision{batch.handle(), running_,       episodes_,
                                   steps_,         actions.data(), violated_};
        actor_(decision);
    }

    // Ctrl-C ends it.
    solvers::Summary evaluate(std::int64_t episodes, std::uint64_t seed, int threads,
                              std::optional<std::int64_t> horizon) const {
        solvers::EpisodeOptions options;
        options.episodes = episodes;
        options.seed = seed;
        options.threads = threads;
        options.horizon = horizon;
        if (episodes < 1)
            throw Refused(fmt::format("an evaluation takes one episode or more, not {}", episodes));
        std::atomic<bool> stops = false;
        solvers::Watch watch;
        watch.stops = [&] {
            return stops.load();
        };
        std::optional<solvers::Summary> summary;
        LongCalls calls(true);  // the last one: it waits for the job, which works with the others
        calls.run([&] { summary = summary_of(run_episodes(*simulator_, policy_, options, watch)); },
                  {}, [&] { stops = true; });
        return *std::move(summary);
    }

  private:
    void start(const EnvPool& batch, bool begins) {
        const bool is_bound = bind(batch);
        const auto count = static_cast<std::size_t>(batch.settings().environments);
        if (!begins && !is_bound && actor_ && running_.size() == count) return;
        actor_ = acting_->start(batch.settings().environments);
        running_.assign(count, 1);
        violated_.assign(count, -1);
        episodes_.assign(count, 0);
        steps_.assign(count, 0);
    }

    // Reads the policy again for the simulator of that batch, of which it also reads non-fluents,
    // unless it acts there already. A policy that does not fit leaves everything as it is.
    bool bind(const EnvPool& batch) {
        if (acting_ && acts_in_ == batch.shared_simulator()) return false;
        const Simulator simulator = batch.shared_simulator();
        solvers::Policy policy = make_(*simulator);
        actor_ = nullptr;
        acting_ = std::move(policy);
        acts_in_ = simulator;
        return true;
    }

    Simulator simulator_;  // that it was learned in; outlives the policy
    Make make_;
    solvers::Policy policy_;
    Simulator acts_in_;  // outlives all that follows
    std::optional<solvers::Policy> acting_;
    solvers::Actor actor_;
    std::vector<std::uint8_t> running_;
    std::vector<std::int64_t> episodes_, steps_;
    std::vector<std::int32_t> violated_;
    LongCalls plans_{true};  // the last one: a decision that goes on works with the others
};

// Whether an update has to end early: the `stops` of a learner's options.
using Stop = std::shared_ptr<std::atomic<bool>>;

std::function<bool()> asks(const Stop& stop) {
    return [stop] {
        return stop->load();
    };
}

// A learner at work.
class Learner {
  public:
    Learner(Simulator simulator, solvers::Trainee trainee, Stop stop)
        : simulator_(std::move(simulator)), trainee_(std::move(trainee)), stop_(std::move(stop)) {}

    bool done() { return trainee().done(); }
    // Imitates what it is to imitate, before the first update, and says what that was; "": nothing.
    // Ctrl-C ends it, and a learner that has been interrupted is of no use.
    std::string prepare() {
        calls_.finish();
        if (!trainee_.prepare) return "";
        *stop_ = false;
        const auto said = std::make_shared<std::string>();
        calls_.run([this, said] { *said = trainee_.prepare(); }, {}, [this] { *stop_ = true; });
        return *said;
    }
    // Ctrl-C ends it early, and leaves what was learned before it.
    void update() {
        calls_.finish();
        *stop_ = false;
        const auto work = [this] {
            const std::string before = trainee_.save();
            trainee_.update();
            if (*stop_) trainee_.load(before);
        };
        calls_.run(work, {}, [this] { *stop_ = true; });
    }
    std::int64_t steps() { return trainee().steps(); }
    std::string policy_text() { return trainee().policy_text(); }
    std::string summary() {
        return trainee().summary ? trainee().summary(trainee().policy_text()) : "";
    }
    nb::dict row() {
        nb::dict row;
        for (const auto& [name, value] : trainee().row()) row[name.c_str()] = value;
        return row;
    }
    nb::bytes save() {
        const std::string bytes = trainee().save();
        return nb::bytes(bytes.data(), bytes.size());
    }
    void load(const nb::bytes& bytes) { trainee().load({bytes.c_str(), bytes.size()}); }

  private:
    const solvers::Trainee& trainee() {
        calls_.finish();
        return trainee_;
    }

    Simulator simulator_;  // outlives the trainee
    solvers::Trainee trainee_;
    Stop stop_;
    LongCalls calls_{true};  // the last one: an update that still runs works with the others
};

// Adds the options that command lines have by other means.
template <class Options>
solvers::OptionTable<Options> with_common(solvers::OptionTable<Options> table) {
    table.push_back(solvers::seed_option<Options>());
    table.push_back(solvers::memory_option<Options>());
    return table;
}
solvers::OptionTable<solvers::PpoOptions> ppo_keywords() {
    return with_common(solvers::ppo_option_table());
}
solvers::OptionTable<solvers::CgpOptions> cgp_keywords() {
    return with_common(solvers::cgp_option_table());
}
solvers::OptionTable<solvers::DrpOptions> drp_keywords() {
    return with_common(solvers::drp_option_table());
}

Learner ppo(const LoadedProblem& problem, const nb::dict& given) {
    solvers::PpoOptions ppo;
    workbench::Imitation imitation;
    std::vector<solvers::OptionText> known;
    set_options(workbench::imitation_option_table(), given, imitation, known);
    set_options(ppo_keywords(), given, ppo, known);
    refuse_unknown(given, known);
    if (!imitation.policy.empty() && ppo.recurrent > 0)
        throw Refused("imitate does not go with recurrent");
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    ppo.stops = asks(stop);
    const nb::gil_scoped_release released;
    const rddl_simulator& simulator = *problem.simulator;
    const solvers::Demonstrate shown =
        workbench::demonstrate(simulator, imitation, ppo.seed, ppo.memory_limit,
                               {.derivatives = problem.derivatives}, ppo.stops, true);
    return {problem.simulator, solvers::ppo_trainee(simulator, ppo, {}, shown), stop};
}

// The options of a learner that takes none but these.
template <class Options>
Options options_of(const nb::dict& given, const solvers::OptionTable<Options>& table) {
    Options options;
    std::vector<solvers::OptionText> known;
    set_options(table, given, options, known);
    refuse_unknown(given, known);
    return options;
}

Learner cgp(const LoadedProblem& problem, const nb::dict& given) {
    solvers::CgpOptions cgp = options_of(given, cgp_keywords());
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    cgp.stops = asks(stop);
    const nb::gil_scoped_release released;
    return {problem.simulator, solvers::cgp_trainee(*problem.simulator, cgp), stop};
}

Learner drp(const LoadedProblem& problem, const nb::dict& given) {
    solvers::DrpOptions drp = options_of(given, drp_keywords());
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    drp.stops = asks(stop);
    const nb::gil_scoped_release released;
    return {problem.simulator, solvers::drp_trainee(*problem.simulator, drp, problem.derivatives),
            stop};
}

Policy policy_of_text(const LoadedProblem& problem, const std::string& text, bool random,
                      std::uint64_t seed) {
    return {problem.simulator, [text, random, seed](const rddl_simulator& simulator) {
                return workbench::policy_of_text(simulator, text, random, seed, "learned");
            }};
}

// A policy as `rddl evaluate --policy` takes it; planners have the seed of their text, or 0.
Policy policy_named(const LoadedProblem& problem, const std::string& name) {
    workbench::PlannerSettings planning;
    planning.derivatives = problem.derivatives;
    return {problem.simulator, [name, planning](const rddl_simulator& simulator) {
                return workbench::policy_named(simulator, name, false, 0, default_memory_limit,
                                               planning);
            }};
}

std::string planner_options(const std::string& name) {
    std::string text;
    for (const planners::PlannerText& planner : planners::planner_texts())
        if (planner.name == name)
            for (const solvers::OptionText& option : planner.options)
                text += fmt::format("    {}: {}\n", option.keyword, option.help);
    return text;
}

std::string formula_of_text(const LoadedProblem& problem, const std::string& text) {
    const auto found = solvers::read_program(*problem.simulator, text);
    return solvers::program_formula(found->scope, found->genome);
}

nb::bytes policy_of_file(const nb::object& path) {
    const std::string text = workbench::policy_text(path_of(path));
    return nb::bytes(text.data(), text.size());
}

std::string solver_of_text(const std::string& text) {
    return solvers::is_program(text) ? "cgp" : solvers::solver_of_network(text);
}

void write_policy(const nb::object& path, const std::string& text) {
    UsedFiles used;
    write_file(path_of(path), text, used);
}

nb::dict summary_dict(const solvers::Summary& summary) {
    const auto estimate = [](const solvers::Estimate& of) {
        nb::dict all;
        all["mean"] = of.mean;
        all["deviation"] = of.deviation;
        all["minimum"] = of.minimum;
        all["maximum"] = of.maximum;
        all["half_width"] = of.half_width;
        return all;
    };
    nb::dict all;
    all["episodes"] = summary.episodes;
    all["return"] = estimate(summary.undiscounted_return);
    all["discounted_return"] = estimate(summary.discounted_return);
    all["length"] = estimate(summary.length);
    all["terminated"] = summary.terminated;
    all["faulted"] = summary.faulted;
    return all;
}

}  // namespace

void add_learners(nb::module_& module) {
    nb::class_<Policy>(module, "Policy", "Chooses actions in a batch.")
        .def(
            "act", [](Policy& policy, EnvPool& batch, bool begins) { policy.act(batch, begins); },
            nb::arg("batch"), nb::arg("begins"))
        .def("plan", &Policy::plan, nb::arg("batch"), nb::arg("begins"))
        .def(
            "draw",
            [](Policy& policy, EnvPool& batch, std::uint32_t number,
               nb::ndarray<std::uint8_t, nb::ndim<2>, nb::c_contig> actions) {
                const std::span bytes(actions.data(), actions.size());
                if (bytes.size() != batch.arrays().actions.size())
                    throw Refused("there is a record for each environment");
                policy.draw(batch, number, std::as_writable_bytes(bytes));
            },
            nb::arg("batch"), nb::arg("number"), nb::arg("actions"))
        .def(
            "evaluate",
            [](const Policy& policy, std::int64_t episodes, std::uint64_t seed, int threads,
               std::optional<std::int64_t> horizon) {
                return summary_dict(policy.evaluate(episodes, seed, threads, horizon));
            },
            nb::arg("episodes"), nb::arg("seed"), nb::arg("threads"),
            nb::arg("horizon").none() = nb::none());
    nb::class_<Learner>(module, "Learner", "A learner at work.")
        .def_prop_ro("done", &Learner::done)
        .def_prop_ro("steps", &Learner::steps)
        .def("prepare", &Learner::prepare)
        .def("update", &Learner::update)
        .def("row", &Learner::row)
        .def("policy_text", &Learner::policy_text)
        .def("summary", &Learner::summary)
        .def("save", &Learner::save)
        .def("load", &Learner::load);
    module.def("ppo", ppo, nb::arg("simulator"), nb::arg("options"));
    module.def("cgp", cgp, nb::arg("simulator"), nb::arg("options"));
    module.def("drp", drp, nb::arg("simulator"), nb::arg("options"));
    module.def("ppo_options", [] {
        return options_help(workbench::imitation_option_table()) + options_help(ppo_keywords());
    });
    module.def("cgp_options", [] { return options_help(cgp_keywords()); });
    module.def("drp_options", [] { return options_help(drp_keywords()); });
    module.def("policy_named", policy_named, nb::arg("simulator"), nb::arg("name"));
    module.def("planner_options", planner_options, nb::arg("name"));
    module.def("formula_of_text", formula_of_text, nb::arg("simulator"), nb::arg("text"));
    module.def("policy_of_file", policy_of_file, nb::arg("path"),
               "What a policy file holds, or that of the folder of a run.");
    module.def("solver_of_text", solver_of_text, nb::arg("text"),
               "\"ppo\", \"cgp\" or \"drp\": what has learned the policy of a file's text.");
    module.def("write_file", write_policy, nb::arg("path"), nb::arg("text"));
    module.def("policy_of_text", policy_of_text, nb::arg("simulator"), nb::arg("text"),
               nb::arg("random"), nb::arg("seed"));
}

}  // namespace rddlc::python
