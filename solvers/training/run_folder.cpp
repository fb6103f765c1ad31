#include "solvers/training/run_folder.hpp"

#include "support/failure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace rddlc::solvers {

RunFolder::~RunFolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void RunFolder::hold(const std::filesystem::path& folder) {
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        throw Failure(fmt::format("another run writes into the folder '{}' now", folder.string()),
                      "wait for its end, or name another one with --out");
}

}  // namespace rddlc::solvers
