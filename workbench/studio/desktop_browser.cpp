#include "studio/desktop_browser.hpp"

#include "lsp/positions.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>

extern char** environ;

namespace rddlc::studio {

namespace {

bool has_desktop() {
    return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
}

// A folder of the user's own, if the system has one.
std::filesystem::path private_folder() {
    if (const char* const folder = std::getenv("XDG_RUNTIME_DIR"); folder && *folder) return folder;
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
    return folder.empty() ? "/tmp" : std::filesystem::absolute(folder);
}

// A new file that the user alone can read. Empty if it cannot be written.
std::filesystem::path write_private_file(const std::string& text) {
    constexpr const char* ending = ".html";
    std::string name = private_folder() / (std::string("rddl-studio-XXXXXX") + ending);
    const int file = mkostemps(name.data(), 5, O_CLOEXEC);  // its mode is 0600
    if (file < 0) return {};
    const ssize_t written = write(file, text.data(), text.size());
    const bool is_complete = written == static_cast<ssize_t>(text.size());
    if (close(file) == 0 && is_complete) return name;
    unlink(name.c_str());
    return {};
}

std::string redirection_to(const std::string& address) {
    return fmt::format(
        R"(<!doctype html><meta charset="utf-8"><title>rddl studio</title>)"
        R"(<meta http-equiv="refresh" content="0; url={0}"><a href="{0}">rddl studio</a>)"
        "\n",
        address);
}

// Messages of the browser would stand among ours.
std::optional<pid_t> start_opener(const std::string& page) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_WRONLY, 0);
    std::string program = "xdg-open", argument = page;
    char* words[] = {program.data(), argument.data(), nullptr};
    pid_t process = 0;
    const int error = posix_spawnp(&process, "xdg-open", &files, nullptr, words, environ);
    posix_spawn_file_actions_destroy(&files);
    return error == 0 ? std::optional(process) : std::nullopt;
}

}  // namespace

DesktopBrowser::DesktopBrowser(const std::string& address) {
    if (!has_desktop()) return;
    file_ = write_private_file(redirection_to(address));
    if (!file_.empty()) opener_ = start_opener(lsp::uri_of(file_));
}

DesktopBrowser::~DesktopBrowser() {
    if (!file_.empty()) unlink(file_.c_str());
}

void DesktopBrowser::forget_ended() {
    if (opener_ && waitpid(*opener_, nullptr, WNOHANG) != 0) opener_.reset();
}

}  // namespace rddlc::studio
