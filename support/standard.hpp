// The accepted variant of RDDL.
#pragma once

#include <optional>
#include <string_view>

namespace rddlc {

enum class Standard {
    PyRddlGym,  // what pyRDDLGym accepts
    Rddlc,      // that and the extensions of docs/dialects.md
};

constexpr std::string_view name_of(Standard standard) {
    return standard == Standard::Rddlc ? "rddlc" : "pyrddlgym";
}

constexpr std::optional<Standard> standard_named(std::string_view name) {
    for (const Standard standard : {Standard::PyRddlGym, Standard::Rddlc})
        if (name == name_of(standard)) return standard;
    return std::nullopt;
}

// Ends the hint of every diagnostic about an extension that is not asked for.
inline constexpr std::string_view extension_hint = "--std=rddlc allows it";

}  // namespace rddlc
