#include "pictures/trace_renderer.hpp"

#include "pictures/pace.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/progress.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace rddlc::workbench {

namespace render = rddl::render;

TraceRenderer::TraceRenderer(const render::World& world, const render::Visualizer& visualizer,
                             const PictureOptions& options, std::vector<Output> outputs,
                             std::optional<std::int64_t> episode, std::string trace)
    : world_(world),
      visualizer_(visualizer),
      options_(options),
      outputs_(std::move(outputs)),
      wanted_(episode),
      trace_(std::move(trace)),
      steps_(std::in_place, world.simulator(), episode, trace_) {}

void TraceRenderer::add_line(std::string_view line) {
    std::optional<TraceStep> step = steps_->read(line);
    if (!wanted_ && steps_->is_over()) {
        finish_episode();
        steps_->begin_next();
        step = steps_->read(line);
    }
    if (!step) return;
    if (pending_) take(std::move(*std::exchange(pending_, std::nullopt)), false);
    // The state is shown at once, since a user may be watching.
    if (steps_->has_last())
        take(std::move(*step), false);
    else
        pending_ = std::move(step);
}

// A header's horizon may be wrong or absent: files wait for the episode's end. Terminals do not.
void TraceRenderer::take(TraceStep&& step, bool is_last) {
    if (!wanted_ || !options_.most_frames) return draw(std::move(step), is_last);
    held_.push_back(std::move(step));
    if (!is_last) return;
    begin_episode(static_cast<std::int64_t>(held_.size()) - 1);
    Progress progress("drawing", static_cast<std::int64_t>(held_.size()),
                      !options_.quiet && !options_.watch);
    for (std::size_t i = 0; i < held_.size(); ++i) {
        draw(std::move(held_[i]), i + 1 == held_.size());
        progress.advance();
    }
    held_.clear();
}

// When the first state is there, for the horizon is known then. An episode has `length` steps, so
// far as is known.
void TraceRenderer::begin_episode(std::int64_t length) {
    pace_ = choose_pace(options_, world_, length);
    renderer_.emplace(world_, visualizer_, options_.width, options_.height, *steps_->episode(),
                      steps_->horizon());
    const std::string name = steps_->course().empty() || steps_->course() == trace_
                                 ? trace_
                                 : fmt::format("{} ({})", trace_, steps_->course());
    for (const Output& output : outputs_) output.begin({world_, pace_, name});
}

void TraceRenderer::draw(TraceStep&& step, bool is_last) {
    if (is_interrupted()) return;
    if (!renderer_) begin_episode(steps_->horizon());
    renderer_->add({step.number, std::move(step.state), std::move(step.action), step.reward,
                    step.total, std::move(step.end)});
    const bool has_room = !options_.most_frames || in_movie_ + 1 < *options_.most_frames;
    const bool in_movie = is_last || (has_room && pace_.shows(added_));
    ++added_;
    in_movie_ += in_movie;
    bool is_drawn = false;
    for (const Output& output : outputs_)
        if (output.add({*renderer_, in_movie, is_last})) is_drawn = true;
    states_.drawn += is_drawn;
}

void TraceRenderer::finish_episode() {
    std::optional<TraceStep> end = steps_->last();
    if (pending_) take(std::move(*std::exchange(pending_, std::nullopt)), !end);
    if (end) take(std::move(*end), true);
    give_up_if_interrupted("drawing");
    if (!renderer_)
        throw Failure(wanted_ ? fmt::format("'{}' has no step of episode {}", trace_, *wanted_)
                              : fmt::format("'{}' has no step", trace_));
    if (!steps_->has_ended())
        tell("rddl: warning: episode {} does not end in '{}'; it is drawn as far as it goes\n",
             steps_->episode().value_or(0), trace_);
    renderer_.reset();
    states_.all += std::exchange(added_, 0);
    in_movie_ = 0;
}

void TraceRenderer::begin_second(std::string trace) {
    finish_episode();
    trace_ = std::move(trace);
    steps_.emplace(world_.simulator(), wanted_, trace_);
}

StatesDrawn TraceRenderer::finish() {
    finish_episode();
    for (const Output& output : outputs_) output.finish();
    return states_;
}

}  // namespace rddlc::workbench
