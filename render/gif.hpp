// Animated GIF files, written frame by frame.
#pragma once

#include "render/picture.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GifFileType;

namespace rddl::render {

// Each frame stores only the rectangle that changed, and in it only the pixels that changed; the
// others are transparent. A frame has a palette of its own: all colours of what changed where they
// are at most 255, else a good choice of them (palette.hpp).
class GifWriter {
  public:
    // The movie repeats for ever. Bytes go to `sink` with each frame; exceptions of `sink` reach
    // the caller.
    GifWriter(int width, int height, Sink sink);
    ~GifWriter();
    GifWriter(const GifWriter&) = delete;
    GifWriter& operator=(const GifWriter&) = delete;

    // Shown for so many seconds. GIF counts hundredths: what is rounded is made good by the frames
    // that follow.
    void add(const Picture& picture, double seconds);
    // A file without it is cut off.
    void finish();

  private:
    struct Changed;
    Changed changed_part(const Picture& picture) const;
    void write_frame(const Changed& part, int hundredths);
    void check(int status) const;
    void flush();

    int width_, height_;
    Sink sink_;
    std::string bytes_;  // of the encoder, until the sink has them
    GifFileType* file_;
    Picture last_;     // as it was before encoding; empty before the first frame
    double debt_ = 0;  // hundredths of a second that frames were shown too short
};

}  // namespace rddl::render
