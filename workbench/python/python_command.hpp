// Chooses the Python that runs our scripts, and passes their arguments.
#pragma once

#include "problems/problem_lookup.hpp"

#include <filesystem>
#include <string>

namespace rddlc::workbench {

// `named` if it is not empty, else that of $VIRTUAL_ENV, else python3.
std::string python_command(const std::string& named);

struct PythonFiles {
    std::filesystem::path domain, instance;
};

// pyRDDLGym reads two files: beside one that holds both blocks an empty one, in `folder`. It takes
// the last instance and the last non-fluents; if others are wanted, the first file holds what
// belongs to the wanted instance alone.
PythonFiles files_for_python(const ProblemFiles& files, const std::filesystem::path& folder);

}  // namespace rddlc::workbench
