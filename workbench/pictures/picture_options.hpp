// The options of pictures, of `rddl run` and `rddl render`: their files, their episode, and their
// look.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct PictureOptions {
    // Files; empty: not wanted; "-": standard output, except for videos.
    std::string gif, video;         // of the whole episode
    std::string png, svg;           // a file of one state, or a folder of all
    std::string html;               // replay page
    bool watch = false;             // in the terminal
    bool quiet = false;             // no progress is shown
    std::string scene;              // a file that says what to draw; empty: no scene
    std::string visualizer;         // empty: the one for the domain
    int width = 600, height = 400;  // pixels
    std::optional<double> frames_per_second;
    std::optional<double> real_time_factor;
    std::optional<std::int64_t> most_frames;
    std::optional<std::int64_t> episode;  // absent: the first, and all on the screen
    std::optional<std::int64_t> step;     // of files of one state; the last one if absent

    bool any_file() const {
        return !(gif.empty() && video.empty() && png.empty() && svg.empty() && html.empty());
    }
    bool any() const { return watch || any_file(); }
    // A picture goes to standard output, for another program.
    bool any_on_standard_output() const;
};

// Throws a Failure if more than one thing is written to standard output, or pictures to a terminal.
// `other`: an option that also writes there; empty: no such option.
void require_one_on_standard_output(const PictureOptions& options, std::string_view other = {});
// Throws a Failure where two outputs have the same file; `others` are no pictures, such as a trace.
void require_different_files(const PictureOptions& options, std::vector<std::string> others = {});

// The ending of a file's name, in small letters: ".mp4" of a.MP4.
std::string extension_of(const std::filesystem::path& file);

}  // namespace rddlc::workbench
