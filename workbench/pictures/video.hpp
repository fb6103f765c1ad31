// Movies in the formats of ffmpeg, which gets the pictures as they are drawn.
#pragma once

#include "driver/work_folder.hpp"
#include "support/files.hpp"

#include <render/picture.hpp>
#include <sys/types.h>

#include <filesystem>

namespace rddlc::workbench {

// Throws a Failure if the file cannot be written, or its ending is not one of the known formats:
// .mp4, .webm and .webp.
void require_video(const std::filesystem::path& file, const UsedFiles& used);

class VideoWriter {
  public:
    // Throws a Failure as require_video does, or if ffmpeg is missing.
    VideoWriter(std::filesystem::path file, int width, int height, double frames_per_second,
                const UsedFiles& used);
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    void add(const rddl::render::Picture& picture);
    // The file has its name from here on.
    void finish(UsedFiles& used);

  private:
    int wait();

    std::filesystem::path file_;
    TemporaryFolder folder_;
    std::filesystem::path made_;  // by ffmpeg
    pid_t process_ = -1;
    int pictures_ = -1;  // what ffmpeg reads
    int log_ = -1;       // what it says is wrong
};

}  // namespace rddlc::workbench
