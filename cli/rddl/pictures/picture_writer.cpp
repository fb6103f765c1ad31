#include "pictures/picture_writer.hpp"

#include "pictures/outputs.hpp"
#include "pictures/watch.hpp"
#include "scenes/scene.hpp"
#include "support/diagnostic.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <render/film.hpp>
#include <render/visualizer.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rddlc::cli {

namespace render = rddl::render;

namespace {

constexpr double usual_frames_per_second = 10;
constexpr std::int64_t usual_most_frames = 1000;
constexpr double most_frames_per_second = 50;  // that players of GIFs keep up with

render::Visualizer choose_visualizer(const PictureOptions& options, const ProblemFiles& files,
                                     const render::World& world) {
    if (!options.scene.empty()) return scene_visualizer(files, options.scene);
    const std::string& name = options.visualizer;
    if (name.empty()) return render::visualizer_for(world);
    const render::Visualizer* const found = render::find_visualizer(name);
    if (!found) {
        std::vector<std::string> names;
        for (const auto* visualizer : render::visualizers()) names.emplace_back(visualizer->name);
        const auto near = did_you_mean(name, names);
        throw Failure(
            fmt::format("there is no visualizer '{}'", name),
            near ? fmt::format("did you mean '{}'?", *near) : "--visualizer list prints all",
            usage_error);
    }
    if (const auto missing = render::missing_fluent(*found, world); !missing.empty()) {
        tell(
            "rddl: warning: the visualizer '{}' draws a fluent '{}', which this problem has not; "
            "it is drawn by 'auto'\n",
            name, missing);
        return *render::find_visualizer("auto");
    }
    return *found;
}

// How long a step is in the problem's own time: by the names that problems use for it.
double seconds_per_step(const render::World& world) {
    const rddl_fluent* const fluent =
        world.find("DT|DELTA-T|TIME-DELTA|TIME-STEP|TIME_DELTA|TAU|Ts|DELTA|TIMESTEP");
    if (fluent && fluent->role == RDDL_NON_FLUENT && fluent->rank == 0) {
        const double seconds = world.constant(*fluent).numbers.at(0);
        if (seconds > 0 && std::isfinite(seconds)) return seconds;
    }
    throw Failure("this problem does not tell how long a step is, which --real-time-factor needs",
                  "say --fps N", usage_error);
}

Pace choose_pace(const PictureOptions& options, const render::World& world, std::int64_t horizon) {
    double rate = options.frames_per_second.value_or(usual_frames_per_second);
    if (options.real_time_factor) rate = *options.real_time_factor / seconds_per_step(world);
    std::int64_t stride = 1;
    const std::int64_t most = options.most_frames.value_or(usual_most_frames);
    if (horizon + 1 > most) stride = (horizon + most) / most;
    stride = std::max(stride, static_cast<std::int64_t>(std::ceil(rate / most_frames_per_second)));
    return {std::max(rate / static_cast<double>(stride), 0.01), stride};
}

std::vector<Output> outputs_of(const PictureOptions& options, UsedFiles& used) {
    std::vector<Output> outputs;
    if (!options.gif.empty()) outputs.push_back(gif_output(options, used));
    if (!options.video.empty()) outputs.push_back(video_output(options, used));
    if (!options.png.empty()) outputs.push_back(png_output(options, used));
    if (!options.svg.empty()) outputs.push_back(svg_output(options, used));
    if (!options.html.empty()) outputs.push_back(page_output(options, used));
    if (options.watch) outputs.push_back(watch_output(options));
    return outputs;
}

// A scene is read, so nothing is written over it.
UsedFiles used_files(const LoadedProblem& problem, const PictureOptions& options) {
    UsedFiles used = problem.used;
    if (!options.scene.empty()) used.add(options.scene);
    return used;
}

}  // namespace

// An episode that is being drawn.
struct Episode {
    Episode(const rddl_simulator& simulator, std::int64_t number, std::string trace)
        : name(std::move(trace)), steps(simulator, number, name) {}

    std::string name;
    TraceSteps steps;
    std::optional<TraceStep> pending;  // the last one may turn out to be the end
    std::optional<render::Film> film;
    std::int64_t stride = 1, states = 0;
};

struct PictureWriter::State {
    State(const LoadedProblem& problem, const PictureOptions& wanted, std::string name)
        : options(wanted),
          used(used_files(problem, wanted)),
          world(*problem.simulator),
          visualizer(choose_visualizer(options, problem.files, world)),
          outputs(outputs_of(options, used)) {
        episode.emplace(*problem.simulator, options.episode, std::move(name));
    }

    // When the first state is there, for the horizon is known then.
    void begin() {
        const std::int64_t horizon = episode->steps.horizon();
        const Show show{world, choose_pace(options, world, horizon), episode->name};
        episode->stride = show.pace.stride;
        episode->film.emplace(world, visualizer, options.width, options.height, options.episode,
                              horizon);
        for (const Output& output : outputs) output.begin(show);
    }

    void draw(TraceStep&& step, bool is_last) {
        give_up_if_interrupted();
        if (!episode->film) begin();
        episode->film->add({step.number, std::move(step.state), std::move(step.action), step.reward,
                            step.total, std::move(step.end)});
        const bool in_movie = is_last || episode->states % episode->stride == 0;
        ++episode->states;
        for (const Output& output : outputs) output.add({*episode->film, in_movie, is_last});
    }

    void finish_episode() {
        if (!episode->pending)
            throw Failure(
                fmt::format("'{}' has no step of episode {}", episode->name, options.episode));
        std::optional<TraceStep> end = episode->steps.last();
        draw(std::move(*episode->pending), !end);
        if (end) draw(std::move(*end), true);
        if (!episode->steps.has_ended())
            tell("rddl: warning: episode {} does not end in '{}'; it is drawn as far as it goes\n",
                 options.episode, episode->name);
        states += episode->states;
    }

    PictureOptions options;
    UsedFiles used;
    render::World world;
    render::Visualizer visualizer;
    std::vector<Output> outputs;
    std::optional<Episode> episode;
    std::int64_t states = 0;
};

bool can_draw() {
    return true;
}

void require_pictures() {}

std::string visualizer_list() {
    std::string text;
    for (const render::Visualizer* const visualizer : render::visualizers())
        text += fmt::format("{:<18}{}\n", visualizer->name, visualizer->summary);
    return text;
}

PictureWriter::PictureWriter(const LoadedProblem& problem, const PictureOptions& options,
                             std::string name)
    : state_(std::make_unique<State>(problem, options, std::move(name))) {}

PictureWriter::~PictureWriter() = default;

void PictureWriter::add_line(std::string_view line) {
    std::optional<TraceStep> step = state_->episode->steps.read(line);
    if (!step) return;
    std::optional<TraceStep>& pending = state_->episode->pending;
    if (pending) state_->draw(std::move(*pending), false);
    pending = std::move(step);
}

void PictureWriter::begin_second(std::string name) {
    state_->finish_episode();
    state_->episode.emplace(state_->world.simulator(), state_->options.episode, std::move(name));
}

std::string PictureWriter::finish() {
    state_->finish_episode();
    for (const Output& output : state_->outputs) output.finish();
    return fmt::format("{} states drawn by '{}'", state_->states, state_->visualizer.name);
}

}  // namespace rddlc::cli
