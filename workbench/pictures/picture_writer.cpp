#include "pictures/picture_writer.hpp"

#include "pictures/outputs.hpp"
#include "pictures/trace_renderer.hpp"
#include "pictures/watch.hpp"
#include "scenes/scene.hpp"
#include "support/diagnostic.hpp"
#include "support/program.hpp"
#include "support/suggestion.hpp"

#include <fmt/format.h>
#include <render/snapshot.hpp>
#include <render/visualizer.hpp>

#include <cstdint>
#include <deque>
#include <vector>

namespace rddlc::workbench {

namespace render = rddl::render;

namespace {

render::Visualizer choose_visualizer(const PictureOptions& options, const ProblemFiles& files,
                                     const render::World& world) {
    const std::string& name = options.visualizer;
    if (!options.scene.empty() && !name.empty())
        throw Failure("--scene and --visualizer both say how states are drawn", "leave one out",
                      usage_error);
    if (!options.scene.empty()) return scene_visualizer(files, options.scene);
    if (name.empty()) return render::visualizer_for(world);
    const render::Visualizer* const found = render::find_visualizer(name);
    if (!found) {
        std::vector<std::string> names;
        for (const auto* visualizer : render::visualizers()) names.emplace_back(visualizer->name);
        const auto near = did_you_mean(name, names);
        throw Failure(fmt::format("there is no visualizer '{}'", name),
                      near ? hint_of_name(near) : "--visualizer list prints all", usage_error);
    }
    if (const auto missing = render::missing_fluent(*found, world); !missing.empty()) {
        tell(
            "rddl: warning: the visualizer '{}' draws a fluent '{}', which this problem lacks; "
            "it is drawn by 'auto'\n",
            name, missing.substr(0, missing.find('|')));
        return *render::find_visualizer("auto");
    }
    return *found;
}

std::vector<Output> outputs_of(const PictureOptions& options, UsedFiles& used) {
    std::vector<Output> outputs;
    if (!options.gif.empty()) outputs.push_back(gif_output(options, used));
    if (!options.video.empty()) outputs.push_back(video_output(options, used));
    if (!options.png.empty()) outputs.push_back(png_output(options, used));
    if (!options.svg.empty()) outputs.push_back(svg_output(options, used));
    if (!options.html.empty()) outputs.push_back(page_output(options, used));
    return outputs;
}

// Limits the number of pictures in a file by default, not in terminals, where viewers stop when
// they like.
PictureOptions with_usual_limit(PictureOptions options) {
    constexpr std::int64_t usual_most_frames = 1000;
    if (!options.most_frames) options.most_frames = usual_most_frames;
    return options;
}

// A scene is read, so nothing is written over it.
UsedFiles used_files(const LoadedProblem& problem, const PictureOptions& options) {
    UsedFiles used = problem.used;
    if (!options.scene.empty()) used.add(options.scene);
    return used;
}

}  // namespace

struct PictureWriter::State {
    State(const LoadedProblem& problem, const PictureOptions& wanted, const std::string& name)
        : into_files(with_usual_limit(wanted)),
          on_screen(wanted),
          used(used_files(problem, wanted)),
          world(*problem.simulator),
          visualizer(choose_visualizer(wanted, problem.files, world)) {
        if (wanted.any_file())
            renderers.emplace_back(world, visualizer, into_files, outputs_of(wanted, used),
                                   wanted.episode.value_or(0), name);
        if (wanted.watch)
            renderers.emplace_back(world, visualizer, on_screen, std::vector{watch_output(wanted)},
                                   wanted.episode, name);
    }

    PictureOptions into_files, on_screen;
    UsedFiles used;
    render::World world;
    render::Visualizer visualizer;
    std::deque<TraceRenderer> renderers;
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
                             const std::string& name)
    : state_(std::make_unique<State>(problem, options, name)) {}

PictureWriter::~PictureWriter() = default;

void PictureWriter::add_line(std::string_view line) {
    for (TraceRenderer& renderer : state_->renderers) renderer.add_line(line);
}

void PictureWriter::begin_second(const std::string& name) {
    for (TraceRenderer& renderer : state_->renderers) renderer.begin_second(name);
}

std::string PictureWriter::finish() {
    StatesDrawn states;
    for (TraceRenderer& renderer : state_->renderers) {
        const StatesDrawn of_renderer = renderer.finish();
        if (of_renderer.drawn > states.drawn) states = of_renderer;
    }
    const std::string of =
        states.drawn < states.all ? fmt::format(" of {}", states.all) : std::string();
    return fmt::format("{}{} state{} drawn by '{}'", states.drawn, of, states.all == 1 ? "" : "s",
                       state_->visualizer.name);
}

}  // namespace rddlc::workbench
