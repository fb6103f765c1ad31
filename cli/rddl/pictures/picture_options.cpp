#include "pictures/picture_options.hpp"

#include "pictures/charts.hpp"
#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace rddlc::cli {

namespace {

// "600x400"
void read_size(const std::string& text, int& width, int& height) {
    const std::size_t by = text.find_first_of("xX");
    if (by == std::string::npos)
        throw UsageError(fmt::format("--size: '{}' is not WIDTHxHEIGHT, such as 600x400", text));
    width = number_of<int>("--size", text.substr(0, by), 16, 8192);
    height = number_of<int>("--size", text.substr(by + 1), 16, 8192);
}

}  // namespace

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return std::tolower(c); });
    return extension;
}

bool PictureOptions::any_on_standard_output() const {
    return gif == "-" || png == "-" || svg == "-" || html == "-";
}

void require_one_on_standard_output(const PictureOptions& options, std::string_view other) {
    std::vector<std::string_view> writers;
    if (!other.empty()) writers.push_back(other);
    if (options.gif == "-") writers.emplace_back("--gif -");
    if (options.png == "-") writers.emplace_back("--png -");
    if (options.svg == "-") writers.emplace_back("--svg -");
    if (options.html == "-") writers.emplace_back("--html -");
    if (options.watch) writers.emplace_back("--watch");
    if (writers.size() > 1)
        throw Failure(
            fmt::format("{} and {} both write to standard output", writers[0], writers[1]), {},
            usage_error);
    if (options.any_on_standard_output() && is_terminal(STDOUT_FILENO))
        throw Failure("standard output is a terminal, which shows no files of pictures",
                      "name a file, or send the output to another program; --watch shows episodes "
                      "in terminals",
                      usage_error);
}

void require_different_files(const PictureOptions& options, const std::string& trace) {
    UsedFiles named;
    for (const std::string& path :
         {trace, options.gif, options.video, options.png, options.svg, options.html}) {
        if (path.empty() || path == "-") continue;
        if (named.contain(path))
            throw Failure(fmt::format("two outputs would be written to '{}'", path), {},
                          usage_error);
        named.add(path);
    }
}

void add_size_option(Command& command, int& width, int& height, const std::string& explanation) {
    add_option(command, "--size", "WxH", explanation,
               [&width, &height](const std::string& text) { read_size(text, width, height); });
}

void add_chart_options(Command& command, ChartFiles& files) {
    add_text_option(command, "--png", "FILE", "Write a picture", files.png);
    add_text_option(command, "--svg", "FILE", "Write a vector graphic", files.svg);
    add_size_option(command, files.width, files.height, "Pixels of the picture (900x600)");
}

void add_picture_options(Command& command, PictureOptions& options) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    add_text_option(command, "--gif", "FILE",
                    "Write a movie of an episode; - is stdout, here and below", options.gif);
    add_text_option(command, "--video,--mp4", "FILE",
                    "The same as .mp4, .webm or .webp, by the program ffmpeg", options.video);
    add_text_option(command, "--png", "PATH",
                    "FILE.png or -: a picture of one state; another path: a folder of all",
                    options.png);
    add_text_option(command, "--svg", "PATH", "The same as vector graphics", options.svg);
    add_text_option(command, "--html", "FILE", "Write a page that replays the episode, in one file",
                    options.html);
    add_flag(command, "--watch", "Show the episode in the terminal, state by state", options.watch);
    add_text_option(command, "--visualizer", "NAME",
                    "How states are drawn: auto, chart, heatmap, text, or that of a domain (the "
                    "one for the problem's domain); 'list' prints all",
                    options.visualizer);
    add_text_option(command, "--scene", "FILE.json",
                    "Draw the shapes that this file describes (docs/scenes.md)", options.scene);
    add_size_option(command, options.width, options.height, "Pixels of a picture (600x400)");
    add_number_option<double>(command, "--fps", "N", "Steps a second in movies (10)",
                              options.frames_per_second, 0.01, 1000);
    add_number_option<double>(command, "--real-time-factor", "X",
                              "X seconds of the problem in a second of the movie, where a "
                              "non-fluent gives the length of a step",
                              options.real_time_factor, 1e-6, 1e6);
    add_number_option<std::int64_t>(command, "--max-frames", "N",
                                    "Largest number of pictures: every second, third, ... state of "
                                    "a longer episode (1000)",
                                    options.most_frames, 1, most);
    add_number_option<std::int64_t>(command, "--environment", "K",
                                    "Number of the episode, from 0 on (0; --watch shows all)",
                                    options.episode, 0, most);
    add_number_option<std::int64_t>(command, "--step", "K",
                                    "State that a single picture shows (the last one)",
                                    options.step, 0, most);
}

}  // namespace rddlc::cli
