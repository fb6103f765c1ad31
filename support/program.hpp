// What both programs do around their work.
#pragma once

#include "support/failure.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace rddlc {

// Runs `work` and gives the exit status of the program `name`. Whatever is thrown is told here, in
// one place, as the fault of who made it: a Failure is the user's or the machine's, as are a lack
// of memory and what the system refuses; all else is a mistake of our own. What could not be
// written to standard output is a failure, too.
int run_program(std::string_view name, std::string_view version,
                const std::function<ExitStatus()>& work);

bool is_terminal(int descriptor);
// Whether what is told is read on a terminal that understands escape codes: TERM is not "dumb".
bool tells_to_screen();
// How many columns that terminal has; 0 if it does not tell.
std::size_t screen_columns();
// And by somebody who has not set NO_COLOR (https://no-color.org).
bool tells_in_color();

// What people read goes through tell() or print(), which leave nothing of it that drives a terminal
// (printable() of utf8.hpp): names, paths and messages may be anybody's.
//
// Writes to standard error. If nobody can read that there is nobody to tell, so it never fails.
void tell(std::string_view text);
// The same with escape codes of ours; all else in the text is printable().
void tell_with_codes(std::string_view text);
// Writes to standard output.
void print(std::string_view text);
// What another program may read, or a file: as it is, unless standard output is a terminal.
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
