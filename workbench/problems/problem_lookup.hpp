// Finds the files of a problem: two paths, or a name and an instance of rddlrepository.
#pragma once

#include "support/memory.hpp"
#include "support/standard.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rddlc::workbench {

struct ProblemFiles {
    std::string name;  // for people: "MountainCar_ippc2023 1", or the paths
    std::filesystem::path domain;
    std::optional<std::filesystem::path> instance;     // absent: `domain` holds both
    std::optional<std::filesystem::path> policy = {};  // a file with a policy block for it
    std::string instance_name = {};           // of several that the files hold; empty: the last one
    Standard standard = Standard::PyRddlGym;  // in which they are written
    std::int64_t memory_limit = default_memory_limit;  // bytes that its simulators may take

    std::vector<std::filesystem::path> inputs() const;  // without the policy
    std::vector<std::filesystem::path> all() const;
};

// A folder of the repository that holds a domain and its instances.
struct RepositoryProblem {
    std::string name;         // as in pyRDDLGym: "MountainCar_ippc2023"
    std::string context;      // "ippc2023"; "standalone" if it belongs to no competition
    std::string description;  // one sentence
    std::filesystem::path folder;
    std::vector<std::string> instances;  // "1", "2", ... in numerical order

    std::filesystem::path domain_file() const { return folder / "domain.rddl"; }
    std::filesystem::path instance_file(std::string_view instance) const;
};

struct Repository {
    std::filesystem::path folder;
    std::vector<RepositoryProblem> problems;  // by name
};

// The repository at $RDDL_REPOSITORY (the package rddlrepository, its archive, or any folder of
// problems), else the Python package installed for $VIRTUAL_ENV or python3.
std::optional<Repository> find_repository();
// The same, failing with how to install it.
Repository require_repository();

// All problems below `folder`: sub-folders with a domain.rddl and instances: instance7.rddl is "7",
// instance.rddl is "1". Names and descriptions come from the `info = {...}` of their __init__.py,
// or else from the folder.
Repository scan_repository(const std::filesystem::path& folder);

// A domain.rddl and its instances in a folder of the user. Fails if the folder holds no such files.
RepositoryProblem problem_in(const std::filesystem::path& folder);

// Fails, and suggests similar names, if there is no such problem.
const RepositoryProblem& find_problem(const Repository& repository, std::string_view name);
ProblemFiles find_instance(const RepositoryProblem& problem, std::string_view instance);

// Whether the user means a file or a folder: it exists, ends with .rddl or has a '/'.
bool is_path(const std::string& text);

// `first` and `second` as the user gave them: two files; a file that holds both blocks; a folder or
// a name of the repository, and which instance. `second` may be empty.
ProblemFiles find_files(const std::string& first, const std::string& second);

}  // namespace rddlc::workbench
