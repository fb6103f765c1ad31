#include "pictures/video.hpp"

#include "pictures/picture_options.hpp"
#include "support/failure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

namespace rddlc::workbench {

namespace {

// The options of ffmpeg for the file's ending.
std::vector<std::string> format_options(const std::filesystem::path& file) {
    const std::string ending = extension_of(file);
    // Half the colours of most players' videos need an even size.
    if (ending == ".mp4")
        return {"-c:v",      "libx264",   "-pix_fmt",
                "yuv420p",   "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                "-movflags", "+faststart"};
    if (ending == ".webm") return {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "30"};
    if (ending == ".webp") return {"-c:v", "libwebp", "-lossless", "1", "-loop", "0"};
    throw Failure(fmt::format("a video is a file .mp4, .webm or .webp, not '{}'", file.string()),
                  "--gif writes a GIF", usage_error);
}

// Two ends that are connected. A write to one does not end us by a signal, as with a pipe, if
// ffmpeg has ended.
struct Connection {
    int ours = -1, theirs = -1;

    Connection() {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
            throw Failure(fmt::format("cannot talk to ffmpeg: {}", std::strerror(errno)));
        ours = ends[0];
        theirs = ends[1];
    }
    ~Connection() {
        for (const int end : {ours, theirs})
            if (end >= 0) close(end);
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
};

// The child's standard input, and where it says what is wrong. Returns the error number.
int start(const std::vector<std::string>& command, int input, int log, pid_t& process) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, log, STDERR_FILENO);
    posix_spawn_file_actions_adddup2(&actions, log, STDOUT_FILENO);
    const int error = posix_spawnp(&process, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

}  // namespace

void require_video(const std::filesystem::path& file, const UsedFiles& used) {
    format_options(file);
    require_writable(file, used);
}

VideoWriter::VideoWriter(std::filesystem::path file, int width, int height,
                         double frames_per_second, const UsedFiles& used)
    : file_(std::move(file)), made_(folder_.path() / ("movie" + extension_of(file_))) {
    require_video(file_, used);
    std::vector<std::string> command{"ffmpeg", "-nostdin", "-loglevel", "error", "-y",
                                     "-f",     "rawvideo", "-pix_fmt",  "bgr0"};
    for (const std::string& word :
         {std::string("-s"), fmt::format("{}x{}", width, height), std::string("-r"),
          fmt::format("{}", frames_per_second), std::string("-i"), std::string("pipe:0")})
        command.push_back(word);
    for (std::string& word : format_options(file_)) command.push_back(std::move(word));
    command.push_back(made_.string());

    // A pipe takes the messages, since the disk may be full. Excess messages are dropped and do not
    // block.
    Connection pictures, log;
    fcntl(log.theirs, F_SETFL, O_NONBLOCK);
    const int error = start(command, pictures.theirs, log.theirs, process_);
    if (error != 0) {
        process_ = -1;
        throw Failure(fmt::format("cannot start ffmpeg: {}", std::strerror(error)),
                      "videos are made by the program ffmpeg, which Debian has as a package of "
                      "that name; --gif needs nothing else");
    }
    pictures_ = std::exchange(pictures.ours, -1);
    log_ = std::exchange(log.ours, -1);
}

VideoWriter::~VideoWriter() {
    if (pictures_ >= 0) close(pictures_);
    if (process_ > 0) {
        kill(process_, SIGKILL);
        wait();
    }
    if (log_ >= 0) close(log_);
}

int VideoWriter::wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

void VideoWriter::add(const rddl::render::Picture& picture) {
    const char* bytes = reinterpret_cast<const char*>(picture.pixels.data());
    std::size_t left = picture.pixels.size() * sizeof picture.pixels[0];
    while (left > 0) {
        const ssize_t sent = send(pictures_, bytes, left, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) return;  // ffmpeg has ended; finish() reports why
        bytes += sent;
        left -= static_cast<std::size_t>(sent);
    }
}

void VideoWriter::finish(UsedFiles& used) {
    close(std::exchange(pictures_, -1));
    const int status = wait();
    std::string log = read_descriptor(log_, "what ffmpeg says");
    while (!log.empty() && log.back() == '\n') log.pop_back();
    // It may end well although the end of a file could not be written.
    if (status != 0 || !log.empty()) {
        throw Failure(fmt::format("ffmpeg failed: {}", log.empty() ? "it says nothing" : log));
    }
    write_file(file_, read_file(made_), used);
}

}  // namespace rddlc::workbench
