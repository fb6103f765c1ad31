// The diagnostics of this stage; each has a page in docs/diagnostics.
#pragma once

#include "support/diagnostic.hpp"

namespace rddlc {

inline constexpr Code unreadable_file{'E', 901};
inline constexpr Code unwritable_file{'E', 902};
inline constexpr Code unknown_output_kind{'E', 903};
inline constexpr Code no_float_reals{'E', 904};
inline constexpr Code no_cpp_compiler{'E', 905};
inline constexpr Code output_is_input{'E', 906};
inline constexpr Code undefined_external{'E', 907};
inline constexpr Code refused_external{'E', 908};
inline constexpr Code table_too_large{'E', 909};
inline constexpr Code broken_cpp_compiler{'E', 910};
inline constexpr Code no_policy_block{'E', 911};
inline constexpr Code no_such_instance{'E', 912};

inline constexpr Code idle_lanes{'W', 901};

}  // namespace rddlc
