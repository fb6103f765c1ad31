// Lines in and out, quick for files and prompt for pipes: a program can drive a command by
// writing a line and waiting for the answer.
#pragma once

#include <optional>
#include <string>

namespace rddlc::cli {

class LineReader {
  public:
    // "-" is standard input. Fails if the file cannot be opened.
    explicit LineReader(const std::string& path);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    // Without its line break; nothing at the end of the input and on an interrupt.
    std::optional<std::string> next();

  private:
    bool fill();

    int descriptor_;
    std::string buffer_;
    std::size_t begin_ = 0;  // of what is not yet given out
};

class LineWriter {
  public:
    // "-" is standard output. Fails if the file cannot be opened.
    explicit LineWriter(const std::string& path);
    ~LineWriter();  // closes; call flush() before to learn of errors
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;

    // Text of whole lines. Reaches a reader at once unless it goes to a regular file.
    void write(const std::string& lines);
    void flush();

  private:
    std::string path_;
    int descriptor_;
    bool prompt_;
    std::string buffer_;
};

}  // namespace rddlc::cli
