#include "native/learners.hpp"

#include "learning/learned_policy.hpp"
#include "native/batch.hpp"
#include "native/long_calls.hpp"
#include "native/options.hpp"
#include "native/paths.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/evaluation/summary.hpp"
#include "solvers/ppo/trainee.hpp"
#include "support/files.hpp"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

using cli::LoadedProblem;
using cli::Simulator;

// A policy, which acts in one batch at a time.
class Policy {
  public:
    Policy(Simulator simulator, solvers::Policy policy)
        : simulator_(std::move(simulator)), policy_(std::move(policy)) {}

    // Writes the actions of all environments, which are at these steps of their episodes. Those of
    // a new batch, and those at step 0, begin.
    void act(Batch& batch, bool begins) {
        const auto count = static_cast<std::size_t>(batch.settings().environments);
        if (begins || !actor_ || running_.size() != count) {
            actor_ = policy_.start(batch.settings().environments);
            running_.assign(count, 1);
            violated_.assign(count, -1);
            episodes_.assign(count, 0);
            steps_.assign(count, 0);
        }
        for (std::size_t i = 0; i < count; ++i) {
            std::tie(steps_[i], episodes_[i]) = batch.progress(static_cast<std::int64_t>(i));
            running_[i] = batch.causes(static_cast<std::int64_t>(i)) == RDDL_RUNNING;
        }
        solvers::Decision decision{
            batch.handle(), running_, episodes_, steps_, batch.arrays().actions.data(), violated_};
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
    Simulator simulator_;  // outlives the policy
    solvers::Policy policy_;
    solvers::Actor actor_;
    std::vector<std::uint8_t> running_;
    std::vector<std::int64_t> episodes_, steps_;
    std::vector<std::int32_t> violated_;
};

// Whether an update shall end early: what a learner's options ask.
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
    // Ctrl-C ends it early, and leaves what has been learned by then.
    void update() {
        calls_.finish();
        *stop_ = false;
        calls_.run([this] { trainee_.update(); }, {}, [this] { *stop_ = true; });
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
    LongCalls calls_{true};  // the last one: an update that goes on works with the others
};

Learner ppo(const LoadedProblem& problem, const std::string& preset, const nb::dict& given) {
    const auto known = solvers::preset(preset);
    if (!known) throw Refused(fmt::format("there is no preset '{}': fast, sb3, rllib", preset));
    solvers::PpoOptions ppo = *known;
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    ppo.stops = asks(stop);
    Options options(given);
    options.take("steps", ppo.steps);
    options.take("environments", ppo.environments);
    options.take("rollout", ppo.rollout);
    options.take("epochs", ppo.epochs);
    options.take("minibatch", ppo.minibatch);
    options.take("learning_rate", ppo.learning_rate);
    options.take("schedule", ppo.schedule,
                 {{"linear", solvers::LearningRate::Linear},
                  {"constant", solvers::LearningRate::Constant},
                  {"kl", solvers::LearningRate::Kl}});
    options.take("gamma", ppo.gamma);
    options.take("gae_lambda", ppo.lambda);
    options.take("clip", ppo.clip);
    options.take("value_weight", ppo.value_weight);
    options.take("gradient_norm", ppo.gradient_norm);
    options.take("hidden", ppo.hidden);
    options.take("activation", ppo.activation,
                 {{"tanh", solvers::Activation::Tanh}, {"relu", solvers::Activation::Relu}});
    options.take("stack", ppo.observations.stack);
    options.take("recurrent", ppo.recurrent);
    options.take("segment", ppo.segment);
    options.take("seed", ppo.seed);
    options.take("threads", ppo.threads);
    options.finish();
    const nb::gil_scoped_release released;
    return {problem.simulator, solvers::ppo_trainee(*problem.simulator, ppo), stop};
}

Learner cgp(const LoadedProblem& problem, const nb::dict& given) {
    solvers::CgpOptions cgp;
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    cgp.stops = asks(stop);
    std::vector<std::string> functions;
    Options options(given);
    options.take("generations", cgp.generations);
    options.take("children", cgp.children);
    options.take("nodes", cgp.nodes);
    options.take("constants", cgp.constants);
    options.take("functions", functions);
    options.take("episodes", cgp.episodes);
    options.take("measure", cgp.measure,
                 {{"mean", solvers::Measure::Mean},
                  {"median", solvers::Measure::Median},
                  {"min", solvers::Measure::Minimum},
                  {"cvar", solvers::Measure::WorstFifth}});
    options.take("restart_after", cgp.restart_after);
    options.take("tune_every", cgp.tune_every);
    options.take("islands", cgp.islands);
    options.take("threads", cgp.threads);
    options.take("time", cgp.time);
    options.take("compat", cgp.skdecide, {{"none", false}, {"skdecide", true}});
    options.take("seed", cgp.seed);
    options.finish();
    if (!functions.empty()) cgp.functions = solvers::functions_named(functions);
    const nb::gil_scoped_release released;
    return {problem.simulator, solvers::cgp_trainee(*problem.simulator, cgp), stop};
}

Policy policy_of_text(const LoadedProblem& problem, const std::string& text, bool random,
                      std::uint64_t seed) {
    return {problem.simulator,
            cli::policy_of_text(*problem.simulator, text, random, seed, "learned")};
}

std::string formula_of_text(const LoadedProblem& problem, const std::string& text) {
    const auto found = solvers::read_program(*problem.simulator, text);
    return solvers::program_formula(found->scope, found->genome);
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
    nb::class_<Policy>(module, "Policy", "What chooses actions in a batch.")
        .def("act", &Policy::act, nb::arg("batch"), nb::arg("begins"))
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
        .def("update", &Learner::update)
        .def("row", &Learner::row)
        .def("policy_text", &Learner::policy_text)
        .def("summary", &Learner::summary)
        .def("save", &Learner::save)
        .def("load", &Learner::load);
    module.def("ppo", ppo, nb::arg("simulator"), nb::arg("preset"), nb::arg("options"));
    module.def("cgp", cgp, nb::arg("simulator"), nb::arg("options"));
    module.def("formula_of_text", formula_of_text, nb::arg("simulator"), nb::arg("text"));
    module.def("write_file", write_policy, nb::arg("path"), nb::arg("text"));
    module.def("policy_of_text", policy_of_text, nb::arg("simulator"), nb::arg("text"),
               nb::arg("random"), nb::arg("seed"));
}

}  // namespace rddlc::python
