#include "render/episode_renderer.hpp"

#include <utility>

namespace rddl::render {

EpisodeRenderer::EpisodeRenderer(const World& world, const Visualizer& visualizer, int width,
                                 int height, std::int64_t episode, std::int64_t horizon)
    : world_(world),
      visualizer_(visualizer),
      width_(width),
      height_(height),
      episode_(episode),
      horizon_(horizon),
      canvas_(width, height) {}

void EpisodeRenderer::add(Step step) {
    steps_.push_back(std::move(step));
    if (steps_.size() > most_steps_remembered) steps_.pop_front();
    is_drawn_ = false;
}

const Picture& EpisodeRenderer::picture() {
    if (!is_drawn_) {
        draw_picture(canvas_, visualizer_, snapshot());
        canvas_.read(picture_);
        is_drawn_ = true;
    }
    return picture_;
}

std::string EpisodeRenderer::svg() const {
    Canvas canvas = Canvas::svg(width_, height_);
    draw_picture(canvas, visualizer_, snapshot());
    return canvas.finish_svg();
}

}  // namespace rddl::render
