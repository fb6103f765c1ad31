// The cause of a failed C++ compilation: it is a bug of ours if the compiler finds an error in our
// text, and only then.
#pragma once

#include "driver/process.hpp"
#include "support/diagnostic.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rddlc {

// Whether it names a place in what it compiles as wrong, or a function that is missing. It must
// speak English (LC_ALL=C).
bool names_a_mistake(const ProcessResult& failed);

// Whether it says that it lacks memory or room, or that it was killed.
bool lacks_resources(const ProcessResult& failed);

// Whether a text that we have written is wrong. It is if the compiler names a mistake and lacks
// nothing, if CXX adds no options of the user's, and if `compiles_runtime`: the compiler accepts
// the headers of our runtime alone, so it is new enough. The last is asked only if all else holds.
bool is_our_mistake(const ProcessResult& failed, const std::function<bool()>& compiles_runtime);

// Any other failure, with what the compiler says.
Diagnostic failing_compiler(const std::vector<std::string>& command, const ProcessResult& failed);

// It said that all went well, and made no output.
Diagnostic idle_compiler(const std::vector<std::string>& command);

}  // namespace rddlc
