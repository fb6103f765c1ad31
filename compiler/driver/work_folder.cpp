#include "driver/work_folder.hpp"

#include "support/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

int open_folder(const fs::path& folder) {
    return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool is_ours(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid();
}

void remove_abandoned(const fs::path& parent, const std::string& prefix) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(parent, ignored)) {
        if (!entry.path().filename().string().starts_with(prefix)) continue;
        const int folder = open_folder(entry.path());
        if (folder < 0) continue;
        if (is_ours(folder) && ::flock(folder, LOCK_EX | LOCK_NB) == 0)
            fs::remove_all(entry.path(), ignored);
        ::close(folder);
    }
}

fs::path temporary_parent() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    if (!error) return fs::absolute(folder);
    const char* const wanted = std::getenv("TMPDIR");
    throw UnwritableFile(wanted ? wanted : "/tmp", error.value(), "set TMPDIR to another folder");
}

}  // namespace

WorkFolder::WorkFolder(const fs::path& parent, const std::string& prefix, const std::string& hint) {
    remove_abandoned(parent, prefix);
    // Another process may take the new folder for an abandoned one before it is locked.
    do {
        if (lock_ >= 0) ::close(lock_);
        std::string name = (parent / (prefix + "XXXXXX")).string();
        if (!::mkdtemp(name.data())) throw UnwritableFile(parent, errno, hint);
        path_ = name;
        lock_ = open_folder(path_);
        if (lock_ >= 0) static_cast<void>(::flock(lock_, LOCK_EX));
    } while (::access(path_.c_str(), F_OK) != 0);
}

WorkFolder::~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

TemporaryFolder::TemporaryFolder()
    : WorkFolder(temporary_parent(), "rddlc-building-",
                 "set TMPDIR to a folder that can be written") {}

}  // namespace rddlc
