#include "native/painter.hpp"

#include "native/env_pool.hpp"
#include "native/paths.hpp"
#include "native/problem.hpp"

#include <fmt/format.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <render/gif.hpp>
#include <render/png.hpp>
#include <render/replay_page.hpp>
#include <render/state_text.hpp>
#include <render/visualizer.hpp>

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <tuple>

namespace nb = nanobind;

namespace rddlc::python {

namespace {

namespace render = rddl::render;

// An episode of environment 0 of a batch, as far as it goes, and what draws it.
class Painter {
  public:
    Painter(const workbench::LoadedProblem& problem, int width, int height,
            const std::string& visualizer)
        : simulator_(problem.simulator),
          world_(*simulator_),
          visualizer_(chosen(visualizer)),
          width_(side(width)),
          height_(side(height)),
          canvas_(width_, height_) {}

    void begin(EnvPool& batch, std::int64_t horizon) {
        steps_.clear();
        horizon_ = horizon;
        std::tie(std::ignore, episode_) = batch.progress(0);
        add(batch, 0);
    }

    // Adds the step that the batch has just made.
    void add_step(EnvPool& batch, const std::string& end) {
        render::Step& last = steps_.back();
        const EnvPool::Arrays& arrays = batch.arrays();
        last.action = arrays.actions;
        last.reward = arrays.rewards[0];
        add(batch, last.total + last.reward);
        steps_.back().end = end;
    }

    const render::Picture& draw() {
        const render::Snapshot now = snapshot();
        render::draw_picture(canvas_, visualizer_, now);
        canvas_.read(picture_);
        return picture_;
    }

    std::string text() const {
        const render::Snapshot now = snapshot();
        std::string text = fmt::format("step {}, return {}\n", now.now().number,
                                       render::number_text(now.now().total));
        for (const render::TextLine& line : render::state_lines(now))
            text += fmt::format("{} = {}\n", line.name, line.value);
        return text;
    }

    // A page of all steps that are remembered.
    std::string page(double frames_per_second) {
        render::ReplayPage page(world_, width_, height_, frames_per_second);
        page.begin_run(simulator_->problem->instance);
        for_each_moment([&](const render::Snapshot& then) { page.add(then, picture_); });
        return page.html();
    }

    std::string gif(double frames_per_second) {
        std::string bytes;
        render::GifWriter writer(width_, height_, [&](std::string_view more) { bytes += more; });
        for_each_moment(
            [&](const render::Snapshot&) { writer.add(picture_, 1 / frames_per_second); });
        writer.finish();
        return bytes;
    }

  private:
    // Visits all moments from the first step that is remembered, each with its picture drawn.
    template <class Visit>
    void for_each_moment(Visit&& visit) {
        std::deque<render::Step> shown;
        for (const render::Step& step : steps_) {
            shown.push_back(step);
            const render::Snapshot then(world_, shown, episode_, horizon_);
            render::draw_picture(canvas_, visualizer_, then);
            canvas_.read(picture_);
            visit(then);
        }
    }

    static int side(int pixels) {
        if (pixels < 16 || pixels > 8192)
            throw Refused(fmt::format(
                "a picture has from 16 to 8192 pixels in each direction, not {}", pixels));
        return pixels;
    }

    const render::Visualizer& chosen(const std::string& name) const {
        if (name.empty()) return render::visualizer_for(world_);
        const render::Visualizer* const found = render::find_visualizer(name);
        if (!found) throw Refused(fmt::format("there is no visualizer '{}'", name));
        if (const auto missing = render::missing_fluent(*found, world_); !missing.empty())
            throw Refused(
                fmt::format("the visualizer '{}' draws a fluent '{}', which this "
                            "problem has not",
                            name, missing));
        return *found;
    }

    render::Snapshot snapshot() const { return {world_, steps_, episode_, horizon_}; }

    void add(EnvPool& batch, double total) {
        render::Step step;
        step.number = batch.progress(0).first;
        step.state.resize(static_cast<std::size_t>(simulator_->problem->state_size));
        batch.read_state(0, step.state.data());
        step.total = total;
        steps_.push_back(std::move(step));
        if (steps_.size() > render::most_steps_remembered) steps_.pop_front();
    }

    workbench::Simulator simulator_;
    render::World world_;
    const render::Visualizer& visualizer_;
    int width_, height_;
    render::Canvas canvas_;
    render::Picture picture_;
    std::deque<render::Step> steps_;
    std::int64_t episode_ = 0, horizon_ = 0;
};

// (height, width, 3)
nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<3>> pixels(Painter& painter) {
    const render::Picture& picture = painter.draw();
    auto bytes = std::make_unique<std::uint8_t[]>(3 * picture.pixels.size());
    std::uint8_t* out = bytes.get();
    for (const std::uint32_t pixel : picture.pixels)
        for (const int shift : {16, 8, 0}) *out++ = static_cast<std::uint8_t>(pixel >> shift);
    const std::size_t shape[] = {static_cast<std::size_t>(picture.height),
                                 static_cast<std::size_t>(picture.width), 3};
    std::uint8_t* const data = bytes.release();
    const nb::capsule owner(
        data, [](void* array) noexcept { delete[] static_cast<std::uint8_t*>(array); });
    return {data, 3, shape, owner};
}

nb::bytes png(Painter& painter) {
    const std::string bytes = render::small_png_bytes(painter.draw());
    return nb::bytes(bytes.data(), bytes.size());
}

}  // namespace

void add_painter(nb::module_& module) {
    nb::class_<Painter>(module, "Painter", "Pictures of a running episode.")
        .def(nb::init<const workbench::LoadedProblem&, int, int, const std::string&>(),
             nb::arg("simulator"), nb::arg("width"), nb::arg("height"), nb::arg("visualizer"))
        .def("begin", &Painter::begin)
        .def("add_step", &Painter::add_step)
        .def("pixels", pixels)
        .def("png", png)
        .def("text", &Painter::text)
        .def("write_gif",
             [](Painter& painter, const nb::object& path, double frames_per_second) {
                 const std::string file = path_of(path);  // before anything is drawn
                 UsedFiles used;
                 write_file(file, painter.gif(frames_per_second), used);
             })
        .def("page", &Painter::page);
}

}  // namespace rddlc::python
