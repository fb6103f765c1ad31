// The diagnostics of this stage; each has a page in docs/diagnostics.
#pragma once

#include "support/diagnostic.hpp"

namespace rddlc {

inline constexpr Code unexpected_token{'E', 101};
inline constexpr Code missing_semicolon{'E', 102};
inline constexpr Code unbalanced_bracket{'E', 103};
inline constexpr Code reserved_word_as_name{'E', 104};
inline constexpr Code missing_else{'E', 105};
inline constexpr Code illegal_character{'E', 106};
inline constexpr Code not_utf8_text{'E', 107};
inline constexpr Code foreign_number{'E', 108};
inline constexpr Code foreign_operator{'E', 109};
inline constexpr Code foreign_comment{'E', 110};
inline constexpr Code misplaced_prime{'E', 111};
inline constexpr Code number_out_of_range{'E', 112};
inline constexpr Code wrong_attribute{'E', 113};
inline constexpr Code empty_file{'E', 114};
inline constexpr Code nested_too_deeply{'E', 115};
inline constexpr Code expression_too_long{'E', 116};
inline constexpr Code file_too_large{'E', 117};

}  // namespace rddlc
