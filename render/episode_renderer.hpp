// The pictures of an episode, one after the other.
#pragma once

#include "render/canvas.hpp"
#include "render/snapshot.hpp"
#include "render/visualizer.hpp"

#include <cstdint>
#include <deque>
#include <string>

namespace rddl::render {

class EpisodeRenderer {
  public:
    // World and visualizer must outlive it. `horizon` is 0 if there is no horizon. The size is in
    // pixels; throws Error for sizes that no canvas has.
    EpisodeRenderer(const World& world, const Visualizer& visualizer, int width, int height,
                    std::int64_t episode, std::int64_t horizon);

    // The next state of the episode.
    void add(Step step);

    // The snapshot of the state that was added last.
    Snapshot snapshot() const { return Snapshot(world_, steps_, episode_, horizon_); }
    const Picture& picture();  // drawn when it is first asked for
    std::string svg() const;

  private:
    const World& world_;
    const Visualizer& visualizer_;
    int width_, height_;
    std::int64_t episode_, horizon_;
    std::deque<Step> steps_;
    Canvas canvas_;
    Picture picture_;
    bool is_drawn_ = false;
};

}  // namespace rddl::render
