// The folder in which compiled code is kept between runs. The code is loaded into the process, so
// other users must not be able to put anything there.
#pragma once

#include <filesystem>

namespace rddlc::workbench {

// $XDG_CACHE_HOME/rddlc or ~/.cache/rddlc; made if it is missing. Fails if it cannot be made, or if
// others own it or may write to it. Root counts as ourselves.
std::filesystem::path cache_folder();

// Whether a file in it also belongs to this user alone: it may have been put there while others
// could write.
bool is_ours(const std::filesystem::path& file);

}  // namespace rddlc::workbench
