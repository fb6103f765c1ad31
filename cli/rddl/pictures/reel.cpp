#include "pictures/reel.hpp"

#include "pictures/pace.hpp"
#include "support/program.hpp"
#include "terminal/interrupt.hpp"

#include <fmt/format.h>

#include <utility>

namespace rddlc::cli {

namespace render = rddl::render;

Reel::Reel(const render::World& world, const render::Visualizer& visualizer,
           const PictureOptions& options, std::vector<Output> outputs,
           std::optional<std::int64_t> episode, std::string trace)
    : world_(world),
      visualizer_(visualizer),
      options_(options),
      outputs_(std::move(outputs)),
      wanted_(episode),
      trace_(std::move(trace)),
      steps_(std::in_place, world.simulator(), episode, trace_) {}

void Reel::add_line(std::string_view line) {
    std::optional<TraceStep> step = steps_->read(line);
    if (!wanted_ && steps_->is_over()) {
        finish_episode();
        steps_->begin_next();
        step = steps_->read(line);
    }
    if (!step) return;
    if (pending_) draw(std::move(*std::exchange(pending_, std::nullopt)), false);
    // At once, for somebody may be watching.
    if (steps_->has_last())
        draw(std::move(*step), false);
    else
        pending_ = std::move(step);
}

// When the first state is there, for the horizon is known then.
void Reel::begin_episode() {
    const std::int64_t horizon = steps_->horizon();
    const Pace pace = choose_pace(options_, world_, horizon);
    stride_ = pace.stride;
    film_.emplace(world_, visualizer_, options_.width, options_.height, *steps_->episode(),
                  horizon);
    for (const Output& output : outputs_) output.begin({world_, pace, trace_});
}

void Reel::draw(TraceStep&& step, bool is_last) {
    if (is_interrupted()) return;
    if (!film_) begin_episode();
    film_->add({step.number, std::move(step.state), std::move(step.action), step.reward, step.total,
                std::move(step.end)});
    const bool in_movie = is_last || drawn_ % stride_ == 0;
    ++drawn_;
    for (const Output& output : outputs_) output.add({*film_, in_movie, is_last});
}

void Reel::finish_episode() {
    std::optional<TraceStep> end = steps_->last();
    if (pending_) draw(std::move(*std::exchange(pending_, std::nullopt)), !end);
    if (end) draw(std::move(*end), true);
    if (!film_ && !is_interrupted())
        throw Failure(wanted_ ? fmt::format("'{}' has no step of episode {}", trace_, *wanted_)
                              : fmt::format("'{}' has no step", trace_));
    if (!steps_->has_ended())
        tell("rddl: warning: episode {} does not end in '{}'; it is drawn as far as it goes\n",
             steps_->episode().value_or(0), trace_);
    film_.reset();
    states_ += std::exchange(drawn_, 0);
}

void Reel::begin_second(std::string trace) {
    finish_episode();
    trace_ = std::move(trace);
    steps_.emplace(world_.simulator(), wanted_, trace_);
}

std::int64_t Reel::finish() {
    finish_episode();
    for (const Output& output : outputs_) output.finish();
    return states_;
}

}  // namespace rddlc::cli
