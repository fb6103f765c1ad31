// An episode of a trace after the other, drawn into outputs as its lines come.
#pragma once

#include "formats/trace_steps.hpp"
#include "pictures/outputs.hpp"

#include <render/episode_renderer.hpp>
#include <render/visualizer.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct StatesDrawn {
    std::int64_t drawn = 0;  // by one of the outputs, or more
    std::int64_t all = 0;
};

class TraceRenderer {
  public:
    // World and visualizer must outlive it. `trace` is the name of the trace in messages. Draws the
    // episode with that number; without one, each that comes.
    TraceRenderer(const rddl::render::World& world, const rddl::render::Visualizer& visualizer,
                  const PictureOptions& options, std::vector<Output> outputs,
                  std::optional<std::int64_t> episode, std::string trace);

    // Throws a Failure, as do the functions below, and stops drawing on an interrupt.
    void add_line(std::string_view line);
    // The lines that follow are of another trace of the same problem.
    void begin_second(std::string trace);
    // The files have their names from here on.
    StatesDrawn finish();

  private:
    void take(TraceStep&& step, bool is_last);
    void begin_episode(std::int64_t length);
    void draw(TraceStep&& step, bool is_last);
    void finish_episode();

    const rddl::render::World& world_;
    const rddl::render::Visualizer& visualizer_;
    const PictureOptions& options_;
    std::vector<Output> outputs_;
    std::optional<std::int64_t> wanted_;
    std::string trace_;
    std::optional<TraceSteps> steps_;
    std::optional<TraceStep> pending_;  // the last one may turn out to be the end
    std::optional<rddl::render::EpisodeRenderer> renderer_;  // of the episode that has begun
    Pace pace_;
    // All states of an episode of which only some are drawn: their number determines which.
    std::vector<TraceStep> held_;
    std::int64_t added_ = 0, in_movie_ = 0;  // states of the episode
    StatesDrawn states_;
};

}  // namespace rddlc::workbench
