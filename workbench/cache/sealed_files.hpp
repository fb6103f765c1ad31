// Files of the cache that can be distinguished from damaged ones: by a full disk, or a machine that
// stopped. Loading or linking a file that is cut off may kill the process.
#pragma once

#include <filesystem>

namespace rddlc::workbench {

// A shared object ends with the hash of what stands before it; the loader does not mind.
void seal(const std::filesystem::path& object);
bool is_sealed(const std::filesystem::path& object);

// A folder has a list of its files, with the size and a checksum of each.
void seal_folder(const std::filesystem::path& folder);
// Neither more nor fewer files than that.
bool is_sealed_folder(const std::filesystem::path& folder);

}  // namespace rddlc::workbench
