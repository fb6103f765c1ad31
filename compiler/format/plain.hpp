// Layout of what has no expressions in it: by its tokens alone.
#pragma once

#include "format/cursor.hpp"

#include <string>
#include <string_view>

namespace rddlc::format {

// The tokens up to and including `stop`, which is not inside brackets. Lists break where the text
// does and where they are full, and continue below their first member.
Doc plain(Cursor& cursor, std::string_view stop);

// The tokens up to `stop`, without it, and a blank.
Doc plain_before(Cursor& cursor, std::string_view stop);

// The same without the blank as text; there are no comments.
std::string plain_text(Cursor& cursor, std::string_view stop);

// Whether a comment stands between the next token and the next `stop`.
bool has_comments_inside(const Cursor& cursor, std::string_view stop);

}  // namespace rddlc::format
