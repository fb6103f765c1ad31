#include "support/program.hpp"

#include "support/utf8.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

namespace rddlc {
namespace {

// A file that is opened may not become what others take for standard output. Such a descriptor
// cannot be used; it only holds the place.
void occupy_standard_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) != -1) continue;
        const int wrong_way = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        static_cast<void>(::open("/dev/null", wrong_way));
    }
}

Failure unwritable_standard_output(int error) {
    return Failure(fmt::format("cannot write to standard output: {}",
                               error != 0 ? std::strerror(error) : "it was refused before"));
}

void flush_standard_output() {
    errno = 0;
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (flushed && std::cout) return;
    throw unwritable_standard_output(errno);
}

// A failure of the system, in words of ours. Only printing to standard output leaves that mark.
Failure failure_of(const std::system_error& error) {
    const int number = error.code().value();
    if (std::ferror(stdout)) return unwritable_standard_output(number);
    if (const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
        return Failure(
            fmt::format("cannot use '{}': {}", file->path1().string(), std::strerror(number)));
    return Failure(error.what());
}

ExitStatus tell_own_mistake(std::string_view name, std::string_view version, const char* what) {
    tell(
        "{0}: internal error: {1}\n"
        "This is a mistake in {0} {2}, not in your problem: please report it with the command and "
        "the files.\n",
        name, what, version);
    return internal_error;
}

// A terminate handler takes no arguments, so what it prints stands here.
std::string program_name, program_version;

// Exceptions that leave a thread or a noexcept function come here.
[[noreturn]] void end_with_message() {
    const char* what = "the program was ended by itself";
    try {
        if (const std::exception_ptr error = std::current_exception())
            std::rethrow_exception(error);
    } catch (const std::exception& error) {
        std::_Exit(tell_own_mistake(program_name, program_version, error.what()));
    } catch (...) {
        what = "an exception that is none of the standard library's";
    }
    std::_Exit(tell_own_mistake(program_name, program_version, what));
}

}  // namespace

int run_program(std::string_view name, std::string_view version,
                const std::function<ExitStatus()>& work) {
    const auto failed = [&](const char* what, const std::string& hint, ExitStatus status) {
        tell("{}: error: {}\n", name, what);
        if (!hint.empty()) tell("  {}\n", hint);
        return status;
    };
    occupy_standard_descriptors();
    program_name = name;
    program_version = version;
    std::set_terminate(end_with_message);
    // A file that may not grow is a failure to write, not the end of the process.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        const ExitStatus status = work();
        flush_standard_output();
        return status;
    } catch (const Diagnosed&) {
        return diagnosed;
    } catch (const Failure& failure) {
        return failed(failure.what(), failure.hint, failure.status);
    } catch (const std::system_error& error) {
        return failed(failure_of(error).what(), "", diagnosed);
    } catch (const std::bad_alloc&) {
        return failed("not enough memory", "", diagnosed);
    } catch (const std::exception& error) {
        return tell_own_mistake(name, version, error.what());
    }
}

bool is_terminal(int descriptor) {
    return ::isatty(descriptor) == 1;
}

bool tells_to_screen() {
    const char* const terminal = std::getenv("TERM");
    return is_terminal(STDERR_FILENO) && (!terminal || std::string_view(terminal) != "dumb");
}

std::size_t screen_columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

bool tells_in_color() {
    const char* const no_color = std::getenv("NO_COLOR");
    return tells_to_screen() && (!no_color || *no_color == '\0');
}

void tell(std::string_view text) {
    tell_with_codes(printable(text));
}

void print(std::string_view text) {
    fmt::print("{}", printable(text));
}

void print_data(std::string_view text) {
    if (is_terminal(STDOUT_FILENO)) return print(text);
    fmt::print("{}", text);
}

void tell_with_codes(std::string_view text) {
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

}  // namespace rddlc
