// The texts that the server knows: those that are open in the editor, and the files beside them.
#pragma once

#include "lsp/outline.hpp"
#include "lsp/positions.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::lsp {

// One state of a file; a change makes a new one.
struct File {
    File(std::string where, std::optional<std::int64_t> number, std::string content);
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    std::string uri;
    std::filesystem::path path;  // as the compiler knows it; the URI, if that is not of a file
    std::optional<std::int64_t> version;  // absent: it is not open, but read from the disk
    Text text;
    Outline outline;
};
using FilePtr = std::shared_ptr<const File>;

// Files of one domain, as far as they are open or lie in the folder of one that is.
struct Family {
    FilePtr domain;               // absent if it was not found
    std::vector<FilePtr> others;  // non-fluents, instances, policies; open ones first
    // All that declare a domain, of this family or not: 'domain = ' may come to name each of them.
    std::vector<FilePtr> domains_around;

    std::vector<FilePtr> all() const;
};

class Workspace {
  public:
    // `is_one_problem`: the open files belong together, whatever names are in them.
    explicit Workspace(bool is_one_problem = false) : is_one_problem_(is_one_problem) {}

    // The file that the editor has opened, or changed.
    void open(const std::string& uri, std::int64_t version, std::string text);
    // One of textDocument/didChange's changes; they may be of ranges or of the whole.
    void change(const std::string& uri, std::int64_t version, const Json& changes);
    void close(const std::string& uri);

    FilePtr find(const std::string& uri) const;  // of the open ones
    std::vector<FilePtr> open_files() const;

    // The file itself is always one of them.
    Family family_of(const FilePtr& file) const;

  private:
    std::vector<FilePtr> files_around(const File& file) const;
    FilePtr read(const std::filesystem::path& path) const;

    struct OnDisk {
        std::filesystem::file_time_type time;
        FilePtr file;  // null if it could not be read
    };
    bool is_one_problem_;
    std::map<std::string, FilePtr> open_;
    mutable std::map<std::filesystem::path, OnDisk> on_disk_;
};

}  // namespace rddlc::lsp
