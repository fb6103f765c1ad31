// The files that an episode is drawn into, one kind like the other.
#pragma once

#include "pictures/pace.hpp"
#include "pictures/picture_options.hpp"
#include "support/files.hpp"

#include <render/episode_renderer.hpp>
#include <render/replay_page.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rddlc::workbench {

// The facts that are known when the first state is there.
struct Show {
    const rddl::render::World& world;
    Pace pace;
    std::string name;  // of the trace
};

struct Drawn {
    rddl::render::EpisodeRenderer& renderer;  // after the state was added
    bool in_movie;                            // not left out by the stride
    bool is_last;
};

// Opened before anything is drawn, so that what cannot be written is known at once.
struct Output {
    std::function<void(const Show&)> begin;  // an episode
    std::function<bool(const Drawn&)> add;   // whether it shows the state
    std::function<void()> finish;            // the file has its name from here on
};

Output gif_output(const PictureOptions& options, UsedFiles& used);
Output video_output(const PictureOptions& options, UsedFiles& used);
Output png_output(const PictureOptions& options, UsedFiles& used);
Output svg_output(const PictureOptions& options, UsedFiles& used);
// A page of one or two episodes.
Output page_output(const PictureOptions& options, UsedFiles& used);

}  // namespace rddlc::workbench
