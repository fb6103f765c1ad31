// Names of options, of command lines and keywords.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc {

struct KnownOption {
    std::string name;                 // "--lr"
    std::vector<std::string> others;  // "learning_rate": what it is called elsewhere
};

// The option that an unknown name means: what is called so elsewhere, or the nearest name.
std::optional<std::string> option_meant(std::string_view given,
                                        const std::vector<KnownOption>& known);

// "; did you mean '--lr'?", or "".
std::string option_meant_text(std::string_view given, const std::vector<KnownOption>& known);

}  // namespace rddlc
