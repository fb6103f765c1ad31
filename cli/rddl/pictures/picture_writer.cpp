#include "pictures/picture_writer.hpp"

#include "pictures/video.hpp"
#include "support/diagnostic.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>
#include <render/film.hpp>
#include <render/gif.hpp>
#include <render/png.hpp>
#include <render/visualizer.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace rddlc::cli {

namespace fs = std::filesystem;
namespace render = rddl::render;

// How quickly states are shown, and which of them.
struct Pace {
    double frames_per_second;
    std::int64_t stride;  // every so manyth state
};

namespace {

constexpr double usual_frames_per_second = 10;
constexpr std::int64_t usual_most_frames = 1000;
constexpr double last_frame_seconds = 1.5;     // before a movie begins anew
constexpr double most_frames_per_second = 50;  // that players of GIFs keep up with

const render::Visualizer& choose_visualizer(const std::string& name, const render::World& world) {
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
    for (const char* const name : {"DT", "DELTA-T", "TIME-DELTA", "TIME-STEP", "TIME_DELTA", "TAU",
                                   "Ts", "DELTA", "TIMESTEP"}) {
        const rddl_fluent* const fluent = world.find(name);
        if (!fluent || fluent->role != RDDL_NON_FLUENT || fluent->rank != 0) continue;
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

bool is_file_of(const std::string& path, const char* ending) {
    return fs::path(path).extension() == ending;
}

}  // namespace

// A file of one state, or a folder with one for each.
class StillWriter {
  public:
    using Bytes = std::function<std::string()>;

    StillWriter(std::string path, const char* ending, std::optional<std::int64_t> step,
                UsedFiles& used)
        : path_(std::move(path)),
          ending_(ending),
          is_single_(is_file_of(path_, ending)),
          step_(step),
          used_(used) {
        if (is_single_) {
            require_writable(path_, used_);
            return;
        }
        std::error_code error;
        fs::create_directories(path_, error);
        if (error) throw UnwritableFile(path_, error.value());
    }

    void add(std::int64_t step, const Bytes& bytes) {
        if (is_single_) {
            if (step_ && *step_ == step) write(path_, bytes());
            return;
        }
        write(fs::path(path_) / fmt::format("{:06}{}", step, ending_), bytes());
    }
    void end(std::int64_t last_step, const Bytes& bytes) {
        if (is_single_ && !step_) write(path_, bytes());
        if (is_single_ && step_ && !written_)
            throw Failure(
                fmt::format("there is no state {}: the episode has {} steps", *step_, last_step));
    }

  private:
    void write(const fs::path& file, const std::string& bytes) {
        write_file(file, bytes, used_);
        written_ = true;
    }

    std::string path_;
    const char* ending_;
    bool is_single_;
    std::optional<std::int64_t> step_;
    UsedFiles& used_;
    bool written_ = false;
};

struct PictureWriter::State {
    State(const LoadedProblem& problem, const PictureOptions& wanted, std::string trace_name)
        : options(wanted),
          used(problem.used),
          name(std::move(trace_name)),
          world(*problem.simulator),
          visualizer(choose_visualizer(options.visualizer, world)),
          steps(*problem.simulator, options.episode, name) {
        if (!options.gif.empty()) gif_file.emplace(options.gif, used);
        if (!options.png.empty()) png.emplace(options.png, ".png", options.step, used);
        if (!options.svg.empty()) svg.emplace(options.svg, ".svg", options.step, used);
        if (!options.video.empty()) require_writable(options.video, used);
    }

    // When the first state is there, for the horizon is known then.
    void begin() {
        const std::int64_t horizon = steps.horizon();
        pace = choose_pace(options, world, horizon);
        film.emplace(world, visualizer, options.width, options.height, options.episode, horizon);
        if (gif_file)
            gif.emplace(options.width, options.height,
                        [this](std::string_view bytes) { gif_file->write(bytes); });
        if (!options.video.empty())
            video.emplace(options.video, options.width, options.height, pace.frames_per_second,
                          used);
    }

    void add(TraceStep&& step, bool is_last) {
        give_up_if_interrupted();
        if (!film) begin();
        const std::int64_t number = step.number;
        film->add({step.number, std::move(step.state), std::move(step.action), step.reward,
                   step.total, std::move(step.end)});
        const bool in_movie = is_last || (film_states++ % pace.stride == 0);
        const auto png_of_state = [&] {
            return render::png_bytes(film->picture());
        };
        const auto svg_of_state = [&] {
            return film->svg();
        };
        if (in_movie && (gif || video)) {
            const render::Picture& picture = film->picture();
            if (gif) gif->add(picture, is_last ? last_frame_seconds : 1 / pace.frames_per_second);
            if (video) video->add(picture);
            ++pictures;
        }
        if (png && (in_movie || options.step)) png->add(number, png_of_state);
        if (svg && (in_movie || options.step)) svg->add(number, svg_of_state);
        if (!is_last) return;
        if (png) png->end(number, png_of_state);
        if (svg) svg->end(number, svg_of_state);
    }

    PictureOptions options;
    UsedFiles used;
    std::string name;
    render::World world;
    const render::Visualizer& visualizer;
    TraceSteps steps;
    std::optional<TraceStep> pending;  // the last one may turn out to be the end
    Pace pace{};
    std::optional<render::Film> film;
    std::int64_t film_states = 0, pictures = 0;
    std::optional<OutputFile> gif_file;
    std::optional<render::GifWriter> gif;
    std::optional<StillWriter> png, svg;
    std::optional<VideoWriter> video;
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
    State& state = *state_;
    std::optional<TraceStep> step = state.steps.read(line);
    if (!step) return;
    if (state.pending) state.add(std::move(*state.pending), false);
    state.pending = std::move(step);
}

std::string PictureWriter::finish() {
    State& state = *state_;
    if (!state.pending)
        throw Failure(
            fmt::format("'{}' has no step of episode {}", state.name, state.options.episode));
    std::optional<TraceStep> end = state.steps.last();
    state.add(std::move(*state.pending), !end);
    if (end) state.add(std::move(*end), true);
    if (!state.steps.has_ended())
        tell("rddl: warning: episode {} does not end in '{}'; it is drawn as far as it goes\n",
             state.options.episode, state.name);
    if (state.gif) {
        state.gif->finish();
        state.gif_file->finish();
    }
    if (state.video) state.video->finish(state.used);
    return fmt::format("{} states drawn by '{}'", state.film_states + 1, state.visualizer.name);
}

}  // namespace rddlc::cli
