// A page that replays episodes in a browser: pictures, charts, values, all in one file that asks
// for no other.
#pragma once

#include "render/snapshot.hpp"

#include <string>
#include <string_view>

namespace rddl::render {

// Its parts, from page/; built in.
extern const std::string_view page_html, page_css, page_js;

class ReplayPage {
  public:
    ReplayPage(const World& world, int width, int height, double frames_per_second);

    // The frames that follow are of this episode. One or two; texts are UTF-8.
    void begin_run(std::string_view name);
    // A state with its picture, which has the size of the page's.
    void add(const Snapshot& snapshot, const Picture& picture);
    // All of the file.
    std::string html() const;

  private:
    const World& world_;
    int width_, height_;
    double frames_per_second_;
    std::string runs_;  // JSON
    bool first_run_ = true, first_frame_ = true;
};

}  // namespace rddl::render
