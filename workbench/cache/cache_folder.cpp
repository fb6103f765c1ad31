#include "cache/cache_folder.hpp"

#include "support/failure.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace rddlc::workbench {

namespace fs = std::filesystem;

namespace {

constexpr const char* other_folder = "set XDG_CACHE_HOME to another folder";

fs::path wanted_folder() {
    if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
        return fs::path(cache) / "rddlc";
    if (const char* const home = std::getenv("HOME"); home && *home)
        return fs::absolute(home) / ".cache" / "rddlc";
    throw Failure(
        "there is no place for compiled simulators: neither XDG_CACHE_HOME nor HOME is set");
}

[[noreturn]] void cannot_make(const fs::path& folder, int error) {
    throw Failure(fmt::format("cannot make the folder '{}' of compiled simulators: {}",
                              folder.string(), std::strerror(error)),
                  other_folder);
}

[[noreturn]] void refuse(const fs::path& folder, const char* why, std::string hint) {
    throw Failure(
        fmt::format(
            "compiled simulators are not kept in '{}': {}, and code from there would be run",
            folder.string(), why),
        std::move(hint));
}

bool is_owner_ours(const struct stat& status) {
    return status.st_uid == ::geteuid() || status.st_uid == 0;
}

bool may_others_write(const struct stat& status) {
    return (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
}

}  // namespace

fs::path cache_folder() {
    const fs::path folder = wanted_folder();
    std::error_code error;
    fs::create_directories(folder.parent_path(), error);
    if (error) cannot_make(folder, error.value());
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) cannot_make(folder, errno);
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) cannot_make(folder, errno);
    if (!S_ISDIR(status.st_mode)) cannot_make(folder, ENOTDIR);
    if (!is_owner_ours(status)) refuse(folder, "the folder belongs to another user", other_folder);
    if (may_others_write(status))
        refuse(
            folder, "others may write to the folder",
            fmt::format("empty it and run chmod go-w '{}', or {}", folder.string(), other_folder));
    return folder;
}

bool is_ours(const fs::path& file) {
    struct stat status {};
    return ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
           is_owner_ours(status) && !may_others_write(status);
}

}  // namespace rddlc::workbench
