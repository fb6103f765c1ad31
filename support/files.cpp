#include "support/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

namespace rddlc {
namespace {

namespace fs = std::filesystem;

Failure unreadable(std::string_view name, int error) {
    return Failure(fmt::format("cannot read '{}': {}", name, std::strerror(error)));
}

std::optional<struct stat> status_of(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return status;
}

std::optional<struct stat> status_of(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return std::nullopt;
    return status;
}

bool is_regular(const std::optional<struct stat>& status) {
    return status && S_ISREG(status->st_mode);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// The descriptor of this process that a name such as /dev/fd/3 means.
std::optional<int> descriptor_named(const fs::path& path) {
    const fs::path folder = path.parent_path();
    if (folder != "/proc/self/fd" && folder != "/dev/fd") return std::nullopt;
    const std::string digits = path.filename().string();
    int number = -1;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return number;
}

// The target of symbolic links, at the furthest the one that names a descriptor; nothing if they
// form a loop.
std::optional<fs::path> find_target(const fs::path& path) {
    constexpr int most_links = 40;  // as Linux has it
    fs::path target = path;
    for (int i = 0; i < most_links; ++i) {
        std::error_code no_link;
        const fs::path next = fs::read_symlink(target, no_link);
        if (no_link || descriptor_named(target)) return target;
        target = next.is_absolute() ? next : folder_of(target) / next;
    }
    return std::nullopt;
}

fs::path target_of(const fs::path& path) {
    if (auto target = find_target(path)) return *std::move(target);
    throw UnwritableFile(path, ELOOP);
}

int open_file(const fs::path& path, int flags, mode_t mode = 0) {
    return ::open(path.c_str(), flags | O_CLOEXEC, mode);
}

// Whether writing there goes to a pipe, a device or an open descriptor, and makes no file.
bool is_stream_at(const fs::path& target) {
    const auto status = status_of(target);
    return status && (!is_regular(status) || descriptor_named(target));
}

std::string name_of_descriptor(int descriptor) {
    return fmt::format("/proc/self/fd/{}", descriptor);
}

// A name that cannot be predicted.
fs::path temporary_name(const fs::path& target) {
    std::random_device random;
    return target.parent_path() / fmt::format(".rddlc-{:08x}{:08x}", random(), random());
}

// A file that gets its name later; -1 if the system or the file system has no such files, or could
// not name it.
int open_nameless([[maybe_unused]] const fs::path& folder, [[maybe_unused]] mode_t mode) {
#ifdef O_TMPFILE
    const int descriptor = open_file(folder, O_WRONLY | O_TMPFILE, mode);
    if (descriptor < 0 || ::access(name_of_descriptor(descriptor).c_str(), F_OK) == 0)
        return descriptor;
    ::close(descriptor);
#endif
    return -1;
}

}  // namespace

// ------------------------------------------------------------------------------------- reading

std::string read_descriptor(int descriptor, std::string_view name, std::size_t largest) {
    std::string text;
    std::array<char, 1 << 16> block;
    while (true) {
        const ssize_t count = ::read(descriptor, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw unreadable(name, errno);
        if (count == 0) return text;
        text.append(block.data(), static_cast<std::size_t>(count));
        if (text.size() > largest) throw unreadable(name, EFBIG);
    }
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

std::string read_file(const fs::path& path, std::size_t largest) {
    struct Descriptor {
        int number;
        ~Descriptor() {
            if (number >= 0) ::close(number);
        }
    };
    const Descriptor file{open_file(path, O_RDONLY)};
    if (file.number < 0) throw unreadable(path.string(), errno);
    return read_descriptor(file.number, path.string(), largest);
}

// ------------------------------------------------------------------------ what must not be lost

UnwritableFile::UnwritableFile(const fs::path& path, int error, std::string advice)
    : Failure(fmt::format("cannot write '{}': {}", path.string(), std::strerror(error)),
              std::move(advice)) {}

UnwritableFile UnwritableFile::in_use(const fs::path& path) {
    return {
        fmt::format("the output '{}' would overwrite a file of this very command", path.string()),
        "give the output a name of its own", Reason::InUse};
}

std::set<UsedFiles::Identity> UsedFiles::identities(const fs::path& file) {
    std::set<Identity> all;
    const auto status = status_of(file);
    if (status && !is_regular(status)) return all;
    if (status) all.emplace(status->st_dev, status->st_ino, "");
    const auto target = find_target(file);
    if (!target) return all;
    if (const auto folder = status_of(folder_of(*target)))
        all.emplace(folder->st_dev, folder->st_ino, target->filename().string());
    return all;
}

void UsedFiles::add(const fs::path& file) {
    files_.merge(identities(file));
}

void UsedFiles::add(int descriptor) {
    const auto status = status_of(descriptor);
    if (is_regular(status)) files_.emplace(status->st_dev, status->st_ino, "");
}

bool UsedFiles::contain(const fs::path& file) const {
    for (const Identity& identity : identities(file))
        if (files_.contains(identity)) return true;
    return false;
}

bool UsedFiles::contain(int descriptor) const {
    const auto status = status_of(descriptor);
    return is_regular(status) && files_.contains({status->st_dev, status->st_ino, ""});
}

// ------------------------------------------------------------------------------------- writing

namespace {

// Throws UnwritableFile if permissions or kinds of files forbid an output there.
void require_allowed(const fs::path& path, const fs::path& target, const UsedFiles& used) {
    const auto status = status_of(target);
    if (!target.has_filename() || (status && S_ISDIR(status->st_mode)))
        throw UnwritableFile(path, EISDIR, "name a file in that folder");
    if (used.contain(path)) throw UnwritableFile::in_use(path);
    // Effective user, not the real one.
    const auto may_write = [](const fs::path& place) {
        return ::faccessat(AT_FDCWD, place.c_str(), W_OK, AT_EACCESS) == 0;
    };
    if (status && !may_write(target)) throw UnwritableFile(path, errno);
    if (is_stream_at(target)) return;
    const fs::path folder = folder_of(target);
    const auto folder_status = status_of(folder);
    if (!folder_status) throw UnwritableFile(path, errno);
    if (!S_ISDIR(folder_status->st_mode)) throw UnwritableFile(path, ENOTDIR);
    if (!may_write(folder)) throw UnwritableFile(path, errno);
}

}  // namespace

// Permissions do not tell all: no file can be made in /proc, whatever they are.
void require_writable(const fs::path& path, const UsedFiles& used) {
    const fs::path target = target_of(path);
    require_allowed(path, target, used);
    if (!is_stream_at(target)) OutputFile(path, used);
}

OutputFile::OutputFile(const fs::path& path, const UsedFiles& used, mode_t mode)
    : path_(path), target_(target_of(path)) {
    require_allowed(path, target_, used);
    if (is_stream_at(target_))
        open_stream();
    else
        open_temporary(mode);
}

OutputFile OutputFile::standard_output(const UsedFiles& used) {
    if (used.contain(STDOUT_FILENO)) throw UnwritableFile::in_use("standard output");
    return OutputFile(STDOUT_FILENO, "standard output");
}

void OutputFile::open_stream() {
    const auto number = descriptor_named(target_);
    descriptor_ = number ? ::fcntl(*number, F_DUPFD_CLOEXEC, 0) : open_file(target_, O_WRONLY);
    if (descriptor_ < 0) throw UnwritableFile(path_, errno);
}

// Opens a file beside the target, so that renaming it is one step. It has no name if the system can
// do that: then a process that is killed leaves nothing.
void OutputFile::open_temporary(mode_t mode) {
    descriptor_ = open_nameless(folder_of(target_), mode);
    is_nameless_ = descriptor_ >= 0;
    if (!is_nameless_) open_named(mode);
    const auto older = status_of(target_);
    if (!older) return;
    // Somebody else's file can stay theirs only where we are root.
    static_cast<void>(!::fchown(descriptor_, older->st_uid, older->st_gid));
    static_cast<void>(!::fchmod(descriptor_, older->st_mode & 0777));
}

// O_EXCL prevents other users from preparing a link there.
void OutputFile::open_named(mode_t mode) {
    do {
        temporary_ = temporary_name(target_);
        descriptor_ = open_file(temporary_, O_WRONLY | O_CREAT | O_EXCL, mode);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ >= 0) return;
    temporary_.clear();
    throw UnwritableFile(path_, errno, "no file can be made in that folder");
}

// Only renaming replaces a file, so the name lasts for a moment.
void OutputFile::give_name() {
    do {
        temporary_ = temporary_name(target_);
        if (::linkat(AT_FDCWD, name_of_descriptor(descriptor_).c_str(), AT_FDCWD,
                     temporary_.c_str(), AT_SYMLINK_FOLLOW) == 0)
            return;
    } while (errno == EEXIST);
    temporary_.clear();
    throw UnwritableFile(path_, errno);
}

OutputFile::~OutputFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool OutputFile::is_stream() const {
    return !is_regular(status_of(descriptor_));
}

void OutputFile::write(std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(descriptor_, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw UnwritableFile(path_, errno);
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

void OutputFile::finish() {
    if (descriptor_ <= STDERR_FILENO) return;
    if (is_nameless_) give_name();
    const int error = ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
    if (error != 0 && error != EINTR) throw UnwritableFile(path_, error);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw UnwritableFile(path_, errno);
    temporary_.clear();
}

void write_file(const fs::path& path, std::string_view text, UsedFiles& used, mode_t mode) {
    OutputFile file(path, used, mode);
    file.write(text);
    file.finish();
    used.add(path);
}

}  // namespace rddlc
