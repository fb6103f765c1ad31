// Reading and writing of files, for both programs.
//
// All that is written goes through OutputFile: nothing that was read in this run is replaced, nor
// anything that is not a regular file; and nothing half-written ever has the name that was asked
// for.
#pragma once

#include "support/failure.hpp"

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

namespace rddlc {

// Also false for symlink loops and names that are too long: reading the file reports that.
bool is_there(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);

// The bytes of a file, which may be a pipe, and may have so many; "-" has no special meaning.
// Throws a Failure "cannot read 'x': Is a directory".
std::string read_file(const std::filesystem::path& path, std::size_t largest = std::string::npos);
// The same of an open file, called `name` in messages, which may have so many bytes.
std::string read_descriptor(int descriptor, std::string_view name,
                            std::size_t largest = std::string::npos);
// The limit of a text that users write: places in it have 32 bits, and devices have no end.
inline constexpr std::size_t largest_text = std::size_t{1} << 28;

// Why not to write: the system's reason, or that the file is in use by this very run.
struct UnwritableFile : Failure {
    enum class Reason { System, InUse };
    // `error` is one of <cerrno>.
    UnwritableFile(const std::filesystem::path& path, int error, std::string advice = {});
    static UnwritableFile in_use(const std::filesystem::path& path);

    Reason reason = Reason::System;

  private:
    UnwritableFile(std::string message, std::string advice, Reason why)
        : Failure(std::move(message), std::move(advice)), reason(why) {}
};

// Files that this run reads or has written, whatever their names are: a hard or symbolic link to
// one is that file.
class UsedFiles {
  public:
    void add(const std::filesystem::path& file);
    void add(int descriptor);
    bool contain(const std::filesystem::path& file) const;
    bool contain(int descriptor) const;

  private:
    // A regular file is its device and inode; one that is yet to be made is the folder's and a
    // name.
    using Identity = std::tuple<dev_t, ino_t, std::string>;
    static std::set<Identity> identities(const std::filesystem::path& file);

    std::set<Identity> files_;
};

// Throws UnwritableFile if an OutputFile cannot be made there now. Leaves everything as it was.
void require_writable(const std::filesystem::path& path, const UsedFiles& used);

// A file that is being written. A regular file, or one that does not exist, gets its name when it
// is complete: until then an older one stays as it was, with its permissions afterwards. Links are
// followed. Pipes, devices and the like, and descriptors such as /dev/stdout, are written to
// directly.
class OutputFile {
  public:
    // Throws UnwritableFile, as the functions below do. `mode` is that of a new file, before umask.
    OutputFile(const std::filesystem::path& path, const UsedFiles& used, mode_t mode = 0666);
    static OutputFile standard_output(const UsedFiles& used);
    // Removes the file unless finish() was called.
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Whether another program may be reading while it is written.
    bool is_stream() const;

    void write(std::string_view text);
    void finish();

  private:
    OutputFile(int descriptor, const char* name) : path_(name), descriptor_(descriptor) {}
    void open_stream();
    void open_temporary(mode_t mode);
    void open_named(mode_t mode);
    void give_name();

    std::filesystem::path path_;       // as the user calls it
    std::filesystem::path target_;     // what that leads to
    std::filesystem::path temporary_;  // what is renamed to the target; empty if it has no name
    bool is_nameless_ = false;         // a file without a name until it is complete
    int descriptor_ = -1;
};

// All of a file; adds it to those that are used.
void write_file(const std::filesystem::path& path, std::string_view text, UsedFiles& used,
                mode_t mode = 0666);

}  // namespace rddlc
