// Shared frame of both programs around their work.
#pragma once

#include "support/failure.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace rddlc {

// Runs `work` and returns the exit status of the program `name`. All exceptions are reported here,
// in one place, with their cause: a Failure is the user's or the machine's, as are a lack of memory
// and errors of the system; all else is a bug of ours. Output that could not be written to standard
// output is also a failure.
int run_program(std::string_view name, std::string_view version,
                const std::function<ExitStatus()>& work);

bool is_terminal(int descriptor);
// Whether messages appear on a terminal that understands escape codes: TERM is not "dumb".
bool tells_to_screen();
// The number of columns of that terminal; 0 if it does not report it.
std::size_t screen_columns();
// The same, and NO_COLOR is not set (https://no-color.org).
bool tells_in_color();

// Texts for people go through tell() or print(), which leave nothing in them that drives a terminal
// (printable() of utf8.hpp): names, paths and messages may come from strangers.
//
// Writes to standard error. If that cannot be written, no report is possible, so it never fails.
void tell(std::string_view text);
// The same with escape codes of ours; all else in the text is printable().
void tell_with_codes(std::string_view text);
// Writes to standard output.
void print(std::string_view text);
// Prints data for other programs or files: as it is, unless standard output is a terminal.
void print_data(std::string_view text);

template <class... Arguments>
void tell(fmt::format_string<Arguments...> form,
          Arguments&&... arguments) requires(sizeof...(Arguments) > 0) {
    tell(std::string_view(fmt::format(form, std::forward<Arguments>(arguments)...)));
}

template <class... Arguments>
void print(fmt::format_string<Arguments...> form,
           Arguments&&... arguments) requires(sizeof...(Arguments) > 0) {
    print(std::string_view(fmt::format(form, std::forward<Arguments>(arguments)...)));
}

}  // namespace rddlc
