// Lines in and out, quick for files and prompt for pipes: a program can drive a command by
// writing a line and waiting for the answer.
#pragma once

#include "support/files.hpp"

#include <optional>
#include <string>

namespace rddlc::workbench {

// A line is longer than any that means something. It is left out: the next one can be read.
struct LongLine : Failure {
    using Failure::Failure;
};

class LineReader {
  public:
    // "-" is standard input. Fails if the file cannot be opened, and later if it cannot be read, as
    // a folder. `used` gets the file. Lines have at most `longest` bytes.
    LineReader(const std::string& path, UsedFiles& used, std::size_t longest);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    // The next line without its line break; nothing at the end of the input and on an interrupt.
    // Throws a LongLine as soon as the line is too long; fails if a line has no end.
    std::optional<std::string> next();

  private:
    bool fill();
    bool leave_out_rest();

    std::string path_;
    int descriptor_;
    std::size_t longest_;
    std::string buffer_;
    std::size_t begin_ = 0;  // of what is not yet given out
    bool is_within_long_line_ = false;
};

class LineWriter {
  public:
    // "-" is standard output. Fails, as the functions below, if the file cannot be written or is
    // one of those that are used.
    LineWriter(const std::string& path, const UsedFiles& used);

    // Text of whole lines. Reaches a reader at once unless it goes to a regular file.
    void write(const std::string& lines);
    // A file has its name from here on; without this nothing is left of it.
    void finish();

  private:
    void flush();

    OutputFile file_;
    bool prompt_;
    std::string buffer_;
};

}  // namespace rddlc::workbench
