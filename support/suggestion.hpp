// How a nearest name is suggested.
#pragma once

#include "support/diagnostic.hpp"

#include <optional>
#include <string>

namespace rddlc {

// The hint "did you mean 'x'?", or "".
inline std::string hint_of_name(const std::optional<std::string>& near) {
    return near ? "did you mean '" + *near + "'?" : "";
}

// The same, with the change of `place`, which holds the name.
inline Hint hint_of_name(const std::optional<std::string>& near, Span place) {
    if (!near) return {};
    return Hint(hint_of_name(near), {{place, *near}});
}

// At the end of a sentence: "; did you mean 'x'?", or "".
inline std::string ending_with_name(const std::optional<std::string>& near) {
    return near ? "; " + hint_of_name(near) : "";
}

}  // namespace rddlc
