#include "studio/drawing.hpp"

#include "formats/trace.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <render/episode_renderer.hpp>
#include <render/png.hpp>
#include <render/visualizer.hpp>

#include <algorithm>

namespace rddlc::studio {

namespace render = rddl::render;

namespace {

// "horizon" of ["horizon"].
std::string end_text(std::uint8_t causes) {
    if (causes == RDDL_RUNNING) return "";
    std::string text = workbench::causes_json(causes);
    std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == '"'; });
    return text;
}

render::Step step_of(const Moment& moment, std::size_t number) {
    return {static_cast<std::int64_t>(number),
            moment.state,
            moment.action,
            moment.reward,
            moment.total,
            end_text(moment.causes)};
}

Moment without_snapshot(const Moment& moment) {
    Moment copy;
    copy.state = moment.state;
    copy.causes = moment.causes;
    copy.total = moment.total;
    copy.action = moment.action;
    copy.reward = moment.reward;
    return copy;
}

}  // namespace

std::vector<std::string> visualizers_for(const rddl_simulator& simulator) {
    const render::World world(simulator);
    const render::Visualizer& best = render::visualizer_for(world);
    std::vector<std::string> names{std::string(best.name)};
    for (const render::Visualizer* const each : render::visualizers()) {
        const bool is_for_all = each->domains.empty() && each->name != best.name;
        if (is_for_all && render::missing_fluent(*each, world).empty())
            names.emplace_back(each->name);
    }
    return names;
}

DrawnMoments drawn_moments(const SteppedEpisode& episode, std::size_t moment) {
    const std::vector<Moment>& moments = episode.moments();
    if (moment >= moments.size()) throw Failure(fmt::format("the episode has no step {}", moment));
    DrawnMoments drawn{moment - std::min(moment, render::most_steps_remembered - 1), {}};
    for (std::size_t k = drawn.first; k <= moment; ++k)
        drawn.moments.push_back(without_snapshot(moments[k]));
    return drawn;
}

std::string picture_of(const SteppedEpisode& episode, const DrawnMoments& drawn,
                       const std::string& visualizer, PictureSize size) {
    const render::World world(episode.simulator());
    const render::Visualizer* const chosen = render::find_visualizer(visualizer);
    if (!chosen) throw Failure(fmt::format("there is no visualizer '{}'", visualizer));
    try {
        render::EpisodeRenderer renderer(
            world, *chosen, size.width, size.height, episode.number(),
            solvers::steps_of_horizon(episode.problem(), episode.horizon()));
        for (std::size_t k = 0; k < drawn.moments.size(); ++k)
            renderer.add(step_of(drawn.moments[k], drawn.first + k));
        return render::small_png_bytes(renderer.picture());
    } catch (const render::Error& error) {
        throw Failure(error.what());
    }
}

}  // namespace rddlc::studio
