#include "pictures/outputs.hpp"

#include "pictures/video.hpp"
#include "support/utf8.hpp"

#include <fmt/format.h>
#include <render/gif.hpp>
#include <render/png.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace rddlc::workbench {

namespace fs = std::filesystem;
namespace render = rddl::render;

namespace {

constexpr double last_frame_seconds = 1.5;  // before a movie begins anew

bool is_standard_output(const std::string& path) {
    return path == "-";
}

OutputFile open_output(const std::string& path, const UsedFiles& used) {
    return is_standard_output(path) ? OutputFile::standard_output(used) : OutputFile(path, used);
}

void require_output(const std::string& path, const UsedFiles& used) {
    if (!is_standard_output(path)) require_writable(path, used);
}

void write_output(const std::string& path, std::string_view bytes, UsedFiles& used) {
    if (!is_standard_output(path)) return write_file(path, bytes, used);
    OutputFile file = open_output(path, used);
    file.write(bytes);
    file.finish();
}

using BytesOf = std::string (*)(render::EpisodeRenderer&);

std::string png_of(render::EpisodeRenderer& renderer) {
    return render::png_bytes(renderer.picture());
}

std::string svg_of(render::EpisodeRenderer& renderer) {
    return renderer.svg();
}

// A file of one state. It is written at the end, when all else has gone well.
Output single_output(const std::string& path, std::optional<std::int64_t> step, BytesOf bytes_of,
                     UsedFiles& used) {
    require_output(path, used);
    const auto bytes = std::make_shared<std::optional<std::string>>();
    Output output;
    output.begin = [](const Show&) {
    };
    output.add = [=](const Drawn& drawn) {
        const std::int64_t number = drawn.renderer.snapshot().now().number;
        const bool is_wanted = step ? *step == number : drawn.is_last;
        if (is_wanted) *bytes = bytes_of(drawn.renderer);
        if (drawn.is_last && !*bytes)
            throw Failure(
                fmt::format("there is no state {}: the episode has {} steps", *step, number));
        return is_wanted;
    };
    output.finish = [=, &used] {
        write_output(path, bytes->value(), used);
    };
    return output;
}

// A folder with a file of each state.
Output folder_output(const fs::path& folder, const char* ending, BytesOf bytes_of,
                     UsedFiles& used) {
    std::error_code error;
    if (fs::is_symlink(folder) && !fs::exists(folder))
        throw Failure(fmt::format("cannot write '{}': it is a link to a folder that is not there",
                                  folder.string()));
    fs::create_directories(folder, error);
    if (error) throw UnwritableFile(folder, error.value());
    Output output;
    output.begin = [](const Show&) {
    };
    output.add = [=, &used](const Drawn& drawn) {
        if (!drawn.in_movie) return false;
        const std::int64_t number = drawn.renderer.snapshot().now().number;
        write_file(folder / fmt::format("{:06}{}", number, ending), bytes_of(drawn.renderer), used);
        return true;
    };
    output.finish = [] {
    };
    return output;
}

// Whether other programs read the path as a file of another kind.
bool names_another_kind(const std::string& path, std::string_view ending) {
    constexpr std::array<std::string_view, 11> endings{
        ".png", ".svg", ".gif", ".jpg", ".jpeg", ".webp", ".bmp", ".pdf", ".mp4", ".webm", ".html"};
    const std::string extension = extension_of(path);
    return extension != ending && std::ranges::find(endings, extension) != std::end(endings);
}

Output still_output(const std::string& path, const char* ending, const PictureOptions& options,
                    BytesOf bytes_of, UsedFiles& used) {
    if (names_another_kind(path, ending))  // such a path is not meant as a folder
        throw Failure(
            fmt::format("a picture is a file {}, or a folder of them, not '{}'", ending, path), {},
            usage_error);
    const bool single = is_standard_output(path) || extension_of(path) == ending;
    return single ? single_output(path, options.step, bytes_of, used)
                  : folder_output(path, ending, bytes_of, used);
}

}  // namespace

Output gif_output(const PictureOptions& options, UsedFiles& used) {
    struct Gif {
        OutputFile file;
        render::GifWriter writer;
        double seconds = 0;

        Gif(const std::string& path, int width, int height, UsedFiles& in_use)
            : file(open_output(path, in_use)),
              writer(width, height, [this](std::string_view bytes) { file.write(bytes); }) {}
    };
    if (names_another_kind(options.gif, ".gif"))
        throw Failure(fmt::format("--gif writes a file .gif, not '{}'", options.gif), {},
                      usage_error);
    const auto gif = std::make_shared<Gif>(options.gif, options.width, options.height, used);
    Output output;
    output.begin = [=](const Show& show) {
        gif->seconds = 1 / show.pace.frames_per_second;
    };
    output.add = [=](const Drawn& drawn) {
        if (drawn.in_movie)
            gif->writer.add(drawn.renderer.picture(),
                            drawn.is_last ? last_frame_seconds : gif->seconds);
        return drawn.in_movie;
    };
    output.finish = [=] {
        gif->writer.finish();
        gif->file.finish();
    };
    return output;
}

Output video_output(const PictureOptions& options, UsedFiles& used) {
    require_video(options.video, used);
    const auto video = std::make_shared<std::optional<VideoWriter>>();
    Output output;
    output.begin = [=, &used](const Show& show) {
        video->emplace(options.video, options.width, options.height, show.pace.frames_per_second,
                       used);
    };
    output.add = [=](const Drawn& drawn) {
        if (drawn.in_movie) (*video)->add(drawn.renderer.picture());
        return drawn.in_movie;
    };
    output.finish = [=, &used] {
        (*video)->finish(used);
    };
    return output;
}

Output png_output(const PictureOptions& options, UsedFiles& used) {
    return still_output(options.png, ".png", options, png_of, used);
}

Output svg_output(const PictureOptions& options, UsedFiles& used) {
    return still_output(options.svg, ".svg", options, svg_of, used);
}

Output page_output(const PictureOptions& options, UsedFiles& used) {
    require_output(options.html, used);
    const auto page = std::make_shared<std::optional<render::ReplayPage>>();
    Output output;
    output.begin = [=](const Show& show) {
        if (!*page)
            page->emplace(show.world, options.width, options.height, show.pace.frames_per_second);
        (*page)->begin_run(is_utf8(show.name) ? show.name : "episode");
    };
    output.add = [=](const Drawn& drawn) {
        if (drawn.in_movie) (*page)->add(drawn.renderer.snapshot(), drawn.renderer.picture());
        return drawn.in_movie;
    };
    output.finish = [=, &used] {
        write_output(options.html, (*page)->html(), used);
    };
    return output;
}

}  // namespace rddlc::workbench
