#include "driver/watched_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>

namespace rddlc {
namespace {

// Pointers as posix_spawn takes them; they point into the strings.
std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> all;
    for (const std::string& word : words) all.push_back(const_cast<char*>(word.c_str()));
    all.push_back(nullptr);
    return all;
}

// The arguments of posix_spawn. Made before the fork: nothing may be allocated after it.
struct Start {
    Start(const std::vector<std::string>& words, const std::vector<std::string>& variables,
          int output)
        : command(pointers(words)), environment(pointers(variables)) {
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
        ::posix_spawnattr_init(&attributes);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
        ::posix_spawnattr_setpgroup(&attributes, 0);  // one of its own
        ::pthread_sigmask(SIG_SETMASK, nullptr, &mask);
        ::posix_spawnattr_setsigmask(&attributes, &mask);
    }
    ~Start() {
        ::posix_spawn_file_actions_destroy(&actions);
        ::posix_spawnattr_destroy(&attributes);
    }
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;

    std::vector<char*> command, environment;
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t mask;  // ours
};

bool is_ignored(int signal) {
    struct sigaction action {};
    return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// The signals that end the process. Those that we ignore, as under nohup, are not among them.
sigset_t watched_signals() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGHUP, SIGQUIT})
        if (!is_ignored(signal)) ::sigaddset(&signals, signal);
    ::sigaddset(&signals, SIGTERM);
    ::sigaddset(&signals, SIGCHLD);
    return signals;
}

// Descriptors of the process that we were: pipes and locks that others wait for.
void close_all_others() {
#ifdef __linux__
    ::close_range(STDERR_FILENO + 1, ~0U, 0);
#endif
}

// Compilers remove their temporary files when they are asked to end. Processes that then still run
// are killed.
void end_group(pid_t program) {
    constexpr timespec patience{1, 0};
    sigset_t ended;
    ::sigemptyset(&ended);
    ::sigaddset(&ended, SIGCHLD);
    ::kill(-program, SIGTERM);
    ::sigtimedwait(&ended, nullptr, &patience);
    ::kill(-program, SIGKILL);
}

int status_like(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

// Runs in a process of our own, where nothing may be allocated.
[[noreturn]] void watch(const Start& start, const sigset_t& signals, Interrupts interrupts,
                        pid_t parent, int told) {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
    ::signal(SIGCHLD, SIG_DFL);  // if it was ignored there would be no status
    pid_t program = 0;
    const int error =
        ::getppid() != parent
            ? ESRCH
            : ::posix_spawnp(&program, start.command[0], &start.actions, &start.attributes,
                             start.command.data(), start.environment.data());
    static_cast<void>(!::write(told, &error, sizeof error));
    close_all_others();
    if (error != 0) ::_exit(127);
    while (true) {
        int signal = 0;
        ::sigwait(&signals, &signal);
        const bool is_of_terminal = signal != SIGCHLD && signal != SIGTERM;
        if (is_of_terminal && interrupts == Interrupts::Ignored) continue;
        if (signal != SIGCHLD) {
            end_group(program);
            ::_exit(128 + signal);
        }
        int status = 0;
        if (::waitpid(program, &status, WNOHANG) == program) ::_exit(status_like(status));
    }
}

// The error that the process reports of its start, or 0.
int read_error(int descriptor) {
    int error = 0;
    ssize_t count = 0;
    do {
        count = ::read(descriptor, &error, sizeof error);
    } while (count < 0 && errno == EINTR);
    return count == sizeof error ? error : EAGAIN;
}

}  // namespace

pid_t start_watched(const std::vector<std::string>& command,
                    const std::vector<std::string>& environment, int output,
                    Interrupts interrupts) {
    std::array<int, 2> ends;  // to read from, to write to
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return -1;
    const Start start(command, environment, output);
    const pid_t parent = ::getpid();
    // No signal may end the watching process before it waits for them.
    const sigset_t signals = watched_signals();
    ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    const pid_t process = ::fork();
    if (process == 0) watch(start, signals, interrupts, parent, ends[1]);
    int error = errno;
    ::pthread_sigmask(SIG_SETMASK, &start.mask, nullptr);
    ::close(ends[1]);
    if (process > 0) error = read_error(ends[0]);
    ::close(ends[0]);
    if (process > 0 && error == 0) return process;
    while (process > 0 && ::waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
    }
    errno = error;
    return -1;
}

}  // namespace rddlc
