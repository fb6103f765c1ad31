// A record of the cached object for a problem's files, so that loading them again compiles nothing:
// neither the object nor its text.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rddlc::workbench {

// Whether the C++ compiler is a program in PATH.
bool is_compiler_there();

// A key for all that an object depends on: the texts and names of the files, `options`, this very
// compiler, the runtime's headers, the C++ compiler (these three by place, size and time) and the
// kind of processor. Nothing if there is no C++ compiler, or a file cannot be read.
std::optional<std::string> key_of_files(const std::vector<std::filesystem::path>& files,
                                        const std::string& options);

// Nothing where the object is not there or damaged.
std::optional<std::filesystem::path> known_object(const std::string& key);

void remember_object(const std::string& key, const std::filesystem::path& object);

}  // namespace rddlc::workbench
