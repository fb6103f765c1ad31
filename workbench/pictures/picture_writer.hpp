// Converts lines of a trace to files of pictures.
#pragma once

#include "engines/load_simulator.hpp"
#include "formats/trace_steps.hpp"
#include "pictures/picture_options.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace rddlc::workbench {

// Whether rddl was built with the library that draws; otherwise the commands say so.
bool can_draw();
// Fails if it was not.
void require_pictures();

// "auto      chart, heatmap or text ...", a line each.
std::string visualizer_list();

class PictureWriter {
  public:
    // Opens the files, so that what cannot be written is known before anything is run. `name` is
    // that of the trace in messages. Throws a Failure; so do the functions below.
    PictureWriter(const LoadedProblem& problem, const PictureOptions& options,
                  const std::string& name);
    ~PictureWriter();
    PictureWriter(const PictureWriter&) = delete;
    PictureWriter& operator=(const PictureWriter&) = delete;

    // Adds a line of the trace, without its line break.
    void add_line(std::string_view line);
    // The lines that follow are of another trace of the same problem. For pages only, which show
    // both episodes side by side.
    void begin_second(const std::string& name);

    // The files have their names from here on. `what` was drawn in words: "201 pictures".
    std::string finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rddlc::workbench
