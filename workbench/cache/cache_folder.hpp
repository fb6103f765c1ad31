// Where compiled code is kept between runs. It is loaded into the process, so nobody else may put
// anything there.
#pragma once

#include <filesystem>

namespace rddlc::workbench {

// $XDG_CACHE_HOME/rddlc or ~/.cache/rddlc; made if it is missing. Fails if it cannot be made, or if
// others own it or may write to it. Root counts as ourselves.
std::filesystem::path cache_folder();

// Whether a file in it is ours alone, too: one that was put there while others could.
bool is_ours(const std::filesystem::path& file);

}  // namespace rddlc::workbench
