#include "exercise_file.hpp"

#include "engines/load_simulator.hpp"
#include "formats/trace.hpp"
#include "learning/learned_policy.hpp"
#include "learning/learning_curves.hpp"
#include "pictures/trace_renderer.hpp"
#include "rollouts/replay_session.hpp"
#include "scenes/scene.hpp"
#include "solvers/cgp/formula.hpp"
#include "solvers/cgp/policy_file.hpp"
#include "solvers/cgp/skdecide.hpp"
#include "solvers/cgp/trainee.hpp"
#include "solvers/evaluation/episodes.hpp"
#include "solvers/ppo/export.hpp"
#include "solvers/ppo/policy_file.hpp"
#include "solvers/ppo/trainee.hpp"
#include "solvers/ppo/trainer.hpp"
#include "solvers/training/checkpoint_file.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "verify/verified_states.hpp"

#include <render/episode_renderer.hpp>
#include <render/visualizer.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rddlc::fuzzing {

namespace fs = std::filesystem;
namespace render = rddl::render;

namespace {

constexpr const char* scene_example = R"json({
  "about": "all shapes",
  "world": {"left": -1, "bottom": 0.5, "right": "count-cell + 1", "top": 5},
  "shapes": [
    {"shape": "circle", "for": {"?c": "cell"}, "x": "index-cell(?c)",
                     "y" : "depth(?c)",
                     "radius" : 0.25,
                     "outline" : true,
                     "thickness" : 2,
                     "visible" : "lit(?c) | presses > 1"
},
    {"shape": "line", "for": {"?c": "cell", "?d": "cell"}, "x1": "depth(?c)", "y1": 1, "x2": 2, "y2": "depth(?d)",
     "color": {"if": "lit(?c)", "then": "orange", "else": {"scale": "depth(?d)", "low": 0, "high": "LIMIT(?d)"}}},
    {"shape": "rectangle", "left": 0, "bottom": 1, "right": "presses", "top": 1.5e0, "color": "#a0b0c0"},
    {"shape": "cell", "for": {"?c": "cell"}, "column": "index-cell(?c)", "row": 1},
    {"shape": "polygon", "for": {"?c": "cell"}, "points": [[0, 1], ["presses / 2", 2], [1, "index-cell(?c)"]]},
    {"shape": "text", "for": {"?c": "cell"}, "x": 1, "y": 2, "size": 9, "align": "left",
     "text": "\u6c34 {?c}: {depth(?c)} {lit(?c)} {last}"}
  ]
})json";

constexpr const char* trace_example =
    R"({"rddl_trace":1,"rddlc":"0.2.0","problem":"levels","domain":"levels","instance":"levels_1","files":[],"policy":"random","engine":"interpreter","seed":4,"episodes":2,"horizon":6,"discount":1.0}
{"episode":0,"step":0,"state":{"depth___left":1.0,"depth___right":1.0,"lit___left":true,"lit___right":false,"presses":0,"last":"pale"},"action":{"pour___left":0.75,"press___left":true},"reward":1.0,"next_state":{"depth___left":1.5,"depth___right":"inf","lit___left":false,"lit___right":false,"presses":1,"last":"pale"},"observation":null,"terminated":false,"truncated":false,"causes":[]}
{"episode":0,"step":1,"state":{"depth___left":1.5,"depth___right":0.75,"lit___left":false,"presses":1,"last":"pale"},"action":{"paint":"@dark"},"reward":-0.1,"next_state":{"depth___left":1.25,"depth___right":0.5,"last":"dark"},"observation":null,"terminated":false,"truncated":true,"causes":["horizon"]}
{"episode":1,"step":0,"state":{"depth___left":1},"action":{},"reset":false,"reward":"nan","next_state":{"presses":7},"terminated":true,"truncated":false,"causes":["terminated"],"fault":"none"}
)";

solvers::PpoOptions small_ppo() {
    solvers::PpoOptions options;
    options.steps = 16;
    options.environments = 2;
    options.rollout = 4;
    options.minibatch = 8;
    options.epochs = 1;
    options.hidden = {3};
    options.recurrent = 2;
    options.segment = 4;
    return options;
}

solvers::CgpOptions small_cgp() {
    solvers::CgpOptions options;
    options.generations = 2;
    options.children = 2;
    options.nodes = 8;
    options.constants = 2;
    options.episodes = 1;
    options.tune_every = 1;
    options.islands = 2;
    return options;
}

template <class Use>
void each_line(std::string_view text, Use use) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        use(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

}  // namespace

struct FileReaders::State {
    State(const fs::path& problem, const fs::path& plain_problem, fs::path its_folder)
        : folder(std::move(its_folder)),
          loaded(load(problem)),
          simulator(*loaded.simulator),
          plain(load(plain_problem)),
          world(simulator) {
        fs::create_directories(folder);
    }

    static workbench::LoadOptions interpreted() {
        workbench::LoadOptions options;
        options.engine = workbench::Engine::Interpreter;
        options.quiet = true;
        return options;
    }
    static workbench::LoadedProblem load(const fs::path& problem) {
        return workbench::load_problem(
            workbench::find_files(problem.string(), is_folder(problem) ? "1" : ""), interpreted());
    }

    fs::path file(const char* name, std::string_view bytes) const {
        fs::path path = folder / name;
        UsedFiles used;
        write_file(path, bytes, used);
        return path;
    }

    static void play(const rddl_simulator& simulator, const solvers::Policy& policy) {
        solvers::EpisodeOptions options;
        options.episodes = 2;
        options.threads = 1;
        solvers::run_episodes(simulator, policy, options, {});
    }

    // Reads it as `rddl run --policy` and `rddl export` do.
    void read_policy(std::string_view bytes) const {
        const std::string text(bytes);
        const rddl_simulator& of = solvers::is_skdecide_genome(text) ? *plain.simulator : simulator;
        for (const bool random : {false, true})
            play(of, workbench::policy_of_text(of, text, random, 1, "policy"));
        if (!solvers::is_program(text)) {
            const auto model = solvers::read_ppo_policy(of, text);
            const std::string again = solvers::ppo_policy_text(of, *model);
            if (solvers::ppo_policy_text(of, *solvers::read_ppo_policy(of, again)) != again)
                throw std::logic_error("a policy that was written is not read as it was");
            solvers::ppo_policy_cpp(*model);
            solvers::ppo_policy_onnx(*model);
            return;
        }
        const auto found = solvers::read_program(of, text);
        solvers::program_formula(found->scope, found->genome);
        solvers::read_program(of, solvers::program_text(of, found->scope, found->genome));
        if (found->genome.delayed) return;
        const solvers::Formula formula = solvers::simplified(found->genome);
        solvers::formula_cpp(formula, found->scope);
        solvers::formula_dot(formula, found->scope);
        solvers::formula_svg(formula, found->scope);
        solvers::formula_python(formula, found->scope);
        solvers::formula_latex(formula, found->scope);
    }

    solvers::Trainee trainee(bool ppo) const {
        return ppo ? solvers::ppo_trainee(simulator, small_ppo())
                   : solvers::cgp_trainee(simulator, small_cgp());
    }
    static solvers::TrainingOptions training(const fs::path& run) {
        solvers::TrainingOptions options;
        options.folder = run;
        options.evaluations = 2;
        options.evaluation_episodes = 2;
        options.quiet = true;
        return options;
    }
    // Reads it as `rddl train --resume` does. The bytes are not sealed: a fuzzer finds no checksum.
    void read_checkpoint(bool ppo, std::string_view bytes) const {
        const fs::path run = folder / "run";
        fs::create_directories(run);
        file("run/checkpoint", solvers::sealed(bytes));
        solvers::TrainingOptions options = training(run);
        options.resumes = true;
        solvers::train(simulator, trainee(ppo), options);
    }
    std::string checkpoint(bool ppo) const {
        const fs::path run = folder / "begun";
        fs::remove_all(run);
        solvers::train(simulator, trainee(ppo), training(run));
        return solvers::read_sealed(run / "checkpoint", default_memory_limit);
    }

    void draw(const render::Visualizer& visualizer, std::string_view trace) const {
        workbench::PictureOptions options;
        options.width = 200;
        options.height = 120;
        options.quiet = true;
        options.most_frames = 4;
        workbench::Output output;
        output.begin = [](const workbench::Show&) {
        };
        output.add = [](const workbench::Drawn& drawn) {
            if (drawn.in_movie) drawn.renderer.svg();
            return drawn.in_movie;
        };
        output.finish = [] {
        };
        workbench::TraceRenderer renderer(world, visualizer, options, {output}, {}, "trace");
        each_line(trace, [&](std::string_view line) { renderer.add_line(line); });
        renderer.finish();
    }

    // Reads it as `rddl replay`, `rddl run --policy TRACE`, `rddl verify --states` and `rddl
    // render` do.
    void read_trace(std::string_view bytes) {
        constexpr std::size_t longest = 100'000;
        std::optional<Failure> refusal;
        const auto attempt = [&](const std::function<void()>& reader) {
            try {
                reader();
            } catch (const Failure& failure) {
                refusal = failure;
            }
        };
        attempt([&] {
            workbench::ReplaySession session(simulator, {});
            std::size_t written = 0;
            each_line(bytes, [&](std::string_view line) {
                // A line may ask for any number of samples.
                if (written < longest && line.find("repeat") == std::string_view::npos)
                    written += session.answer(line).size();
            });
        });
        const fs::path path = file("trace.jsonl", bytes);
        attempt([&] { play(simulator, workbench::learned_policy(simulator, path, false, 1)); });
        attempt([&] {
            workbench::Record initial(static_cast<std::size_t>(simulator.problem->state_size));
            simulator.initial_state(&simulator, initial.data());
            workbench::read_states(path, *simulator.problem, initial);
        });
        attempt([&] { draw(*render::find_visualizer("auto"), bytes); });
        if (refusal) throw Failure(*refusal);
    }
    void read_scene(std::string_view bytes) const {
        const render::Visualizer visualizer =
            workbench::scene_visualizer(loaded.files, file("scene.json", bytes));
        draw(
            visualizer,
            R"({"action":{"pour___left":1.0},"next_state":{"depth___left":2.5,"lit___right":true}})");
    }

    fs::path folder;
    workbench::LoadedProblem loaded;
    const rddl_simulator& simulator;
    workbench::LoadedProblem plain;
    render::World world;
};

FileReaders::FileReaders(const fs::path& problem, const fs::path& plain, fs::path folder)
    : state_(std::make_unique<State>(problem, plain, std::move(folder))) {}

FileReaders::~FileReaders() = default;

bool FileReaders::read(FileKind kind, std::string_view bytes) {
    try {
        switch (kind) {
            case FileKind::Policy:
                state_->read_policy(bytes);
                break;
            case FileKind::PpoCheckpoint:
            case FileKind::CgpCheckpoint:
                state_->read_checkpoint(kind == FileKind::PpoCheckpoint, bytes);
                break;
            case FileKind::Trace:
                state_->read_trace(bytes);
                break;
            case FileKind::Scene:
                state_->read_scene(bytes);
                break;
            case FileKind::Run:
                state_->file("run.json", bytes);
                workbench::description_of(state_->folder);
                break;
            case FileKind::Curves: {
                state_->file("progress.csv", bytes);
                const workbench::RunProgress run = workbench::read_progress(state_->folder);
                workbench::curve_of("run", {run, run}, run.columns.front(), run.columns.back());
                break;
            }
        }
        return true;
    } catch (const Diagnosed&) {
        return false;
    } catch (const Failure&) {
        return false;
    }
}

std::vector<std::string> FileReaders::examples(FileKind kind) const {
    const auto ppo_policy = [&](auto change) {
        solvers::PpoOptions options = small_ppo();
        options.recurrent = 0;
        change(options);
        return solvers::ppo_policy_text(state_->simulator,
                                        solvers::PpoTrainer(state_->simulator, options).model());
    };
    const auto program = [&](bool skdecide) {
        solvers::CgpOptions options = small_cgp();
        options.skdecide = skdecide;
        if (skdecide) options.constants = solvers::CgpOptions().constants;
        const rddl_simulator& of = skdecide ? *state_->plain.simulator : state_->simulator;
        const solvers::CgpSearch search(of, options);
        return solvers::program_text(of, search.scope(), search.best());
    };
    switch (kind) {
        case FileKind::Policy:
            return {ppo_policy([](solvers::PpoOptions&) {}), ppo_policy([](solvers::PpoOptions& o) {
                        o.recurrent = 2;
                        o.noise = solvers::Noise::Sde;
                        o.squashes = true;
                        o.observations.stack = 2;
                    }),
                    program(false), program(true)};
        case FileKind::PpoCheckpoint:
        case FileKind::CgpCheckpoint:
            return {state_->checkpoint(kind == FileKind::PpoCheckpoint)};
        case FileKind::Trace:
            return {trace_example};
        case FileKind::Scene:
            return {scene_example};
        case FileKind::Run:
            return {R"({"solver": "ppo", "domain": "levels", "instance": "levels_1", "seed": 3})"};
        case FileKind::Curves:
            return {"steps,return,kl\n0,1.5,\n64,-2e-3,0.5\n128,inf,1\n"};
    }
    return {};
}

}  // namespace rddlc::fuzzing
