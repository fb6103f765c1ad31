#include "pictures/picture_options.hpp"

#include "support/failure.hpp"
#include "support/files.hpp"
#include "support/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace rddlc::workbench {

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

void require_different_files(const PictureOptions& options, std::vector<std::string> others) {
    UsedFiles named;
    others.insert(others.end(),
                  {options.gif, options.video, options.png, options.svg, options.html});
    for (const std::string& path : others) {
        if (path.empty() || path == "-") continue;
        if (named.contain(path))
            throw Failure(fmt::format("two outputs would be written to '{}'", path), {},
                          usage_error);
        named.add(path);
    }
}

}  // namespace rddlc::workbench
